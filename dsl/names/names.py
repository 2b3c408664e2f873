"""Names and members to the objects they stand for."""

from __future__ import annotations

import math
import re

from frot.dsl import checked
from frot.dsl.catalogue import TYPES, body_members, point_members
from frot.dsl.names.classes import Class, Namespace
from frot.dsl.names.flanges import flange
from frot.dsl.names.scope import (
    Array,
    Entity,
    Instance,
    Record,
    Refused,
    Scope,
    did_you_mean,
    settled,
)
from frot.dsl.quantities.dimensions import REAL, Type
from frot.dsl.quantities.units import is_unit
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
_AXES = "xyz"


def resolve(node: tree.Expression, scope: Scope, want: str) -> Thing | None:
    """What a name, a member or an item stands for; None after a message, or where silence is due.

    `want` is `place` or `value` and only chooses the words of messages.
    """
    if isinstance(node, tree.Name):
        return _name(node, scope)
    if isinstance(node, tree.Index):
        from frot.dsl.expressions.indexing import index

        return index(node, scope)
    assert isinstance(node, tree.Member)
    owner = _owner(node.operand, scope)
    if owner is None:
        return None
    return member(owner, node, scope, want)


def _owner(node: tree.Expression, scope: Scope) -> Thing | None:
    if isinstance(node, tree.Name | tree.Member | tree.Index):
        return resolve(node, scope, "place")
    from frot.dsl.expressions.expressions import value_of

    return value_of(node, scope)


def _name(node: tree.Name, scope: Scope) -> Thing | None:
    found = scope.find(node.text)
    if isinstance(found, Refused):
        return None
    if found is None:
        return _built_in(node, scope)
    return as_thing(found, node, scope)


def as_thing(found: Entity, node: tree.Expression, scope: Scope) -> Thing:
    """What a name gives where it is used: a reference to a value, or the thing itself."""
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
    constant = _constant_around(node, scope)
    if constant is not None:
        return constant
    if scope.knows(node.text):
        scope.log.report(
            "E0201",
            f"unknown name {node.text!r}",
            node.span,
            help=_product_in_unit(node) or did_you_mean(node.text, scope.visible(), scope.log),
        )
    return None


def _product_in_unit(node: tree.Name) -> str:
    """The remedy where a unit is written as a product: `2 N*m`."""
    text, start = node.span.source.text, node.span.start
    before = re.search(r"([\d.]+)[ \t]+(\w+)\*$", text[max(start - 60, 0) : start])
    if before is None or not is_unit(before[2]) or not is_unit(node.text):
        return ""
    return f"in a unit a product is a point: '{before[1]} {before[2]}.{node.text}'"


def _constant_around(node: tree.Name, scope: Scope) -> Thing | None:
    """A constant that is imported, or of a package that surrounds the class."""
    from frot.dsl.names.packages import constant

    space: Namespace | None = scope.space
    while space is not None:
        places = [space.constants[node.text]] if node.text in space.constants else []
        if space.owner is not None and space.owner.kind == "package":
            places.append((space.owner, node.text))
        stars = [s.target for s in space.stars if s.target is not None]
        places += [(s, node.text) for s in stars if s.kind == "package"]
        for package, name in places:
            found = constant(package, name, scope)
            if found is not None:
                for star in space.stars:
                    star.used = star.used or star.target is package
                return None if isinstance(found, Refused) else as_thing(found, node, scope)
        space = space.outer
    return None


# ------------------------------------------------------------------ members


def member(owner: Thing, node: tree.Member, scope: Scope, want: str) -> Thing | None:
    """What `owner.name` stands for."""
    match owner:
        case checked.Body():
            return _of_body(owner, node, scope, want)
        case checked.BodyPoint():
            turns = owner.body.shape is None or owner.body.shape.turns
            members = point_members(scope.planar, turns)
            what = f"point {owner.name!r} of body {owner.body.name!r}"
            return _quantity(owner, dict(members), what, node, scope)
        case checked.Frame():
            members = point_members(scope.planar)
            return _quantity(owner, dict(members), f"frame {owner.name!r}", node, scope)
        case checked.Liaison():
            return _of_liaison(owner, node, scope)
        case Instance():
            return _of_instance(owner, node, scope)
        case Array():
            return _of_array(owner, node, scope, want)
        case Record():
            return _of_record(owner, node, scope)
        case Class():
            from frot.dsl.names.packages import of_class

            return of_class(owner, node, scope)
        case (
            checked.Curve()
            | checked.CurvePlace()
            | checked.Surface()
            | checked.SurfacePlace()
            | checked.BodyGeometry()
            | checked.Force()
        ):
            scope.log.report("E0203", f"{kind_of(owner)} has no variables", node.name.span)
            return None
    return _component(owner, node, scope)


