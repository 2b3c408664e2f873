"""Lark's nodes of expressions to those of the tree, precedence of operators included."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from frot.dsl.messages.diagnostics import Log
from frot.dsl.messages.source import Source, Span
from frot.dsl.text import tree
from frot.dsl.text.syntax_messages import too_deep
from frot.dsl.text.tree_names import children
from frot.dsl.text.unit_messages import refuse_power

# Parentheses, calls and `if`s in one another, which the passes follow by recursion, and levels of
# the tree, where each term of a sum is one. Both keep well inside Python's own limit.
NESTED = 100
HIGHEST = 200

# Precedence of binary operators; `^` alone associates to the right.
_BINDING = {
    "or": 1,
    "and": 2,
    "<": 4,
    "<=": 4,
    ">": 4,
    ">=": 4,
    "==": 4,
    "<>": 4,
    "+": 5,
    "-": 5,
    "*": 6,
    "/": 6,
    "^": 8,
}
_SIGN = {"not": 3, "-": 5, "+": 5}
_LITERAL = re.compile(r"(?P<number>[0-9.]+(?:[eE][+-]?[0-9]+)?)(?P<space>[ \t]*)(?P<unit>.*)")
_ESCAPES = {"n": "\n", "t": "\t"}


class Dropped(Exception):
    """An expression that cannot be; it was reported, its statement is dropped."""


@dataclass(slots=True)
class Place:
    """Where a text is read from and where its faults go."""

    source: Source
    log: Log

    def span(self, node: Any) -> Span:
        """The place of a node or token of lark."""
        meta = getattr(node, "meta", node)
        return Span(self.source, getattr(meta, "start_pos", 0) or 0, getattr(meta, "end_pos", 0))

    def word(self, token: Any) -> tree.Word:
        """An identifier, NFC-normalised."""
        return tree.Word(unicodedata.normalize("NFC", str(token)), self.span(token))


def expression(node: Any, at: Place) -> tree.Expression:
    """The expression of lark's node. Raises Dropped after reporting it."""
    result = _expression(node, at, 0)
    if height(result) > HIGHEST:
        too_deep(at.log, at.span(node), HIGHEST)
        raise Dropped
    return result


def _expression(node: Any, at: Place, depth: int) -> tree.Expression:
    if depth > NESTED:
        too_deep(at.log, at.span(node), NESTED)
        raise Dropped
    if node.data == "flat":
        return _read_operators(node, at, depth)
    return _BUILDERS[node.data](node, at, depth + 1)


def _name(node: Any, at: Place, depth: int) -> tree.Expression:
    word = at.word(node.children[0])
    return tree.Name(word.text, word.span)


def _chain(node: Any, at: Place, depth: int) -> tree.Expression:
    """Members, subscripts and calls: left-recursive, so read in a loop."""
    links = []
    while node.data in ("member", "index", "call"):
        links.append(node)
        node = node.children[0]
    result = _expression(node, at, depth)
    start = result.span.start
    for link in reversed(links):
        span = Span(at.source, start, link.meta.end_pos)
        if link.data == "member":
            result = tree.Member(result, at.word(link.children[1]), span)
        elif link.data == "index":
            result = tree.Index(result, _items(link.children[1], at, depth), span)
        else:
            result = tree.Call(result, _arguments(link.children[1], at, depth), span)
    return result


def _items(node: Any, at: Place, depth: int) -> tuple[tree.Expression, ...]:
    return tuple(_expression(c, at, depth) for c in node.children)


def _arguments(node: Any, at: Place, depth: int) -> tuple[tree.Argument, ...]:
    found = []
    for child in node.children:
        if child.data in ("named", "kept"):
            *name, value = (_expression(c, at, depth) for c in child.children if hasattr(c, "data"))
            final = getattr(child.children[0], "type", "") == "FINAL"
            first = name[0] if name else value
            span = Span(at.source, first.span.start, value.span.end)
            found.append(tree.Argument(name[0] if name else None, value, span, final))
        else:
            value = _expression(child, at, depth)
            found.append(tree.Argument(None, value, value.span))
    return tuple(found)


def arguments(node: Any, at: Place) -> tuple[tree.Argument, ...]:
    """The arguments of a modifier list."""
    return _arguments(node, at, 0)


