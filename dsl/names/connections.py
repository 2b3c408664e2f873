"""Connection sets: equal potentials, and flows that sum to zero (Modelica 3.6, section 9.2).

A connector of a component is inside of the model that connects it; the model's own is outside, and
its flow then counts with the other sign. What nobody connects from outside carries no flow.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from frot.dsl import checked
from frot.dsl.checked.arrays import total, zero
from frot.dsl.messages.source import Span
from frot.dsl.quantities.dimensions import Type

# The message on a connector without a connection.
UNCONNECTED = "nothing is connected to "

# A variable of a connector, and whether its connector is seen from the model around it.
Face = tuple[int, bool]
Entity = checked.Variable | checked.Input | checked.Output | checked.Parameter | checked.Expression


@dataclass(slots=True)
class _Set:
    """Flow variables that meet, with the first connection that made them meet."""

    members: list[tuple[Entity, bool, str]]
    span: Span
    owner: str


@dataclass(slots=True)
class Connections:
    """The connections met so far; `declared` are flow variables with the place of their part."""

    declared: dict[int, tuple[checked.Variable, Span, object]] = field(default_factory=dict)
    parents: dict[object, object] = field(default_factory=dict)
    sets: dict[object, _Set] = field(default_factory=dict)
    equations: list[checked.Equation] = field(default_factory=list)
    kept: list[object] = field(default_factory=list)
    joined: set[int] = field(default_factory=set)

    def flow(self, variable: checked.Variable, span: Span, connector: object) -> None:
        """Say that a connector has this flow variable."""
        self.declared[id(variable)] = (variable, span, connector)

    def unconnected(self) -> dict[int, tuple[str, list[int]]]:
        """By the identity of each connector its name and its flow variables that are in no set."""
        met = self._met()
        found: dict[int, tuple[str, list[int]]] = {}
        for key, (variable, _, connector) in self.declared.items():
            if key not in met:
                name = variable.name.rpartition(".")[0]
                found.setdefault(id(connector), (name, []))[1].append(key)
        return found

    def _met(self) -> set[int]:
        return {
            id(entity)
            for joined in self.sets.values()
            for entity, inside, _ in joined.members
            if inside
        }

    def join_potentials(self, a: Entity, b: Entity, span: Span, owner: str, text: str) -> None:
        """Make two potentials equal, unless others made them so already."""
        self.kept += (a, b)
        first, second = self._root(id(a)), self._root(id(b))
        if first == second:
            return
        self.parents[second] = first
        left, right = as_expression(a, span), as_expression(b, span)
        self.equations.append(checked.Equation(left, right, span, owner, text))

    def join_flows(
        self,
        a: tuple[Entity, bool, str],
        b: tuple[Entity, bool, str],
        span: Span,
        owner: str,
    ) -> None:
        """Let two flows meet; each is a variable, whether it is inside, and its connector."""
        roots = []
        for entity, inside, name in (a, b):
            root = self._root((id(entity), inside))
            if root not in self.sets:
                self.sets[root] = _Set([(entity, inside, name)], span, owner)
            roots.append(root)
        first, second = roots
        if first == second:
            return
        big, small = self.sets[first], self.sets[second]
        if len(small.members) > len(big.members):
            first, second = second, first
            big, small = small, big
        big.members += small.members
        del self.sets[second]
        self.parents[second] = first

    def _root(self, key: object) -> object:
        parents = self.parents
        while key in parents:
            above = parents[key]
            parents[key] = parents.get(above, above)
            key = above
        return key

    def finish(
        self, held_open: set[int], grow: Callable[[int, Span], None]
    ) -> list[checked.Equation]:
        """All equations of the connections; the flows in `held_open` are not closed."""
        found = self.equations
        met = self._met() | held_open
        found += [_balance(joined) for joined in self.sets.values()]
        for key, (variable, span, _) in self.declared.items():
            if key not in met:
                name = variable.name.rpartition(".")[0]
                left = checked.Reference(variable, variable.type, span)
                zero = _zero(variable.type, span)
                text = f"{UNCONNECTED}{name}"
                found.append(checked.Equation(left, zero, span, _owner(name), text))
        for equation in found:
            grow(1, equation.span)
        return found


def _owner(connector: str) -> str:
    return connector.rpartition(".")[0]


def _balance(joined: _Set) -> checked.Equation:
    """The sum of the flows of a set is zero."""
    span = joined.span
    terms: list[checked.Expression] = []
    for entity, inside, _ in joined.members:
        term = as_expression(entity, span)
        terms.append(term if inside else checked.Unary("-", term, term.type, span))
    names = ", ".join(_short(name for _, _, name in joined.members))
    right = _zero(terms[0].type, span)
    return checked.Equation(total(terms, span), right, span, joined.owner, f"flows of {names}")


def _short(names: Iterable[str]) -> list[str]:
    found = list(dict.fromkeys(names))
    return found if len(found) <= 6 else [*found[:5], f"{len(found) - 5} more"]


def _zero(kind: Type, span: Span) -> checked.Expression:
    return zero(kind, span)


def as_expression(entity: Entity, span: Span) -> checked.Expression:
    """The expression of a variable of a connector in an equation."""
    if isinstance(entity, checked.Expression):
        return entity
    return checked.Reference(entity, entity.type, span)
