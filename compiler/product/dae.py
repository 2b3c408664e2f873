"""The CasADi DAE of a model with its switching, for other integrators and optimal control."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import casadi as ca
import numpy as np
from frot.compiler.lowering.assembled import Assembled
from frot.compiler.lowering.lower import Lowered
from frot.compiler.lowering.symbols import Rows, column, scalars_of
from frot.compiler.lowering.walk import as_number
from frot.compiler.mechanics.liaisons.locks import Way
from frot.compiler.mechanics.mechanism import Contact, Joint, Link, Relation, rolls
from frot.dsl import default_values, evaluate
from frot.dsl.data.classes import dataclass

CLOSED, SIDE, FRICTION, ROLLING = range(4)
STICK, FORWARD, BACKWARD = range(1, 4)
PARTS = ("closed", "reaction_sign", "friction", "rolling")
GUARDS = ("normal", "friction_1", "friction_2", "rolling_1", "rolling_2")
NEWTON_STEPS = 10


@dataclass(frozen=True, slots=True)
class Names:
    """Names in the order of the functions' vectors; all values are in SI.

    `fired` are the conditions that `update` asks for, by their names in `mode`.
    """

    x: tuple[str, ...]
    z: tuple[str, ...]
    u: tuple[str, ...]
    p: tuple[str, ...]
    mode: tuple[str, ...]
    guards: tuple[str, ...]
    invariants: tuple[str, ...]
    fired: tuple[str, ...]
    outcomes: tuple[str, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Dae:
    """x' = ode, 0 = alg in a given mode, the guards that end the mode and the resets at its end.

    All Functions take (t, x, z, u, p, mode) but where other arguments are named. x: coordinates and
    other states, then speeds; z: accelerations, the unknowns of the text that friction or the
    mechanism changes at once, reactions (of a pin: force of a on b, and friction couple), forces of
    `friction(...)`, then the unknowns of systems of equations of the text.

    `mode` has four numbers a contact, pin or `friction(...)`: closed (0 or 1;
    only a contact opens), sign of a bilateral normal reaction (a contact's), friction and rolling
    (0 no law, 1 stick, 2 slip forward, 3 slip backward); then the conditions (0 or 1), the sides of
    the contacts (+1 or -1), the values that only events change.

    * `ode` (x'), `alg` (0, index 1: a system in z, linear but for the size of the reaction of a pin
      in slip and for what is nonlinear in the text);
    * `guards`: five for each of the former, positive while the mode lasts: normal (gap if open,
      reaction if closed), friction (2), rolling (2); then the conditions. One that cannot end the
      mode is 1;
    * `solve` (t, x, u, p, mode) -> z: the system solved; by Newton's method from the guesses of the
      text where it is not linear. Not unique, and no numbers, where relations are redundant;
    * `invariants` (t, x, u, p, mode) -> 0: what equations differentiated demand of the states;
    * `start` (t, u, p) -> x: the values and guesses of `initial`, before they meet the relations;
    * `u0`, `p0`: start values of the inputs and the parameters, in SI;
    * `reset` (t, x, z, u, p, mode) -> x_after: speeds moved onto the relations of `mode`, the mode
      entered, by the least change in the metric of the mass. Without impacts nothing else jumps;
    * `update` (t, x, z, u, p, mode, fired) -> x_after, the values that only events change, and for
      each of `names.outcomes` whether it is asked for: what the `when`s do whose conditions come to
      hold. None without a `when`.

    The next mode at an event is a complementarity problem: `frot.Model.simulate` solves it.
    """

    names: Names
    ode: ca.Function
    alg: ca.Function
    guards: ca.Function
    solve: ca.Function
    invariants: ca.Function
    start: ca.Function
    reset: ca.Function
    update: ca.Function | None
    u0: ca.DM
    p0: ca.DM

    def problem(self) -> dict[str, ca.SX]:
        """`t x z p ode alg` for `casadi.integrator`; its p is (u, p, mode) in one column."""
        t, x, z = (ca.SX.sym(n, *self.ode.size_in(k)) for k, n in enumerate("txz"))
        parts = [ca.SX.sym(n, *self.ode.size_in(3 + k)) for k, n in enumerate(("u", "p", "m"))]
        return {
            "t": t,
            "x": x,
            "z": z,
            "p": ca.vertcat(*parts),
            "ode": self.ode(t, x, z, *parts),
            "alg": self.alg(t, x, z, *parts),
        }


@dataclass(frozen=True, slots=True, eq=False)
class _Switch:
    """What four numbers of the mode rule: a contact, a pin, a relation, a `friction` of the text.

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
        for row, kind in ((self.rows.tangent, FRICTION), (self.rows.rolling, ROLLING)):
            if row >= 0:
                yield row, self.mode[kind]


def dae_of(lowered: Lowered) -> Dae:
    """The DAE of a model's functions."""
    system = lowered.system
    reduced, s = system.reduced, system.reduced.symbols
    switches = _switches(system)
    flags = column(reduced.conditions.flags)
    contacts = [isinstance(link, Contact) for link in reduced.mechanism.contacts]
    sides = [x for x, one in zip(scalars_of(s.sides), contacts, strict=True) if one]
    mode = ca.vertcat(*(w.mode for w in switches if w.ruled), flags, *sides, system.discrete)
    nv, na, solved = system.nv, system.na, scalars_of(system.z)
    auxiliary, core = column(solved[nv : nv + na]), column([*solved[:nv], *solved[nv + na :]])
    x, z = ca.vertcat(system.q, system.v), ca.vertcat(core, system.lam, system.y)
    # what is no contact has a place among the sides, but none
    sideless = ca.SX.zeros(len(system.elements))
    d = ca.vertcat(flags, s.sides, sideless, system.discrete)
    state = [s.t, system.q, system.v, s.u, s.p, d, system.y]
    conditions = lowered.conditions
    q, v, guess, _ = lowered.functions["start"].call([s.t, s.u, s.p])
    values = default_values(reduced.mechanism.model, {})
    places = {"t": s.t, "x": x, "z": z, "u": s.u, "p": s.p, "mode": mode}

    nowhere = ca.vertcat(
        auxiliary, *(x for x, one in zip(scalars_of(s.sides), contacts, strict=True) if not one)
    )
    settled = ca.vertcat(
        ca.SX.zeros(auxiliary.shape), ca.SX.ones(nowhere.numel() - auxiliary.numel())
    )

    def function(name: str, *results: tuple[str, ca.SX], without: str = "") -> ca.Function:
        """A function of all `places` but one, auxiliary accelerations at zero.

        What touches and cannot part is on the outer side.
        """
        taken = {k: symbols for k, symbols in places.items() if k != without}
        return ca.Function(
            name,
            list(taken.values()),
            [_put(value, nowhere, settled) for _, value in results],
            list(taken),
            [k for k, _ in results],
        )

    matrix, force = system.in_full()
    balance = matrix @ system.z - force - system.spread @ system.lam
    blocks = (block.residual for block in system.blocks)
    alg = function("alg", ("alg", ca.vertcat(balance, *_laws(system, switches), *blocks)))
    update = None
    if "update" in lowered.functions:
        fired = ca.SX.sym("fired", len(reduced.events.fired))
        places["fired"] = fired
        after = lowered.functions["update"].call(
            [*state, system.z, system.lam, fired, system.discrete]
        )
        update = function(
            "update",
            ("x_after", ca.vertcat(after[0], after[1])),
            ("values", after[2]),
            ("outcomes", after[3]),
        )
        del places["fired"]
    first = ca.vertcat(ca.SX.zeros(core.numel() + system.lam.numel()), guess)
    return Dae(
        names=_names(system, switches),
        ode=function("ode", ("ode", ca.vertcat(system.rates, *solved[:nv]))),
        alg=alg,
        guards=function("guards", ("guards", column(_guards(system, switches, conditions)))),
        solve=_solve(alg, places, first),
        invariants=function("invariants", ("values", system.invariants.values), without="z"),
        start=ca.Function("start", [s.t, s.u, s.p], [ca.vertcat(q, v)], ["t", "u", "p"], ["x"]),
        reset=function("reset", ("x_after", _reset(system, switches))),
        update=update,
        u0=_column(as_number(evaluate(i.start, values)) for i in s.inputs),
        p0=_column(as_number(evaluate(k.value, values)) for k in s.parameters),
    )


def _put(value: ca.SX, symbols: ca.SX, numbers: ca.SX) -> ca.SX:
    return ca.substitute(value, symbols, numbers) if symbols.numel() and value.numel() else value


def _column(numbers: Iterable[float]) -> ca.DM:
    return ca.DM(np.array(list(numbers)))


def _names(system: Assembled, switches: list[_Switch]) -> Names:
    reduced = system.reduced
    conditions = tuple(f"condition_{k + 1}" for k in range(len(reduced.conditions.flags)))
    speeds = [x.name() for x in scalars_of(system.v)]
    unknowns = scalars_of(system.z)[system.nv + system.na :]
    return Names(
        x=system.names,
        z=(
            *(f"der({name})" for name in speeds),
            *(x.name() for x in unknowns),
            *(label for w in switches for label in w.labels),
            *(x.name() for x in scalars_of(system.y)),
        ),
        u=tuple(i.name for i in reduced.symbols.inputs),
        p=tuple(p.name for p in reduced.symbols.parameters),
        mode=(
            *(f"{w.name}.{part}" for w in switches if w.ruled for part in PARTS),
            *conditions,
            *(
                f"{link.liaison.name}.side"
                for link in reduced.mechanism.contacts
                if isinstance(link, Contact)
            ),
            *(x.name() for x in scalars_of(system.discrete)),
        ),
        guards=(
            *(f"{w.name}.{part}" for w in switches if w.ruled for part in GUARDS),
            *conditions,
        ),
        invariants=tuple(origin.text for origin in system.invariants.origins),
        fired=tuple(conditions[k] for k in reduced.events.conditions),
        outcomes=tuple(outcome.text for outcome in reduced.events.outcomes),
    )


def _switches(system: Assembled) -> list[_Switch]:
    reduced, lam = system.reduced, system.lam
    found: list[_Switch] = []
    for i, (link, rows) in enumerate(
        zip(reduced.mechanism.contacts, reduced.contact_rows, strict=True)
    ):
        contact = isinstance(link, Contact)
        ruled = not isinstance(link, Relation) and not (isinstance(link, Joint) and rolls(link))
        mode = ca.SX.sym("m", len(PARTS)) if ruled else ca.SX([1.0, 0.0, 0.0, 0.0])
        found.append(
            _Switch(
                name=link.liaison.name,
                mode=mode,
                ruled=ruled,
                rows=rows,
                free=not link.reduced,
                normal=mode[SIDE] * lam[rows.reaction[0]] if contact else _size(lam, rows),
                gap=None if link.reduced or not contact else system.gap[i],
                labels=_row_names(link, rows),
            )
        )
    row = reduced.rows.size1()
    for k, element in enumerate(system.elements):
        found.append(
            _Switch(
                name=element.name,
                mode=ca.SX.sym("m", len(PARTS)),
                ruled=True,
                rows=Rows((), row + k, -1),
                free=False,
                normal=ca.SX(1),
                gap=None,
                labels=(element.force.name(),),
            )
        )
    return found


def _size(lam: ca.SX, rows: Rows) -> ca.SX:
    """The size of a pin's reaction; its slope is zero where it carries nothing.

    So Newton's method can start there.
    """
    square = sum((lam[r] ** 2 for r in rows.reaction), ca.SX(0))
    return ca.if_else(square > 0, ca.sqrt(ca.if_else(square > 0, square, 1)), 0)


def _row_names(link: Link, rows: Rows) -> tuple[str, ...]:
    name = link.liaison.name
    if isinstance(link, Relation):
        return (f"{name}.reaction[{link.joint.locks.index(link.lock) + 1}]",)
    if not isinstance(link, Contact):
        couple = (f"{name}.torque",) if rows.tangent >= 0 else ()
        ways = [
            lock.axis
            for lock in (link.locks if isinstance(link, Joint) else ())
            if isinstance(lock, Way)
        ]
        if len(ways) == len(rows.reaction):
            return (*(f"{name}.force.{'xyz'[k]}" for k in ways), *couple)
        locks = link.locks if isinstance(link, Joint) else ()
        first = len(locks) - len(rows.reaction) + 1
        return (*(f"{name}.reaction[{first + k}]" for k in range(len(rows.reaction))), *couple)
    return (
        f"{name}.normal_force",
        *([f"{name}.tangential_force"] if rows.tangent >= 0 else []),
        *([f"{name}.rolling_couple"] if rows.rolling >= 0 else []),
    )


def _solve(alg: ca.Function, places: dict[str, ca.SX], first: ca.SX) -> ca.Function:
    """Gives z: one linear solve, or Newton's method from `first` where `alg` is not linear in z."""
    z = places["z"]
    residual = alg.call(list(places.values()))[0]
    slope = ca.jacobian(residual, z)
    names = [k for k in places if k != "z"]
    known = [places[k] for k in names]
    if not (z.numel() and ca.depends_on(slope, z)):
        constant = _put(residual, z, ca.SX.zeros(z.shape))
        solved = -ca.solve(slope, constant) if z.numel() else ca.SX.zeros(0)
        return ca.Function("solve", known, [solved], names, ["z"])
    begin = ca.Function("begin", known, [first])
    step = ca.Function("newton_step", [z, *known], [z - ca.solve(slope, residual)])
    arguments = [ca.MX.sym(n, *x.shape) for n, x in zip(names, known, strict=True)]
    reached = begin(*arguments)
    for _ in range(NEWTON_STEPS):
        reached = step(reached, *arguments)
    return ca.Function("solve", arguments, [reached], names, ["z"])


def _coefficient(system: Assembled, row: int, *, at_rest: bool) -> ca.SX:
    """The coefficient of the law whose motion is this row; of a `friction`, its bound."""
    rows = [r for x in system.reduced.contact_rows for r in (x.tangent, x.rolling) if r >= 0]
    rows += range(system.reduced.rows.size1(), system.rows.size1())
    return system.coefficients[2 * rows.index(row) + at_rest]


def _laws(system: Assembled, switches: list[_Switch]) -> Iterator[ca.SX]:
    """One equation a row that no auxiliary acceleration balances."""
    acceleration = system.rows @ system.z + system.bias if system.lam.numel() else ca.SX.zeros(0)
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


def _guards(system: Assembled, switches: list[_Switch], conditions: ca.SX) -> Iterator[ca.SX]:
    for w in switches:
        if not w.ruled:
            continue
        closed, guards = w.mode[CLOSED], dict.fromkeys(GUARDS, ca.SX(1))
        if w.gap is not None:
            guards["normal"] = ca.if_else(closed, w.normal, w.gap)
        for row, kind in w.laws():
            name = "friction" if row == w.rows.tangent else "rolling"
            bound = _coefficient(system, row, at_rest=True) * w.normal
            lam, rate = system.lam[row], system.rate[row]
            slips = closed * ((kind == FORWARD) + (kind == BACKWARD))
            stuck = closed * (kind == STICK)
            along = ca.if_else(kind == FORWARD, rate, -rate)
            guards[f"{name}_1"] = ca.if_else(stuck, bound - lam, ca.if_else(slips, along, 1))
            guards[f"{name}_2"] = ca.if_else(stuck, bound + lam, 1)
        yield from guards.values()
    flags = system.reduced.conditions.flags
    for flag, value in zip(flags, scalars_of(conditions), strict=True):
        yield ca.if_else(flag, value, -value)


def _reset(system: Assembled, switches: list[_Switch]) -> ca.SX:
    """Speeds whose rows that hold have the rate zero: v - M^-1 J' (J M^-1 J' + I - D)^-1 D r.

    r are the rates, J = dr/dv; D has a one for each row that holds, other rows of J become zero.
    """
    nv, nr = system.nv, system.lam.numel()
    if nr == 0:
        return ca.vertcat(system.q, system.v)
    holds = ca.SX.zeros(nr)
    for w in switches:
        for row in w.rows.reaction if w.free else ():
            holds[row] = w.mode[CLOSED]
        for row, kind in w.laws():
            holds[row] = w.mode[CLOSED] * (kind == STICK)
    active = ca.diag(holds) @ system.rows[:, :nv]
    metric = system.tree.in_full(system.metric, system.v, nv)[0]
    spread = ca.solve(metric[:nv, :nv], active.T)
    matrix = active @ spread + ca.diag(1 - holds)
    moved = system.v - spread @ ca.solve(matrix, holds * system.rate)
    return ca.vertcat(system.q, moved)
