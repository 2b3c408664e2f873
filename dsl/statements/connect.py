"""The statement `connect(a, b)`: what is connected is found, compared, and put into its sets."""

from __future__ import annotations

from frot.dsl import checked
from frot.dsl.checked.describe import describe
from frot.dsl.expressions.expression import agrees
from frot.dsl.expressions.names import resolve
from frot.dsl.messages.source import Span
from frot.dsl.names.classes import Class
from frot.dsl.names.connections import Entity
from frot.dsl.names.scope import Array, Build, Instance, Pending, Refused, Scope
from frot.dsl.names.things import Thing, kind_of
from frot.dsl.quantities.dimensions import Type
from frot.dsl.text import tree

_Value = checked.Variable | checked.Input | checked.Output | checked.Parameter


def connect(call: tree.Call, scope: Scope) -> None:
    """Record the connection of `connect(a, b)`; faults are reported."""
    if len(call.arguments) != 2 or any(a.name is not None for a in call.arguments):
        scope.log.report(
            "E0204", "'connect' takes two connectors", call.span, help="write 'connect(a, b)'"
        )
        return
    ends = [_end(argument.value, scope) for argument in call.arguments]
    first, second = ends
    if first is None or second is None:
        return
    found = call.arguments[0].value, call.arguments[1].value
    link = _Link(scope, call.span, f"connect({found[0].span.text}, {found[1].span.text})")
    link.faces = (_inside(found[0], scope), _inside(found[1], scope))
    link.things(first, second)


def _end(node: tree.Expression, scope: Scope) -> Thing | None:
    """The connector or signal that an argument names."""
    if not isinstance(node, tree.Name | tree.Member | tree.Index):
        scope.log.report("E0205", "expected the name of a connector", node.span)
        return None
    thing = resolve(node, scope, "place")
    if thing is None or _connects(thing):
        return thing
    help_text = ""
    if isinstance(thing, Instance):
        inner = [n for n, e in thing.names.items() if isinstance(e, Instance) and e.is_connector]
        inner += [n for n in ("u", "y") if isinstance(thing.names.get(n), _Value)]
        if inner:
            help_text = f"name its connector, as '{node.span.text}.{inner[0]}'"
    elif isinstance(thing, checked.Liaison):
        help_text = f"name its flange: '{node.span.text}.flange'"
    message = f"expected a connector, found {kind_of(thing)}"
    scope.log.report("E0205", message, node.span, help=help_text)
    return None


def _connects(thing: Thing) -> bool:
    match thing:
        case Instance():
            return thing.is_connector
        case Array(items=items):
            return all(_connects(i) for i in items)  # type: ignore[arg-type]
        case checked.Parameter() | Class():
            return False
        case _:
            return isinstance(thing, checked.Expression | _Value)


def _inside(node: tree.Expression, scope: Scope) -> bool:
    """Whether the connector belongs to a component of the model that connects it."""
    while isinstance(node, tree.Member | tree.Index):
        node = node.operand
    head = scope.find(node.text) if isinstance(node, tree.Name) else None
    while isinstance(head, Array):
        first = head.items[0]
        head = first
    return not (isinstance(head, Instance) and head.is_connector)


