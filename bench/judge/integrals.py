"""Velocities are the integrals of the accelerations, positions those of the velocities."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from judge.mechanics import Floats
from judge.motions import parts
from judge.scene import Body
from judge.seen import SLACK, Seen

CARRIED = 1e-15  # a speed is a sum along what joins bodies: known to roundings of the largest there
NODES, WEIGHTS = np.polynomial.legendre.leggauss(10)
# Parts of an interval over each of which a rule is taken; the finest sees a bell of a thousandth.
PANELS = (2, 64, 2048)


def integrals(
    seen: Seen,
    rng: np.random.Generator,
    marks: list[float],
    begin: float,
    end: float,
    count: int = 5,
) -> None:
    """Look at some intervals without events."""
    cuts = [begin, *[t for t in marks if begin < t < end], end]
    for _ in range(count):
        k = int(rng.integers(len(cuts) - 1))
        a, b = cuts[k], cuts[k + 1]
        span = (b - a) * min(1.0, 10 ** rng.uniform(-2.0, 0.0))
        a = float(rng.uniform(a, b - span)) if b - span > a else a
        if seen.spins() > 0:  # no rule follows many turns
            span = min(span, 1.0 / seen.spins())
        b = min(a + span, math.nextafter(b, -math.inf))
        if b - a > 1e-9 * max(abs(a), abs(b), end - begin):
            _interval(seen, a, b)


def gauss_places(a: float, b: float, panels: int) -> Floats:
    """The nodes of the Gauss rule on each of so many equal parts of [a, b], in one row."""
    middles = a + (b - a) / panels * (np.arange(panels) + 0.5)
    return (middles[:, None] + (b - a) / panels / 2 * NODES).ravel()


def _interval(seen: Seen, a: float, b: float) -> None:
    """Changes over [a, b] against integrals; of what they miss, by ever finer rules.

    What is left at the end may be what errors of the states leave: those of a body among what it
    is joined to, whose speeds are its coordinates, and what a stiff load makes of them.
    """
    for panels in PANELS:
        found = list(_missed(seen, a, b, panels))
        if all(abs(missed) <= allowed for *_, missed, allowed in found):
            break
    else:
        shaken = (b - a) * SLACK * np.max([shaken_by_errors(seen, t) for t in (a, b)], axis=0)
        found = [
            (of, rate, missed, allowed + _left_by_errors(seen, of, rate, shaken))
            for of, rate, missed, allowed in found
        ]
    for of, rate, missed, allowed in found:
        seen.found.hold(f"integral of {rate}", missed, allowed, a, f"{of} to {b!r}")


def _left_by_errors(seen: Seen, of: str, rate: str, shaken: Floats) -> float:
    """What a speed misses by errors of states, of which accelerations are `shaken` by so much."""
    body = of.split(".")[0]
    k = 3 * [b.name for b in seen.scene.bodies].index(body)
    if rate == "acceleration":
        return float(shaken[k + "xy".index(of[-1])]) + SLACK * seen.tol * seen.joined[body]
    if rate == "angular_acceleration":
        return float(shaken[k + 2]) + SLACK * seen.tol * seen.joined[f"{body}.w"]
    return 0.0


def shaken_by_errors(seen: Seen, t: float) -> Floats:
    """Accelerations that one tolerance of each coordinate and speed makes by the loads.

    What joins bodies hands these loads on, and turns them by the arms of what it joins.
    """
    row = seen.row(t)
    now = seen.mechanics_of(row, t)
    load = np.zeros(now.n)
    for b in seen.scene.bodies:
        for name, size in _sizes(seen, b):
            moved = {**row, f"{b.name}.{name}": row[f"{b.name}.{name}"] + seen.tol * size}
            load += np.abs(seen.mechanics_of(moved, t).load - now.load)
    found = load / now.mass
    for places, joints in parts(now):
        force = float(np.sum(load[places[:, :2]]))
        arm = max((j.size for j in joints), default=0.0)
        if arm > 0:
            couple = arm * force + float(np.sum(load[places[:, 2]]))
            found[places[:, :2]] = force / now.mass[places[:, :2]]
            found[places[:, 2]] = couple / now.mass[places[:, 2]]
    return found


def _sizes(seen: Seen, body: Body) -> list[tuple[str, float]]:
    """The states of a body and what their errors are measured against."""
    found = [(f"position.{axis}", seen.length) for axis in "xy"]
    found += [(f"velocity.{axis}", seen.speed[body.name]) for axis in "xy"]
    if body.turns:
        found += [("angle", 1.0), ("angular_velocity", seen.speed[f"{body.name}.w"])]
    return found


def _missed(seen: Seen, a: float, b: float, panels: int) -> Iterator[tuple[str, str, float, float]]:
    """The names of values and of their rates, what they differ by and what is allowed."""
    coarse, fine = (seen.result.at(gauss_places(a, b, n)) for n in (panels // 2, panels))
    ends = seen.result.at(np.array([a, b]))
    pairs = [("position", "velocity"), ("velocity", "acceleration")]
    for body in seen.scene.bodies:
        names = [
            (f"{body.name}.{x}.{axis}", f"{body.name}.{y}.{axis}")
            for x, y in pairs
            for axis in "xy"
        ]
        if body.turns:
            names += [(f"{body.name}.angle", f"{body.name}.angular_velocity")]
            names += [(f"{body.name}.angular_velocity", f"{body.name}.angular_acceleration")]
        for of, rate in names:
            one, two = (
                (b - a) / (2 * n) * float(np.tile(WEIGHTS, n) @ at[rate])
                for n, at in ((panels // 2, coarse), (panels, fine))
            )
            size = float(np.max(np.abs(fine[of])) + (b - a) * np.max(np.abs(fine[rate])))
            change = float(ends[of][1] - ends[of][0])
            # the sizes the kernel measures against: the largest of the run
            if ".position" in of:
                size = max(size, seen.length)
            elif of.endswith(".angle"):
                size = max(size, 1e-3)  # rad
            elif "angular_velocity" in of:
                size = max(size, seen.speed[f"{body.name}.w"])
            elif ".velocity" in of:
                size = max(size, seen.speed[body.name])
            allowed = SLACK * seen.tol * size + 1e-12 * size + 100 * abs(one - two)
            if "velocity" in of:
                joined = seen.joined[f"{body.name}.w" if "angular" in of else body.name]
                allowed += CARRIED * joined
            yield of, rate.split(".")[1], change - two, allowed
