"""Models of friction in space, compiled once in a process, and what they end with."""

from __future__ import annotations

import textwrap
from functools import cache
from pathlib import Path

import frot

MODELS = Path(__file__).parents[2] / "models"
G = 9.81


@cache
def model(text: str) -> frot.Model:
    """The model of a text that may be indented."""
    return frot.compile(textwrap.dedent(text))


@cache
def loaded(name: str) -> frot.Model:
    """The model of a file of `models`."""
    return frot.load(MODELS / f"{name}.frot")


def run(name: str, **values: object) -> frot.Result:
    """Its run with other parameters."""
    return loaded(name).simulate(parameters=values)


def last(result: frot.Result, *names: str) -> list[float]:
    """The last values of variables."""
    return [float(result[name][-1]) for name in names]
