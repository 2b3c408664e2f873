"""Boxes that corners keep on a plane: what the corners hold is rounding, and bounds no step."""

from __future__ import annotations

import functools

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding

THREE = "\n".join(
    f"  liaison f{k}: contact_ponctuel(b.corners[{k}], slope, unilateral = false);"
    for k in (1, 2, 3)
)
FOUR = "  liaison feet: appui_faces(b.bottom, slope, unilateral = false);"


@functools.cache
def box(feet: str, push: str) -> frot.Model:
    """A box of side `a` on a plane that is turned about y by `tilt` and about x by `roll`."""
    return frot.compile(f"""
model Corners
  parameter Angle tilt = 0;
  parameter Angle roll = 0;
  parameter Angle yaw = 0;
  parameter Mass mass = 1 kg;
  parameter Length a = 0.1 m;
  frame first on ground rotated(axis = y, angle = tilt);
  frame way on first rotated(axis = x, angle = roll);
  frame turned on way rotated(axis = z, angle = yaw);
  surface slope on way: plane(through = (0, 0, 0) m, normal = (0, 0, 1));
  body b: box(mass = mass, size = (a, a, 0.2*a));
{feet}
  force f: on(b.top, value = mass*({push})*way.ex);
  force lift: on(b.G, value = mass*(9.81 m/s^2)*(0, 0, 1));
initial
  b.position = 0.1*a*way.ez;
  b.orientation = turned.orientation;
  experiment(stop = 1 s);
end Corners;""")


def along(result: frot.Result, tilt: float) -> np.ndarray:
    """The way along the first axis of the plane."""
    x, z = result["b.position.x"], result["b.position.z"]
    way = x * np.cos(tilt) - z * np.sin(tilt)
    return np.asarray(way - way[0])


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9, 1e-12])
@pytest.mark.parametrize("feet", [THREE, FOUR], ids=["three", "four"])
@pytest.mark.parametrize(("tilt", "roll"), [(0.0, 0.0), (0.3, 0.0), (-1.0, 0.4)])
def test_a_box_slides_on_its_corners_at_any_yaw(
    feet: str, tilt: float, roll: float, tolerance: float
) -> None:
    """x(t) = 0.625 (1 - cos 2t) along the plane, in some dozens of steps, whether the corners say
    more than they need or not."""
    model = box(feet, "2.5 m/s^2*cos(2*time/(1 s))")
    for yaw in np.radians(np.arange(0, 360, 10)):
        values = {"tilt": tilt, "roll": roll, "yaw": float(yaw)}
        result = model.simulate(parameters=values, tolerance=tolerance)
        assert result.figures.steps < 100
        exact = 0.625 * (1 - np.cos(2 * result.time))
        assert np.abs(along(result, tilt) - exact).max() < 20 * tolerance + 1e-12


@pytest.mark.parametrize("tolerance", [1e-4, 1e-8, 1e-12])
@pytest.mark.parametrize("feet", [THREE, FOUR], ids=["three", "four"])
@pytest.mark.parametrize(("mass", "a"), [(1e6, 0.1), (1e-6, 0.1), (1.0, 1e-3), (1.0, 100.0)])
def test_a_constant_force_moves_boxes_of_any_size(
    feet: str, mass: float, a: float, tolerance: float
) -> None:
    """x(1 s) = 0.5 m."""
    model = box(feet, "1 m/s^2")
    for tilt in (0.0, 0.6):
        for yaw in (0.0, 0.6, 1.1, 2.5):
            values = {"tilt": tilt, "yaw": yaw, "mass": mass, "a": a}
            result = model.simulate(parameters=values, tolerance=tolerance)
            assert result.figures.steps < 150
            assert abs(along(result, tilt)[-1] - 0.5) < 20 * tolerance + 1e-12 * max(1, a)
