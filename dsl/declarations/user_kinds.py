"""Liaisons, laws and shapes of the user: what they say where a model uses them.

It is checked in the world of that model, planar or space. A liaison is its relations, a shape the
arguments of a `solid`; a law is checked and then refused by name.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import cast

from frot.dsl import checked
from frot.dsl.catalogue import SHAPES, LawKind, LiaisonKind
from frot.dsl.catalogue.liaisons import SLIDING
from frot.dsl.catalogue.types import FORCE, VELOCITY
from frot.dsl.checked.arrays import scalars
from frot.dsl.checked.describe import written_unit
from frot.dsl.declarations.argument_values import nature_of
from frot.dsl.declarations.arguments import bind
from frot.dsl.expressions.expression import expect, expression, fitting
from frot.dsl.expressions.names import place
from frot.dsl.expressions.rates import rate_of
from frot.dsl.expressions.structure import sizes
from frot.dsl.messages.source import Source, Span
from frot.dsl.names.classes import Class
from frot.dsl.names.declared_types import Kind, find_type, split_type
from frot.dsl.names.imports import enter
from frot.dsl.names.near import did_you_mean
from frot.dsl.names.scope import Entity, Instance, Scope
from frot.dsl.names.things import kind_of
from frot.dsl.quantities.dimensions import Type
from frot.dsl.text import tree

_NOWHERE = Span(Source("", ""), 0, 0)
_PLACES = ("frame", "body", "point", "curve", "surface", "repère", "repere", "corps")


def stated_liaison(
    of: Class, arguments: tuple[tree.Argument, ...], span: Span, scope: Scope
) -> tuple[LiaisonKind, list[checked.Place], tuple[checked.StatedRelation, ...]] | None:
    """A liaison of the user where it is used: its kind, its places, its relations."""
    bound = _bind(of, arguments, span, scope)
    if bound is None:
        return None
    inner, local = bound
    at = inner.inside(**local)
    relations: list[checked.StatedRelation] = []
    complete = True
    for element in of.elements:
        if isinstance(element, tree.Relation):
            found = _relations(element, at)
            complete = complete and found is not None
            relations.extend(found or ())
        elif not isinstance(element, tree.Import | tree.Definition | tree.Alias | tree.Component):
            complete = False
            scope.log.report(
                "E0501",
                "a liaison holds relations: 'kinematic a = b;' or 'geometric a = b;'",
                element.span,
                help="put what begins with a sign into parentheses: 'kinematic (-a + b) = 0;'"
                if element.span.text.startswith(("kinematic", "geometric"))
                else "",
            )
    if not complete:
        return None
    places = [p for p in map(_place_of, local.values()) if p is not None]
    count = len(relations)
    if len(places) < 2 or count == 0:
        lacks = "two places that are frames, points or bodies" if len(places) < 2 else "a relation"
        scope.log.report("E0501", f"the liaison {of.name!r} needs {lacks}", of.definition.span)
        return None
    kind = LiaisonKind(
        of.name,
        (),
        count,
        count,
        title=of.name,
        laws=SLIDING,
        laws_in_space=SLIDING,
        own_laws=("plane", "space"),
    )
    return kind, places, tuple(relations)


def _relations(element: tree.Relation, at: Scope) -> list[checked.StatedRelation] | None:
    """Scalar relations, one for each component of the left side."""
    left = expression(element.left, at)
    right = None if left is None else expression(element.right, at)
    if left is None or right is None:
        return None
    # A bare zero stands for no value of any kind.
    zero = isinstance(right, checked.Literal) and right.value == 0.0 and not right.unit
    if not zero:
        unit, rate = written_unit(left), rate_of(left)
        fitted = fitting(right, element.right, left.type, at, unit=unit, rate=rate)
        if fitted is None:
            return None
        right = fitted
    lefts = scalars(left)
    rights = [right] * len(lefts) if zero else scalars(right)
    kinematic = element.kind == "kinematic"
    return [checked.StatedRelation(*two, kinematic) for two in zip(lefts, rights, strict=True)]


def _place_of(thing: Entity) -> checked.Place | None:
    """The place that a formal argument stands for; None for a value."""
    if isinstance(thing, checked.Body):
        home = "origin" if thing.shape is None else thing.shape.home
        return checked.BodyPoint(thing, home, thing.span or _NOWHERE)
    places = (checked.BodyPoint, checked.Frame, checked.CurvePlace, checked.BodyGeometry)
    return thing if isinstance(thing, places) else None


def stated_law(
    of: Class,
    arguments: tuple[tree.Argument, ...],
    span: Span,
    liaison: checked.Liaison | None,
    scope: Scope,
) -> checked.Law | None:
    """A law of the user where it is used: what `slip` and `normal` are in it is the liaison's."""
    bound = _bind(of, arguments, span, scope)
    if bound is None:
        return None
    inner, local = bound
    here = of.definition.span
    for name, member, kind in (("slip", "slip", VELOCITY), ("normal", "normal_force", FORCE)):
        if liaison is None:
            local[name] = checked.Variable(name, kind, here)
        else:
            value = checked.Quantity(liaison, member, kind, span)
            local[name] = checked.Parameter(name, kind, value, here, constant=True)
    values = _values(of, {"tangential": FORCE}, inner.inside(**local))
    if liaison is None or values is None:
        return None
    if not values:
        message = f"the law {of.name!r} gives no value to 'tangential'"
        scope.log.report("E0204", message, span, help="write `tangential = ...;` in it")
        return None
    return checked.Law(LawKind(of.name, ()), values, span)


