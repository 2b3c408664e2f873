"""Walking through expressions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from frot.dsl.checked import (
    Assertion,
    Assign,
    Binary,
    Call,
    Derivative,
    Element,
    Equation,
    Expression,
    If,
    IfEquations,
    Model,
    Parameter,
    Quantity,
    Reference,
    Reinit,
    Time,
    Unary,
    Vector,
)


def subexpressions(expression: Expression) -> Iterator[Expression]:
    """The expression and everything in it once, through outputs and constants it names."""
    stack = [expression]
    seen: set[int] = set()
    while stack:
        node = stack.pop()
        if id(node) in seen:
            continue
        seen.add(id(node))
        yield node
        stack.extend(parts(node))
        parameter = node.target if isinstance(node, Reference) else None
        if isinstance(parameter, Parameter) and parameter.constant:
            stack.append(parameter.value)


def parts(node: Expression) -> tuple[Expression, ...]:
    """What an expression is made of; of a declared output, its value."""
    from frot.dsl.checked import Output

    match node:
        case Derivative() | Element() | Unary():
            return (node.operand,)
        case Vector():
            return node.items
        case Binary():
            return (node.left, node.right)
        case Call():
            return node.arguments
        case If():
            return (node.condition, node.yes, node.no)
        case Reference() if isinstance(node.target, Output):
            return (node.target.value,)
    return ()


def is_fixed(expression: Expression) -> bool:
    """Whether the value depends on parameters and constants alone."""
    return all(
        not isinstance(node, (Time, Quantity, Derivative))
        and not (isinstance(node, Reference) and not isinstance(node.target, Parameter))
        for node in subexpressions(expression)
    )


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
        for law in liaison.laws:
            yield from law.arguments.values()


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
