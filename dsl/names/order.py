"""The order in which declarations can be checked: each after those it names."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from frot.dsl.text import tree
from frot.dsl.text.build_expressions import children


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


def in_order(
    needs: Mapping[str, Sequence[str]],
) -> tuple[list[str], list[list[str]]]:
    """The names so that each stands after what it needs, and the circles found.

    Iterative: a chain of thousands of parameters takes no Python frames. The names of a circle are
    in the order too, where the circle is first met.
    """
    done: dict[str, bool] = {}
    order: list[str] = []
    circles: list[list[str]] = []
    for root in needs:
        if root in done:
            continue
        done[root] = False
        path = [(root, iter(needs[root]))]
        while path:
            name, rest = path[-1]
            for other in rest:
                if other not in needs:
                    continue
                if other not in done:
                    done[other] = False
                    path.append((other, iter(needs[other])))
                    break
                if not done[other]:
                    names = [n for n, _ in path]
                    circles.append(names[names.index(other) :])
            else:
                path.pop()
                done[name] = True
                order.append(name)
    return order, circles
