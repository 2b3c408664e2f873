"""The way through expressions: their parts, each object in them once, and what they come to.

Functions are put in where they are called, as shared objects: an expression is a tree with parts
that stand at several places of it, and may have far more paths than objects.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any, ClassVar, Generic, TypeVar

from frot.dsl import checked

R = TypeVar("R")
# By the kind of expression, the method of a walk that says what it comes to.
Rules = Mapping[type, Callable[[Any, Any], Any]]


def parts(node: checked.Expression) -> tuple[checked.Expression, ...]:
    """The expressions directly inside an expression."""
    match node:
        case (
            checked.Element(operand=operand)
            | checked.Unary(operand=operand)
            | checked.Derivative(operand=operand)
        ):
            return (operand,)
        case checked.Vector(items=items) | checked.Call(arguments=items):
            return items
        case checked.Binary(left=left, right=right):
            return (left, right)
        case checked.If(condition=condition, yes=yes, no=no):
            return (condition, yes, no)
    return ()


def nodes(
    root: checked.Expression,
    inside: Callable[[checked.Expression], tuple[checked.Expression, ...]] = parts,
) -> Iterator[checked.Expression]:
    """The expression and everything in it, each object once, from left to right.

    `inside` says what counts as being in an expression.
    """
    seen: set[int] = set()
    pending = [root]
    while pending:
        node = pending.pop()
        if id(node) in seen:
            continue
        seen.add(id(node))
        yield node
        pending.extend(reversed(inside(node)))


def conjuncts(condition: checked.Expression) -> tuple[checked.Expression, ...]:
    """The conditions that `and` joins, one where it joins none."""
    if isinstance(condition, checked.Binary) and condition.op == "and":
        return (*conjuncts(condition.left), *conjuncts(condition.right))
    return (condition,)


def is_instant(condition: checked.Expression) -> bool:
    """Whether a condition holds at instants only: `sample(...)`, `initial()`."""
    return isinstance(condition, checked.Call) and condition.function in ("sample", "initial")


def height(root: checked.Expression, known: dict[int, tuple[checked.Expression, int]]) -> int:
    """The number of levels of an expression; `known` keeps those of what was met."""
    pending = [root]
    while pending:
        node = pending[-1]
        inner = parts(node)
        missing = [p for p in inner if id(p) not in known]
        if missing:
            pending += missing
            continue
        pending.pop()
        known[id(node)] = (node, 1 + max((known[id(p)][1] for p in inner), default=0))
    return known[id(root)][1]


class Walk(Generic[R]):
    """Evaluates expressions by a rule for each kind of them.

    A rule is a method; it asks with `of` for what the parts come to that it needs, and only those.
    """

    __slots__ = ()
    rules: ClassVar[Rules]

    def of(self, node: checked.Expression) -> R:
        """The value of an expression."""
        found: R = self.rules[type(node)](self, node)
        return found


class SharedWalk(Walk[R]):
    """As `Walk`; what stands at several places comes to one object, made once, kept in `done`."""

    __slots__ = ()
    done: dict[int, tuple[checked.Expression, R]]

    def of(self, node: checked.Expression) -> R:
        """The value of an expression."""
        found = self.done.get(id(node))
        if found is None:
            found = self.done[id(node)] = (node, self.rules[type(node)](self, node))
        return found[1]
