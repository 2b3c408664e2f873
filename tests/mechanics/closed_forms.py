"""Closed forms of motions with dry friction, written without a look at Frot."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, field


@dataclass
class Phase:
    """Constant accelerations from t on; signs of slip and rolling (0: held)."""

    t: float
    s: float
    v: float
    angle: float
    w: float
    a: float
    b: float
    slip: int
    roll: int


@dataclass
class Motion:
    """Phases in order; `margin` tells how far the motion keeps from ambiguous states."""

    phases: list[Phase] = field(default_factory=list)
    margin: float = math.inf

    def at(self, t: float) -> tuple[float, float, float, float]:
        """Displacement, speed, angle, angular velocity."""
        p = [p for p in self.phases if p.t <= t][-1]
        d = t - p.t
        return (
            p.s + p.v * d + p.a * d * d / 2,
            p.v + p.a * d,
            p.angle + p.w * d + p.b * d * d / 2,
            p.w + p.b * d,
        )


def _sign(x: float) -> int:
    return (x > 0) - (x < 0)


def block_on_slope(v0: float, pull: float, bound: float, stop: float) -> Motion:
    """Block under the force `pull` a unit mass along its line, friction `bound` a unit mass.

    Painlevé 1895, p. 58: v changes at the rate pull -+ bound; at v = 0 it stays if |pull| <= bound.
    """
    motion = Motion()
    t, s, v = 0.0, 0.0, v0
    while True:
        slip = _sign(v) or (_sign(pull) if abs(pull) > bound else 0)
        if v == 0:
            motion.margin = min(motion.margin, abs(abs(pull) - bound) / max(abs(pull), bound))
        a = pull - slip * bound if slip else 0.0
        motion.phases.append(Phase(t, s, v, 0.0, 0.0, a, 0.0, slip, 0))
        if v * a >= 0:
            return motion
        motion.margin = min(motion.margin, abs(a) / (abs(pull) + bound))
        end = -v / a
        if t + end >= stop:
            return motion
        t, s, v = t + end, s - v * v / (2 * a), 0.0


def hoop_on_line(
    m: float,
    r: float,
    inertia: float,
    pull: float,
    press: float,
    mu: float,
    delta: float,
    v0: float,
    w0: float,
    stop: float,
) -> Motion:
    """Round body on a line under `pull` along and `press` onto it; w counter-clockwise, on top.

    Painlevé 1895, p. 78-81 and 106-108: the slip is v + r w; friction mu N against it, or any up to
    mu N that keeps it zero; likewise a couple delta N against w. Rest is preferred.
    """
    motion = Motion()
    t, s, v, angle, w = 0.0, 0.0, v0, 0.0, w0
    slip_zero = abs(v + r * w) < 1e-13 * (abs(v) + abs(r * w))
    roll_zero = w == 0
    for _ in range(20):
        slip = 0 if slip_zero else _sign(v + r * w)
        roll = 0 if roll_zero else _sign(w)
        slips = (0, 1, -1) if slip_zero else (slip,)
        rolls = (0, 1, -1) if roll_zero and delta > 0 else (roll or 1,)
        nearest = -math.inf
        for slip, roll in itertools.product(slips, rolls):
            a, b, margin = _accelerations(m, r, inertia, pull, press, mu, delta, slip, roll)
            nearest = max(nearest, margin)
            good = margin > 0
            if slip_zero and slip:
                good = good and slip * (a + r * b) > 0
            if delta > 0 and roll_zero and roll:
                good = good and roll * b > 0
            if good:
                motion.margin = min(motion.margin, margin)
                break
        else:
            # A friction or couple exactly at its bound: rounding decides which motion goes on.
            assert abs(nearest) < 1e-12, "no admissible motion"
            motion.margin = 0.0
            return motion
        motion.phases.append(Phase(t, s, v, angle, w, a, b, slip, roll))
        until = []
        turning = w if roll and delta > 0 else 0.0
        for value, rate in ((v + r * w if slip else 0.0, a + r * b), (turning, b)):
            until.append(-value / rate if value * rate < 0 else math.inf)
            if value * rate < 0:
                size = (abs(pull) + mu * press) / m + r * (r * mu + delta) * press / inertia
                motion.margin = min(motion.margin, abs(rate) / size)
        step = min(until)
        motion.margin = min(motion.margin, *(abs(u - stop + t) / stop for u in until))
        if math.isfinite(until[0]) and math.isfinite(until[1]):
            motion.margin = min(motion.margin, abs(until[0] - until[1]) / stop)
        if t + step >= stop:
            return motion
        s, angle = s + v * step + a * step**2 / 2, angle + w * step + b * step**2 / 2
        v, w, t = v + a * step, w + b * step, t + step
        slip_zero = (slip == 0 and slip_zero) or until[0] == step
        roll_zero = (roll == 0 and roll_zero) or until[1] == step
        if roll_zero:
            w = 0.0
        if slip_zero:
            v = -r * w
    raise AssertionError("too many phases")


def _accelerations(
    m: float,
    r: float,
    inertia: float,
    pull: float,
    press: float,
    mu: float,
    delta: float,
    slip: int,
    roll: int,
) -> tuple[float, float, float]:
    """Accelerations in a mode and how far its friction and couple are below their bounds."""
    friction, couple, margin = -slip * mu * press, -roll * delta * press, math.inf
    if slip == 0 and roll == 0:
        friction, couple = -pull, r * pull
    elif slip == 0:  # m a = pull + T, I b = r T + C, a + r b = 0
        friction = -(pull / m + r * couple / inertia) / (1 / m + r * r / inertia)
    elif roll == 0:
        couple = -r * friction
    if slip == 0:
        margin = min(margin, 1 - abs(friction) / (mu * press))
    if roll == 0:
        margin = min(margin, (delta * press - abs(couple)) / (r * mu * press))
    a, b = (pull + friction) / m, (r * friction + couple) / inertia
    if slip == 0:
        b = -a / r
    return a, b, margin


def coulomb_oscillator(
    m: float, k: float, pull: float, bound: float, s0: float
) -> tuple[list[float], list[float]]:
    """Times and places where a block on a spring comes to rest, let go at rest at s0.

    Painlevé 1895, p. 61-62: isochronous half swings pi sqrt(m/k) about (pull -+ bound)/k.
    """
    times, places = [0.0], [s0]
    while abs(pull - k * places[-1]) > bound:
        away = _sign(pull - k * places[-1])
        centre = (pull - away * bound) / k
        places.append(2 * centre - places[-1])
        times.append(len(times) * math.pi * math.sqrt(m / k))
    return times, places


def oscillator_at(
    t: float, m: float, k: float, pull: float, times: list[float], places: list[float]
) -> tuple[float, float]:
    """Place and speed of the Coulomb oscillator at t."""
    i = max(i for i, at in enumerate(times) if at <= t)
    if i == len(times) - 1:
        return places[-1], 0.0
    centre, omega = (places[i] + places[i + 1]) / 2, math.sqrt(k / m)
    phase, swing = omega * (t - times[i]), places[i] - centre
    return centre + swing * math.cos(phase), -swing * omega * math.sin(phase)


def stick_slip(
    m: float, k: float, speed: float, static: float, kinetic: float
) -> tuple[float, float, float]:
    """First break-away, duration of slip and of stick of a block drawn by a spring.

    `static` and `kinetic`: friction forces. S05 of scenes.json.
    """
    omega, drop = math.sqrt(k / m), static - kinetic
    slip = 2 / omega * (math.pi - math.atan2(drop * omega, k * speed))
    return static / (k * speed), slip, 2 * drop / (k * speed)
