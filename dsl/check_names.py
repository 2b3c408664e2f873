"""Names and members to the objects they stand for."""

from __future__ import annotations

import math

from frot.dsl import checked, tree
from frot.dsl.catalogue import body_members, liaison_members, point_members
from frot.dsl.dimensions import REAL, Type
from frot.dsl.scope import BUILT_IN, Refused, Scope, did_you_mean

Thing = (
    checked.Expression
    | checked.Body
    | checked.Frame
    | checked.Curve
    | checked.Liaison
    | checked.Force
    | checked.BodyPoint
    | checked.BodyGeometry
    | checked.CurvePlace
)
_AXES = "xyz"


def resolve(node: tree.Expression, scope: Scope, want: str) -> Thing | None:
    """What a name or a member stands for; None after a message, or where silence is due.

    `want` is `place` or `value` and only chooses the words of messages.
    """
    if isinstance(node, tree.Name):
        return _name(node, scope)
    assert isinstance(node, tree.Member)
    owner = _owner(node.operand, scope)
    if owner is None:
        return None
    return _member(owner, node, scope, want)


def _owner(node: tree.Expression, scope: Scope) -> Thing | None:
    from frot.dsl.check_expressions import expression

    if isinstance(node, tree.Name | tree.Member):
        return resolve(node, scope, "place")
    return expression(node, scope)


def _name(node: tree.Name, scope: Scope) -> Thing | None:
    found = scope.names.get(node.text)
    if isinstance(found, Refused):
        return None
    if found is None:
        return _built_in(node, scope)
    if isinstance(found, checked.Parameter | checked.Input | checked.Output):
        return checked.Reference(found, found.type, node.span)
    return found


def _built_in(node: tree.Name, scope: Scope) -> Thing | None:
    if node.text == "time":
        from frot.dsl.catalogue import TYPES

        return checked.Time(TYPES["Time"], node.span)
    if node.text == "pi":
        return checked.Literal(math.pi, REAL, node.span)
    if node.text == "ground":
        return scope.ground
    if scope.knows(node.text):
        scope.log.report(
            "E0201",
            f"unknown name {node.text!r}",
            node.span,
            help=did_you_mean(node.text, (*scope.names, *BUILT_IN)),
        )
    return None


def _member(owner: Thing, node: tree.Member, scope: Scope, want: str) -> Thing | None:
    if isinstance(owner, checked.Body):
        return _of_body(owner, node, scope, want)
    if isinstance(owner, checked.BodyPoint):
        turns = owner.body.shape is None or owner.body.shape.turns
        members = point_members(scope.planar, turns)
        what = f"point {owner.name!r} of body {owner.body.name!r}"
        return _quantity(owner, dict(members), what, node, scope)
    if isinstance(owner, checked.Frame):
        members = point_members(scope.planar)
        return _quantity(owner, dict(members), f"frame {owner.name!r}", node, scope)
    if isinstance(owner, checked.Liaison):
        if node.name.text == "flange":
            scope.log.report("E0701", "flanges of liaisons are not supported yet", node.span)
            return None
        members = liaison_members(owner.kind, scope.planar)
        return _quantity(owner, dict(members), f"liaison {owner.name!r}", node, scope)
    if isinstance(owner, checked.Curve | checked.CurvePlace | checked.BodyGeometry | checked.Force):
        scope.log.report("E0203", f"{kind_of(owner)} has no variables", node.name.span)
        return None
    return _component(owner, node, scope)


def _of_body(body: checked.Body, node: tree.Member, scope: Scope, want: str) -> Thing | None:
    name = node.name.text
    if body.shape is None:
        if name == "line" and scope.planar:
            return checked.CurvePlace(scope.ground_line, node.span)
        frames: tuple[str, ...] = ("origin",)
        geometry: tuple[str, ...] = ("line",)
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
    help_text = did_you_mean(node.name.text, names)
    notes = () if help_text else (f"there are: {', '.join(names)}",)
    scope.log.report("E0203", message, node.name.span, notes=notes, help=help_text)


def _component(owner: checked.Expression, node: tree.Member, scope: Scope) -> Thing | None:
    name = node.name.text
    if len(owner.type.shape) == 1 and name in tuple(_AXES[: owner.type.shape[0]]):
        item = Type(owner.type.base, owner.type.dimension)
        return checked.Element(owner, _AXES.index(name), item, node.span)
    if owner.type.is_scalar:
        message = f"{node.operand.span.text!r} is a scalar: it has no {name!r}"
    else:
        axes = ", ".join(f".{a}" for a in _AXES[: owner.type.shape[0]])
        message = f"a vector of this model has {axes}, not '.{name}'"
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
        case checked.Liaison(name=name):
            return f"liaison {name!r}"
        case checked.Force(name=name):
            return f"force {name!r}"
        case checked.BodyPoint(body=body, name=name):
            return f"point {body.name + '.' + name!r}"
        case checked.BodyGeometry(body=body, name=name):
            return f"geometry {body.name + '.' + name!r}"
    return "a value"


def place(node: tree.Expression, scope: Scope) -> checked.Place | None:
    """The point, curve or frame an argument names; None after a message."""
    if not isinstance(node, tree.Name | tree.Member):
        scope.log.report("E0205", "expected a body, frame, point or curve", node.span)
        return None
    thing = resolve(node, scope, "place")
    match thing:
        case None:
            return None
        case checked.Body(shape=shape):
            return checked.BodyPoint(thing, "origin" if shape is None else shape.home, node.span)
        case checked.Curve():
            return checked.CurvePlace(thing, node.span)
        case checked.CurvePlace() | checked.BodyPoint() | checked.BodyGeometry() | checked.Frame():
            return thing
    scope.log.report(
        "E0205", f"expected a body, frame, point or curve, found {kind_of(thing)}", node.span
    )
    return None
