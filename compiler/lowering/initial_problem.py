"""The initial problem: the statements of `initial`, and what translated them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import casadi as ca
from frot.compiler.equations.assembled import Assembled
from frot.compiler.lowering.explicit_reactions import make_explicit
from frot.compiler.lowering.initial_values import Initial, lower_initial
from frot.compiler.translate.expressions import Lowering
from frot.dsl import Log


@dataclass(frozen=True, slots=True, eq=False)
class InitialProblem:
    """The statements of `initial`, and what lowered them.

    `display` translates what locates no events, `explicit` writes out the formulas of unknowns.
    """

    display: Lowering
    explicit: Callable[[ca.SX], ca.SX]
    initial: Initial


def pose_initial_problem(system: Assembled, log: Log) -> InitialProblem:
    """Translate the statements of `initial`; those that contradict each other are reported."""
    reduced, explicit = system.reduced, make_explicit(system)
    chains, without_auxiliary = reduced.text.chains, reduced.variables.without_auxiliary

    def formula(value: ca.SX) -> ca.SX:
        return explicit(system.resolve(without_auxiliary(value)))

    display = Lowering(
        reduced.symbols,
        reduced.variables.quantity,
        lambda value: chains.rate(formula(value)),
        log,
        variable=reduced.text.values.__getitem__,
        without_rate=lambda value: chains.without_rate(formula(value)),
    )
    return InitialProblem(display, explicit, lower_initial(system, display, explicit, log))
