"""The report of a mechanism, as data and in words."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

from frot.compiler.mechanics.liaisons.kinematic_relations import is_row, prescribed_rates
from frot.compiler.mechanics.mechanism import (
    Mechanism,
    freedoms_of,
    is_unilateral,
    relations_of,
)
from frot.compiler.report.paradox_lines import paradox_lines
from frot.compiler.translate.walk import follows_time, has_time, subexpressions
from frot.dsl.checked import (
    Body,
    BodyGeometry,
    BodyPoint,
    CurvePlace,
    Equation,
    Expression,
    Frame,
    Input,
    Law,
    Liaison,
    Model,
    Place,
    Reference,
    SurfacePlace,
)
from frot.dsl.names.connections import UNCONNECTED
from frot.dsl.statements.equations import count

TYPE_CHECKING = False
if TYPE_CHECKING:
    from frot.compiler.report.analysis import Analysis, LoopLine


@dataclass(frozen=True, slots=True)
class LiaisonLine:
    """One liaison in words: its relations and how they are kept.

    `kinematic` of its relations are between velocities; `holonomic`: whether these are the rates of
    relations between places all the same, in this mechanism (None: not known); `moves_with_time`:
    whether they hang on time or inputs.
    """

    name: str
    text: str
    relations: int
    unilateral: bool
    kept: str
    kinematic: int
    holonomic: bool | None
    moves_with_time: bool


@dataclass(frozen=True, slots=True)
class Mobility:
    """Free coordinates of the bodies, their relations by number, and what is left.

    `classes` are the numbers of liaisons that keep one, two, ... relations, of those that always
    hold. `independent` of these relations are so in general position near the start,
    `independent_at_start` there. `touching` contacts that may part touch at the start,
    `touching_independent` of them are independent there.
    """

    freedoms: int
    bilateral: int
    unilateral: int
    classes: tuple[tuple[int, int], ...]
    independent: int
    independent_at_start: int
    touching: int
    touching_independent: int

    @property
    def degrees_of_freedom(self) -> int:
        """Of all motions that the relations leave which always hold."""
        return self.freedoms - self.independent

    @property
    def hyperstatic(self) -> int:
        """The number of redundant relations."""
        return self.bilateral - self.independent


@dataclass(frozen=True, slots=True)
class Report:
    """Mobility, liaisons and what is constant; `str()` gives the text.

    `bodies` with their shapes and freedoms. `unconnected` are connectors through which nothing
    flows, because nothing is connected there. `analysis` is None where there are no bodies.
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
    analysis: Analysis | None = None

    def __str__(self) -> str:
        if not (self.bodies or self.liaisons):
            return "\n".join([f"{self.model}: equations only", *self._counts()])
        lines = [
            f"{self.model}: {self.world}, bodies {len(self.bodies)}, liaisons {len(self.liaisons)}"
        ]
        lines += self._mobility()
        if self.analysis is not None:
            lines += _found(self.analysis)
        lines += self._counts()
        width = max((len(x.name) for x in self.liaisons), default=0)
        for liaison in self.liaisons:
            lines.append(f"  {liaison.name:<{width}}  {liaison.text}")
            lines.append(f"  {'':<{width}}  {_nature(liaison)}; {liaison.kept}")
        return "\n".join(lines)

    def _mobility(self) -> Iterator[str]:
        m = self.mobility
        freedoms = ", ".join(f"{name} {count}" for name, _, count in self.bodies) or "none"
        kinds = sorted(Counter(n for _, _, n in self.bodies).items())
        summed = " + ".join(f"{k}*{n}" for k, n in kinds)
        yield f"  free coordinates        {m.freedoms}" + (f"  = {summed}" if summed else "")
        yield f"                          {freedoms}"
        sums = " + ".join(f"{k}*{n}" for k, n in m.classes)
        yield f"  bilateral relations     {m.bilateral}" + (f"  = {sums}" if sums else "")
        yield f"  unilateral relations    {m.unilateral}"
        closed = ""
        if m.touching:
            left = m.freedoms - m.independent_at_start - m.touching_independent
            closed = f"  ({left} with the contacts that touch at the start)"
        counted = self.analysis is not None and not self.analysis.found
        if counted:
            closed = "  (where no relation follows from others)"
        yield f"  degrees of freedom      {m.degrees_of_freedom}{closed}"
        if self.bodies and m.degrees_of_freedom <= 0 and not counted:
            names = ", ".join(f"'{x.name}'" for x in self.liaisons)
            yield f"  nothing can move by itself: the liaisons {names} hold all bodies"
        if m.independent_at_start < m.independent:
            more = m.freedoms - m.independent_at_start
            yield f"  singular start          {more} degrees of freedom there"
        if m.touching > m.touching_independent:
            extra = m.touching - m.touching_independent
            yield f"  hyperstatic contacts    {extra} of the {m.touching} that touch at the start:"
            rules = "reactions of least norm at rest, of equal springs while sliding"
            yield f"{'':28}{rules}"

    def _counts(self) -> list[str]:
        """The line on the text's own equations, where there are some."""
        if not (self.unknowns or self.equations or self.events):
            return []
        events = f", events {self.events}" if self.events else ""
        lines = [f"  variables {self.unknowns}, equations {self.equations}{events}"]
        if self.unconnected:
            lines.append(f"  connected to nothing: {', '.join(self.unconnected)}")
        return lines


