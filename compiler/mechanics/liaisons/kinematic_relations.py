"""Relations of the user's liaisons that are equations of the text, and prescribed coordinates.

A relation between places, velocities, time and parameters that is linear in velocities is a row of
the mechanism. One that holds variables, inputs, coordinates of other liaisons or switches, and one
that is not linear in velocities, is an equation, and its reaction an unknown: with the relation
f(q, v, ...) = 0 that unknown s acts along each speed by s df/dv (P. Appell, C. R. Acad. Sci. 152,
1911, p. 1197; N. Chetaev 1932), of f(q, ...) = 0 by s df/dq, as a multiplier does in a row.
"""

from __future__ import annotations

from frot.compiler.translate.walk import (
    follows_time,
    is_fixed,
    is_given,
    subexpressions,
    switches,
)
from frot.dsl.checked import (
    Binary,
    Call,
    Derivative,
    Element,
    Expression,
    If,
    Liaison,
    Output,
    Parameter,
    Quantity,
    Reference,
    StatedRelation,
    Unary,
    Variable,
    Vector,
)
from frot.dsl.quantities.dimensions import Type, dimension

TURNING = "angular_velocity"  # a drive that prescribes it

OF_PLACES = ("position", "angle", "orientation", "ex", "ey", "ez")
OF_SPEEDS = ("velocity", "angular_velocity")
_POWER = dimension(m=2, kg=1, s=-3)
_ENERGY = dimension(m=2, kg=1, s=-2)
_BENT = 2


def is_row(relation: StatedRelation) -> bool:
    """Whether a relation is a row of the mechanism."""
    sides = (relation.left, relation.right)
    if any(_degree(side) > 1 for side in sides):
        return False
    return all(_of_motion(node) for side in sides for node in subexpressions(side))


def reaction_of(liaison: Liaison, number: int) -> Variable:
    """The unknown that keeps a relation, numbered from 1."""
    relation = liaison.relations[number - 1]
    done = _POWER if relation.kinematic else _ENERGY
    kind = Type("real", done / relation.left.type.dimension)
    name = f"{liaison.name}.drive.{coordinate_of(number)}"
    return Variable(name, kind, liaison.span, f"what keeps relation {number}")


def coordinate_of(number: int) -> str:
    """What a relation is called where coordinates are."""
    return f"relation_{number}"


def numbered(liaison: Liaison, coordinate: str) -> StatedRelation | None:
    """The relation of that name; None if it names a coordinate."""
    head, _, number = coordinate.partition("_")
    return liaison.relations[int(number) - 1] if head == "relation" else None


def _of_motion(node: Expression) -> bool:
    """Whether an expression may stand in a row."""
    match node:
        case Derivative():
            return False
        case Quantity(owner=owner):
            return not isinstance(owner, Liaison)
        case Reference(target=target):
            return isinstance(target, Parameter | Output)
    return is_fixed(node) or not switches(node)


def _degree(node: Expression) -> int:
    """Degree in velocities; 2 for what is not linear in them."""
    match node:
        case Quantity(name=name):
            return int(name in OF_SPEEDS)
        case Reference(target=Parameter(constant=True, value=value) | Output(value=value)):
            return _degree(value)
        case Unary(operand=inner) | Element(operand=inner):
            return _degree(inner)
        case Vector(items=items):
            return max(map(_degree, items), default=0)
        case If(yes=yes, no=no):
            return max(_degree(yes), _degree(no))
        case Binary(op="+" | "-", left=left, right=right):
            return max(_degree(left), _degree(right))
        case Binary(op="/", left=left, right=right) if _degree(right) == 0:
            return _degree(left)
        case Binary(op="*", left=left, right=right):
            return _degree(left) + _degree(right)
        case Call(function="dot" | "cross", arguments=arguments):
            return sum(map(_degree, arguments))
        case Binary(left=left, right=right):
            return _BENT if _degree(left) + _degree(right) else 0
        case Call(arguments=arguments):
            return _BENT if any(map(_degree, arguments)) else 0
    return 0


def drives_of(liaison: Liaison) -> dict[str, Expression]:
    """The coordinates that are prescribed: by `driven`, or a length by what it is said to be."""
    lengths = {
        name: value
        for name in liaison.kind.coordinates
        if (value := liaison.options.get(name)) is not None
        and not (is_given(value) or follows_time(value))
    }
    return {**lengths, **liaison.driven}


def prescribed_rates(liaison: Liaison) -> dict[str, Expression]:
    """The drives that prescribe a velocity, not a place: relations between velocities."""
    return {k: x for k, x in drives_of(liaison).items() if is_rate(k)}


def is_rate(name: str) -> bool:
    """Whether a drive of this name prescribes a velocity."""
    return name.startswith("speed") or name == TURNING
