"""Continuous parts of `Blocks`, each behind a signal whose answer has a closed form."""

from __future__ import annotations

import math

import numpy as np
from reference import Bench, Reference, Signal

TEXT = """
model BlocksBench
  import Blocks.*;

  Constant level(value = 1.37);
  Step step(height = 2.3, start = 0.41 s, offset = -0.6);
  Ramp ramp(height = -1.9, duration = 0.83 s, start = 0.29 s, offset = 0.7);
  Sine sine(amplitude = 1.6, frequency = 0.55 Hz, phase = 0.4 rad, offset = 0.21);

  Gain gain(k = -2.4);
  Sum sum(k1 = 0.8, k2 = -1.3);
  Feedback feedback;
  Limiter limiter(y_min = -0.9, y_max = 1.1);
  Table table(n = 4, x = (-1.2, -0.3, 0.4, 1.5), values = (0.7, -0.2, 0.9, 0.35));

  Integrator integrator(k = 1.45);
  FirstOrder lag(k = 1.8, T = 0.37 s);
  SecondOrder swing(k = 0.9, w = 5.2 rad/s, D = 0.23);
  Derivative rate(k = 0.8 s, T = 0.11 s);
  PI pi_block(k = 1.7, T = 0.6 s);
  LimitedPI limited(k = 1.25, T = 0.8 s, tracking = 0.5 s, y_min = -2, y_max = 1.6);
  Constant pushing(value = 0.9);

initial
  integrator.y = 0.35;
  lag.y = -0.4;
  swing.y = 0.15;
  swing.rate = -0.7 1/s;
  rate.filtered = 0.25;
  pi_block.integral = -0.33;
  limited.integral = -0.5;

equation
  connect(sine.y, gain.u);
  connect(sine.y, sum.u1);       connect(ramp.y, sum.u2);
  connect(sine.y, feedback.u1);  connect(level.y, feedback.u2);
  connect(sine.y, limiter.u);    connect(sine.y, table.u);
  connect(sine.y, integrator.u); connect(sine.y, pi_block.u);
  connect(level.y, lag.u);       connect(level.y, swing.u);
  rate.u = 1.1*time/(1 s);
  connect(pushing.y, limited.u);

  experiment(stop = 2.2 s, tolerance = 1e-11);
end BlocksBench;
"""

OMEGA = 2 * math.pi * 0.55


def ramp(t: Signal) -> Signal:
    return 0.7 - 1.9 * np.clip((t - 0.29) / 0.83, 0, 1)


def sine(t: Signal) -> Signal:
    return 0.21 + 1.6 * np.sin(OMEGA * t + 0.4)


def sine_integral(t: Signal) -> Signal:
    return 0.21 * t + 1.6 / OMEGA * (math.cos(0.4) - np.cos(OMEGA * t + 0.4))


def swing(t: Signal) -> Signal:
    """The step answer of a damped oscillation, from 0.15 with the rate -0.7."""
    end, decay = 0.9 * 1.37, 0.23 * 5.2
    own = 5.2 * math.sqrt(1 - 0.23**2)
    start = 0.15 - end
    wave = start * np.cos(own * t) + (-0.7 + decay * start) / own * np.sin(own * t)
    return end + np.exp(-decay * t) * wave


def derivative(t: Signal) -> Signal:
    """The filter follows the slope 1.1 with a lag; what remains of its first value dies away."""
    behind = 1.1 * 0.11 + (-0.25 - 1.1 * 0.11) * np.exp(-t / 0.11)
    return 0.8 / 0.11 * behind


# The output meets its bound 1.6 while the integral rises; from there on it unwinds to a lag.
FULL = 0.8 / 0.9 * (1.6 / 1.25 - 0.9 + 0.5)


def limited_integral(t: Signal) -> Signal:
    """I' = u/T + (1.6/k - u - I)/tracking behind the instant FULL."""
    at_full = 1.6 / 1.25 - 0.9
    end = at_full + 0.9 * 0.5 / 0.8
    after = end + (at_full - end) * np.exp(-(t - FULL) / 0.5)
    return np.where(t < FULL, -0.5 + 0.9 / 0.8 * t, after)


def limited(t: Signal) -> Signal:
    return np.minimum(1.25 * (0.9 + limited_integral(t)), 1.6)


BENCH = Bench(
    "Blocks",
    TEXT,
    {
        "Constant": (Reference("level.y", lambda t: 1.37, bound=1e-15),),
        "Step": (Reference("step.y", lambda t: -0.6 + 2.3 * (t >= 0.41), jumps=(0.41,)),),
        "Ramp": (Reference("ramp.y", ramp),),
        "Sine": (Reference("sine.y", sine),),
        "Gain": (Reference("gain.y", lambda t: -2.4 * sine(t)),),
        "Sum": (Reference("sum.y", lambda t: 0.8 * sine(t) - 1.3 * ramp(t)),),
        "Feedback": (Reference("feedback.y", lambda t: sine(t) - 1.37),),
        "Limiter": (Reference("limiter.y", lambda t: np.clip(sine(t), -0.9, 1.1)),),
        "Table": (
            Reference(
                "table.y",
                lambda t: np.interp(sine(t), (-1.2, -0.3, 0.4, 1.5), (0.7, -0.2, 0.9, 0.35)),
            ),
        ),
        "Integrator": (Reference("integrator.y", lambda t: 0.35 + 1.45 * sine_integral(t)),),
        "FirstOrder": (Reference("lag.y", lambda t: 2.466 + (-0.4 - 2.466) * np.exp(-t / 0.37)),),
        "SecondOrder": (Reference("swing.y", swing),),
        "Derivative": (Reference("rate.y", derivative),),
        "PI": (Reference("pi_block.y", lambda t: 1.7 * (sine(t) - 0.33 + sine_integral(t) / 0.6)),),
        "LimitedPI": (
            Reference("limited.integral", limited_integral),
            Reference("limited.y", limited),
        ),
    },
)
