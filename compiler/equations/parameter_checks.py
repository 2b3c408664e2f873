"""Values that parameters must give: positive masses, finite numbers and the like."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import casadi as ca
from frot.compiler.equations.structure.eliminate import Pivot
from frot.compiler.mechanics.mechanism import Mechanism
from frot.compiler.symbolic.slopes import CANCELS, size_of_sum
from frot.compiler.translate.walk import as_number, is_fixed
from frot.dsl import Log, default_values, evaluate
from frot.dsl.catalogue import Argument
from frot.dsl.checked import (
    Binary,
    Call,
    Element,
    Expression,
    If,
    Liaison,
    Literal,
    Parameter,
    Place,
    Reference,
    Vector,
)
from frot.dsl.checked.arrays import component_names, scalars
from frot.dsl.checked.walk import conjuncts
from frot.dsl.messages.source import Span
from frot.dsl.quantities.dimensions import REAL, Type

POSITIVE, NOT_NEGATIVE, FINITE, NOT_BELOW_PREVIOUS, NOT_ZERO, NOT_BELOW_MIN, NOT_ABOVE_MAX = range(
    7
)


@dataclass(frozen=True, slots=True, eq=False)
class Check:
    """`value` must satisfy `rule` (frot_rule); `subject` names it, `notes` say why."""

    rule: int
    subject: str
    value: Expression | ca.SX
    span: Span | None
    notes: tuple[str, ...] = ()


def parameter_checks(
    mechanism: Mechanism, parameters: Sequence[Parameter], pivots: Sequence[Pivot] = ()
) -> tuple[Check, ...]:
    """Every check that depends on parameters alone, in the order of the text.

    `parameters` are scalars, `pivots` divisors that came from solving equations for an unknown.
    """
    first = {p.value.element_hash(): p for p in reversed(pivots)}
    divisors = (
        Check(
            NOT_ZERO,
            f"factor of '{p.unknown}' in `{p.origin.text}`"
            + (f" of {p.origin.owner}" if p.origin.owner else ""),
            _but_for_rounding(p.value),
            p.origin.span,
        )
        for p in pivots
        if first[p.value.element_hash()] is p
    )
    return (*_checks(mechanism, parameters), *divisors)


def _but_for_rounding(value: ca.SX) -> ca.SX:
    """The value; zero where it is what rounding leaves of a sum."""
    if not (value.is_op(ca.OP_ADD) or value.is_op(ca.OP_SUB)):
        return value
    return ca.if_else(ca.fabs(value) > CANCELS * size_of_sum(value), value, 0)


def _checks(mechanism: Mechanism, parameters: Sequence[Parameter]) -> Iterator[Check]:
    model = mechanism.model
    for parameter in parameters:
        value = Reference(parameter, parameter.type, parameter.span)
        yield Check(FINITE, f"parameter '{parameter.name}'", value, parameter.span)
    for whole in model.parameters:
        yield from _bounds(whole)
    for when in model.whens:
        written = (c for conditions, _ in when.branches for c in conditions)
        for condition in (c for one in written for c in conjuncts(one)):
            if isinstance(condition, Call) and condition.function == "sample":
                yield Check(
                    POSITIVE, "interval of 'sample'", condition.arguments[1], condition.span
                )
    if not isinstance(model.world.down, str):
        yield _length("'down' of the world", model.world.down)
    for body in model.bodies:
        if body.shape is not None:
            owner = f"body '{body.name}'"
            yield from _arguments(owner, body.shape.arguments, body.arguments)
    for curve in model.curves:
        yield from _sizes(f"curve '{curve.name}'", curve.arguments)
    for surface in model.surfaces:
        yield from _sizes(f"surface '{surface.name}'", surface.arguments)
    for frame in model.frames:
        if not isinstance(frame.axis, str) and frame.axis.type.shape and is_fixed(frame.axis):
            yield _length(f"the axis of frame '{frame.name}'", frame.axis)
    for force in model.forces:
        yield from _arguments(f"force '{force.name}'", force.kind.arguments, force.arguments)
    for liaison in model.liaisons:
        for argument in liaison.kind.arguments:
            axis = liaison.options.get(argument.name) if argument.kind == "axis" else None
            if axis is not None and axis.type.shape and is_fixed(axis):
                yield _length(f"the {argument.name} of liaison '{liaison.name}'", axis)
        if {"axis_a", "axis_b"} <= liaison.options.keys() and _axes_stay(liaison):
            yield _crossing(liaison)
        for law in liaison.laws:
            owner = f"liaison '{liaison.name}'"
            yield from _arguments(owner, law.kind.arguments, law.arguments)
            yield from _pairs(owner, law.kind.arguments, law.arguments)


def _pairs(
    owner: str, kinds: tuple[Argument, ...], values: Mapping[str, Expression]
) -> Iterator[Check]:
    """Arguments that must not be below another, each after that."""
    for kind in kinds:
        low, high = values.get(kind.not_below), values.get(kind.name)
        if low is not None and high is not None and is_fixed(low) and is_fixed(high):
            yield Check(FINITE, f"{kind.not_below} of {owner}", low, low.span)
            yield Check(NOT_BELOW_PREVIOUS, f"{kind.name} of {owner}", high, high.span)


_MUST: Mapping[int, str] = {
    POSITIVE: "must be positive",
    NOT_NEGATIVE: "must not be negative",
    NOT_BELOW_PREVIOUS: "must not be below the coefficient of motion",
    NOT_BELOW_MIN: "must not be below that",
    NOT_ABOVE_MAX: "must not be above that",
}


def _bounds(parameter: Parameter) -> Iterator[Check]:
    """`min` and `max` of a parameter, item by item: each after the bound itself."""
    for word, bound in parameter.bounds:
        names = component_names(parameter.name, parameter.type.shape)
        whole = Reference(parameter, parameter.type, parameter.span)
        written = " ".join(bound.span.text.split())
        for name, item, limit in zip(names, scalars(whole), scalars(bound), strict=True):
            rule = NOT_BELOW_MIN if word == "min" else NOT_ABOVE_MAX
            yield Check(FINITE, f"{word} of parameter '{name}'", limit, bound.span)
            subject = f"parameter '{name}', whose {word} is {written},"
            yield Check(rule, subject, item, parameter.span)


class _Defaults(dict[Parameter, object]):
    """Values of parameters; those of a shape's own constants are found when they are used."""

    def __missing__(self, parameter: Parameter) -> object:
        self[parameter] = evaluate(parameter.value, self)
        return self[parameter]


