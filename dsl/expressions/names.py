"""Names, members and items to the objects they stand for."""

from __future__ import annotations

import math
import re

from frot.dsl import checked
from frot.dsl.catalogue import MODE, MODES, TYPES
from frot.dsl.checked.arrays import element
from frot.dsl.checked.describe import describe
from frot.dsl.expressions.expression import value_of
from frot.dsl.expressions.structure import span_of, whole_number
from frot.dsl.messages.source import Span
from frot.dsl.names.constants import constant_around
from frot.dsl.names.find_member import member
from frot.dsl.names.near import did_you_mean
from frot.dsl.names.scope import Array, Refused, Scope
from frot.dsl.names.things import Thing, as_thing, gathered, kind_of
from frot.dsl.quantities.dimensions import REAL
from frot.dsl.quantities.spelling import corrected
from frot.dsl.quantities.units import is_unit
from frot.dsl.text import tree

_WORDS = ("true", "false", "pi", "time", "ground")
_PARENTHESES = re.compile(r"([\d.]+[ \t]+)([\w.^%°-]+/\([\w./^%°-]+\))")
_POWER = re.compile(r"\^-?\d+")
_MODES = tuple(f"Mode.{name}" for name in MODES)


def resolve(node: tree.Expression, scope: Scope, want: str) -> Thing | None:
    """The entity of a name, a member or an item; None after a message, or where silence is due.

    `want` is `place` or `value` and only chooses the words of messages.
    """
    if isinstance(node, tree.Name):
        return _name(node, scope)
    if isinstance(node, tree.Index):
        return index(node, scope)
    assert isinstance(node, tree.Member)
    if node.span.text in _MODES and scope.find("Mode") is None and not scope.space.find("Mode"):
        return _mode(node.name.text, node)
    owner = _owner(node.operand, scope)
    if owner is None:
        return None
    return member(owner, node, scope, want)


def _mode(name: str, node: tree.Expression) -> checked.Literal:
    return checked.Literal(float(MODES.index(name) + 1), MODE, node.span)


def _owner(node: tree.Expression, scope: Scope) -> Thing | None:
    if isinstance(node, tree.Name | tree.Member | tree.Index):
        return resolve(node, scope, "place")
    return value_of(node, scope)


def _name(node: tree.Name, scope: Scope) -> Thing | None:
    found = scope.find(node.text)
    if isinstance(found, Refused):
        return None
    if found is None:
        return _built_in(node, scope)
    return as_thing(found, node, scope)


def _built_in(node: tree.Name, scope: Scope) -> Thing | None:
    if node.text == "time":
        return checked.Time(TYPES["Time"], node.span)
    if node.text == "pi":
        return checked.Literal(math.pi, REAL, node.span)
    if node.text == "ground":
        return scope.build.ground
    defined = scope.space.find(node.text)
    if defined is not None:
        return defined
    if node.text in MODES:
        return _mode(node.text, node)
    constant = constant_around(node, scope)
    if constant is not None:
        return constant
    if scope.knows(node.text) and not _unit_in_parentheses(node, scope):
        scope.log.report(
            "E0201",
            f"unknown name {node.text!r}",
            node.span,
            help=_unit_apart(node)
            or did_you_mean(node.text, (*scope.visible(), *_WORDS), scope.log),
        )
    return None


def _unit_in_parentheses(node: tree.Name, scope: Scope) -> bool:
    """Whether a name is part of a unit with parentheses, `3 N.m/(rad/s)`; this is reported once."""
    text, start = node.span.source.text, node.span.start
    for found in _PARENTHESES.finditer(text, max(start - 60, 0), start + 60):
        meant = corrected(found[2])
        if found.start(2) < start < found.end() and meant:
            help_text = f"write '{found[1]}{meant}'"
            span = Span(node.span.source, found.start(2), found.end())
            scope.log.report("E0302", "a unit has no parentheses", span, help=help_text)
            return True
    return False


