"""Parts of `Blocks` that jump: sampled ones and a relay, on a sine."""

from __future__ import annotations

import math

import numpy as np
from reference import Bench, Reference, Signal

TEXT = """
model SampledBench
  import Blocks.*;
  Sine sine(amplitude = 1.3, frequency = 0.45 Hz, phase = -0.2 rad);
  Pulse pulse(height = 2.2, period = 0.37 s, duty = 0.28);
  Sampler sampler(period = 0.13 s, start = 0.05 s);
  UnitDelay delay(period = 0.21 s);
  Relay relay(low = -0.7, high = 0.4, off = -0.3, on_value = 1.9);
  Relay pressed(low = -0.7, high = -0.4);
equation
  connect(sine.y, sampler.u);
  connect(sine.y, delay.u);
  connect(sine.y, relay.u);
  connect(sine.y, pressed.u);
  experiment(stop = 3 s, tolerance = 1e-11);
end SampledBench;
"""

OMEGA = 2 * math.pi * 0.45
END = 3.0


def sine(t: Signal | float) -> Signal:
    return np.asarray(1.3 * np.sin(OMEGA * np.asarray(t) - 0.2))


def repeated(period: float, start: float = 0.0) -> tuple[float, ...]:
    return tuple(np.arange(start, END + period, period))


def sampled(t: Signal) -> Signal:
    """Before the first sample the output is zero."""
    last = 0.05 + 0.13 * np.floor((t - 0.05) / 0.13)
    return np.where(t < 0.05, 0, sine(last))


def delayed(t: Signal) -> Signal:
    before = 0.21 * (np.floor(t / 0.21) - 1)
    return np.where(before < -1e-9, 0, sine(before))


# Upwards through `high`, downwards through `low`, upwards again.
RISES = (math.asin(0.4 / 1.3) + 0.2) / OMEGA
FALLS = (math.pi + math.asin(0.7 / 1.3) + 0.2) / OMEGA
AGAIN = RISES + 1 / 0.45
# The second relay begins above its upper bound: on at once.
LETS_GO = FALLS
RETURNS = (2 * math.pi - math.asin(0.4 / 1.3) + 0.2) / OMEGA


def is_on(t: Signal) -> Signal:
    return ((t >= RISES) & (t < FALLS)) | (t >= AGAIN)


PULSES = repeated(0.37) + repeated(0.37, 0.37 * 0.28)

BENCH = Bench(
    "Blocks",
    TEXT,
    {
        "Pulse": (Reference("pulse.y", lambda t: 2.2 * (t % 0.37 < 0.28 * 0.37), jumps=PULSES),),
        "Sampler": (Reference("sampler.y", sampled, jumps=repeated(0.13, 0.05)),),
        "UnitDelay": (Reference("delay.y", delayed, jumps=repeated(0.21)),),
        "Relay": (
            Reference(
                "relay.y", lambda t: np.where(is_on(t), 1.9, -0.3), jumps=(RISES, FALLS, AGAIN)
            ),
            Reference(
                "pressed.y",
                lambda t: 1.0 * ((t < LETS_GO) | (t >= RETURNS)),
                jumps=(LETS_GO, RETURNS),
            ),
        ),
    },
)
