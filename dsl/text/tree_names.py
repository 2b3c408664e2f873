"""Walking through expressions of the tree."""

from __future__ import annotations

from collections.abc import Iterator

from frot.dsl.text import tree


def names_in(root: tree.Expression | None) -> Iterator[str]:
    """Every identifier an expression begins with, words of options included."""
    pending = [] if root is None else [root]
    while pending:
        node = pending.pop()
        if isinstance(node, tree.Name):
            yield node.text
        elif isinstance(node, tree.Call):
            # The callee is a function or a kind; it can share the name of a body.
            pending.extend(a.value for a in node.arguments)
        else:
            pending.extend(children(node))


def children(node: tree.Expression) -> tuple[tree.Expression, ...]:
    """The expressions directly inside an expression."""
    match node:
        case tree.Member(operand=operand) | tree.Prefix(operand=operand):
            return (operand,)
        case tree.Index(operand=operand, subscripts=subscripts):
            return (operand, *subscripts)
        case tree.Call(callee=callee, arguments=found):
            return (callee, *(a.value for a in found))
        case tree.Tuple(items=items) | tree.Range(items=items):
            return items
        case tree.Infix(left=left, right=right):
            return (left, right)
        case tree.Conditional(condition=condition, yes=yes, no=no):
            return (condition, yes, no)
    return ()
