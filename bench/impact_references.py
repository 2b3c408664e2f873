"""Exact values of the scenes of `impacts.py`, by means that have nothing of Frot."""

from __future__ import annotations

import math
from decimal import Decimal, getcontext
from itertools import combinations

import numpy as np
from peers.impact_scenes import BALL, BILLIARD, BLOCK, GRAVITY
from scipy.integrate import solve_ivp

DIGITS = 300


def ball() -> tuple[float, ...]:
    """The height of the centre at the end."""
    return (BALL.radius + BALL.height,)


def block() -> tuple[float, tuple[float, ...]]:
    """The time of the first highest place after the last blow, and the tilt there.

    About a corner 4/3 R^2 tilt'' = -g R sin(alpha - tilt); each blow takes the part 3/2 sin^2
    alpha of the speed. By symmetry a swing goes up as it will come down.
    """
    radius, alpha = math.hypot(BLOCK.wide, BLOCK.high) / 2, math.atan2(BLOCK.wide, BLOCK.high)
    pace, left = 0.75 * GRAVITY / radius, 1 - 1.5 * math.sin(alpha) ** 2

    def energy(tilt: float) -> float:
        return pace * math.cos(alpha - tilt)

    def fall(tilt: float) -> float:
        """From rest at a tilt to zero: tilt = highest - s^2 makes the start regular."""

        def rates(_: float, y: np.ndarray) -> np.ndarray:
            return np.array([y[1], -pace * math.sin(alpha - y[0])])

        def flat(_: float, y: np.ndarray) -> float:
            return float(y[0])

        flat.terminal = True  # type: ignore[attr-defined]
        options = {"method": "DOP853", "rtol": 3e-14, "atol": 1e-18, "max_step": 0.02}
        found = solve_ivp(rates, (0, 100), [tilt, 0.0], events=flat, **options)
        t, y = float(found.t_events[0][0]), found.y_events[0][0]
        return t - float(y[0]) / float(y[1])

    tilt, now = BLOCK.tilt, 0.0
    for _ in range(BLOCK.blows):
        now += fall(tilt)
        speed = math.sqrt(2 * (energy(tilt) - energy(0.0))) * left
        tilt = alpha - math.acos(math.cos(alpha) + speed**2 / (2 * pace))
        now += fall(tilt)
    return now, ((-1) ** BLOCK.blows * tilt,)


def billiard() -> tuple[float, float, tuple[float, ...]]:
    """Instants half way from impact `compared`, and `impacts`, to the next; places at the first.

    Straight flights between impacts, with so many digits that the growth of errors does not matter.
    """
    getcontext().prec = DIGITS
    r = Decimal(repr(BILLIARD.radius))
    x = [[Decimal(repr(c)) for c in place] for place in BILLIARD.places]
    v = [[Decimal(0), Decimal(0)] for _ in x]
    v[0] = [Decimal(repr(c)) for c in BILLIARD.speed]
    half = [Decimal(repr(c)) - r for c in BILLIARD.half]
    now, times, places = Decimal(0), [], []
    for _ in range(BILLIARD.impacts + 1):
        step, what = _next(x, v, r, half)
        pairs = list(zip(x, v, strict=True))
        times.append(now + step)
        if len(times) == BILLIARD.compared + 1:
            middle = step / 2
            places = [float(a + middle * b) for p, w in pairs for a, b in zip(p, w, strict=True)]
        for p, w in pairs:
            for k in (0, 1):
                p[k] += step * w[k]
        now += step
        i, j = what
        if j < 0:
            v[i][-j - 1] *= -1
            continue
        d = [x[j][k] - x[i][k] for k in (0, 1)]
        part = sum((v[j][k] - v[i][k]) * d[k] for k in (0, 1)) / sum(c * c for c in d)
        for k in (0, 1):
            v[i][k], v[j][k] = v[i][k] + part * d[k], v[j][k] - part * d[k]
    middles = [float((times[n - 1] + times[n]) / 2) for n in (BILLIARD.compared, BILLIARD.impacts)]
    return middles[0], middles[1], tuple(places)


def _next(x: list, v: list, r: Decimal, half: list) -> tuple[Decimal, tuple[int, int]]:
    """The time to the next impact, and its balls; -1 and -2 are walls across x and y."""
    best, what = Decimal("inf"), (0, 0)
    for i, (p, w) in enumerate(zip(x, v, strict=True)):
        for k in (0, 1):
            if w[k] != 0:
                t = (half[k].copy_sign(w[k]) - p[k]) / w[k]
                if t < best:
                    best, what = t, (i, -k - 1)
    for i, j in combinations(range(len(x)), 2):
        d = [x[j][k] - x[i][k] for k in (0, 1)]
        u = [v[j][k] - v[i][k] for k in (0, 1)]
        b, a = d[0] * u[0] + d[1] * u[1], u[0] ** 2 + u[1] ** 2
        c = d[0] ** 2 + d[1] ** 2 - 4 * r * r
        inside = b * b - a * c
        if b < 0 and inside > 0:
            t = c / (inside.sqrt() - b)
            if t < best:
                best, what = t, (i, j)
    return best, what
