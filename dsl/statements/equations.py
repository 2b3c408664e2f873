"""The section `equation`: equations, `if` and `for`, connections and assertions."""

from __future__ import annotations

from dataclasses import dataclass, field

from frot.dsl import checked
from frot.dsl.checked.describe import describe, written_unit
from frot.dsl.checked.evaluation import constant
from frot.dsl.expressions.expression import NUMERIC, expect, fitting, value_of
from frot.dsl.expressions.rates import rate_of
from frot.dsl.expressions.records import pairs
from frot.dsl.expressions.seconds import seconds_missing
from frot.dsl.messages.diagnostics import Label
from frot.dsl.messages.source import Span
from frot.dsl.names.scope import Record, Scope
from frot.dsl.names.sections import called_name
from frot.dsl.quantities.dimensions import BOOLEAN, Type
from frot.dsl.statements.connect import connect
from frot.dsl.statements.unfold import Leaf, unfold
from frot.dsl.text import tree

Made = checked.Equation | checked.IfEquations


@dataclass(slots=True)
class Sink:
    """Where equations go; `guard` is the condition of the branch they stand in."""

    made: list[Made] = field(default_factory=list)
    guard: checked.Expression | None = None
    branch: Span | None = None


# ------------------------------------------------------------------ one statement


def statement(leaf: Leaf, sink: Sink) -> None:
    """Check one statement that is not a `when` and put what it gives into the sink."""
    element, scope = leaf
    if isinstance(element, tree.IfEquation):
        _if(element, scope, sink)
        return
    assert isinstance(element, tree.Equation)
    if element.right is not None:
        _equation(element, scope, sink)
        return
    name = called_name(element)
    call = element.left
    if name == "connect":
        assert isinstance(call, tree.Call)
        if sink.branch is not None:
            scope.log.report(
                "E0501",
                "'connect' in an 'if' whose condition can change",
                element.span,
                labels=(Label(sink.branch, "this condition"),),
                help="connections are fixed: use a Boolean or Integer parameter",
            )
            return
        connect(call, scope)
    elif name == "assert":
        assert isinstance(call, tree.Call)
        made = assertion(call, scope)
        if made is not None:
            scope.build.assertions.append(_guarded(made, sink.guard))
    elif name in ("reinit", "terminate"):
        scope.log.report("E0501", f"{name!r} stands in 'when' only", element.span)
    elif name != "experiment" or not scope.log.failed:  # else the missing 'end if' was reported
        what = f"{name!r} is not a statement" if name else "this is not a statement"
        scope.log.report("E0501", what, element.span, help="an equation is written 'left = right;'")


def _guarded(made: checked.Assertion, guard: checked.Expression | None) -> checked.Assertion:
    """The assertion of a branch: it counts only where the branch is taken."""
    if guard is None:
        return made
    outside = checked.Unary("not", guard, BOOLEAN, made.span)
    condition = checked.Binary("or", outside, made.condition, BOOLEAN, made.span)
    return checked.Assertion(condition, made.message, made.level, made.span, made.owner)


def _equation(element: tree.Equation, scope: Scope, sink: Sink) -> None:
    assert element.right is not None
    sides = both_sides(element.left, element.right, scope)
    if sides is None:
        return
    for left, right in sides:
        if constant(left) is None and constant(right) is None:
            scope.log.report(
                "E0508",
                "this equation holds only parameters: it determines nothing",
                element.span,
                help="name a variable on one side, or give the parameter its value where it is "
                "declared",
            )
            return
        scope.build.grow(1, element.span)
        sink.made.append(checked.Equation(left, right, element.span, scope.instance.name))


def both_sides(
    left: tree.Expression, right: tree.Expression, scope: Scope
) -> list[tuple[checked.Expression, checked.Expression]] | None:
    """The sides of an equation, of one type; those of records member by member."""
    first, second = value_of(left, scope), value_of(right, scope)
    if first is None or second is None:
        return None
    if isinstance(first, Record) or isinstance(second, Record):
        if (
            isinstance(first, Record)
            and isinstance(second, Record)
            and first.of.definition is second.of.definition
        ):
            return list(pairs(first, second))
        shown = [
            f"a record {x.of.name!r}" if isinstance(x, Record) else describe(x.type)
            for x in (first, second)
        ]
        message = f"the sides differ: {shown[0]} = {shown[1]}"
        scope.log.report("E0301", message, right.span, caret=shown[1])
        return None
    if first.type.base == "string":
        scope.log.report("E0304", "texts have no equations", left.span)
        return None
    wanted = first.type
    if wanted.base in NUMERIC and wanted.enumeration is None and second.type.base == "real":
        # A whole number may stand on the left of a sum of others.
        wanted = wanted if isinstance(first, checked.Reference) else _real(first)
    unit, rate, remedy = (
        written_unit(first),
        rate_of(first),
        seconds_missing(first.type, second, first),
    )
    fitted = fitting(second, right, wanted, scope, unit=unit, rate=rate, remedy=remedy)
    return None if fitted is None else [(first, fitted)]


