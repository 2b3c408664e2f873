"""A guess is met by the least change, or missed the least, as a vector: whatever the axes."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

import frot

PLACED = """
planar model Placed "Guesses of what has fewer freedoms, and of what has more"
  parameter Angle th = 0 rad;
  parameter Real x = 0.4, y = 0.9;
  world(gravity = 0 m/s^2);
  frame base on ground rotated(angle = th);
  body bead: particle(mass = 2 kg);
  curve e on base: ellipse(a = 1.5 m, b = 0.7 m);
  liaison on_e: point_courbe(bead, e);
  body upper: rod(mass = 1 kg, length = 1 m);
  body lower: rod(mass = 2 kg, length = 0.8 m);
  liaison A: rotoide(base, upper.start);
  liaison B: rotoide(upper.tip, lower.start);
  output Length tip_x = dot(lower.tip.position, base.ex);
  output Length tip_y = dot(lower.tip.position, base.ey);
  body aside: rod(mass = 3 kg, length = 1 m);
  liaison C: rotoide(base, aside.start);
initial
  guess(bead.position = (x*base.ex + y*base.ey)*(1 m));
  guess(lower.tip.position = (2*x*base.ex + 2*y*base.ey)*(1 m));
  guess(aside.tip.position = (x*base.ex - y*base.ey)*(1 m));
  guess(aside.angle = th + 0.3);
  experiment(stop = 1e-9 s);
end Placed;
"""


@pytest.fixture(scope="module")
def placed() -> frot.Model:
    return frot.compile(PLACED)


def of(start: frot.Result, name: str, th: float) -> np.ndarray:
    """A place of the start along the axes of the base."""
    x, y = (float(start[f"{name}.{c}"]) for c in "xy")
    return np.array([np.cos(th) * x + np.sin(th) * y, -np.sin(th) * x + np.cos(th) * y])


@pytest.mark.parametrize("th", [0.0, 0.7, -2.0])
@pytest.mark.parametrize("given", [(0.4, 0.9), (-1.2, 0.3), (0.1, -0.2)])
def test_of_a_place_on_a_curve_the_nearest_is_taken(
    placed: frot.Model, th: float, given: tuple[float, float]
) -> None:
    """The least of (1.5 cos u - x)^2 + (0.7 sin u - y)^2 over the whole ellipse."""
    x, y = given
    start = placed.simulate(parameters={"th": th, "x": x, "y": y}).at(0)

    def far(u: float) -> float:
        return (1.5 * np.cos(u) - x) ** 2 + (0.7 * np.sin(u) - y) ** 2

    first = min(np.linspace(-np.pi, np.pi, 721), key=far)
    u = minimize_scalar(far, (first - 0.01, first + 0.01), tol=1e-12).x
    nearest = np.array([1.5 * np.cos(u), 0.7 * np.sin(u)])
    assert of(start, "bead.position", th) == pytest.approx(nearest, abs=1e-7)


@pytest.mark.parametrize("th", [0.0, 0.7, -2.0])
def test_what_cannot_be_reached_is_reached_for(placed: frot.Model, th: float) -> None:
    """An arm of 1.8 m, guessed to end 2 m and more away, is stretched out towards there."""
    start = placed.simulate(parameters={"th": th, "x": 0.8, "y": 0.9}).at(0)
    way = np.array([0.8, 0.9]) / np.hypot(0.8, 0.9)
    tip = [float(start[f"tip_{c}"]) for c in "xy"]
    assert tip == pytest.approx(1.8 * way, abs=1e-6)


def test_guesses_at_odds_share_by_the_mass_they_move(placed: frot.Model) -> None:
    """An angle f and a tip (cos f, sin f) that are at odds: both move 1 kg.m^2, a vector all of it.

    The least of (f - 0.3)^2 + |(cos f, sin f) - (x, -y)|^2.
    """
    x, y = 0.4, 0.9
    for th in (0.0, 0.7, -2.0):
        start = placed.simulate(parameters={"th": th, "x": x, "y": y}).at(0)

        def missed(f: float) -> float:
            return (f - 0.3) ** 2 + (np.cos(f) - x) ** 2 + (np.sin(f) + y) ** 2

        f = minimize_scalar(missed, (-0.6, -0.2), tol=1e-12).x
        assert float(start["aside.angle"]) - th == pytest.approx(f, abs=1e-7)


def many(count: int, far: float) -> str:
    """Beads on ellipses of their own, the last of which is guessed far away."""
    text = "planar model Many\n"
    for k in range(count):
        text += f"  body b{k}: particle(mass = 1 kg);\n"
        text += f"  curve e{k} on ground: ellipse(a = {1 + 0.1 * k} m, b = 0.5 m);\n"
        text += f"  liaison p{k}: point_courbe(b{k}, e{k});\n"
    text += "initial\n"
    for k in range(count):
        size = far if k == count - 1 else 1
        text += f"  guess(b{k}.position = ({0.3 * size + 0.1 * k}, {size}) m);\n"
    return text + "  experiment(stop = 1e-9 s);\nend Many;\n"


def test_what_nothing_binds_together_is_put_together_for_itself() -> None:
    """The same to the last bit whatever is guessed of another part."""
    near, far = (frot.compile(many(5, x)).simulate().at(0) for x in (1.0, 40.0))
    for k in range(4):
        for c in "xy":
            assert float(near[f"b{k}.position.{c}"]) == float(far[f"b{k}.position.{c}"])


def test_angles_guessed_many_turns_away_are_met_there() -> None:
    """Beside a place a million metres away, of a rod of a millimetre; and along a chain."""
    text = (
        "planar model A body a: rod(mass = 1 kg, length = 1 mm);"
        "body b: rod(mass = 1 kg, length = 1 m); body c: rod(mass = 1 kg, length = 1 m);"
        "liaison p: rotoide(ground, b.start); liaison q: rotoide(b.tip, c.start);"
        "initial guess(a.tip.position = (1e6, 2e5) m); guess(a.angle = 1e4 rad);"
        "guess(b.angle = -629.63 rad); guess(c.angle = 2e4 rad); end A;"
    )
    start = frot.compile(text).simulate(stop=1e-9).at(0)
    assert [start[f"{body}.angle"] for body in "abc"] == [1e4, -629.63, 2e4]
    assert start["a.position.x"] == pytest.approx(1e6 - 5e-4 * np.cos(1e4), rel=1e-15)
