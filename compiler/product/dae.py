"""The CasADi DAE of a model with its switching, for other integrators and optimal control."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import casadi as ca
import numpy as np
from frot.compiler.lowering.lower import Lowered, lower
from frot.compiler.lowering.symbols import Rows, column, scalars_of
from frot.compiler.lowering.walk import as_number
from frot.compiler.mechanics.locks import Way
from frot.compiler.mechanics.mechanism import Contact, Joint, Link
from frot.compiler.mechanics.mechanize import mechanize
from frot.compiler.mechanics.reduce import Reduced, reduce
from frot.dsl import Log
from frot.dsl.checked import Model

CLOSED, SIDE, FRICTION, ROLLING = range(4)
STICK, FORWARD, BACKWARD = range(1, 4)
NEWTON_STEPS = 10


@dataclass(frozen=True, slots=True)
class Names:
    """Names in the order of the functions' vectors; all values are in SI."""

    x: tuple[str, ...]
    z: tuple[str, ...]
    u: tuple[str, ...]
    p: tuple[str, ...]
    mode: tuple[str, ...]
    guards: tuple[str, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Dae:
    """x' = ode, 0 = alg in a given mode, the guards that end the mode and the resets at its end.

    All Functions take (t, x, z, u, p, mode). x: coordinates then speeds; z: accelerations then
    reactions of the contacts' rows (of a pin: force of a on b and friction couple); `mode` has four
    numbers a contact or pin, then the conditions (0 or 1) and the sides of the contacts (+1 or -1):
    closed (0 or 1; a pin always is), sign of a bilateral normal reaction (a pin has none),
    friction and rolling (0 no law, 1 stick, 2 slip forward, 3 slip backward).

    * `ode` (x'), `alg` (0, index 1: a system in z, linear but for the norm of the reaction of a pin
      in slip);
    * `guards`: five a contact, positive while the mode lasts: normal (gap if open, reaction if
      closed), friction (2), rolling (2); then the conditions. One that cannot end the mode is 1;
    * `solve` (t, x, u, p, mode) -> z: the system solved;
    * `u0`, `p0`: start values of the inputs and the parameters, in SI;
    * `reset` (t, x, z, u, p, mode) -> x_after: speeds moved onto the relations of `mode`, the mode
      entered, by the least change in the metric of the mass. Without impacts nothing else jumps.

    The next mode at an event is a complementarity problem: `frot.Model.simulate` solves it.
    """

    names: Names
    ode: ca.Function
    alg: ca.Function
    guards: ca.Function
    solve: ca.Function
    reset: ca.Function
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


def make_dae(model: Model, log: Log) -> Dae | None:
    """The DAE of a model; None where it is refused (reported to `log`)."""
    mechanism = mechanize(model, log)
    reduced = reduce(mechanism, log) if mechanism is not None else None
    lowered = lower(reduced, log) if reduced is not None else None
    if lowered is None:
        return None
    if model.variables or not lowered.grouping.is_mass_matrix:
        log.report(
            "E0701",
            "the DAE of a model with equations of its own is not supported yet",
            model.span,
            help="`simulate` and the FMU run it; 'frot check --emit equations' shows it",
        )
        return None
    return _assemble(lowered)


def _assemble(lowered: Lowered) -> Dae:
    from frot.dsl import default_values, evaluate

    reduced = lowered.reduced
    s, contacts = reduced.symbols, reduced.mechanism.contacts
    flags = column(reduced.conditions.flags)
    contact_modes = ca.SX.sym("m", 4 * len(contacts))
    mode = ca.vertcat(contact_modes, flags, s.sides)
    x, z = ca.vertcat(s.q, s.v), ca.vertcat(s.a, s.lam)
    arguments = [s.t, x, z, s.u, s.p, mode]
    names = ["t", "x", "z", "u", "p", "mode"]
    auxiliary = ca.SX.zeros(s.sw.shape)
    balance = reduced.mass @ ca.vertcat(s.a, auxiliary) - reduced.force - reduced.rows.T @ s.lam
    alg = ca.vertcat(balance, *_laws(reduced, contact_modes))
    values = default_values(reduced.mechanism.model, {})
    guards = ca.vertcat(*_guards(reduced, contact_modes))
    q_names, v_names = ([x.name() for x in scalars_of(part)] for part in (s.q, s.v))
    row_names = [
        n for c, r in zip(contacts, reduced.contact_rows, strict=True) for n in _row_names(c, r)
    ]
    return Dae(
        names=Names(
            x=(*q_names, *v_names),
            z=(*(f"der({n})" for n in v_names), *row_names),
            u=tuple(i.name for i in s.inputs),
            p=tuple(p.name for p in s.parameters),
            mode=(
                *(
                    f"{c.liaison.name}.{part}"
                    for c in contacts
                    for part in ("closed", "reaction_sign", "friction", "rolling")
                ),
                *(f"condition_{k + 1}" for k in range(len(reduced.conditions.flags))),
                *(f"{c.liaison.name}.side" for c in contacts),
            ),
            guards=(
                *(
                    f"{c.liaison.name}.{part}"
                    for c in contacts
                    for part in ("normal", "friction_1", "friction_2", "rolling_1", "rolling_2")
                ),
                *(f"condition_{k + 1}" for k in range(len(reduced.conditions.flags))),
            ),
        ),
        ode=ca.Function("ode", arguments, [ca.vertcat(s.rates, s.a)], names, ["ode"]),
        alg=ca.Function("alg", arguments, [alg], names, ["alg"]),
        guards=ca.Function("guards", arguments, [guards], names, ["guards"]),
        solve=_solve(alg, z, [s.t, x, s.u, s.p, mode], any(_bounds_couple(c) for c in contacts)),
        reset=ca.Function("reset", arguments, [_reset(reduced, contact_modes)], names, ["x_after"]),
        u0=_column(as_number(evaluate(i.start, values)) for i in s.inputs),
        p0=_column(as_number(evaluate(p.value, values)) for p in s.parameters),
    )


def _row_names(link: Link, rows: Rows) -> tuple[str, ...]:
    name = link.liaison.name
    if not isinstance(link, Contact):
        couple = (f"{name}.torque",) if rows.tangent >= 0 else ()
        ways = [
            lock.axis
            for lock in (link.locks if isinstance(link, Joint) else ())
            if isinstance(lock, Way)
        ]
        if len(ways) == len(rows.reaction):
            return (*(f"{name}.force.{'xyz'[k]}" for k in ways), *couple)
        return (*(f"{name}.reaction[{k + 1}]" for k in range(len(rows.reaction))), *couple)
    return (
        f"{name}.normal_force",
        *([f"{name}.tangential_force"] if rows.tangent >= 0 else []),
        *([f"{name}.rolling_couple"] if rows.rolling >= 0 else []),
    )


def _bounds_couple(link: Link) -> bool:
    """Whether the friction follows the norm of two components, which is not linear in them."""
    return isinstance(link, Joint) and link.mu is not None


def _solve(alg: ca.SX, z: ca.SX, known: list[ca.SX], curved: bool) -> ca.Function:
    """Gives z: one linear solve, or Newton's method from no reactions where `curved`."""
    names = (["t", "x", "u", "p", "mode"], ["z"])
    slope = ca.jacobian(alg, z)
    if not curved:
        constant = ca.substitute(alg, z, ca.SX.zeros(z.shape))
        solved = -ca.solve(slope, constant) if z.numel() else ca.SX.zeros(0)
        return ca.Function("solve", known, [solved], *names)
    step = ca.Function("newton_step", [z, *known], [z - ca.solve(slope, alg)])
    arguments = [ca.MX.sym(n, *x.shape) for n, x in zip(names[0], known, strict=True)]
    reached = ca.MX.zeros(z.shape)
    for _ in range(NEWTON_STEPS):
        reached = step(reached, *arguments)
    return ca.Function("solve", arguments, [reached], *names)


def _normal(reduced: Reduced, link: Link, rows: Rows, side: ca.SX) -> ca.SX:
    """The normal reaction that bounds friction: not negative; of a pin, the size of its reaction.

    Its slope is zero where a pin carries nothing, so that Newton's method can start there.
    """
    lam = reduced.symbols.lam
    if not isinstance(link, Joint):
        return side * lam[rows.reaction[0]]
    square = sum((lam[r] ** 2 for r in rows.reaction), ca.SX(0))
    return ca.if_else(square > 0, ca.sqrt(ca.if_else(square > 0, square, 1)), 0)


def _column(numbers: Iterable[float]) -> ca.DM:
    return ca.DM(np.array(list(numbers)))


def _laws(reduced: Reduced, modes: ca.SX) -> list[ca.SX]:
    """One equation a row that is not balanced by an auxiliary speed, and one for each of these."""
    s = reduced.symbols
    accelerations = (
        reduced.rows @ ca.vertcat(s.a, ca.SX.zeros(s.sw.shape)) + reduced.bias
        if s.lam.numel()
        else ca.SX.zeros(0)
    )
    equations: list[ca.SX] = []
    for i, (contact, rows) in enumerate(
        zip(reduced.mechanism.contacts, reduced.contact_rows, strict=True)
    ):
        mode = modes[4 * i : 4 * i + 4]
        closed, normal = mode[CLOSED], _normal(reduced, contact, rows, mode[SIDE])
        if not contact.reduced:
            lam_n = s.lam[rows.reaction[0]]
            equations.append(ca.if_else(closed, accelerations[rows.reaction[0]], lam_n))
        for row, kind in ((rows.tangent, mode[FRICTION]), (rows.rolling, mode[ROLLING])):
            if row < 0:
                continue
            coefficient = _coefficient(reduced, row, at_rest=False)
            sign = ca.if_else(kind == FORWARD, 1, 0) - ca.if_else(kind == BACKWARD, 1, 0)
            follows = s.lam[row] + sign * coefficient * normal
            held = ca.if_else(kind == STICK, accelerations[row], follows)
            equations.append(ca.if_else(closed, held, s.lam[row]))
    return equations


def _coefficient(reduced: Reduced, row: int, *, at_rest: bool) -> ca.SX:
    """The coefficient of the law whose motion is this row."""
    laws = [r for x in reduced.contact_rows for r in (x.tangent, x.rolling) if r >= 0]
    return reduced.coefficients[2 * laws.index(row) + at_rest]


def _guards(reduced: Reduced, modes: ca.SX) -> list[ca.SX]:
    s = reduced.symbols
    guards: list[ca.SX] = []
    for i, (contact, rows) in enumerate(
        zip(reduced.mechanism.contacts, reduced.contact_rows, strict=True)
    ):
        mode = modes[4 * i : 4 * i + 4]
        normal = _normal(reduced, contact, rows, mode[SIDE])
        gap = ca.SX(1) if contact.reduced else reduced.gap[i]
        guard = ca.if_else(mode[CLOSED], normal, gap)
        guards.append(ca.SX(1) if isinstance(contact, Joint) else guard)
        for row, kind in ((rows.tangent, mode[FRICTION]), (rows.rolling, mode[ROLLING])):
            if row < 0:
                guards += [ca.SX(1), ca.SX(1)]
                continue
            coefficient = _coefficient(reduced, row, at_rest=True)
            bound, lam, rate = coefficient * normal, s.lam[row], reduced.rate[row]
            slips = mode[CLOSED] * ((kind == FORWARD) + (kind == BACKWARD))
            stuck = mode[CLOSED] * (kind == STICK)
            along = ca.if_else(kind == FORWARD, rate, -rate)
            guards.append(ca.if_else(stuck, bound - lam, ca.if_else(slips, along, 1)))
            guards.append(ca.if_else(stuck, bound + lam, 1))
    for flag, value in zip(reduced.conditions.flags, reduced.conditions.values, strict=True):
        guards.append(ca.if_else(flag, value, -value))
    return guards


def _reset(reduced: Reduced, modes: ca.SX) -> ca.SX:
    """Speeds with J v = 0 on the rows that hold: v - M^-1 J' (J M^-1 J' + I - D)^-1 D J v.

    D has a one for each row that holds; other rows of J are replaced by zero.
    """
    s = reduced.symbols
    nv, nr = s.v.numel(), s.lam.numel()
    if nr == 0:
        return ca.vertcat(s.q, s.v)
    holds = ca.SX.zeros(nr)
    for i, (contact, rows) in enumerate(
        zip(reduced.mechanism.contacts, reduced.contact_rows, strict=True)
    ):
        mode = modes[4 * i : 4 * i + 4]
        if not contact.reduced:
            holds[rows.reaction[0]] = mode[CLOSED]
        for row, kind in ((rows.tangent, mode[FRICTION]), (rows.rolling, mode[ROLLING])):
            if row >= 0:
                holds[row] = mode[CLOSED] * (kind == STICK)
    active = ca.diag(holds) @ reduced.rows[:, :nv]
    mass = reduced.mass[:nv, :nv]
    spread = ca.solve(mass, active.T)
    system = active @ spread + ca.diag(1 - holds)
    return ca.vertcat(s.q, s.v - spread @ ca.solve(system, active @ s.v))
