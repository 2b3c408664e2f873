"""Values of a list of motions: laws, motions, parts, and how they are shown."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

# Names of frot_law_kind, and of the modes of frot_friction, by kind.
KINDS = ("slide", "roll", "pivot", "turn", "slip")
_VERBS = {
    "slide": ("sticks", "slips"),
    "roll": ("does not roll", "rolls"),
    "pivot": ("does not pivot", "pivots"),
    "turn": ("sticks", "turns"),
    "slip": ("sticks", "slips"),
}


@dataclass(frozen=True, slots=True)
class LawMode:
    """A law of friction in a motion.

    Attributes:
        liaison: The liaison, or the item of the text.
        kind: One of KINDS: what the law resists.
        moving: Whether it slips, or begins to.
        direction: +1 or -1 of a motion of one component; in space the unit vector of a slide in the
            axes of the world, () of a rolling.
        acceleration: Of the motion along its direction, m/s^2 or rad/s^2.
        since: The order of the time after the instant at which a motion first differs from zero.
        painleve: W_nn - mu W_nt.d of a slip, in 1/kg (1/kg over W_nn where coordinates keep the
            contact); None where there is none.
    """

    liaison: str
    kind: str
    moving: bool
    direction: tuple[float, ...]
    acceleration: float
    since: int
    painleve: float | None

    def __str__(self) -> str:
        """As "slips -"."""
        verb = _VERBS[self.kind][self.moving]
        if not self.direction:
            return verb
        if len(self.direction) == 1:
            return f"{verb} {'+' if self.direction[0] > 0 else '-'}"
        return f"{verb} along ({', '.join(f'{x:.6g}' for x in self.direction)})"


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """One admissible motion.

    Attributes:
        modes: `open`, `closed`, `stick` or `slip` of each liaison that has modes.
        laws: The laws of friction of closed contacts.
        values: All variables in this motion, in SI.
        others: Values with other reactions and the same accelerations.
        decided: Whether the known orders decide each inequality; else some hold with equality.
        family: Whether undetermined reactions decide the accelerations.
        springs: Whether these are then the reactions of equal springs; else the least ones.
        hardly: Whether it begins by no more than rounding.
    """

    modes: Mapping[str, str]
    laws: tuple[LawMode, ...]
    values: Mapping[str, float]
    others: tuple[Mapping[str, float], ...]
    decided: bool
    family: bool
    springs: bool
    hardly: bool
    accelerations: Mapping[str, float]
    reactions: Mapping[str, float]

    @property
    def rests(self) -> bool:
        """Whether every acceleration is zero."""
        return all(x == 0 for x in self.accelerations.values())

    def __getitem__(self, name: str) -> float:
        """A variable of the motion."""
        return self.values[name]

    def words(self) -> str:
        """As "floor slips -, wall opens"."""
        told: dict[str, list[str]] = {}
        for name, mode in self.modes.items():
            told[name] = ["opens"] if mode == "open" else []
        for law in self.laws:
            told.setdefault(law.liaison, []).append(str(law))
        return ", ".join(
            f"{name} {' and '.join(x or ['stays closed'])}" for name, x in told.items()
        )


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """Liaisons that act on each other, and their motions; no motion: an impasse."""

    liaisons: tuple[str, ...]
    motions: tuple[Motion, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Motions:
    """The admissible motions of a state, part after part; each choice of one of each is a motion.

    Attributes:
        model: Its name.
        time: In s.
        parts: What acts on each other.
        complete: Whether no motion is left out; else the search ended before.
        proved: Whether that is proved; slips of several components are searched from many starts.
        highest: The highest order of the time after the instant that is known.
        nodes: Combinations of modes that were examined.
        before: Impacts and percussions at the same instant that come before these motions.
        beside: Impacts without collision that are admissible as well, at the start of a run.
    """

    model: str
    time: float
    parts: tuple[Part, ...]
    complete: bool
    proved: bool
    highest: int
    nodes: int
    before: tuple[str, ...] = ()
    beside: tuple[str, ...] = ()

    def __iter__(self) -> Iterator[Motion]:
        """The motions of all parts."""
        return (motion for part in self.parts for motion in part.motions)

    def __getitem__(self, k: int) -> Motion:
        """Motion k of all parts."""
        return list(self)[k]

    def __len__(self) -> int:
        """The number of motions of the whole: the product over the parts."""
        return math.prod(len(part.motions) for part in self.parts)

    def __str__(self) -> str:
        """In words; what `frot motions` prints."""
        return "\n".join(self.lines())

    def lines(self) -> Iterator[str]:
        """The words, line by line."""
        yield f"{self.model} at t = {self.time:.12g} s: {_count(len(self))}"
        for text in self.before:
            yield f"  after {text}"
        for part in self.parts:
            if len(self.parts) > 1:
                yield f"  {', '.join(part.liaisons)}: {_count(len(part.motions))}"
            for k, motion in enumerate(part.motions, 1):
                yield from _motion_lines(k, motion)
        for text in self.beside:
            yield f"  an impact without collision is admissible: {text}"
        if not self.complete:
            yield "  the search ended before all combinations were examined: there may be others"
        elif not self.proved:
            yield "  slips in space are searched from many starts: the list is not proved complete"
        if self.highest == 0:
            yield "  only accelerations are compared: rates of loads are not known for this model"

    def as_data(self) -> dict[str, Any]:
        """For JSON: numbers, texts, lists."""
        return {
            "model": self.model,
            "time": self.time,
            "count": len(self),
            "complete": self.complete,
            "proved": self.proved,
            "highest_order": self.highest,
            "nodes": self.nodes,
            "impacts_before": list(self.before),
            "impacts_beside": list(self.beside),
            "parts": [
                {
                    "liaisons": list(part.liaisons),
                    "motions": [_motion_data(motion) for motion in part.motions],
                }
                for part in self.parts
            ],
        }


def _count(n: int) -> str:
    if n == 0:
        return "no admissible motion (impasse)"
    return "one admissible motion" if n == 1 else f"{n} admissible motions"


def _motion_lines(k: int, motion: Motion) -> Iterator[str]:
    yield f"  {k}. {motion.words() or 'nothing may part or slip'}"
    for law in motion.laws:
        if not law.moving:
            continue
        parts = [f"acceleration {law.acceleration:.6g}"]
        if law.since:
            parts.append(f"from order {law.since} on")
        if law.painleve is not None:
            parts.append(f"p = {law.painleve:.6g}")
        yield f"       {law.liaison}: {law.kind}, {', '.join(parts)}"
    moving = {name: x for name, x in motion.accelerations.items() if x != 0}
    yield f"       {_table(moving)}" if moving else "       rest: all accelerations are zero"
    shown = [name for name in motion.reactions if _is_shown(name, motion.reactions)]
    if shown:
        yield f"       {_table({name: motion.reactions[name] for name in shown})}"
    for other in motion.others:
        own = {name: other[name] for name in shown}
        yield f"       or, with the same accelerations: {_table(own)}"
    if motion.family:
        which = "those of equal springs" if motion.springs else "the least ones"
        yield f"       reactions that are not determined decide these accelerations: {which}"
    if motion.hardly:
        yield "       it begins by no more than rounding"
    if not motion.decided:
        yield "       some inequalities hold with equality: a reaction stays at its bound"


def _is_shown(name: str, reactions: Mapping[str, float]) -> bool:
    """Not the components of what normal and tangential forces say, nor couples that are zero."""
    liaison, _, _ = name.partition(".")
    if f"{liaison}.normal_force" in reactions and ".force." in name:
        return False
    return ".torque" not in name or reactions[name] != 0


def _table(values: Mapping[str, float]) -> str:
    return ", ".join(f"{name} = {x:.6g}" for name, x in values.items())


def _motion_data(motion: Motion) -> dict[str, Any]:
    return {
        "modes": dict(motion.modes),
        "laws": [
            {name: getattr(law, name) for name in LawMode.__dataclass_fields__}
            for law in motion.laws
        ],
        "accelerations": dict(motion.accelerations),
        "reactions": dict(motion.reactions),
        "other_reactions": [{name: x[name] for name in motion.reactions} for x in motion.others],
        "decided": motion.decided,
        "accelerations_depend_on_undetermined_reactions": motion.family,
        "reactions_of_equal_springs": motion.springs,
        "hardly_moves": motion.hardly,
    }
