"""Friction elements bounded by a value of the text or by a pin's reaction, against closed forms."""

from __future__ import annotations

import math

import casadi as ca
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from small_models import Element, Small, column

CLUTCH = Element("value", tangent=0)


def clutch(name: str, torque: float, bound: float, bound_s: float | None = None, **more) -> Small:
    """Two inertias on one axis, a torque on the first, and a clutch between them."""
    rest = bound if bound_s is None else bound_s
    return Small(
        name=name, nq=2, nv=2, elements=[CLUTCH], unilateral=[0.0],
        mass=lambda s: ca.diag(column(2.0, 3.0)), force=lambda s: column(torque, 0),
        rows=lambda s: ca.SX(ca.DM([[1.0, -1.0]])),
        coefficients=lambda s: column(bound, rest),
        energy=lambda s: column((2 * s.v[0] ** 2 + 3 * s.v[1] ** 2) / 2, 0),
        power=lambda s: torque * s.v[0],
        variables={"w1": lambda s: s.v[0], "w2": lambda s: s.v[1], "c": lambda s: s.lam[0]},
        **more,
    )  # fmt: skip


def test_a_clutch_locks_when_its_speeds_meet(run) -> None:
    """2 w1' = 1 - 5, 3 w2' = 5 from 10 and 0: they meet at 10 / (2 + 5/3)."""
    result = run(clutch("clutch", 1.0, 5.0, start=([0, 0], [10.0, 0.0]), stop=5.0))
    meets = 10 / (2 + 5 / 3)
    assert [e.kind for e in result.events] == ["stick"]
    assert result.events[0].time == pytest.approx(meets, rel=1e-13)
    together = (20 + 5.0) / 5
    assert result["w1"][-1] == pytest.approx(together, rel=1e-13)
    assert np.array_equal(np.unique(result["element 1.mode"]), [1, 2])
    assert result["c"][-1] == pytest.approx(-3 / 5, rel=1e-13)  # it carries 3/5 of the torque
    assert result["c"][0] == -5.0
    lost = (2 * 100 - 5 * (20 + meets) ** 2 / 25) / 2 + (0.5 * (10 + 10 - 2 * meets) * meets)
    assert result.balance.dissipated == pytest.approx(lost, rel=1e-12)
    assert result.balance.relative < 1e-12


def test_a_clutch_slips_once_its_load_grows_past_the_bound_of_rest(run) -> None:
    """The torque 4 t on the first: the clutch carries 3/5 of it, up to mu_s = 6; slips with 5."""
    model = Small(
        name="ramp", nq=2, nv=2, elements=[CLUTCH], unilateral=[0.0], stop=4.0,
        mass=lambda s: ca.diag(column(2.0, 3.0)), force=lambda s: column(4 * s.t, 0),
        rows=lambda s: ca.SX(ca.DM([[1.0, -1.0]])), coefficients=lambda s: column(5.0, 6.0),
        start=([0, 0], [1.0, 1.0]), time_dependent=True,
        variables={"w1": lambda s: s.v[0], "w2": lambda s: s.v[1]},
    )  # fmt: skip
    result = run(model)
    leaves = 6 / (4 * 3 / 5)
    assert [(e.kind, e.time) for e in result.events] == [("slip", pytest.approx(leaves, rel=1e-13))]
    w0 = 1 + 2 * leaves**2 / 5
    t = 4.0
    assert result["w2"][-1] == pytest.approx(w0 + 5 / 3 * (t - leaves), rel=1e-12)
    gained = (2 * (t**2 - leaves**2) - 5 * (t - leaves)) / 2
    assert result["w1"][-1] == pytest.approx(w0 + gained, rel=1e-12)


