"""Outputs that read the power of friction are zero to the last bit while friction holds."""

import numpy as np

import frot

CARRIED = """planar model Carried
  body base: box(mass = 1 kg, size = (1, 1) m);
  body load: particle(mass = 1 kg);
  curve top on base: line(through = (0, 0) m, direction = (1, 0));
  liaison floor: contact_ponctuel(base.G, ground.line) with coulomb(0.1);
  liaison seat: contact_ponctuel(load, top) with coulomb(0.5);
  output Power held = seat.power;
  output Power lost = floor.power;
initial
  base.velocity.x = 1 m/s;
  load.velocity.x = 1 m/s;
  load.position = (0.1, 0) m;
  experiment(stop = 0.3 s);
end Carried;
"""
ROLLING = """planar model Rolling
  body wheel: disc(mass = 1 kg, radius = 0.3 m);
  liaison floor: contact_ponctuel(wheel.rim, ground.line)
    with coulomb(0.6), rolling_resistance(1 mm);
  output Power lost = floor.power;
initial
  wheel.velocity = (1, 0) m/s;
  floor.gap = 0 m;
  floor.slip = 0 m/s;
  experiment(stop = 0.3 s);
end Rolling;
"""


def test_power_of_friction_that_holds_is_zero_and_of_friction_that_slips_is_not() -> None:
    result = frot.compile(CARRIED).simulate()
    assert not np.any(result["held"])
    assert np.all(result["lost"] < -0.1 * 9.81)


def test_what_rolls_without_slip_loses_by_rolling() -> None:
    """The couple is delta*N, against the rotation: P = -delta*m*g*w."""
    result = frot.compile(ROLLING).simulate()
    lost = -1e-3 * 9.81 * np.abs(result["wheel.angular_velocity"])
    assert np.max(np.abs(result["lost"] - lost)) <= 1e-12
