"""What an impact costs in a run, beside an evaluation of the right-hand side.

Two runs of a scene with other largest steps have the same impacts and other numbers of steps: their
difference is the cost of a step, and what steps leave of a run is that of its impacts. An impact
is here all that an event adds: it is located, the law of impact solved, the modes found again, the
integration started anew.
"""

from __future__ import annotations

from dataclasses import dataclass

from peers import impacts_frot

import frot

REPEAT = 9
PARTS = (1.0, 0.0625)
# Texts, ends of runs, and times of flight between impacts: largest steps are parts of these.
SCENES = {
    "ball": (impacts_frot.ball(), 40.0, 0.28),
    "rocking block": (impacts_frot.block(), 15.0, 0.3),
    "nine balls": (impacts_frot.billiard(), 20.0, 0.1),
    "chain of ten rods": (impacts_frot.chain(), 1.0, 0.02),
}


@dataclass(frozen=True, slots=True)
class Cost:
    """Instants of impacts; of one of them evaluations and time; the time of an evaluation (s)."""

    impacts: int
    evaluations: float
    time: float
    evaluation: float


def measured() -> dict[str, Cost]:
    """The cost of an impact in each scene."""
    return {name: _cost(*scene) for name, scene in SCENES.items()}


def _cost(text: str, stop: float, flight: float) -> Cost:
    table = []
    for part in PARTS:
        model = frot.compile(text.replace(" s);", f" s, max_step = {part * flight} s);"))
        runs = [model.simulate(stop=stop, tolerance=1e-8, interval=stop) for _ in range(REPEAT)]
        one = runs[0]
        hits = len({e.time for e in one.events if e.kind.endswith("impact")})
        least = min(r.figures.wall_time for r in runs)
        table.append((one.figures.steps, hits, one.figures.evaluations, least))
    (steps, hits, evaluations, time), (more, _, fine, longer) = table
    each, slow = (fine - evaluations) / (more - steps), (longer - time) / (more - steps)
    left, spent = evaluations - each * steps, time - slow * steps
    return Cost(hits, left / hits, spent / hits, slow / each)
