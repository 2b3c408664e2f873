"""Expressions of the text to CasADi expressions."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from typing import ClassVar

import casadi as ca
from frot.compiler.translate.conditions import RISING, ConditionTable
from frot.compiler.translate.previous_values import Before, whole
from frot.compiler.translate.symbols import Symbols
from frot.compiler.translate.walk import is_fixed, quantities_in
from frot.dsl import Log
from frot.dsl.catalogue import FUNCTIONS
from frot.dsl.checked import (
    Binary,
    Call,
    Derivative,
    Element,
    Expression,
    If,
    Input,
    Literal,
    Parameter,
    Quantity,
    Reference,
    Time,
    Unary,
    Variable,
    Vector,
)
from frot.dsl.checked.walk import Rules, SharedWalk, parts
from frot.dsl.checked.wording import words
from frot.dsl.messages.source import Span


@dataclass(slots=True)
class Lowering(SharedWalk[ca.SX]):
    """Lowers expressions; `quantity` gives the variables of bodies and liaisons, `rate` d/dt.

    `variable` gives the variables of the text, `before` those before an event;
    `friction` makes a friction element of its call, in the component named by `owner`;
    `without_rate` names what in a value has no derivative that anybody knows; `holds` tells
    the motions that friction holds, `at_rest` is `quantity` where they are zero.

    With `conditions`, every switch that depends on time, inputs or motion becomes a located event;
    without, it is taken as it stands (for what is only displayed: outputs, initial statements), but
    for those `known`, whose values are known.
    """

    symbols: Symbols
    quantity: Callable[[Quantity], ca.SX]
    rate: Callable[[ca.SX], ca.SX]
    log: Log
    conditions: ConditionTable | None = None
    known: ConditionTable | None = None
    variable: Callable[[Variable], ca.SX] | None = None
    before: Before | None = None
    friction: Callable[[Call, list[ca.SX], str], ca.SX] | None = None
    without_rate: Callable[[ca.SX], list[str]] | None = None
    holds: Callable[[Quantity], ca.SX] | None = None
    at_rest: Callable[[Quantity], ca.SX] | None = None
    owner: str = ""
    done: dict[int, tuple[Expression, ca.SX]] = field(default_factory=dict)

    def lower(self, expression: Expression) -> ca.SX:
        """The CasADi value: a scalar, a column or a matrix. Shared parts are lowered once."""
        return self.of(expression)

    def _literal(self, node: Literal) -> ca.SX:
        return ca.SX(float(node.value))

    def _time(self, node: Time) -> ca.SX:
        return self.symbols.t

    def _quantity(self, node: Quantity) -> ca.SX:
        return self.quantity(node)

    def _element(self, node: Element) -> ca.SX:
        whole = self.of(node.operand)
        if len(node.operand.type.shape) == 2:
            return whole[node.index, :].T
        return whole[node.index]

    def _vector(self, node: Vector) -> ca.SX:
        items = [self.of(item) for item in node.items]
        rows = [i.T for i in items] if len(node.type.shape) == 2 else items
        return ca.vertcat(*rows) if rows else ca.SX.zeros(0)

    def _unary(self, node: Unary) -> ca.SX:
        value = self.of(node.operand)
        return 1 - value if node.op == "not" else -value

    def _if(self, node: If) -> ca.SX:
        condition, yes, no = (self.of(part) for part in parts(node))
        return ca.if_else(condition, yes, no)

    def _rate(self, node: Derivative) -> ca.SX:
        value = self.of(node.operand)
        unknown = self.without_rate(value) if self.without_rate is not None else []
        if not unknown:
            return self.rate(value)
        self.log.report(
            "E0606",
            f"the derivative of {unknown[0]} is not known here",
            node.span,
            help="let the value act through a filter, `der(x) = (value - x)/T`, and read `der(x)`",
        )
        return value * 0

    def _reference(self, node: Reference) -> ca.SX:
        target = node.target
        if isinstance(target, Parameter) and target.constant:
            return self.of(target.value)
        if isinstance(target, Parameter | Input):
            return self.symbols.value(target)
        if isinstance(target, Variable):
            assert self.variable is not None
            return self.variable(target)
        return self.of(target.value)

    def _located(self, expression: Expression) -> ConditionTable | None:
        """Where the events of a switch go; None if it never changes or is only displayed."""
        return None if is_fixed(expression) else self.conditions

    def _binary(self, node: Binary) -> ca.SX:
        left, right = map(self.of, (node.left, node.right))
        match node.op:
            case "+":
                return left + right
            case "-":
                return left - right
            case "*":
                shapes = node.left.type.shape, node.right.type.shape
                return left @ right if (2 in map(len, shapes) and all(shapes)) else left * right
            case "/":
                return left / right
            case "^":
                return left**right
            case "and":
                return left * right
            case "or":
                return left + right - left * right
        conditions = self._located(node)
        held = ca.SX(0)
        if self.holds is not None:
            held = sum((self.holds(q) for q in quantities_in(node)), held)
        if node.op in ("==", "<>"):
            if conditions is not None and node.left.type.base == "real":
                self.log.report(
                    "E0304",
                    f"`{node.op}` between numbers that change: they are equal at instants at most",
                    node.span,
                    help="compare by `<` and `>`, or compare whole numbers",
                )
            if not held.is_zero():
                left, right = self._at_rest(node)
            return left == right if node.op == "==" else left != right
        positive = left - right if node.op in (">", ">=") else right - left
        strict = node.op in ("<", ">")
        still = None if held.is_zero() else self._still(node, held)
        if conditions is not None:
            told = self._told(words(node))
            return conditions.add(positive, strict, told, node.span, at_rest=still)
        flag = None if self.known is None else self.known.find(positive, strict)
        if flag is not None:
            return flag
        positive = positive if still is None else still
        return positive > 0 if strict else positive >= 0

    def _at_rest(self, node: Binary) -> tuple[ca.SX, ca.SX]:
        """Both sides with motions that friction holds at zero."""
        assert self.at_rest is not None
        still = replace(self, quantity=self.at_rest, done={})
        return still.of(node.left), still.of(node.right)

    def _still(self, node: Binary, held: ca.SX) -> ca.SX:
        """What is positive where a comparison is true, decided where friction holds it at zero."""
        left, right = self._at_rest(node)
        positive = left - right if node.op in (">", ">=") else right - left
        decided = ca.SX(-1.0 if node.op in ("<", ">") else 1.0)
        return ca.if_else((held > 0) * (positive == 0), decided, positive)

    def _call(self, node: Call) -> ca.SX:
        if node.function == "noEvent":
            return replace(self, conditions=None, known=None, done={}).of(node.arguments[0])
        arguments = [self.of(argument) for argument in node.arguments]
        conditions = self._located(node)
        name = node.function
        function = FUNCTIONS[name]
        if name == "smooth":
            return arguments[1]
        if function.place == "event":
            return self._of_events(node, arguments)
        if function.switch == "order":
            value, text = arguments[0], words(node.arguments[0])
            for other, written in zip(arguments[1:], node.arguments[1:], strict=True):
                sign = ">=" if name == "max" else "<="
                value = self._least(
                    value,
                    other,
                    conditions,
                    name,
                    self._told(f"{text} {sign} {words(written)}"),
                    node.span,
                )
                text = f"{name}({text}, {words(written)})"
            return value
        if conditions is not None and function.switch == "sign":
            above = conditions.add(
                arguments[0], False, self._told(f"{words(node.arguments[0])} >= 0"), node.span
            )
            return (2 * above - 1) * (arguments[0] if name == "abs" else 1)
        if conditions is not None and function.switch == "step":
            return self._step(node, arguments, conditions)
        assert function.form is not None
        made: ca.SX = function.form(ca, *arguments)
        return made

    def _step(self, node: Call, arguments: list[ca.SX], conditions: ConditionTable) -> ca.SX:
        """`floor`, `ceil` and `mod` of what changes: the events are where they step."""
        assert self.before is not None

        def crosses(value: ca.SX, strict: bool) -> ca.SX:
            return conditions.add(
                value, strict, self._told(f"{words(node)} steps"), node.span, RISING
            )

        first = arguments[0]
        match node.function:
            case "floor":
                return self.before.floor(first, crosses, node.span)
            case "ceil":
                return -self.before.floor(-first, crosses, node.span)
        count = self.before.floor(first / arguments[1], crosses, node.span)
        return first - arguments[1] * count

    def _told(self, text: str) -> str:
        """A condition's words, with the component it stands in."""
        return f"{self.owner}: {text}" if self.owner else text

    def _of_events(self, node: Call, arguments: list[ca.SX]) -> ca.SX:
        """Functions that only equations and `when` may hold."""
        name = node.function
        if name in ("pre", "change", "edge"):
            return self._of_jumps(node, arguments[0])
        if name == "friction" and self.friction is not None:
            return self.friction(node, arguments, self.owner)
        where = "is the condition of a 'when', joined to others by 'and' or in `(a, b)`"
        remedy = "write `when sample(...) and c then`, and give a discrete variable its value there"
        if name == "initial":
            remedy = remedy.replace("sample(...)", "initial()")
        if name == "friction":
            where = "stands in an equation of the section `equation`"
            remedy = "declare `Force f;`, write `f = friction(...);` there, and read f here"
        self.log.report("E0304", f"`{name}` {where}, and nowhere else", node.span, help=remedy)
        return arguments[0] if arguments else ca.SX(0)

    def _of_jumps(self, node: Call, now: ca.SX) -> ca.SX:
        """`pre`, `change` and `edge`; where nothing happens, there is no difference."""
        if self.before is None:
            return now if node.function == "pre" else ca.SX(0)
        named = whole(node.arguments[0])
        if named is None:
            mode = isinstance(node.arguments[0], Quantity) and node.arguments[0].name == "mode"
            if node.function == "pre" and not mode:
                return now
            was = self.before.hold(now, words(node.arguments[0]), ca.SX(0), node.span)
        else:
            variable, indices = named
            was = self.before.variable(variable, node.span)
            for index in indices:
                was = was[index, :].T if was.size2() > 1 else was[index]
        if node.function == "pre":
            return was
        if node.function == "edge":
            return now * (1 - was)
        return 1 - _product(ca.eq(a, b) for a, b in zip(_items(now), _items(was), strict=True))

    @staticmethod
    def _least(
        x: ca.SX, y: ca.SX, conditions: ConditionTable | None, name: str, text: str, span: Span
    ) -> ca.SX:
        below = x - y if name == "max" else y - x
        flag = conditions.add(below, False, text, span) if conditions is not None else below >= 0
        return ca.if_else(flag, x, y)

    rules: ClassVar[Rules] = {
        Literal: _literal,
        Reference: _reference,
        Time: _time,
        Quantity: _quantity,
        Derivative: _rate,
        Element: _element,
        Vector: _vector,
        Unary: _unary,
        Binary: _binary,
        Call: _call,
        If: _if,
    }


def _items(value: ca.SX) -> list[ca.SX]:
    return list(ca.vertsplit(ca.vec(value)))


def _product(items: Iterable[ca.SX]) -> ca.SX:
    result = ca.SX(1)
    for item in items:
        result = result * item
    return result
