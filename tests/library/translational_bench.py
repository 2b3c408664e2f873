"""Parts of `Translational`, each in a small machine of its own with a closed form."""

from __future__ import annotations

import numpy as np
from reference import Bench, Reference, Signal
from vibration import BetweenStops, Vibration

TEXT = """
model TranslationalBench
  import Translational.*;
  import Rotational;

  // a spring from a wall
  Fixed wall(displacement = -0.1 m);
  Spring spring(k = 3.7 N/m, length = 0.4 m);
  Mass swing(m = 0.9 kg);
  PositionSensor place_of_swing;

  // a damper on a wall
  Fixed post;
  Damper damper(c = 0.55 N.s/m);
  Mass braked(m = 1.4 kg);
  SpeedSensor speed_of_braked;

  // both
  SpringDamper both(k = 7.1 N/m, c = 0.63 N.s/m, length = 0.25 m);
  Mass damped(m = 0.85 kg);

  // a motor, a pinion, a rack, a measuring rod, a load
  Rotational.TorqueSource motor;
  Rotational.Inertia pinion(J = 0.021 kg.m^2);
  RackAndPinion rack(radius = 85 mm);
  ForceSensor rod;
  Mass load(m = 2.3 kg);

  // dry friction
  ForceSource push;
  Slide slide(mu = 0.23, mu_s = 0.3);
  Mass under(m = 2.9 kg);
  Mass upon(m = 1.1 kg);
  Support support(sliding = 0.8 N, rest = 1.2 N);
  Mass crate(m = 0.75 kg);

  // a mass between elastic stops
  Stop stop(play = 150 mm, k = 90 N/m, c = 1.7 N.s/m);
  Fixed frame;
  Mass shuttle(m = 0.65 kg);
  Stop upper(play = 120 mm, k = 70 N/m, c = 1.3 N.s/m);
  Mass forward(m = 0.55 kg);

  // prescribed motions
  SpeedSource moving;
  Damper soft(c = 1.9 N.s/m);
  Mass led(m = 0.8 kg);
  PositionSource rocking;
  Mass rocked(m = 1.2 kg);

initial
  swing.position = 0.7 m;    swing.speed = 0.5 m/s;
  braked.position = 0.2 m;   braked.speed = -1.7 m/s;
  damped.position = -0.3 m;  damped.speed = 0.9 m/s;
  load.position = 0.1 m;     load.speed = -0.2 m/s;
  under.position = 0 m;      under.speed = 1.9 m/s;
  upon.position = 0.1 m;     upon.speed = -0.4 m/s;
  crate.position = 0.3 m;    crate.speed = 1.4 m/s;
  shuttle.position = 0.02 m; shuttle.speed = -0.3 m/s;
  forward.position = 0.01 m; forward.speed = 0.2 m/s;
  led.position = 0.1 m;      led.speed = 0.35 m/s;
  moving.a.displacement = 0.6 m;

equation
  connect(wall.a, spring.a);   connect(spring.b, swing.a);   connect(swing.b, place_of_swing.a);
  connect(post.a, damper.a);   connect(damper.b, braked.a);  connect(braked.b, speed_of_braked.a);
  connect(post.a, both.a);     connect(both.b, damped.a);

  motor.torque = 0.19 N.m + 0.3 N.m/s*time;
  connect(motor.a, pinion.a);  connect(pinion.b, rack.a);    connect(rack.b, rod.a);
  connect(rod.b, load.a);

  push.force = 0.9 N;
  slide.normal_force = 17 N;
  connect(push.a, under.a);    connect(under.b, slide.a);    connect(slide.b, upon.a);
  connect(support.a, crate.a);

  connect(frame.a, stop.a);    connect(stop.b, shuttle.a);
  connect(frame.a, upper.a);   connect(upper.b, forward.a);

  moving.speed = 0.6 m/s*cos(1.7 rad/s*time);
  connect(moving.a, soft.a);   connect(soft.b, led.a);
  rocking.displacement = 0.3 m*sin(2.1 rad/s*time);
  connect(rocking.a, rocked.a);

  experiment(stop = 2 s, tolerance = 1e-11);
end TranslationalBench;
"""

