"""Models of equations: a core of any matrix, states without speed, invariants."""

from __future__ import annotations

import math

import casadi as ca
import numpy as np
import pytest
from records import HEAD, records
from scipy.special import ellipj, ellipk
from small_models import NONE, Block, Small, column


def swinging(amplitude: float, t: np.ndarray, g: float, length: float) -> np.ndarray:
    """Angle of a pendulum released at rest (closed form in elliptic functions)."""
    k = math.sin(amplitude / 2)
    w0 = math.sqrt(g / length)
    sn = ellipj(ellipk(k * k) - w0 * t, k * k)[0]
    return 2 * np.arcsin(k * sn)


def pendulum_in_x_y() -> Small:
    """Index 1 with the tension as an unknown of the core, and the two hidden relations."""
    g, length, amplitude = 9.81, 1.3, 1.0
    start = [length * math.sin(amplitude), -length * math.cos(amplitude)]
    return Small(
        name="pendulum", nq=2, nv=2, nc=1, start=(start, [0.0, 0.0]), stop=10.0,
        mass=lambda s: ca.blockcat([[1, 0, s.q[0]], [0, 1, s.q[1]], [s.q[0], s.q[1], 0]]),
        force=lambda s: column(0, -g, -ca.sumsqr(s.v)),
        metric=lambda s: ca.SX.eye(2),
        invariants=lambda s: column(ca.sumsqr(s.q) - length**2, ca.dot(s.q, s.v)),
        energy=lambda s: column(ca.sumsqr(s.v) / 2, g * s.q[1]),
        variables={"x": lambda s: s.q[0], "y": lambda s: s.q[1], "tension": lambda s: s.z[2]},
    )  # fmt: skip


def test_a_pendulum_in_x_and_y_is_the_pendulum(run) -> None:
    result = run(pendulum_in_x_y(), tolerance=1e-12)
    angle = swinging(1.0, result.time, 9.81, 1.3)
    assert np.allclose(result["x"], 1.3 * np.sin(angle), rtol=0, atol=1e-10)
    # m L tension = m v^2 / L + m g cos: the multiplier of q is tension over length
    speed2 = 2 * 9.81 * 1.3 * (np.cos(angle) - math.cos(1.0))
    assert np.allclose(result["tension"], (speed2 / 1.3 + 9.81 * np.cos(angle)) / 1.3, atol=1e-9)


def test_its_length_stays_over_a_thousand_periods(run) -> None:
    period = 4 * ellipk(math.sin(0.5) ** 2) / math.sqrt(9.81 / 1.3)
    result = run(pendulum_in_x_y(), stop=1000 * period, tolerance=1e-8, interval=period / 3.7)
    ends = np.hypot(result["x"], result["y"])
    assert np.abs(ends / 1.3 - 1).max() < 1e-6  # inside the steps: their dense output
    segments = records(result._record)
    assert len(segments) == result.figures.steps
    first = HEAD + 3 + 2 + 4  # q begins after three times, the speeds held and sizes
    x, y = np.array([segment[first : first + 2] for segment in segments]).T
    assert np.abs(np.hypot(x, y) / 1.3 - 1).max() < 1e-12
    assert result.balance.relative < 1e-5


def test_plain_states_need_no_speeds(run) -> None:
    """Lotka and Volterra: their first integral is kept as the tolerance says."""
    model = Small(
        name="prey", nq=2, q_speed=[-1, -1], start=([1.2, 0.7],), stop=40.0,
        rates=lambda s: column(s.q[0] * (1 - s.q[1]), s.q[1] * (s.q[0] - 1)),
        variables={"a": lambda s: s.q[0], "b": lambda s: s.q[1]},
    )  # fmt: skip
    drift = []
    for tolerance in (1e-6, 1e-9, 1e-12):
        r = run(model, tolerance=tolerance)
        integral = r["a"] - np.log(r["a"]) + r["b"] - np.log(r["b"])
        drift.append(np.abs(integral - integral[0]).max())
    assert drift[0] < 1e-5 and drift[1] < 1e-8 and drift[2] < 1e-11


def test_a_model_without_states_tells_the_time(run) -> None:
    model = Small(
        name="clock",
        nq=0,
        variables={"sine": lambda s: ca.sin(s.t)},
        rates=lambda s: NONE,
        stop=5.0,
    )
    result = run(model)
    assert np.allclose(result["sine"], np.sin(result.time), rtol=0, atol=1e-15)


