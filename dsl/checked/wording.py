"""The author's words for an expression, with the items that a loop or an array gives it."""

from __future__ import annotations

import re
from collections.abc import Iterator

from frot.dsl.checked import Element, Expression, Literal, Quantity, Reference
from frot.dsl.checked.walk import nodes, parts
from frot.dsl.messages.source import Span

_INDEX = re.compile(r"\[[^\[\]]*\]")
_Piece = tuple[int, int, str]


def words(node: Expression) -> str:
    """The author's text on one line; a parenthesis cut off at an end of it is put back.

    The variable of a loop is shown as its number: `x[i + 1]` as `x[3]`.
    """
    text = " ".join(_with_numbers(node).split())
    missing = text.count("(") - text.count(")")
    return "(" * -missing + text + ")" * missing


def _with_numbers(node: Expression) -> str:
    span, found, done = node.span, "", node.span.start
    for start, end, text in sorted(_pieces(node), key=lambda piece: (piece[0], -piece[1])):
        if done <= start and end <= span.end:
            found += span.source.text[done:start] + text
            done = end
    return found + span.source.text[done : span.end]


def _pieces(node: Expression) -> Iterator[_Piece]:
    """Places of the text whose words stand for a number, and what they stand for."""
    for part in nodes(node, parts):
        span = part.span
        if span.source is not node.span.source or span.start < node.span.start:
            continue  # an argument of a function, which stands at its call
        match part:
            case Literal(value=float(value), type=kind):
                if kind.base == "integer" and kind.enumeration is None and span.text.isidentifier():
                    yield span.start, span.end, f"{value:g}"
            case Element():
                yield from _item(part)
            case Reference(target=target):
                yield from _indices(span, target.name)
            case Quantity(owner=owner):
                yield from _indices(span, getattr(owner, "name", ""))


def _item(node: Element) -> Iterator[_Piece]:
    """`x[i, k]`: the indices of its elements, which are one in another."""
    inner: Expression = node
    numbers: list[int] = []
    while isinstance(inner, Element) and inner.span == node.span:
        numbers.insert(0, inner.index + 1)
        inner = inner.operand
    bracket = node.span.source.text[inner.span.end : node.span.end].strip()
    if _INDEX.fullmatch(bracket) and _is_named(bracket):
        yield inner.span.end, node.span.end, str(numbers).replace("'", "")


def _indices(span: Span, name: str) -> Iterator[_Piece]:
    """`p[k].x` of what is called `part.p[2]`."""
    written, known = list(_INDEX.finditer(span.text)), _INDEX.findall(name)
    if len(known) < len(written):
        return
    for one, number in zip(reversed(written), reversed(known), strict=False):
        if _is_named(one[0]):
            yield span.start + one.start(), span.start + one.end(), number


def _is_named(bracket: str) -> bool:
    return any(c.isalpha() for c in bracket)