def stated_shape(
    of: Class, arguments: tuple[tree.Argument, ...], span: Span, scope: Scope
) -> dict[str, checked.Expression] | None:
    """The arguments of a `solid` that a user's shape defines where it is used."""
    bound = _bind(of, arguments, span, scope)
    if bound is None:
        return None
    inner, local = bound
    given: list[tree.Argument] = []
    complete = True
    for element in of.elements:
        if isinstance(element, tree.Equation) and element.right is not None:
            given.append(tree.Argument(element.left, element.right, element.span))
        elif not isinstance(element, tree.Import | tree.Definition | tree.Alias | tree.Component):
            complete = False
            scope.log.report("E0501", "this cannot stand in a shape", element.span)
    wanted = SHAPES["solid"].arguments
    found = bind(given, wanted, of.name, span, inner.inside(**local), constants=True)
    if not (complete and found.complete):
        return None
    return cast("dict[str, checked.Expression]", found.values)


def _values(of: Class, wanted: dict[str, Type], at: Scope) -> dict[str, checked.Expression] | None:
    """The values that the statements `name = value;` of a law give; None after a message."""
    found: dict[str, checked.Expression] = {}
    complete = True
    for element in of.elements:
        if isinstance(element, tree.Equation) and element.right is not None:
            name = element.left.span.text
            kind = wanted.get(name)
            if kind is None:
                names = ", ".join(wanted)
                at.log.report(
                    "E0501",
                    f"a law gives values to: {names}",
                    element.left.span,
                    help=did_you_mean(name, wanted),
                )
                complete = False
                continue
            value = expect(element.right, kind, at)
            if value is None:
                complete = False
            else:
                found[name] = value
        elif isinstance(element, tree.Equation | tree.Relation | tree.When | tree.For):
            at.log.report("E0501", "this cannot stand in a law", element.span)
            complete = False
    return found if complete else None


