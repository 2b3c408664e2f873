"""Liaisons with their laws, and applied forces."""

from __future__ import annotations

from typing import cast

from frot.dsl import checked
from frot.dsl.catalogue import (
    FORCES,
    LAWS,
    LIAISONS,
    Argument,
    LiaisonKind,
    arguments_for,
    find,
    spellings,
)
from frot.dsl.checked.describe import quantity
from frot.dsl.checked.liaison_variables import arc_of_unit, liaison_variables
from frot.dsl.declarations.arguments import bind
from frot.dsl.declarations.bounds import keep_positive
from frot.dsl.declarations.geometry import called
from frot.dsl.declarations.user_kinds import stated_law, stated_liaison
from frot.dsl.expressions.expression import expression, fitting
from frot.dsl.expressions.known import known
from frot.dsl.messages.diagnostics import Label
from frot.dsl.names.classes import Class
from frot.dsl.names.declared_types import find_class
from frot.dsl.names.near import did_you_mean, unknown_kind
from frot.dsl.names.scope import Scope
from frot.dsl.quantities.dimensions import BOOLEAN
from frot.dsl.quantities.turns import RATE, TURNING
from frot.dsl.text import tree


def liaison(node: tree.Liaison, full_name: str, scope: Scope) -> checked.Liaison | None:
    """The checked liaison, still to be completed by `complete_liaison`; None after a message."""
    call = called(node.kind, "liaison", scope)
    if call is None:
        return None
    name, callee, arguments = call
    kind = find(LIAISONS, name)
    if kind is None:
        defined = find_class(callee, scope)
        if defined is not None and defined.kind == "liaison":
            return _stated(node, full_name, defined, arguments, scope)
        if scope.knows(name):
            english = node.keyword == "joint"
            word = "joint" if english else "liaison"
            usable = [
                k.aliases[-1] if english and k.aliases else k.name
                for k in LIAISONS.values()
                if not scope.planar or k.relations_planar is not None
            ]
            log, known_names = scope.log, spellings(LIAISONS)
            unknown_kind(word, name, known_names, callee.span, log, usable=usable)
        return None
    if scope.planar and kind.relations_planar is None:
        scope.log.report(
            "E0506", f"{name!r} is a liaison of space models; this model is planar", callee.span
        )
        return None
    arguments = (*arguments, *_told_by_drives(node, kind, arguments))
    found = bind(arguments, kind.arguments, name, node.kind.span, scope)
    if not found.complete:
        return None
    a = cast(checked.Place, found.values.pop("a"))
    b = cast(checked.Place, found.values.pop("b"))
    if not _parts_agree(node, kind.name, a, b, scope):
        return None
    options = cast("dict[str, checked.Expression]", found.values)
    keep_positive(options, kind.arguments, f"liaison '{full_name}'", scope)
    return checked.Liaison(full_name, kind, a, b, options, (), node.span, node.doc)


def _told_by_drives(
    node: tree.Liaison, kind: LiaisonKind, arguments: tuple[tree.Argument, ...]
) -> list[tree.Argument]:
    """Arguments that are coordinates and not given: what drives them says what they are."""
    plain = sum(x.name is None for x in arguments)
    given = {x.name.span.text for x in arguments if x.name is not None}
    open_ = {x.name for x in kind.arguments[plain:] if x.name in kind.coordinates} - given
    return [x for x in node.driven or () if x.name is not None and x.name.span.text in open_]


def _stated(
    node: tree.Liaison,
    name: str,
    of: Class,
    arguments: tuple[tree.Argument, ...],
    scope: Scope,
) -> checked.Liaison | None:
    """A liaison of the user."""
    found = stated_liaison(of, arguments, node.kind.span, scope)
    if found is None:
        return None
    kind, (a, b, *others), relations = found
    if not others and not _parts_agree(node, kind.name, a, b, scope):
        return None
    if node.driven is not None:
        scope.log.report("E0204", f"{of.name!r} has no coordinate to drive", node.driven_span)
        return None
    no = checked.Literal(False, BOOLEAN, node.span)
    return checked.Liaison(
        name, kind, a, b, {"unilateral": no}, (), node.span, node.doc, relations=relations
    )