@pytest.mark.parametrize(
    ("bounds", "torque", "slides"),
    [((1.0, 10.0), 6.0, False), ((1.0, 10.0), 10.9, False), ((1.0, 10.0), 11.1, True),
     ((3.0, 3.0), 5.9, False), ((3.0, 3.0), 6.1, True), ((0.0, 2.0), 1.9, False)],
)  # fmt: skip
def test_two_brakes_in_parallel_hold_what_both_can_together(run, bounds, torque, slides) -> None:
    model = Small(
        name=f"brakes{bounds}{torque}".replace(" ", ""), nq=1, nv=1, unilateral=[0.0, 0.0],
        elements=[Element("value", tangent=0), Element("value", tangent=1)],
        mass=lambda s: ca.SX(2), force=lambda s: ca.SX(torque), start=([0.0], [0.0]),
        rows=lambda s: ca.SX(ca.DM([[1.0], [1.0]])),
        coefficients=lambda s: column(bounds[0], bounds[0], bounds[1], bounds[1]),
        variables={
            "w": lambda s: s.v[0], "a": lambda s: s.lam[0], "b": lambda s: s.lam[1],
        },
    )  # fmt: skip
    result = run(model)
    if slides:
        assert result["w"][-1] == pytest.approx((torque - sum(bounds)) / 2, rel=1e-12)
    else:
        assert np.all(result["w"] == 0)
        assert result["a"] + result["b"] == pytest.approx(-torque, rel=1e-12)
        assert np.all(np.abs(result["a"]) <= bounds[0] * (1 + 1e-12))
        assert np.all(np.abs(result["b"]) <= bounds[1] * (1 + 1e-12))


def test_two_brakes_in_parallel_let_go_together(run) -> None:
    """A torque 2 t against bounds of rest 1 and 4, of motion 1 and 3."""
    model = Small(
        name="parallel", nq=1, nv=1, unilateral=[0.0, 0.0], time_dependent=True, stop=5.0,
        elements=[Element("value", tangent=0), Element("value", tangent=1)],
        mass=lambda s: ca.SX(2), force=lambda s: 2 * s.t, start=([0.0], [0.0]),
        rows=lambda s: ca.SX(ca.DM([[1.0], [1.0]])),
        coefficients=lambda s: column(1.0, 1.0, 3.0, 4.0), variables={"w": lambda s: s.v[0]},
    )  # fmt: skip
    result = run(model)
    slips = [e.time for e in result.events if e.kind == "slip"]
    assert slips == pytest.approx([2.5, 2.5], rel=1e-12)
    assert result["w"][-1] == pytest.approx((25 - 6.25 - 4 * 2.5) / 2, rel=1e-11)


def test_two_clutches_in_series_slip_where_they_are_weaker(run) -> None:
    """Ground - 3 Nm - wheel - 5 Nm - wheel with a torque: first both hold, then one lets go."""
    model = Small(
        name="series", nq=2, nv=2, unilateral=[0.0, 0.0], time_dependent=True, stop=4.0,
        elements=[Element("value", tangent=0), Element("value", tangent=1)],
        mass=lambda s: ca.diag(column(1.0, 1.0)), force=lambda s: column(0, s.t),
        start=([0.0] * 2, [0.0] * 2), rows=lambda s: ca.SX(ca.DM([[1.0, 0.0], [-1.0, 1.0]])),
        coefficients=lambda s: column(3.0, 3.0, 5.0, 5.0),
        variables={"w1": lambda s: s.v[0], "w2": lambda s: s.v[1]},
    )  # fmt: skip
    result = run(model)
    assert [(e.liaison, e.kind) for e in result.events] == [("element 1", "slip")]
    assert result.events[0].time == pytest.approx(3, rel=1e-12)
    assert result["w1"][-1] == pytest.approx((16 - 9 - 6) / 4, rel=1e-10)
    assert result["w2"][-1] == pytest.approx(result["w1"][-1], rel=1e-13)


def test_an_element_between_two_prescribed_motions(run) -> None:
    """Its row of J is zero. At rest its force is undetermined: 0; moving, it is the bound."""
    slip = lambda s: ca.if_else(s.conditions[0], ca.sin(3 * (s.t - 1)), 0)  # noqa: E731
    model = Small(
        name="prescribed", nq=1, nv=1, elements=[CLUTCH], unilateral=[0.0], time_dependent=True,
        mass=lambda s: ca.SX(1), force=lambda s: -s.q[0], start=([1.0], [0.0]), stop=4.0,
        rows=lambda s: ca.SX(ca.DM([[0.0]])), row_rates=slip,
        bias=lambda s: ca.if_else(s.conditions[0], 3 * ca.cos(3 * (s.t - 1)), 0),
        coefficients=lambda s: column(2.0, 2.5), conditions=lambda s: s.t - 1, strict=[False],
        variables={"f": lambda s: s.lam[0], "x": lambda s: s.q[0]},
    )  # fmt: skip
    result = run(model)
    kinds = [(e.kind, e.time) for e in result.events if e.kind != "condition"]
    turns = [1 + k * math.pi / 3 for k in (1, 2)]
    assert [k for k, _ in kinds] == ["slip", "reversal", "reversal"]
    assert [t for _, t in kinds] == pytest.approx([1, *turns], rel=1e-12)
    t = result.time
    expected = np.where(t < 1, 0, -2 * np.sign(np.sin(3 * (t - 1))))
    away = np.all([np.abs(t - x) > 1e-9 for x in (1, *turns)], axis=0)
    assert np.array_equal(result["f"][away], expected[away])
    assert result["x"] == pytest.approx(np.cos(t), abs=1e-8)


