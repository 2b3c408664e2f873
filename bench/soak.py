"""Long runs: does anything drift, creep or miss an event? All against closed forms.

Writes `results/soak.md`; exit status 1 when a limit is exceeded or a run failed.
"""

from __future__ import annotations

import argparse
import math
import random
import sys
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from closed_forms import Drag, Hoop, hoop_motion
from common import MODELS, OWN_MODELS, RESULTS, name_card, say, seconds, table, write

import frot

SEED = 1895


@dataclass(frozen=True, slots=True)
class Line:
    """A line of a table, and whether it is within its limit."""

    cells: tuple[object, ...]
    good: bool


def oscillator(quick: bool) -> Iterable[Line]:
    """Energy and phase of the oscillator without friction after so many periods."""
    model = frot.load(MODELS / "coulomb_oscillator.frot")
    x0, omega = 2.0, 3.0
    period = 2 * math.pi / omega
    scale = omega**2 * x0**2 / 2
    most = 100 if quick else 1000
    for tolerance in (1e-6, 1e-9, 1e-12):
        begun = time.perf_counter()
        result = model.simulate(
            stop=most * period,
            tolerance=tolerance,
            interval=period,
            parameters={"mu": 0.0},
        )
        wall = time.perf_counter() - begun
        for count in (1, 10, 100, 1000):
            if count > most:
                continue
            # The end of the run may be one rounding before the last whole period.
            end = result.at(min(count * period, float(result.time[-1])))
            x, v = float(end["m.position.x"]), float(end["m.velocity.x"])
            energy = ((v * v + omega**2 * x * x) / 2 - scale) / scale
            phase = math.atan2(-v / omega, x)
            limit = count * (tolerance + 1e-13)
            yield Line(
                (f"{tolerance:.0e}", count, f"{energy:+.1e}", f"{phase:+.1e}",
                 f"{limit:.0e}", result.figures.steps, seconds(wall)),
                max(abs(energy), abs(phase)) <= limit and not result.events,
            )  # fmt: skip


def rest(quick: bool) -> Iterable[Line]:
    """A block at rest, from the start and after a stop: it must not move by one bit."""
    model = frot.load(MODELS / "inclined_block.frot")
    stop = 1e6
    for title, speed, after in (("from the start", 0.0, 0.0), ("after sliding", 3.0, 2.5)):
        begun = time.perf_counter()
        result = model.simulate(stop=stop, interval=stop / 1000, parameters={"v0": speed})
        wall = time.perf_counter() - begun
        times = np.linspace(after, stop, 100_001)
        samples = result.at(times)
        s, vx, vy = samples["s"], samples["block.velocity.x"], samples["block.velocity.y"]
        spread = float(np.ptp(s))
        fastest = float(max(np.max(np.abs(vx)), np.max(np.abs(vy))))
        yield Line(
            (title, f"{stop:.0e} s", f"{float(s[-1]):.16g}", f"{spread:g}", f"{fastest:g}",
             result.figures.steps, seconds(wall)),
            spread == 0 and fastest == 0,
        )  # fmt: skip


