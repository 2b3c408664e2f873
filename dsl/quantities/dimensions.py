"""Physical dimensions and the types of expressions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import prod

BASE = ("m", "kg", "s", "A", "K", "mol", "cd")


@dataclass(frozen=True, slots=True)
class Dimension:
    """Exponents of m, kg, s, A, K, mol, cd; whole ones are `int`. Angles are dimensionless."""

    exponents: tuple[Fraction | int, ...] = (0,) * 7

    def __mul__(self, other: Dimension) -> Dimension:
        return Dimension(tuple(a + b for a, b in zip(self.exponents, other.exponents, strict=True)))

    def __truediv__(self, other: Dimension) -> Dimension:
        return Dimension(tuple(a - b for a, b in zip(self.exponents, other.exponents, strict=True)))

    def __pow__(self, power: Fraction | int) -> Dimension:
        exact = (a * Fraction(power) for a in self.exponents)
        return Dimension(tuple(int(e) if e.denominator == 1 else e for e in exact))

    @property
    def is_one(self) -> bool:
        """Whether it is dimensionless."""
        return not any(self.exponents)

    @property
    def unit(self) -> str:
        """The coherent SI unit as people write it, as `N` or `kg.m^2`; `1` for a number."""
        if self in NAMED:
            return NAMED[self]
        named = sorted(zip(BASE, self.exponents, strict=True), key=lambda pair: pair[0] != "kg")
        above = [_power(n, e) for n, e in named if e > 0]
        below = [_power(n, -e) for n, e in named if e < 0]
        text = ".".join(above) or "1"
        return "/".join([text, *below])


def _power(name: str, exponent: Fraction | int) -> str:
    if exponent == 1:
        return name
    return f"{name}^{exponent}" if exponent == int(exponent) else f"{name}^({exponent})"


def dimension(m: int = 0, kg: int = 0, s: int = 0, A: int = 0, K: int = 0) -> Dimension:
    """The dimension with these exponents of the base units."""
    return Dimension((m, kg, s, A, K, 0, 0))


ONE = dimension()

# Units with a name, and products of them that people write.
NAMED: Mapping[Dimension, str] = {
    dimension(m=1, kg=1, s=-2): "N",
    dimension(m=2, kg=1, s=-2): "N.m",
    dimension(m=2, kg=1, s=-3): "W",
    dimension(kg=1, s=-2): "N/m",
    dimension(kg=1, s=-1): "N.s/m",
    dimension(m=1, kg=1, s=-1): "N.s",
    dimension(m=2, kg=1, s=-1): "N.m.s",
    dimension(m=-1, kg=1, s=-2): "Pa",
    dimension(A=1, s=1): "C",
    dimension(m=2, kg=1, s=-3, A=-1): "V",
    dimension(m=2, kg=1, s=-3, A=-2): "Ohm",
    dimension(m=-2, kg=-1, s=3, A=2): "1/Ohm",
    dimension(m=2, kg=1, s=-2, A=-2): "H",
    dimension(m=-2, kg=-1, s=4, A=2): "F",
    dimension(m=2, kg=1, s=-2, A=-1): "Wb",
    dimension(kg=1, s=-2, A=-1): "T",
}


@dataclass(frozen=True, slots=True)
class Enumeration:
    """An enumeration: its name and its literals, which count from 1."""

    name: str
    literals: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Type:
    """Type of an expression: base (`real integer boolean string`), dimension and shape.

    `shape` is `()` for a scalar, `(2,)` or `(3,)` for a vector, `(n, m)` for a matrix.
    The base of an enumeration is `integer`.
    """

    base: str = "real"
    dimension: Dimension = ONE
    shape: tuple[int, ...] = ()
    enumeration: Enumeration | None = None

    @property
    def item(self) -> Type:
        """The type of what one index gives."""
        return Type(self.base, self.dimension, self.shape[1:], self.enumeration)

    @property
    def count(self) -> int:
        """The number of scalars."""
        return prod(self.shape)

    def of_shape(self, shape: tuple[int, ...]) -> Type:
        """The same type in another shape."""
        return Type(self.base, self.dimension, shape, self.enumeration)

    @property
    def is_scalar(self) -> bool:
        """Whether it has no index."""
        return not self.shape


REAL = Type()
BOOLEAN = Type("boolean")
INTEGER = Type("integer")
STRING = Type("string")
