"""Entities as they are used, and their words in messages."""

from __future__ import annotations

from frot.dsl import checked
from frot.dsl.names.classes import Class
from frot.dsl.names.scope import Array, Entity, Instance, Record, Scope
from frot.dsl.text import tree

Thing = (
    checked.Expression
    | checked.Body
    | checked.Frame
    | checked.Curve
    | checked.Surface
    | checked.Liaison
    | checked.Force
    | checked.BodyPoint
    | checked.BodyGeometry
    | checked.CurvePlace
    | checked.SurfacePlace
    | Instance
    | Array
    | Record
    | Class
)


_VALUES = (checked.Parameter, checked.Input, checked.Output, checked.Variable)


def as_thing(found: Entity, node: tree.Expression, scope: Scope) -> Thing:
    """The use of an entity: a reference to a value, or the entity itself."""
    scope.build.used.add(id(found))
    if isinstance(found, _VALUES):
        return checked.Reference(found, found.type, node.span)
    if isinstance(found, checked.Literal):
        return checked.Literal(found.value, found.type, node.span)
    if isinstance(found, Array) and scope.element is not None:
        index, size = scope.element
        if len(found.items) == size and not isinstance(node, tree.Index):
            return as_thing(found.items[index], node, scope)
    return found


def gathered(items: list[Thing], name: str, node: tree.Expression) -> Thing:
    """Things of one kind as one: a vector of values, or an array."""
    values = [i for i in items if isinstance(i, checked.Expression)]
    if values and len(values) == len(items):
        first = values[0].type
        return checked.Vector(tuple(values), first.of_shape((len(values), *first.shape)), node.span)
    return Array(name, tuple(items))  # type: ignore[arg-type]


def kind_of(thing: Thing) -> str:
    """Kind and name of an entity: `body 'hoop'`."""
    match thing:
        case checked.Body(name=name):
            return f"body {name!r}"
        case checked.Frame(name=name):
            return f"frame {name!r}"
        case checked.Curve(name=name):
            return f"curve {name!r}"
        case checked.CurvePlace(curve=curve):
            return f"curve {curve.name!r}"
        case checked.Surface(name=name) | checked.SurfacePlace(surface=checked.Surface(name=name)):
            return f"surface {name!r}"
        case checked.Liaison(name=name):
            return f"liaison {name!r}"
        case checked.Force(name=name):
            return f"force {name!r}"
        case checked.BodyPoint(body=body, name=name):
            return f"point {body.name + '.' + name!r}"
        case checked.BodyGeometry(body=body, name=name):
            return f"geometry {body.name + '.' + name!r}"
        case Instance():
            return f"{thing.of.kind} {thing.name!r}"
        case Array(name=name, items=items):
            return f"array {name!r} of {len(items)}"
        case Record():
            return f"a record {thing.of.name!r}"
        case Class():
            return f"{thing.kind} {thing.name!r}"
    return "a value"
