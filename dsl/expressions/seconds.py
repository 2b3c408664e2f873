"""The remedy where a rate in time stands beside what is none: seconds are missing."""

from __future__ import annotations

from frot.dsl import checked
from frot.dsl.checked.walk import nodes
from frot.dsl.quantities.dimensions import Type, dimension

_TIME = dimension(s=1)
_SECONDS = (("1 s", "(1 s)"), ("1 s^2", "(1 s^2)"))


def seconds_missing(
    wanted: Type, found: checked.Expression, beside: checked.Expression | None = None
) -> str:
    """The remedy where `found` should be of another type, or of that `beside` it.

    An empty text where no rate is concerned.
    """
    of = found.type.dimension
    for k, (said, factor) in enumerate(_SECONDS, 1):
        time = _TIME**k
        if of == wanted.dimension * time and beside is not None and _holds_rate(beside):
            text = " ".join(found.span.text.split())
            plain = isinstance(found, checked.Reference | checked.Literal)
            return (
                f"'der' is a rate in time: divide by {said}, "
                f"'{text if plain else f'({text})'}/{factor}'"
            )
        if wanted.dimension == of * time and _holds_rate(found):
            return f"'der' is a rate in time: multiply it by {said}, '{factor}*der(...)'"
    return ""


def _holds_rate(node: checked.Expression) -> bool:
    return any(isinstance(inner, checked.Derivative) for inner in nodes(node))
