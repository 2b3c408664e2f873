"""A place of contact that becomes undetermined ends the run there, before any penetration."""

from __future__ import annotations

import math

import numpy as np
import pytest
from frot.runtime.run import SimulationError

import frot

# A ring of radius R leans over in the valley of z = x^2/(2 rho) - y^2/(2 sigma), its plane along x.
SADDLE = """
model Saddle
  parameter Angle lean = 0.3;
  parameter Length rho = 0.5 m;
  parameter Length sigma = 0.5 m;
  parameter Length R = 0.3 m;
  parameter Mass m = 1 kg;
  parameter Angle tilt = 0;
  world(gravity = 9.81 m/s^2, down = (-sin(tilt), 0, -cos(tilt)));
  frame f on ground at (0, 0, 0) m rotated(axis = y, angle = tilt);
  frame g on f at (0, 0, 0) m rotated(axis = x, angle = 90 deg - lean);
  body b: ring(mass = m, radius = R);
  surface s on f: implicit(z - x^2/(2*rho) + y^2/(2*sigma));
  liaison c: contact_ponctuel(s, b.rim) {law};
initial
  guess(b.position = R*sin(lean)*f.ey + R*cos(lean)*f.ez);
  b.orientation = g.orientation;
  c.gap = 0 m;
  dot(b.position, f.ex) = 0 m;
  dot(b.position, f.ey) = 0 m;
  experiment(stop = 1 s, tolerance = 1e-10);
end Saddle;
"""


def axes(result: frot.Result, k: int) -> np.ndarray:
    w, x, y, z = (float(result[f"b.orientation.{c}"][k]) for c in "wxyz")
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + 2 * w * skew + 2 * skew @ skew


def ended(text: str, **given: object) -> frot.Result:
    with pytest.raises(SimulationError, match=r"E0911.*liaison 'c'.*bend alike") as caught:
        frot.compile(text).simulate(parameters=given)
    result = caught.value.result
    assert result is not None
    return result


@pytest.mark.parametrize("law", ["", "with coulomb(0.3)"])
@pytest.mark.parametrize(
    ("lean", "rho", "mass", "tilt"), [(0.3, 0.5, 1, 0), (0.2, 0.6, 1e6, 0.7), (-0.3, 0.4, 1e-3, 2)]
)
def test_a_ring_leans_over_on_a_saddle_until_it_bends_as_that(
    law: str, lean: float, rho: float, mass: float, tilt: float
) -> None:
    """F = z - x^2/2 rho + y^2/2 sigma along the rim has the bend R grad F . c - R^2/rho.

    c is the direction from the place to the centre. Beyond grad F . c = R/rho the rim is inside.
    """
    given = {"lean": lean, "rho": f"{rho} m", "m": f"{mass} kg", "tilt": tilt}
    result = ended(SADDLE.format(law=law), **given)
    turn = np.array([[math.cos(tilt), 0, math.sin(tilt)], [0, 1, 0],
                     [-math.sin(tilt), 0, math.cos(tilt)]])  # fmt: skip
    around = np.linspace(0, 2 * math.pi, 2001)
    for k in (0, len(result.time) // 2, -1):
        own = turn.T @ axes(result, k)
        centre = turn.T @ np.array([float(result[f"b.position.{c}"][k]) for c in "xyz"])
        rim = centre + 0.3 * (np.outer(np.cos(around), own[:, 0])
                              + np.outer(np.sin(around), own[:, 1]))  # fmt: skip
        gaps = rim[:, 2] - rim[:, 0] ** 2 / (2 * rho) + rim[:, 1] ** 2
        assert gaps.min() > -1e-9
    lowest = rim[gaps.argmin()]
    slope = np.array([0, lowest[1] / 0.5, 1])
    assert slope @ (centre - lowest) == pytest.approx(0.3**2 / rho, abs=2e-4)
