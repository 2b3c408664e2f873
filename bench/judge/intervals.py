"""What must hold over intervals of a result: integrals of rates, the balance of energy."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np

from judge.mechanics import Floats, inertia
from judge.seen import SLACK, Seen

NODES, WEIGHTS = np.polynomial.legendre.leggauss(10)
# Parts of an interval over each of which a rule is taken; the finest sees a bell of a thousandth.
PANELS = (2, 64, 2048)


def gauss_places(a: float, b: float, panels: int) -> Floats:
    """The nodes of the Gauss rule on each of so many equal parts of [a, b], in one row."""
    middles = a + (b - a) / panels * (np.arange(panels) + 0.5)
    return (middles[:, None] + (b - a) / panels / 2 * NODES).ravel()


def integrals(
    seen: Seen,
    rng: np.random.Generator,
    marks: list[float],
    begin: float,
    end: float,
    count: int = 5,
) -> None:
    """Velocities are the integrals of the accelerations, positions those of the velocities."""
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
            integral(seen, a, b)


def integral(seen: Seen, a: float, b: float) -> None:
    """Changes over [a, b] against integrals; of what they miss, by ever finer rules."""
    for panels in PANELS:
        found = list(missed(seen, a, b, panels))
        if all(abs(off) <= allowed for *_, off, allowed in found):
            break
    for of, rate, off, allowed in found:
        seen.found.hold(f"integral of {rate}", off, allowed, a, f"{of} to {b!r}")


def missed(seen: Seen, a: float, b: float, panels: int) -> Iterator[tuple[str, str, float, float]]:
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
                allowed += seen.carried[f"{body.name}.w" if "angular" in of else body.name]
            yield of, rate.split(".")[1], change - two, allowed


def balance(seen: Seen, rng: np.random.Generator, begin: float, end: float) -> None:
    """Kinetic + potential + dissipated - work is constant, and the kinetic energy right."""
    if "energy.kinetic" not in seen.result:
        return
    now = seen.result.at(np.sort(rng.uniform(begin, end, 8)))
    parts = [now[f"energy.{x}"] for x in ("kinetic", "potential", "dissipated", "work")]
    kinetic = np.zeros(8)
    look = seen.look(begin, {})
    for b in seen.scene.bodies:
        speed = now[f"{b.name}.velocity.x"] ** 2 + now[f"{b.name}.velocity.y"] ** 2
        kinetic += b.mass.at(look) * speed / 2
        if b.turns:
            kinetic += inertia(b, look) * now[f"{b.name}.angular_velocity"] ** 2 / 2
    grid = sum(
        np.max(np.abs(seen.result[f"energy.{x}"]))
        for x in ("kinetic", "potential", "dissipated", "work")
    )
    size = float(np.max(seen.result["energy.kinetic"]))
    for x, y, t in zip(kinetic, parts[0], now_times(now), strict=True):
        seen.found.hold("kinetic energy", float(x - y), 1e-11 * size, t, "energy")
    total = parts[0] + parts[1] + parts[2] - parts[3]
    now_here = seen.mechanics(end)
    grid += 1e-6 * float(np.max(now_here.load_size.reshape(-1, 3)[:, :2])) * seen.length
    steps = max(1, len(seen.result.events))
    allowed = 1e4 * steps * seen.tol * float(grid) + 1e-10 * float(grid)
    seen.found.hold(
        "energy balance", float(np.max(total) - np.min(total)), allowed, begin, "energy"
    )
    fall = float(np.min(np.diff(parts[2]), initial=0.0))
    seen.found.hold("dissipated", fall, (SLACK * seen.tol + 1e-12) * float(grid), begin, "energy")


def now_times(now: Mapping[str, Floats]) -> Floats:
    return now["time"] if "time" in now else np.zeros(8)