def _found(analysis: Analysis) -> Iterator[str]:
    """Results of the analysis, in words."""
    if not analysis.found:
        yield f"  no more is told         {analysis.missing}"
        return
    for name, number in analysis.uncounted:
        yield f"  taken as independent    the {number} relations that {name} belongs to: too many"
    for loop in analysis.loops:
        yield from _loop(loop)
    texts = [
        x.text if x.always else f"{x.text} (with these parameters)" for x in analysis.integrals
    ]
    yield f"  first integrals         {texts[0] if texts else 'none found'}"
    yield from (f"                          {text}" for text in texts[1:])
    if speeds := analysis.energy_alone:
        yield f"                          (of {speeds} speeds no other is looked for)"
    for k, paradox in enumerate(analysis.paradoxes):
        for j, line in enumerate(paradox_lines(paradox)):
            yield f"  {'' if k or j else 'paradox possible':<22}  {line}"


def _loop(loop: LoopLine) -> Iterator[str]:
    too_many = f"{loop.degree} relation{'s' if loop.degree > 1 else ''} too many"
    yield f"  hyperstatic             {too_many}: {' - '.join(loop.path)}"
    parts = ", ".join(f"{name} {n}" for name, n in loop.undetermined)
    yield f"    undetermined components of the reactions: {parts}"
    if loop.cure:
        changes = [f"{name} as {kind}" if kind else f"no {name}" for name, kind in loop.cure]
        then = f"{loop.left} too many" if loop.left else "isostatic"
        yield f"    {then} with {', '.join(changes)}"


def _nature(line: LiaisonLine) -> str:
    many = f"{line.relations} relation{'' if line.relations == 1 else 's'}"
    parts = [f"{many}, {'unilateral' if line.unilateral else 'bilateral'}"]
    if line.kinematic:
        between = "" if line.kinematic == line.relations else f"{line.kinematic} "
        known = {True: "holonomic", False: "not holonomic", None: "holonomic or not"}
        parts.append(f"{between}kinematic, {known[line.holonomic]}")
    else:
        parts.append("geometric")
    if line.moves_with_time:
        parts.append("time-dependent")
    return ", ".join(parts)


def report_of(mechanism: Mechanism, analysis: Analysis | None) -> Report:
    """The report of a mechanism and the equations of its text."""
    model = mechanism.model
    unknowns = sum(v.type.count for v in model.variables if not v.discrete)
    counts = unknowns, sum(count(e) for e in model.equations), len(model.whens)
    counted = relations_of(mechanism)
    return Report(
        model.name,
        "planar" if model.planar else "space",
        *counts,
        tuple(
            (b.name, b.shape.name, freedoms_of(b, model))
            for b in model.bodies
            if b.shape is not None
        ),
        tuple(_line(x, n, mechanism, analysis) for x, n in counted.items()),
        _mobility(model, counted, analysis),
        tuple(dict.fromkeys(_unconnected(model))),
        analysis,
    )


