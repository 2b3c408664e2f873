"""Reduced mechanism and equations of the text to the one system that the kernel solves."""

from __future__ import annotations

import casadi as ca
from frot.compiler.equations.chains import Resolver
from frot.compiler.equations.solve_equations import solve_equations
from frot.compiler.lowering.assembled import (
    Assembled,
    Invariants,
    Solution,
    followed_blocks,
)
from frot.compiler.lowering.held_slips import with_held_slips
from frot.compiler.mechanics.reduce import Reduced
from frot.compiler.symbolic.columns import scalars_of
from frot.dsl import Log


def assemble(reduced: Reduced, log: Log) -> Assembled | None:
    """The kernel's system; what cannot be solved is reported."""
    system = _plain(reduced) if reduced.plain else solve_equations(reduced, log)
    return system if system is None else with_held_slips(system)


def _plain(reduced: Reduced) -> Assembled:
    """A mechanism alone: its mass matrix is the core."""
    s = reduced.symbols
    na = s.sw.numel()
    nothing = ca.SX.zeros(0)
    y, blocks = followed_blocks(reduced)
    return Assembled(
        reduced=reduced,
        elements=(),
        q=s.q,
        v=s.v,
        y=y,
        z=ca.vertcat(s.a, ca.SX.sym("auxiliary", na)),
        lam=s.lam,
        discrete=nothing,
        names=tuple(x.name() for x in (*scalars_of(s.q), *scalars_of(s.v))),
        q_speed=s.q_speed,
        na=na,
        nc=0,
        late=False,
        rates=s.rates,
        matrix=reduced.mass,
        force=reduced.force,
        force_size=reduced.force_size,
        spread=reduced.rows.T,
        metric=reduced.mass,
        rows=reduced.rows,
        bias=reduced.bias,
        rate=reduced.rate,
        gap=reduced.gap,
        coefficients=reduced.coefficients,
        power=reduced.power,
        blocks=blocks,
        invariants=Invariants(nothing, ()),
        pivots=(),
        divisors=(),
        solution=Solution(reduced.text.chains, Resolver(), {}),
        tree=reduced.tree,
    )
