"""State shared by all scopes of one check, and the checking of pending entities."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from frot.dsl import checked
from frot.dsl.messages.diagnostics import Label, Log
from frot.dsl.messages.source import Span
from frot.dsl.names.entities import REFUSED, Entity, Instance, Pending, Record, Refused
from frot.dsl.text import tree

if TYPE_CHECKING:
    from frot.dsl.names.classes import Class
    from frot.dsl.names.imports import Libraries
    from frot.dsl.names.scope import Scope
    from frot.dsl.statements.connections import Connections

# Scalars, components, equations, rounds of loops and expanded calls of one model, together: what a
# check makes of a text stays below some seconds and hundreds of megabytes.
LARGEST = 200_000
# What a component and a call take, where an equation takes 1.
COMPONENT, CALL = 3, 6
# Declarations of different components that wait for one another.
LONGEST = 400


class TooLarge(Exception):
    """The model is too large; it was reported, and the check ends."""


Rule = Callable[[Any, "Scope"], checked.Expression | Record | None]


@dataclass(frozen=True, slots=True, repr=False)
class Checks:
    """How what a name leads to is checked: an index is an expression, a constant is declared.

    `expressions` holds a rule for each kind of expression; `declare` makes the names of a clause.
    """

    expressions: Mapping[type, Rule]
    declare: Callable[[tree.Component, Scope], None]


@dataclass(slots=True, repr=False)
class Build:
    """State shared by all scopes of one check: log, known values, gathered entities.

    `named` are the connectors whose variables a component's text names. `used` are the identities
    of what was named. `before` are the calls of `pre` and `change`, to be judged at the end.
    `unused`: how deep in branches that never count; `items_beyond`: items used there that are
    none. `circles`: the classes of each circle of bases that was reported.
    """

    log: Log
    planar: bool
    ground: checked.Body
    ground_places: dict[str, checked.Curve | checked.Surface]
    libraries: Libraries
    connections: Connections
    checks: Checks
    root: Instance | None = None
    values: dict[checked.Parameter, object] = field(default_factory=dict)
    equations: list[checked.Equation | checked.IfEquations] = field(default_factory=list)
    initial: list[checked.InitialEquation] = field(default_factory=list)
    whens: list[checked.When] = field(default_factory=list)
    assertions: list[checked.Assertion] = field(default_factory=list)
    flanges: list[checked.Flange] = field(default_factory=list)
    flange_instances: dict[checked.Liaison, Instance] = field(default_factory=dict)
    packages: dict[int, Instance] = field(default_factory=dict)
    used: set[int] = field(default_factory=set)
    named: dict[str, set[int]] = field(default_factory=dict)
    waiting: list[Pending] = field(default_factory=list)
    bindings: list[Callable[[], None]] = field(default_factory=list)
    fresh: list[Instance] = field(default_factory=list)
    calls: list[Class] = field(default_factory=list)
    functions: dict[int, object] = field(default_factory=dict)
    clauses: dict[object, object] = field(default_factory=dict)
    before: list[tuple[checked.Call, checked.Variable, bool]] = field(default_factory=list)
    circles: set[frozenset[int]] = field(default_factory=set)
    heights: dict[int, tuple[checked.Expression, int]] = field(default_factory=dict)
    size: int = 0
    unused: int = 0
    items_beyond: int = 0

    def grow(self, count: int, span: Span) -> None:
        """Count what is made. Raises TooLarge, after telling it, past LARGEST."""
        self.size += count
        self.room(0, span)

    def room(self, count: int, span: Span) -> None:
        """Raises TooLarge, after telling it, where `count` more would be past LARGEST."""
        if self.size + count > LARGEST:
            self.log.report(
                "E0109",
                f"the model is too large: more than {LARGEST} scalars, equations and calls",
                span,
            )
            raise TooLarge


def settled(
    found: Entity | Pending | Refused | None, name: str, instance: Instance, build: Build
) -> Entity | Refused | None:
    """The entity of a declaration, checked now if it was not; circles are reported."""
    if type(found) is not Pending:
        return found  # type: ignore[return-value]
    if found.busy:
        _tell_circle(found, build)
        return REFUSED
    if len(build.waiting) > LONGEST:
        build.log.report(
            "E0108",
            f"more than {LONGEST} declarations wait for one another",
            found.name.span,
            help="write the components in the order in which they need each other",
        )
        return REFUSED
    found.busy = True
    build.waiting.append(found)
    entity = found.check()
    build.waiting.pop()
    result: Entity | Refused = REFUSED if entity is None else entity
    instance.names[name] = result
    return result


def _tell_circle(first: Pending, build: Build) -> None:
    circle = build.waiting[build.waiting.index(first) :]
    start = min(range(len(circle)), key=lambda k: circle[k].name.span.start)
    circle = [*circle[start:], *circle[:start]]
    first = circle[0]
    path = " -> ".join(p.name.text for p in (*circle, first))
    if len(circle) == 1:
        message = f"{first.name.text!r} depends on itself"
    else:
        what = "parameters" if all(p.is_value for p in circle) else "declarations"
        message = f"{what} depend on each other in a circle: {path}"
    labels = tuple(Label(p.name.span, "part of it") for p in circle[1:])
    build.log.report("E0208", message, first.name.span, labels=labels)
