"""A bicycle against the linear equations of J. P. Meijaard, J. M. Papadopoulos, A. Ruina and
A. L. Schwab (Proc. R. Soc. A 463, 2007, table 2), and what a wheel costs that runs straight."""

from __future__ import annotations

import functools
from pathlib import Path

import numpy as np
import pytest

import frot

MODEL = Path(__file__).parents[2] / "models" / "bicycle.frot"
MASS = np.array([[80.81722, 2.31941332208709], [2.31941332208709, 0.29784188199686]])
BY_GRAVITY = np.array([[-80.95, -2.59951685249872], [-2.59951685249872, -0.80329488458618]])
BY_SPEED = np.array([[0, 76.59734589573222], [0, 2.65431523794604]])
DAMPING = np.array([[0, 33.86641391492494], [-0.85035641456978, 1.68540397397560]])


@functools.cache
def bicycle() -> frot.Model:
    return frot.load(MODEL)


def modes(v: float) -> np.ndarray:
    """Eigenvalues of lean and steer at speed v."""
    stiffness = 9.81 * BY_GRAVITY + v**2 * BY_SPEED
    below = np.linalg.solve(MASS, np.hstack([-stiffness, -v * DAMPING]))
    return np.linalg.eigvals(np.vstack([np.eye(4)[2:], below]))


@pytest.mark.parametrize("v", [2.0, 5.0, 8.0])
@pytest.mark.parametrize("tipped", [1e-3, -1e-5])
def test_what_is_tipped_a_little_moves_as_the_linear_equations_say(v: float, tipped: float) -> None:
    """Capsize, weave and castering, growing or not; what is left is of the third order."""
    values = {"v": v, "tipped": tipped}
    result = bicycle().simulate(stop=1.2, tolerance=1e-11, parameters=values)
    times = np.linspace(0, 1.2, 121)
    shapes = np.exp(np.outer(times, modes(v)))
    for name in ("steer", "lean"):
        seen = result.at(times)[name]
        parts = np.linalg.lstsq(shapes, seen.astype(complex), rcond=None)[0]
        left = np.abs(shapes @ parts - seen).max() / np.abs(seen).max()
        assert left < 1e-8 + 100 * tipped**2


@pytest.mark.parametrize("tolerance", [1e-4, 1e-8, 1e-12])
def test_what_runs_straight_costs_little_more_than_what_wobbles(tolerance: float) -> None:
    """Stages lengthen quaternions: axes that followed that leaned the wheel, and steps were those
    of what had no size at all."""
    text = """
model Wheel
  parameter Angle heading = 0;
  parameter AngularVelocity wobble = 1 rad/s;
  body d: disc(mass = 2 kg, radius = 0.3 m);
  liaison c: roulement(ground.plane, d.rim);
initial
  d.position = (0, 0, 0.3) m;
  d.orientation = sqrt(0.5)*(cos(heading/2), -cos(heading/2), -sin(heading/2), sin(heading/2));
  d.angular_velocity.x = wobble*cos(heading) - 16 rad/s*sin(heading);
  d.angular_velocity.y = wobble*sin(heading) + 16 rad/s*cos(heading);
  d.angular_velocity.z = 0 rad/s;
  experiment(stop = 3 s);
end Wheel;
"""
    model = frot.compile(text)

    def steps(wobble: float, heading: float) -> int:
        values = {"wobble": wobble, "heading": heading}
        result = model.simulate(tolerance=tolerance, parameters=values)
        way = result["d.position.x"] * np.cos(heading) + result["d.position.y"] * np.sin(heading)
        if wobble == 0:
            assert way == pytest.approx(16 * 0.3 * result.time, abs=1e-11)
        return result.figures.steps

    wobbles = steps(1.0, 0.0)
    for heading in (0.0, 0.7, np.pi / 2, -2.0):
        assert steps(0.0, heading) < 2 * wobbles
        assert steps(1e-6, heading) < 3 * wobbles
