"""The symbols of a reduced system."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

import casadi as ca
from frot.compiler.lowering.flatten import T, by_input, tunable
from frot.compiler.mechanics.mechanism import (
    Joint,
    Mechanism,
    Pin,
)
from frot.compiler.mechanics.names import coordinate_names
from frot.dsl.checked import Input, Liaison, Parameter


@dataclass(frozen=True, slots=True, eq=False)
class Symbols:
    """CasADi symbols, all columns.

    `t` time; `q` coordinates (nq), `v` speeds (nv = nq in the plane), `w` and `sw` auxiliary
    coordinates and speeds (na), zero in the motion, along which the reaction of a reduced liaison
    is read; `u` inputs, `p` parameters, `sides` of the contacts (+1 or -1); `a` accelerations (nv),
    `lam` reactions of the rows by the names of their liaisons, `energy` (dissipated, work).
    `parameters` and `inputs` are scalars in the order of p and u; `items` are those of each array.
    """

    t: ca.SX
    q: ca.SX
    v: ca.SX
    w: ca.SX
    sw: ca.SX
    u: ca.SX
    p: ca.SX
    sides: ca.SX
    a: ca.SX
    lam: ca.SX
    energy: ca.SX
    parameters: tuple[Parameter, ...]
    inputs: tuple[Input, ...]
    items: dict[Parameter, tuple[Parameter, ...]]
    _values: dict[Parameter | Input, ca.SX] = field(default_factory=dict)

    def value(self, of: Parameter | Input) -> ca.SX:
        """A parameter or an input in the shape of its type, or one scalar of it."""
        return self._values[of]

    @property
    def auxiliary(self) -> ca.SX:
        """Auxiliary coordinates and speeds, to be replaced by zero."""
        return ca.vertcat(self.w, self.sw)


@dataclass(frozen=True, slots=True)
class Rows:
    """Rows of a contact or pin in the order of the kernel's arrays; -1 where there is none.

    `normal` and, for a pin, `second` are the components of the reaction.
    """

    normal: int
    tangent: int
    rolling: int
    second: int = -1


def column(values: Iterable[ca.SX]) -> ca.SX:
    """The values below one another; an empty column for none."""
    items = list(values)
    return ca.vertcat(*items) if items else ca.SX.zeros(0)


def auxiliary_places(mechanism: Mechanism) -> tuple[dict[Liaison, int], int]:
    """First auxiliary speed of each liaison that has some, and the number of all.

    A line has one, along its normal; a pin has two, along the axes of the ground.
    """
    places: dict[Liaison, int] = {}
    count = 0
    for joint in mechanism.contacts:
        if joint.reduced:
            places[joint.liaison] = count
            count += 2 if isinstance(joint, Pin) else 1
    return places, count


def contact_rows(contacts: tuple[Joint, ...]) -> tuple[Rows, ...]:
    """Number the rows of the contacts and pins."""
    rows: list[Rows] = []
    count = 0
    for contact in contacts:
        normal, second, tangent, rolling = count, -1, -1, -1
        count += 1
        if isinstance(contact, Pin):
            second, count = count, count + 1
        if contact.mu is not None:
            tangent, count = count, count + 1
        if contact.delta is not None:
            rolling, count = count, count + 1
        rows.append(Rows(normal, tangent, rolling, second))
    return tuple(rows)


def make_symbols(mechanism: Mechanism) -> Symbols:
    """Symbols of the sizes the mechanism needs."""
    names = [n for c in mechanism.coordinates for n in coordinate_names(c)]
    _, na = auxiliary_places(mechanism)
    rows = contact_rows(mechanism.contacts)
    reactions = [
        joint.liaison.name
        for joint, r in zip(mechanism.contacts, rows, strict=True)
        for k in (r.normal, r.second, r.tangent, r.rolling)
        if k >= 0
    ]
    items, of_input = tunable(mechanism.model.parameters), by_input(mechanism.model.inputs)
    values: dict[Parameter | Input, ca.SX] = {}
    p, u = _scalars(items, values), _scalars(of_input, values)
    return Symbols(
        t=ca.SX.sym("t"),
        q=column(ca.SX.sym(n) for n in names),
        v=column(ca.SX.sym(f"der({n})") for n in names),
        w=ca.SX.sym("w", na),
        sw=ca.SX.sym("sw", na),
        u=column(u),
        p=column(p),
        sides=ca.SX.sym("side", len(mechanism.contacts)),
        a=column(ca.SX.sym(f"der(der({n}))") for n in names),
        lam=column(ca.SX.sym(n) for n in reactions),
        energy=ca.SX.sym("energy", 2),
        parameters=tuple(one for group in items.values() for one in group),
        inputs=tuple(one for group in of_input.values() for one in group),
        items=items,
        _values=values,
    )


def _scalars(
    items: Mapping[T, tuple[T, ...]], values: dict[Parameter | Input, ca.SX]
) -> list[ca.SX]:
    """A symbol for each scalar; `values` learns those of each of them, and of each array."""
    found: list[ca.SX] = []
    for whole, group in items.items():
        symbols = [ca.SX.sym(one.name) for one in group]
        found += symbols
        values.update(zip(group, symbols, strict=True))
        values[whole] = shaped(symbols, whole.type.shape)
    return found


def shaped(items: list[ca.SX], shape: tuple[int, ...]) -> ca.SX:
    """A scalar, a column, or a matrix from its items by rows."""
    if not shape:
        return items[0]
    whole = ca.vertcat(*items) if items else ca.SX.zeros(0)
    return ca.reshape(whole, shape[1], shape[0]).T if len(shape) == 2 else whole
