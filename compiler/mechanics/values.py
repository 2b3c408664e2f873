"""Values that a text gives: how they are lowered, directions, and what time alone changes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import casadi as ca
from frot.compiler.mechanics.spatial import X, Y, Z, beside, cross, whole
from frot.compiler.translate.walk import follows_time, has_time
from frot.dsl.catalogue import TYPES
from frot.dsl.checked import Expression, Literal, Time
from frot.dsl.messages.source import Source, Span

Lower = Callable[[Expression], ca.SX]
NOW = Time(TYPES["Time"], Span(Source("", ""), 0, 0))


def unit_vector(given: Expression | str, lower: Lower) -> ca.SX:
    """The unit vector of `x`, `-x`, `y`, ... or of a vector of the text."""
    name = given.value if isinstance(given, Literal) else given
    if isinstance(name, str):
        along = {"x": X, "y": Y, "z": Z}[name[-1]]
        return -along if name[0] == "-" else along
    assert not isinstance(given, str)
    vector = whole(lower(given))
    return ca.sparsify(vector / ca.norm_2(vector))


def beside_given(given: Expression | str, lower: Lower) -> tuple[ca.SX, ca.SX]:
    """Two unit vectors beside that of `unit_vector`, as `beside` finds them.

    Where time turns the direction n they turn with it, without a jump: from where they stand at
    time 0 on they keep their angle to the plane of n and `reference` e.
    """
    n, now = unit_vector(given, lower), lower(NOW)
    if not ca.depends_on(n, now):
        return beside(n)
    e = reference(n, now)
    one = e - ca.dot(e, n) * n
    one = one / ca.norm_2(one)
    other = cross(n, one)
    began, own, next_to_own = (_at_zero(x, now) for x in (n, one, other))
    first, _ = beside(began)
    cosine, sine = ca.dot(first, own), ca.dot(first, next_to_own)
    return cosine * one + sine * other, cosine * other - sine * one


def reference(n: ca.SX, now: ca.SX) -> ca.SX:
    """The fixed unit vector (3) e from which directions beside n(time) are counted.

    That is n' x n'' at time 0: the axis of every steady turn of n, and of every turn that keeps n
    in a plane, so that n never comes to it. From rest (n' = 0) n x n'' serves, and beside an n
    that stands any vector.
    """
    rate = ca.jacobian(n, now)
    start, rate, bend = (_at_zero(x, now) for x in (n, rate, ca.jacobian(rate, now)))
    e, _ = beside(start)
    for way in (cross(start, bend), cross(rate, bend)):
        length = ca.norm_2(way)
        e = ca.if_else(length > 0, way / length, e)
    return e


def _at_zero(value: ca.SX, now: ca.SX) -> ca.SX:
    return ca.substitute(ca.densify(value), now, ca.SX(0))


def rate_by_time(value: ca.SX, lower: Lower) -> ca.SX:
    """The rate of what time alone changes."""
    return ca.sparsify(ca.jacobian(value, lower(NOW)).reshape(value.shape))


_DIRECTIONS = ("axis", "axis_a", "axis_b", "direction", "normal")


def pace_of(given: Mapping[str, Expression], lower: Lower) -> ca.SX:
    """The size |x''| + x'^2 of the values that time changes, directions being of length 1.

    What is given by the points of a curve or surface (`u`, `x`, ...) is left out.
    """
    size = ca.SX(0)
    for name, value in given.items():
        if has_time(value) and follows_time(value):
            told = unit_vector(value, lower) if name in _DIRECTIONS else whole(lower(value))
            rate = rate_by_time(told, lower)
            size += ca.norm_1(rate_by_time(rate, lower)) + ca.sumsqr(rate)
    return size


@dataclass(frozen=True, slots=True, eq=False)
class Axis:
    """A direction: a vector of the text, or the name of an axis."""

    given: Expression | str

    def unit(self, lower: Lower) -> ca.SX:
        """Its unit vector (3)."""
        return unit_vector(self.given, lower)

    def beside(self, lower: Lower) -> tuple[ca.SX, ca.SX]:
        """Two unit vectors (3) beside it."""
        return beside_given(self.given, lower)

    @property
    def turns(self) -> bool:
        """Whether time moves it."""
        return not isinstance(self.given, str) and has_time(self.given)


class Moments:
    """Lowers with time as a symbol of its own, to tell what time changes by itself.

    `met`: an expression that depends on time was lowered.
    """

    def __init__(self, lower: Lower) -> None:
        """`lower` lowers expressions; time is one symbol in it."""
        self._lower = lower
        self._now = lower(NOW)
        self.symbol = ca.SX.sym("now")
        self.met = False

    def __call__(self, expression: Expression) -> ca.SX:
        """The value with the symbol for time."""
        value = self._lower(expression)
        if not ca.depends_on(value, self._now):
            return value
        self.met = True
        return ca.substitute(value, self._now, self.symbol)

    def back(self, *values: ca.SX) -> list[ca.SX]:
        """The values with time itself."""
        return [ca.SX(x) for x in ca.substitute(list(values), [self.symbol], [self._now])]
