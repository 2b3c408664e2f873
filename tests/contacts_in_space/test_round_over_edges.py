"""Balls and points on faces that end: over an edge, over a corner, round the end of a rod."""

from __future__ import annotations

import math
import textwrap

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

import frot

G = 9.81


def run(text: str, **values: object) -> frot.Result:
    return frot.compile(textwrap.dedent(text).format(**values)).simulate()


# A box whose axes are turned by `turn` about a skew axis, gravity against its own z axis.
BALL = """
    model Ball
      parameter Length r = {radius} m;
      world(gravity = 9.81 m/s^2, down = ({down}));
      frame f on ground at (1, 2, 3) m rotated(axis = (1, 2, 3), angle = {turn});
      body t: box(mass = 2 kg, size = (2, 1, 0.2) m);
      body b: {body};
      liaison w: encastrement(f, t);
      liaison c: contact_ponctuel({places}){law};
    initial
      b.position = t.top.position + {x} m*f.ex + {y} m*f.ey + r*f.ez;
      b.velocity = {vx} m/s*f.ex + {vy} m/s*f.ey;
      {spin}
      experiment(stop = {stop} s, tolerance = 1e-11);
    end Ball;
    """


def turned(angle: float) -> np.ndarray:
    """The axes of the frame f as columns (Rodrigues)."""
    n = np.array([1.0, 2.0, 3.0]) / math.sqrt(14)
    skew = np.array([[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]])
    return np.eye(3) + math.sin(angle) * skew + (1 - math.cos(angle)) * skew @ skew


def down(angle: float) -> str:
    return ", ".join(repr(float(-x)) for x in turned(angle)[:, 2])


def ball(turn: float, **values: object) -> frot.Result:
    given: dict[str, object] = {
        "body": f"sphere(mass = {values.pop('mass', 1)} kg, radius = r)",
        "places": "b.surface, t.top",
    }
    given |= {"turn": turn, "down": down(turn), "law": "", "spin": "", "stop": 1} | values
    return run(BALL, **given)


@pytest.mark.parametrize(
    ("turn", "mass", "radius", "speed", "places"),
    [
        (0, 1, 0.1, 0.5, "b.surface, t.top"),
        (0.8, 1e6, 0.2, -0.4, "b.surface, t.top"),
        (2.0, 1e-6, 0.05, 0.2, "t.top, b.surface"),
    ],
)
def test_a_smooth_ball_slides_round_an_edge_and_leaves_it(
    turn: float, mass: float, radius: float, speed: float, places: str
) -> None:
    """It leaves where g cos(a) = v^2/r with v^2 = v0^2 + 2 g r (1 - cos(a))."""
    result = ball(turn, mass=mass, radius=radius, x=math.copysign(0.9, speed), y=0.1, vx=speed,
                  vy=0, places=places)  # fmt: skip
    (leaving,) = result.events
    assert leaving.kind == "separation"
    square = speed**2
    angle = math.acos((2 + square / (G * radius)) / 3)
    way, _ = quad(
        lambda a: radius / math.sqrt(square + 2 * G * radius * (1 - math.cos(a))), 0, angle,
        epsabs=1e-13, epsrel=1e-13,
    )  # fmt: skip
    assert leaving.time == pytest.approx(0.1 / abs(speed) + way, abs=1e-10)
    there = np.array([result.at(leaving.time)[f"b.position.{k}"] for k in "xyz"])
    local = turned(turn).T @ (there - [1, 2, 3])
    side = math.copysign(1, speed)
    expected = [side * (1 + radius * math.sin(angle)), 0.1, 0.1 + radius * math.cos(angle)]
    assert local == pytest.approx(expected, abs=1e-9)


def test_a_ball_slides_over_a_corner_as_round_a_point() -> None:
    """Beyond both edges it turns about the corner, a spherical pendulum: integrated apart."""
    radius, v = 0.1, 0.5
    result = ball(0.6, radius=radius, x=0.7, y=0.2, vx=v, vy=v)
    (leaving,) = result.events

    def rates(_: float, z: np.ndarray) -> np.ndarray:
        """A mass point on a sphere about the corner: x'' = -g + n (g . n - v^2/r)."""
        n, w = z[:3] / radius, z[3:]
        fall = np.array([0, 0, -G])
        return np.concatenate([w, fall - (fall @ n + w @ w / radius) * n])

    def pressure(_: float, z: np.ndarray) -> float:
        return float(G * z[2] / radius - z[3:] @ z[3:] / radius)

    pressure.terminal = True  # type: ignore[attr-defined]
    start = np.array([0, 0, radius, v, v, 0])
    found = solve_ivp(rates, (0, 1), start, "DOP853", events=pressure, rtol=1e-12, atol=1e-14)
    assert leaving.time == pytest.approx(0.6 + found.t[-1], abs=1e-9)
    there = np.array([result.at(leaving.time)[f"b.position.{k}"] for k in "xyz"])
    local = turned(0.6).T @ (there - [1, 2, 3]) - [1, 0.5, 0.1]
    assert local == pytest.approx(found.y[:3, -1], abs=1e-8)


