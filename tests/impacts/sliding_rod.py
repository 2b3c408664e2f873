"""A slender rod that slides on its lower end: which parts, is pressed, or jams by its friction."""

from __future__ import annotations

import functools

import frot


@functools.cache
def rod(options: str) -> frot.Model:
    """The rod with further options of its experiment; `side` = -1: its mirror image."""
    return frot.compile(f"""
planar model Rod
  parameter Real mu = 2;
  parameter Angle start = 40 deg;
  parameter AngularVelocity rate = 4 rad/s;
  parameter Velocity slip = -1 m/s;
  parameter Mass m = 1 kg;
  parameter Length l = 2 m;
  parameter Real side = 1;
  body rod: rod(mass = m, length = l);
  liaison tip: contact_ponctuel(ground.line, rod.start) with coulomb(mu);
initial
  rod.start.position = (0, 0) m;
  rod.start.velocity = (side*slip, 0 m/s);
  rod.angle = (1 - side)/2*pi*(1 rad) + side*start;
  rod.angular_velocity = side*rate;
  experiment(stop = 0.2 s, {options});
end Rod;
""")