def stick_slip(quick: bool) -> Iterable[Line]:
    """Times of a long train of events against the closed form."""
    model = frot.load(OWN_MODELS / "drag.frot")
    drag = Drag()
    wanted = 1000 if quick else 10_000
    stop = drag.event(wanted) - 0.5 * drag.slip_time
    exact = np.array([drag.event(k) for k in range(wanted)])
    for tolerance in (1e-6, 1e-9, 1e-12):
        begun = time.perf_counter()
        result = model.simulate(stop=stop, tolerance=tolerance, interval=1.0)
        wall = time.perf_counter() - begun
        times = np.array([event.time for event in result.events])
        after = [event.after for event in result.events]
        ordered = after == ["slip", "stick"] * (len(after) // 2) + ["slip"] * (len(after) % 2)
        error, growth = math.nan, math.nan
        if len(times) == wanted:
            late = np.abs(times - exact)
            error = float(np.max(late))
            growth = float(np.max(late[wanted // 2 :]) / max(np.max(late[: wanted // 2]), 1e-300))
        # Rest wipes out what a slip left in the state; what a period got wrong stays in the times.
        limit = tolerance * wanted / 2 + 1e-14 * stop
        yield Line(
            (f"{tolerance:.0e}", f"{len(times)} of {wanted}", "yes" if ordered else "NO",
             f"{error:.1e}", f"{growth:.2g}", f"{limit:.0e}", result.figures.steps,
             f"{result.balance.relative:.1e}", seconds(wall)),
            ordered and error <= limit,
        )  # fmt: skip


def hoops(quick: bool) -> Iterable[Line]:
    """Random hoops on random slopes against the closed form, up to rounding."""
    model = frot.load(OWN_MODELS / "hoop.frot")
    count = 100 if quick else 1000
    for tolerance in (1e-6, 1e-9, 1e-12):
        chance = random.Random(SEED)
        worst, worst_set, failures, wrong = 0.0, "", [], 0
        phases: dict[str, int] = {}
        begun = time.perf_counter()
        for _ in range(count):
            hoop = _random_hoop(chance)
            error, order, failure = _compare(model, hoop, tolerance)
            if failure:
                failures.append(f"{hoop}: {failure}")
                continue
            phases[order[0]] = phases.get(order[0], 0) + 1
            wrong += not order[1]
            if error > worst:
                worst, worst_set = error, str(hoop)
        wall = time.perf_counter() - begun
        for failure in failures[:5]:
            say(f"hoop failed: {failure}")
        kinds = ", ".join(f"{n} {k}" for k, n in sorted(phases.items(), key=lambda p: -p[1]))
        say(f"worst hoop at {tolerance:g}: {worst_set}")
        yield Line(
            (f"{tolerance:.0e}", count, len(failures), wrong, f"{worst:.1e}", kinds,
             seconds(wall / count)),
            not failures and not wrong and worst <= 1e-10,
        )  # fmt: skip


def _random_hoop(chance: random.Random) -> Hoop:
    radius, mu = chance.uniform(0.05, 2.0), chance.uniform(0.05, 1.0)
    flip = (-1.0, 1.0)
    return Hoop(
        slope=math.radians(chance.uniform(-40, 40)) if chance.random() < 0.8 else 0.0,
        r=radius,
        mu=mu,
        delta=radius * mu * chance.uniform(0, 0.9) * (chance.random() < 0.7),
        v0=chance.choice(flip) * chance.uniform(0.1, 5.0),
        w0=chance.choice(flip) * chance.uniform(0.1, 20.0),
        stop=chance.uniform(0.5, 10.0),
    )


def _compare(
    model: frot.Model, hoop: Hoop, tolerance: float
) -> tuple[float, tuple[str, bool], str]:
    """Relative error at the end, phases and whether Frot's events are those, and a failure."""
    exact = hoop_motion(hoop, hoop.stop)
    title = "-".join(phase for _, phase in exact.changes)
    try:
        result = model.simulate(
            stop=hoop.stop,
            tolerance=tolerance,
            interval=hoop.stop,
            # The model counts angles anticlockwise.
            parameters={
                "slope": hoop.slope, "r": hoop.r, "mu": hoop.mu, "delta": hoop.delta,
                "v0": hoop.v0, "w0": -hoop.w0,
            },
        )  # fmt: skip
    except frot.FrotError as failure:
        return math.nan, (title, False), str(failure).strip().replace("\n", " ")[:300]
    end = result.at(hoop.stop)
    x, angle = float(end["x"]), -hoop.r * float(end["hoop.angle"])
    vx, vy = float(end["hoop.velocity.x"]), float(end["hoop.velocity.y"])
    v = vx * math.cos(hoop.slope) - vy * math.sin(hoop.slope)
    w = -hoop.r * float(end["hoop.angular_velocity"])
    wanted = (exact.x, hoop.r * exact.angle, exact.v, hoop.r * exact.w)
    length = max(abs(exact.x), abs(wanted[1]), abs(hoop.v0), hoop.r * abs(hoop.w0), 1e-3)
    error = max(abs(a - b) for a, b in zip((x, angle, v, w), wanted, strict=True)) / length
    # A change of phase is an event of that liaison near its exact time.
    near = all(
        any(abs(event.time - t) <= 1e-7 * (1 + t) for event in result.events)
        for t, _ in exact.changes[1:]
    )
    return error, (title, near), ""


PARTS: dict[str, tuple[str, str, tuple[str, ...], Callable[[bool], Iterable[Line]]]] = {
    "oscillator": (
        "Oscillator without friction",
        "Relative error of the energy and error of the phase (rad) after so many periods; the "
        "limit is one tolerance a period, beside rounding.",
        ("tolerance", "periods", "energy", "phase", "limit", "steps of the run", "wall"),
        oscillator,
    ),
    "rest": (
        "Block at rest on the incline",
        "Spread of the position and largest speed over 100 001 samples: both exactly zero.",
        ("rest", "until", "position (m)", "spread (m)", "fastest (m/s)", "steps", "wall"),
        rest,
    ),
    "stick_slip": (
        "Stick-slip of a dragged block",
        "Largest error of all event times (s), and that of the second half of the run over that of "
        "the first; the limit is one tolerance a period, beside rounding.",
        ("tolerance", "events", "in order", "error", "growth", "limit", "steps", "energy balance",
         "wall"),
        stick_slip,
    ),
    "hoops": (
        "Random hoops",
        f"Largest error of x, r angle and their rates over the largest length or speed (seed "
        f"{SEED}); the limit is 1e-10. `missed` counts runs without an event at a change of phase.",
        ("tolerance", "sets", "failed", "missed", "largest error", "phases", "wall of one"),
        hoops,
    ),
}  # fmt: skip


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--quick", action="store_true", help="a tenth of the length")
    parser.add_argument("--only", nargs="+", choices=list(PARTS), help="only these parts")
    parser.add_argument("-o", "--output", type=Path, default=RESULTS / "soak.md", help="the table")
    options = parser.parse_args()
    lines = ["# Long runs", "", *name_card()]
    bad = 0
    for name in options.only or PARTS:
        title, text, head, part = PARTS[name]
        say(f"-- {title}")
        rows: list[tuple[object, ...]] = []
        begun = time.perf_counter()
        try:
            for line in part(options.quick):
                verdict = "pass" if line.good else "EXCEEDED"
                rows.append((*line.cells, verdict))
                bad += not line.good
                say("  ".join(map(str, rows[-1])))
        except (frot.FrotError, ArithmeticError, KeyError, ValueError) as error:
            rows.append((f"FAILED: {type(error).__name__}: {error}", *[""] * len(head)))
            bad += 1
            say(str(rows[-1][0]))
        took = seconds(time.perf_counter() - begun)
        lines += ["", f"## {title}", "", f"{text} Took {took}.", ""]
        lines += table((*head, "verdict"), rows)
    write(options.output, lines)
    print("\n".join(lines))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
