"""The symbols of a reduced system."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

import casadi as ca
from frot.compiler.mechanism import Contact, Coordinates, LineCoordinates, Mechanism
from frot.dsl.checked import Input, Parameter


@dataclass(frozen=True, slots=True, eq=False)
class Symbols:
    """CasADi symbols, all columns.

    `t` time; `q` coordinates (nq), `v` speeds (nv = nq in the plane), `w` and `sw` auxiliary
    coordinates and speeds (na), zero in the motion, along which the reaction of a reduced liaison
    is read; `u` inputs, `p` parameters, `sides` of the contacts (+1 or -1); `a` accelerations (nv),
    `lam` reactions of the rows, `energy` (dissipated, work).
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
    _place: dict[Parameter, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._place.update({p: i for i, p in enumerate(self.parameters)})

    def parameter(self, parameter: Parameter) -> ca.SX:
        """The symbol of a parameter."""
        return self.p[self._place[parameter]]

    @property
    def auxiliary(self) -> ca.SX:
        """Auxiliary coordinates and speeds, to be replaced by zero."""
        return ca.vertcat(self.w, self.sw)


@dataclass(frozen=True, slots=True)
class Rows:
    """Rows of a contact in the order of the kernel's arrays; -1 where there is none."""

    normal: int
    tangent: int
    rolling: int


def column(values: Iterable[ca.SX]) -> ca.SX:
    """The values below one another; an empty column for none."""
    items = list(values)
    return ca.vertcat(*items) if items else ca.SX.zeros(0)


def coordinate_names(coordinates: Coordinates) -> tuple[str, ...]:
    """Names of the coordinates, for messages and the DAE."""
    body = coordinates.body
    turning = (f"{body.name}.angle",) if body.shape is not None and body.shape.turns else ()
    if isinstance(coordinates, LineCoordinates):
        return (f"{coordinates.liaison.name}.u", *turning)
    return (f"{body.name}.position.x", f"{body.name}.position.y", *turning)


def contact_rows(contacts: tuple[Contact, ...]) -> tuple[Rows, ...]:
    """Number the rows of the contacts."""
    rows: list[Rows] = []
    count = 0
    for contact in contacts:
        normal, tangent, rolling = count, -1, -1
        count += 1
        if contact.mu is not None:
            tangent, count = count, count + 1
        if contact.delta is not None:
            rolling, count = count, count + 1
        rows.append(Rows(normal, tangent, rolling))
    return tuple(rows)


def make_symbols(mechanism: Mechanism) -> Symbols:
    """Symbols of the sizes the mechanism needs."""
    nq = sum(len(coordinate_names(c)) for c in mechanism.coordinates)
    na = sum(contact.reduced for contact in mechanism.contacts)
    rows = contact_rows(mechanism.contacts)
    n_rows = sum((r.normal >= 0) + (r.tangent >= 0) + (r.rolling >= 0) for r in rows)
    parameters = tuple(p for p in mechanism.model.parameters if not p.constant)
    inputs = mechanism.model.inputs
    return Symbols(
        t=ca.SX.sym("t"),
        q=ca.SX.sym("q", nq),
        v=ca.SX.sym("v", nq),
        w=ca.SX.sym("w", na),
        sw=ca.SX.sym("sw", na),
        u=ca.SX.sym("u", len(inputs)),
        p=ca.SX.sym("p", len(parameters)),
        sides=ca.SX.sym("side", len(mechanism.contacts)),
        a=ca.SX.sym("a", nq),
        lam=ca.SX.sym("lam", n_rows),
        energy=ca.SX.sym("energy", 2),
        parameters=parameters,
        inputs=inputs,
    )
