"""Switches in the DAE of a model: modes of friction and contact, their guards, the resets."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import casadi as ca
from frot.compiler.equations.assembled import Assembled
from frot.compiler.mechanics.constraint_geometry import Rows
from frot.compiler.mechanics.variables import Closed
from frot.compiler.symbolic.columns import scalars_of

CLOSED, SIDE, FRICTION, ROLLING = range(4)
STICK, FORWARD, BACKWARD = range(1, 4)
PARTS = ("closed", "reaction_sign", "friction", "rolling")
GUARDS = ("normal", "friction_1", "friction_2", "rolling_1", "rolling_2")


@dataclass(frozen=True, slots=True, eq=False)
class Switch:
    """The owner of four numbers of the mode: a contact, pin, relation or `friction` of the text.

    A relation of a loop always holds: it is not `ruled`, and its mode a constant. A reaction
    follows from the mode where it is `free`; else coordinates keep the liaison, and it is read.
    `normal` is what bounds friction, `gap` is None for what cannot open; `labels` name the rows.
    """

    name: str
    mode: ca.SX
    ruled: bool
    rows: Rows
    free: bool
    normal: ca.SX
    gap: ca.SX | None
    labels: tuple[str, ...]

    def laws(self) -> Iterator[tuple[int, ca.SX]]:
        """Each row of friction with the number that says how it moves."""
        for rows, kind in ((self.rows.tangent, FRICTION), (self.rows.rolling, ROLLING)):
            for row in rows:
                yield row, self.mode[kind]


def switches_of(system: Assembled) -> list[Switch]:
    """Switches: contacts and pins, relations of loops, `friction`s of the text."""
    reduced, lam = system.reduced, system.lam
    found: list[Switch] = []
    for i, (link, rows) in enumerate(
        zip(reduced.mechanism.contacts, reduced.contact_rows, strict=True)
    ):
        mode = ca.SX.sym("m", len(PARTS)) if link.ruled else ca.SX([1.0, 0.0, 0.0, 0.0])
        found.append(
            Switch(
                name=link.liaison.name,
                mode=mode,
                ruled=link.ruled,
                rows=rows,
                free=not link.reduced,
                normal=mode[SIDE] * lam[rows.reaction[0]]
                if link.opens
                else _size(lam, link.bounding(rows), link.norms),
                gap=None if link.reduced or not link.opens else system.matrices.gap[i],
                labels=link.labels(rows),
            )
        )
    row = reduced.motion.matrices.rows.size1()
    for k, element in enumerate(system.elements):
        found.append(
            Switch(
                name=element.name,
                mode=ca.SX.sym("m", len(PARTS)),
                ruled=True,
                rows=Rows((), (row + k,)),
                free=False,
                normal=ca.SX(1),
                gap=None,
                labels=(element.force.name(),),
            )
        )
    return found


def reads_of_closed(system: Assembled, switches: Sequence[Switch]) -> dict[int, ca.SX]:
    """What says that a contact is closed, by its place among the discrete values."""
    modes = enumerate(system.reduced.variables.modes.of.items())
    return {
        place: switches[contact].mode[CLOSED]
        for place, (owner, (contact, _)) in modes
        if isinstance(owner, Closed)
    }


def _size(lam: ca.SX, rows: tuple[int, ...], norms: tuple[int, ...]) -> ca.SX:
    """The size of a pin's reactions; its slope is zero where they carry nothing.

    So Newton's method can start there.
    """
    total, first = ca.SX(0), 0
    for count in norms or (len(rows),):
        square = sum((lam[r] ** 2 for r in rows[first : first + count]), ca.SX(0))
        total += ca.if_else(square > 0, ca.sqrt(ca.if_else(square > 0, square, 1)), 0)
        first += count
    return total


def _coefficient(system: Assembled, row: int, *, at_rest: bool) -> ca.SX:
    """The coefficient of the law whose motion is this row; of a `friction`, its bound."""
    rows = [r for x in system.reduced.contact_rows for r in (*x.tangent, *x.rolling)]
    rows += range(system.reduced.motion.matrices.rows.size1(), system.matrices.rows.size1())
    return system.matrices.coefficients[2 * rows.index(row) + at_rest]


def laws_of(
    system: Assembled,
    switches: list[Switch],
    inertias: Sequence[ca.SX] = (),
    gives: Sequence[ca.SX] = (),
) -> Iterator[ca.SX]:
    """One equation a row that no auxiliary acceleration balances.

    Accelerations of rows that hold are forces by `inertias`, one each; then `gives` act on them.
    """
    acceleration = (
        system.matrices.rows @ system.z + system.matrices.bias
        if system.lam.numel()
        else ca.SX.zeros(0)
    )
    if inertias:
        acceleration *= ca.vertcat(*inertias)
    if gives:
        acceleration += ca.vertcat(*gives) * system.lam
    for w in switches:
        closed = w.mode[CLOSED]
        for row in w.rows.reaction if w.free else ():
            yield ca.if_else(closed, acceleration[row], system.lam[row])
        for row, kind in w.laws():
            sign = ca.if_else(kind == FORWARD, 1, 0) - ca.if_else(kind == BACKWARD, 1, 0)
            bound = _coefficient(system, row, at_rest=False) * w.normal
            follows = system.lam[row] + sign * bound
            held = ca.if_else(kind == STICK, acceleration[row], follows)
            yield ca.if_else(closed, held, system.lam[row])


def guards_of(system: Assembled, switches: list[Switch], conditions: ca.SX) -> Iterator[ca.SX]:
    """Guards, positive while the mode lasts: five numbers a switch, then the conditions."""
    for w in switches:
        if not w.ruled:
            continue
        closed, guards = w.mode[CLOSED], dict.fromkeys(GUARDS, ca.SX(1))
        if w.gap is not None:
            guards["normal"] = ca.if_else(closed, w.normal, w.gap)
        for row, kind in w.laws():
            name = "friction" if row in w.rows.tangent else "rolling"
            bound = _coefficient(system, row, at_rest=True) * w.normal
            lam, rate = system.lam[row], system.matrices.rate[row]
            slips = closed * ((kind == FORWARD) + (kind == BACKWARD))
            stuck = closed * (kind == STICK)
            along = ca.if_else(kind == FORWARD, rate, -rate)
            guards[f"{name}_1"] = ca.if_else(stuck, bound - lam, ca.if_else(slips, along, 1))
            guards[f"{name}_2"] = ca.if_else(stuck, bound + lam, 1)
        yield from guards.values()
    flags = system.reduced.conditions.flags
    for flag, value in zip(flags, scalars_of(conditions), strict=True):
        yield ca.if_else(flag, value, -value)


def reset_of(
    system: Assembled, switches: list[Switch], inertias: Sequence[ca.SX], gives: Sequence[ca.SX]
) -> tuple[ca.SX, ca.SX, ca.SX, ca.SX]:
    """The impulses P that bring the rates r of rows that hold to zero: (J M^-1 J' + I - D) P = D r.

    J = dr/dv; D has a one for each row that holds, other rows of J become zero. Returns the matrix,
    the same with the `gives`, the right side, all by `inertias`, and the speeds -M^-1 J' of unit
    impulses.
    """
    nv, nr = system.nv, system.lam.numel()
    holds = ca.SX.zeros(nr)
    for w in switches:
        for row in w.rows.reaction if w.free else ():
            holds[row] = w.mode[CLOSED]
        for row, kind in w.laws():
            holds[row] = w.mode[CLOSED] * (kind == STICK)
    active = ca.diag(holds) @ system.matrices.rows[:, :nv]
    metric = system.tree.in_full(system.matrices.metric, system.v, nv)[0]
    spread = ca.solve(metric[:nv, :nv], active.T)
    masses = ca.vertcat(*inertias)
    matrix = ca.diag(masses) @ (active @ spread) + ca.diag(1 - holds)
    soft = matrix + ca.diag(holds * ca.vertcat(*gives))
    return matrix, soft, masses * holds * system.matrices.rate, -spread
