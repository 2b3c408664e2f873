"""The conditions as they are where the search for initial values begins.

What switches an unknown and is switched by it, as in `abs(x) = 2`, may be so in several ways. The
`start` of the unknown says which is meant, as it does where there is no switch.
"""

from __future__ import annotations

import casadi as ca
from frot.compiler.equations.assembled import Assembled
from frot.compiler.equations.structure.sparse import strong_components
from frot.compiler.symbolic.columns import column, scalars_of
from frot.compiler.translate.derivative_chains import replace_known
from frot.compiler.translate.expressions import Lowering
from frot.compiler.translate.text_symbols import scalars
from frot.compiler.translate.walk import is_fixed


def first_conditions(system: Assembled, display: Lowering, values: ca.SX) -> ca.SX:
    """The conditions, which have these `values`, with starts for what follows from themselves."""
    conditions = system.reduced.conditions
    flags = column(conditions.flags)
    if not conditions.flags:
        return values
    reads: list[list[int]] = [[] for _ in conditions.flags]
    for i, j in zip(*ca.jacobian_sparsity(values, flags).get_triplet(), strict=True):
        reads[i].append(j)
    if not any(reads):
        return values
    _, circle = strong_components(reads)
    circles = [i for i, read in enumerate(reads) if circle[i] in (circle[j] for j in read)]
    starts = _starts(system, display, flags)
    found = scalars_of(values)
    for i in circles:
        found[i] = system.resolve(replace_known(conditions.values[i], starts))
    return column(found)


def _starts(system: Assembled, display: Lowering, flags: ca.SX) -> dict[int, ca.SX]:
    """The starts of the unknowns that follow from conditions, zero where none is given."""
    text = system.reduced.text
    starts: dict[int, ca.SX] = {}
    for variable in system.reduced.mechanism.model.variables:
        if variable.discrete or variable.type.base != "real":
            continue
        own = scalars(text.values[variable])
        given = [ca.SX(0)]
        if variable.start is not None and is_fixed(variable.start):
            given = scalars(display.lower(variable.start))
        given = given * len(own) if len(given) == 1 else given
        for symbol, value in zip(own, given, strict=True):
            if symbol.is_symbolic() and ca.depends_on(system.resolve(symbol), flags):
                starts[symbol.element_hash()] = value
    return starts
