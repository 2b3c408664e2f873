"""The CasADi DAE of a model with its switching, for other integrators and optimal control."""

from __future__ import annotations

import ctypes as ct
from collections.abc import Callable, Iterable

import casadi as ca
import numpy as np
from frot.compiler.lowering.lower import Lowered
from frot.compiler.product.dae_events import After, first_mode, happen
from frot.compiler.product.dae_functions import DaeFunctions
from frot.compiler.product.dae_impacts import effects_of, impacts_of
from frot.compiler.product.dae_instant import Instant, Vector
from frot.compiler.product.dae_names import names_of
from frot.compiler.product.dae_solve import gives_of, make_reset, make_solve, may_depend
from frot.compiler.product.dae_switching import (
    guards_of,
    laws_of,
    reads_of_closed,
    reset_of,
    switches_of,
)
from frot.compiler.symbolic.columns import column, scalars_of
from frot.compiler.translate.walk import as_number
from frot.dsl import default_values, evaluate

# Speed below which an event takes a motion for rest, m/s or rad/s.
SLOW = 1e-9


class Dae(DaeFunctions):
    """The DAE of a model, and what happens at its events; its functions are `DaeFunctions`."""

    __slots__ = ()

    def event(
        self,
        t: float,
        x: object,
        u: object,
        p: object,
        mode: object,
        fired: Iterable[str] = (),
        *,
        slow: float = SLOW,
    ) -> After:
        """The state after an event at which the guards `fired`, by their names, are zero.

        Conditions change and their `when`s act, percussions strike, contacts that close meet by
        Darboux's and Keller's law, and the modes follow. Speeds below `slow` (m/s, rad/s) are zero:
        what closes with less gives nothing back, so that infinitely many impacts end.

        Raises:
            FrotError: Bad numbers or an unknown guard (E0806); no impulses (E0905), no mode
                (E0902), a singular system (E0701), conditions without end (E0903).
        """
        return happen(Instant(self, t, x, u, p, mode, slow), fired)

    def first_mode(
        self,
        t: float,
        x: object,
        u: object,
        p: object,
        closed: Iterable[str] = (),
        *,
        slow: float = SLOW,
    ) -> Vector:
        """The mode of a motion that begins at x; `closed` names the contacts that touch.

        Contacts are on the side on which their figures are; on the outer one, if that is not known.

        Raises:
            FrotError: As `event`.
        """
        at = Instant(self, t, x, u, p, np.zeros(len(self.names.mode)), slow)
        return first_mode(at, np.array(self.values0).ravel(), closed)


def _start(lowered: Lowered, state: list[ca.SX]) -> tuple[ca.SX, ca.SX, ca.SX, ca.SX]:
    """Where the search for q, v and y begins, and what only events change.

    The conditions are taken not to hold.
    """
    t, _, _, u, p, d, y = state
    q, discrete = lowered.whole.functions["start"].call([t, u, p])
    known = ca.vertcat(ca.SX.zeros(d.numel() - discrete.numel()), discrete)
    speeds = ca.SX.zeros(lowered.system.v.shape)
    v, guess, _ = lowered.whole.functions["beginning"].call(
        [t, q, speeds, u, p, known, ca.SX.zeros(y.shape)]
    )
    return q, v, guess, discrete