def _mobility(model: Model, counted: dict[Liaison, int], analysis: Analysis | None) -> Mobility:
    held = [n for x, n in counted.items() if not is_unilateral(x)]
    bilateral = sum(held)
    ranks = (bilateral, bilateral, 0, 0)
    if analysis is not None:
        ranks = (
            *(analysis.independent, analysis.independent_at_start),
            *(analysis.touching, analysis.touching_independent),
        )
    return Mobility(
        sum(freedoms_of(b, model) for b in model.bodies),
        bilateral,
        sum(n for x, n in counted.items() if is_unilateral(x)),
        tuple(sorted(Counter(n for n in held if n).items())),
        *ranks,
    )


def _unconnected(model: Model) -> Iterator[str]:
    for equation in model.equations:
        if isinstance(equation, Equation) and equation.connection.startswith(UNCONNECTED):
            yield equation.connection.removeprefix(UNCONNECTED)


def _law(law: Law) -> str:
    """A law with the arguments that the text gives; defaults have the place of the whole law."""
    given = ((k, v.span.text) for k, v in law.arguments.items() if v.span != law.span)
    return f"{law.kind.name}({', '.join(f'{k} = {text}' for k, text in given)})"


def _line(
    liaison: Liaison, relations: int, mechanism: Mechanism, analysis: Analysis | None
) -> LiaisonLine:
    laws = ", ".join(map(_law, liaison.laws))
    text = f"{liaison.kind.name}({_place(liaison.a)}, {_place(liaison.b)})"
    links = [x for x in (*mechanism.contacts, *mechanism.ideal) if x.liaison is liaison]
    built = [x.reduced or x in mechanism.ideal for x in links if not x.repeats]
    freed = [x for x in liaison.relations if not is_row(x)]
    built_in = any(built) and (not freed or len(freed) < relations)
    ways = ["built into the coordinates"] * built_in
    if not built or not all(built):
        ways.append("kept by its reaction and projection")
    if freed:
        ways.append("kept by an equation of the text each")
    kept = ", the rest ".join(ways)
    if is_unilateral(liaison):
        kept = "opens and closes by events"
    kinematic = sum(x.kinematic for link in links for x in link.held)
    kinematic += sum(x.kinematic for x in freed)
    known = dict(analysis.holonomic) if analysis is not None else {}
    holonomic = known.get(liaison.name) if kinematic else True
    rates = prescribed_rates(liaison).values()
    kinematic += sum(x.type.count for x in rates)
    # a velocity that is a value of time is the rate of a place that is one
    if not all(follows_time(x, switching=True) for x in rates):
        holonomic = None if holonomic else holonomic
    return LiaisonLine(
        liaison.name,
        f"{text} with {laws}" if laws else f"{text}, without friction",
        relations,
        is_unilateral(liaison),
        kept,
        kinematic,
        holonomic,
        any(_changes(x) for x in _expressions(liaison)),
    )


def _changes(value: Expression) -> bool:
    """Whether time or an input is in an expression."""
    return has_time(value) or any(
        isinstance(node, Reference) and isinstance(node.target, Input)
        for node in subexpressions(value)
    )


def _expressions(liaison: Liaison) -> Iterator[Expression]:
    """Expressions of the relations of a liaison, with its places."""
    yield from liaison.driven.values()
    yield from liaison.options.values()
    for relation in liaison.relations:
        yield from (relation.left, relation.right)
    for place in (liaison.a, liaison.b):
        owner: Body | Frame | None = place if isinstance(place, Frame) else None
        if isinstance(place, CurvePlace):
            owner = place.curve.owner
            yield from place.curve.arguments.values()
        elif isinstance(place, SurfacePlace):
            owner = place.surface.owner
            yield from place.surface.arguments.values()
        while isinstance(owner, Frame):
            yield from (x for x in (owner.origin, owner.angle) if x is not None)
            owner = owner.owner


def _place(place: Place) -> str:
    match place:
        case BodyPoint() | BodyGeometry():
            return f"{place.body.name}.{place.name}"
        case CurvePlace():
            owner = place.curve.owner.name
            return f"{owner}.{place.curve.name}" if place.curve.span is None else place.curve.name
        case _:
            return place.name
