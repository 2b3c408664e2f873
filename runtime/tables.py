"""Inputs over time: values between points, as polynomials that change at knots.

Between points a value is held (`held`), goes straight (`linear`), or follows a cubic spline
(`cubic`, C. de Boor's with the not-a-knot ends). Two values at one time are a jump.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from frot.dsl.messages.errors import fail

if TYPE_CHECKING:
    from frot.runtime.program import ParameterInfo

WAYS = ("held", "linear", "cubic")
MOST_KNOTS = 200_000
# Of a function: the part of its size to which it is followed, and of its span where it jumps.
FOLLOWED, JUMP = 1e-10, 1e-13


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """The input `name` is c0 + c1 s + c2 s^2 + c3 s^3, s being the time since the last knot.

    `knots` (s) ascend, `pieces` has the four coefficients (SI) from each on; the last knot is the
    end, from which on nothing is known. `way` is one of WAYS.
    """

    name: str
    way: str
    knots: tuple[float, ...]
    pieces: tuple[tuple[float, float, float, float], ...]

    def check(self, begin: float, end: float) -> None:
        """FrotError (E0821) where a run from `begin` to `end` needs more than the table has."""
        first, last = self.knots[0], self.knots[-1]
        near = 1e-12 * max(abs(begin), abs(end), 1e-300)
        if begin < first - near or (end > last + near and self.way != "held"):
            raise _bad(
                self.name,
                f"it is given from {first:g} s to {last:g} s, and the run goes from {begin:g} s to "
                f"{end:g} s",
                "give values for the whole run, or choose its start and stop",
            )


def is_table(value: object) -> bool:
    """Whether a value given for a scalar input is one over time."""
    if isinstance(value, (str, bool, int, float)):
        return False
    if callable(value) or (hasattr(value, "index") and hasattr(value, "to_numpy")):
        return True
    shape = getattr(value, "shape", None)
    if shape is not None:
        return len(shape) == 2
    return isinstance(value, (tuple, list)) and len(value) > 1


def make_table(
    info: ParameterInfo, given: Any, span: tuple[float, float], way: str | None = None
) -> Table:
    """The table of what is given for an input.

    Args:
        info: The input.
        given: (times, values), (times, values, way), an array of two columns, a pandas Series by
            its index, or a function of time.
        span: Begin and end of the run, between which a function is followed.
        way: One of WAYS; by default that in `given`, or `linear`, `held` for what is no real.

    Raises:
        FrotError: E0821: values that are no function of time.
    """
    if callable(given):
        return _of_function(info, given, span)
    times, values, told = _columns(info, given)
    chosen = way or told or ("linear" if info.type == "real" else "held")
    if chosen not in WAYS:
        raise _bad(info.name, f"the way '{chosen}' is not known", f"write one of {', '.join(WAYS)}")
    if info.type != "real" and chosen != "held":
        raise _bad(info.name, f"a value that is {info.type} has none in between", "write 'held'")
    _check(info, times, values)
    return _of_points(info.name, times, values, chosen)


def _columns(info: ParameterInfo, given: Any) -> tuple[list[float], list[float], str | None]:
    """Times, values and the way, where it is given."""
    if hasattr(given, "index") and hasattr(given, "to_numpy"):
        return _numbers(info, given.index), _numbers(info, given), None
    if getattr(given, "shape", None) is not None:
        if given.shape[1] != 2:
            words = f"an array of {given.shape[1]} columns"
            raise _bad(info.name, words, "give two columns: times and values")
        return _numbers(info, given[:, 0]), _numbers(info, given[:, 1]), None
    if len(given) not in (2, 3):
        words = f"{len(given)} items in place of times and values"
        raise _bad(info.name, words, "write (times, values), or (times, values, 'held')")
    way = None if len(given) == 2 or given[2] is None else str(given[2])
    return _numbers(info, given[0]), _numbers(info, given[1]), way


def _numbers(info: ParameterInfo, values: Any) -> list[float]:
    try:
        return [float(x) for x in values]
    except (TypeError, ValueError) as error:
        raise _bad(info.name, str(error), "give numbers in SI") from None


def _check(info: ParameterInfo, times: Sequence[float], values: Sequence[float]) -> None:
    """Refuse values that are no function of time with jumps: FrotError (E0821)."""
    if len(times) != len(values):
        words = f"{len(times)} times and {len(values)} values"
        raise _bad(info.name, words, "give a value for each time")
    if len(times) < 2:
        raise _bad(info.name, f"{len(times)} points", "give two at least, or a constant")
    for k, (t, value) in enumerate(zip(times, values, strict=True)):
        if not (math.isfinite(t) and math.isfinite(value)):
            words = f"point {k + 1} is ({t:g} s, {value:g}), which is no number"
            raise _bad(info.name, words, "leave it out, or give its number")
        if k and t < times[k - 1]:
            words = f"the times go back, from {times[k - 1]:.17g} s to {t:.17g} s (point {k + 1})"
            raise _bad(info.name, words, "put the points in the order of time")
        if k > 1 and t == times[k - 2]:
            raise _bad(info.name, f"three values at t = {t:.17g} s", "give two where it jumps")
        if info.type == "integer" and value != round(value):
            raise _bad(info.name, f"{value!r} is not an integer", "write whole numbers")
        if info.type == "boolean" and value not in (0.0, 1.0):
            raise _bad(info.name, f"{value!r} is not true or false", "write 0 or 1")


def _of_points(name: str, times: Sequence[float], values: Sequence[float], way: str) -> Table:
    knots: list[float] = []
    pieces: list[tuple[float, float, float, float]] = []
    for first, last in _runs(times):
        t, y = times[first:last], values[first:last]
        if len(t) == 1:
            if way == "held" and last == len(times):
                knots.append(t[0])
                pieces.append((y[0], 0.0, 0.0, 0.0))
            continue
        knots += t[:-1]
        pieces += _between(t, y, way)
    if way == "held":  # the last value holds from its time on
        knots.append(times[-1])
        pieces.append((values[-1], 0.0, 0.0, 0.0))
        kept = [k for k in range(len(knots)) if k + 1 == len(knots) or knots[k] < knots[k + 1]]
        knots, pieces = [knots[k] for k in kept], [pieces[k] for k in kept]
    return Table(name, way, (*knots, times[-1]), tuple(pieces))


def _runs(times: Sequence[float]) -> list[tuple[int, int]]:
    """Where the points between jumps begin and end."""
    cuts = [0, *(k for k in range(1, len(times)) if times[k] == times[k - 1]), len(times)]
    return list(itertools.pairwise(cuts))


def _between(
    t: Sequence[float], y: Sequence[float], way: str
) -> list[tuple[float, float, float, float]]:
    """The coefficients of the pieces between points without a jump."""
    if way == "held":
        return [(value, 0.0, 0.0, 0.0) for value in y[:-1]]
    if way == "linear" or len(t) == 2:
        steps = zip(t, t[1:], y, y[1:], strict=False)
        return [(c, (d - c) / (b - a), 0.0, 0.0) for a, b, c, d in steps]
    from scipy.interpolate import CubicSpline

    c = CubicSpline(t, y).c
    return [(float(p[3]), float(p[2]), float(p[1]), float(p[0])) for p in c.T]


def _of_function(
    info: ParameterInfo, function: Callable[[float], float], span: tuple[float, float]
) -> Table:
    """A function of time by cubic pieces, halved until they follow it, or are a jump."""
    if info.type != "real":
        raise _bad(info.name, f"a function for a value that is {info.type}", "give points, 'held'")

    def at(t: float) -> float:
        try:
            value = float(function(t))
        except (TypeError, ValueError, ArithmeticError) as error:
            words = f"the function gives no number at t = {t:g} s: {error}"
            raise _bad(info.name, words, "let it give one for every time of the run") from None
        if not math.isfinite(value):
            words = f"the function gives {value:g} at t = {t:g} s"
            raise _bad(info.name, words, "let it give a number for every time of the run")
        return value

    begin, end = span
    size = max(abs(at(begin + (end - begin) * k / 64)) for k in range(65)) or 1.0
    knots, pieces = [], []
    waiting = [
        (begin + (end - begin) * k / 16, begin + (end - begin) * (k + 1) / 16) for k in range(16)
    ]
    waiting.reverse()
    while waiting:
        a, b = waiting.pop()
        piece, wrong = _cubic(at, a, b)
        if wrong <= FOLLOWED * size or b - a <= JUMP * (end - begin):
            knots.append(a)
            pieces.append(piece)
            if len(knots) > MOST_KNOTS:
                words = f"the function is not followed by {MOST_KNOTS} pieces"
                raise _bad(info.name, words, "give points, or write it in the text")
            continue
        middle = a + (b - a) / 2
        waiting += [(middle, b), (a, middle)]
    return Table(info.name, "cubic", (*knots, end), tuple(pieces))


def _cubic(
    at: Callable[[float], float], a: float, b: float
) -> tuple[tuple[float, float, float, float], float]:
    """The cubic through four points of [a, b], and how far it is from two others."""
    h = b - a
    y = [at(a + h * k / 3) for k in range(3)] + [at(b)]
    c1 = (-11 * y[0] + 18 * y[1] - 9 * y[2] + 2 * y[3]) / 2
    c2 = 9 * (2 * y[0] - 5 * y[1] + 4 * y[2] - y[3]) / 2
    c3 = 9 * (-y[0] + 3 * y[1] - 3 * y[2] + y[3]) / 2
    wrong = max(
        abs(y[0] + s * (c1 + s * (c2 + s * c3)) - at(a + s * h)) for s in (1 / 6, 0.55, 0.83)
    )
    return (y[0], c1 / h, c2 / h**2, c3 / h**3), wrong


def _bad(name: str, what: str, help: str) -> Exception:
    return fail("E0821", f"bad values of the input '{name}' over time: {what}", help=help)


def moving_of(tables: Iterable[Table]) -> frozenset[str]:
    """The inputs that are polynomials of time in the program of these tables."""
    return frozenset(table.name for table in tables if table.way != "held")
