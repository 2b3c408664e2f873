"""Conditions, blocks and events as the kernel takes them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import casadi as ca
from frot.compiler.equations.assembled import Assembled, Block
from frot.compiler.lowering.lower_events import Ranks, lower_update, rank_whens
from frot.compiler.lowering.nonfinite import Watched, watch_numbers
from frot.compiler.lowering.sort_conditions import SortedConditions
from frot.compiler.lowering.state import clean, state_arguments
from frot.compiler.lowering.switching import straighten, switching_residual
from frot.compiler.symbolic.numbers_in_sums import size_of_numbers
from frot.dsl import Log


@dataclass(frozen=True, slots=True, eq=False)
class Switches:
    """The values of all conditions, and what follows from them.

    `timers`: see `SortedConditions`. `blocks` are the functions of the blocks of equations,
    `switching` those with the conditions on their own unknowns as they are, if there are any.
    `watched` are numbers that must stay finite, of the equations `sources`. `update`: what events
    do, None without any; `ranks`: the order of the `when`s.
    """

    conditions: ca.SX
    timers: list[ca.SX]
    blocks: tuple[ca.Function, ...]
    switching: tuple[ca.Function | None, ...]
    watched: ca.SX
    sources: tuple[Watched, ...]
    update: list[ca.SX] | None
    ranks: Ranks


def lower_switches(
    system: Assembled, found: SortedConditions, log: Log
) -> tuple[Assembled, Switches]:
    """The switches of a system whose conditions are sorted; it may gain outcomes of events."""
    switching = tuple(_switching(k, b, system, found.values) for k, b in enumerate(system.blocks))
    conditions = straighten(system, found.values)
    watched, sources = watch_numbers(system)
    system, update = lower_update(system, log)
    return system, Switches(
        conditions=conditions,
        timers=found.timers,
        blocks=tuple(_block(f"block_{k}", b, system) for k, b in enumerate(system.blocks)),
        switching=switching,
        watched=watched,
        sources=tuple(sources),
        update=update,
        ranks=rank_whens(system, conditions, update),
    )


def _block(name: str, block: Block, system: Assembled) -> ca.Function:
    """Residual, its Jacobian in the block's own unknowns, the size of its terms."""
    own = system.y[block.first : block.first + block.residual.numel()]
    slope = ca.jacobian(block.residual, own)
    size = block.size
    if size is None:
        size = ca.fabs(slope) @ ca.fabs(own) + ca.fabs(block.residual)
        size += size_of_numbers(block.residual, own)
    arguments = state_arguments(system)
    if block.late:
        arguments += [system.z, system.lam]
    return ca.Function(f"frot_{name}", arguments, clean([block.residual, slope, size]))


def _switching(
    index: int, block: Block, system: Assembled, conditions: ca.SX
) -> ca.Function | None:
    """The same where the conditions on the block's own unknowns are as they are."""
    residual = switching_residual(block, system, conditions)
    if residual is None:
        return None
    return _block(f"switching_{index}", replace(block, residual=residual), system)
