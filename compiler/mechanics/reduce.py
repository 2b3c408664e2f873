"""Mechanism to its equations of motion: M a = h + J' lam with the rows of the contacts.

Auxiliary speeds along the normals of reduced liaisons (T. Kane, D. Levinson, Dynamics: Theory and
Applications, 1985, sect. 4.9) bring their reactions to light without adding a coordinate: they are
zero, and so are their accelerations, in every motion.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

import casadi as ca
from frot.compiler.mechanics.cancelling import (
    biases_without_rounding,
    rows_without_rounding,
    sizes_of_drives,
)
from frot.compiler.mechanics.constants import Constants
from frot.compiler.mechanics.constraint import Constraint
from frot.compiler.mechanics.constraint_geometry import Geometry
from frot.compiler.mechanics.dynamics import Step, heaviest_loads, write_out
from frot.compiler.mechanics.forces.force import Load
from frot.compiler.mechanics.forces.loads import sum_loads
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.make_symbols import link_rows, make_symbols
from frot.compiler.mechanics.masses import make_masses
from frot.compiler.mechanics.mechanism import Mechanism
from frot.compiler.mechanics.tree_step import place_bodies
from frot.compiler.mechanics.undetermined_spin import refuse_idle_spins
from frot.compiler.mechanics.variables import Variables
from frot.compiler.symbolic.columns import column
from frot.compiler.translate.conditions import ConditionTable
from frot.compiler.translate.expressions import Lowering
from frot.compiler.translate.symbols import Symbols
from frot.dsl import Log
from frot.dsl.catalogue.types import VELOCITY
from frot.dsl.checked import Expression

# Part by which a coefficient of rest may be below that of motion, by rounding.
_ROUNDING = 1e-12
# Operations to which two coefficients are compared symbolically.
_DEPTH = 20


@dataclass(frozen=True, slots=True, eq=False)
class Placed:
    """A mechanism in its coordinates: symbols, the kinematics, the geometry of its contacts.

    `conditions` collects the ends of figures, and later the switches of the text.
    """

    mechanism: Mechanism
    symbols: Symbols
    kinematics: Kinematics
    geometry: tuple[Geometry, ...]
    conditions: ConditionTable


@dataclass(frozen=True, slots=True, eq=False)
class SystemMatrices:
    """`matrix` z = `force` + `spread` lam, with the rows' accelerations `rows` z + `bias`.

    `force_size`: the sum of the sizes of the terms of the force; `metric` measures z; `rate` are
    the velocities of the rows, `gap` those of the contacts; `coefficients` of motion and of rest,
    of each element; `power` of the loads without potential.
    """

    matrix: ca.SX
    force: ca.SX
    force_size: ca.SX
    spread: ca.SX
    metric: ca.SX
    rows: ca.SX
    bias: ca.SX
    rate: ca.SX
    gap: ca.SX
    coefficients: ca.SX
    power: ca.SX


@dataclass(frozen=True, slots=True, eq=False)
class BodyTrees:
    """The steps of the tree, none where no tree is large; the speeds of large trees."""

    steps: tuple[Step, ...]
    large: frozenset[int]

    def in_full(self, mass: ca.SX, force: ca.SX, nv: int) -> tuple[ca.SX, ca.SX]:
        """A mass matrix and a force of `nv` speeds, then others, with those of large trees."""
        if not self.large:
            return mass, force
        others = {p for step in self.steps for p in step.node.places} - self.large
        whole = write_out(self.steps, nv, mass.size1(), frozenset(others))
        own = ca.SX(force)
        for place in self.large:
            if place < nv:
                own[place] += whole.force[place]
        return mass + whole.mass, own


@dataclass(frozen=True, slots=True, eq=False)
class MotionEquations:
    """The equations of the motion in CasADi expressions, auxiliary speeds at zero.

    `matrices` are those of the rates of all speeds, auxiliary ones last: M (nw x nw) is both matrix
    and metric, J (n_rows x nw) the rows, J' the spread. `load_sizes` of the applied forces,
    `drives` (n_rows: sizes of what drives bring to it), `witness` (3 each) and `reach` (see
    contacts.py), `tree`: the speeds of large trees have no entries in the matrix, nor what their
    bodies weigh in the force; `carried`: of each speed the most that a step of its tree carries,
    over its own mass; `kinetic`, `potential`; `energy_terms`: sizes of the forces times those of
    the places they act at, below whose rounding no energy is determined.
    """

    matrices: SystemMatrices
    load_sizes: ca.SX
    drives: ca.SX
    witness: ca.SX
    reach: ca.SX
    tree: BodyTrees
    carried: ca.SX
    kinetic: ca.SX
    potential: ca.SX
    energy_terms: ca.SX


def place_mechanism(mechanism: Mechanism) -> Placed:
    """Where everything is, and how its contacts stand, as functions of the coordinates."""
    symbols, conditions = make_symbols(mechanism), ConditionTable()
    kinematics = place_bodies(mechanism, symbols, Constants(symbols), conditions)
    symbols, world = kinematics.symbols, mechanism.model.world
    places = {link.liaison: k for k, link in reversed(tuple(enumerate(mechanism.contacts)))}
    geometry = tuple(
        link.geometry(
            kinematics,
            symbols.sides[k if link.side_of is link.liaison else places.get(link.side_of, k)],
            world,
        )
        for k, link in enumerate(mechanism.contacts)
    )
    return Placed(mechanism, symbols, kinematics, geometry, conditions)


def reduce_motion(
    placed: Placed,
    variables: Variables,
    applied: list[Load],
    coefficients: ca.SX,
    large: frozenset[int],
    log: Log,
) -> MotionEquations:
    """The equations of the motion under the loads `applied`; `large` are speeds of large trees."""
    mechanism, kinematics, geometry = placed.mechanism, placed.kinematics, placed.geometry
    symbols, without_auxiliary = placed.symbols, variables.without_auxiliary
    rates = column(rate for g in geometry for rate in g.rates(kinematics))
    speeds = ca.vertcat(symbols.v, symbols.sw)
    loads = sum_loads(mechanism, variables, applied, large)
    steps, potential, terms = make_masses(mechanism, variables, loads.pushes)
    motion = write_out(steps, symbols.v.numel(), speeds.numel(), large)
    if not large:
        refuse_idle_spins(mechanism, variables, motion.mass, log)
    rows = rows_without_rounding(without_auxiliary(ca.jacobian(rates, speeds)), mechanism, geometry)
    biases = without_auxiliary(_biases(mechanism.contacts, geometry, rates, variables))
    mass = without_auxiliary(motion.mass)
    kinetic = (variables.of_body(b, "kinetic_energy") for b in mechanism.model.bodies)
    return MotionEquations(
        matrices=SystemMatrices(
            matrix=mass,
            force=without_auxiliary(motion.force + loads.force),
            force_size=without_auxiliary(motion.size + loads.size),
            spread=rows.T,
            metric=mass,
            rows=rows,
            bias=biases_without_rounding(biases, rows, mechanism, geometry),
            rate=without_auxiliary(rates),
            gap=without_auxiliary(column(g.gap for g in geometry)),
            coefficients=without_auxiliary(coefficients),
            power=without_auxiliary(loads.power),
        ),
        load_sizes=without_auxiliary(column(loads.sizes)),
        drives=without_auxiliary(sizes_of_drives(mechanism, kinematics, geometry)),
        witness=without_auxiliary(column(g.witness for g in geometry)),
        reach=without_auxiliary(column(g.reach for g in geometry)),
        tree=BodyTrees(_steps_without_auxiliary(steps, large, without_auxiliary), large),
        carried=ca.substitute(
            heaviest_loads(steps, symbols.v.numel()), symbols.v, ca.SX.zeros(symbols.v.shape)
        ),
        kinetic=without_auxiliary(sum(kinetic, ca.SX(0))),
        potential=without_auxiliary(potential + loads.potential),
        energy_terms=without_auxiliary(terms + loads.terms),
    )


def _biases(
    links: Iterable[Constraint],
    geometry: Iterable[Geometry],
    rates: ca.SX,
    variables: Variables,
) -> ca.SX:
    """What moves the rows while no speed changes; of what does not slip, along their directions."""
    slips = {
        rows.reaction[0]: g.still
        for rows, g in zip(link_rows(tuple(links)), geometry, strict=True)
        if g.still is not None
    }
    moved = [slips[k][0] if k in slips else rates[k] for k in range(rates.numel())]
    found = variables.kinematics.rate(variables.without_auxiliary(column(moved)))
    ends = itertools.accumulate((x.numel() for x in moved), initial=0)
    parts = (found[first : first + x.numel()] for first, x in zip(ends, moved, strict=False))
    return column(ca.dot(slips[k][1], part) if k in slips else part for k, part in enumerate(parts))


def _steps_without_auxiliary(
    steps: tuple[Step, ...], large: frozenset[int], without_auxiliary: Callable[[ca.SX], ca.SX]
) -> tuple[Step, ...]:
    """Those of large trees with auxiliary speeds at zero; only forces hold speeds."""
    if not large:
        return ()
    return tuple(
        replace(step, force=without_auxiliary(step.force), couple=without_auxiliary(step.couple))
        for step in steps
    )


def reads_solution(value: ca.SX, symbols: Symbols) -> bool:
    """Whether a value depends on accelerations or reactions."""
    return any(
        s.numel() and value.numel() and ca.depends_on(value, s) for s in (symbols.a, symbols.lam)
    )


def friction_coefficients(placed: Placed, motion: Lowering, log: Log) -> ca.SX:
    """For each element its coefficient of motion and of rest, times the radius of a pin.

    A negative one is no number, nor one of rest below that of motion, so that it is seen.
    """
    values: list[ca.SX] = []
    symbols = placed.symbols
    for contact, geometry in zip(placed.mechanism.contacts, placed.geometry, strict=True):
        count = sum(friction.components for friction in contact.frictions)
        rates = geometry.rates(placed.kinematics)[-count:] if count else []
        for friction in contact.frictions:
            arm = ca.SX(1) if friction.arm is None else motion.lower(friction.arm)
            slip, rates = rates[: friction.components], rates[friction.components :]
            own: list[ca.SX] = []
            for expression in friction.coefficients:
                value = motion.lower(expression)
                if reads_solution(value, symbols) or _reads_speed(value, symbols):
                    log.report(
                        "E0701",
                        f"a coefficient of liaison '{contact.liaison.name}' that depends on the "
                        "motion otherwise than by positions is not supported yet",
                        expression.span,
                    )
                own.append(ca.if_else(value >= 0, arm * value, ca.SX.nan()))
            if len(own) > 1 and not ca.is_equal(own[0], own[1], _DEPTH):
                least = (1 - _ROUNDING) * own[0]
                own[1] = ca.if_else(own[1] >= least, own[1], ca.SX.nan())
            if friction.fades is not None:
                own[0] = _faded(own, slip, friction.fades, arm, motion)
            if friction.smooth is not None:
                own = [_grown(own[0], slip, friction.smooth, arm, motion), ca.SX(0)]
            values += own * friction.components
    return column(values)


def _faded(
    own: list[ca.SX], slip: list[ca.SX], over: Expression, arm: ca.SX, motion: Lowering
) -> ca.SX:
    """The coefficient of motion at a slip, that decreases from that of rest over a speed."""
    moving, resting = own
    square = _square(slip, over, arm)
    return moving + (resting - moving) * ca.exp(-square / motion.lower(over) ** 2)


def _grown(own: ca.SX, slip: list[ca.SX], over: Expression, arm: ca.SX, motion: Lowering) -> ca.SX:
    """The coefficient mu s/sqrt(s^2 + v^2) at a slip s, that grows from zero over a speed v."""
    square = _square(slip, over, arm)
    moves = square > 0
    part = ca.if_else(moves, ca.sqrt(ca.if_else(moves, square, 1)), 0)
    return own * part / ca.sqrt(square + motion.lower(over) ** 2)


def _square(slip: list[ca.SX], over: Expression, arm: ca.SX) -> ca.SX:
    """That of a slip, as a speed is given: that of a pin is measured at its surface, or turns."""
    square = sum((rate**2 for rate in slip), ca.SX(0))
    return square * arm**2 if over.type.dimension == VELOCITY.dimension else square


def _reads_speed(value: ca.SX, symbols: Symbols) -> bool:
    return bool(symbols.v.numel() and ca.depends_on(value, symbols.v))
