"""Derivatives of the equations of motion along the motion, for the search order by order.

With a' = da/dt and so on, the k-th total derivative of

    A z - E lam - h = 0,    acceleration of rows = J z + c,    coefficients of friction

is linear in the highest derivatives of z and lam. It is given here without them: what is left is
the right side of the contact problem of order k (runtime/kernel/motion_search/motion_problem.h).
"""

from __future__ import annotations

import casadi as ca
from frot.compiler.equations.assembled import Assembled
from frot.compiler.lowering.jacobian import has_motion, slips_in_space
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.compiler.symbolic.columns import column

# Orders that are given.
HIGHEST = 3
# Unknowns of blocks whose derivatives are written out, and operations of the values, at most: of
# the list of motions, and of every run, whose program is to stay small.
MOST_UNKNOWNS = 6
MOST_OPERATIONS = 20_000
MOST_IN_RUNS = 1_500


def make_orders(
    system: Assembled, state: list[ca.SX], most: int
) -> tuple[str, list[ca.SX], list[ca.SX]] | None:
    """The function `orders` of the kernel's contract, or None where no orders are known.

    `most`: operations of the values, at most.

    Arguments: `state` (t, q, v, u, p, d, y), then z and lam and their derivatives up to the order
    HIGHEST - 1. Results: for each order from 1 the residual (nw), the accelerations of the rows
    (n_rows) and the coefficients (2 x elements), without the highest z and lam.
    """
    if not has_motion(system) or system.late or slips_in_space(system):
        return None
    links = system.reduced.mechanism.contacts
    if not system.elements and not any(x.frictions or is_unilateral(x.liaison) for x in links):
        return None
    if system.early > MOST_UNKNOWNS:
        return None
    matrix, force = system.in_full()
    own = system.matrices
    values = ca.vertcat(
        matrix @ system.z - own.spread @ system.lam - force,
        own.rows @ system.z + own.bias,
        own.coefficients,
    )
    if ca.Function("f", [*state, system.z, system.lam], [values]).n_instructions() > most:
        return None
    z, lam = [system.z], [system.lam]
    for k in range(1, HIGHEST + 1):
        z.append(ca.SX.sym(f"z{k}", system.z.shape))
        lam.append(ca.SX.sym(f"lam{k}", system.lam.shape))
    t, q, v, y = state[0], system.q, system.v, system.y[: system.early, :]
    moved = [system.rates, system.z[: system.nv, :], ca.SX(1)]
    y_rate = _rate_of_places(system, ca.vertcat(q, v, t), ca.vertcat(*moved))
    results = []
    for k in range(1, HIGHEST + 1):
        symbols = ca.vertcat(q, v, t, y, *z[:k], *lam[:k])
        rates = ca.vertcat(*moved, y_rate, *z[1 : k + 1], *lam[1 : k + 1])
        values = ca.jtimes(values, symbols, rates)
        highest = ca.vertcat(z[k], lam[k])
        results.append(ca.substitute(values, highest, ca.SX.zeros(highest.shape)))
    arguments = [*state]
    for k in range(HIGHEST):
        arguments += [z[k], lam[k]]
    return "orders", arguments, results


def _rate_of_places(system: Assembled, states: ca.SX, rates: ca.SX) -> ca.SX:
    """Derivatives of the unknowns of the early blocks r = 0 along the motion."""
    y = system.y[: system.early, :]
    if not y.numel():
        return ca.SX.zeros(0)
    residual = column(b.residual for b in system.blocks if not b.late)
    return -ca.solve(ca.densify(ca.jacobian(residual, y)), ca.jtimes(residual, states, rates))
