"""The order of things of which each stands after what it needs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence


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