def refuse_values(mechanism: Mechanism, log: Log) -> None:
    """Report the first that the defaults of the parameters break: the model has no meaning then."""
    values, before = _Defaults(default_values(mechanism.model, {})), 0.0
    for check in _checks(mechanism, ()):
        assert isinstance(check.value, Expression)
        if not is_fixed(check.value):
            continue
        try:
            x = as_number(evaluate(check.value, values))
        except ValueError:  # no number at all: told by the run
            continue
        broken = {
            POSITIVE: x <= 0,
            NOT_NEGATIVE: x < 0,
            NOT_BELOW_PREVIOUS: x < before,
            NOT_BELOW_MIN: x < before,
            NOT_ABOVE_MAX: x > before,
        }
        if broken.get(check.rule):
            message = f"the {check.subject} is {x:.9g}: it {_MUST[check.rule]}"
            log.report("E0401", message, check.span, notes=check.notes)
            return
        before = x


# Vertices up to which sides are looked at in pairs.
MOST_VERTICES = 8
# Part of the products of lengths within which a vertex is on a side or beyond its end.
_ON_SIDE = 1e-9
# Part of the cube of the moments' sum that rounding may take from a product that is zero: a plate.
_FLAT = 1e-12
_TRIANGLE = "masses give no moment of inertia that is larger than the two others together"


