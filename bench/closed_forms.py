"""Exact motions that the benchmarks are measured against. SI units throughout."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

GRAVITY = 9.81


@dataclass(frozen=True, slots=True)
class Block:
    """S01: a block launched down a slope gentler than the friction angle (Painlevé 1895, p. 58)."""

    slope: float = math.radians(20)
    mu: float = 0.5
    v0: float = 2.0
    stop: float = 3.0

    @property
    def x_stop(self) -> float:
        """Where it stops: v0^2 / (2 g (mu cos - sin))."""
        slowing = GRAVITY * (self.mu * math.cos(self.slope) - math.sin(self.slope))
        return self.v0**2 / (2 * slowing)


@dataclass(frozen=True, slots=True)
class Oscillator:
    """A unit mass drawn to O with dry friction from rest at x0 (Painlevé 1895, p. 61)."""

    mu: float = 0.1
    k: float = 9.0
    x0: float = 2.0
    stop: float = 12.0

    @property
    def x_stop(self) -> float:
        """Where it rests: each half swing is 2 mu g / k shorter, until |x| <= mu g / k."""
        band = self.mu * GRAVITY / self.k
        x = self.x0
        while abs(x) > band:
            x = math.copysign(abs(x) - 2 * band, -x)
        return x


@dataclass(frozen=True, slots=True)
class Hoop:
    """A hoop on a rough line that falls by `slope` towards +x (Painlevé 1895, p. 78 and 106).

    `delta` is the rolling resistance (a length), `w0` the first angular velocity, counted so that
    rolling towards +x is positive. The defaults are row hoop-3 of the reference values.
    """

    slope: float = 0.0
    r: float = 0.5
    mu: float = 0.3
    delta: float = 0.01
    v0: float = 4.0
    w0: float = 0.0
    stop: float = 60.0


@dataclass(slots=True)
class HoopMotion:
    """Position, angle and their rates; `changes` are (time, phase) with phase slide, roll, rest."""

    x: float = 0.0
    angle: float = 0.0
    v: float = 0.0
    w: float = 0.0
    changes: list[tuple[float, str]] = field(default_factory=list)


def hoop_motion(hoop: Hoop, t: float) -> HoopMotion:
    """The hoop at time t: pieces of constant acceleration. Needs delta / r < mu, v0 and w0 not 0.

    In each piece x'' = p and r angle'' = q, for a hoop of moment of inertia m r^2:
    sliding, p = g sin - s mu g cos and q = (s mu - d delta/r) g cos with the signs s of the slip
    v - r w and d of the rotation; rolling, 2 p = 2 q = g sin - d (delta/r) g cos while the
    friction this takes, g sin - p, is within mu g cos.
    """
    drive, load = GRAVITY * math.sin(hoop.slope), GRAVITY * math.cos(hoop.slope)
    f, r = hoop.delta / hoop.r, hoop.r
    if not 0 <= f < hoop.mu:
        raise ValueError("the closed form needs 0 <= delta / r < mu")
    motion = HoopMotion(0.0, 0.0, hoop.v0, hoop.w0)
    slip, turn = _sign(hoop.v0 - r * hoop.w0), _sign(hoop.w0)
    now = 0.0
    for _ in range(20):
        slip, turn, p, q = _piece(slip, turn, hoop.mu, f, drive, load)
        phase = "slide" if slip else "roll" if turn else "rest"
        if not motion.changes or motion.changes[-1][1] != phase:
            motion.changes.append((now, phase))
        # The piece ends where the slip or the rotation reaches zero.
        ends = [math.inf, math.inf]
        if slip and slip * (p - q) < 0:
            ends[0] = (motion.v - r * motion.w) / (q - p)
        if turn and turn * q < 0:
            ends[1] = -r * motion.w / q
        last = t - now
        step = min(last, *ends)
        motion.x += motion.v * step + p * step**2 / 2
        motion.angle += motion.w * step + q / r * step**2 / 2
        motion.v += p * step
        motion.w += q / r * step
        now += step
        if step == last:
            return motion
        if step == ends[0]:
            slip, motion.v = 0, r * motion.w
        if step == ends[1]:
            turn, motion.w = 0, 0.0
            if not slip:
                motion.v = 0.0
    raise ValueError("the hoop changes its motion too often")


def _piece(
    slip: int, turn: int, mu: float, f: float, drive: float, load: float
) -> tuple[int, int, float, float]:
    """Signs of slip and rotation as the next piece begins, and its accelerations p and q."""
    if slip and not turn:
        turn = slip
    if not slip:
        if not turn and abs(drive) <= min(f, mu) * load:
            return 0, 0, 0.0, 0.0
        turn = turn or _sign(drive)
        p = (drive - turn * f * load) / 2
        if abs(drive - p) <= mu * load:
            return 0, turn, p, p
        slip = _sign(drive - p)
    return slip, turn, drive - slip * mu * load, (slip * mu - turn * f) * load


def _sign(x: float) -> int:
    return (x > 0) - (x < 0)


@dataclass(frozen=True, slots=True)
class Drag:
    """A unit mass on a table, dragged through a spring whose end moves at speed v."""

    k: float = 100.0
    mu: float = 0.25
    mu_s: float = 0.4
    v: float = 0.1
    x0: float = -0.01

    @property
    def first_slip(self) -> float:
        """When the spring first holds the force mu_s g."""
        return (self.mu_s * GRAVITY / self.k + self.x0) / self.v

    @property
    def slip_time(self) -> float:
        """Duration of a slip: (2 / w) (pi - atan(dF w / (k v))), dF the drop of the force."""
        omega = math.sqrt(self.k)
        drop = (self.mu_s - self.mu) * GRAVITY
        return 2 / omega * (math.pi - math.atan(drop * omega / (self.k * self.v)))

    @property
    def stick_time(self) -> float:
        """Duration of a rest: the spring regains twice dF."""
        return 2 * (self.mu_s - self.mu) * GRAVITY / (self.k * self.v)

    @property
    def period(self) -> float:
        """Of the stick-slip cycle."""
        return self.slip_time + self.stick_time

    def event(self, index: int) -> float:
        """Time of event 0, 1, 2 ...: slip begins, rest begins, slip begins ..."""
        return self.first_slip + index // 2 * self.period + (index % 2) * self.slip_time


BLOCK, OSCILLATOR, HOOP = Block(), Oscillator(), Hoop()


def exact(scene: str) -> tuple[float, ...]:
    """Positions at the end of a scene of `work_precision`: x, for the hoop x and r angle."""
    if scene == "hoop":
        end = hoop_motion(HOOP, HOOP.stop)
        return end.x, HOOP.r * end.angle
    return (BLOCK.x_stop,) if scene == "block" else (OSCILLATOR.x_stop,)
