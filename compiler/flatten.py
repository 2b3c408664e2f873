"""Parameters and inputs as the kernel holds them: scalars, those of an array by its items."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TypeVar

from frot.compiler.names import component_names
from frot.dsl.arrays import scalars
from frot.dsl.checked import Input, Parameter

T = TypeVar("T", Parameter, Input)


def tunable(parameters: Sequence[Parameter]) -> dict[Parameter, tuple[Parameter, ...]]:
    """The scalars of each parameter that a run can set; a text and a constant are fixed."""
    return {
        p: _items(p, [*scalars(p.value)], "value")
        for p in parameters
        if not p.constant and p.type.base != "string"
    }


def by_input(inputs: Sequence[Input]) -> dict[Input, tuple[Input, ...]]:
    """The scalars of each input."""
    return {i: _items(i, [*scalars(i.start)], "start") for i in inputs}


def _items(whole: T, values: Sequence[object], field: str) -> tuple[T, ...]:
    """`mu` itself, or `mu[1]`, `mu[2]`, each with its own value."""
    shape = whole.type.shape
    if not shape:
        return (whole,)
    one = whole.type.of_shape(())
    names = component_names(whole.name, shape)
    return tuple(
        replace(whole, name=name, type=one, **{field: value})
        for name, value in zip(names, values, strict=True)
    )
