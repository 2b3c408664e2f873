"""Values before an event: `pre`, `change` and `edge`.

Modelica Language Specification 3.6, sect. 3.7.5: at an event all values are found anew; then those
before become those found, and all is found again, until none changes. What a `when` sets has its
value before in the equations of its conditions already. What an equation gives is held apart.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import casadi as ca
from frot.compiler.translate.symbols import shaped
from frot.compiler.translate.text_symbols import Held, TextTable, scalars
from frot.dsl.checked import Element, Expression, Reference, Variable
from frot.dsl.messages.source import Span

# Of a whole number, by how much a value is beyond it before it counts as back.
_LATE = 2.0**-43
Crosses = Callable[[ca.SX, bool], ca.SX]


@dataclass(slots=True)
class Before:
    """`variable` gives the value of a variable before the event; `first` that at the start.

    `set_before` gives that of what a `when` sets, inside of a `when`.
    """

    text: TextTable
    first: Callable[[Variable], list[ca.SX]]
    set_before: Callable[[Variable], ca.SX] | None = None

    def variable(self, variable: Variable, span: Span) -> ca.SX:
        """The value before, in the shape of the variable."""
        if variable.discrete and self.set_before is not None:
            return self.set_before(variable)
        if not variable.discrete and variable.type.base == "real":
            return self.text.values[variable]
        return self.held(variable, span)

    def held(self, variable: Variable, span: Span) -> ca.SX:
        """The value that the variable had in the last round at an event."""
        items = [
            self.hold(value, value.name(), start, span)
            for value, start in zip(
                scalars(self.text.values[variable]), self.first(variable), strict=True
            )
        ]
        return shaped(items, variable.type.shape)

    def hold(self, value: ca.SX, name: str, start: ca.SX, span: Span) -> ca.SX:
        """A symbol for the value that the scalar `value` had in the last round at an event."""
        for known in self.text.held:
            if ca.is_equal(known.value, value, 20):
                return known.symbol
        symbol = ca.SX.sym(f"pre({name})")
        self.text.held.append(Held(name, symbol, start, value, span))
        return symbol

    def floor(self, value: ca.SX, crosses: Crosses, span: Span) -> ca.SX:
        """The whole number below `value`, which events change where `value` crosses one.

        Where it turns back at once it crosses a little late, for it may be a rounding short.
        """
        whole, way = (ca.SX.sym(f"{name} of a floor") for name in ("value", "way"))
        late = _LATE * (1 + ca.fabs(whole))
        risen = crosses(value - (whole + 1) - (way < 0) * late, False)
        fallen = crosses(whole - value - (way > 0) * late, True)
        below = ca.floor(value)
        up, down = ca.fmax(below, whole + 1), ca.fmin(below, whole - 1)
        new = ca.if_else(risen, up, ca.if_else(fallen, down, whole))
        near = value - ca.if_else(risen, up, whole)  # at the start it may come from anywhere
        turn = ca.if_else(ca.fabs(near) < 2 * late, risen - fallen, 0)
        self._hold(whole, ca.SX(0), new, span)
        self._hold(way, ca.SX(0), ca.if_else(risen + fallen, turn, way), span)
        return new

    def _hold(self, symbol: ca.SX, start: ca.SX, value: ca.SX, span: Span) -> None:
        self.text.held.append(Held(symbol.name(), symbol, start, value, span))


def whole(expression: Expression) -> tuple[Variable, list[int]] | None:
    """The variable an expression names, and the indices of its item; None if it names none."""
    indices: list[int] = []
    while isinstance(expression, Element):
        indices.append(expression.index)
        expression = expression.operand
    if isinstance(expression, Reference) and isinstance(expression.target, Variable):
        return expression.target, indices[::-1]
    return None
