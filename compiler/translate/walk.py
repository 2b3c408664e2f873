"""Walking through expressions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from frot.dsl.catalogue import FUNCTIONS
from frot.dsl.checked import (
    Assertion,
    Assign,
    Binary,
    Call,
    Derivative,
    Equation,
    Expression,
    If,
    IfEquations,
    Model,
    Output,
    Parameter,
    Quantity,
    Reference,
    Reinit,
    Time,
    Variable,
)
from frot.dsl.checked.walk import nodes, parts

COMPARISONS = ("<", "<=", ">", ">=", "==", "<>")


def subexpressions(expression: Expression) -> Iterator[Expression]:
    """The expression and everything in it once, through outputs and constants it names."""
    return nodes(expression, _behind)


def through(node: Expression) -> tuple[Expression, ...]:
    """What an expression is made of; of a declared output, its value."""
    if isinstance(node, Reference) and isinstance(node.target, Output):
        return (node.target.value,)
    return parts(node)


def _behind(node: Expression) -> tuple[Expression, ...]:
    """As `through`; of a constant, its value too."""
    if isinstance(node, Reference) and isinstance(node.target, Parameter) and node.target.constant:
        return (node.target.value,)
    return through(node)


def is_fixed(expression: Expression) -> bool:
    """Whether the value depends on parameters and constants alone."""
    return all(
        not isinstance(node, (Time, Quantity, Derivative))
        and not (isinstance(node, Reference) and not isinstance(node.target, Parameter))
        for node in subexpressions(expression)
    )


def is_given(expression: Expression) -> bool:
    """Whether no time and no motion changes the value: parameters and inputs give it."""
    return not any(
        isinstance(node, Time | Quantity | Derivative)
        or (isinstance(node, Reference) and isinstance(node.target, Variable))
        for node in subexpressions(expression)
    )


def has_time(expression: Expression) -> bool:
    """Whether the value changes with time."""
    return any(isinstance(node, Time) for node in subexpressions(expression))


def follows_time(expression: Expression, but_for: str = "", switching: bool = False) -> bool:
    """Whether the value depends on time and parameters alone, and nothing switches in it.

    `but_for` are the letters of variables that a curve or surface is given by; `switching`: it may.
    """
    for node in subexpressions(expression):
        if isinstance(node, (Quantity, Derivative)):
            return False
        if isinstance(node, Reference) and not isinstance(node.target, Parameter):
            own = isinstance(node.target, Variable) and node.target.name in tuple(but_for)
            if not own:
                return False
        if not switching and switches(node) and not is_fixed(node):
            return False
    return True


def switches(node: Expression) -> bool:
    """Whether an expression itself may jump."""
    if isinstance(node, Call):
        return bool(FUNCTIONS[node.function].switch or FUNCTIONS[node.function].place)
    return isinstance(node, If) or (isinstance(node, Binary) and node.op in _ORDERS)


_ORDERS = ("<", "<=", ">", ">=", "==", "<>")


def as_number(value: object) -> float:
    """A value of `evaluate` as the kernel holds it: truth values are 0 and 1."""
    if not isinstance(value, (bool, int, float)):
        raise TypeError(f"{value!r} is no number")
    return float(value)


def read_expressions(model: Model) -> Iterator[Expression]:
    """Every expression of the model that can read a variable of a body or liaison."""
    for output in model.outputs:
        yield output.value
    yield from _of_equations(model.equations)
    yield from _of_events(model)
    for equation in model.initial:
        yield from (equation.left, equation.right)
    for force in model.forces:
        for argument in force.arguments.values():
            if isinstance(argument, Expression):
                yield argument
    for liaison in model.liaisons:
        yield from liaison.driven.values()
        for relation in liaison.relations:
            yield from (relation.left, relation.right)
        for law in liaison.laws:
            yield from law.arguments.values()


def read_quantities(model: Model) -> Iterator[Quantity]:
    """What the model reads of its bodies and liaisons, in the order of the text."""
    if not (model.bodies or model.liaisons):
        return
    yield from quantities_in(*read_expressions(model))


def quantities_in(*expressions: Expression) -> Iterator[Quantity]:
    """What expressions read of bodies and liaisons."""
    for expression in expressions:
        for node in subexpressions(expression):
            if isinstance(node, Quantity):
                yield node


def compared_quantities(model: Model) -> Iterator[Quantity]:
    """What stands in the comparisons that anything but an output follows."""
    if not (model.bodies or model.liaisons):
        return
    for expression in read_expressions(replace(model, outputs=())):
        for node in subexpressions(expression):
            if isinstance(node, Binary) and node.op in COMPARISONS:
                yield from quantities_in(node.left, node.right)


def _of_equations(equations: Iterable[Equation | IfEquations]) -> Iterator[Expression]:
    for equation in equations:
        if isinstance(equation, Equation):
            yield from (equation.left, equation.right)
            continue
        for condition, inner in equation.branches:
            if condition is not None:
                yield condition
            yield from _of_equations(inner)


def _of_events(model: Model) -> Iterator[Expression]:
    for assertion in model.assertions:
        yield assertion.condition
    for conditions, actions in (branch for when in model.whens for branch in when.branches):
        yield from conditions
        for action in actions:
            match action:
                case Assign(value=value):
                    yield value
                case Reinit(target=target, value=value):
                    yield from (target, value)
                case Assertion(condition=condition):
                    yield condition