def test_a_prescribed_motion_that_starts_smoothly_ends_the_rest(run) -> None:
    start = lambda t: ca.fmax(t - 1, 0)  # noqa: E731
    model = Small(
        name="smooth", nq=0, elements=[CLUTCH], unilateral=[0.0], time_dependent=True, stop=2.0,
        rows=lambda s: ca.SX(1, 0), row_rates=lambda s: start(s.t) ** 4,
        bias=lambda s: 4 * start(s.t) ** 3, coefficients=lambda s: column(2.0, 2.0),
        rates=lambda s: ca.SX(0, 1), variables={"f": lambda s: s.lam[0]},
    )  # fmt: skip
    result = run(model)
    assert [e.kind for e in result.events] == ["slip"]
    assert result.events[0].time == pytest.approx(1, abs=1e-3)  # 4 (t-1)^3 = 1e-12
    assert result["f"][0] == 0 and result["f"][-1] == -2


def pin_pendulum(name: str, couple: float, couple_s: float, **more) -> Small:
    """A rod (m = 1, L = 1, at its end) on a pin: auxiliary speeds bring its reaction to light."""
    m, half, g = 1.0, 0.5, 9.81
    about = m * half**2 * 4 / 3

    def mass(s):
        c, n = half * ca.cos(s.q[0]), half * ca.sin(s.q[0])
        return ca.blockcat([[about, m * c, m * n], [m * c, m, 0], [m * n, 0, m]])

    def force(s):
        n, c = ca.sin(s.q[0]), ca.cos(s.q[0])
        w2 = half * s.v[0] ** 2
        return column(-m * g * half * n, m * w2 * n, -m * g - m * w2 * c)

    return Small(
        name=name, nq=1, nv=1, na=2, mass=mass, force=force, unilateral=[0.0],
        elements=[Element("pin", normal=0, second=1, tangent=2)],
        rows=lambda s: ca.SX(ca.DM([[0.0, 1, 0], [0, 0, 1], [1, 0, 0]])),
        coefficients=lambda s: column(couple, couple_s),
        energy=lambda s: column(about * s.v[0] ** 2 / 2, -m * g * half * ca.cos(s.q[0])),
        variables={
            "angle": lambda s: s.q[0], "w": lambda s: s.v[0],
            "rx": lambda s: s.lam[0], "ry": lambda s: s.lam[1], "c": lambda s: s.lam[2],
        },
        **more,
    )  # fmt: skip


def swing(couple: float, q0: float, w0: float, sign: float, end: float) -> np.ndarray:
    """Angle and speed of the same rod: its reaction solved from Newton's law in closed form."""
    m, half, g = 1.0, 0.5, 9.81
    about = m * half**2 * 4 / 3

    def rate(_: float, x: np.ndarray) -> list[float]:
        n, c = math.sin(x[0]), math.cos(x[0])
        along = m * g * c + m * half * x[1] ** 2  # towards the pin
        # J a = -m g h n - sign mu rho;  across = m (h a + g n);  rho^2 = along^2 + across^2
        b0 = m * g * n * (1 - m * half**2 / about)
        b1 = m * half * sign * couple / about
        # rho^2 (1 - b1^2) + 2 b0 b1 rho - (b0^2 + along^2) = 0
        k = 1 - b1**2
        rho = (-b0 * b1 + math.sqrt((b0 * b1) ** 2 + k * (b0**2 + along**2))) / k
        return [x[1], (-m * g * half * n - sign * couple * rho) / about]

    done = solve_ivp(rate, (0, end), [q0, w0], method="DOP853", rtol=1e-13, atol=1e-14)
    return done.y[:, -1]


def test_a_pin_resists_with_its_own_reaction(run) -> None:
    """The couple mu |R| acts back on R: solved with it, not a step late."""
    result = run(pin_pendulum("pin", 0.05, 0.05, start=([1.2], [0.0])), stop=0.5, tolerance=1e-13)
    angle, w = swing(0.05, 1.2, 0.0, -1.0, 0.5)
    assert result["angle"][-1] == pytest.approx(angle, rel=1e-11)
    assert result["w"][-1] == pytest.approx(w, rel=1e-11)
    size = np.hypot(result["rx"], result["ry"])
    assert result["c"][1:] == pytest.approx(0.05 * size[1:], rel=1e-13)
    assert result.balance.relative < 1e-11


