"""A slip in space turns to where Painlevé's coefficient is zero: the tangential impact there."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

import frot

Floats = NDArray[np.float64]
INERTIA = np.diag([1e-4, 1 / 12, 1 / 12])
END = np.array([-0.5, 0, 0])
ROD = """
    model Rod
      parameter Real mu = 2;
      parameter Mass m = 1 kg;
      parameter Angle turn = 0 rad;
      parameter Angle a = 1.2 rad;
      parameter AngularVelocity w = -1 rad/s;
      parameter AngularVelocity about = 0 rad/s;
      parameter Velocity along = 5 m/s;
      parameter Velocity across = 0 m/s;
      body r: solid(mass = m, inertia = (m*1e-4*1 m^2, m/12*1 m^2, m/12*1 m^2));
      frame start on r at (-0.5, 0, 0) m;
      surface floor on ground: plane(through = (0, 0, 0) m, normal = (0, 0, 1));
      liaison c: contact_ponctuel(floor, start) with coulomb(mu);
    initial
      start.position = (0, 0, 0) m;
      r.orientation = (cos(turn/2)*cos(a/2), sin(turn/2)*sin(a/2),
                       -cos(turn/2)*sin(a/2), sin(turn/2)*cos(a/2));
      r.angular_velocity = (-cos(turn)*about*sin(a) + sin(turn)*w,
                            -sin(turn)*about*sin(a) - cos(turn)*w, about*cos(a));
      start.velocity = (cos(turn)*along - sin(turn)*across,
                        sin(turn)*along + cos(turn)*across, 0 m/s);
      experiment(stop = 0.6 s, tolerance = 1e-9);
    end Rod;
    """


CASES = [
    # mu, a, w, about, along, across
    (3.0, 2.513801, -0.891656, 2.325971, 0.580899, -4.892548),
    (2.0, 2.108017, -0.835071, 0.795540, 0.068633, -0.697017),
    (3.0, 2.529214, 1.247199, 0.491865, 0.857559, 1.769831),
    (1.4, 1.197650, -2.774826, -3.232561, -3.602589, 3.331103),
    (2.0, 2.130139, -2.491896, -0.380496, 0.929995, 2.068242),
]


def turned(q: Floats) -> Floats:
    """The matrix of a unit quaternion."""
    w, x = q[0], q[1:]
    cross = np.array([[0, -x[2], x[1]], [x[2], 0, -x[0]], [-x[1], x[0], 0]])
    return np.eye(3) + 2 * w * cross + 2 * cross @ cross


def at_end(result: frot.Result, t: float, mass: float) -> tuple[Floats, Floats]:
    """The speed of the rod's end at t, and the matrix W of what impulses there do to it."""
    at = result.at(t)
    axes = turned(np.array([at[f"r.orientation[{i}]"] for i in (1, 2, 3, 4)], dtype=float))
    v, spin = (
        np.array([at[f"r.{n}.{c}"] for c in "xyz"], dtype=float)
        for n in ("velocity", "angular_velocity")
    )
    arm = axes @ END
    cross = np.array([[0, -arm[2], arm[1]], [arm[2], 0, -arm[0]], [-arm[1], arm[0], 0]])
    w = np.eye(3) - cross @ axes @ np.linalg.inv(INERTIA) @ axes.T @ cross
    return v + np.cross(spin, arm), w / mass


def impulse_of_compression(w: Floats, u: Floats, mu: float) -> float:
    """The normal impulse until the end of compression: u' = W (-mu s, 1), then without slip."""
    size = np.linalg.norm(u[:2])

    def rate(_: float, x: Floats) -> Floats:
        along = x[:2] / np.linalg.norm(x[:2])
        return w @ np.array([*(-mu * along), 1.0])

    def stops(_: float, x: Floats) -> float:
        return float(np.linalg.norm(x[:2]) - 1e-9 * size)

    def is_over(_: float, x: Floats) -> float:
        return float(x[2])

    for event in (stops, is_over):
        event.terminal = True  # type: ignore[attr-defined]
    is_over.direction = 1  # type: ignore[attr-defined]
    start = np.array([u[0], u[1], -1e-10 * size])
    longest = 100 * size / np.trace(w)
    found = solve_ivp(
        rate, (0, longest), start, "DOP853", events=(stops, is_over), rtol=1e-11, atol=1e-14 * size
    )
    assert found.status == 1
    if len(found.t_events[1]) > 0:
        return float(found.t[-1])
    held = -np.linalg.solve(w[:2, :2], w[:2, 2])
    assert np.linalg.norm(held) <= mu
    return float(found.t[-1] - found.y[2, -1] / (w[2, :2] @ held + w[2, 2]))


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize(("turn", "mass"), [(0, 1), (0.7, 1e6), (-2, 1e-6)])
def test_a_slip_turns_into_a_jam(
    case: tuple[float, float, float, float, float, float], turn: float, mass: float
) -> None:
    """The impulse is that of an integration from the state before, next to p = 0.

    The rod's reaction grows as (T - t)^(-1/2) before the jam at T, which has a finite impulse.
    """
    mu, *values = case
    names = ("a", "w", "about", "along", "across")
    given = dict(zip(names, values, strict=True), mu=mu, turn=turn, m=mass)
    result = frot.compile(ROD).simulate(parameters=given)
    jam = next(e for e in result.events if e.kind == "tangential_impact")
    speed, w = at_end(result, jam.time - 1e-13, mass)
    assert jam.impulse == pytest.approx(impulse_of_compression(w, speed, mu), rel=2e-5)
    assert jam.energy_lost > 0
    assert result.balance.relative < 1e-9
    after, _ = at_end(result, jam.time, mass)
    assert abs(after[2]) < 1e-12 * np.linalg.norm(speed)


def test_random_rods_go_on() -> None:
    """Rods of all postures, speeds and coefficients pass their jams: none ends by name."""
    rng = np.random.default_rng(7)
    rod = frot.compile(ROD)
    jams = 0
    for _ in range(60):
        given = {"mu": float(rng.choice([1.4, 2, 3])), "a": float(rng.uniform(0.3, 2.8))}
        for name, size in (("w", 2), ("about", 3), ("along", 3), ("across", 3)):
            given[name] = float(size * rng.normal())
        result = rod.simulate(parameters=given)
        jams += any(e.kind == "tangential_impact" for e in result.events)
        assert result.balance.relative < 1e-9
    assert jams >= 8
