"""Slips of the text that dry friction holds: where they are shown, zero to the last bit.

A slip is a difference of speeds, each of which a run gives to rounding. That it is held is known
from the mode: the kernel shows a variable that is a slip as zero, and writes the modes of those
that outputs read among the discrete values.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import casadi as ca
from frot.compiler.equations.text_symbols import Discrete, FrictionElement, TextSymbols, scalars
from frot.compiler.lowering.walk import subexpressions
from frot.compiler.mechanics.variables import STICK, Variables
from frot.dsl.checked import Model, Reference, Variable
from frot.dsl.checked.arrays import component_names


def slip_names(text: TextSymbols) -> Mapping[str, str]:
    """The names of variables that are slips, by those of their elements."""
    return {e.name: name for e, _, name, _ in _slips(text)}


def give_slip_modes(model: Model, variables: Variables, text: TextSymbols, first: int) -> None:
    """The modes of slips that outputs read; `first` is the kernel's number of the first element."""
    read = {
        node.target
        for output in model.outputs
        for node in subexpressions(output.value)
        if isinstance(node, Reference) and isinstance(node.target, Variable)
    }
    for element, slip, _, variable in _slips(text):
        if variable in read:
            symbol = ca.SX.sym(f"{element.name}.mode")
            place = len(variables.modes)  # the modes are the first discrete values
            variables.modes[element] = first + text.elements.index(element), symbol
            text.discrete.insert(place, Discrete(symbol.name(), symbol, ca.SX(0)))
            variables.slips.append((slip, ca.if_else(symbol + 1 == STICK, 0, slip)))


def _slips(text: TextSymbols) -> Iterator[tuple[FrictionElement, ca.SX, str, Variable]]:
    """The elements whose slip is a variable, or its opposite, with its symbol and its name."""
    known = {
        symbol.element_hash(): (symbol, name, variable)
        for variable, values in text.values.items()
        for symbol, name in zip(
            scalars(values), component_names(variable.name, variable.type.shape), strict=True
        )
    }
    for element in text.elements:
        slip = element.slip
        if slip.is_op(ca.OP_NEG):
            slip = slip.dep(0)
        if slip.is_symbolic() and slip.element_hash() in known:
            yield element, *known[slip.element_hash()]
