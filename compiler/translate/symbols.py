"""The CasADi symbols that expressions of a text are translated to."""

from __future__ import annotations

from dataclasses import dataclass, field

import casadi as ca
from frot.dsl.checked import Input, Parameter


@dataclass(frozen=True, slots=True, eq=False)
class Symbols:
    """CasADi symbols, all columns.

    `t` time; `q` coordinates (nq), `v` speeds (nv), `sw` auxiliary speeds (na), zero in the motion,
    along which the reaction of a reduced liaison is read; `u` inputs, `p` parameters, `sides` of
    the contacts (+1 or -1); `a` rates of v (nv), `lam` reactions of the rows by the names of their
    liaisons, `energy` (dissipated, work). `rates` are those of q in q and v; `q_speed` is the speed
    that is the rate of a coordinate, or -1; `turns` are the coordinates that are quaternions,
    `spots` those of places that roll along, whose rates come with the kinematics. The
    last of q are the mechanism's counters; their rates come with the geometry (reduce.py).
    `parameters` and `inputs` are scalars in the order of p and u; `items` are those of each array.
    """

    t: ca.SX
    q: ca.SX
    v: ca.SX
    sw: ca.SX
    u: ca.SX
    p: ca.SX
    sides: ca.SX
    a: ca.SX
    lam: ca.SX
    energy: ca.SX
    rates: ca.SX
    q_speed: tuple[int, ...]
    turns: tuple[Turning, ...]
    spots: tuple[int, ...]
    parameters: tuple[Parameter, ...]
    inputs: tuple[Input, ...]
    items: dict[Parameter, tuple[Parameter, ...]]
    _values: dict[Parameter | Input, ca.SX] = field(default_factory=dict)

    def value(self, of: Parameter | Input) -> ca.SX:
        """A parameter or an input in the shape of its type, or one scalar of it."""
        return self._values[of]


@dataclass(frozen=True, slots=True)
class Turning:
    """A quaternion: its first coordinate, its three speeds, -1 for one that is always zero.

    `own_axes`: the speeds are along the axes that turn, else along those of the ground.
    """

    coordinate: int
    speeds: tuple[int, int, int]
    own_axes: bool


def shaped(items: list[ca.SX], shape: tuple[int, ...]) -> ca.SX:
    """A scalar, a column, or a matrix from its items by rows."""
    if not shape:
        return items[0]
    whole = ca.vertcat(*items) if items else ca.SX.zeros(0)
    return ca.reshape(whole, shape[1], shape[0]).T if len(shape) == 2 else whole
