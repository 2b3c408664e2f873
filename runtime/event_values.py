"""What decides an event, with its values just before and just after the instant."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from frot.runtime.run_report import STRIKES, Event


@dataclass(frozen=True, slots=True)
class Quantity:
    """A vector or number with its unit; `words`: its formula, where it has one."""

    parts: tuple[float, ...]
    unit: str
    words: str = ""

    @property
    def size(self) -> float:
        """Its length."""
        return math.hypot(*self.parts)

    def show(self, scale: float = 0.0) -> str:
        """The length with its unit; 0 where it is rounding beside `scale`."""
        size = self.size
        return f"{0.0 if size <= ROUNDING * scale else size:.6g} {self.unit}"

    def show_number(self) -> str:
        """A number with its unit, if it has one."""
        return f"{self.parts[0]:.6g}" + (f" {self.unit}" if self.unit != "1" else "")

    @property
    def signed(self) -> str:
        """A number with its sign and unit."""
        return f"{self.parts[0]:+.6g} {self.unit}" if len(self.parts) == 1 else self.show()


# Below this part of the value that a quantity had, it is zero: events are located to rounding.
ROUNDING = 1e-6
# Below this part of the slip that there was, the direction of a slip in space is rounding.
FAINT = 1e-9


@dataclass(frozen=True, slots=True)
class LawValues:
    """A law of friction: its slip, its friction, and what bounds it in motion and at rest."""

    kind: str
    slip: Quantity
    friction: Quantity
    limit: Quantity
    limit_s: Quantity

    @property
    def rest(self) -> Quantity:
        """The limit at rest, in the words of that of motion where both are equal."""
        return self.limit if self.limit.parts == self.limit_s.parts else self.limit_s


@dataclass(frozen=True, slots=True)
class ContactValues:
    """A contact: the speed at which its gap grows, its reaction along the normal."""

    speed: Quantity
    reaction: Quantity


@dataclass(frozen=True, slots=True)
class Side:
    """The law and the contact of an event at an instant; None where there is none, or no value."""

    law: LawValues | None = None
    contact: ContactValues | None = None


@dataclass(frozen=True, slots=True)
class Instant:
    """An event with what was there before it and what is there after it.

    `before` and `after`: None where no step comes before or after. `earlier`: at the begins of
    some steps before it, which give the sizes beside which a value is zero. `others` are the events
    of the same instant, `approach` the last begin of a step at which the slip is above `FAINT` of
    its largest, `ended` those whose infinitely many impacts end here; `variables` what the
    text may name, just after it.
    """

    event: Event
    before: Side | None
    after: Side | None
    earlier: tuple[Side, ...] = ()
    approach: Side | None = None
    others: tuple[Event, ...] = ()
    ended: tuple[Event, ...] = ()
    variables: Mapping[str, Quantity] = field(default_factory=dict)
    on_indeterminate: str = "rest"

    @property
    def laws(self) -> tuple[LawValues | None, LawValues | None]:
        """The law just before and just after."""
        return tuple(None if x is None else x.law for x in (self.before, self.after))  # type: ignore[return-value]

    @property
    def contacts(self) -> tuple[ContactValues | None, ContactValues | None]:
        """The contact just before and just after."""
        return tuple(None if x is None else x.contact for x in (self.before, self.after))  # type: ignore[return-value]

    def largest(self, name: str) -> float:
        """The largest size that a quantity of the law or of the contact had in the steps before."""
        sides = (*self.earlier, *((self.before,) if self.before else ()))
        found = [getattr(x, name, None) for side in sides for x in (side.law, side.contact)]
        return max((x.size for x in found if x is not None), default=0.0)

    @property
    def is_struck(self) -> bool:
        """Whether speeds jump here: by an impact or a percussion."""
        events = (self.event, *self.others)
        return any(x.kind in STRIKES for x in events)

    def beside(self) -> str:
        """The other liaisons of whose events this one may be the consequence, in words."""
        words = {"percussion": "the impulse '{}'", "condition": "the condition `{}`"}
        names = dict.fromkeys(
            words.get(x.kind, "'{}'").format(x.liaison)
            for x in self.others
            if x.liaison != self.event.liaison and x.kind not in _NO_CAUSE
        )
        return " and ".join(names)


_NO_CAUSE = ("several", "warning", "terminate")
# Events that end a motion: their direction is that of before.
_ENDS = ("stick", "roll_stop", "separation", "tangential_impact")
_MOVING = ("slip", "rolling")


def direction_of(instant: Instant) -> tuple[float, ...]:
    """The direction of the slip that begins, ends or continues: a unit vector, or +-1.

    Dry friction in motion is against the slip, which is zero at the instant itself. The direction
    of a slip that ends in space is that just before, where it is more than rounding. () where
    nothing slips, or the direction has no value.
    """
    ends = instant.event.kind in _ENDS
    mode = instant.event.before if ends else instant.event.after
    law = instant.laws[0 if ends else 1]
    if law is None or mode not in _MOVING:
        return ()
    near = instant.approach
    if ends and near is not None and near.law is not None and len(law.slip.parts) > 1:
        return _unit(near.law.slip.parts, 1)
    limit = max(law.limit.size, instant.largest("limit"))
    if law.friction.size > ROUNDING * limit:
        return _unit(law.friction.parts, -1)
    return _unit(law.slip.parts, 1)


def _unit(parts: tuple[float, ...], sign: int) -> tuple[float, ...]:
    size = math.hypot(*parts)
    return tuple(sign * x / size + 0.0 for x in parts) if size > 0 else ()
