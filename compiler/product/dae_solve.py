"""Solving the DAE for accelerations and reactions where these are not unique.

Rows that depend on each other leave reactions open, and accelerations not. Rows that give a little,
a = -give lam, have one solution. With the give acting on the change of lam alone the solutions
converge, by the ratio of the give to the least effect of a row that is independent, to the rigid
one of the least sum of lam_r^2 times the give of r, W_rr where rows differ (the proximal point
method: R. Rockafellar 1976).
"""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca
import numpy as np
from frot.compiler.equations.assembled import Assembled
from frot.compiler.product.dae_switching import Switch
from frot.compiler.symbolic.columns import scalars_of
from frot.compiler.symbolic.random_tests import at_random
from frot.compiler.symbolic.sums import sizes_of_terms

# The give of a row, as a part of its effect, and of friction, which takes little of what others
# hold; multiples of both, round by round. A row that is independent by 1e-6 is solved to 1e-8. The
# first rounds are softer: rounding in reactions that nothing determines grows as 1/give.
GIVE, FRICTION_GIVE = 1e-7, 1e-4
SOFTER = (1e4, 1e4, 1e2, 1e2, 1, 1, 1, 1, 1, 1, 1, 1)
# Part of the largest effect below which rows depend on each other.
DEPENDENT = 1e-9


def may_depend(system: Assembled, switches: Sequence[Switch], effect: ca.SX) -> bool:
    """Whether rows that hold may depend on each other: those of loops, or of too many contacts."""
    if any(not w.ruled for w in switches):
        return True
    held = [r for w in switches for r in (*(w.rows.reaction if w.free else ()), *_of_laws(w))]
    if len(held) < 2:
        return False
    for drawn in at_random(effect[held, held]):
        numbers = drawn.reshape(len(held), len(held))
        own = np.sqrt(np.abs(np.diag(numbers)))
        moved = own > 0
        unit = numbers[np.ix_(moved, moved)] / np.outer(own[moved], own[moved])
        if unit.size and np.linalg.matrix_rank(unit, tol=DEPENDENT) < len(unit):
            return True
    return False


def _of_laws(switch: Switch) -> tuple[int, ...]:
    return (*switch.rows.tangent, *switch.rows.rolling)


def _springs_of(switch: Switch) -> tuple[int, ...]:
    return tuple(switch.rows.reaction) if switch.free and switch.gap is not None else ()


def gives_of(
    system: Assembled, switches: Sequence[Switch], least: bool
) -> tuple[list[ca.SX], list[ca.SX], ca.SX]:
    """Of each row an inertia, and its give as a part of 1/inertia; one and zero, if unique.

    Gives are multiples of the last, a symbol.

    The inertia follows from the sizes of the terms of the row, which do not cancel: what others
    keep as well may move by no impulse of its own. Contacts that can part give alike, so that
    friction of motion reads the reactions of equal springs, as in a run.
    """
    count, nv = system.lam.numel(), system.nv
    if not least:
        return [ca.SX(1)] * count, [ca.SX(0)] * count, ca.SX.sym("softer")
    rubs = {row for w in switches for row in _of_laws(w)}
    entries = ca.vec(ca.densify(system.matrices.rows[:, :nv]))
    sizes = ca.fmax(ca.fabs(entries), sizes_of_terms(entries))
    own = ca.fabs(ca.diag(system.in_full()[0])[:nv])
    moves = (ca.reshape(sizes, count, nv) ** 2) @ ca.if_else(own > 0, 1 / own, 0)
    inertias = [ca.if_else(w > 0, 1 / w, 1) for w in scalars_of(moves)]
    springs = [r for w in switches for r in _springs_of(w)]
    if springs:
        logs = ca.vertcat(*(ca.log(inertias[r]) for r in springs))
        alike = ca.exp(ca.sum1(logs) / len(springs))
        inertias = [alike if r in springs else own for r, own in enumerate(inertias)]
    softer = ca.SX.sym("softer")
    gives = [softer * (FRICTION_GIVE if r in rubs else GIVE) for r in range(count)]
    return inertias, gives, softer


def make_solve(
    alg: ca.SX,
    soft: ca.SX,
    places: dict[str, ca.SX],
    first: ca.SX,
    softer: ca.SX,
    *,
    least: bool,
) -> ca.Function:
    """(t, x, u, p, mode) -> z with `alg` zero; `soft` are the same equations with gives.

    Gives are multiples of `softer`. One linear solve where `alg` is linear in z; else Newton's
    method from `first`. `least`: rounds of the one or the other with the slope of `soft`.
    """
    z = places["z"]
    names = [k for k in places if k != "z"]
    known = [places[k] for k in names]
    slope = ca.jacobian(soft, z)
    linear = not (z.numel() and ca.depends_on(slope, z))
    if linear and not least:
        constant = ca.substitute(alg, z, ca.SX.zeros(z.shape)) if z.numel() else alg
        solved = -ca.solve(slope, constant) if z.numel() else ca.SX.zeros(0)
        return ca.Function("solve", known, [solved], names, ["z"])
    begin = ca.Function("begin", known, [ca.SX.zeros(z.shape) if linear else first])
    step = ca.Function("newton_step", [z, *known, softer], [z - ca.solve(slope, alg)])
    return _repeated("solve", begin, step, names, known, "z")


def make_reset(
    x: ca.SX,
    parts: Sequence[ca.SX],
    places: dict[str, ca.SX],
    softer: ca.SX,
    *,
    least: bool,
) -> ca.Function:
    """(t, x, z, u, p, mode) -> x_after by the `parts` of `reset_of`."""
    matrix, soft, right, spread = parts
    names, known = list(places), list(places.values())
    still = ca.SX.zeros(x.numel() - spread.size1())
    if right.numel() == 0:
        return ca.Function("reset", known, [x], names, ["x_after"])
    if not least:
        moved = x + ca.vertcat(still, spread @ ca.solve(matrix, right))
        return ca.Function("reset", known, [moved], names, ["x_after"])
    impulse = ca.SX.sym("impulse", right.numel())
    begin = ca.Function("begin", known, [ca.SX.zeros(right.shape)])
    better = impulse + ca.solve(soft, right - matrix @ impulse)
    step = ca.Function("reset_step", [impulse, *known, softer], [better])
    impulses = _repeated("impulses", begin, step, names, known, "impulse")
    act = ca.Function("act", [impulse, *known], [x + ca.vertcat(still, spread @ impulse)])
    arguments = [ca.MX.sym(n, *k.shape) for n, k in zip(names, known, strict=True)]
    after = act(impulses(*arguments), *arguments)
    return ca.Function("reset", arguments, [after], names, ["x_after"])


def _repeated(
    name: str,
    begin: ca.Function,
    step: ca.Function,
    names: list[str],
    known: list[ca.SX],
    result: str,
) -> ca.Function:
    arguments = [ca.MX.sym(n, *k.shape) for n, k in zip(names, known, strict=True)]
    reached = begin(*arguments)
    for softer in SOFTER:
        reached = step(reached, *arguments, softer)
    return ca.Function(name, arguments, [reached], names, [result])
