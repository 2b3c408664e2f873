"""The CasADi DAE of a model with its switching, for other integrators and optimal control."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import casadi as ca
import numpy as np
from frot.compiler.equations.assembled import Assembled
from frot.compiler.lowering.lower import Lowered
from frot.compiler.product.dae_switching import (
    GUARDS,
    PARTS,
    Switch,
    guards_of,
    laws_of,
    reset_of,
    switches_of,
)
from frot.compiler.symbolic.columns import column, scalars_of
from frot.compiler.translate.walk import as_number
from frot.dsl import default_values, evaluate

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
      entered, by the least change in the metric of the mass. Impacts are not in it;
    * `update` (t, x, z, u, p, mode, fired) -> x_after, the values that only events change, and for
      each of `names.outcomes` whether it happens: what the `when`s do whose conditions come to
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


def _start(lowered: Lowered, state: list[ca.SX]) -> tuple[ca.SX, ca.SX, ca.SX]:
    """Where the search for q, v and y begins, the conditions taken not to hold."""
    t, _, _, u, p, d, y = state
    q, discrete = lowered.whole.functions["start"].call([t, u, p])
    known = ca.vertcat(ca.SX.zeros(d.numel() - discrete.numel()), discrete)
    speeds = ca.SX.zeros(lowered.system.v.shape)
    v, guess, _ = lowered.whole.functions["beginning"].call(
        [t, q, speeds, u, p, known, ca.SX.zeros(y.shape)]
    )
    return q, v, guess


def dae_of(lowered: Lowered) -> Dae:
    """The DAE of a model's functions."""
    system = lowered.system
    reduced, s = system.reduced, system.reduced.symbols
    switches = switches_of(system)
    flags = column(reduced.conditions.flags)
    contacts = [link.opens for link in reduced.mechanism.contacts]
    sides = [x for x, one in zip(scalars_of(s.sides), contacts, strict=True) if one]
    mode = ca.vertcat(*(w.mode for w in switches if w.ruled), flags, *sides, system.discrete)
    nv, na, solved = system.nv, system.na, scalars_of(system.z)
    auxiliary, core = column(solved[nv : nv + na]), column([*solved[:nv], *solved[nv + na :]])
    x, z = ca.vertcat(system.q, system.v), ca.vertcat(core, system.lam, system.y)
    # what is no contact has a place among the sides, but none
    sideless = ca.SX.zeros(len(system.elements))
    d = ca.vertcat(flags, s.sides, sideless, system.discrete)
    state = [s.t, system.q, system.v, s.u, s.p, d, system.y]
    conditions = lowered.switches.conditions
    q, v, guess = _start(lowered, state)
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
    balance = matrix @ system.z - force - system.matrices.spread @ system.lam
    blocks = (block.residual for block in system.blocks)
    alg = function("alg", ("alg", ca.vertcat(balance, *laws_of(system, switches), *blocks)))
    update = None
    if "update" in lowered.whole.functions:
        fired = ca.SX.sym("fired", len(reduced.events.fired))
        places["fired"] = fired
        after = lowered.whole.functions["update"].call(
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
        guards=function("guards", ("guards", column(guards_of(system, switches, conditions)))),
        solve=_solve(alg, places, first),
        invariants=function("invariants", ("values", system.invariants.values), without="z"),
        start=ca.Function("start", [s.t, s.u, s.p], [ca.vertcat(q, v)], ["t", "u", "p"], ["x"]),
        reset=function("reset", ("x_after", reset_of(system, switches))),
        update=update,
        u0=_column(as_number(evaluate(i.start, values)) for i in s.inputs),
        p0=_column(as_number(evaluate(k.value, values)) for k in s.parameters),
    )


def _put(value: ca.SX, symbols: ca.SX, numbers: ca.SX) -> ca.SX:
    return ca.substitute(value, symbols, numbers) if symbols.numel() and value.numel() else value


def _column(numbers: Iterable[float]) -> ca.DM:
    return ca.DM(np.array(list(numbers)))


def _names(system: Assembled, switches: list[Switch]) -> Names:
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
            *(f"{link.liaison.name}.side" for link in reduced.mechanism.contacts if link.opens),
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
