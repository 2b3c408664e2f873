"""Whether a text's equations can determine its variables, decided by the expressions alone.

This needs no CasADi, so that `frot check` is quick. What takes part in an equation is taken at its
largest, so that nothing right is refused; the compiler looks again, more closely.
"""

from __future__ import annotations

from collections.abc import Iterator

from frot.compiler.equations.structure.index import find_unbalanced, report_unbalanced
from frot.compiler.mechanics.mechanism import Mechanism
from frot.compiler.translate.origins import Origin, Unknown
from frot.compiler.translate.walk import subexpressions
from frot.dsl import Log
from frot.dsl.checked import (
    Element,
    Equation,
    Expression,
    IfEquations,
    Model,
    Quantity,
    Reference,
    Variable,
)
from frot.dsl.checked.arrays import component_names


class _Places:
    """Numbers of the unknowns: coordinates of the mechanism, then scalars of the variables."""

    def __init__(self, model: Model, coordinates: list[str]) -> None:
        self.unknowns = [Unknown(name, None) for name in coordinates]
        self.mechanical = tuple(range(len(coordinates)))
        self.first: dict[Variable, int] = {}
        for variable in model.variables:
            if not variable.discrete:
                self.first[variable] = len(self.unknowns)
                for name in component_names(variable.name, variable.type.shape):
                    self.unknowns.append(Unknown(name, variable.span))

    def of(self, variable: Variable, item: int | None, width: int) -> Iterator[int]:
        """The unknowns of a variable: those of one row (`width` scalars), or all of them."""
        if variable not in self.first:
            return
        count = 1
        for size in variable.type.shape:
            count *= size
        first = self.first[variable]
        if item is None:
            yield from range(first, first + count)
        else:
            yield from range(first + item * width, first + (item + 1) * width)

    def inside(self, expression: Expression) -> set[int]:
        """All unknowns that an expression may depend on."""
        found: set[int] = set()
        narrowed: set[int] = set()
        for node in subexpressions(expression):
            if isinstance(node, Element) and isinstance(node.operand, Reference):
                target = node.operand.target
                if isinstance(target, Variable):
                    narrowed.add(id(node.operand))
                    width = target.type.shape[1] if len(target.type.shape) == 2 else 1
                    found.update(self.of(target, node.index, width))
        for node in subexpressions(expression):
            if isinstance(node, Quantity):
                found.update(self.mechanical)
            elif (
                isinstance(node, Reference)
                and isinstance(node.target, Variable)
                and id(node) not in narrowed
            ):
                found.update(self.of(node.target, None, 1))
        return found


def check_balance(model: Model, mechanism: Mechanism, log: Log) -> bool:
    """Report unknowns without equations and equations without unknowns; whether all is well."""
    if not (model.variables or model.equations):
        return True
    names = [n for c in mechanism.coordinates for n in c.speeds]
    places = _Places(model, names)
    rows: list[tuple[int, ...]] = []
    origins: list[Origin] = []
    loads: set[int] = set(places.mechanical)
    for flange in model.flanges:
        loads.update(places.of(flange.effort, None, 1))
    for force in model.forces:
        for argument in force.arguments.values():
            if isinstance(argument, Expression):
                loads.update(places.inside(argument))
    for _ in names:
        rows.append(tuple(loads))
        origins.append(Origin(model.span, "the equations of motion", ""))
    for equation in model.equations:
        for origin, inside in _scalar_equations(equation, places):
            rows.append(tuple(inside))
            origins.append(origin)
    unbalanced = find_unbalanced(rows, len(places.unknowns))
    if unbalanced is None:
        return True
    report_unbalanced(unbalanced, places.unknowns, origins, log)
    return False


def _scalar_equations(
    equation: Equation | IfEquations, places: _Places
) -> Iterator[tuple[Origin, set[int]]]:
    if isinstance(equation, Equation):
        inside = places.inside(equation.left) | places.inside(equation.right)
        text = equation.connection or " ".join(equation.span.text.split()).rstrip("; ")
        count = 1
        for size in equation.left.type.shape or equation.right.type.shape:
            count *= size
        for _ in range(count):
            yield Origin(equation.span, text, equation.owner), inside
        return
    branches = [
        [e for inner in b for e in _scalar_equations(inner, places)] for _, b in equation.branches
    ]
    common: set[int] = set()
    for condition, _ in equation.branches:
        if condition is not None:
            common |= places.inside(condition)
    if len({len(b) for b in branches}) > 1:
        return  # told where the branches are lowered
    for same in zip(*branches, strict=True):
        yield same[0][0], common.union(*(inside for _, inside in same))
