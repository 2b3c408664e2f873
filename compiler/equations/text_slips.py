"""Slips of the text that dry friction holds: zero to the last bit wherever the text reads them.

A slip is a difference of speeds, each of which a run gives to rounding. That it is held is known
from the mode, which the kernel writes among the discrete values.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import casadi as ca
from frot.compiler.equations.reduced import Reduced
from frot.compiler.mechanics.variables import ModeOwner, Modes, Sense
from frot.compiler.translate.text_symbols import (
    Discrete,
    FrictionElement,
    TextSymbols,
    TextTable,
    scalars,
)
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


def slip_modes(modes: Modes, text: TextTable, first: int) -> Modes:
    """The modes with those of all elements; `first` is the kernel's number of the first element."""
    found = dict(modes.of)
    for k, element in enumerate(text.elements):
        symbol = ca.SX.sym(f"{element.name}.mode")
        place = len(found)  # the modes are the first discrete values
        found[element] = first + k, symbol
        text.discrete.insert(place, Discrete(symbol.name(), symbol, ca.SX(0)))
    return Modes(found, modes.located)


class ModeBook:
    """The modes of a model while conditions and equations are made to follow more of them."""

    def __init__(self, reduced: Reduced) -> None:
        """Begin with the modes that `reduced` has; it stays as it is."""
        self._reduced = reduced
        self._modes = list(reduced.variables.modes.of.items())
        self._located = reduced.variables.modes.located
        self._discrete = list(reduced.text.discrete)
        self._before = list(reduced.events.before)
        self._values = list(reduced.events.values)

    def _place(self, owner: ModeOwner) -> int:
        return next((k for k, (x, _) in enumerate(self._modes) if x == owner), -1)

    def follow(self, owner: FrictionElement | Sense) -> None:
        """Let conditions and equations follow a mode or a sense: it becomes one of the first."""
        old, new = self._place(owner), self._located
        if old < new:
            return
        columns: tuple[list[Any], ...] = (self._modes, self._discrete, self._before, self._values)
        for items in columns:
            items.insert(new, items.pop(old))
        self._located += 1

    def sense(self, contact: int) -> ca.SX:
        """The symbol of the sense of a contact, which conditions follow."""
        sense = Sense(contact)
        if self._place(sense) < 0:
            symbol, place = ca.SX.sym(f"sense_{contact}"), len(self._modes)
            self._modes.append((sense, (contact, symbol)))
            self._discrete.insert(place, Discrete(symbol.name(), symbol, ca.SX(0)))
            before = ca.SX.sym(f"{symbol.name()} before")
            self._before.insert(place, before)
            self._values.insert(place, before)
            self.follow(sense)
        return self._modes[self._place(sense)][1][1]

    def reduced(self, conditions: Sequence[ca.SX]) -> Reduced:
        """The reduced equations with these modes, and these values of the conditions."""
        old = self._reduced
        modes = Modes(dict(self._modes), self._located)
        events = replace(old.events, before=tuple(self._before), values=tuple(self._values))
        return replace(
            old,
            variables=replace(old.variables, modes=modes),
            text=replace(old.text, discrete=tuple(self._discrete)),
            events=events,
            conditions=old.conditions.with_values(conditions),
        )