def _principal_moments(owner: str, inertia: Expression) -> Iterator[Check]:
    """The same of a matrix J: none of the products of its moments A B C and of (B + C - A) ...

    is negative: det J and det(tr J - 2 J). Of the second three at most one can be.
    """
    span, item = inertia.span, inertia.type.item
    row = Type(item.base, item.dimension, (3,))

    def of(op: str, a: Expression, b: Expression) -> Expression:
        return Binary(op, a, b, item, span)

    def determinant(x: list[list[Expression]]) -> Expression:
        (a, b, c), (d, e, f), (g, h, i) = x
        first = of("*", a, of("-", of("*", e, i), of("*", f, h)))
        second = of("*", b, of("-", of("*", d, i), of("*", f, g)))
        third = of("*", c, of("-", of("*", d, h), of("*", e, g)))
        return of("+", of("-", first, second), third)

    own: list[list[Expression]] = [
        [Element(Element(inertia, i, row, span), k, item, span) for k in range(3)] for i in range(3)
    ]
    for k in range(3):
        subject = f"moment {k + 1} of the inertia of {owner}"
        yield Check(NOT_NEGATIVE, subject, own[k][k], span)
    total = of("+", of("+", own[0][0], own[1][1]), own[2][2])
    for i, k in ((0, 1), (0, 2), (1, 2)):
        uneven = Call("abs", (of("-", own[i][k], own[k][i]),), item, span)
        rest_of_it = of("-", of("*", Literal(_FLAT, REAL, span), total), uneven)
        subject = f"difference of items [{i + 1}, {k + 1}] and [{k + 1}, {i + 1}], taken from zero,"
        yield Check(NOT_NEGATIVE, f"{subject} of the inertia of {owner}", rest_of_it, span)
    twice, nothing = Literal(2.0, item, span), Literal(0.0, item, span)
    rest: list[list[Expression]] = [
        [of("-", total if i == k else nothing, of("*", twice, x)) for k, x in enumerate(line)]
        for i, line in enumerate(own)
    ]
    cube = of("*", Literal(_FLAT, item, span), of("*", total, of("*", total, total)))
    for subject, matrix in (
        ("product of the principal moments", own),
        ("product of what each two principal moments are more than the third,", rest),
    ):
        value = of("+", determinant(matrix), cube)
        yield Check(NOT_NEGATIVE, f"{subject} of the inertia of {owner}", value, span, (_TRIANGLE,))


def _axes_stay(liaison: Liaison) -> bool:
    return is_fixed(liaison.options["axis_a"]) and is_fixed(liaison.options["axis_b"])


def _direction(axis: Expression) -> Expression:
    """The vector of an axis, which may be named `x`, `-y` and so on."""
    if not (isinstance(axis, Literal) and isinstance(axis.value, str)):
        return axis
    sign = -1.0 if axis.value[0] == "-" else 1.0
    items = tuple(Literal(sign * (axis.value[-1] == k), REAL, axis.span) for k in "xyz")
    return Vector(items, REAL.of_shape((3,)), axis.span)


def _crossing(liaison: Liaison) -> Check:
    """Of parallel axes a cardan would have one turn twice."""
    first, second = (_direction(liaison.options[x]) for x in ("axis_a", "axis_b"))
    span = liaison.span
    normal = Call("cross", (first, second), first.type, span)
    subject = f"product of the axes of liaison '{liaison.name}', which must cross,"
    return Check(
        POSITIVE, f"length of the vector {subject}", Call("norm", (normal,), REAL, span), span
    )


def _length(subject: str, direction: Expression) -> Check:
    length = Call("norm", (direction,), REAL, direction.span)
    return Check(POSITIVE, f"length of {subject}", length, direction.span)


def _sizes(owner: str, given: Mapping[str, Expression]) -> Iterator[Check]:
    """No direction is zero, sizes and intervals are positive, as far as parameters give them."""
    for name, value in given.items():
        if not is_fixed(value):
            continue
        if name in ("direction", "normal", "axis") and value.type.shape:
            yield _length(f"the {name} of {owner}", value)
        elif name in ("radius", "a", "b", "semi_axes"):
            names = component_names(name, value.type.shape)
            for one, item in zip(names, scalars(value), strict=True):
                yield Check(POSITIVE, f"{one} of {owner}", item, value.span)
        elif name in ("u", "v"):
            kind = value.type.item
            first, last = (Element(value, k, kind, value.span) for k in (0, 1))
            way = Binary("-", last, first, kind, value.span)
            long = Call("abs", (way,), kind, value.span)
            yield Check(POSITIVE, f"length of the interval of {name} of {owner}", long, value.span)


