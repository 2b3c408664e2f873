"""Circuits that nothing ties down: all their potentials can be shifted together.

In a circuit without a ground every equation holds differences of potentials alone. It has as many
equations as unknowns, but one balance of flows follows from the others, and the potentials are open
by a constant. That is seen in the Jacobian: the same change of all of them changes nothing,
whatever the values.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import casadi as ca
import numpy as np
from frot.compiler.symbolic.columns import column
from frot.compiler.symbolic.random_tests import at_random
from frot.compiler.translate.derivative_chains import Chains
from frot.dsl import Label, Log
from frot.dsl.checked import Element, Equation, Expression, Model, Reference, Variable
from frot.dsl.messages.source import Span

# Unknowns beyond which nobody looks: the decomposition takes their third power.
_LARGEST = 300
_ROUNDING = 1e-9
_SHOWN = 6


def is_tied_down(values: Sequence[ca.SX], chains: Chains, model: Model, log: Log) -> bool:
    """Whether every circuit has a potential that something fixes; those without are reported."""
    potentials = dict(_potentials(model))
    places = [
        k
        for k, chain in enumerate(chains.items)
        if chain.variable is not None and len(chain.symbols) == 1
    ]
    if not potentials or not any(chains.items[k].variable in potentials for k in places):
        return True
    if len(places) > _LARGEST:
        return True
    loose = _shifted_together(values, [chains.items[k].symbols[0] for k in places])
    for group in loose:
        named = [chains.items[places[k]] for k in group]
        found = [c.variable for c in named if c.variable in potentials]
        spans = list(dict.fromkeys(potentials[v] for v in found if v is not None))
        if not spans:
            continue
        shown = ", ".join(f"'{c.name}'" for c in named[:_SHOWN])
        more = f" and {len(named) - _SHOWN} more" if len(named) > _SHOWN else ""
        log.report(
            "E0611",
            f"nothing fixes the potentials {shown}{more}: the same change of all of them changes "
            "nothing else",
            spans[0],
            labels=tuple(Label(span, "connected with it") for span in spans[1:3]),
            help="connect a part that fixes one: a `Ground` in a circuit, a `Fixed` on a shaft",
        )
    return not log.failed


def _potentials(model: Model) -> Iterator[tuple[Variable, Span]]:
    """The variables that connections make equal, each with the place of a connection."""
    for equation in model.equations:
        if isinstance(equation, Equation) and equation.connection.startswith("connect("):
            for side in (equation.left, equation.right):
                variable = _variable(side)
                if variable is not None:
                    yield variable, equation.span


def _variable(node: Expression) -> Variable | None:
    while isinstance(node, Element):
        node = node.operand
    if isinstance(node, Reference) and isinstance(node.target, Variable):
        return node.target
    return None


def _shifted_together(values: Sequence[ca.SX], unknowns: Sequence[ca.SX]) -> list[list[int]]:
    """Groups of unknowns whose common change leaves all values as they are, at random places."""
    slope = ca.jacobian(column(values), column(unknowns))
    parts = at_random(slope)
    if not parts:
        return []
    whole = np.vstack(parts)
    size = np.linalg.norm(whole, axis=1)
    whole = whole[size > 0] / size[size > 0, None]
    _, singular, directions = np.linalg.svd(whole, full_matrices=True)
    rank = int(np.sum(singular > _ROUNDING))
    null = directions[rank:]
    onto = null.T @ null
    groups: list[list[int]] = []
    taken: set[int] = set()
    for k in range(len(unknowns)):
        group = [int(j) for j in np.flatnonzero(np.abs(onto[k]) > _ROUNDING)]
        if not group or k in taken:
            continue
        taken.update(group)
        if np.ptp(onto[k, group]) <= _ROUNDING:
            groups.append(group)
    return groups
