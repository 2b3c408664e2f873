"""Numbers of expressions that no motion changes: at the parameters and inputs of a run."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from typing import TYPE_CHECKING

import casadi as ca
import numpy as np

from frot.dsl.checked import Expression
from frot.view.outline import Array

if TYPE_CHECKING:
    from frot.compiler.equations.assembled import Assembled


class Numbers:
    """Evaluates expressions of parameters and of time."""

    def __init__(self, system: Assembled, parameters: Mapping[str, float], time: float) -> None:
        """`parameters` in SI by name; inputs have their start values."""
        reduced = system.reduced
        self._symbols = reduced.symbols
        self.kinematics = reduced.variables.kinematics
        self.lower = self.kinematics.fixed.lower
        self._p = np.array([parameters[p.name] for p in self._symbols.parameters], dtype=float)
        self._time = time

    def of(self, value: Expression, time: float | None = None) -> Array:
        """The value of an expression, as an array of one, two or no axes."""
        return self.evaluate(ca.densify(self.lower(value)), time)

    def evaluate(self, value: ca.SX, time: float | None = None) -> Array:
        """The value of a CasADi expression."""
        found = self._call(ca.Function("number", self._given, [value]), time)
        if found.size == 1:
            return found.reshape(())
        return found[:, 0] if found.shape[1] == 1 else found

    def along(
        self, value: ca.SX, parameter: ca.SX, at: Array, time: float | None = None
    ) -> Array | None:
        """The values (n x 3) of an expression of one or two parameters at n places.

        None where it depends on more than time and parameters.
        """
        inputs = [*self._given, parameter]
        try:
            function = ca.Function("along", inputs, [ca.densify(value)])
        except RuntimeError:
            return None
        places = np.atleast_2d(at)
        found = function(self._now(time), self._inputs, self._p, places)
        return np.array(found).T

    def changes(self, value: ca.SX) -> bool:
        """Whether time changes the value."""
        return bool(ca.depends_on(value, self._symbols.t))

    @property
    def _given(self) -> list[ca.SX]:
        return [self._symbols.t, self._symbols.u, self._symbols.p]

    @property
    def _inputs(self) -> Array:
        return np.zeros(self._symbols.u.numel())

    def _now(self, time: float | None) -> float:
        return self._time if time is None else time

    def _call(self, function: ca.Function, time: float | None) -> Array:
        return np.array(function(self._now(time), self._inputs, self._p))


def packed(values: Array) -> str:
    """Numbers as text: 32 bits each, what has none is zero."""
    found = np.nan_to_num(np.asarray(values, dtype=np.float32), posinf=0, neginf=0)
    return base64.b64encode(found.tobytes()).decode("ascii")
