"""Connectors that equations hold open.

What nobody connects carries no flow. But where a model writes `r.p.v = u` itself, beside what
determines its own variables, that equation stands for a part connected there: the flow of `r.p` is
then whatever the equations make it. Which equations are left over is found by matching those of a
model with its own variables first, and then with its open connectors.
"""

from __future__ import annotations

from collections.abc import Iterator

from frot.dsl import checked
from frot.dsl.checked.walk import nodes
from frot.dsl.names.scope import Build, Instance
from frot.dsl.statements.equations import Made, count


def open_flows(made: list[Instance], equations: list[Made], build: Build) -> set[int]:
    """The identities of the flow variables that an equation from outside determines."""
    closed = build.connections.unconnected()
    outside = {
        owner
        for owner, named in build.named.items()
        if any(key in closed and _component(closed[key][0]) != owner for key in named)
    }
    if not outside:
        return set()
    connectors = _connectors(made, build)
    by_owner: dict[str, list[Made]] = {owner: [] for owner in outside}
    for equation in equations:
        if equation.owner in outside:
            by_owner[equation.owner].append(equation)
    found: set[int] = set()
    for owner, own in by_owner.items():
        found |= _left_over(own, [_named(e, owner, connectors) for e in own], closed)
    return found


def _connectors(made: list[Instance], build: Build) -> dict[int, Instance]:
    """The connector of each of its variables, flanges among them."""
    flanges = build.flange_instances.values()
    return {
        id(entity): instance
        for instance in (*(m for m in made if m.is_connector), *flanges)
        for entity in instance.names.values()
    }


def _expressions(equation: Made) -> Iterator[checked.Expression]:
    if isinstance(equation, checked.Equation):
        yield equation.left
        yield equation.right
        return
    for _, branch in equation.branches:
        for inner in branch:
            yield from _expressions(inner)


def _named(
    equation: Made, owner: str, connectors: dict[int, Instance]
) -> tuple[list[checked.Variable], list[Instance]]:
    """The variables of a model that an equation names, and the connectors of its components."""
    own: list[checked.Variable] = []
    parts: list[Instance] = []
    for root in _expressions(equation):
        for node in nodes(root):
            key = id(node.target) if isinstance(node, checked.Reference) else id(node)
            connector = connectors.get(key)
            if connector is not None:
                if _component(connector.name) != owner:
                    parts.append(connector)
            elif isinstance(node, checked.Reference) and isinstance(node.target, checked.Variable):
                own.append(node.target)
    return own, parts


def _component(connector: str) -> str:
    """The name of what a connector belongs to."""
    return connector.rpartition(".")[0]


def _left_over(
    equations: list[Made],
    named: list[tuple[list[checked.Variable], list[Instance]]],
    closed: dict[int, tuple[str, list[int]]],
) -> set[int]:
    """The flows matched with equations that no variable of the model needs."""
    wishes: list[list[int]] = []
    flows: list[list[int]] = []
    for equation, (variables, connectors) in zip(equations, named, strict=True):
        mine = [id(v) for v in variables if not v.discrete]
        open_ones = [f for c in connectors for f in closed.get(id(c), ("", []))[1]]
        for _ in range(min(count(equation), 100)):
            wishes.append(mine)
            flows.append(open_ones)
    taken: dict[int, int] = {}
    held = [0] * len(wishes)
    for k in range(len(wishes)):
        _augment(k, [wishes], taken, held)
    for k in range(len(wishes)):
        if k not in taken.values() and flows[k]:
            _augment(k, [wishes, flows], taken, held)
    every = {f for part in flows for f in part}
    return {key for key in taken if key in every}


def _augment(
    start: int, wishes: list[list[list[int]]], taken: dict[int, int], held: list[int]
) -> bool:
    """Give an equation a variable, moving others if need be (breadth first)."""
    came: dict[int, tuple[int, int]] = {}
    level = [start]
    seen: set[int] = set()
    while level:
        following: list[int] = []
        for equation in level:
            for part in wishes:
                for key in part[equation]:
                    if key in seen:
                        continue
                    seen.add(key)
                    came[key] = (equation, held[equation])
                    other = taken.get(key)
                    if other is None:
                        _shift(key, came, taken, held)
                        return True
                    following.append(other)
        level = following
    return False


def _shift(
    key: int, came: dict[int, tuple[int, int]], taken: dict[int, int], held: list[int]
) -> None:
    while key:
        equation, before = came[key]
        taken[key] = equation
        held[equation] = key
        key = before
