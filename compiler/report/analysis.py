"""Numerical analysis of a mechanism: freedoms, redundant relations, integrals, paradoxes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from frot.compiler.equations.assembled import Assembled
from frot.compiler.equations.reduced import Reduced
from frot.compiler.lowering.initial_problem import InitialProblem
from frot.compiler.mechanics.constraint import Constraint
from frot.compiler.mechanics.free_bodies import free
from frot.compiler.mechanics.liaisons.user_liaisons import bodies_of
from frot.compiler.mechanics.mechanism import (
    Mechanism,
    is_unilateral,
    relations_of,
)
from frot.compiler.report.candidates import place_body
from frot.compiler.report.first_integrals import MOST_SPEEDS, find_first_integrals
from frot.compiler.report.holonomy import non_holonomic
from frot.compiler.report.isostatic_alternatives import find_cure
from frot.compiler.report.paradox import find_paradoxes
from frot.compiler.report.redundancy import Loop, find_loops, find_ranks
from frot.compiler.report.relations import make_relations
from frot.compiler.report.start import Start, find_start, may_part, posture_of
from frot.dsl import default_values
from frot.dsl.checked import Body, Liaison
from frot.dsl.messages.interrupts import raise_noted_interrupt

# Ranks of more relations than these take long: they are counted, and nothing more is said.
MOST_RELATIONS = 1200


@dataclass(frozen=True, slots=True)
class LoopLine:
    """Liaisons that keep what others keep: `degree` too many, in the loop `path` (ground, A, ...).

    `undetermined`: how many components of each one's reaction equilibrium does not tell. `cure`:
    liaisons and what they may be replaced by ("" where they may be left out); `left` relations are
    too many still.
    """

    degree: int
    path: tuple[str, ...]
    undetermined: tuple[tuple[str, int], ...]
    cure: tuple[tuple[str, str], ...]
    left: int


@dataclass(frozen=True, slots=True)
class IntegralLine:
    """A first integral in words; `always`: for all parameters, else at their defaults."""

    text: str
    always: bool


@dataclass(frozen=True, slots=True)
class ParadoxLine:
    """A liaison with friction `mu` that may have no motion, or several, from a coefficient on.

    From `at_start` at the posture of the start, from `least` in the worst posture that was found,
    which has the coordinates `where` and closed contacts `beside`; None is: at no coefficient, or
    not looked for.
    """

    liaison: str
    mu: float
    at_start: float | None
    least: float | None
    where: tuple[tuple[str, float], ...]
    beside: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Analysis:
    """Results of the analysis; `missing`: why some are missing, or "".

    `uncounted`: parts of too many relations, by their first liaison, with that number: all are
    taken as independent. `energy_alone`: the number of speeds where they are so many that no other
    first integral is looked for, else 0.

    `independent` relations in general position near the start, `independent_at_start` there;
    `touching` contacts touch at the start, `touching_independent` of them independently.
    `holonomic` of the liaisons with relations between velocities: None where it was not examined.
    """

    missing: str
    independent: int
    independent_at_start: int
    touching: int
    touching_independent: int
    loops: tuple[LoopLine, ...]
    holonomic: tuple[tuple[str, bool | None], ...]
    integrals: tuple[IntegralLine, ...] = ()
    paradoxes: tuple[ParadoxLine, ...] = ()
    uncounted: tuple[tuple[str, int], ...] = ()
    energy_alone: int = 0

    @property
    def found(self) -> bool:
        """Whether the posture of the start was, without which little is said."""
        return not self.missing


def analyse(system: Assembled, problem: InitialProblem | None) -> Analysis:
    """What the mechanism of a system allows; `problem` is None where it could not be posed."""
    reduced = system.reduced
    mechanism = reduced.mechanism
    whole = _count(mechanism)
    start = None if problem is None else find_start(system, problem)
    if start is None or not start.found:
        return Analysis("the start was not found", whole, whole, 0, 0, (), ())
    found = _Found()
    for part in _parts(mechanism):
        raise_noted_interrupt()
        _look(part, system, start, found)
    integrals = find_first_integrals(reduced, start.posture)
    speeds = int(reduced.symbols.v.numel())
    return Analysis(
        missing="",
        independent=whole - found.dependent,
        independent_at_start=whole - found.dependent_at_start,
        touching=found.touching,
        touching_independent=found.touching_independent,
        loops=tuple(found.loops),
        holonomic=tuple(found.holonomic),
        integrals=tuple(IntegralLine(x.text, x.always) for x in integrals),
        paradoxes=tuple(_paradoxes(reduced, start)),
        uncounted=tuple(found.uncounted),
        energy_alone=speeds if speeds > MOST_SPEEDS else 0,
    )


@dataclass(slots=True)
class _Found:
    """Sums over the parts of a mechanism."""

    dependent: int = 0
    dependent_at_start: int = 0
    touching: int = 0
    touching_independent: int = 0
    loops: list[LoopLine] = field(default_factory=list)
    holonomic: list[tuple[str, bool | None]] = field(default_factory=list)
    uncounted: list[tuple[str, int]] = field(default_factory=list)


def _count(mechanism: Mechanism) -> int:
    """All relations that always hold."""
    return sum(n for x, n in relations_of(mechanism).items() if not is_unilateral(x))


def _ends(liaison: Liaison) -> tuple[Body, ...]:
    """The bodies of its places; a relation of the user may read more of them."""
    read = (body for relation in liaison.relations for body in bodies_of(relation))
    return (place_body(liaison.a), place_body(liaison.b), *read)


def looped(mechanism: Mechanism) -> list[Liaison]:
    """The liaisons whose relations may depend on others.

    One by which a body hangs that nothing else holds is left out, and so on from the ends of trees.
    """
    left = {x: _ends(x) for x in mechanism.model.liaisons}
    rolling = {x.liaison for x in (*mechanism.contacts, *mechanism.ideal) if x.rolls}
    simple = {x for x in left if not (x.relations or x in rolling or is_unilateral(x))}
    while True:
        held: dict[Body, list[Liaison]] = {}
        for liaison, ends in left.items():
            for body in set(ends):
                held.setdefault(body, []).append(liaison)
        leaves = {
            own[0]
            for body, own in held.items()
            if body.shape is not None and len(own) == 1 and own[0] in simple
        }
        if not leaves:
            return list(left)
        for liaison in leaves:
            del left[liaison]


def _parts(mechanism: Mechanism) -> Iterator[list[Liaison]]:
    """Liaisons in the groups that bodies, but for the ground, connect; those that part together."""
    wanted = looped(mechanism)
    parting: list[Liaison] = []
    while wanted:
        part = _connected(wanted[0], wanted)
        inside = set(part)
        wanted = [x for x in wanted if x not in inside]
        if all(is_unilateral(x) for x in part):
            parting += part
        else:
            yield part
    if parting:
        yield parting


def _look(part: list[Liaison], system: Assembled, start: Start, found: _Found) -> None:
    """Ranks in general position and at the start, loops, holonomy of one part."""
    mechanism = system.reduced.mechanism
    counts = relations_of(mechanism)
    count = sum(counts[x] for x in part)
    if count > MOST_RELATIONS:
        found.uncounted.append((part[0].name, count))
        return
    freed = free(mechanism, part)
    relations = make_relations(freed, _parting(freed))
    here = posture_of(relations, system, start)
    relations = relations.measured(here)
    closed = {
        link.liaison: bool(touches)
        for link, touches in zip(mechanism.contacts, start.closed, strict=True)
    }
    touching = {x: closed.get(x.liaison, False) for x in freed.contacts}
    ranks = find_ranks(relations, here, touching)
    found.dependent += ranks.count - ranks.general
    found.dependent_at_start += ranks.count - ranks.start
    found.touching += ranks.touching - ranks.count
    found.touching_independent += ranks.touching_rank - ranks.start
    for loop in find_loops(relations, ranks.posture):
        cure = find_cure(relations, ranks.posture, loop)
        found.loops.append(
            LoopLine(
                loop.degree,
                tuple(_path(loop)),
                tuple((x.name, n) for x, n in zip(loop.liaisons, loop.undetermined, strict=True)),
                tuple((x.liaison.name, x.kind) for x in cure.changes),
                cure.left,
            )
        )
    for one, broken in non_holonomic(relations, ranks.posture).items():
        found.holonomic.append((one.name, None if broken is None else not broken))


def _parting(mechanism: Mechanism) -> dict[Constraint, bool]:
    values = default_values(mechanism.model, {})
    return {x: may_part(x, values) for x in mechanism.contacts}


def _path(loop: Loop) -> Iterator[str]:
    """Round a simple loop, body and liaison in turn; else all bodies, then all liaisons."""
    around = len(loop.bodies) == len(loop.liaisons)
    if not around:
        yield from (b.name for b in loop.bodies)
        return
    for body, liaison in zip(loop.bodies, loop.liaisons, strict=True):
        yield from (body.name, liaison.name)
    yield loop.bodies[0].name


def _connected(liaison: Liaison, among: list[Liaison]) -> list[Liaison]:
    """The liaisons that bodies, but for the ground, connect with one."""
    bodies = {b for b in _ends(liaison) if b.shape is not None}
    while True:
        more = {b for x in among if bodies & set(_ends(x)) for b in _ends(x) if b.shape is not None}
        if more <= bodies:
            return [x for x in among if bodies & set(_ends(x))]
        bodies |= more


def _paradoxes(reduced: Reduced, start: Start) -> Iterator[ParadoxLine]:
    for one in find_paradoxes(reduced, start.posture):
        yield ParadoxLine(
            one.liaison.name,
            one.mu,
            one.start if one.start < float("inf") else None,
            one.least if one.least is not None and one.least < float("inf") else None,
            one.where,
            tuple(x.name for x in one.beside),
        )