def test_two_states_may_share_no_rate_and_one_speed(run) -> None:
    """A block with a filter on its place: nq > nv, q' explicit for the filter."""
    w, tau = 2.0, 0.5
    model = Small(
        name="filtered", nq=2, nv=1, q_speed=[0, -1], start=([1.0, 0.0], [0.0]), stop=8.0,
        rates=lambda s: column(s.v[0], (s.q[0] - s.q[1]) / tau),
        mass=lambda s: ca.SX(1), force=lambda s: -(w**2) * s.q[0],
        variables={"x": lambda s: s.q[0], "f": lambda s: s.q[1]},
    )  # fmt: skip
    result = run(model, tolerance=1e-12)
    t, b = result.time, w * tau
    steady = (np.cos(w * t) + b * np.sin(w * t)) / (1 + b * b)
    assert np.allclose(result["x"], np.cos(w * t), rtol=0, atol=1e-11)
    assert np.allclose(result["f"], steady - np.exp(-t / tau) / (1 + b * b), rtol=0, atol=1e-11)


def test_a_general_core_moves_as_the_mass_matrix_does(run) -> None:
    """Two masses and a spring, equations scaled and mixed so that A is unsymmetric."""
    mix = ca.DM([[2.0, 1.0], [-3.0, 5.0]]) * 1e3
    m1, m2, k = 1.0, 3.0, 12.0
    model = Small(
        name="mixed", nq=2, nv=2, start=([0.4, -0.2], [0.0, 0.0]), stop=6.0,
        mass=lambda s: mix @ ca.diag(column(m1, m2)),
        force=lambda s: mix @ column(-k * (s.q[0] - s.q[1]), k * (s.q[0] - s.q[1])),
        metric=lambda s: ca.SX.eye(2),
        variables={"stretch": lambda s: s.q[0] - s.q[1]},
    )  # fmt: skip
    result = run(model, tolerance=1e-12)
    w = math.sqrt(k * (1 / m1 + 1 / m2))
    assert np.allclose(result["stretch"], 0.6 * np.cos(w * result.time), rtol=0, atol=1e-10)


def test_a_singular_core_is_said_in_a_sentence_of_equations(run) -> None:
    model = Small(
        name="twice", nq=1, nv=1, nc=1, start=([0.0], [1.0]), metric=lambda s: ca.SX(1),
        mass=lambda s: ca.SX(ca.DM([[1.0, 0.3], [2.0, 0.6]])), force=lambda s: column(1.0, 2.0),
    )  # fmt: skip
    with pytest.raises(Exception, match="equations of the motion are singular"):
        run(model)


def kepler(e: float) -> Small:
    """E - e sin E = M(t) in a nonlinear block, and an orbit from it."""
    block = Block(0, lambda s: [s.y[0] - e * ca.sin(s.y[0]) - s.t], name="E")
    return Small(
        name="kepler", nq=1, q_speed=[-1], start=([0.0], [], [0.0]), blocks=[block], stop=20.0,
        rates=lambda s: 1 / (1 - e * ca.cos(s.y[0])), time_dependent=True,
        variables={"E": lambda s: s.y[0], "integral": lambda s: s.q[0]},
    )  # fmt: skip


def test_kepler_s_equation_is_solved_at_every_instant(run) -> None:
    e = 0.9
    result = run(kepler(e), tolerance=1e-11)
    E = result["E"]
    assert np.allclose(E - e * np.sin(E), result.time, rtol=0, atol=5e-15 * 20)
    assert np.allclose(result["integral"], E, rtol=0, atol=1e-8)


def test_a_linear_block_is_exact(run) -> None:
    """A resistor ladder: three currents of one linear block drive a capacitor."""

    def ladder(s):
        return [s.y[0] - s.y[1] - s.y[2], 2 * s.y[1] - s.q[0], s.y[0] + 2 * s.y[1] - 10]

    model = Small(
        name="ladder", nq=1, q_speed=[-1], start=([0.0], [], [0.0] * 3), stop=4.0,
        blocks=[Block(0, ladder, 3, linear=True)], rates=lambda s: s.y[2],
        variables={"u": lambda s: s.q[0], "i": lambda s: s.y[2]},
    )  # fmt: skip
    result = run(model, tolerance=1e-12)
    # i = 10 - u - u/2: u = 20/3 (1 - exp(-3/2 t))
    assert np.allclose(result["u"], 20 / 3 * (1 - np.exp(-1.5 * result.time)), rtol=0, atol=1e-10)
    assert np.allclose(result["i"], 10 - 1.5 * result["u"], rtol=0, atol=1e-14)


