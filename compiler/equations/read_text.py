"""The symbols of a text beside its mechanism, and the translators of its expressions."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import casadi as ca
from frot.compiler.equations.text_of_motion import (
    chains_of_motion,
    first_values,
    give_rates_of_tracks,
)
from frot.compiler.mechanics.constraint import Constraint
from frot.compiler.mechanics.constraint_geometry import Geometry, GivenFriction, Rows
from frot.compiler.mechanics.laws.law_models import acts_while_closed
from frot.compiler.mechanics.make_symbols import link_rows
from frot.compiler.mechanics.mechanism import Mechanism
from frot.compiler.mechanics.reduce import Placed
from frot.compiler.mechanics.variables import (
    Closed,
    ModeOwner,
    Modes,
    Variables,
    may_be_held,
)
from frot.compiler.translate.expressions import Lowering
from frot.compiler.translate.previous_values import Before
from frot.compiler.translate.text_symbols import TextTable, scalars
from frot.compiler.translate.walk import compared_quantities, quantities_in, read_quantities
from frot.dsl import Log
from frot.dsl.checked import Liaison, Quantity


@dataclass(frozen=True, slots=True, eq=False)
class Reading:
    """What translates a text: its symbols so far, the variables of bodies and liaisons.

    `motion` locates switches as events, `display` takes them as they stand. `frictions` collects
    what laws of the user give, which `variables` shows.
    """

    text: TextTable
    variables: Variables
    frictions: dict[Liaison, GivenFriction]
    motion: Lowering
    display: Lowering


def read_text(placed: Placed, log: Log) -> Reading:
    """Declare the variables of the text; make the translators of its expressions."""
    mechanism, kinematics, symbols = placed.mechanism, placed.kinematics, placed.symbols
    text = chains_of_motion(mechanism, symbols)
    frictions: dict[Liaison, GivenFriction] = {}
    variables = _variables(placed, text, _modes(mechanism, text), frictions)
    give_rates_of_tracks(kinematics, text)
    display = Lowering(
        symbols,
        variables.quantity,
        variables.rate,
        log,
        variable=text.values.__getitem__,
        without_rate=text.chains.without_rate,
    )
    first = first_values(mechanism.model, text, symbols, display, log)
    motion = Lowering(
        symbols,
        variables.quantity,
        variables.rate,
        log,
        placed.conditions,
        variable=text.values.__getitem__,
        without_rate=text.chains.without_rate,
        before=Before(text, first),
        holds=variables.holds,
        at_rest=variables.at_rest,
    )
    for variable in mechanism.model.variables:
        if variable.discrete:
            symbols_of = scalars(text.values[variable])
            for symbol, start in zip(symbols_of, first(variable), strict=True):
                text.add_discrete(symbol.name(), symbol, start)
    return Reading(text, variables, frictions, motion, display)


def _variables(
    placed: Placed, text: TextTable, modes: Modes, frictions: dict[Liaison, GivenFriction]
) -> Variables:
    """The variables of the bodies, points and liaisons."""
    mechanism, kinematics, found = placed.mechanism, placed.kinematics, placed.geometry
    world, symbols = mechanism.model.world, kinematics.symbols
    geometry: dict[Liaison, Geometry] = {}
    sides: dict[Liaison, ca.SX] = {}
    links: dict[Liaison, Constraint] = {}
    reactions: dict[Liaison, Rows] = {}
    for k, (link, rows, own) in enumerate(
        zip(mechanism.contacts, link_rows(mechanism.contacts), found, strict=True)
    ):
        sides.setdefault(link.liaison, symbols.sides[k])
        before = reactions.get(link.liaison)
        if before is None:
            reactions[link.liaison] = rows
        else:  # its laws are those of one of its relations, or of what reads these again
            added = () if link.repeats else rows.reaction
            lawful = rows if link.frictions else before
            reactions[link.liaison] = replace(lawful, reaction=(*before.reaction, *added))
        links[link.liaison] = link.whole
        if link.whole is link:
            geometry[link.liaison] = own
    for link in mechanism.ideal:  # what rolls has a row, but its reaction is not asked for
        reactions.pop(link.liaison, None)
    for link in (*mechanism.ideal, *tuple(links.values())):
        if link.liaison not in geometry:
            side = sides.get(link.liaison, ca.SX(1))
            geometry[link.liaison] = link.geometry(kinematics, side, world)
        links[link.liaison] = link
    drives: dict[Liaison, list[tuple[str, ca.SX]]] = {}
    for flange in mechanism.model.flanges:
        if flange.drives:
            effort = text.values[flange.effort]
            drives.setdefault(flange.liaison, []).append((flange.coordinate, effort))
    for link in mechanism.contacts:
        if link.pushes is not None:
            coordinate, sign = link.pushes
            effort = sign * symbols.lam[reactions[link.liaison].reaction[0]]
            drives.setdefault(link.side_of, []).append((coordinate, effort))
    return Variables(
        symbols=symbols,
        chains=text.chains,
        kinematics=kinematics,
        geometry=geometry,
        links=links,
        reactions=reactions,
        drives=drives,
        corners=mechanism.corners,
        values=text.values,
        frictions=frictions,
        modes=modes,
        strikes={
            force: ca.SX.sym(f"{force.name}.strike")
            for force in mechanism.forces
            if force.kind.name == "impulse"
        },
    )


def _modes(mechanism: Mechanism, text: TextTable) -> Modes:
    """The modes that text and laws read are the first discrete values: the kernel writes them."""
    numbers: dict[Liaison, int] = {}
    for k, link in enumerate(mechanism.contacts):
        numbers.setdefault(link.liaison, k)
    model = mechanism.model
    found: dict[ModeOwner, tuple[int, ca.SX]] = {}

    def add(owner: ModeOwner, number: int, name: str) -> None:
        symbol = ca.SX.sym(name)
        found[owner] = number, symbol
        text.add_discrete(name, symbol, ca.SX(0))

    def give(read: Iterable[Quantity]) -> None:
        owners = (x.owner for x in read if isinstance(x.owner, Liaison))
        for one in dict.fromkeys(c for x in owners for c in mechanism.corners.get(x, (x,))):
            if one in numbers and one not in found:  # what keeps nothing is open
                add(one, numbers[one], f"{one.name}.mode")

    give(x for x in read_quantities(model) if x.name == "mode")
    give(filter(may_be_held, compared_quantities(model)))
    for one in model.liaisons:
        if one in numbers and any(acts_while_closed(one, law) for law in one.laws):
            add(Closed(one), numbers[one], f"{one.name}.is_closed")
    located = len(found)
    give(x for output in model.outputs for x in quantities_in(output.value) if may_be_held(x))
    return Modes(found, located)
