"""Conditions on unknowns that blocks of equations solve for.

In a step a condition holds as it did at its start, and the solution continues smoothly to where an
event is located. In `x*abs(x) = 1 - t` there is none beyond x = 0, where x passes as a root: then
the block is solved with such conditions as its own unknowns say.
"""

from __future__ import annotations

import casadi as ca
from frot.compiler.equations.assembled import Assembled, Block
from frot.compiler.symbolic.columns import column, scalars_of
from frot.compiler.translate.derivative_chains import replace_known

# Above this a slope is none.
_LARGEST = 1e100


def switching_residual(block: Block, system: Assembled, values: ca.SX) -> ca.SX | None:
    """The residual of a block where conditions, which have these values, are as they are.

    None where it reads none on its own unknowns. Those that follow from what is solved after the
    block stay.
    """
    if block.linear:
        return None
    conditions, own = system.reduced.conditions, _own(block, system)
    later = ca.vertcat(system.z, system.lam, system.y[block.first + own.numel() :, :])
    known: dict[int, ca.SX] = {}
    for flag, value, strict in zip(
        conditions.flags, scalars_of(values), conditions.strict, strict=True
    ):
        unsolved = later.numel() and ca.depends_on(value, later)
        if ca.depends_on(value, own) and not unsolved:
            known[flag.element_hash()] = value > 0 if strict else value >= 0

    def reads(residual: ca.SX) -> bool:
        return any(x.element_hash() in known for x in ca.symvar(residual))

    residual = block.residual
    if not reads(residual):
        return None
    for _ in known:  # conditions may read conditions
        residual = replace_known(residual, known)
    return None if reads(residual) else residual


def straighten(system: Assembled, values: ca.SX) -> ca.SX:
    """The values of the conditions, such that they pass zero with a slope.

    What a block of one unknown y solves for may come to a threshold c as a root does, where the
    slope f' of its equation on this side of it vanishes there. Times |f'(c)| + |f'(y) - f'(c)|,
    y - c is nearly f(y) - f(c).
    """
    found = scalars_of(values)
    for block in system.blocks:
        own = _own(block, system)
        if block.late or block.followed or own.numel() != 1:
            continue
        mine = [k for k, value in enumerate(found) if ca.depends_on(value, own)]
        if not mine or switching_residual(block, system, values) is None:
            continue
        slope = ca.jacobian(block.residual, own)
        for k in mine:
            factor = ca.jacobian(found[k], own)
            if ca.depends_on(factor, own):
                continue
            threshold = -ca.substitute(found[k], own, ca.SX(0)) / factor
            there = ca.substitute(slope, own, threshold)
            part = ca.fabs(there) + ca.fabs(slope - there)
            found[k] *= ca.if_else(ca.fabs(there) < _LARGEST, part, 1)
    return column(found)


def _own(block: Block, system: Assembled) -> ca.SX:
    return system.y[block.first : block.first + block.residual.numel()]
