"""The differentiated equations in the order in which they can be solved: strong components."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from graphlib import TopologicalSorter

from frot.compiler.equations.structure.sparse import strong_components


@dataclass(frozen=True, slots=True)
class Component:
    """Equations that determine as many unknowns together; `needs` are earlier components."""

    equations: tuple[int, ...]
    unknowns: tuple[int, ...]
    needs: tuple[int, ...]


def find_components(uses: Sequence[Sequence[int]], solves: Sequence[int]) -> list[Component]:
    """The strong components, each after those it needs.

    `uses[i]` are the unknowns that equation i holds (highest derivatives only), `solves[i]` the one
    it is matched with.
    """
    count = len(uses)
    if count == 0:
        return []
    solver = {j: i for i, j in enumerate(solves)}
    edges = [[solver[j] for j in row if solver[j] != i] for i, row in enumerate(uses)]
    number, labels = strong_components(edges)
    members: list[list[int]] = [[] for _ in range(number)]
    needs: list[set[int]] = [set() for _ in range(number)]
    for i in range(count):
        members[labels[i]].append(i)
        needs[labels[i]].update(labels[k] for k in edges[i] if labels[k] != labels[i])
    order = list(TopologicalSorter(dict(enumerate(needs))).static_order())
    place = {label: k for k, label in enumerate(order)}
    return [
        Component(
            tuple(members[label]),
            tuple(solves[i] for i in members[label]),
            tuple(sorted(place[n] for n in needs[label])),
        )
        for label in order
    ]


def closure(start: set[int], neighbours: Sequence[Sequence[int]]) -> set[int]:
    """Everything reached from `start`, itself included."""
    seen = set(start)
    pending = list(start)
    while pending:
        for k in neighbours[pending.pop()]:
            if k not in seen:
                seen.add(k)
                pending.append(k)
    return seen