REDUCED = 2.3 + 0.021 / 0.085**2
FRICTION = 0.23 * 17
LOCKED = 2.3 / (FRICTION / 1.1 + (FRICTION - 0.9) / 2.9)


def load_speed(t: Signal) -> Signal:
    return -0.2 + (0.19 * t + 0.15 * t**2) / (0.085 * REDUCED)


def rod_force(t: Signal) -> Signal:
    return 2.3 * (0.19 + 0.3 * t) / (0.085 * REDUCED)


def under_speed(t: Signal) -> Signal:
    """Braked by the friction, pushed by 0.9 N; then both masses go on together."""
    slipping = np.minimum(t, LOCKED)
    return 1.9 + (0.9 - FRICTION) / 2.9 * slipping + 0.9 / 4.0 * (t - slipping)


def upon_speed(t: Signal) -> Signal:
    slipping = np.minimum(t, LOCKED)
    return -0.4 + FRICTION / 1.1 * slipping + 0.9 / 4.0 * (t - slipping)


def crate_position(t: Signal) -> Signal:
    t = np.minimum(t, 1.4 * 0.75 / 0.8)
    return 0.3 + 1.4 * t - 0.8 / 0.75 * t**2 / 2


def led_speed(t: Signal) -> Signal:
    """m v' = c (0.6 cos(w t) - v): the mean of the forced course and what dies away."""
    rate, w = 1.9 / 0.8, 1.7
    forced = 0.6 * rate / (rate**2 + w**2)
    return forced * (rate * np.cos(w * t) + w * np.sin(w * t)) + (0.35 - forced * rate) * np.exp(
        -rate * t
    )


SWING = Vibration(m=0.9, c=0, k=3.7, middle=0.3, x=0.7, v=0.5)
DAMPED = Vibration(m=0.85, c=0.63, k=7.1, middle=0.25, x=-0.3, v=0.9)
# The lower stop: the mirror image of a run towards the upper one.
SHUTTLE = BetweenStops(m=0.65, c=1.7, k=90, play=0.15, x=-0.02, v=0.3)
FORWARD = BetweenStops(m=0.55, c=1.3, k=70, play=0.12, x=0.01, v=0.2)

BENCH = Bench(
    "Translational",
    TEXT,
    {
        "Fixed": (Reference("spring.distance", lambda t: SWING.x(t) + 0.1),),
        "Mass": (Reference("swing.speed", SWING.v),),
        "Spring": (Reference("swing.position", SWING.x),),
        "PositionSensor": (Reference("place_of_swing.y", SWING.x),),
        "Damper": (
            Reference(
                "braked.position", lambda t: 0.2 + 1.7 * 1.4 / 0.55 * np.expm1(-0.55 / 1.4 * t)
            ),
        ),
        "SpeedSensor": (Reference("speed_of_braked.y", lambda t: -1.7 * np.exp(-0.55 / 1.4 * t)),),
        "SpringDamper": (Reference("damped.position", DAMPED.x),),
        "RackAndPinion": (
            Reference("load.speed", load_speed),
            Reference("pinion.speed", lambda t: load_speed(t) / 0.085, bound=1e-7),
        ),
        "ForceSensor": (Reference("rod.y", rod_force),),
        "ForceSource": (Reference("under.speed", under_speed),),
        "Slide": (Reference("upon.speed", upon_speed),),
        "Support": (Reference("crate.position", crate_position),),
        "Stop": (
            Reference("shuttle.position", lambda t: -SHUTTLE.x(t)),
            Reference("shuttle.speed", lambda t: -SHUTTLE.v(t)),
            Reference("forward.position", FORWARD.x),
        ),
        "SpeedSource": (
            Reference("moving.a.displacement", lambda t: 0.6 + 0.6 / 1.7 * np.sin(1.7 * t)),
            Reference("led.speed", led_speed),
        ),
        "PositionSource": (
            Reference("rocked.a.force", lambda t: -1.2 * 0.3 * 2.1**2 * np.sin(2.1 * t)),
        ),
    },
)
