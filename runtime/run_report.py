"""What a run reports beside its values: events, balance of energy, drifts, figures."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

KINDS = (
    "stick",
    "slip",
    "reversal",
    "separation",
    "contact",
    "roll_stop",
    "roll_start",
    "roll_reversal",
    "reaction",
    "condition",
    "several",
    "warning",
    "terminate",
    "impact",
    "last_impact",
    "tangential_impact",
    "percussion",
)
# Those at which speeds jump.
STRIKES = ("impact", "last_impact", "tangential_impact", "percussion")
MODES = ("open", "stick", "slip")
ROLLING = ("free", "held", "rolling", "rolling")


@dataclass(frozen=True, slots=True)
class Event:
    """A change of mode: `kind` of KINDS, `liaison`, modes `before` and `after`, time in s.

    Of an impact: the normal `impulse` of the liaison in N.s, the `energy_lost` there in J, the
    number of `contacts` that met at the instant and of `phases` of slip, stick and compression.
    `last_impact`: the last of infinitely many impacts, which end at the time `until`.
    Of a percussion `liaison` is its name, `vector` its impulse in ground axes, `impulse` the length
    of that; the first of an instant has less their work as `energy_lost`.
    `element`: of a motion that begins, ends or reverses its place in `Engine.laws`, else -1.
    """

    time: float
    kind: str
    liaison: str
    before: str
    after: str
    text: str
    impulse: float = 0.0
    energy_lost: float = 0.0
    contacts: int = 0
    phases: int = 0
    until: float | None = None
    element: int = -1
    vector: tuple[float, ...] = ()

    @property
    def measures(self) -> dict[str, Any]:
        """Of an impact or percussion its numbers by their names, none of other events."""
        if self.kind == "percussion":
            names = ("impulse", "energy_lost", "vector")
            return {name: getattr(self, name) for name in names}
        if not self.kind.endswith("impact"):
            return {}
        found: dict[str, Any] = {
            "impulse": self.impulse,
            "energy_lost": self.energy_lost,
            "contacts": self.contacts,
            "phases": self.phases,
        }
        return found if self.until is None else {**found, "until": self.until}

    def as_data(self) -> dict[str, Any]:
        """For JSON."""
        names = ("time", "kind", "liaison", "before", "after", "text")
        return {**{name: getattr(self, name) for name in names}, **self.measures}


@dataclass(frozen=True, slots=True)
class Balance:
    """Energy at the end: `residual` of kinetic + potential + dissipated - work, in J.

    `scale` is the largest of the energies that took part, and no less than the rounding
    of their terms, the forces times the places they act at; `relative` the quotient of both.
    """

    residual: float
    scale: float
    mechanical: float
    dissipated: float
    work: float

    @property
    def relative(self) -> float:
        """Residual over scale; 0 where nothing had energy."""
        return abs(self.residual) / self.scale if self.scale > 0 else 0.0


@dataclass(frozen=True, slots=True)
class Drift:
    """A first integral in a run: its `value` at the start, how far it went from that, in `unit`.

    `largest` is the largest size it had, or what it is the sum of.
    """

    value: float
    drift: float
    largest: float
    unit: str

    @property
    def relative(self) -> float:
        """Drift over the largest size; 0 where that is zero."""
        return self.drift / self.largest if self.largest > 0 else 0.0


@dataclass(frozen=True, slots=True)
class Figures:
    """Statistics of the run: accepted and rejected steps, evaluations, wall time of the kernel (s).

    `unsearched`: instants with so many possible modes that one motion was found, and others were
    not looked for. `crossings`: steps through postures in which the relations of a loop depend on
    each other: the motion goes straight on there. `blurred`: the largest error of a step, relative
    to what moves, that rounding may have made beyond the tolerance. `free`: speeds at the
    start that no liaison holds. `masked`: what part of an acceleration may be rounding, at the
    start, where a light body is held between heavy ones and its own inertia is lost among those
    that its joint carries. `lost`: what part of the state `lost_state` rounding of the rates has
    made, where that is far above the tolerance; else 0. `springs`: steps in which redundant
    contacts slide, `spring` among them: their reactions are those of equal springs.
    """

    steps: int
    rejected: int
    evaluations: int
    wall_time: float
    unsearched: int = 0
    crossings: int = 0
    blurred: float = 0.0
    free: int = -1
    masked: float = 0.0
    lost: float = 0.0
    lost_state: str = ""
    springs: int = 0
    spring: str = ""