def _bind(
    of: Class, arguments: tuple[tree.Argument, ...], span: Span, scope: Scope
) -> tuple[Scope, dict[str, Entity]] | None:
    """The scope of the definition, and what its formal arguments stand for."""
    definition = of.definition
    assert isinstance(definition, tree.Definition)
    inner = Scope(scope.build, Instance("", of, definition.span), enter(of, scope.build.libraries))
    formals = {f.name.text: f for f in definition.formals}
    given: dict[str, tree.Expression] = {}
    order = list(formals)
    for position, argument in enumerate(arguments):
        if argument.name is None:
            name = order[position] if position < len(order) else ""
        else:
            name = argument.name.span.text
        if name not in formals or name in given:
            message = (
                f"{of.name!r} has no argument {name!r}"
                if name
                else (f"too many arguments for {of.name!r}")
            )
            message = f"{name!r} of {of.name!r} is given twice" if name in given else message
            notes = (f"its arguments are: {', '.join(order)}",)
            scope.log.report("E0204", message, argument.span, notes=notes)
            return None
        given[name] = argument.value
    local: dict[str, Entity] = {}
    for name, formal in formals.items():
        found = _formal(formal, given.get(name), of, span, inner, scope, local)
        if found is None:
            return None
        local[name] = found
    for formal in _values_inside(of):
        name = formal.name.text
        if formal.value is None or name in local:
            fault = "declared twice" if name in local else "given no value"
            scope.log.report("E0204", f"{name!r} is {fault} in {of.name!r}", formal.span)
            return None
        found = _formal(formal, None, of, span, inner, scope, local)
        if found is None:
            return None
        local[name] = found
    return inner, local


def _values_inside(of: Class) -> Iterator[tree.Formal]:
    """The values that a definition gives names, as `Length way = norm(b.position);`."""
    for element in of.elements:
        if not isinstance(element, tree.Component):
            continue
        kind, before = split_type(element)
        for item in element.declared:
            yield tree.Formal(item.name, kind, item.value, item.span, (*before, *item.subscripts))


def _formal(
    formal: tree.Formal,
    node: tree.Expression | None,
    of: Class,
    span: Span,
    inner: Scope,
    scope: Scope,
    local: dict[str, Entity],
) -> Entity | None:
    if formal.type is None:
        message = f"the argument {formal.name.text!r} has no type"
        help_text = f"write 'Real {formal.name.text}' or '{formal.name.text}: frame'"
        scope.log.report("E0206", message, formal.span, help=help_text)
        return None
    there = scope
    if node is None:
        node, there = formal.value, inner.inside(**local)
    if node is None:
        message = f"{of.name!r} needs {formal.name.text!r}"
        scope.log.report("E0204", message, span)
        return None
    told = formal.type.span.text
    if told in _PLACES:
        found = place(node, there)
        if isinstance(found, checked.BodyGeometry) and told not in ("curve", "surface"):
            found = found.centre or found
        if found is None or not _is_a(found, formal.name.text, told, of, node, scope):
            return None
        if isinstance(found, checked.BodyPoint) and told in ("body", "corps"):
            return found.body
        if isinstance(found, checked.CurvePlace):
            return found.curve
        if isinstance(found, checked.SurfacePlace):
            return found.surface
        return found  # type: ignore[return-value]
    kind = find_type(formal.type, inner, True)
    shape = sizes(formal.sizes, formal.name, inner.inside(**local))
    if kind is None or shape is None:
        return None
    if not isinstance(kind, Kind):
        scope.log.report(
            "E0206", f"{kind.kind} {kind.name!r} is not a type of values", formal.type.span
        )
        return None
    value = expression(node, there)
    if value is None:
        return None
    wanted = kind.type.of_shape((*kind.type.shape, *shape))
    value = fitting(value, node, wanted, there, unit=kind.unit, rate=kind.rate)
    # A variable of this type stands for the value: the text of the definition is what is checked.
    if value is None:
        return None
    return checked.Parameter(formal.name.text, wanted, value, formal.span, constant=True)


def _is_a(
    found: checked.Place | checked.SurfacePlace,
    name: str,
    told: str,
    of: Class,
    node: tree.Expression,
    scope: Scope,
) -> bool:
    """Whether a place is what the argument is declared as; reported where it is not."""
    wanted = told if told in ("curve", "surface") else "point"
    if nature_of(found) == wanted:
        return True
    message = f"{name!r} of {of.name!r} is a {told}, found {kind_of(found)}"
    scope.log.report("E0205", message, node.span, caret=f"a {nature_of(found)}")
    return False


__all__ = ["stated_law", "stated_liaison", "stated_shape"]