def _driven(
    node: tree.Liaison, made: checked.Liaison, scope: Scope
) -> dict[str, checked.Expression]:
    """Check `driven(angle = ...)`: the values by their coordinates, none after a message."""
    driven: dict[str, checked.Expression] = {}
    known_coordinates = liaison_variables(made, scope.planar)
    own = [c for c in made.kind.coordinates if c in known_coordinates]
    for argument in node.driven or ():
        name = argument.name.span.text if argument.name is not None else ""
        if name not in own:
            what = f"{name!r} is not a coordinate" if name else "name the coordinate that is driven"
            scope.log.report(
                "E0204",
                f"{what} of liaison {made.name!r}",
                argument.span,
                notes=(f"its coordinates are: {', '.join(own) or 'none'}",),
                help=did_you_mean(name, own),
            )
            return {}
        if name == "orientation":
            scope.log.report(
                "E0204",
                f"'orientation' of liaison {made.name!r} cannot be driven",
                argument.span,
                help="drive 'angular_velocity' and state the orientation in 'initial', or weld to "
                "a frame that is rotated by a function of time",
            )
            return {}
        key = "u" if name == "abscissa" else name
        if key in driven:
            message = f"{name!r} of liaison {made.name!r} is driven twice"
            scope.log.report("E0204", message, argument.span)
            return {}
        own_option = made.options.get(name)
        said = own_option is not None and own_option.span == argument.value.span
        if said and not made.kind.unilateral:
            continue  # it says what the argument of that name is
        kind, found = known_coordinates[name], expression(argument.value, scope)
        if found is None:
            return {}
        rate = TURNING if kind.dimension == RATE else ""
        value = fitting(found, argument.value, kind, scope, rate=rate)
        if value is None:
            return {}
        arc = arc_of_unit(made.b) if name == "abscissa" else None
        if arc is not None:
            value = checked.Binary("/", value, arc, known_coordinates["u"], value.span)
        driven[key] = value
    return driven


def _parts_agree(
    node: tree.Liaison, kind: str, a: checked.Place, b: checked.Place, scope: Scope
) -> bool:
    if _root(a) is _root(b):
        scope.log.report(
            "E0507",
            f"both places of {node.keyword} {node.name.text!r} are on body {_root(a).name!r}",
            node.kind.span,
        )
        return False
    points = (checked.BodyPoint, checked.Frame)
    if kind == "contact_ponctuel" and isinstance(a, points) and isinstance(b, points):
        scope.log.report(
            "E0205", "a contact needs a curve or a surface on one side", node.kind.span
        )
        return False
    return True


def _root(place: checked.Place) -> checked.Body:
    owner: checked.Body | checked.Frame
    match place:
        case checked.CurvePlace(curve=curve):
            owner = curve.owner
        case checked.SurfacePlace(surface=surface):
            owner = surface.owner
        case checked.Frame():
            owner = place
        case checked.BodyPoint(body=body) | checked.BodyGeometry(body=body):
            owner = body
    while isinstance(owner, checked.Frame):
        owner = owner.owner
    return owner


def complete_liaison(node: tree.Liaison, to: checked.Liaison | None, scope: Scope) -> None:
    """Check the drives and laws of a liaison once every name has its meaning.

    They may read any coordinate, that of their own liaison among them. `to` is None where the
    liaison itself was refused.
    """
    if to is not None and node.driven is not None and not to.relations:
        object.__setattr__(to, "driven", _driven(node, to, scope))
    found: list[checked.Law] = []
    for written in node.laws:
        law = _law(written, to, scope)
        if law is None:
            continue
        same = next((other for other in found if other.kind is law.kind), None)
        if same is not None and not law.kind.repeats:
            message = f"the law {law.kind.name!r} is given twice"
            first = Label(same.span, "first here")
            scope.log.report("E0502", message, law.span, labels=(first,))
        found.append(law)
    if to is not None:
        object.__setattr__(to, "laws", tuple(found))


def _law(written: tree.Expression, to: checked.Liaison | None, scope: Scope) -> checked.Law | None:
    call = called(written, "law", scope)
    if call is None:
        return None
    name, callee, arguments = call
    kind = find(LAWS, name)
    if kind is None:
        defined = find_class(callee, scope)
        if defined is not None and defined.kind == "law":
            return stated_law(defined, arguments, written.span, to, scope)
        if scope.knows(name):
            unknown_kind("law", name, spellings(LAWS), callee.span, scope.log, usable=LAWS)
        return None
    wanted = kind.arguments if to is None else arguments_for(kind, to.kind)
    found = bind(arguments, wanted, name, written.span, scope)
    if not found.complete:
        return None
    values = cast("dict[str, checked.Expression]", found.values)
    _check_pairs(wanted, values, scope)
    return checked.Law(kind, values, written.span)


def _check_pairs(
    kinds: tuple[Argument, ...], values: dict[str, checked.Expression], scope: Scope
) -> None:
    """Report a literal that is below the one it must not be below."""
    for kind in kinds:
        low, high = kind.not_below, kind.name
        if low in values and high in values:
            a, b = known(values[low], scope), known(values[high], scope)
            if isinstance(a, float) and isinstance(b, float) and b < a:
                of = values[high].type
                scope.log.report(
                    "E0402",
                    f"{high} must not be below {low}: {quantity(b, of)} < {quantity(a, of)}",
                    values[high].span,
                )


def force(node: tree.Force, full_name: str, scope: Scope) -> checked.Force | None:
    """The checked force; None after a message."""
    call = called(node.kind, "force", scope)
    if call is None:
        return None
    name, callee, arguments = call
    kind = find(FORCES, name)
    if kind is None:
        if scope.knows(name):
            unknown_kind("force", name, spellings(FORCES), callee.span, scope.log, usable=FORCES)
        return None
    found = bind(arguments, kind.arguments, name, node.kind.span, scope)
    if not found.complete:
        return None
    values = cast("dict[str, checked.Expression | checked.Place | checked.Liaison]", found.values)
    return checked.Force(full_name, kind, values, node.span, node.doc)
