"""The CasADi functions of the DAE of a model."""

from __future__ import annotations

import ctypes as ct
from collections.abc import Callable
from dataclasses import dataclass

import casadi as ca
from frot.compiler.product.dae_impacts import Impacts
from frot.compiler.product.dae_names import Names


@dataclass(frozen=True, slots=True, eq=False)
class DaeFunctions:
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
      text where it is not linear. Of reactions that are not unique, the least (`dae_solve.py`);
    * `invariants` (t, x, u, p, mode) -> 0: what equations differentiated demand of the states;
    * `start` (t, u, p) -> x: the values and guesses of `initial`, before they meet the relations;
    * `u0`, `p0`: start values of the inputs and the parameters, in SI;
    * `reset` (t, x, z, u, p, mode) -> x_after: speeds moved onto the relations of `mode`, the mode
      entered, by the least change in the metric of the mass: what a plastic impact without friction
      does;
    * `impacts`: gaps, effects of impulses, the reset by impulses, and the laws that bound them;
    * `update` (t, x, z, u, p, mode, fired) -> x_after, the values that only events change, and for
      each of `names.outcomes` whether it happens: what the `when`s do whose conditions come to
      hold. None without a `when`.

    What happens at an event is no expression: `event` solves for impulses and modes, with the
    impact law of the kernel. `values0`: what only events change, at the start; `kernel` gives its
    library.
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
    impacts: Impacts
    values0: ca.DM
    u0: ca.DM
    p0: ca.DM
    kernel: Callable[[], ct.CDLL]

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
