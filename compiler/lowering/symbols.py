"""The symbols of a reduced system."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import casadi as ca
from frot.compiler.lowering.flatten import T, by_input, tunable
from frot.compiler.mechanics.liaisons.motion import Motion
from frot.compiler.mechanics.link import Link
from frot.compiler.mechanics.mechanism import Mechanism
from frot.compiler.symbolic.columns import column
from frot.dsl.checked import Input, Liaison, Parameter


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


@dataclass(frozen=True, slots=True)
class Rows:
    """Rows of a link in the order of the kernel's arrays; -1 where there is none.

    `reaction` are the components of what it locks: of a contact the normal one. `of_laws` are those
    of each law of friction; `tangent` and `rolling` the first of sliding and of rolling.
    """

    reaction: tuple[int, ...]
    tangent: int
    rolling: int
    of_laws: tuple[tuple[int, ...], ...] = ()

    @property
    def all(self) -> tuple[int, ...]:
        """Every row."""
        return (*self.reaction, *(row for rows in self.of_laws for row in rows))


def reading_places(mechanism: Mechanism) -> tuple[dict[Liaison, int], int]:
    """First auxiliary speed of each liaison that has some, and the number of all."""
    places: dict[Liaison, int] = {}
    count = 0
    for link in mechanism.contacts:
        if link.readings:
            places[link.liaison] = count
            count += link.readings
    return places, count


def link_rows(links: tuple[Link, ...]) -> tuple[Rows, ...]:
    """Number the rows of the links."""
    rows: list[Rows] = []
    count = 0
    for link in links:
        reaction = tuple(range(count, count + (link.readings or 1)))
        count += len(reaction)
        tangent = rolling = -1
        of_laws: list[tuple[int, ...]] = []
        for friction in link.frictions:
            if friction.rolling:
                rolling = count
            elif not friction.pivoting:
                tangent = count
            of_laws.append(tuple(range(count, count + friction.components)))
            count += friction.components
        rows.append(Rows(reaction, tangent, rolling, tuple(of_laws)))
    return tuple(rows)


def counters_of(mechanism: Mechanism, q: ca.SX) -> dict[tuple[Liaison, int], ca.SX]:
    """The symbols of the mechanism's counters, by liaison and motion."""
    first = q.numel() - len(mechanism.counters)
    return {(x.liaison, k): q[first + i] for i, (x, k) in enumerate(mechanism.counters)}


def make_symbols(mechanism: Mechanism) -> Symbols:
    """Symbols of the sizes the mechanism needs."""
    names = [n for c in mechanism.coordinates for n in c.names]
    speeds = [n for c in mechanism.coordinates for n in c.speeds]
    _, na = reading_places(mechanism)
    rows = link_rows(mechanism.contacts)
    reactions = [
        link.liaison.name for link, r in zip(mechanism.contacts, rows, strict=True) for _ in r.all
    ]
    q, v = column(ca.SX.sym(n) for n in names), column(ca.SX.sym(n) for n in speeds)
    turned = column(ca.SX.sym(f"{x.liaison.name}.turned") for x, _ in mechanism.counters)
    motions = [m for c in mechanism.coordinates for m in c.motions]
    items, of_input = tunable(mechanism.model.parameters), by_input(mechanism.model.inputs)
    values: dict[Parameter | Input, ca.SX] = {}
    p, u = _scalars(items, values), _scalars(of_input, values)
    return Symbols(
        t=ca.SX.sym("t"),
        q=ca.vertcat(q, turned) if turned.numel() else q,
        v=v,
        sw=ca.SX.sym("sw", na),
        u=column(u),
        p=column(p),
        sides=ca.SX.sym("side", len(mechanism.contacts)),
        a=column(ca.SX.sym(f"der({n})") for n in speeds),
        lam=column(ca.SX.sym(n) for n in reactions),
        energy=ca.SX.sym("energy", 2),
        rates=_rates(motions, q, v),
        q_speed=(*_rate_places(motions), *[-1] * turned.numel()),
        turns=_turns(motions),
        spots=tuple(
            k for m, i, _ in _places(motions) if m.is_taken for k in range(i.start, i.stop)
        ),
        parameters=tuple(one for group in items.values() for one in group),
        inputs=tuple(one for group in of_input.values() for one in group),
        items=items,
        _values=values,
    )


def _places(motions: list[Motion]) -> Iterator[tuple[Motion, slice, slice]]:
    """Each motion with its coordinates and its speeds."""
    nq = nv = 0
    for motion in motions:
        m, n = len(motion.coordinates), motion.speed_count
        yield motion, slice(nq, nq + m), slice(nv, nv + n)
        nq, nv = nq + m, nv + n


def _rates(motions: list[Motion], q: ca.SX, v: ca.SX) -> ca.SX:
    """Q' = N(q) v."""
    if not any(motion.quaternion for motion in motions):
        return v
    return column(motion.rates(q[i], v[k]) for motion, i, k in _places(motions))


def _rate_places(motions: list[Motion]) -> tuple[int, ...]:
    found: list[int] = []
    for motion, i, k in _places(motions):
        count = i.stop - i.start
        own = motion.quaternion is None and not motion.is_taken
        found += range(k.start, k.start + count) if own else [-1] * count
    return tuple(found)


def _turns(motions: list[Motion]) -> tuple[Turning, ...]:
    found: list[Turning] = []
    for motion, i, k in _places(motions):
        if motion.quaternion is not None:
            own = motion.quaternion.own_axes
            first = k.start - 1 if own else k.start
            speeds = (-1 if own else first, first + 1, first + 2)
            found.append(Turning(i.start, speeds, own))
    return tuple(found)


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
