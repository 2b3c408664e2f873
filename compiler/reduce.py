"""Mechanism to reduced equations: M a = h + J' lam with the rows of the contacts.

Auxiliary speeds along the normals of reduced liaisons (T. Kane, D. Levinson, Dynamics: Theory and
Applications, 1985, sect. 4.9) bring their reactions to light without adding a coordinate: they are
zero, and so are their accelerations, in every motion.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
from frot.compiler.contacts import Geometry, down, joint_geometry, row_rates
from frot.compiler.expressions import Conditions, Lowering
from frot.compiler.forces import load
from frot.compiler.kinematics import Kinematics
from frot.compiler.mechanism import Joint, Mechanism, Pin
from frot.compiler.pins import PinGeometry
from frot.compiler.symbols import Rows, Symbols, column, contact_rows, make_symbols
from frot.compiler.variables import Variables
from frot.dsl import Log
from frot.dsl.checked import Liaison, Quantity

STANDARD_GRAVITY = 9.81


@dataclass(frozen=True, slots=True, eq=False)
class Reduced:
    """Equations of the motion in CasADi expressions, auxiliary speeds at zero.

    `mass` (nw x nw), `force` (nw) and `force_size`, the sum of the sizes of its terms,
    `load_sizes` of the applied forces, `rows` (n_rows x nw), `bias` (n_rows: J a + bias is the
    rows' acceleration), `rate` (n_rows), `gap` and `distance` (n_contacts), `coefficients` (mu,
    mu_s, delta of each contact), `power` of the loads without potential, `kinetic`, `potential`.
    """

    mechanism: Mechanism
    symbols: Symbols
    contact_rows: tuple[Rows, ...]
    variables: Variables
    fixed: Lowering
    conditions: Conditions
    mass: ca.SX
    force: ca.SX
    force_size: ca.SX
    load_sizes: ca.SX
    rows: ca.SX
    bias: ca.SX
    rate: ca.SX
    gap: ca.SX
    distance: ca.SX
    coefficients: ca.SX
    power: ca.SX
    kinetic: ca.SX
    potential: ca.SX


def reduce(mechanism: Mechanism, log: Log) -> Reduced | None:
    """Form the equations; what cannot be lowered is reported."""
    symbols = make_symbols(mechanism)

    def nothing(node: Quantity) -> ca.SX:
        raise TypeError(f"{node.name} in an expression of parameters")

    fixed = Lowering(symbols, nothing, lambda value: value * 0, log)
    kinematics = Kinematics(mechanism, symbols, fixed)
    variables = _variables(mechanism, kinematics, symbols)
    conditions = Conditions()
    moving = Lowering(symbols, variables.quantity, variables.rate, log, conditions)
    rates = _rates(mechanism.contacts, variables, kinematics)
    speeds, places = ca.vertcat(symbols.v, symbols.sw), ca.vertcat(symbols.q, symbols.w)
    motion = _masses(mechanism, variables)
    loads = _loads(mechanism, variables, moving, log)
    coefficients = _coefficients(mechanism.contacts, moving, symbols, log)
    geometry = [variables.geometry[contact.liaison] for contact in mechanism.contacts]
    if log.failed:
        return None
    settled = variables.settled
    conditions.values = [settled(value) for value in conditions.values]
    return Reduced(
        mechanism=mechanism,
        symbols=symbols,
        contact_rows=contact_rows(mechanism.contacts),
        variables=variables,
        fixed=fixed,
        conditions=conditions,
        mass=settled(motion.mass),
        force=settled(motion.force + loads.force),
        force_size=settled(motion.size + loads.size),
        load_sizes=settled(column(loads.sizes)),
        rows=settled(ca.jacobian(rates, speeds)),
        bias=settled(ca.jtimes(rates, places, speeds)),
        rate=settled(rates),
        gap=settled(column(g.gap for g in geometry)),
        distance=settled(column(g.distance for g in geometry)),
        coefficients=settled(coefficients),
        power=settled(loads.power),
        kinetic=settled(motion.kinetic),
        potential=settled(motion.potential + loads.potential),
    )


def _variables(mechanism: Mechanism, kinematics: Kinematics, symbols: Symbols) -> Variables:
    world = mechanism.model.world
    geometry: dict[Liaison, Geometry | PinGeometry] = {}
    for index, contact in enumerate(mechanism.contacts):
        side = symbols.sides[index]
        geometry[contact.liaison] = joint_geometry(contact, kinematics, side, world)
    for contact in mechanism.ideal:
        geometry[contact.liaison] = joint_geometry(contact, kinematics, ca.SX(1), world)
    return Variables(
        symbols,
        kinematics,
        geometry,
        {contact.liaison: contact for contact in mechanism.contacts},
        {
            contact.liaison: rows
            for contact, rows in zip(
                mechanism.contacts, contact_rows(mechanism.contacts), strict=True
            )
        },
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Masses:
    """Mass matrix, weight less inertial bias with the size of its terms, energies of the bodies."""

    mass: ca.SX
    force: ca.SX
    size: ca.SX
    kinetic: ca.SX
    potential: ca.SX


def _masses(mechanism: Mechanism, variables: Variables) -> _Masses:
    kinematics, symbols = variables.kinematics, variables.symbols
    world = mechanism.model.world
    speeds, places = ca.vertcat(symbols.v, symbols.sw), ca.vertcat(symbols.q, symbols.w)
    gravity = STANDARD_GRAVITY if world.gravity is None else kinematics.fixed.lower(world.gravity)
    mass, force = ca.SX.zeros(speeds.numel(), speeds.numel()), ca.SX.zeros(speeds.numel())
    size, kinetic, potential = ca.SX.zeros(speeds.numel()), ca.SX(0), ca.SX(0)
    for body in mechanism.model.bodies:
        pose = kinematics.poses[body]
        weight = variables.mass(body) * gravity * down(world)
        for velocity, inertia, push in (
            (kinematics.velocity(pose.origin), variables.mass(body), weight),
            (kinematics.velocity(pose.angle), variables.inertia(body), ca.SX.zeros(1)),
        ):
            jacobian = ca.jacobian(velocity, speeds)
            mass += inertia * (jacobian.T @ jacobian)
            bias = jacobian.T @ (inertia * ca.jtimes(velocity, places, speeds))
            force += jacobian.T @ push - bias
            size += ca.fabs(jacobian.T) @ ca.fabs(push) + ca.fabs(bias)
        kinetic += variables.of_body(body, "kinetic_energy")
        potential -= ca.dot(weight, pose.origin)
    return _Masses(mass, force, size, kinetic, potential)


@dataclass(frozen=True, slots=True, eq=False)
class _Loads:
    """Generalized applied forces, the sizes of their terms and of each, potential and power."""

    force: ca.SX
    size: ca.SX
    sizes: list[ca.SX]
    potential: ca.SX
    power: ca.SX


def _loads(mechanism: Mechanism, variables: Variables, moving: Lowering, log: Log) -> _Loads:
    kinematics, symbols = variables.kinematics, variables.symbols
    speeds = ca.vertcat(symbols.v, symbols.sw)
    force, size = ca.SX.zeros(speeds.numel()), ca.SX.zeros(speeds.numel())
    potential, power = ca.SX(0), ca.SX(0)
    sizes: list[ca.SX] = []
    for applied in mechanism.forces:
        result = load(applied, kinematics, moving, mechanism.model.ground)
        for action in result.actions:
            if _reads_solution(action.force, symbols):
                log.report(
                    "E0701",
                    f"force '{applied.name}' reads an acceleration or a reaction: this is not "
                    "supported yet",
                    applied.span,
                    help="write it in terms of time, positions and velocities",
                )
                break
            push = ca.jacobian(action.velocity, speeds).T @ action.force
            force, size = force + push, size + ca.fabs(push)
            if result.potential is None:
                power += ca.dot(action.velocity, action.force)
        sizes.append(sum((ca.sum1(ca.fabs(a.force)) for a in result.actions), ca.SX(0)))
        if result.potential is not None:
            potential += result.potential
    return _Loads(force, size, sizes, potential, power)


def _reads_solution(value: ca.SX, symbols: Symbols) -> bool:
    return any(
        s.numel() and value.numel() and ca.depends_on(value, s) for s in (symbols.a, symbols.lam)
    )


def _rates(contacts: tuple[Joint, ...], variables: Variables, kinematics: Kinematics) -> ca.SX:
    return column(
        rate
        for contact in contacts
        for rate in row_rates(contact, variables.geometry[contact.liaison], kinematics)
    )


def _coefficients(
    contacts: tuple[Joint, ...], moving: Lowering, symbols: Symbols, log: Log
) -> ca.SX:
    """mu, mu_s (times the radius of a pin), delta; a negative one is no number, so it is seen."""
    values: list[ca.SX] = []
    for contact in contacts:
        radius = contact.radius if isinstance(contact, Pin) else None
        arm = ca.SX(1) if radius is None else moving.lower(radius)
        for expression in (contact.mu, contact.mu_s, contact.delta):
            if expression is None:
                values.append(ca.SX(0))
                continue
            value = moving.lower(expression)
            if _reads_solution(value, symbols) or _reads_speed(value, symbols):
                log.report(
                    "E0701",
                    f"a coefficient of liaison '{contact.liaison.name}' that depends on the motion "
                    "otherwise than by positions is not supported yet",
                    expression.span,
                )
            values.append(ca.if_else(value >= 0, arm * value, ca.SX.nan()))
    return column(values)


def _reads_speed(value: ca.SX, symbols: Symbols) -> bool:
    return bool(symbols.v.numel() and ca.depends_on(value, symbols.v))
