"""A body that spins in free flight about its axis, which rounding tilts: no step is lost to that.

The tilt makes speeds across the axis of the size of rounding, and these each other's rates. What
they are to the last digit is not followed.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

import frot

SPIN = 5.0


def text(first: float, second: float, scale: float, law: str) -> str:
    return f"""
model Spins
  body b: cylinder(mass = {3 * scale} kg, radius = 0.1 m, length = 0.4 m);
  liaison k: contact_ponctuel(b.side, ground.plane){law};
initial
  b.position = (0, 0, 0.3) m;
  b.angular_velocity = (0, {SPIN}, 0) rad/s;
  b.orientation = ({first!r}, {second!r}, 0, 0);
  experiment(stop = 0.15 s);
end Spins;
"""


@pytest.mark.parametrize("law", ["", " with coulomb(0.3)"])
@pytest.mark.parametrize("scale", [1.0, 1e6])
@pytest.mark.parametrize("tilt", [0.0, 1e-16, -1e-16, 3e-16, 1e-15, 1e-14, 1e-12])
def test_a_tilt_by_rounding_costs_no_steps(tilt: float, scale: float, law: str) -> None:
    half = math.sqrt(0.5)
    run = frot.compile(text(half + tilt, half - tilt, scale, law)).simulate()
    assert run.figures.steps < 120  # where each is as long as at first, 10^11 of them
    times = run.time
    assert np.abs(run["b.position.z"] - (0.3 - 0.5 * 9.81 * times**2)).max() < 1e-9
    assert np.abs(run["b.angular_velocity.y"] - SPIN).max() < 1e-9
    assert np.abs(run["b.angular_velocity.x"]).max() < 1e-10
    turned = SPIN * times[-1] / 2  # q = q_spin * q_0, about y
    assert run["b.orientation[1]"][-1] == pytest.approx(half * math.cos(turned), abs=1e-8)
    assert run["b.orientation[3]"][-1] == pytest.approx(half * math.sin(turned), abs=1e-8)
