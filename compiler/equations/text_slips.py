"""Slips of the text that dry friction holds: zero to the last bit wherever the text reads them.

A slip is a difference of speeds, each of which a run gives to rounding. That it is held is known
from the mode, which the kernel writes among the discrete values.
"""

from __future__ import annotations

from collections.abc import Mapping, MutableSequence
from typing import Any

import casadi as ca
from frot.compiler.equations.events import Events
from frot.compiler.mechanics.variables import Sense, Variables
from frot.compiler.translate.text_symbols import Discrete, FrictionElement, TextSymbols, scalars
from frot.dsl.checked.arrays import component_names


def slip_names(text: TextSymbols) -> Mapping[str, str]:
    """The names of variables that are slips, or opposites of one, by those of their elements."""
    known = {
        symbol.element_hash(): name
        for variable, values in text.values.items()
        for symbol, name in zip(
            scalars(values), component_names(variable.name, variable.type.shape), strict=True
        )
    }
    found: dict[str, str] = {}
    for element in text.elements:
        slip = element.slip.dep(0) if element.slip.is_op(ca.OP_NEG) else element.slip
        if slip.is_symbolic() and slip.element_hash() in known:
            found[element.name] = known[slip.element_hash()]
    return found


def give_slip_modes(variables: Variables, text: TextSymbols, first: int) -> None:
    """The modes of all elements; `first` is the kernel's number of the first element."""
    for k, element in enumerate(text.elements):
        symbol = ca.SX.sym(f"{element.name}.mode")
        place = len(variables.modes)  # the modes are the first discrete values
        variables.modes[element] = first + k, symbol
        text.discrete.insert(place, Discrete(symbol.name(), symbol, ca.SX(0)))


def follow_mode(
    variables: Variables, text: TextSymbols, events: Events, owner: FrictionElement | Sense
) -> None:
    """Let conditions and equations follow a mode or a sense: it becomes one of the first."""
    if owner in variables.located_modes:
        return
    old, new = list(variables.modes).index(owner), len(variables.located_modes)
    order = list(variables.modes.items())
    columns: tuple[MutableSequence[Any], ...] = (order, text.discrete)
    for items in (*columns, events.before, events.values):
        items.insert(new, items.pop(old))
    variables.modes.clear()
    variables.modes.update(order)
    variables.located_modes.append(owner)


def sense_of(variables: Variables, text: TextSymbols, events: Events, contact: int) -> ca.SX:
    """The symbol of the sense of a contact, which conditions follow."""
    sense = Sense(contact)
    if sense not in variables.modes:
        symbol, place = ca.SX.sym(f"sense_{contact}"), len(variables.modes)
        variables.modes[sense] = contact, symbol
        text.discrete.insert(place, Discrete(symbol.name(), symbol, ca.SX(0)))
        events.before.insert(place, ca.SX.sym(f"{symbol.name()} before"))
        events.values.insert(place, events.before[place])
        follow_mode(variables, text, events, sense)
    return variables.modes[sense][1]
