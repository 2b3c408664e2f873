"""What `frot check` says of a mechanism: mobility and liaisons."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from frot.compiler.mechanics.mechanism import (
    Mechanism,
    Mobility,
    freedoms_of,
    is_unilateral,
    mobility,
    relations_of,
)
from frot.dsl.checked import (
    BodyGeometry,
    BodyPoint,
    CurvePlace,
    Equation,
    Liaison,
    Model,
    Place,
)
from frot.dsl.statements.connections import UNCONNECTED
from frot.dsl.statements.equations import count


@dataclass(frozen=True, slots=True)
class LiaisonLine:
    """One liaison in words: its relations and how they are kept."""

    name: str
    text: str
    relations: int
    unilateral: bool
    kept: str


@dataclass(frozen=True, slots=True)
class Report:
    """Mobility and liaisons of a model; `str()` gives the text.

    `unconnected` are connectors through which nothing flows, because nothing is connected there.
    """

    model: str
    world: str
    unknowns: int
    equations: int
    events: int
    bodies: tuple[tuple[str, str, int], ...]
    liaisons: tuple[LiaisonLine, ...]
    mobility: Mobility
    unconnected: tuple[str, ...] = ()

    def __str__(self) -> str:
        m = self.mobility
        if not (self.bodies or self.liaisons):
            return "\n".join([f"{self.model}: equations only", *self._counts()])
        freedoms = ", ".join(f"{name} {count}" for name, _, count in self.bodies) or "none"
        lines = [
            f"{self.model}: {self.world}, bodies {len(self.bodies)}, liaisons {len(self.liaisons)}",
            f"  freedoms of the bodies  {m.freedoms}  ({freedoms})",
            f"  bilateral relations     {m.bilateral}",
            f"  unilateral relations    {m.unilateral}",
            f"  degrees of freedom      {m.degrees_of_freedom}"
            + (
                f"  ({m.degrees_of_freedom - m.unilateral} with every contact closed)"
                if m.unilateral
                else ""
            ),
        ]
        if m.degrees_of_freedom - m.unilateral < 0:
            lines.append(
                "  counted as if all relations were independent; the run keeps those that are"
            )
        lines += self._counts()
        width = max((len(x.name) for x in self.liaisons), default=0)
        for liaison in self.liaisons:
            nature = "unilateral" if liaison.unilateral else "bilateral"
            lines.append(f"  {liaison.name:<{width}}  {liaison.text}")
            relations = f"{liaison.relations} relation{'s' if liaison.relations > 1 else ''}"
            lines.append(f"  {'':<{width}}  {relations}, {nature}; {liaison.kept}")
        return "\n".join(lines)

    def _counts(self) -> list[str]:
        """The line on the text's own equations, where there are some."""
        if not (self.unknowns or self.equations or self.events):
            return []
        events = f", events {self.events}" if self.events else ""
        lines = [f"  variables {self.unknowns}, equations {self.equations}{events}"]
        if self.unconnected:
            lines.append(f"  connected to nothing: {', '.join(self.unconnected)}")
        return lines


def report_of(mechanism: Mechanism) -> Report:
    """The report of a mechanism and the equations of its text."""
    model = mechanism.model
    unknowns = sum(v.type.count for v in model.variables if not v.discrete)
    counts = unknowns, sum(count(e) for e in model.equations), len(model.whens)
    return Report(
        model.name,
        "planar" if model.planar else "space",
        *counts,
        tuple(
            (b.name, b.shape.name, freedoms_of(b, model.planar))
            for b in model.bodies
            if b.shape is not None
        ),
        tuple(_line(liaison, mechanism) for liaison in model.liaisons),
        mobility(mechanism),
        tuple(dict.fromkeys(_unconnected(model))),
    )


def _unconnected(model: Model) -> Iterator[str]:
    for equation in model.equations:
        if isinstance(equation, Equation) and equation.connection.startswith(UNCONNECTED):
            yield equation.connection.removeprefix(UNCONNECTED)


def _line(liaison: Liaison, mechanism: Mechanism) -> LiaisonLine:
    laws = ", ".join(
        f"{law.kind.name}({', '.join(f'{k} = {v.span.text}' for k, v in law.arguments.items())})"
        for law in liaison.laws
    )
    text = f"{liaison.kind.name}({_place(liaison.a)}, {_place(liaison.b)})"
    ideal = any(c.liaison is liaison for c in mechanism.ideal)
    reduced = ideal or any(c.liaison is liaison and c.reduced for c in mechanism.contacts)
    kept = "built into the coordinates" if reduced else "kept by its reaction and projection"
    if is_unilateral(liaison):
        kept = "opens and closes by events"
    return LiaisonLine(
        liaison.name,
        f"{text} with {laws}" if laws else f"{text}, without friction",
        relations_of(liaison, mechanism.model.planar),
        is_unilateral(liaison),
        kept,
    )


def _place(place: Place) -> str:
    match place:
        case BodyPoint() | BodyGeometry():
            return f"{place.body.name}.{place.name}"
        case CurvePlace():
            owner = place.curve.owner.name
            return f"{owner}.{place.curve.name}" if place.curve.span is None else place.curve.name
        case _:
            return place.name
