"""Numbers of a scene, written for Frot and evaluated for the judge from one description."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

Look = Callable[[str], float]
"""Value of a parameter or of a variable of the result (`time` included), in SI."""

# Exponents of mass, length, time: a scene can be written in any units.
DIMENSIONS: Mapping[str, tuple[int, int, int]] = {
    "Real": (0, 0, 0),
    "Angle": (0, 0, 0),
    "Mass": (1, 0, 0),
    "Length": (0, 1, 0),
    "Time": (0, 0, 1),
    "Velocity": (0, 1, -1),
    "AngularVelocity": (0, 0, -1),
    "Acceleration": (0, 1, -2),
    "Force": (1, 1, -2),
    "Torque": (1, 2, -2),
    "Inertia": (1, 2, 0),
    "Stiffness": (1, 0, -2),
    "Damping": (1, 0, -1),
    "Momentum": (1, 1, -1),
}


@dataclass(frozen=True, slots=True)
class Value:
    """An expression: its text, and its number at an instant."""

    text: str
    at: Callable[[Look], float]

    def __add__(self, other: Value | float) -> Value:
        b = as_value(other)
        return Value(f"({self.text} + {b.text})", lambda look: self.at(look) + b.at(look))

    def __sub__(self, other: Value | float) -> Value:
        b = as_value(other)
        return Value(f"({self.text} - {b.text})", lambda look: self.at(look) - b.at(look))

    def __mul__(self, other: Value | float) -> Value:
        b = as_value(other)
        return Value(f"{self.text}*{b.text}", lambda look: self.at(look) * b.at(look))

    def __truediv__(self, other: Value | float) -> Value:
        b = as_value(other)
        return Value(f"{self.text}/({b.text})", lambda look: self.at(look) / b.at(look))

    def __neg__(self) -> Value:
        return Value(f"(-{self.text})", lambda look: -self.at(look))


def as_value(x: Value | float) -> Value:
    if isinstance(x, Value):
        return x
    return Value(f"({x!r})" if x < 0 else repr(x), lambda look: float(x))


def name(word: str) -> Value:
    """A parameter, a variable of the result, or `time`."""
    return Value(word, lambda look: look(word))


def sin(x: Value) -> Value:
    return Value(f"sin({x.text})", lambda look: math.sin(x.at(look)))


def cos(x: Value) -> Value:
    return Value(f"cos({x.text})", lambda look: math.cos(x.at(look)))


def clamp(x: Value) -> Value:
    """`x` between 0 and 1."""
    return Value(f"min(1, max(0, {x.text}))", lambda look: min(1.0, max(0.0, x.at(look))))


def bell(x: Value) -> Value:
    """exp(-x^2)."""
    return Value(f"exp(-({x.text})^2)", lambda look: math.exp(-(x.at(look) ** 2)))


def switch(left: Value, right: Value, yes: Value, no: Value) -> Value:
    """`yes` where left < right, else `no`."""
    return Value(
        f"(if {left.text} < {right.text} then {yes.text} else {no.text})",
        lambda look: yes.at(look) if left.at(look) < right.at(look) else no.at(look),
    )