def _real(node: checked.Expression) -> Type:
    return Type("real", node.type.dimension, node.type.shape)


def assertion(call: tree.Call, scope: Scope) -> checked.Assertion | None:
    """The checked `assert(condition, "message", level = warning)`; None after a message."""
    level = "error"
    plain = []
    for argument in call.arguments:
        if argument.name is None:
            plain.append(argument.value)
            continue
        name, value = argument.name.span.text, argument.value
        if name != "level" or not isinstance(value, tree.Name):
            message = f"'assert' has no option {argument.span.text!r}"
            scope.log.report("E0204", message, argument.span, help="write 'level = warning'")
            return None
        if value.text not in ("error", "warning"):
            message = f"'level' is 'error' or 'warning', found {value.text!r}"
            scope.log.report("E0404", message, value.span)
            return None
        level = value.text
    if len(plain) != 2 or not isinstance(plain[1], tree.Text):
        scope.log.report("E0204", "write 'assert(condition, \"what is wrong\")'", call.span)
        return None
    condition = expect(plain[0], BOOLEAN, scope)
    if condition is None:
        return None
    return checked.Assertion(condition, plain[1].value, level, call.span, scope.instance.name)


# ------------------------------------------------------------------ `if` that can change


def _if(element: tree.IfEquation, scope: Scope, sink: Sink) -> None:
    branches: list[tuple[checked.Expression | None, tuple[Made, ...]]] = []
    sound = True
    before: checked.Expression | None = None
    for branch in element.branches:
        condition = None
        if branch.condition is not None:
            condition = expect(branch.condition, BOOLEAN, scope)
            sound = sound and condition is not None
        guard = _and_not(condition, before)
        inner = Sink(guard=_both(sink.guard, guard), branch=branch.span)
        failed = len(scope.log.diagnostics)
        for part in branch.elements:
            for leaf in unfold(part, scope):
                if isinstance(leaf[0], tree.When):
                    message = "a 'when' in an 'if' whose condition can change"
                    scope.log.report("E0501", message, leaf[0].span)
                else:
                    statement(leaf, inner)
        sound = sound and len(scope.log.diagnostics) == failed
        branches.append((condition, tuple(inner.made)))
        before = _either(before, condition)
    if not sound:
        return
    has_else = element.branches[-1].condition is None
    counts = [sum(count(m) for m in made) for _, made in branches]
    if len(set(counts if has_else else [*counts, 0])) > 1:
        shown = ", ".join(str(c) for c in counts) + ("" if has_else else " and 0 without 'else'")
        labels = tuple(
            Label(b.span, f"{c} equation{'' if c == 1 else 's'}")
            for b, c in zip(element.branches, counts, strict=True)
        )
        scope.log.report(
            "E0516",
            f"the branches of 'if' have different numbers of equations: {shown}",
            labels[0].span,
            caret=labels[0].text,
            labels=labels[1:],
            help="give every branch as many equations, with an 'else'",
        )
    elif counts[0]:
        sink.made.append(checked.IfEquations(tuple(branches), element.span, scope.instance.name))


def _either(
    a: checked.Expression | None, b: checked.Expression | None
) -> checked.Expression | None:
    if a is None or b is None:
        return a or b
    return checked.Binary("or", a, b, BOOLEAN, b.span)


def _both(a: checked.Expression | None, b: checked.Expression | None) -> checked.Expression | None:
    if a is None or b is None:
        return a or b
    return checked.Binary("and", a, b, BOOLEAN, b.span)


def _and_not(
    condition: checked.Expression | None, before: checked.Expression | None
) -> checked.Expression | None:
    if before is None:
        return condition
    return _both(checked.Unary("not", before, BOOLEAN, before.span), condition)


def count(made: Made) -> int:
    """The number of scalar equations."""
    if isinstance(made, checked.Equation):
        return made.left.type.count
    return sum(count(m) for m in made.branches[0][1])
