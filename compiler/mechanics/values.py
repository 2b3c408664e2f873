"""Values that a text gives: how they are lowered, directions, and what time alone changes."""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca
from frot.compiler.mechanics.spatial import X, Y, Z, whole
from frot.dsl.catalogue import TYPES
from frot.dsl.checked import Expression, Literal, Time
from frot.dsl.messages.source import Source, Span

Lower = Callable[[Expression], ca.SX]
NOW = Time(TYPES["Time"], Span(Source("", ""), 0, 0))


def unit_vector(given: Expression | str, lower: Lower) -> ca.SX:
    """The unit vector of `x`, `-x`, `y`, ... or of a vector of the text."""
    name = given.value if isinstance(given, Literal) else given
    if isinstance(name, str):
        along = {"x": X, "y": Y, "z": Z}[name[-1]]
        return -along if name[0] == "-" else along
    assert not isinstance(given, str)
    vector = whole(lower(given))
    return ca.sparsify(vector / ca.norm_2(vector))


def rate_by_time(value: ca.SX, lower: Lower) -> ca.SX:
    """The rate of what time alone changes."""
    return ca.sparsify(ca.jacobian(value, lower(NOW)).reshape(value.shape))
