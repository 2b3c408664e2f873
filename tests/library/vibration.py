"""Closed forms of one mass on a spring and a damper, and between elastic stops."""

from __future__ import annotations

import math

import numpy as np
from reference import Signal
from scipy.optimize import brentq


class Vibration:
    """m x'' + c x' + k (x - middle) = 0 from x, v at time 0, below critical damping."""

    def __init__(self, m: float, c: float, k: float, middle: float, x: float, v: float) -> None:
        self.middle = middle
        self.decay = c / (2 * m)
        self.own = math.sqrt(k / m - self.decay**2)
        self.cosine = x - middle
        self.sine = (v + self.decay * self.cosine) / self.own

    def x(self, t: Signal) -> Signal:
        angle = self.own * t
        swing = self.cosine * np.cos(angle) + self.sine * np.sin(angle)
        return self.middle + np.exp(-self.decay * t) * swing

    def v(self, t: Signal) -> Signal:
        angle = self.own * t
        cosine = self.own * self.sine - self.decay * self.cosine
        sine = -self.own * self.cosine - self.decay * self.sine
        return np.exp(-self.decay * t) * (cosine * np.cos(angle) + sine * np.sin(angle))


class BetweenStops:
    """A free mass that meets the upper stop once: free, pressed while k x + c v > 0, free again.

    The stop pushes with k (x - play) + c x' and never pulls, so that it lets go of the mass while
    it is still pressed in.
    """

    def __init__(self, m: float, c: float, k: float, play: float, x: float, v: float) -> None:
        self.start, self.speed = x, v
        self.meets = (play - x) / v
        self.pressed = Vibration(m, c, k, play, play, v)

        def push(t: float) -> float:
            return k * float(self.pressed.x(t) - play) + c * float(self.pressed.v(t))

        self.parts = self.meets + brentq(push, 1e-6, math.pi / self.pressed.own, xtol=1e-15)
        self.leaves = float(self.pressed.x(self.parts - self.meets))
        self.back = float(self.pressed.v(self.parts - self.meets))

    def x(self, t: Signal) -> Signal:
        before = self.start + self.speed * t
        after = self.leaves + self.back * (t - self.parts)
        return self._choose(t, before, self.pressed.x(t - self.meets), after)

    def v(self, t: Signal) -> Signal:
        return self._choose(t, self.speed, self.pressed.v(t - self.meets), self.back)

    def _choose(self, t: Signal, before: object, within: object, after: object) -> Signal:
        return np.where(t < self.meets, before, np.where(t < self.parts, within, after))