def dae_of(lowered: Lowered, kernel: Callable[[], ct.CDLL]) -> Dae:
    """The DAE of a model's functions; `kernel` gives the library with its impact law."""
    system = lowered.system
    reduced, s = system.reduced, system.reduced.symbols
    switches = switches_of(system)
    flags = column(reduced.conditions.flags)
    contacts = [link.opens for link in reduced.mechanism.contacts]
    sides = [x for x, one in zip(scalars_of(s.sides), contacts, strict=True) if one]
    read = reads_of_closed(system, switches)

    def kept(values: ca.SX) -> ca.SX:
        """Of the discrete values those that are places of the mode."""
        return column(x for k, x in enumerate(scalars_of(values)) if k not in read)

    memory = kept(system.discrete)
    mode = ca.vertcat(*(w.mode for w in switches if w.ruled), flags, *sides, memory)
    nv, na, solved = system.nv, system.na, scalars_of(system.z)
    auxiliary, core = column(solved[nv : nv + na]), column([*solved[:nv], *solved[nv + na :]])
    x, z = ca.vertcat(system.q, system.v), ca.vertcat(core, system.lam, system.y)
    # what is no contact has a place among the sides, but none
    sideless = ca.SX.zeros(len(system.elements))
    d = ca.vertcat(flags, s.sides, sideless, system.discrete)
    state = [s.t, system.q, system.v, s.u, s.p, d, system.y]
    conditions = lowered.switches.conditions
    q, v, guess, discrete = _start(lowered, state)
    values = default_values(reduced.mechanism.model, {})
    places = {"t": s.t, "x": x, "z": z, "u": s.u, "p": s.p, "mode": mode}

    nowhere = ca.vertcat(
        auxiliary,
        *(x for x, one in zip(scalars_of(s.sides), contacts, strict=True) if not one),
        *(system.discrete[k] for k in read),
    )
    settled = ca.vertcat(
        ca.SX.zeros(auxiliary.shape), ca.SX.ones(len(contacts) - len(sides)), *read.values()
    )

    def at_places(value: ca.SX) -> ca.SX:
        """A value with what is no place of the DAE put in."""
        return _put(value, nowhere, settled)

    def function(
        name: str,
        *results: tuple[str, ca.SX],
        without: str = "",
        also: tuple[str, ca.SX] | None = None,
    ) -> ca.Function:
        """A function of all `places` but one and of `also`, auxiliary accelerations at zero.

        What touches and cannot part is on the outer side.
        """
        taken = {k: symbols for k, symbols in places.items() if k != without}
        taken |= dict([also] if also else [])
        return ca.Function(
            name,
            list(taken.values()),
            [at_places(value) for _, value in results],
            list(taken),
            [k for k, _ in results],
        )

    effects = effects_of(system)
    least = may_depend(system, switches, effects[1])
    inertias, gives, softer = gives_of(system, switches, least)
    matrix, force = system.in_full()
    balance = matrix @ system.z - force - system.matrices.spread @ system.lam
    blocks = [block.residual for block in system.blocks]
    equations, rigid, soft = (
        at_places(ca.vertcat(balance, *laws_of(system, switches, *own), *blocks))
        for own in ((), (inertias,), (inertias, gives))
    )
    update = None
    if "update" in lowered.whole.functions:
        fired = ca.SX.sym("fired", len(reduced.events.fired))
        after = lowered.whole.functions["update"].call(
            [*state, system.z, system.lam, fired, system.discrete]
        )
        update = function(
            "update",
            ("x_after", ca.vertcat(after[0], after[1])),
            ("values", kept(after[2])),
            ("outcomes", after[3]),
            also=("fired", fired),
        )
    first = ca.vertcat(ca.SX.zeros(core.numel() + system.lam.numel()), guess)
    parts = [at_places(part) for part in reset_of(system, switches, inertias, gives)]
    names = names_of(system, switches)
    labels = tuple(label for w in switches for label in w.labels)
    u0 = _column(as_number(evaluate(i.start, values)) for i in s.inputs)
    p0 = _column(as_number(evaluate(k.value, values)) for k in s.parameters)
    return Dae(
        names=names,
        ode=function("ode", ("ode", ca.vertcat(system.rates, *solved[:nv]))),
        alg=function("alg", ("alg", equations)),
        guards=function("guards", ("guards", column(guards_of(system, switches, conditions)))),
        solve=make_solve(rigid, soft, places, first, softer, least=least),
        invariants=function("invariants", ("values", system.invariants.values), without="z"),
        start=ca.Function("start", [s.t, s.u, s.p], [ca.vertcat(q, v)], ["t", "u", "p"], ["x"]),
        reset=make_reset(x, parts, places, softer, least=least),
        update=update,
        impacts=impacts_of(lowered, effects, names.mode, labels, function),
        values0=ca.Function("values0", [s.t, s.u, s.p], [kept(discrete)])(0, u0, p0),
        u0=u0,
        p0=p0,
        kernel=kernel,
    )


def _put(value: ca.SX, symbols: ca.SX, numbers: ca.SX) -> ca.SX:
    return ca.substitute(value, symbols, numbers) if symbols.numel() and value.numel() else value


def _column(numbers: Iterable[float]) -> ca.DM:
    return ca.DM(np.array(list(numbers)))