def _parenthesis(node: Any, at: Place, depth: int) -> tree.Expression:
    closing = node.children[-1]
    if getattr(closing, "type", "") != "CLOSE_UNIT":
        items = _items(node, at, depth)
        if len(items) == 1:
            return items[0]
        return tree.Tuple(items, "", None, at.span(node))
    items = tuple(_expression(c, at, depth) for c in node.children[:-1])
    unit = str(closing)[1:].strip()
    end = closing.end_pos
    return tree.Tuple(items, unit, Span(at.source, end - len(unit), end), at.span(node))


def _number(node: Any, at: Place, depth: int) -> tree.Expression:
    token = node.children[0]
    found = _LITERAL.fullmatch(str(token))
    digits = found["number"] if found else re.match(r"[\d.]+([eE][+-]?\d+)?", str(token))[0]  # type: ignore[index]
    unit = str(token)[len(digits) :].strip()
    span = at.span(token)
    unit_span = Span(at.source, span.end - len(unit), span.end) if unit else None
    return tree.Number(float(digits), digits.isdigit(), unit, unit_span, span)


def _text(node: Any, at: Place, depth: int) -> tree.Expression:
    token = node.children[0]
    return tree.Text(string(token), at.span(token))


def string(token: Any) -> str:
    """The value of a string token."""
    return re.sub(r"\\(.)", lambda m: _ESCAPES.get(m[1], m[1]), str(token)[1:-1])


def _truth(node: Any, at: Place, depth: int) -> tree.Expression:
    return tree.Truth(str(node.children[0]) == "true", at.span(node))


def _conditional(node: Any, at: Place, depth: int) -> tree.Expression:
    *pairs, found = (_expression(c, at, depth) for c in node.children)
    whole = at.span(node)
    for k in range(len(pairs) - 2, -1, -2):
        span = whole if k == 0 else Span(whole.source, pairs[k].span.start, whole.end)
        found = tree.Conditional(pairs[k], pairs[k + 1], found, span)
    return found


def _range(node: Any, at: Place, depth: int) -> tree.Expression:
    return tree.Range(_items(node, at, depth), at.span(node))


def _read_operators(node: Any, at: Place, depth: int) -> tree.Expression:
    """Precedence climbing with two stacks, so that a long sum takes no Python frames."""
    values: list[tree.Expression] = []
    pending: list[tuple[int, str, Span, bool]] = []

    def reduce_to(least: int) -> None:
        while pending and pending[-1][0] >= least:
            _, op, span, binary = pending.pop()
            right = values.pop()
            if not binary:
                values.append(tree.Prefix(op, right, Span(at.source, span.start, right.span.end)))
                continue
            left = values.pop()
            whole = Span(at.source, left.span.start, right.span.end)
            values.append(tree.Infix(op, left, right, span, whole))

    after_operator = False
    for child in node.children:
        if child.data == "sign":
            op = str(child.children[0])
            # After `*` or `^` a sign binds at once: 2*-x, x^-2.
            pending.append(
                (9 if after_operator and op != "not" else _SIGN[op], op, at.span(child), False)
            )
        elif child.data == "operator":
            op = str(child.children[0])
            binding = _BINDING[op]
            reduce_to(binding + 1 if op == "^" else binding)
            if op == "^" and refuse_power(at.log, values[-1], at.span(child)):
                raise Dropped
            pending.append((binding, op, at.span(child), True))
            after_operator = True
        else:
            values.append(_expression(child, at, depth + 1))
    reduce_to(0)
    return values[0]


def height(root: tree.Expression) -> int:
    """The number of levels of an expression, found without recursion; stops past HIGHEST."""
    level: list[tree.Expression] = [root]
    count = 0
    while level and count <= HIGHEST:
        count += 1
        level = [child for node in level for child in children(node)]
    return count


_BUILDERS: dict[str, Callable[[Any, Place, int], tree.Expression]] = {
    "name": _name,
    "member": _chain,
    "index": _chain,
    "call": _chain,
    "parenthesis": _parenthesis,
    "number": _number,
    "quantity": _number,
    "text": _text,
    "truth": _truth,
    "conditional": _conditional,
    "range": _range,
}