def _arguments(
    owner: str, kinds: tuple[Argument, ...], values: Mapping[str, Expression | Place | Liaison]
) -> Iterator[Check]:
    rules = {"positive": POSITIVE, "nonnegative": NOT_NEGATIVE}
    for kind in kinds:
        value = values.get(kind.name)
        if value is None or isinstance(value, (Place, Liaison)):
            continue
        if kind.kind == "vertices" and is_fixed(value) and value.type.shape[0] <= MOST_VERTICES:
            yield _outline(owner, value)
        if kind.sign not in rules:
            continue
        if kind.kind == "inertia" and value.type.shape:
            yield from _moments(owner, value)
        elif is_fixed(value):
            for name, item in zip(
                component_names(kind.name, value.type.shape), scalars(value), strict=True
            ):
                yield Check(rules[kind.sign], f"{name} of {owner}", item, value.span)
                if kind.at_most is not None:
                    most = Literal(kind.at_most, REAL, value.span)
                    yield Check(FINITE, f"most of {name} of {owner}", most, value.span)
                    subject = f"{name} of {owner}, at most {kind.at_most:g},"
                    yield Check(NOT_ABOVE_MAX, subject, item, value.span)


def _outline(owner: str, vertices: Expression) -> Check:
    """No two sides cross: of the ends of one, or of the other, both are on one side of it."""
    count, span = vertices.type.shape[0], vertices.span
    item = vertices.type.item
    row = Type(item.base, item.dimension, (2,))

    def of(op: str, a: Expression, b: Expression) -> Expression:
        return Binary(op, a, b, REAL, span)

    def at(i: int, k: int) -> Expression:
        return Element(Element(vertices, i % count, row, span), k, item, span)

    def turn(i: int, j: int) -> Expression:
        """On which side of side i vertex j is."""
        first = of("*", of("-", at(i + 1, 0), at(i, 0)), of("-", at(j, 1), at(i, 1)))
        second = of("*", of("-", at(i + 1, 1), at(i, 1)), of("-", at(j, 0), at(i, 0)))
        sizes = of("+", *(Call("abs", (x,), REAL, span) for x in (first, second)))
        whole = of("-", first, second)
        least = of("*", Literal(_ON_SIDE, REAL, span), sizes)
        beside = of(">", Call("abs", (whole,), REAL, span), least)
        return If(beside, Call("sign", (whole,), REAL, span), nothing, REAL, span)

    nothing = Literal(0.0, REAL, span)
    apart: Expression = nothing
    for i in range(count):
        for j in range(i + 2, count - (i == 0)):
            own = of("*", turn(i, j), turn(i, j + 1))
            other = of("*", turn(j, i), turn(j, i + 1))
            apart = Call("min", (apart, Call("max", (own, other), REAL, span)), REAL, span)
    subject = f"order of the vertices of {owner}, which is -1 where sides cross,"
    return Check(NOT_NEGATIVE, subject, apart, span)


def _moments(owner: str, inertia: Expression) -> Iterator[Check]:
    """No moment is negative, nor larger than the other two together."""
    item = inertia.type.item
    if inertia.type.shape == (3, 3):
        yield from _principal_moments(owner, inertia)
        return
    moments = [Element(inertia, k, item, inertia.span) for k in range(3)]
    for k, moment in enumerate(moments):
        subject = f"moment {k + 1} of the inertia of {owner}"
        yield Check(NOT_NEGATIVE, subject, moment, inertia.span)
        others = Binary("+", moments[k - 1], moments[k - 2], item, inertia.span)
        rest = Binary("-", others, moment, item, inertia.span)
        less = f"sum of the other moments less {subject}"
        yield Check(NOT_NEGATIVE, less, rest, inertia.span, (_TRIANGLE,))
