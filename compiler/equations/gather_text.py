"""The residuals, events and conditions of a text, beside the loads that act on its mechanism."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import casadi as ca
from frot.compiler.equations.events import FAIL, MEET, Broken, Events, gather_events
from frot.compiler.equations.gather import gather
from frot.compiler.equations.read_text import Reading
from frot.compiler.equations.reduced import Reduced
from frot.compiler.equations.separable_trees import moved_by_forces
from frot.compiler.equations.structure.eliminate import Residuals
from frot.compiler.equations.text_of_motion import friction_maker, slip_accelerations
from frot.compiler.equations.text_slips import slip_modes
from frot.compiler.mechanics.dynamics import large_speeds, speeds_by_tree
from frot.compiler.mechanics.forces.force import Load
from frot.compiler.mechanics.forces.loads import applied_loads
from frot.compiler.mechanics.geometry.end_events import find_leaving
from frot.compiler.mechanics.geometry.parallel_lines import find_meetings
from frot.compiler.mechanics.make_symbols import link_rows
from frot.compiler.mechanics.mechanism import Mechanism
from frot.compiler.mechanics.reduce import (
    MotionEquations,
    Placed,
    friction_coefficients,
    reads_solution,
)
from frot.compiler.mechanics.variables import Modes, Variables
from frot.compiler.symbolic.columns import column
from frot.compiler.translate.expressions import Lowering
from frot.compiler.translate.symbols import Symbols
from frot.dsl import Log


@dataclass(frozen=True, slots=True, eq=False)
class Applied:
    """The loads on a mechanism, and the coefficients of its friction."""

    loads: list[Load]
    coefficients: ca.SX


@dataclass(frozen=True, slots=True, eq=False)
class Gathered:
    """The equations and events of a text, and all the modes that they follow."""

    equations: Residuals
    events: Events
    modes: Modes


def apply_loads(placed: Placed, reading: Reading, log: Log) -> Applied:
    """The forces, laws and coefficients that the text gives."""
    loads = applied_loads(placed.mechanism, reading.variables, reading.motion, reading.frictions)
    return Applied(loads, friction_coefficients(placed, reading.motion, log))


def gather_text(placed: Placed, reading: Reading, log: Log) -> Gathered | None:
    """Translate the equations of the text, then its `when`s and `assert`s; faults are reported."""
    model, text, motion = placed.mechanism.model, reading.text, reading.motion
    with_friction = replace(motion, friction=friction_maker(text))
    equations = gather(model.equations, with_friction, log)
    equations = slip_accelerations(equations, text)
    modes = slip_modes(reading.variables.modes, text, len(placed.mechanism.contacts))
    events = gather_events(
        model,
        text,
        [symbol for _, symbol in modes.of.values()],
        placed.conditions,
        _faults(reading.variables, motion),
        reading.variables.strikes,
        motion=motion,
        display=reading.display,
        log=log,
    )
    return None if log.failed or events is None else Gathered(equations, events, modes)


def has_text(placed: Placed, reading: Reading) -> bool:
    """Whether the text adds variables, equations or values that events change."""
    model, text = placed.mechanism.model, reading.text
    return bool(model.variables or model.equations or text.discrete or text.held)


def is_plain(placed: Placed, reading: Reading, applied: Applied) -> bool:
    """Whether the text adds nothing to the equations of motion."""
    forces = _forces(applied)
    return not has_text(placed, reading) and not reads_solution(forces, placed.symbols)


def _forces(applied: Applied) -> ca.SX:
    return column(ca.vec(action.force) for x in applied.loads for action in x.actions)


def large_trees(
    placed: Placed, reading: Reading, applied: Applied, gathered: Gathered
) -> frozenset[int]:
    """The speeds of large trees of bodies that the text moves by forces alone."""
    nodes = placed.kinematics.nodes
    large = large_speeds(nodes, placed.symbols.v.numel())
    if not large or is_plain(placed, reading, applied):
        return large
    return moved_by_forces(
        speeds_by_tree(nodes),
        large,
        _forces(applied),
        gathered.equations,
        reading.text,
        placed.symbols,
    )


def make_reduced(
    placed: Placed,
    reading: Reading,
    applied: Applied,
    gathered: Gathered,
    motion: MotionEquations,
) -> Reduced:
    """All of these as one value, auxiliary speeds at zero; nothing changes it later."""
    without_auxiliary, mechanism = reading.variables.without_auxiliary, placed.mechanism
    variables = replace(reading.variables, modes=gathered.modes, frictions=dict(reading.frictions))
    equations = gathered.equations
    return Reduced(
        mechanism=mechanism,
        symbols=_with_counters(placed.symbols, mechanism, variables),
        text=reading.text.finish(),
        equations=replace(equations, values=tuple(without_auxiliary(x) for x in equations.values)),
        events=gathered.events,
        contact_rows=link_rows(mechanism.contacts),
        variables=variables,
        conditions=placed.conditions.finish(
            [without_auxiliary(x) for x in placed.conditions.values]
        ),
        motion=motion,
        plain=is_plain(placed, reading, applied),
    )


def _faults(variables: Variables, motion: Lowering) -> Iterator[Broken]:
    """That what cannot part comes to the end of a curve; that lines meet without a normal."""
    for one in find_leaving(variables):
        kept = ca.SX(1) if one.parts is None else 1 - motion.lower(one.parts)
        value = variables.without_auxiliary(one.value)
        yield Broken(FAIL, ca.if_else(kept, value, -1), one.text, one.liaison.span)
    for liaison, met in find_meetings(variables):
        value, *signs = (variables.without_auxiliary(x) for x in (met.value, *met.signs))
        only = None if met.only is None else variables.without_auxiliary(met.only)
        yield Broken(MEET, value, met.text, liaison.span, tuple(signs), only)


def _with_counters(symbols: Symbols, mechanism: Mechanism, variables: Variables) -> Symbols:
    """With the rates of the counters too."""
    if not mechanism.counters:
        return symbols
    seen = (variables.coordinate(link.liaison, k)[1] for link, k in mechanism.counters)
    return replace(symbols, rates=column((symbols.rates, *map(variables.without_auxiliary, seen))))
