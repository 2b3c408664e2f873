"""A box slides over the edge of another: on the corner there, round it and off, without a blow."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import frot

TEXT = """
planar model Edge
  parameter Real mu = 0;
  parameter Real foot = 1;
  parameter Velocity v = 3 m/s;
  parameter Length size = 1 m;
  body table: box(mass = 1 kg, size = (4*size, size));
  body load: box(mass = 1 kg, size = (size, size));
  liaison feet: appui_faces(table.bottom, ground.line) with coulomb(foot);
  liaison on: appui_faces(load.bottom, table.top) with coulomb(mu);
initial
  table.position = (0 m, size/2);
  load.position = (0 m, 1.5*size);
  load.velocity = (v, 0 m/s);
end Edge;
"""
G = 9.81


@pytest.fixture(scope="module")
def model() -> frot.Model:
    return frot.compile(TEXT)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9, 1e-12])
@pytest.mark.parametrize(
    ("v", "mu", "size"),
    [(3, 0, 1), (-3, 0, 1), (4.1, 0.1, 1), (-4.1, 0.1, 1), (3.3, 0.001, 1), (0.03, 0, 1e-4)],
)
def test_the_corner_takes_over_where_the_face_comes_to_it(
    model: frot.Model, v: float, mu: float, size: float, tolerance: float
) -> None:
    """The front is at the edge after 1.5 sizes; it tips where weight and friction pass there."""
    result = model.simulate(
        stop=2.2 * size / abs(v) / (1 - 2.2 * mu * G * size / v**2),
        tolerance=tolerance,
        parameters={"v": v, "mu": mu, "size": size},
    )

    def after(way: float) -> float:
        brake = mu * G
        return way / abs(v) if mu == 0 else (abs(v) - math.sqrt(v * v - 2 * brake * way)) / brake

    corner, front, rear = ("on[3]", "on[2]", "on[1]") if v > 0 else ("on[4]", "on[1]", "on[2]")
    kept = [(e.liaison, e.after) for e in result.events]
    assert sorted(kept[:2]) == sorted([(corner, "slip"), (front, "open")])
    assert kept[2] == (rear, "open")
    times = [e.time for e in result.events]
    near = 1e-9 * result.time[-1]
    assert times[:2] == pytest.approx([after(1.5 * size)] * 2, abs=near)
    assert times[2] == pytest.approx(after((2 - mu / 2) * size), abs=near)
    assert len(kept) == 3


def slides_off(v: float) -> tuple[float, float, float]:
    """When the rear corner comes to the edge, with angle and speed there, without friction.

    G = corner - s e1 + e2/2, so that (1/6 + s^2) a = s (g cos x - 2 s' w - w^2/2) and
    s'' = s w^2 + g sin x - a/2, for a box of 1 m and 1 kg.
    """

    def rates(_: float, z: np.ndarray) -> list[float]:
        x, s, w, along = z
        a = s * (G * np.cos(x) - 2 * along * w - w * w / 2) / (1 / 6 + s * s)
        return [w, along, a, s * w * w + G * np.sin(x) - a / 2]

    def rear(_: float, z: np.ndarray) -> float:
        return float(z[1] + 0.5)

    rear.terminal = True  # type: ignore[attr-defined]
    run = solve_ivp(rates, (0, 9), [0, 0, 0, -v], "DOP853", events=rear, rtol=1e-12, atol=1e-13)
    return 2 / v + run.t[-1], run.y[0, -1], run.y[2, -1]


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-7, 1e-9, 1e-12])
@pytest.mark.parametrize("v", [3, -3, 4.1, -2.2])
def test_what_slides_off_falls(model: frot.Model, v: float, tolerance: float) -> None:
    """The rear corner passes that of the table, beside which nothing is met."""
    at, angle, speed = slides_off(abs(v))
    result = model.simulate(stop=at + 0.3, tolerance=tolerance, parameters={"v": v})
    last, end, way = result.events[-1], result.at(at + 0.3), math.copysign(1, v)
    near = 3 * tolerance + 1e-10
    assert last.after == "open"
    assert last.time == pytest.approx(at, abs=near)
    assert end["load.angular_velocity"] == pytest.approx(way * speed, abs=near * abs(speed))
    assert end["load.angle"] == pytest.approx(way * (angle + 0.3 * speed), abs=near)
    assert end["load.acceleration.y"] == pytest.approx(-G, abs=1e-9)


STACK = """
planar model Stack
  parameter Length r = 0.1 m;
  parameter Real foot = 0;
  parameter Velocity v = 0.5 m/s;
  body low: box(mass = 50 g, size = (2*r, r));
  body middle: box(mass = 50 g, size = (2*r, r));
  body load: box(mass = 50 g, size = (2*r, r));
  liaison feet: appui_faces(low.bottom, ground.line) with coulomb(foot);
  liaison between: appui_faces(middle.bottom, low.top) with coulomb(0.1);
  liaison on: appui_faces(load.bottom, middle.top);
initial
  low.position = (0 m, r/2);
  middle.position = (0 m, 1.5*r);
  load.position = (0 m, 2.5*r);
  load.velocity = (v, 0 m/s);
end Stack;
"""


@pytest.fixture(scope="module")
def stack() -> frot.Model:
    return frot.compile(STACK)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-4, 7.7e-5, 1e-6, 1e-9, 1e-12])
@pytest.mark.parametrize(("v", "foot"), [(0.5, 0), (-0.5, 0), (0.4, 0.3), (0.7, 0.001)])
def test_what_sticks_below_does_not_creep(
    stack: frot.Model, v: float, foot: float, tolerance: float
) -> None:
    """Corners that rest on corners stay there while what tips above slides off."""
    result = stack.simulate(stop=0.7, tolerance=tolerance, parameters={"v": v, "foot": foot})
    apart = result["middle.position.x"] - result["low.position.x"]
    assert {e.liaison[:2] for e in result.events} <= {"on", "fe"}
    assert not result["on.normal_force"][-1]
    assert np.abs(apart).max() < 1e-14
    if foot == 0.3:
        assert np.abs(result["low.position.x"]).max() < 1e-15
