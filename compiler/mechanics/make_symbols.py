"""The symbols of a mechanism, and the rows of its constraints."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import casadi as ca
from frot.compiler.mechanics.constraint import Constraint
from frot.compiler.mechanics.constraint_geometry import Rows
from frot.compiler.mechanics.liaisons.motion import Motion
from frot.compiler.mechanics.mechanism import Mechanism
from frot.compiler.symbolic.columns import column
from frot.compiler.translate.flatten import T, by_input, tunable
from frot.compiler.translate.symbols import Symbols, Turning, shaped
from frot.dsl.checked import Input, Liaison, Parameter


def reading_places(mechanism: Mechanism) -> tuple[dict[Liaison, int], int]:
    """First auxiliary speed of each liaison that has some, and the number of all."""
    places: dict[Liaison, int] = {}
    count = 0
    for link in mechanism.contacts:
        if link.readings:
            places[link.liaison] = count
            count += link.readings
    return places, count


def link_rows(links: tuple[Constraint, ...]) -> tuple[Rows, ...]:
    """Number the rows of the links."""
    rows: list[Rows] = []
    count = 0
    for link in links:
        reaction = tuple(range(count, count + (link.readings or 1)))
        count += len(reaction)
        along: dict[bool, tuple[int, ...]] = {}
        of_laws: list[tuple[int, ...]] = []
        for block in link.frictions:
            of_laws.append(tuple(range(count, count + block.components)))
            along[block.turns] = (*along.get(block.turns, ()), *of_laws[-1])
            count += block.components
        sliding, turning = along.get(False, ()), along.get(True, ())
        rows.append(Rows(reaction, sliding, turning, tuple(of_laws)))
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
