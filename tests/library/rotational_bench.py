"""Parts of `Rotational`, each in a small machine of its own with a closed form."""

from __future__ import annotations

import numpy as np
from reference import Bench, Reference, Signal
from vibration import BetweenStops, Vibration

TEXT = """
model RotationalBench
  import Rotational.*;

  // a spring from a wall
  Fixed wall(angle = 0.2 rad);
  Spring spring(k = 2.9 N.m, rest = 0.3 rad);
  Inertia swing(J = 0.7 kg.m^2);
  AngleSensor angle_of_swing;

  // a damper on a wall
  Fixed post;
  Damper damper(c = 0.35 N.m.s);
  Inertia braked(J = 0.9 kg.m^2);
  SpeedSensor speed_of_braked;

  // both
  SpringDamper both(k = 5.3 N.m, c = 0.41 N.m.s, rest = -0.15 rad);
  Inertia damped(J = 1.3 kg.m^2);

  // a motor, a measuring shaft, a gear, a rotor
  TorqueSource motor;
  Inertia fast(J = 0.23 kg.m^2);
  TorqueSensor shaft;
  Gear gear(ratio = -3.7);
  Inertia slow(J = 4.1 kg.m^2);

  // a planetary gear whose three shafts are all loaded
  TorqueSource on_sun;
  TorqueSource on_ring;
  Planetary planetary(ratio = 2.6);
  Inertia sun(J = 0.3 kg.m^2);
  Inertia carrier(J = 1.7 kg.m^2);
  Inertia ring(J = 0.8 kg.m^2);

  // dry friction
  Brake brake(mu = 0.31, mu_s = 0.4, radius = 130 mm);
  Inertia wheel(J = 0.52 kg.m^2);
  Bearing bearing(sliding = 0.37 N.m, rest = 0.6 N.m);
  Inertia spinning(J = 0.44 kg.m^2);
  Clutch clutch(mu = 0.27, radius = 110 mm);
  Inertia driving(J = 0.6 kg.m^2);
  Inertia taken(J = 0.35 kg.m^2);

  // a rotor between elastic stops
  Stop stop(play = 0.2 rad, k = 60 N.m, c = 1.1 N.m.s);
  Fixed frame;
  Inertia pawl(J = 0.5 kg.m^2);
  Stop lower(play = 0.15 rad, k = 45 N.m, c = 0.8 N.m.s);
  Inertia returning(J = 0.4 kg.m^2);

  // prescribed motions
  SpeedSource turning;
  Spring soft(k = 1.9 N.m);
  Inertia led(J = 0.8 kg.m^2);
  AngleSource rocking;
  Inertia rocked(J = 1.2 kg.m^2);

initial
  swing.angle = 1.1 rad;    swing.speed = -0.4 rad/s;
  braked.angle = 0.3 rad;   braked.speed = 2.2 rad/s;
  damped.angle = 0.6 rad;   damped.speed = 0.7 rad/s;
  slow.angle = -0.1 rad;    slow.speed = 0.2 rad/s;
  sun.angle = 0.1 rad;      sun.speed = 0.9 rad/s;
  ring.angle = 0.25 rad;    ring.speed = -0.3 rad/s;
  wheel.angle = 0 rad;      wheel.speed = 3.1 rad/s;
  spinning.angle = 0 rad;   spinning.speed = -1.3 rad/s;
  driving.angle = 0.1 rad;  driving.speed = 4.2 rad/s;
  taken.angle = 0 rad;      taken.speed = -0.8 rad/s;
  pawl.angle = 0.05 rad;    pawl.speed = 0.3 rad/s;
  returning.angle = 0.02 rad; returning.speed = -0.2 rad/s;
  led.angle = 0.4 rad;      led.speed = 0.1 rad/s;
  turning.a.angle = -0.2 rad;

equation
  connect(wall.a, spring.a);   connect(spring.b, swing.a);   connect(swing.b, angle_of_swing.a);
  connect(post.a, damper.a);   connect(damper.b, braked.a);  connect(braked.b, speed_of_braked.a);
  connect(post.a, both.a);     connect(both.b, damped.a);

  motor.torque = 0.83 N.m + 0.4 N.m/s*time;
  connect(motor.a, fast.a);    connect(fast.b, shaft.a);     connect(shaft.b, gear.a);
  connect(gear.b, slow.a);

  on_sun.torque = 0.7 N.m;
  on_ring.torque = -0.2 N.m;
  connect(on_sun.a, sun.a);    connect(sun.b, planetary.sun);
  connect(on_ring.a, ring.a);  connect(ring.b, planetary.ring);
  connect(carrier.a, planetary.carrier);

  brake.force = 20 N + 5 N/s*time;
  clutch.force = 31 N;
  connect(brake.a, wheel.a);
  connect(bearing.a, spinning.a);
  connect(driving.b, clutch.a); connect(clutch.b, taken.a);

  connect(frame.a, stop.a);    connect(stop.b, pawl.a);
  connect(frame.a, lower.a);   connect(lower.b, returning.a);

  turning.speed = 0.6 rad/s*cos(1.7 rad/s*time);
  connect(turning.a, soft.a);  connect(soft.b, led.a);
  rocking.angle = 0.3*sin(2.1 rad/s*time);
  connect(rocking.a, rocked.a);

  experiment(stop = 2.4 s, tolerance = 1e-11);
end RotationalBench;
"""