def _unit_apart(node: tree.Name) -> str:
    """The remedy where a unit is written as a product or with blanks: `2 N*m`, `3 m / s`."""
    text, start = node.span.source.text, node.span.start
    before = re.search(r"([\d.]+)[ \t]+(\w+)([ \t]*[*/][ \t]*)$", text[max(start - 60, 0) : start])
    if before is None or not is_unit(before[2]) or not is_unit(node.text):
        return ""
    power = _POWER.match(text, node.span.end)
    last = node.text + (power[0] if power else "")
    if "/" in before[3]:
        return f"a unit has no blanks: '{before[1]} {before[2]}/{last}'"
    return f"in a unit a product is a point: '{before[1]} {before[2]}.{last}'"


def place(node: tree.Expression, scope: Scope) -> checked.Place | checked.SurfacePlace | None:
    """The point, curve, surface or frame an argument names; None after a message."""
    if not isinstance(node, tree.Name | tree.Member | tree.Index):
        scope.log.report("E0205", "expected a body, frame, point or curve", node.span)
        return None
    thing = scope.arrays.get(id(node)) or resolve(node, scope, "place")
    items = items_of(thing, node) if isinstance(thing, checked.BodyGeometry) else None
    if items is not None:
        thing = items
    if isinstance(thing, Array) and scope.element is not None:
        scope.arrays[id(node)] = thing
        index, size = scope.element
        if len(thing.items) != size:
            message = f"{kind_of(thing)} stands in a declaration of {size}"
            remedy = "" if items is None else _as_many(node, size, len(thing.items))
            scope.log.report("E0306", message, node.span, help=remedy)
            return None
        thing = thing.items[index]  # type: ignore[assignment]
    match thing:
        case None:
            return None
        case checked.Body(shape=shape):
            return checked.BodyPoint(thing, "origin" if shape is None else shape.home, node.span)
        case checked.Curve():
            return checked.CurvePlace(thing, node.span)
        case checked.Surface():
            return checked.SurfacePlace(thing, node.span)
        case (
            checked.CurvePlace()
            | checked.SurfacePlace()
            | checked.BodyPoint()
            | checked.BodyGeometry()
            | checked.Frame()
        ):
            return thing
    remedy = ""
    if items is not None:
        remedy = (
            f"name one of them, as '{node.span.text}[1]'; an array of liaisons or of forces, as "
            f"'liaison feet[{len(items.items)}]', takes all"
        )
    scope.log.report(
        "E0205",
        f"expected a body, frame, point or curve, found {kind_of(thing)}",
        node.span,
        help=remedy,
    )
    return None


def _as_many(node: tree.Expression, size: int, count: int) -> str:
    """The remedy where a declaration of `size` is given all `count` corners of a body."""
    if isinstance(node, tree.Index):
        bodies, corner = node.operand.span.text, node.subscripts[0].span.text
        return f"the first index counts the bodies: write '{bodies}[1:{size}, {corner}]'"
    if size < count:
        return f"name as many, as '{node.span.text}[1:{size}]'"
    return f"declare as many as there are: {count}"


def items_of(thing: checked.BodyGeometry, node: tree.Expression) -> Array | None:
    """The corners, edges, sides or rims of a body's shape; None of a single figure."""
    if not _are_several(thing):
        return None
    found = tuple(_geometry(thing, k, node) for k in range(_count(thing)))
    return Array(f"{thing.body.name}.{thing.name}", found)  # type: ignore[arg-type]


def index(node: tree.Index, scope: Scope) -> Thing | None:
    """`operand[subscripts]`: an item, or an array of those of a range."""
    found: Thing | None
    if isinstance(node.operand, tree.Name | tree.Member | tree.Index):
        whole = Scope(scope.build, scope.instance, scope.space, scope.local, None, scope.in_when)
        found = resolve(node.operand, whole, "value")
    else:
        found = value_of(node.operand, scope)
    return None if found is None else _items(found, list(node.subscripts), node, scope)