@pytest.mark.parametrize(("mu", "speed", "turn"), [(0.5, 0.5, 0.0), (0.3, 0.3, 1.1)])
def test_a_rough_ball_rolls_round_an_edge_until_it_slips(
    mu: float, speed: float, turn: float
) -> None:
    """Rolling, v^2 = v0^2 + 10/7 g r (1 - cos a), T = 2/7 m g sin a, N = m (g cos a - v^2/r)."""
    radius = 0.1
    result = ball(turn, radius=radius, x=0.9, y=0.1, vx=speed, vy=0, law=f" with coulomb({mu})",
                  spin=f"b.angular_velocity = {speed / radius} 1/s*f.ey;")  # fmt: skip

    def square(a: float) -> float:
        return speed**2 + 10 / 7 * G * radius * (1 - math.cos(a))

    def missing(a: float) -> float:
        return 2 / 7 * G * math.sin(a) - mu * (G * math.cos(a) - square(a) / radius)

    slips, leaves = result.events
    angle = brentq(missing, 0.01, 1, xtol=1e-14)
    way, _ = quad(lambda a: radius / math.sqrt(square(a)), 0, angle, epsabs=1e-13, epsrel=1e-13)
    assert (slips.before, slips.after, leaves.after) == ("stick", "slip", "open")
    assert slips.time == pytest.approx(0.1 / speed + way, abs=1e-9)


@pytest.mark.parametrize(("vx", "vy"), [(0.5, 0.0), (-0.4, 0.3), (0.1, -0.6)])
def test_a_point_falls_off_where_the_face_ends(vx: float, vy: float) -> None:
    result = ball(0.7, body="particle(mass = 1 kg)", places="b, t.top", radius=0, x=0.8, y=0.1,
                  vx=vx, vy=vy, stop=5)  # fmt: skip
    (leaving,) = result.events
    ways = [((1 if v > 0 else -1) * half - at) / v
            for at, half, v in ((0.8, 1, vx), (0.1, 0.5, vy)) if v != 0]  # fmt: skip
    assert leaving.time == pytest.approx(min(ways), abs=1e-11)
    fall = 5 - leaving.time
    there = turned(0.7).T @ (np.array([result[f"b.position.{k}"][-1] for k in "xyz"]) - [1, 2, 3])
    expected = [0.8 + 5 * vx, 0.1 + 5 * vy, 0.1 - G * fall**2 / 2]
    assert there == pytest.approx(expected, abs=1e-8)


ROUND_A_ROD = """
    model Round
      body t: {body};
      frame f on ground at (0, 0, 0) m rotated(axis = y, angle = {angle});
      liaison w: encastrement(f, t);
      body b: sphere(mass = 3 kg, radius = 0.2 m);
      liaison c: contact_ponctuel({place}, b.surface);
    initial
      b.position = (0.8, 0, {height}) m;
      b.velocity = (1, 0, 0) m/s;
      experiment(stop = 1 s, tolerance = 1e-11);
    end Round;
    """


@pytest.mark.parametrize(
    ("body", "angle", "place", "height"),
    [
        ("rod(mass = 1 kg, length = 2 m)", "0", "t.axis", 0.2),
        ("cylinder(mass = 1 kg, radius = 0.1 m, length = 2 m)", "pi/2", "t.side", 0.3),
    ],
)
def test_a_ball_slides_round_the_end_of_a_rod_and_of_a_tube(
    body: str, angle: str, place: str, height: float
) -> None:
    """As over an edge: the end of a rod is a point, that of a tube a circle."""
    result = run(ROUND_A_ROD, body=body, angle=angle, place=place, height=height)
    (leaving,) = result.events
    radius = 0.2
    turn = math.acos((2 + 1 / (G * radius)) / 3)
    way, _ = quad(
        lambda a: radius / math.sqrt(1 + 2 * G * radius * (1 - math.cos(a))), 0, turn,
        epsabs=1e-13, epsrel=1e-13,
    )  # fmt: skip
    assert leaving.time == pytest.approx(0.2 + way, abs=1e-10)
    there = result.at(leaving.time)
    assert there["b.position.x"] == pytest.approx(1 + radius * math.sin(turn), abs=1e-9)
