"""What of the text may give no finite number, and where each equation or condition does by itself.

The residual of an equation is evaluated with the values of its variables, where those that have no
finite value, since another equation gives none, are replaced by one: so the first of the equations
whose residual is not finite then is the one that fails. So it is with what a condition compares,
and with what an equation was divided by when it was solved.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np
from frot.compiler.equations.assembled import Assembled
from frot.compiler.symbolic.columns import column
from frot.compiler.symbolic.random_tests import read_as_truths
from frot.compiler.translate.origins import Origin

_RISKY = {
    getattr(ca, f"OP_{name}")
    for name in (
        *("DIV", "INV", "SQRT", "LOG", "POW", "CONSTPOW", "EXP", "TAN", "SINH", "COSH"),
        *("ASIN", "ACOS", "ACOSH", "ATANH", "LOG1P", "EXPM1"),
    )
    if hasattr(ca, f"OP_{name}")
}
_LARGEST = 1e300


# Truths in a divisor, all values of which are tried.
_MOST = 8


@dataclass(frozen=True, slots=True, eq=False)
class Watched:
    """What may give no number; `lacks`: the unknown that it was solved for, if a branch has none.

    Then the divisor is zero wherever that branch is taken.
    """

    origin: Origin
    lacks: str = ""


def watch_numbers(system: Assembled) -> tuple[ca.SX, list[Watched]]:
    """The values to look at when a number is missed, and what they belong to."""
    equations, conditions = system.reduced.equations, system.reduced.conditions
    written = [
        (value, Watched(Origin(span, text, "")))
        for value, span, text in zip(
            conditions.values, conditions.spans, conditions.texts, strict=True
        )
        if span is not None
    ]
    divided = [
        (1 / x.value, Watched(x.origin, x.unknown if _vanishes_in_a_branch(x.value) else ""))
        for x in system.divisors
    ]
    everything = [
        *zip(equations.values, map(Watched, equations.origins), strict=True),
        *written,
        *divided,
    ]
    risky = _risky([value for value, _ in everything])
    values = column(everything[k][0] for k in risky)
    inside = column(ca.symvar(values))
    known = system.resolve(system.reduced.variables.without_auxiliary(inside))
    guarded = ca.if_else(ca.fabs(known) < _LARGEST, known, 1)
    watched = ca.substitute(values, inside, guarded) if inside.numel() else values
    return watched, [everything[k][1] for k in risky]


def _vanishes_in_a_branch(divisor: ca.SX) -> bool:
    """Whether a divisor is zero on one branch of the conditions in it, whatever the values are."""
    symbols = ca.symvar(divisor)
    function = ca.Function("divisor", [column(symbols)], [divisor])
    truths = sorted(read_as_truths(function))
    if not 0 < len(truths) <= _MOST:
        return False
    place = np.random.default_rng(1).uniform(0.5, 2, len(symbols))
    for values in itertools.product((0.0, 1.0), repeat=len(truths)):
        place[truths] = values
        if float(function(ca.DM(place))) == 0:
            return True
    return False


def _risky(values: Sequence[ca.SX]) -> list[int]:
    """The places of what an operation may make infinite or no number."""
    whole = column(values)
    symbols = column(ca.symvar(whole))
    function = ca.Function("f", [symbols], [whole])
    marked = [False] * function.sz_w()
    found: list[int] = []
    for k in range(function.n_instructions()):
        operation, to, of = (
            function.instruction_id(k),
            function.instruction_output(k),
            function.instruction_input(k),
        )
        if operation == ca.OP_OUTPUT:
            if marked[of[0]]:
                found.append(to[1])
        elif operation in (ca.OP_INPUT, ca.OP_CONST):
            marked[to[0]] = False
        else:
            marked[to[0]] = operation in _RISKY or any(marked[i] for i in of)
    return found
