"""The functions of a DAE at an instant, as arrays of numbers."""

from __future__ import annotations

import numpy as np
from frot.compiler.product.dae_functions import DaeFunctions
from frot.dsl.messages.errors import fail
from numpy.typing import NDArray

Vector = NDArray[np.float64]

# Part of what a speed is a sum of below which it is zero.
AT_REST = 1e-9


def as_vector(values: object) -> Vector:
    """Numbers as an array of one dimension."""
    return np.array(values, dtype=float).reshape(-1)


class Instant:
    """A state of the DAE that an event changes: x and the mode are arrays of its own."""

    def __init__(
        self,
        dae: DaeFunctions,
        t: float,
        x: object,
        u: object,
        p: object,
        mode: object,
        slow: float,
    ) -> None:
        """Copy the state; `touched` are contacts that close in the event."""
        self.slow = slow
        self.touched: set[str] = set()
        self.dae, self.t = dae, float(t)
        self.x, self.u, self.p, self.mode = map(as_vector, (x, u, p, mode))
        for what in ("x", "u", "p", "mode"):
            self._check(what, getattr(self, what), len(getattr(dae.names, what)))

    def _check(self, what: str, values: Vector, count: int) -> None:
        if len(values) != count:
            raise fail(
                "E0806",
                f"'{what}' of the DAE has {count} numbers, not {len(values)}",
                help=f"`dae.names.{what}` lists them",
            )
        if not np.all(np.isfinite(values)):
            raise fail("E0806", f"'{what}' has a number that is not finite", help="look at it")

    def z(self) -> Vector:
        """What `solve` gives in the mode."""
        return np.array(self.dae.solve(self.t, self.x, self.u, self.p, self.mode)).ravel()

    def of(self, name: str, *more: object, z: Vector | None = None) -> Vector:
        """A function of `Impacts` here, its first result."""
        function = getattr(self.dae.impacts, name)
        z = self.z() if z is None else z
        found = function(self.t, self.x, z, self.u, self.p, self.mode, *more)
        first = found[0] if isinstance(found, tuple) else found
        return np.array(first)

    def rates(self) -> tuple[Vector, Vector]:
        """Speeds of the rows, and below which size each is zero."""
        rate, size = self.dae.impacts.rate(self.t, self.x, self.z(), self.u, self.p, self.mode)
        return np.array(rate).ravel(), np.maximum(AT_REST * np.array(size).ravel(), self.slow)

    def guards(self, z: Vector | None = None) -> Vector:
        """All guards."""
        z = self.z() if z is None else z
        return np.array(self.dae.guards(self.t, self.x, z, self.u, self.p, self.mode)).ravel()

    def guard(self, name: str) -> float:
        """The guard of this name."""
        return float(self.guards()[self.dae.names.guards.index(name)])

    def flags(self) -> list[int]:
        """Places of the conditions in the mode."""
        return [k for k, name in enumerate(self.dae.names.mode) if name in self.conditions()]

    def conditions(self) -> frozenset[str]:
        """Names of the conditions: they have no owner."""
        return frozenset(name for name in self.dae.names.guards if name.startswith("condition_"))

    def parting(self) -> frozenset[str]:
        """The liaisons that can part, with these parameters."""
        impacts = self.dae.impacts
        parts = np.array(impacts.restitution(self.p)[1]).ravel()
        return frozenset(
            one.name
            for one, part in zip(impacts.normals, parts, strict=True)
            if one.opens >= 0 and part
        )
