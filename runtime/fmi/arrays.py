"""Arrays of FMI 3.0: the components of a vector or matrix of the text as one variable."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import TYPE_CHECKING, Any

from frot.runtime.fmi.scalars import Scalar

if TYPE_CHECKING:
    from frot.runtime.number_arrays import Floats

_INDEXED = re.compile(r"(?P<base>.+)\[(?P<indices>[0-9]+(?:,[0-9]+)*)\]")
_COMPONENT = re.compile(r"(?P<base>.+)\.(?P<letter>[xyz])")


@dataclass(frozen=True, slots=True)
class Variable:
    """One variable of FMI 3.0: a scalar, which has no dimensions, or an array, row by row."""

    name: str
    elements: tuple[Scalar, ...]
    dimensions: tuple[int, ...] = ()

    @property
    def first(self) -> Scalar:
        """The element whose value reference is that of the variable."""
        return self.elements[0]

    @property
    def knowns(self) -> tuple[str, ...] | None:
        """What the elements depend on together; None where one may depend on anything."""
        of = [one.knowns for one in self.elements]
        if any(one is None for one in of):
            return None
        return tuple(dict.fromkeys(name for one in of for name in one or ()))


def grouped(variables: Sequence[Scalar], arrays: bool) -> tuple[Variable, ...]:
    """All variables in order, those of one vector or matrix together if `arrays`.

    They are real numbers, neighbours, alike in all but value and dependencies, and have all
    indices from 1 on, or the components x, y and maybe z. What model exchange adds is left apart.
    """
    return tuple(_grouped(variables) if arrays else (Variable(v.name, (v,)) for v in variables))


def _grouped(variables: Sequence[Scalar]) -> Iterator[Variable]:
    names = {v.name for v in variables}
    at = 0
    while at < len(variables):
        one = _array(variables, at, names) or Variable(variables[at].name, (variables[at],))
        at += len(one.elements)
        yield one


def _array(variables: Sequence[Scalar], at: int, names: set[str]) -> Variable | None:
    """The array that begins there, if one does."""
    first = variables[at]
    base, place = _place(first)
    if place is None or set(place) != {1} or base in names:
        return None
    run = [first]
    for other in variables[at + 1 :]:
        if _place(other)[0] != base:
            break
        run.append(other)
    if any(_plain(one) != _plain(first) for one in run):
        return None
    places = [_place(one)[1] for one in run]
    last = places[-1] or ()
    if places != list(product(*(range(1, n + 1) for n in last))) or _is_component(first, run):
        return None
    return Variable(base, tuple(run), last)


def _is_component(first: Scalar, run: Sequence[Scalar]) -> bool:
    """Whether this is the lonely x of a record."""
    return len(run) == 1 and not _INDEXED.fullmatch(first.name)


def _place(variable: Scalar) -> tuple[str, tuple[int, ...] | None]:
    """The name of the array and the indices in it, None of what is no element."""
    if variable.motion or variable.type != "real":
        return variable.name, None
    match = _INDEXED.fullmatch(variable.name)
    if match:
        return match["base"], tuple(map(int, match["indices"].split(",")))
    match = _COMPONENT.fullmatch(variable.name)
    return (match["base"], ("xyz".index(match["letter"]) + 1,)) if match else (variable.name, None)


def _plain(variable: Scalar) -> Scalar:
    """What elements of one array have in common."""
    start = None if variable.start is None else 0.0
    return replace(variable, name="", reference=0, start=start, knowns=None, plain="")


def elements_in(record: Any, variables: Iterable[Variable]) -> Iterator[tuple[Scalar, Floats]]:
    """Each element of the variables, with its values in what FMPy has recorded of them."""
    for one in variables:
        columns = record[one.name].astype(float).reshape(len(record), -1).T
        yield from zip(one.elements, columns, strict=True)
