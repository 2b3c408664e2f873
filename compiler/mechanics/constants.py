"""Values of what no motion changes: of parameters, of time, and of places on a figure."""

from __future__ import annotations

from dataclasses import dataclass, field

import casadi as ca
from frot.compiler.translate.expressions import Lowering
from frot.compiler.translate.symbols import Symbols
from frot.dsl import Log
from frot.dsl.checked import Expression, Quantity, Variable


@dataclass(frozen=True, slots=True, eq=False)
class Constants:
    """The values by their expressions, each lowered once.

    `places` are the symbols of what a curve or surface is given by: `u`, or x, y and z; whoever
    lowers its expression replaces them.
    """

    symbols: Symbols
    places: dict[Variable, ca.SX] = field(default_factory=dict)
    known: dict[int, tuple[Expression, ca.SX]] = field(default_factory=dict)

    def lower(self, expression: Expression) -> ca.SX:
        """The CasADi value: a scalar, a column or a matrix."""
        # Nothing that is refused where something moves can stand here: no message is lost.
        walk = Lowering(
            self.symbols, _nothing, _still, Log(), variable=self._place, done=self.known
        )
        return walk.lower(expression)

    def _place(self, variable: Variable) -> ca.SX:
        return self.places.setdefault(variable, ca.SX.sym(variable.name))


def _nothing(node: Quantity) -> ca.SX:
    raise TypeError(f"{node.name} in an expression of what no motion changes")


def _still(value: ca.SX) -> ca.SX:
    """The derivative of a constant."""
    return value * 0