def _of_body(body: checked.Body, node: tree.Member, scope: Scope, want: str) -> Thing | None:
    name = node.name.text
    if body.shape is None:
        place = scope.build.ground_places.get(name)
        if isinstance(place, checked.Curve):
            return checked.CurvePlace(place, node.span)
        if isinstance(place, checked.Surface):
            return checked.SurfacePlace(place, node.span)
        frames: tuple[str, ...] = ("origin",)
        geometry = tuple(scope.build.ground_places)
        turns = True
    else:
        frames, geometry = body.shape.frames, tuple(body.shape.geometry)
        turns = body.shape.turns
    members = body_members(scope.planar, turns)
    if want == "value" and name in members:
        return checked.Quantity(body, name, members[name], node.span)
    if name in geometry:
        return checked.BodyGeometry(body, name, node.span)
    if name in frames:
        return checked.BodyPoint(body, name, node.span)
    if name in members:
        return checked.Quantity(body, name, members[name], node.span)
    what = "variable" if want == "value" else "frame"
    places = (*frames, *geometry)
    candidates = (*members, *places) if want == "value" else (*places, *members)
    _no_member(f"no {what} {name!r} on body {body.name!r}", node, candidates, scope)
    return None


def _of_liaison(liaison: checked.Liaison, node: tree.Member, scope: Scope) -> Thing | None:
    from frot.dsl.declarations.liaison_members import coordinates

    if node.name.text == "flange":
        return flange(liaison, node, scope)
    members = coordinates(liaison, scope.planar)
    return _quantity(liaison, dict(members), f"liaison {liaison.name!r}", node, scope)


def _of_instance(owner: Instance, node: tree.Member, scope: Scope) -> Thing | None:
    name = node.name.text
    found = settled(owner.names.get(name), name, owner, scope.build)
    scope.build.used.add(id(owner))
    if owner.is_connector:
        scope.build.named.setdefault(scope.instance.name, set()).add(id(owner))
    if isinstance(found, Refused):
        return None
    if found is not None:
        return as_thing(found, node, scope)
    if not owner.open and owner.of.space.knows(name):
        what = f"{owner.of.name} {owner.name!r}"
        _no_member(f"no {name!r} in {what}", node, tuple(owner.names), scope)
    return None


def _of_record(owner: Record, node: tree.Member, scope: Scope) -> Thing | None:
    found = owner.members.get(node.name.text)
    if found is None:
        message = f"no {node.name.text!r} in record {owner.of.name!r}"
        _no_member(message, node, tuple(owner.members), scope)
    return found


def _of_array(owner: Array, node: tree.Member, scope: Scope, want: str) -> Thing | None:
    """The members of all items: an array of things, or a vector of values."""
    found = [member(as_thing(item, node.operand, scope), node, scope, want) for item in owner.items]
    items = [f for f in found if f is not None]
    if len(items) < len(found):
        return None
    return gathered(items, f"{owner.name}.{node.name.text}", node)


def gathered(items: list[Thing], name: str, node: tree.Expression) -> Thing:
    """Things of one kind as one: a vector of values, or an array."""
    values = [i for i in items if isinstance(i, checked.Expression)]
    if values and len(values) == len(items):
        first = values[0].type
        return checked.Vector(tuple(values), first.of_shape((len(values), *first.shape)), node.span)
    return Array(name, tuple(items))  # type: ignore[arg-type]


def _quantity(
    owner: checked.BodyPoint | checked.Frame | checked.Liaison,
    members: dict[str, Type],
    what: str,
    node: tree.Member,
    scope: Scope,
) -> checked.Quantity | None:
    kind = members.get(node.name.text)
    if kind is None:
        _no_member(f"no variable {node.name.text!r} on {what}", node, tuple(members), scope)
        return None
    return checked.Quantity(owner, node.name.text, kind, node.span)


def _no_member(message: str, node: tree.Member, names: tuple[str, ...], scope: Scope) -> None:
    help_text = did_you_mean(node.name.text, names, scope.log)
    listed = ", ".join(names[:20]) or "none"
    notes = () if help_text else (f"there are: {listed}",)
    scope.log.report("E0203", message, node.name.span, notes=notes, help=help_text)


def _component(owner: checked.Expression, node: tree.Member, scope: Scope) -> Thing | None:
    from frot.dsl.expressions.indexing import element

    name = node.name.text
    if len(owner.type.shape) == 1 and name in tuple(_AXES[: owner.type.shape[0]]):
        return element(owner, _AXES.index(name), node.span)
    if owner.type.is_scalar:
        message = f"{node.operand.span.text!r} is a scalar: it has no {name!r}"
    elif len(owner.type.shape) == 1 and owner.type.shape[0] <= 3:
        axes = ", ".join(f".{a}" for a in _AXES[: owner.type.shape[0]])
        message = f"a vector of this model has {axes}, not '.{name}'"
    else:
        message = f"{node.operand.span.text!r} is an array: its items are written with '[1]'"
    scope.log.report("E0203", message, node.name.span)
    return None


def kind_of(thing: Thing) -> str:
    """What a thing is, with its name: `body 'hoop'`."""
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


def place(node: tree.Expression, scope: Scope) -> checked.Place | checked.SurfacePlace | None:
    """The point, curve, surface or frame an argument names; None after a message."""
    if not isinstance(node, tree.Name | tree.Member | tree.Index):
        scope.log.report("E0205", "expected a body, frame, point or curve", node.span)
        return None
    thing = resolve(node, scope, "place")
    if isinstance(thing, Array) and scope.element is not None:
        index, size = scope.element
        if len(thing.items) != size:
            message = f"{kind_of(thing)} stands in a declaration of {size}"
            scope.log.report("E0306", message, node.span)
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
    scope.log.report(
        "E0205", f"expected a body, frame, point or curve, found {kind_of(thing)}", node.span
    )
    return None