def _items(
    thing: Thing, subscripts: list[tree.Expression], node: tree.Index, scope: Scope
) -> Thing | None:
    if not subscripts:
        return thing
    first, *rest = subscripts
    if isinstance(thing, checked.BodyGeometry):
        return _geometry_item(thing, first, node, scope)
    if isinstance(thing, Array):
        size = len(thing.items)
    elif isinstance(thing, checked.Expression) and thing.type.shape:
        size = thing.type.shape[0]
    else:
        shown = describe(thing.type) if isinstance(thing, checked.Expression) else kind_of(thing)
        remedy = "an index follows the name of an array"
        if isinstance(thing, checked.Liaison) and thing.kind.name == "appui_faces":
            remedy = (
                "results tell its corners one by one; a text names the whole, or a place of the "
                "body, as 'block.corners[1].position'"
            )
        scope.log.report("E0304", f"{shown} has no index", node.span, help=remedy)
        return None
    chosen = _chosen(first, size, scope)
    if chosen is None:
        return None
    found = []
    for k in chosen:
        if isinstance(thing, Array):
            part: Thing = as_thing(thing.items[k], node, scope)
        else:
            assert isinstance(thing, checked.Expression)
            part = element(thing, k, node.span)
        one = _items(part, rest, node, scope)
        if one is None:
            return None
        found.append(one)
    if not isinstance(first, tree.Range):
        return found[0]
    if not found:
        scope.log.report("E0306", "the range is empty", first.span)
        return None
    return gathered(found, node.span.text, node)


def _geometry_item(
    thing: checked.BodyGeometry, subscript: tree.Expression, node: tree.Index, scope: Scope
) -> Thing | None:
    """A corner, edge, side or rim of a body's shape."""
    if not _are_several(thing):
        scope.log.report("E0304", f"{kind_of(thing)} has no index", node.span)
        return None
    chosen = _chosen(subscript, _count(thing), scope)
    if chosen is None:
        return None
    if not chosen:
        scope.log.report("E0306", "the range is empty", subscript.span)
        return None
    found: list[Thing] = [_geometry(thing, k, node) for k in chosen]
    return gathered(found, node.span.text, node) if isinstance(subscript, tree.Range) else found[0]


def _kind(thing: checked.BodyGeometry) -> str:
    """That of a figure in the catalogue: points, curve, curves, surface; empty of one of many."""
    shape = thing.body.shape
    return "" if shape is None else shape.geometry.get(thing.name, "")


def _are_several(thing: checked.BodyGeometry) -> bool:
    return _kind(thing).endswith("s")


def _geometry(
    thing: checked.BodyGeometry, k: int, node: tree.Expression
) -> checked.BodyPoint | checked.BodyGeometry:
    """One of several, counted from 0."""
    name = f"{thing.name}[{k + 1}]"
    if _kind(thing) == "points":
        return checked.BodyPoint(thing.body, name, node.span)
    return checked.BodyGeometry(thing.body, name, node.span)


# In space: in the plane it has sides.
_EDGES_OF_A_BOX = 12


def _count(thing: checked.BodyGeometry) -> int:
    """How many corners, edges, sides or rims there are."""
    given = thing.body.arguments
    if thing.name == "edges":
        return _EDGES_OF_A_BOX
    if "vertices" in given:
        return given["vertices"].type.shape[0]
    return 2 ** given["size"].type.shape[0] if "size" in given else 2


def _chosen(node: tree.Expression, size: int, scope: Scope) -> list[int] | None:
    """The indices of a subscript, from 0."""
    if isinstance(node, tree.Range):
        found = span_of(node, scope, "an index")
        values = None if found is None else list(found)
    else:
        one = whole_number(node, scope, "an index")
        values = None if one is None else [one]
    for value in values or ():
        if not 1 <= value <= size and scope.build.unused:
            scope.build.items_beyond += 1
            return None
        if not 1 <= value <= size:
            message = f"the index must be from 1 to {size}"
            shown = f"it is {value}" if not isinstance(node, tree.Number) else ""
            remedy = "items are counted from 1" if value < 1 else "name an item that there is"
            scope.log.report("E0304", message, node.span, caret=shown, help=remedy)
            return None
    return None if values is None else [v - 1 for v in values]
