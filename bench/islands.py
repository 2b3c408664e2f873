"""What the parts of a scene cost beside each other, and what an evaluation costs.

Times are of the kernel, start and run, the fastest of several; ratios are of one process, the two
scenes taking turns. Writes `results/islands.md`; exit status 1 when a target is missed.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from common import MODELS, RESULTS, median, name_card, say, table, write
from frot.runtime.engine import OK, Engine

import frot

PENDULUM = """  body arm: rod(mass = 1 kg, length = 1 m);
  liaison pin: rotoide(ground, arm.start);
"""


def blocks(count: int, kind: str, pendulum: bool, speed: float) -> str:
    """`count` blocks, each on an inclined line of its own, with a speed down it."""
    body, start = (
        (PENDULUM, "  pin.angle = 30 deg;\n  pin.speed = 0 rad/s;\n") if pendulum else ("", "")
    )
    for k in range(count):
        line = f"line(through = ({k}, 0) m, direction = (cos(slope), -sin(slope)))"
        body += f"  body b{k}: particle(mass = 1 kg);\n  curve l{k} on ground: {line};\n"
        body += f"  liaison s{k}: {kind.format(k)} with coulomb(mu);\n"
        start += f"  b{k}.position = ({k}, 0) m;\n"
        start += f"  b{k}.velocity = ({speed} m/s*cos(slope), -{speed} m/s*sin(slope));\n"
    return (
        "planar model Blocks\n  parameter Angle slope = 20 deg;\n  parameter Real mu = 0.5;\n"
        f"{body}initial\n{start}end Blocks;\n"
    )


def chain(count: int) -> str:
    """Rods in dry pins, all turning."""
    body, start, before = "", "", "ground"
    for k in range(count):
        body += f"  body r{k}: rod(mass = 1 kg, length = 0.5 m);\n"
        body += (
            f"  liaison p{k}: rotoide({before}, r{k}.start) with coulomb(0.1, radius = 10 mm);\n"
        )
        start += f"  p{k}.angle = {13 + 3 * k} deg;\n  p{k}.speed = 0.5 rad/s;\n"
        before = f"r{k}.tip"
    return f"planar model Chain\n{body}initial\n{start}end Chain;\n"


KEPT, PARTS = "point_courbe(b{0}, l{0})", "contact_ponctuel(l{0}, b{0})"


@dataclass(frozen=True, slots=True)
class Run:
    """Of one run of the kernel: seconds in start and run, steps, rejected ones, evaluations."""

    start: float
    run: float
    steps: int
    rejected: int
    evaluations: int

    @property
    def seconds(self) -> float:
        """Start and run."""
        return self.start + self.run


class Scene:
    """A compiled model that is run again and again."""

    def __init__(self, model: frot.Model, stop: float) -> None:
        """Run to `stop`, at tolerance 1e-9."""
        self._program, self._stop = model.program(), stop
        self.runs: list[Run] = []

    def once(self) -> None:
        """One run more."""
        engine = Engine(self._program)
        begun = time.process_time()
        if engine.start(0.0, 1e-9, "rest") != OK:
            raise RuntimeError(engine.fault_text)
        started = time.process_time()
        if engine.advance(self._stop).status != OK:
            raise RuntimeError(engine.fault_text)
        done = time.process_time()
        s = engine.statistics
        self.runs.append(Run(started - begun, done - started, s.steps, s.rejected, s.evaluations))

    @property
    def best(self) -> Run:
        """The fastest."""
        return min(self.runs, key=lambda run: run.seconds)

    def shown(self) -> tuple[str, ...]:
        """Cells: start, run, evaluations, microseconds each, rejected steps."""
        best = self.best
        tried = best.steps + best.rejected
        return (
            f"{1e3 * best.start:.2f} ms",
            f"{1e3 * best.run:.2f} ms",
            f"{1e3 * median([r.seconds for r in self.runs]):.2f} ms",
            str(best.evaluations),
            f"{1e6 * best.run / best.evaluations:.3f} us",
            f"{best.rejected} of {tried}",
        )


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--repeat", type=int, default=7, metavar="N", help="repetitions (7)")
    parser.add_argument("-o", "--output", type=Path, default=RESULTS / "islands.md")
    options = parser.parse_args()
    card = name_card()
    scenes = {
        "a pendulum, 100 s": Scene(frot.compile(blocks(0, KEPT, True, 0)), 100.0),
        "and 100 blocks at rest": Scene(frot.compile(blocks(100, KEPT, True, 0)), 100.0),
        "and 100 blocks that can part": Scene(frot.compile(blocks(100, PARTS, True, 0)), 100.0),
        "a block that slides to rest, 10 s": Scene(frot.compile(blocks(1, KEPT, False, 3)), 10.0),
        "60 of them": Scene(frot.compile(blocks(60, KEPT, False, 3)), 10.0),
        "slider crank, dry, 3 s": Scene(frot.load(MODELS / "slider_crank.frot"), 3.0),
        "chain of 10 dry pins, 1 s": Scene(frot.compile(chain(10)), 1.0),
    }
    for _ in range(max(1, options.repeat)):
        for scene in scenes.values():
            scene.once()
    for name, scene in scenes.items():
        say("  ".join((name, *scene.shown())))
    pendulum, kept, parts, one, sixty, crank, long = (s.best for s in scenes.values())

    def each(run: Run) -> float:
        return run.run / run.evaluations

    rejected = crank.rejected / (crank.steps + crank.rejected)
    goals: list[tuple[str, float, float, Callable[[float], str]]] = [
        (
            "100 idle blocks beside a pendulum, the run",
            kept.run / pendulum.run,
            1.2,
            "{:.2f}".format,
        ),
        ("the same, with the start", kept.seconds / pendulum.seconds, 1.2, "{:.2f}".format),
        ("100 idle contacts beside it, the run", parts.run / pendulum.run, 1.2, "{:.2f}".format),
        ("the same, with the start", parts.seconds / pendulum.seconds, 1.2, "{:.2f}".format),
        (
            "60 blocks that never meet, over one, an evaluation",
            each(sixty) / each(one),
            60,
            "{:.1f}".format,
        ),
        ("slider crank, an evaluation, us", 1e6 * each(crank), 2.5, "{:.2f}".format),
        ("its rejected steps", rejected, 0.05, "{:.1%}".format),
        ("10 dry pins, 1 s, ms", 1e3 * long.run, 20, "{:.0f}".format),
    ]
    missed = [what for what, value, goal, _ in goals if value > goal]
    rows = [
        (what, show(value), show(goal), "MISSED" if value > goal else "pass")
        for what, value, goal, show in goals
    ]
    head = ("scene", "start", "run", "both, median", "evaluations", "each", "rejected")
    lines = ["# Parts beside each other", "", *card, ""]
    lines += [f"Tolerance 1e-9; processor time of the kernel, fastest of {options.repeat}.", ""]
    lines += table(("what", "measured", "target", "verdict"), rows)
    lines += ["", *table(head, [(name, *scene.shown()) for name, scene in scenes.items()])]
    write(options.output, lines)
    for what in missed:
        print(f"missed: {what}")
    return bool(missed)


if __name__ == "__main__":
    sys.exit(main())
