"""Impacts in the DAE of a model: what impulses in its rows do, and the laws that bound them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import casadi as ca
from frot.compiler.lowering.lower import Lowered
from frot.compiler.mechanics.laws.elements import Bound
from frot.compiler.mechanics.laws.restitution import restitution_of
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.compiler.symbolic.columns import column

if TYPE_CHECKING:
    from frot.compiler.equations.assembled import Assembled

    # A Function of the DAE's arguments, of named results; `also`: a last argument.
    Maker = Callable[..., ca.Function]


@dataclass(frozen=True, slots=True)
class ContactRow:
    """A liaison with one normal: its row, and the number of its rule of restitution.

    `opens`: its place among the contacts that can part, -1 of what always holds; `signed`: the mode
    says on which side it presses. `reads`: coordinates keep it, and its impulse follows from the
    others. `mode`: where its four numbers begin in the mode, -1 of a relation.
    """

    name: str
    row: int
    opens: int
    signed: bool
    reads: bool
    rule: int
    mode: int


@dataclass(frozen=True, slots=True)
class LawRow:
    """A dry law on one motion: its row, and those of the impulses that bound it.

    `norms`: of a joint, of how many of these each reaction is made whose length counts; `contact`:
    the name of its liaison; `mode`: the place of its number in the mode, `closed` that of its
    liaison's. `coefficient`: its place in `coefficients`. A `fixed` bound, a value of the text, is
    no impulse: `bounded_by` is empty.
    """

    name: str
    row: int
    bounded_by: tuple[int, ...]
    by_normal: bool
    norms: tuple[int, ...]
    mode: int
    closed: int
    coefficient: int


@dataclass(frozen=True, slots=True, eq=False)
class Impacts:
    """What impulses P in the rows of the DAE do: v+ = v- + A^-1 J' P, u+ = u- + W P.

    Functions take (t, x, z, u, p, mode) as those of `Dae`, but where other arguments are named.
    Rows are those of the reactions in `rows`, in the order of `Dae.names.z`.

    * `gap`: of the contacts that can part, in m or rad: `contacts`;
    * `rate`: the speeds u of the rows, and the sizes of what they are sums of;
    * `acceleration`: of the rows;
    * `effect`: W = J A^-1 J', in 1/kg. Of a liaison that coordinates keep, the reaction that an
      impulse brings about; such rows have no impulse of their own;
    * `strike` (..., impulse) -> x_after: the reset by the impulses of the rows;
    * `coefficients`: of each law in slip and at rest, a column each;
    * `restitution` (p) -> e and whether it can part, of each of `normals`;
    * `percussion` (..., struck) -> x_after and the changes of the rows by the percussions of the
      text, without reactions; `struck` has 1 for each that strikes. None without a percussion.
    """

    rows: tuple[str, ...]
    contacts: tuple[str, ...]
    percussions: tuple[str, ...]
    normals: tuple[ContactRow, ...]
    laws: tuple[LawRow, ...]
    due: tuple[int, ...]
    gap: ca.Function
    rate: ca.Function
    acceleration: ca.Function
    effect: ca.Function
    strike: ca.Function
    coefficients: ca.Function
    restitution: ca.Function
    percussion: ca.Function | None


def impacts_of(
    lowered: Lowered,
    effects: tuple[ca.SX, ca.SX],
    names: tuple[str, ...],
    labels: tuple[str, ...],
    function: Maker,
) -> Impacts:
    """The impacts of a DAE whose mode has these `names`, and whose rows these `labels`.

    `effects`: see `effects_of`.
    """
    system = lowered.system
    links = system.reduced.mechanism.contacts
    rows = system.matrices.rows
    opens = [k for k, link in enumerate(links) if link.opens and not link.reduced]
    places = {name: k for k, name in enumerate(names)}
    impulse = ca.SX.sym("impulse", system.lam.numel())
    spread, effect = effects
    percussions = system.reduced.events.percussions
    struck = ca.SX.sym("struck", len(percussions))
    x, moved = ca.vertcat(system.q, system.v), ca.SX.zeros(system.q.shape)
    percussion = None
    if percussions:
        speeds, changes = _percussion(system, struck)
        results = ("x_after", x + ca.vertcat(moved, speeds)), ("rate_change", changes)
        percussion = function("percussion", *results, also=("struck", struck))
    sizes = ca.fabs(rows[:, : system.nv]) @ ca.fabs(system.v) + ca.fabs(system.matrices.rate)
    accelerations = rows @ system.z + system.matrices.bias if rows.numel() else ca.SX.zeros(0)
    coefficients = ca.reshape(system.matrices.coefficients, 2, -1).T
    return Impacts(
        rows=labels,
        contacts=tuple(links[k].liaison.name for k in opens),
        percussions=tuple(one.force.name for one in percussions),
        normals=_normals(lowered, opens, places),
        laws=_laws(lowered, places),
        due=tuple(places[one.due.name()] for one in percussions),
        gap=function("gap", ("gap", column(system.matrices.gap[k] for k in opens))),
        rate=function("rate", ("rate", system.matrices.rate), ("size", sizes)),
        acceleration=function("acceleration", ("acceleration", accelerations)),
        effect=function("effect", ("effect", effect)),
        strike=function(
            "strike",
            ("x_after", x + ca.vertcat(moved, spread @ impulse)),
            also=("impulse", impulse),
        ),
        coefficients=function("coefficients", ("coefficients", coefficients)),
        restitution=_restitution(lowered),
        percussion=percussion,
    )


def _split(system: Assembled) -> tuple[list[int], list[int], list[int]]:
    """Places in z that are no auxiliary ones; rows that are read, and those that act."""
    links, rows = system.reduced.mechanism.contacts, system.reduced.contact_rows
    read = [r for link, own in zip(links, rows, strict=True) if link.reduced for r in own.reaction]
    core = [*range(system.nv), *range(system.nv + system.na, system.z.numel())]
    return core, read, [r for r in range(system.lam.numel()) if r not in set(read)]


def _answer(system: Assembled, load: ca.SX) -> tuple[ca.SX, ca.SX]:
    """Speeds (nv), and the rows (speeds, or of what is read reactions), by impulsive loads (nw).

    Each column of `load` is one: A z - E_read lam_read = load.
    """
    core, read, acting = _split(system)
    matrix = system.in_full()[0]
    whole = ca.horzcat(matrix[:, core], -system.matrices.spread[:, read])
    solved = ca.solve(whole, load) if load.numel() else ca.SX.zeros(whole.size1(), load.size2())
    rows = ca.SX.zeros(system.lam.numel(), load.size2())
    if acting:
        rows[acting, :] = system.matrices.rows[acting, core] @ solved[: len(core), :]
    if read:
        rows[read, :] = solved[len(core) :, :]
    return solved[: system.nv, :], rows


def effects_of(system: Assembled) -> tuple[ca.SX, ca.SX]:
    """What an impulse of each row does to the speeds (nv x rows), and to the rows: W."""
    _, _, acting = _split(system)
    speeds, rows = _answer(system, system.matrices.spread[:, acting])
    count = system.lam.numel()
    spread, effect = ca.SX.zeros(system.nv, count), ca.SX.zeros(count, count)
    if acting:
        spread[:, acting], effect[:, acting] = speeds, rows
    return spread, effect


def _percussion(system: Assembled, struck: ca.SX) -> tuple[ca.SX, ca.SX]:
    """Changes of the speeds and of the rows by the percussions, whose force has such a factor."""
    factors = column(one.strike for one in system.reduced.events.percussions)
    force = system.in_full()[1]
    return _answer(system, ca.jacobian(force, factors) @ struck)


def _restitution(lowered: Lowered) -> ca.Function:
    """(p) -> e, and whether it can part, of each contact with a normal."""
    symbols = lowered.reduced.symbols
    count = symbols.p.numel()
    found = lowered.whole.functions["parameters"].call(
        [symbols.p, ca.SX.ones(count), ca.SX.zeros(symbols.u.shape)]
    )
    own = [k for k, link in enumerate(lowered.reduced.mechanism.contacts) if link.has_normal]
    values = [ca.vertcat(*(found[i][k] for k in own)) if own else ca.SX(0, 1) for i in (6, 2)]
    return ca.Function("restitution", [symbols.p], values, ["p"], ["e", "unilateral"])


def _normals(lowered: Lowered, opens: list[int], mode: dict[str, int]) -> tuple[ContactRow, ...]:
    reduced = lowered.reduced
    found = []
    for k, (link, rows) in enumerate(
        zip(reduced.mechanism.contacts, reduced.contact_rows, strict=True)
    ):
        if not link.has_normal:
            continue
        name = link.liaison.name
        found.append(
            ContactRow(
                name=name,
                row=rows.reaction[0],
                opens=opens.index(k) if k in opens and is_unilateral(link.liaison) else -1,
                signed=link.opens and link.ruled,
                reads=link.reduced,
                rule=restitution_of(link.liaison)[1],
                mode=mode[f"{name}.closed"] if link.ruled else -1,
            )
        )
    return tuple(found)


def _laws(lowered: Lowered, mode: dict[str, int]) -> tuple[LawRow, ...]:
    """The laws of liaisons, then those of the text."""
    links, texts = lowered.reduced.mechanism.contacts, lowered.system.elements
    found = []
    for k, e in enumerate(lowered.grouping.elements):
        own = e.contact < len(links)
        name = links[e.contact].liaison.name if own else texts[e.contact - len(links)].name
        moves = not (e.row in lowered.grouping.prescribed or e.bound is Bound.VALUE)
        found.append(
            LawRow(
                name=f"{name}.{'rolling' if e.rolling else 'friction'}",
                row=e.row,
                bounded_by=e.bounded_by if moves else (),
                by_normal=e.bound is Bound.NORMAL,
                norms=e.norms,
                mode=mode[f"{name}.{'rolling' if e.rolling else 'friction'}"],
                closed=mode[f"{name}.closed"],
                coefficient=k,
            )
        )
    return tuple(found)
