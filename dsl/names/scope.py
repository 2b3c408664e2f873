"""Names of a text: entities, the scopes they are looked up in, and the state of a check.

These types refer to each other: an instance keeps its statements with their scopes, a scope knows
its instance and the state of the check, and that lists instances.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from frot.dsl import checked
from frot.dsl.messages.diagnostics import Label, Log
from frot.dsl.messages.source import Span
from frot.dsl.text import tree

if TYPE_CHECKING:
    from frot.dsl.names.classes import Class, Namespace
    from frot.dsl.names.connections import Connections
    from frot.dsl.names.imports import Libraries

BUILT_IN = ("time", "pi", "ground")
# Words that cannot begin an equation or stand in an expression, so that no variable has them.
RESERVED = frozenset(
    """and or not if then else elseif elsewhen end equation initial true false for loop when
    extends import final""".split()  # noqa: SIM905
)
# Scalars, components, equations, rounds of loops and expanded calls of one model, together: what a
# check makes of a text stays below some seconds and hundreds of megabytes.
LARGEST = 200_000
# What a component and a call take, where an equation takes 1.
COMPONENT, CALL = 3, 6
# Declarations of different components that wait for one another.
LONGEST = 400


class Refused:
    """The entity of a name whose declaration was refused: its uses give no message."""


REFUSED = Refused()


@dataclass(slots=True, eq=False, repr=False)
class Statements:
    """Statements checked once every name has its meaning, each with its scope."""

    worlds: list[tuple[tree.Call, Scope]] = field(default_factory=list)
    experiments: list[tuple[tree.Call, Scope]] = field(default_factory=list)
    initial: list[tuple[tree.Element, Scope]] = field(default_factory=list)
    equations: list[tuple[tree.Element, Scope]] = field(default_factory=list)
    liaisons: list[tuple[tree.Liaison, Scope]] = field(default_factory=list)


@dataclass(slots=True, eq=False, repr=False)
class Instance:
    """A component, or the model itself (`name` empty), or a package with its constants.

    `name` is dotted. `of` is its class, `around` the classes of what it is in and its own, `parts`
    the identities of the definitions it is made of, with what modifies them. `flows` names the flow
    variables of a connector. `open`: names may come from a base that was not found, so that missing
    ones are not reported. `written`: where each name is declared.
    """

    name: str
    of: Class
    span: Span
    names: dict[str, Entity | Pending | Refused] = field(default_factory=dict)
    flows: set[str] = field(default_factory=set)
    open: bool = False
    written: dict[str, Span] = field(default_factory=dict)
    around: tuple[Class, ...] = ()
    parts: dict[int, Mapping[str, Modifier]] = field(default_factory=dict)
    statements: Statements = field(default_factory=Statements)

    @property
    def is_connector(self) -> bool:
        """Whether it can be connected."""
        return self.of.kind == "connector"


@dataclass(slots=True, eq=False)
class Array:
    """Components, bodies, liaisons or forces of one declaration, in their order."""

    name: str
    items: tuple[Entity, ...]


@dataclass(slots=True, eq=False)
class Record:
    """The value of a whole record: the values of its members by name."""

    of: Class
    members: dict[str, checked.Expression | Record]
    span: Span


Entity = (
    checked.Parameter
    | checked.Input
    | checked.Output
    | checked.Variable
    | checked.Body
    | checked.Frame
    | checked.Curve
    | checked.Surface
    | checked.Liaison
    | checked.Force
    | Instance
    | Array
    | Record
    | checked.Expression
)


@dataclass(slots=True, eq=False)
class Pending:
    """A declaration that waits to be checked, and the names its expressions begin with."""

    name: tree.Word
    needs: tuple[str, ...]
    check: Callable[[], Entity | None]
    is_value: bool = False
    busy: bool = False


@dataclass(slots=True, eq=False)
class Modifier:
    """A modifier of one name: a value, and modifiers of the names inside of it.

    The value is a text to be checked in `scope`, or `known` already. `picks` are the indices (from
    0) and sizes of the arrays of components it comes through. `memo` keeps what was checked, shared
    by the items of an array. `covered` are the parts that were said further inside than the value:
    that of a whole record counts before them.
    """

    span: Span
    scope: Scope
    value: tree.Expression | None = None
    known: checked.Expression | Record | None = None
    parts: dict[str, Modifier] = field(default_factory=dict)
    final: bool = False
    picks: tuple[tuple[int, int], ...] = ()
    memo: dict[object, checked.Expression | Record | None] = field(default_factory=dict)
    covered: frozenset[str] = frozenset()

    @property
    def has_value(self) -> bool:
        """Whether it gives a value to the name itself."""
        return self.value is not None or self.known is not None


@dataclass(slots=True, repr=False)
class Scope:
    """Where a part of a text is checked: the names of its component and what surrounds its class.

    `local` holds names of a loop or a function, looked up first. `element` is the index (from 0)
    and the size of the array declaration that is being expanded: arrays of that size then stand for
    one item each. `arrays` are those that its arguments name, looked up once for all items: by the
    place in the text.
    """

    build: Build
    instance: Instance
    space: Namespace
    local: dict[str, Entity] = field(default_factory=dict)
    element: tuple[int, int] | None = None
    in_when: bool = False
    arrays: dict[int, Array] = field(default_factory=dict)

    @property
    def log(self) -> Log:
        """The log of faults."""
        return self.build.log

    @property
    def planar(self) -> bool:
        """Whether the model is planar."""
        return self.build.planar

    @property
    def size(self) -> int:
        """The number of components of a vector."""
        return 2 if self.build.planar else 3

    @property
    def values(self) -> dict[checked.Parameter, object]:
        """The values of parameters, with their defaults."""
        return self.build.values

    def knows(self, name: str) -> bool:
        """Whether a missing name must be reported: not if its declaration could not be read."""
        return not self.instance.open and self.space.knows(name)

    def dotted(self, name: str) -> str:
        """The name with that of its component before it."""
        return f"{self.instance.name}.{name}" if self.instance.name else name

    def find(self, name: str) -> Entity | Refused | None:
        """The entity of a name in the component; its declaration is checked if need be."""
        found: Entity | Pending | Refused | None = self.local.get(name)
        if found is None:
            found = self.instance.names.get(name)
        return settled(found, name, self.instance, self.build)

    def visible(self) -> tuple[str, ...]:
        """The names of the component and of the language."""
        return (*self.local, *self.instance.names, *BUILT_IN)

    def inside(self, **local: Entity) -> Scope:
        """The same scope with names of a loop or a law added."""
        return Scope(
            self.build,
            self.instance,
            self.space,
            {**self.local, **local},
            self.element,
            self.in_when,
        )

    def items(self, size: int) -> list[Scope]:
        """The same scope for each item of an array declaration."""
        shared: dict[int, Array] = {}
        return [
            Scope(self.build, self.instance, self.space, self.local, (k, size), arrays=shared)
            for k in range(size)
        ]


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
