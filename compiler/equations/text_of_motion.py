"""What the equations of a text see of the mechanism: coordinates, first values, frictions."""

from __future__ import annotations

from collections.abc import Callable
from math import prod

import casadi as ca
from frot.compiler.equations.structure.eliminate import Residuals
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.mechanism import Mechanism
from frot.compiler.translate.derivative_chains import Chains
from frot.compiler.translate.expressions import Lowering
from frot.compiler.translate.origins import Origin
from frot.compiler.translate.previous_values import whole
from frot.compiler.translate.symbols import Symbols
from frot.compiler.translate.text_symbols import (
    FrictionElement,
    TextTable,
    make_text_symbols,
    scalars,
)
from frot.dsl import Log
from frot.dsl.checked import Call, Expression, Model, Variable


def chains_of_motion(mechanism: Mechanism, symbols: Symbols) -> TextTable:
    """Chains of the coordinates, then symbols for the variables of the text."""
    chains = Chains(symbols.t)
    # the coordinate whose rate is a speed stands before it; a quaternion has none for each
    before = {k: i for i, k in enumerate(symbols.q_speed) if k >= 0}
    for k in range(symbols.v.numel()):
        name = symbols.q[before[k]].name() if k in before else symbols.v[k].name()
        first = symbols.q[before[k]] if k in before else ca.SX.sym(f"integral({name})")
        chains.add(name, None, symbols=(first, symbols.v[k], symbols.a[k]), fixed=True)
    for turn in symbols.turns:
        places = range(turn.coordinate, turn.coordinate + 4)
        chains.give_rates(
            [symbols.q[i] for i in places],
            [symbols.rates[i] for i in places],
            [k for k in turn.speeds if k >= 0],
        )
    for place in symbols.spots:
        rate = symbols.rates[place]
        inside = [k for k in range(symbols.v.numel()) if ca.depends_on(rate, symbols.v[k])]
        chains.give_rates([symbols.q[place]], [rate], inside)
    chains.forbid_rate(symbols.u, "the input", rest=True)
    chains.forbid_rate(symbols.lam, "the reaction of")
    return make_text_symbols(mechanism.model.variables, chains)


def give_rates_of_tracks(kinematics: Kinematics, text: TextTable) -> None:
    """What is followed where figures touch has rates that hold the speeds."""
    speeds = kinematics.symbols.v
    for liaison, track in kinematics.tracks.items():
        rates = kinematics.track_rates[liaison]
        inside = [k for k in range(speeds.numel()) if ca.depends_on(rates, speeds[k])]
        text.chains.give_rates(
            list(ca.vertsplit(track.unknowns)), list(ca.vertsplit(rates)), inside
        )


def first_values(
    model: Model, text: TextTable, given: Symbols, display: Lowering, log: Log
) -> Callable[[Variable], list[ca.SX]]:
    """Gives the first values of what jumps: those of `initial`, of `start`, or zero."""
    stated: dict[Variable, Expression] = {}
    items: dict[Variable, dict[tuple[int, ...], Expression]] = {}
    for equation in model.initial:
        named = whole(equation.left)
        if named is not None and named[1]:
            items.setdefault(named[0], {})[tuple(named[1])] = equation.right
        elif named is not None:
            stated[named[0]] = equation.right

    def first(variable: Variable) -> list[ca.SX]:
        count = text.values[variable].numel()
        value = stated.get(variable, variable.start)
        starts = [ca.SX(0)] if value is None else scalars(display.lower(value))
        starts = starts * count if len(starts) == 1 else starts
        shape = variable.type.shape
        for item, own in items.get(variable, {}).items():
            width = count // prod(shape[: len(item)])
            first = sum(k * prod(shape[d + 1 :]) for d, k in enumerate(item))
            starts[first : first + width] = scalars(display.lower(own))
            value = own
        if value is not None and not all(_is_given(start, given) for start in starts):
            log.report(
                "E0602",
                f"the first value of '{variable.name}', which events set, depends on the motion",
                value.span,
                help=f"set it in `when initial() then {variable.name} = ...; end when;`",
            )
        return starts

    return first


def _is_given(value: ca.SX, symbols: Symbols) -> bool:
    """Whether a value follows from time, parameters and inputs alone."""
    given = ca.vertcat(symbols.t, symbols.u, symbols.p)
    known = {x.element_hash() for x in ca.vertsplit(given)}
    return all(x.element_hash() in known for x in ca.symvar(value))


def friction_maker(text: TextTable) -> Callable[[Call, list[ca.SX], str], ca.SX]:
    """Makes an element of every `friction(slip, bound, bound_s)` of the equations."""
    taken: set[str] = set()

    def make(call: Call, arguments: list[ca.SX], owner: str) -> ca.SX:
        slip, bound = arguments[:2]
        at_rest = arguments[2] if len(arguments) > 2 else bound
        name, count = owner or "friction", 1
        while name in taken:
            count += 1
            name = f"{owner}.friction_{count}" if owner else f"friction_{count}"
        taken.add(name)
        force = ca.SX.sym(f"{name}.friction")
        acceleration = ca.SX.sym(f"{name}.slip_acceleration")
        units = call.arguments[0].type.dimension, call.type.dimension
        text.elements.append(
            FrictionElement(name, call.span, force, acceleration, slip, bound, at_rest, units)
        )
        text.chains.forbid_rate(force, "the friction")
        return force

    return make


def slip_accelerations(equations: Residuals, text: TextTable) -> Residuals:
    """The equations with an unknown for the rate of each slip, which index reduction needs."""
    values, origins = list(equations.values), list(equations.origins)
    for element in text.elements:
        name = element.acceleration.name()
        text.chains.add(name, element.span, symbols=(element.acceleration,))
        values.append(text.chains.rate(element.slip) - element.acceleration)
        origins.append(Origin(element.span, f"slip of {element.name}", ""))
    return Residuals(tuple(values), tuple(origins))
