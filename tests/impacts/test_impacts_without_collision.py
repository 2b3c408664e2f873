"""Where friction can press a contact without collision, this is listed, and chosen on demand.

A rod slides on its lower end at the angle a, its tip at v < 0. Per unit of normal impulse the
speeds of the tip change by p = W_nn + mu W_nt along the normal and s = W_nt + mu W_tt along the
line (m W_nn = 1 + 3 cos(a)^2, m W_tt = 1 + 3 sin(a)^2, m W_nt = -3 sin(a) cos(a)). With p < 0 the
tip is pressed until its slip ends, by the impulse -v/s. It sticks then, and is pressed further by
-p (-v/s)/(W_nn - W_nt^2/W_tt) until it does not approach any more (L. Lecornu 1905; F. Génot,
B. Brogliato 1999).
"""

from __future__ import annotations

import math

import numpy as np
import pytest
import sliding_rod
from scipy.integrate import solve_ivp

import frot

G = 9.81
MU = 2.0


def rod(choice: str) -> frot.Model:
    return sliding_rod.rod(f"tolerance = 1e-10, on_indeterminate = {choice}")


def impulse_and_loss(values: dict[str, float]) -> tuple[float, float]:
    a, m = values.get("start", math.radians(40)), values.get("m", 1.0)
    v = -abs(values.get("slip", -1.0))
    nn, tt = (1 + 3 * math.cos(a) ** 2) / m, (1 + 3 * math.sin(a) ** 2) / m
    nt = -3 * math.sin(a) * math.cos(a) / m
    p, s = nn + MU * nt, nt + MU * tt
    assert p < 0 < s
    pressed = -v / s
    stuck = -p * pressed / (nn - nt * nt / tt)
    # the work of the impulses: sum of the mean speeds times the impulses of both phases
    first = 0.5 * p * pressed * pressed + 0.5 * v * MU * pressed
    second = 0.5 * p * pressed * stuck
    return pressed + stuck, -(first + second)


SCENES = [
    {},
    {"side": -1.0},
    {"m": 1e6},
    {"m": 1e-6, "side": -1.0},
    {"start": math.radians(50), "slip": -3.0},
]


@pytest.mark.parametrize("values", SCENES)
def test_the_choice_impact_takes_the_impulse_of_the_closed_form(values: dict[str, float]) -> None:
    impulse, loss = impulse_and_loss(values)
    events = rod("impact").simulate(parameters=values).events
    one = next(e for e in events if e.kind == "tangential_impact")
    assert one.time == 0 and one.before == "slip"
    assert one.impulse == pytest.approx(impulse, rel=1e-12)
    assert one.energy_lost == pytest.approx(loss, rel=1e-12)


@pytest.mark.parametrize("values", SCENES)
def test_motions_tell_of_it_beside_the_others(values: dict[str, float]) -> None:
    impulse, loss = impulse_and_loss(values)
    found = rod("rest").motions(parameters=values)
    assert [one.modes["tip"] for one in found] == ["slip", "open"]
    (text,) = found.beside
    assert f"impact of {impulse:.6g} N.s" in text and f"{loss:.6g} J lost" in text
    assert text in str(found) and found.as_data()["impacts_beside"] == [text]
    assert found.before == ()


@pytest.mark.parametrize("choice", ["rest", "continue"])
def test_other_choices_take_a_motion_with_finite_reactions(choice: str) -> None:
    events = rod(choice).simulate().events
    assert [e.kind for e in events if e.time == 0] == ["several"]


def test_an_impasse_has_no_motion_and_the_impact_alone() -> None:
    for choice in ("rest", "impact"):
        found = rod(choice).motions(parameters={"rate": 0.0})
        assert len(found) == 0 and len(found.beside) == 1
        assert "no admissible motion (impasse)" in str(found)


def test_nothing_is_pressed_where_the_coefficient_is_positive() -> None:
    for values in ({"start": math.radians(10)}, {"slip": 1.0}):
        found = rod("impact").motions(parameters=values)
        assert found.beside == () and len(found) == 1
        events = rod("impact").simulate(parameters=values).events
        assert not any(e.kind == "tangential_impact" for e in events)


def test_impacts_of_the_start_are_said_before_the_motions() -> None:
    model = frot.compile("""
planar model Drop
  body ball: particle(mass = 2 kg);
  liaison floor: contact_ponctuel(ground.line, ball);
initial
  ball.position = (0, 0) m;
  ball.velocity = (0, -3) m/s;
  experiment(stop = 1 s);
end Drop;
""")
    found = model.motions()
    (text,) = found.before
    assert text.startswith("floor: impact of 6 N.s at t = 0")
    assert found.beside == () and [x.modes["floor"] for x in found] == ["closed"]
    assert f"  after {text}" in str(found)


@pytest.mark.parametrize(("side", "m"), [(1.0, 1.0), (-1.0, 1e6)])
def test_an_impact_follows_at_once_where_the_reaction_of_a_jammed_slip_vanishes(
    side: float, m: float
) -> None:
    """With p < 0 and b' < 0 where N = -b/p comes to zero: neither slip nor flight is admissible.

    The instant and the slip are those of an integration of the slip; the impulse has a closed form.
    """
    length = 1.0

    def rates(_: float, y: np.ndarray) -> list[float]:
        # angle, its rate, slip; unit mass; N from the gap's acceleration, friction mu N against it
        a, w, _slip = y
        n = normal(y)[0]
        couple = (-math.cos(a) + MU * math.sin(a)) * n * length / 2
        turning = 12 / length**2 * couple
        along = MU * n + length / 2 * (w * w * math.cos(a) + turning * math.sin(a))
        return [w, turning, along]

    def normal(y: np.ndarray) -> tuple[float, float]:
        a, w = y[0], y[1]
        p = 1 + 3 * math.cos(a) ** 2 - 3 * MU * math.sin(a) * math.cos(a)
        b = -G + length / 2 * w * w * math.sin(a)
        return -b / p, p

    def vanishes(_: float, y: np.ndarray) -> float:
        return G - length / 2 * y[1] ** 2 * math.sin(y[0])

    vanishes.terminal = True  # type: ignore[attr-defined]
    run = solve_ivp(
        rates, (0, 1), [math.pi / 4, -6.0, -1.0], "DOP853", events=vanishes, rtol=1e-12, atol=1e-13
    )
    (instant,), (state,) = run.t_events[0], run.y_events[0]
    assert normal(state)[1] < 0 and state[2] < 0
    values = {"m": m, "side": side, "l": length, "start": math.pi / 4, "rate": -6.0}
    first = sliding_rod.rod("tolerance = 1e-11").simulate(parameters=values).events
    (one,) = (e for e in first if e.kind == "tangential_impact")
    assert not any(e.kind == "separation" for e in first)
    assert one.time == pytest.approx(instant, rel=1e-9)
    impulse, loss = impulse_and_loss({"start": state[0], "slip": state[2], "m": m})
    assert one.impulse == pytest.approx(impulse, rel=1e-8)
    assert one.energy_lost == pytest.approx(loss, rel=1e-8)
