"""An expression of the tree to a checked one, and whether it is of the type that is wanted.

What each kind of expression is stands in `rules.py`; this module knows none of them.
"""

from __future__ import annotations

from dataclasses import replace

from frot.dsl import checked
from frot.dsl.checked.arrays import element
from frot.dsl.checked.describe import describe, pair, written_unit
from frot.dsl.expressions.rates import as_rate
from frot.dsl.expressions.seconds import seconds_missing
from frot.dsl.names.scope import Record, Scope
from frot.dsl.quantities.dimensions import Type
from frot.dsl.text import tree

NUMERIC = ("real", "integer")


def expression(node: tree.Expression, scope: Scope) -> checked.Expression | None:
    """The checked expression, or None after a message (or where one was already given)."""
    found = value_of(node, scope)
    if isinstance(found, Record):
        tell_no_value(f"a record {found.of.name!r}", node, "name one of its members", scope)
        return None
    return found


def value_of(node: tree.Expression, scope: Scope) -> checked.Expression | Record | None:
    """As `expression`, where a whole record may stand too."""
    return scope.build.checks.expressions[type(node)](node, scope)


def expect(
    node: tree.Expression, kind: Type, scope: Scope, *, others: tuple[Type, ...] = ()
) -> checked.Expression | None:
    """The checked expression if it is of this type (or of one of `others`)."""
    found = expression(node, scope)
    return None if found is None else fitting(found, node, kind, scope, others=others)


def fitting(
    found: checked.Expression,
    node: tree.Expression,
    kind: Type,
    scope: Scope,
    *,
    others: tuple[Type, ...] = (),
    unit: str = "",
    rate: str = "",
    remedy: str = "",
) -> checked.Expression | None:
    """The expression, or its item for one of an array declaration; None after a message.

    `unit` is the one the author wrote for what is expected, `rate` the kind of rate it is, `remedy`
    the help where nothing better is known.
    """
    if any(agrees(found.type, k) for k in (kind, *others)):
        return as_rate(found, rate, scope)
    by_form = found.type.base != "integer" and is_whole(found)
    if kind.base == "integer" and kind.enumeration is None and by_form:
        whole = as_integer(found)
        return fitting(whole, node, kind, scope, others=others, unit=unit, remedy=remedy)
    if scope.element is not None and found.type.shape[:1] == scope.element[1:]:
        item = element(found, scope.element[0], found.span)
        if any(agrees(item.type, k) for k in (kind, *others)):
            return as_rate(item, rate, scope)
    is_number = kind.base == "integer" and agrees(found.type, Type(shape=kind.shape))
    wanted, shown = pair(kind, found.type, unit, written_unit(found))
    wanted = " or ".join((wanted, *(describe(k) for k in others)))
    if is_number and kind.enumeration is None:
        wanted, shown = "a whole number", "a number that may be none"
    help_text = ""
    if is_number and kind.enumeration is None:
        help_text = "round it: 'floor(...)'"
    elif kind.base not in NUMERIC:
        pass
    elif isinstance(node, tree.Number) and not node.unit and kind.is_scalar:
        help_text = f"write the unit: '{node.span.text} {unit or kind.dimension.unit}'"
    elif found.type.is_scalar and found.type.dimension == kind.dimension and kind.shape == (2,):
        zero = f"0 {kind.dimension.unit}".removesuffix(" 1")
        help_text = f"a vector is written '(x, y)': '({node.span.text}, {zero})'"
    elif isinstance(node, tree.Tuple) and not node.unit and found.type.dimension.is_one:
        help_text = f"write the unit after the tuple: '{node.span.text} {kind.dimension.unit}'"
    if not help_text or (kind.dimension.is_one and not is_number):
        help_text = _of_other_space(kind, found, scope) or remedy or seconds_missing(kind, found)
    scope.log.report(
        "E0301", f"expected {wanted}, found {shown}", node.span, caret=shown, help=help_text
    )
    return None


def _of_other_space(kind: Type, found: checked.Expression, scope: Scope) -> str:
    """The help for a pair in a space model, or three components in a planar one; or empty."""
    if kind.shape == (3,) and found.type.shape == (2,) and not scope.planar:
        return "this model is in space: write 'planar model' where positions are pairs"
    if kind.shape == (2,) and found.type.shape == (3,) and scope.planar:
        return "this model is planar: its vectors have two components, along x and y"
    return ""


def agrees(found: Type, wanted: Type) -> bool:
    """Whether a value of one type can stand where the other is wanted."""
    if wanted.enumeration is not None:
        return found == wanted
    if found.base in NUMERIC and wanted.base in NUMERIC:
        if found.enumeration is not None or (wanted.base == "integer" and found.base != "integer"):
            return False
        return found.dimension == wanted.dimension and found.shape == wanted.shape
    return found.base == wanted.base and found.shape == wanted.shape


def is_whole(node: checked.Expression) -> bool:
    """Whether an expression is a whole number by its form: `2`, `-n`, `(1, 2)`."""
    match node:
        case checked.Literal(value=value, type=kind):
            written_plain = kind.dimension.is_one and not node.unit
            return written_plain and isinstance(value, float) and value.is_integer()
        case checked.Unary(op="-", operand=operand):
            return is_whole(operand)
        case checked.Vector(items=items):
            return all(is_whole(i) for i in items)
        case checked.If(yes=yes, no=no):
            return is_whole(yes) and is_whole(no)
    return node.type.base == "integer" and node.type.enumeration is None


def as_integer(node: checked.Expression) -> checked.Expression:
    """A whole number by its form, typed so."""
    return replace(node, type=Type("integer", node.type.dimension, node.type.shape))


def tell_no_value(what: str, node: tree.Expression, help_text: str, scope: Scope) -> None:
    """Report a thing that is no value where one is needed."""
    message = f"{what} stands where a value is needed"
    scope.log.report("E0205", message, node.span, help=help_text)
