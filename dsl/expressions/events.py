"""Calls of functions that belong to events and to dry friction between variables."""

from __future__ import annotations

from frot.dsl import checked
from frot.dsl.catalogue import TYPES
from frot.dsl.checked.describe import describe
from frot.dsl.checked.evaluation import constant
from frot.dsl.expressions.expression import NUMERIC, expect, expression
from frot.dsl.expressions.known import known, out_of_bounds
from frot.dsl.names.scope import Scope
from frot.dsl.quantities.dimensions import BOOLEAN, Type
from frot.dsl.text import tree

_BOUNDS = {
    TYPES["Velocity"].dimension: TYPES["Force"],
    TYPES["AngularVelocity"].dimension: TYPES["Torque"],
}


def event_call(node: tree.Call, scope: Scope) -> checked.Expression | None:
    """The checked call; None after a message."""
    assert isinstance(node.callee, tree.Name)
    name = node.callee.text
    match name:
        case "initial":
            return checked.Call("initial", (), BOOLEAN, node.span)
        case "sample":
            return _sample(node, scope)
        case "friction":
            return _friction(node, scope)
        case "noEvent":
            inner = expression(node.arguments[0].value, scope)
            return None if inner is None else checked.Call(name, (inner,), inner.type, node.span)
        case "smooth":
            return _smooth(node, scope)
        case "edge":
            found = expect(node.arguments[0].value, BOOLEAN, scope)
            return None if found is None else checked.Call(name, (found,), BOOLEAN, node.span)
    return _before(name, node, scope)


def _smooth(node: tree.Call, scope: Scope) -> checked.Expression | None:
    """`smooth(n, x)`: x, of which the author says that it and n derivatives do not jump."""
    order = expect(node.arguments[0].value, Type("integer"), scope)
    value = expression(node.arguments[1].value, scope)
    if order is None or value is None:
        return None
    if constant(order) is not None or value.type.base != "real":
        what = "a number" if value.type.base != "real" else "a fixed number of derivatives, first"
        scope.log.report("E0304", f"'smooth' takes {what}", node.span, help="write 'smooth(1, x)'")
        return None
    return checked.Call("smooth", (order, value), value.type, node.span)


def _before(name: str, node: tree.Call, scope: Scope) -> checked.Expression | None:
    """`pre(x)` and `change(x)`, of a variable."""
    found = expression(node.arguments[0].value, scope)
    if found is None:
        return None
    inner = found
    while isinstance(inner, checked.Element):
        inner = inner.operand
    if not isinstance(inner, checked.Reference) or not isinstance(inner.target, checked.Variable):
        if isinstance(inner, checked.Quantity) and inner.name == "mode":
            return checked.Call(name, (found,), found.type if name == "pre" else BOOLEAN, node.span)
        # What moves by itself does not jump where an event is told: it is its own value before.
        moving = isinstance(inner, checked.Quantity | checked.Time)
        if name == "pre" and scope.in_when and moving:
            return found
        message = f"{name!r} is of a variable of the equations"
        scope.log.report("E0304", message, node.arguments[0].span)
        return None
    target = inner.target
    if name == "pre" and scope.in_when and not target.discrete and target.type.base == "real":
        # In a `when` a variable that moves still has the value that it had before the event.
        return found
    kind = found.type if name == "pre" else BOOLEAN
    made = checked.Call(name, (found,), kind, node.span)
    scope.build.before.append((made, target, scope.in_when))
    return made


def _sample(node: tree.Call, scope: Scope) -> checked.Expression | None:
    found = [expect(a.value, TYPES["Time"], scope) for a in node.arguments]
    times = [f for f in found if f is not None]
    if len(times) < len(found):
        return None
    for one in times:
        moving = constant(one)
        if moving is not None:
            message = "the times of 'sample' depend on parameters only"
            scope.log.report("E0305", message, moving.span, caret="this varies")
            return None
    interval = known(times[1], scope)
    if isinstance(interval, float) and interval <= 0:
        message = f"the interval of 'sample' must be positive; it is {interval:g} s"
        out_of_bounds(message, times[1].span, scope)
        return None
    return checked.Call("sample", tuple(times), BOOLEAN, node.span)


def _friction(node: tree.Call, scope: Scope) -> checked.Expression | None:
    slip = expression(node.arguments[0].value, scope)
    if slip is None:
        return None
    bound = _BOUNDS.get(slip.type.dimension)
    if slip.type.base not in NUMERIC or not slip.type.is_scalar or bound is None:
        scope.log.report(
            "E0301",
            "the slip of 'friction' is a velocity (m/s) or an angular velocity (1/s), found "
            f"{describe(slip.type)}",
            node.arguments[0].span,
        )
        return None
    bounds = [expect(a.value, bound, scope) for a in node.arguments[1:]]
    found = [b for b in bounds if b is not None]
    if len(found) < len(bounds):
        return None
    arguments = (slip, found[0], found[-1])
    return checked.Call("friction", arguments, Type("real", bound.dimension), node.span)
