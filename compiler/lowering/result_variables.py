"""The variables a run gives: of bodies, of liaisons, declared outputs, energies."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass, replace

import casadi as ca
from frot.compiler.equations.assembled import Assembled
from frot.compiler.equations.reduced import Reduced
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.compiler.symbolic.columns import column
from frot.compiler.translate.expressions import Lowering
from frot.compiler.translate.text_symbols import scalars
from frot.dsl.catalogue import coordinates_of
from frot.dsl.checked import (
    Body,
    Expression,
    Liaison,
    Variable,
    arrays,
)
from frot.dsl.checked.arrays import component_names
from frot.dsl.checked.liaison_variables import arc_of_unit, parameter_type
from frot.dsl.quantities.dimensions import Dimension, Enumeration, dimension

AXES = ("x", "y", "z")


@dataclass(frozen=True, slots=True, eq=False)
class Listed:
    """One scalar variable. `quantity` names its type (`Angle`), `unit` is the author's.

    `base` is `real`, `integer` (enumerations are counted from 1) or `boolean`. `declared`: by the
    text. `changes`: false for a mode that cannot.
    """

    name: str
    value: ca.SX
    dimension: Dimension
    doc: str
    quantity: str = ""
    output: bool = False
    mode: bool = False
    base: str = "real"
    unit: str = ""
    bounds: tuple[tuple[str, Expression], ...] = ()
    enumeration: Enumeration | None = None
    declared: bool = False
    changes: bool = True


@dataclass(frozen=True, slots=True, eq=False)
class FirstIntegral:
    """What stays constant, in words, with its value as an expression of the reduced system.

    `always`: whatever the parameters are; else at their defaults.
    """

    text: str
    value: ca.SX
    dimension: Dimension
    always: bool


LENGTH, VELOCITY, ACCELERATION = (dimension(m=1, s=-k) for k in range(3))
RATE, RATE_OF_RATE, NUMBER = dimension(s=-1), dimension(s=-2), dimension()
FORCE, ENERGY, POWER = dimension(m=1, kg=1, s=-2), dimension(2, 1, -2), dimension(2, 1, -3)


MOST_INTEGRALS = 16


def integral_name(number: int) -> str:
    """The variable of a first integral, numbered from 1."""
    return f"first_integrals[{number}]"


def listed_integrals(integrals: tuple[FirstIntegral, ...]) -> tuple[FirstIntegral, ...]:
    """Those with a variable of their own: the energy has those of its parts."""
    return tuple(x for x in integrals if x.text != "energy")[:MOST_INTEGRALS]


def list_variables(
    system: Assembled, display: Lowering, integrals: tuple[FirstIntegral, ...] = ()
) -> tuple[Listed, ...]:
    """Modes first, in the kernel's order; then outputs, variables, bodies, liaisons, energies.

    Last the first integrals.

    A name that occurs twice (an output called as a body's variable) keeps its first meaning.
    """
    seen: set[str] = set()
    variables: list[Listed] = []
    whole = itertools.chain(_all(system, display), _of_integrals(integrals))
    for variable in whole:
        if variable.name not in seen:
            seen.add(variable.name)
            variables.append(variable)
    return tuple(variables)


def _all(system: Assembled, display: Lowering) -> Iterator[Listed]:
    reduced = system.reduced
    mechanism = reduced.mechanism
    for link in mechanism.contacts:
        if link.first:
            name = f"{link.liaison.name}.mode"
            changes = bool(link.frictions) or is_unilateral(link.liaison)
            doc = "open, stick or slip"
            yield Listed(name, ca.SX(0), NUMBER, doc, mode=True, changes=changes)
    for element in system.elements:
        yield Listed(f"{element.name}.mode", ca.SX(0), NUMBER, "stick or slip", mode=True)
    # Whatever an output reads of a motion that friction holds is zero to the last bit.
    showing = replace(display, quantity=reduced.variables.at_rest, done={})
    for output in mechanism.model.outputs:
        value = showing.lower(output.value)
        limits = arrays.bounds_of(output.bounds, value.numel())
        for k, (suffix, part) in enumerate(_components(output.name, value)):
            yield Listed(
                suffix,
                part,
                output.type.dimension,
                output.doc,
                quantity=output.quantity,
                output=True,
                base=output.type.base,
                unit=output.unit,
                bounds=limits[k],
                enumeration=output.type.enumeration,
                declared=True,
            )
    for variable in mechanism.model.variables:
        yield from _of_text(reduced, variable)
    yield from _rates(system)
    accelerations = _accelerations(reduced)
    for body in mechanism.model.bodies:
        yield from _of_body(reduced, body, accelerations)
    known = dict.fromkeys(x.liaison for x in (*mechanism.contacts, *mechanism.ideal))
    own = set(mechanism.model.liaisons)
    for liaison in (*(x for x in known if x in own), *mechanism.corners):
        yield from _of_liaison(reduced, liaison)
    if not mechanism.model.bodies:
        return
    dissipated, work = reduced.symbols.energy[0], reduced.symbols.energy[1]
    yield Listed("energy.kinetic", reduced.motion.kinetic, ENERGY, "kinetic energy of all bodies")
    yield Listed(
        "energy.potential", reduced.motion.potential, ENERGY, "gravity, springs, attractions"
    )
    yield Listed("energy.dissipated", dissipated, ENERGY, "lost in friction since the start")
    yield Listed("energy.work", work, ENERGY, "work done by the other forces since the start")


def _of_integrals(integrals: tuple[FirstIntegral, ...]) -> Iterator[Listed]:
    for k, one in enumerate(listed_integrals(integrals)):
        yield Listed(integral_name(k + 1), one.value, one.dimension, f"constant: {one.text}")


def _components(name: str, value: ca.SX) -> Iterator[tuple[str, ca.SX]]:
    if value.numel() == 1:
        yield name, value
    elif value.numel() <= len(AXES):
        for axis, k in zip(AXES, range(value.numel()), strict=False):
            yield f"{name}.{axis}", value[k]
    else:
        for k in range(value.numel()):
            yield f"{name}[{k + 1}]", value[k]


def _of_text(reduced: Reduced, variable: Variable) -> Iterator[Listed]:
    names = component_names(variable.name, variable.type.shape)
    values = scalars(reduced.text.values[variable])
    nominal = () if variable.nominal is None else (("nominal", variable.nominal),)
    limits = arrays.bounds_of((*variable.bounds, *nominal), len(values))
    for name, value, bounds in zip(names, values, limits, strict=True):
        yield Listed(
            name,
            value,
            variable.type.dimension,
            variable.doc,
            quantity=variable.quantity,
            output=variable.output,
            base=variable.type.base,
            unit=variable.unit,
            bounds=bounds,
            enumeration=variable.type.enumeration,
            declared=True,
        )


def _rates(system: Assembled) -> Iterator[Listed]:
    """States that are derivatives of variables, by the name `der(x)`."""
    chains = system.reduced.text.chains
    for symbol in (*ca.vertsplit(system.q), *ca.vertsplit(system.v)):
        index, order = chains.place.get(symbol.element_hash(), (-1, 0))
        variable = chains.items[index].variable if index >= 0 else None
        if order == 1 and variable is not None:
            name = chains.items[index].name
            rate = variable.type.dimension / dimension(s=1)
            yield Listed(f"der({name})", symbol, rate, f"rate of {name}")


def _accelerations(reduced: Reduced) -> dict[tuple[Body, str], ca.SX]:
    """Rates of the velocities of all bodies, found in one go: each hangs on those before it."""
    of_body, found = reduced.variables.of_body, {}
    for body in reduced.mechanism.model.bodies:
        found[body, "acceleration"] = of_body(body, "velocity")
        if body.shape is not None and body.shape.turns:
            found[body, "angular_acceleration"] = of_body(body, "angular_velocity")
    rates = reduced.variables.rate(column(found.values()))
    ends = itertools.accumulate((x.numel() for x in found.values()), initial=0)
    return {
        key: rates[first : first + value.numel()]
        for (key, value), first in zip(found.items(), ends, strict=False)
    }


def _of_body(
    reduced: Reduced, body: Body, accelerations: dict[tuple[Body, str], ca.SX]
) -> Iterator[Listed]:
    def vector(name: str, of: Dimension, doc: str) -> Iterator[Listed]:
        value = own(name)
        for suffix, part in _components(f"{body.name}.{name}", value):
            yield Listed(suffix, part, of, doc)

    def own(name: str) -> ca.SX:
        known = accelerations.get((body, name))
        return reduced.variables.of_body(body, name) if known is None else known

    yield from vector("position", LENGTH, "position of G")
    yield from vector("velocity", VELOCITY, "velocity of G")
    yield from vector("acceleration", ACCELERATION, "acceleration of G")
    if body.shape is not None and body.shape.turns:
        if reduced.mechanism.model.planar:
            value = reduced.variables.of_body(body, "angle")
            yield Listed(f"{body.name}.angle", value, NUMBER, "angle to the x axis", "Angle")
        else:
            yield from vector("orientation", NUMBER, "unit quaternion of the axes: w, x, y, z")
        for name, of, doc, quantity in (
            ("angular_velocity", RATE, "angular velocity", "AngularVelocity"),
            ("angular_acceleration", RATE_OF_RATE, "angular acceleration", "AngularAcceleration"),
        ):
            for suffix, part in _components(f"{body.name}.{name}", own(name)):
                yield Listed(suffix, part, of, doc, quantity)
    value = reduced.variables.of_body(body, "kinetic_energy")
    yield Listed(f"{body.name}.kinetic_energy", value, ENERGY, "kinetic energy")


# Of the coordinates of joints: their dimensions, what they are, their types.
_COORDINATES = {
    "angle": (NUMBER, "angle of b's axes from a's", "Angle"),
    "angle_a": (NUMBER, "angle about the axis of a", "Angle"),
    "angle_b": (NUMBER, "angle about the axis of b", "Angle"),
    "displacement": (LENGTH, "way of b along the axis", ""),
    "x": (LENGTH, "way of b in the plane", ""),
    "y": (LENGTH, "way of b in the plane", ""),
    "z": (LENGTH, "way of b along z", ""),
    "orientation": (NUMBER, "unit quaternion of b's axes in those of a: w, x, y, z", ""),
    "length": (LENGTH, "distance of the points", ""),
}


def _of_liaison(reduced: Reduced, liaison: Liaison) -> Iterator[Listed]:
    def one(name: str, of: Dimension, doc: str, quantity: str = "") -> Iterator[Listed]:
        value = reduced.variables.of_liaison(liaison, name)
        for suffix, part in _components(f"{liaison.name}.{name}", value):
            yield Listed(suffix, part, of, doc, quantity)

    variables = reduced.variables
    corners = variables.corners.get(liaison, ())
    if corners:
        yield from one("gap", LENGTH, "smallest distance of a corner")
        if all(corner in variables.reactions for corner in corners):
            yield from one("normal_force", FORCE, "sum of the reactions along the normal")
            yield from one("tangential_force", FORCE, "sum of the friction at the corners")
            yield from one("force", FORCE, "reaction of the first place on the second")
            yield from one("power", POWER, "power of the reactions")
        return
    geometry = variables.geometry[liaison]
    for name in coordinates_of(liaison.kind, reduced.mechanism.model.planar):
        if name in _COORDINATES:
            yield from one(name, *_COORDINATES[name])
        elif name in ("gap", "u", "abscissa"):
            continue
        elif name == "speed" and "displacement" in liaison.kind.coordinates:
            yield from one(name, VELOCITY, "speed of b along the axis")
        else:
            yield from one(name, RATE, "angular velocity of b from a", "AngularVelocity")
    yield from _of_curve(reduced, liaison)
    yield from one("gap", LENGTH, "distance of the places")
    words = geometry.words
    if "slip" in words:
        yield from one("slip", VELOCITY, words["slip"])
    free = geometry.is_free and liaison in variables.drives
    if not free and liaison not in variables.reactions:
        return
    for name in ("normal_force", "tangential_force"):
        if name in words:
            yield from one(name, FORCE, words[name])
    yield from one("force", FORCE, "reaction of the first place on the second")
    yield from one("torque", ENERGY, "couple of the first place on the second", "Torque")
    yield from one("power", POWER, "power of the reaction")


def _of_curve(reduced: Reduced, liaison: Liaison) -> Iterator[Listed]:
    """The parameter of a point on a curve, and the arc length where a closed form tells it."""
    if not liaison.kind.along_curve:
        return
    kind = parameter_type(liaison.b)
    value = reduced.variables.of_liaison(liaison, "u")
    yield Listed(f"{liaison.name}.u", value, kind.dimension, "parameter of the curve")
    if arc_of_unit(liaison.b) is not None:
        value = reduced.variables.of_liaison(liaison, "abscissa")
        yield Listed(f"{liaison.name}.abscissa", value, LENGTH, "arc length along the curve")