def test_a_pin_swings_down_to_rest_within_its_bound(run) -> None:
    result = run(pin_pendulum("pin_rest", 0.05, 0.06, start=([1.2], [0.0])), stop=20.0)
    kinds = [e.kind for e in result.events]
    assert kinds[-1] == "stick" and set(kinds[:-1]) <= {"reversal"}
    assert result["w"][-1] == 0
    # at rest R is the weight, and the couple that of the weight about the pin
    assert result["c"][-1] == pytest.approx(9.81 * 0.5 * math.sin(result["angle"][-1]), rel=1e-12)
    assert abs(result["c"][-1]) <= 0.06 * 9.81
    assert result.balance.relative < 1e-8


@pytest.mark.parametrize("angle", [0.119, -0.119, 0.121])
def test_a_pin_holds_up_to_mu_s_times_its_reaction(run, angle) -> None:
    """m g h sin = mu_s r m g: sin = 0.06 / 0.5 = 0.12."""
    angle = math.copysign(math.asin(abs(angle)), angle)
    model = pin_pendulum(f"pin_{angle}", 0.05, 0.06, start=([angle], [0.0]))
    result = run(model, stop=0.3)
    assert (result["w"][-1] == 0) == (abs(angle) < math.asin(0.12))


def test_a_pin_s_reaction_may_pass_through_zero(run) -> None:
    """A turning wheel whose shaft is pushed by cos t along one axis: |R| has a corner at zero."""
    model = Small(
        name="zero", nq=1, nv=1, na=2, unilateral=[0.0], start=([0.0], [5.0]), stop=6.0,
        elements=[Element("pin", normal=0, second=1, tangent=2)], time_dependent=True,
        mass=lambda s: ca.diag(column(2.0, 1.0, 1.0)), force=lambda s: column(0, -ca.cos(s.t), 0),
        rows=lambda s: ca.SX(ca.DM([[0.0, 1, 0], [0, 0, 1], [1, 0, 0]])),
        coefficients=lambda s: column(0.4, 0.4), variables={"w": lambda s: s.v[0]},
    )  # fmt: skip
    result = run(model, tolerance=1e-9)
    impulse = 1 + 2 + (1 + math.sin(6.0))  # of |cos t| from 0 to 6
    assert result["w"][-1] == pytest.approx(5 - 0.2 * impulse, abs=1e-9)
    assert not result.events  # it is no change of mode


def test_many_elements_stick_at_one_instant(run) -> None:
    """Six equal wheels, each with its brake, released alike: all come to rest at once."""
    n = 6
    model = Small(
        name="six", nq=n, nv=n, unilateral=[0.0] * n, start=([0.0] * n, [3.0] * n), stop=4.0,
        elements=[Element("value", tangent=i) for i in range(n)],
        mass=lambda s: ca.SX.eye(n) + 0.1, force=lambda s: ca.SX.zeros(n),
        rows=lambda s: ca.SX.eye(n), coefficients=lambda s: column(*([1.6, 1.6] * n)),
        variables={f"w{i}": lambda s, i=i: s.v[i] for i in range(n)},
    )  # fmt: skip
    result = run(model)
    assert [e.kind for e in result.events] == ["stick"] * n
    assert [e.time for e in result.events] == pytest.approx([3.0] * n, rel=1e-12)
    assert all(result[f"w{i}"][-1] == 0 for i in range(n))


def test_the_general_core_treats_elements_as_the_symmetric_one_does(run) -> None:
    one = run(clutch("clutch_a", 1.0, 5.0, start=([0, 0], [10.0, 0.0]), stop=5.0))
    two = run(
        clutch(
            "clutch_b",
            1.0,
            5.0,
            start=([0, 0], [10.0, 0.0]),
            stop=5.0,
            metric=lambda s: ca.diag(column(2.0, 3.0)),
        )
    )
    assert [e.kind for e in two.events] == ["stick"]
    assert two.events[0].time == pytest.approx(one.events[0].time, rel=1e-14)
    for name in ("w1", "w2", "c"):
        assert np.allclose(one[name], two[name], rtol=1e-13, atol=1e-13)
