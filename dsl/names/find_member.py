"""Members by `owner.name`: those of bodies, places, liaisons, components and packages."""

from __future__ import annotations

from frot.dsl import checked
from frot.dsl.catalogue import body_members, point_members
from frot.dsl.checked.arrays import element
from frot.dsl.checked.liaison_variables import liaison_variables
from frot.dsl.names.classes import Class
from frot.dsl.names.constants import of_class
from frot.dsl.names.flanges import flange
from frot.dsl.names.near import did_you_mean
from frot.dsl.names.scope import Array, Instance, Record, Refused, Scope, settled
from frot.dsl.names.things import Thing, as_thing, gathered, kind_of
from frot.dsl.quantities.dimensions import Type
from frot.dsl.text import tree

_AXES, _QUATERNION = "xyz", "wxyz"
# Places of the ground in a planar model, and in space; the help where a member is of the other.
_GROUND = ("line", "plane")
_OTHER = {
    False: "'{}' is of planar models, and this one is in space: write 'planar model'",
    True: "'{}' is of models in space, and this one is planar",
}


def member(owner: Thing, node: tree.Member, scope: Scope, want: str) -> Thing | None:
    """The entity of `owner.name`."""
    if isinstance(owner, checked.BodyGeometry):
        owner = owner.centre or owner
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
            return of_class(owner, node, scope)
        case (
            checked.Curve()
            | checked.CurvePlace()
            | checked.Surface()
            | checked.SurfacePlace()
            | checked.BodyGeometry()
            | checked.Force()
        ):
            help_text = "its value is that of its arguments: write them as an output"
            scope.log.report(
                "E0203",
                f"{kind_of(owner)} has no variables",
                node.name.span,
                help=help_text if isinstance(owner, checked.Force) else "",
            )
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
    other = {*body_members(not scope.planar, turns), *(_GROUND if body.shape is None else ())}
    help_text = _OTHER[scope.planar].format(name) if name in other else ""
    _no_member(f"no {what} {name!r} on body {body.name!r}", node, candidates, scope, help_text)
    return None


def _of_liaison(liaison: checked.Liaison, node: tree.Member, scope: Scope) -> Thing | None:

    if node.name.text == "flange":
        return flange(liaison, node, scope)
    members = liaison_variables(liaison, scope.planar)
    name = node.name.text
    if name in ("stops", "butees"):
        own = " and ".join(f"'{liaison.name}.{x}'" for x in ("force", "torque") if x in members)
        scope.log.report(
            "E0203",
            f"the stops of liaison {liaison.name!r} have no variables of their own",
            node.name.span,
            help=f"their reaction is a part of {own}",
        )
        return None
    if name in liaison.kind.coordinates and name not in members and liaison.kind.along_curve:
        scope.log.report(
            "E0203",
            f"no variable {name!r} on liaison {liaison.name!r}: no closed form tells the arc "
            "length of its curve",
            node.name.span,
            help="read 'u', the parameter of the curve; only lines and circles have an 'abscissa'",
        )
        return None
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


def _no_member(
    message: str, node: tree.Member, names: tuple[str, ...], scope: Scope, help_text: str = ""
) -> None:
    help_text = help_text or did_you_mean(node.name.text, names, scope.log)
    listed = ", ".join(names[:20]) or "none"
    notes = () if help_text else (f"there are: {listed}",)
    scope.log.report("E0203", message, node.name.span, notes=notes, help=help_text)


def _component(owner: checked.Expression, node: tree.Member, scope: Scope) -> Thing | None:
    name = node.name.text
    quaternion = isinstance(owner, checked.Quantity) and owner.name == "orientation"
    names = _QUATERNION if quaternion else _AXES
    if len(owner.type.shape) == 1 and name in tuple(names[: owner.type.shape[0]]):
        return element(owner, names.index(name), node.span)
    if owner.type.is_scalar:
        message = f"{node.operand.span.text!r} is a scalar: it has no {name!r}"
    elif quaternion:
        message = f"an orientation has .w, .x, .y, .z, not '.{name}'"
    elif len(owner.type.shape) == 1 and owner.type.shape[0] <= 3:
        axes = ", ".join(f".{a}" for a in _AXES[: owner.type.shape[0]])
        message = f"a vector of this model has {axes}, not '.{name}'"
    else:
        message = f"{node.operand.span.text!r} is an array: its items are written with '[1]'"
    scope.log.report("E0203", message, node.name.span)
    return None
