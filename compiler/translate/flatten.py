"""Parameters and inputs as the kernel holds them: scalars, those of an array by its items."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TypeVar

from frot.dsl.checked import Expression, Input, Parameter
from frot.dsl.checked.arrays import bounds_of, component_names, scalars

T = TypeVar("T", Parameter, Input)


def tunable(parameters: Sequence[Parameter]) -> dict[Parameter, tuple[Parameter, ...]]:
    """The scalars of each parameter that a run can set; a text and a constant are fixed.

    Those of `mu` with two items are `mu[1]` and `mu[2]`, each with its own value.
    """
    return {
        p: tuple(
            replace(p, name=name, type=p.type.of_shape(()), value=value, bounds=bounds)
            for name, value, bounds in _parts(p, p.value)
        )
        if p.type.shape
        else (p,)
        for p in parameters
        if not p.constant and p.type.base != "string"
    }


def by_input(inputs: Sequence[Input]) -> dict[Input, tuple[Input, ...]]:
    """The scalars of each input."""
    return {
        i: tuple(
            replace(i, name=name, type=i.type.of_shape(()), start=value, bounds=bounds)
            for name, value, bounds in _parts(i, i.start)
        )
        if i.type.shape
        else (i,)
        for i in inputs
    }


def _parts(
    whole: Parameter | Input, value: Expression
) -> Iterator[tuple[str, Expression, tuple[tuple[str, Expression], ...]]]:
    """Name, value and bounds of each scalar."""
    values = scalars(value)
    names = component_names(whole.name, whole.type.shape)
    return zip(names, values, bounds_of(whole.bounds, len(values)), strict=True)