def test_a_block_without_solution_is_named(run) -> None:
    model = Small(
        name="root", nq=1, q_speed=[-1], start=([1.0], [], [1.0]), stop=3.0,
        blocks=[Block(0, lambda s: [s.y[0] ** 2 - s.q[0]], name="'r'")], rates=lambda s: ca.SX(-1),
        variables={"r": lambda s: s.y[0]},
    )  # fmt: skip
    with pytest.raises(Exception, match=r"equations for 'r'") as caught:
        run(model)
    assert "E0907" in str(caught.value)
    assert caught.value.result.time[-1] == pytest.approx(1, abs=1e-6)
    assert np.allclose(caught.value.result["r"], np.sqrt(1 - caught.value.result.time), atol=1e-6)


def test_late_blocks_read_accelerations_and_rates_read_them(run) -> None:
    """q[1]' = y, y^3 + y = 2 a, where a is the acceleration of an oscillator."""
    late = Block(0, lambda s: [s.y[0] ** 3 + s.y[0] - 2 * s.z[0]], late=True)
    model = Small(
        name="late", nq=2, nv=1, q_speed=[0, -1], start=([1.0, 0.0], [0.0], [0.0]), stop=3.0,
        blocks=[late], rates=lambda s: column(s.v[0], 0),
        late_rates=lambda s: column(s.v[0], s.y[0]), mass=lambda s: ca.SX(1),
        force=lambda s: -s.q[0], variables={"y": lambda s: s.y[0], "sum": lambda s: s.q[1]},
    )  # fmt: skip
    result = run(model, tolerance=1e-11)
    y = result["y"]
    assert np.allclose(y**3 + y, -2 * np.cos(result.time), rtol=0, atol=1e-9)
    from scipy.integrate import quad
    from scipy.optimize import brentq

    def at(t: float) -> float:
        return brentq(lambda x: x**3 + x + 2 * math.cos(t), -3, 3, xtol=1e-15)

    assert result["sum"][-1] == pytest.approx(quad(at, 0, 3, epsabs=1e-12)[0], abs=1e-9)


def test_noise_alone_does_not_stop_a_plain_state(run) -> None:
    """The derivative is a difference that cancels up to rounding."""
    model = Small(
        name="noise", nq=3, q_speed=[-1] * 3, start=([0.0, 5.1, 0.3],), stop=50.0,
        rates=lambda s: column(
            (s.q[1] * s.q[2] - 5.1 * ca.exp(-s.t) * s.q[2]) * 1e6, -s.q[1], s.q[1] * ca.cos(s.t)
        ),
        time_dependent=True, variables={"x": lambda s: s.q[0]},
    )  # fmt: skip
    result = run(model, tolerance=1e-6)
    assert result.figures.steps < 2000


@pytest.mark.parametrize("n", [60, 1500])
def test_a_front_runs_through_many_plain_states(run, n) -> None:
    """Heat in a bar of n cells whose ends are held at 1 and 0, against its matrix exponential."""
    k, stop = 400.0, 0.02
    edge = np.r_[k, np.zeros(n - 1)]

    def flow(s):
        x = ca.vertcat(1, s.q, 0)
        return k * (x[2:] - 2 * x[1:-1] + x[:-2])

    model = Small(
        name=f"bar{n}", nq=n, q_speed=[-1] * n, start=([0.0] * n,), rates=flow, stop=stop,
        variables={f"x{i}": lambda s, i=i: s.q[i] for i in (0, 5, 20, 40)},
    )  # fmt: skip
    result = run(model, tolerance=1e-10)
    i = np.arange(1, n + 1)
    rates = -4 * k * np.sin(i * np.pi / (2 * (n + 1))) ** 2
    modes = np.sin(np.outer(i, i) * np.pi / (n + 1)) * math.sqrt(2 / (n + 1))
    x = modes @ (np.expm1(rates * stop) / rates * (modes @ edge))
    for j in (0, 5, 20, 40):
        assert result[f"x{j}"][-1] == pytest.approx(x[j], rel=1e-7, abs=1e-12)
    assert result.figures.rejected < 60
