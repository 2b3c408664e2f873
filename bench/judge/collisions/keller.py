"""The impact of one contact, in the normal impulse as time.

G. Darboux 1880, J. Keller 1986: du/dp = W (1, f) with f = -mu s/|s| while the slip s lasts, and
|f| <= mu_s with s = 0 while it sticks. Compression ends at u_n = 0; restitution ends by the rule.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

Floats = NDArray[np.float64]
# Part of its speeds below which a slip is none, and how often a phase may change.
NONE, PHASES = 1e-11, 40


@dataclass(slots=True)
class Blow:
    """Speeds before, normal impulse, impulses, work given to and taken from the contact."""

    u: Floats
    p: float
    impulses: Floats
    stored: float
    returned: float


@dataclass(frozen=True, slots=True)
class Stage:
    """Compression, or restitution by a rule, with what compression left."""

    compressing: bool
    rule: str
    e: float
    approach: float
    compressed: float
    peak: float

    def left(self, at: Blow) -> float:
        """Positive until the stage ends."""
        if self.compressing:
            return -float(at.u[0])
        if self.rule == "energetic":
            return self.e**2 * self.peak - at.returned
        if self.rule == "poisson":
            return (1 + self.e) * self.compressed - at.p
        return self.e * self.approach - float(at.u[0])


class Jams(Exception):
    """Friction presses the contact further, or no motion follows: no closed answer here."""


def impact(
    w: Floats, u: Floats, mu: tuple[float, float], e: float, rule: str
) -> tuple[Floats, Floats, float]:
    """Speeds after, impulses and the energy lost; rows are the normal, then one or two tangents.

    `mu` are the coefficients of motion and of rest. Raises Jams where friction drives the contact.
    """
    size = float(np.max(np.abs(u)))
    before = -float(u[0])
    now = Blow(u.astype(float).copy(), 0.0, np.zeros(len(u)), 0.0, 0.0)
    compressed = peak = 0.0
    compressing = before > 0
    for _ in range(PHASES):
        slip = np.linalg.norm(now.u[1:])
        turned = len(u) == 3 and slip > NONE * size and not straight(w, now.u)
        stage = Stage(compressing, rule, e, before, compressed, peak)
        force = friction(w, now.u, mu, size)
        rate = w @ np.array([1.0, *force])
        if turned:
            now, ended = _turning(w, now, mu[0], stage, size)
        else:
            now, ended = _straight(now, force, rate, stage, size)
        if not ended:
            continue
        if compressing and e > 0:
            compressing, compressed, peak = False, now.p, now.stored
            now.u[0] = 0.0
            continue
        if compressing:
            now.u[0] = 0.0
        return now.u, now.impulses, -float(now.impulses @ (u + now.u)) / 2
    raise Jams


def straight(w: Floats, u: Floats) -> bool:
    """Whether a slip keeps its direction: W maps the normal and the slip into their own plane."""
    s = u[1:]
    across = np.array([-s[1], s[0]]) / np.linalg.norm(s)
    d = s / np.linalg.norm(s)
    turns = abs(across @ w[1:, 0]) + abs(across @ w[1:, 1:] @ d)
    return bool(turns <= 1e-14 * np.max(np.abs(w)))


def friction(w: Floats, u: Floats, mu: tuple[float, float], size: float) -> Floats:
    """The tangential force per normal one: of slip, of stick, or of the slip that begins."""
    s = u[1:]
    slip = float(np.linalg.norm(s))
    if not len(s):
        return s
    if slip > NONE * size:
        return -mu[0] * s / slip
    holding = -np.linalg.solve(w[1:, 1:], w[1:, 0])
    if np.linalg.norm(holding) <= mu[1]:
        return np.asarray(holding)
    starts = departures(w, mu[0])
    if len(starts) != 1:
        raise Jams
    return -mu[0] * starts[0]


def departures(w: Floats, mu: float) -> list[Floats]:
    """Directions d in which a slip begins: W_tn - mu W_tt d = beta d with beta > 0."""
    push, inner = w[1:, 0], w[1:, 1:]
    if len(push) == 1:
        ways = [np.array([1.0]), np.array([-1.0])]
        return [d for d in ways if float(d @ (push - mu * inner @ d)) > 0]
    angles = np.linspace(0, 2 * math.pi, 721)

    def missed(a: float) -> float:
        d = np.array([math.cos(a), math.sin(a)])
        r = push - mu * inner @ d
        return float(d[0] * r[1] - d[1] * r[0])

    found = []
    for a, b in itertools.pairwise(angles):
        x, y = missed(a), missed(b)
        if x * y >= 0 and x != 0:
            continue
        root = float(brentq(missed, a, b, xtol=1e-15)) if x != 0 else float(a)
        d = np.array([math.cos(root), math.sin(root)])
        if d @ (push - mu * inner @ d) > 0:
            found.append(d)
    return found


def _straight(
    now: Blow, force: Floats, rate: Floats, stage: Stage, size: float
) -> tuple[Blow, bool]:
    """A phase with constant rates, to its end or that of the stage, in closed form."""
    s = now.u[1:]
    slip = float(np.linalg.norm(s))
    until = math.inf
    if slip > NONE * size:
        fall = -float(s @ rate[1:]) / slip
        until = slip / fall if fall > 0 else math.inf
    left = stage.left(now)
    if stage.compressing or stage.rule == "newton":
        end = left / rate[0] if rate[0] > 0 else math.inf
    elif stage.rule == "poisson":
        end = left
    elif rate[0] == 0:
        end = left / now.u[0] if now.u[0] > 0 else math.inf
    else:
        inside = now.u[0] ** 2 + 2 * rate[0] * left
        end = (math.sqrt(inside) - now.u[0]) / rate[0] if inside >= 0 else math.inf
    step = min(until, end)
    if not math.isfinite(step):
        raise Jams
    after = Blow(
        now.u + step * rate,
        now.p + step,
        now.impulses + step * np.array([1.0, *force]),
        now.stored,
        now.returned,
    )
    work = step * float(now.u[0] + after.u[0]) / 2
    if stage.compressing:
        after.stored -= work
    else:
        after.returned += work
    if until <= end:
        after.u[1:] = 0.0
    return after, end <= until


def _turning(w: Floats, now: Blow, mu: float, stage: Stage, size: float) -> tuple[Blow, bool]:
    """A slip that turns: dp = |s| dtau, so that its end, |s| -> 0, is no singular point."""
    k = len(now.u)

    def rates(_: float, y: Floats) -> Floats:
        slip = math.hypot(*y[1:k])
        push = np.array([slip, *(-mu * y[1:k])])
        return np.array([*(w @ push), *push, slip * y[0]])

    def blow(y: Floats) -> Blow:
        work = float(y[-1])
        stored = now.stored - (work if stage.compressing else 0.0)
        returned = now.returned + (0.0 if stage.compressing else work)
        return Blow(
            y[:k].copy(), now.p + float(y[k]), now.impulses + y[k : 2 * k], stored, returned
        )

    def ends(_: float, y: Floats) -> float:
        return stage.left(blow(y))

    def stops(_: float, y: Floats) -> float:
        return math.hypot(*y[1:k]) - 0.1 * NONE * size

    ends.terminal = stops.terminal = True  # type: ignore[attr-defined]
    start = np.concatenate([now.u, np.zeros(k), [0.0]])
    scale = 1 / float(np.max(np.abs(w)))
    units = np.concatenate([np.full(k, size), np.full(k, size * scale), [size * size * scale]])
    found = solve_ivp(
        rates,
        (0, 1e6 * scale / min(1.0, max(mu, 1e-9))),
        start,
        "DOP853",
        rtol=1e-12,
        atol=1e-14 * units,
        events=(ends, stops),
    )
    if found.status != 1:
        raise Jams
    after = blow(found.y[:, -1])
    if len(found.t_events[1]):
        after.u[1:] = 0.0
    return after, len(found.t_events[0]) > 0