class _Link:
    """One connection: two ends walked side by side."""

    __slots__ = ("build", "faces", "scope", "span", "text")

    def __init__(self, scope: Scope, span: Span, text: str) -> None:
        self.scope, self.span, self.text = scope, span, text
        self.build: Build = scope.build
        self.faces = (True, True)

    def things(self, a: Thing, b: Thing) -> None:
        """Connect two connectors, arrays of them, or two signals."""
        match a, b:
            case Array(), Array():
                if len(a.items) != len(b.items):
                    self._refuse(f"{kind_of(a)} and {kind_of(b)} have different sizes")
                    return
                for one, other in zip(a.items, b.items, strict=True):
                    self.things(one, other)  # type: ignore[arg-type]
            case Instance(), Instance():
                if self._alike(a, b):
                    self.build.connections.joined.update((id(a), id(b)))
                    self._members(a, b)
            case (Instance() | Array(), _) | (_, Instance() | Array()):
                self._refuse(f"{_said(a)} cannot be connected to {_said(b)}")
            case _:
                self._signals(a, b)  # type: ignore[arg-type]

    def _refuse(self, message: str, notes: tuple[str, ...] = ()) -> None:
        self.scope.log.report("E0515", message, self.span, notes=notes)

    def _alike(self, a: Instance, b: Instance) -> bool:
        """Whether two connectors have the same variables; what differs is reported."""
        if a.of.definition is b.of.definition:
            return True
        differences = list(_differences(a, b))
        if differences:
            self._refuse(
                f"connectors {a.of.name!r} and {b.of.name!r} are not alike", tuple(differences[:3])
            )
        return not differences

    def _members(self, a: Instance, b: Instance) -> None:
        self.build.grow(1, self.span)
        for name, first in a.names.items():
            second = b.names.get(name)
            self._member(a, b, name, first, second)

    def _member(self, a: Instance, b: Instance, name: str, first: object, second: object) -> None:
        match first, second:
            case Instance(), Instance():
                self.build.connections.joined.update((id(first), id(second)))
                self._members(first, second)
            case Array(), Array():
                for one, other in zip(first.items, second.items, strict=False):
                    self._member(a, b, name, one, other)
            case (checked.Parameter(), _) | (_, checked.Parameter()):
                return
            case _ if isinstance(first, Refused | Pending) or isinstance(second, Refused | Pending):
                return
            case _ if name in a.flows:
                self.build.connections.join_flows(
                    (first, self.faces[0], a.name),  # type: ignore[arg-type]
                    (second, self.faces[1], b.name),  # type: ignore[arg-type]
                    self.span,
                    self.scope.instance.name,
                )
            case _:
                self._equal(first, second)  # type: ignore[arg-type]

    def _equal(self, a: Entity, b: Entity) -> None:
        owner = self.scope.instance.name
        self.build.connections.join_potentials(a, b, self.span, owner, self.text)

    def _signals(self, a: checked.Expression, b: checked.Expression) -> None:
        if not (agrees(a.type, b.type) or agrees(b.type, a.type)):
            self._refuse(f"these differ: {describe(a.type)}, {describe(b.type)}")
            return
        ends = [e.target if isinstance(e, checked.Reference) else e for e in (a, b)]
        self._equal(ends[0], ends[1])


def _said(thing: Thing) -> str:
    return describe(thing.type) if isinstance(thing, checked.Expression) else kind_of(thing)


def _differences(a: Instance, b: Instance) -> list[str]:
    """The differences of two connectors of different definitions, in words."""
    found = []
    for one, other in ((a, b), (b, a)):
        missing = [n for n in one.names if n not in other.names]
        if missing:
            names = ", ".join(repr(n) for n in missing)
            found.append(f"{names} is in {one.of.name!r} only")
    for name, first in a.names.items():
        second = b.names.get(name)
        if second is None:
            continue
        if (name in a.flows) != (name in b.flows):
            flow = a if name in a.flows else b
            found.append(f"{name!r} is a flow in {flow.of.name!r} only")
        kinds = [getattr(e, "type", None) for e in (first, second)]
        if all(isinstance(k, Type) for k in kinds) and kinds[0] != kinds[1]:
            shown = [describe(k) for k in kinds]  # type: ignore[arg-type]
            found.append(f"{name!r} is {shown[0]} in {a.of.name!r}, {shown[1]} in {b.of.name!r}")
        elif isinstance(first, Instance) and isinstance(second, Instance):
            found += _differences(first, second)
        elif type(first) is not type(second) and not all(isinstance(k, Type) for k in kinds):
            found.append(f"{name!r} is of another kind")
    return found