# The couple of the motor turns the rotors as one inertia, that of the slow one over ratio^2.
RATIO = -3.7
REDUCED = 0.23 + 4.1 / RATIO**2


def fast_speed(t: Signal) -> Signal:
    return RATIO * 0.2 + (0.83 * t + 0.2 * t**2) / REDUCED


def shaft_couple(t: Signal) -> Signal:
    return 4.1 / RATIO**2 * (0.83 + 0.4 * t) / REDUCED


def planetary_accelerations() -> Signal:
    """Of sun and ring: Lagrange's equations in their angles; the carrier's is a mean of both."""
    share = np.array([1.0, 2.6]) / 3.6
    inertia = np.diag([0.3, 0.8]) + 1.7 * np.outer(share, share)
    return np.linalg.solve(inertia, np.array([0.7, -0.2]))


SUN, RING = planetary_accelerations()


def wheel_speed(t: Signal) -> Signal:
    """The couple mu r (20 + 5 t) takes the speed away, then holds."""
    lost = 0.31 * 0.130 * (20 * t + 2.5 * t**2) / 0.52
    return np.maximum(3.1 - lost, 0)


def spinning_angle(t: Signal) -> Signal:
    end = 1.3 * 0.44 / 0.37
    t = np.minimum(t, end)
    return -1.3 * t + 0.37 / 0.44 * t**2 / 2


COUPLE = 0.27 * 0.110 * 31
LOCKED = 5.0 / (COUPLE / 0.6 + COUPLE / 0.35)


def driving_speed(t: Signal) -> Signal:
    return 4.2 - COUPLE / 0.6 * np.minimum(t, LOCKED)


def taken_speed(t: Signal) -> Signal:
    return -0.8 + COUPLE / 0.35 * np.minimum(t, LOCKED)


def soft_couple_motion(t: Signal) -> Signal:
    """led.angle: J x'' = k (s - x) with s = -0.2 + 0.6/1.7 sin(1.7 t)."""
    own = np.sqrt(1.9 / 0.8)
    forced = 0.6 / 1.7 * own**2 / (own**2 - 1.7**2)
    return (
        -0.2
        + forced * np.sin(1.7 * t)
        + 0.6 * np.cos(own * t)
        + (0.1 - 1.7 * forced) / own * np.sin(own * t)
    )


SWING = Vibration(m=0.7, c=0, k=2.9, middle=0.5, x=1.1, v=-0.4)
DAMPED = Vibration(m=1.3, c=0.41, k=5.3, middle=-0.15, x=0.6, v=0.7)
PAWL = BetweenStops(m=0.5, c=1.1, k=60, play=0.2, x=0.05, v=0.3)
# The lower stop: the mirror image of a run towards the upper one.
RETURNING = BetweenStops(m=0.4, c=0.8, k=45, play=0.15, x=-0.02, v=0.2)

BENCH = Bench(
    "Rotational",
    TEXT,
    {
        "Fixed": (Reference("spring.angle", lambda t: SWING.x(t) - 0.2),),
        "Inertia": (Reference("swing.speed", SWING.v),),
        "Spring": (Reference("swing.angle", SWING.x),),
        "AngleSensor": (Reference("angle_of_swing.y", SWING.x),),
        "Damper": (
            Reference("braked.angle", lambda t: 0.3 - 2.2 * 0.9 / 0.35 * np.expm1(-0.35 / 0.9 * t)),
        ),
        "SpeedSensor": (Reference("speed_of_braked.y", lambda t: 2.2 * np.exp(-0.35 / 0.9 * t)),),
        "SpringDamper": (Reference("damped.angle", DAMPED.x),),
        "TorqueSource": (Reference("fast.speed", fast_speed),),
        "Gear": (Reference("slow.speed", lambda t: fast_speed(t) / RATIO),),
        "TorqueSensor": (Reference("shaft.y", shaft_couple),),
        "Planetary": (
            Reference("sun.speed", lambda t: 0.9 + SUN * t),
            Reference("ring.speed", lambda t: -0.3 + RING * t),
            Reference("carrier.speed", lambda t: (0.9 - 0.78 + (SUN + 2.6 * RING) * t) / 3.6),
        ),
        "Brake": (Reference("wheel.speed", wheel_speed),),
        "Bearing": (Reference("spinning.angle", spinning_angle),),
        "Clutch": (
            Reference("driving.speed", driving_speed),
            Reference("taken.speed", taken_speed),
        ),
        "Stop": (
            Reference("pawl.angle", PAWL.x),
            Reference("pawl.speed", PAWL.v),
            Reference("returning.angle", lambda t: -RETURNING.x(t)),
        ),
        "SpeedSource": (Reference("led.angle", soft_couple_motion),),
        "AngleSource": (
            Reference("rocked.a.torque", lambda t: -1.2 * 0.3 * 2.1**2 * np.sin(2.1 * t)),
        ),
    },
)
