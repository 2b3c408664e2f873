"""A circle of imports, of modules or folders."""

from __future__ import annotations

from collections.abc import Mapping


def circle(graph: Mapping[str, set[str]]) -> list[str]:
    """A closed way along the imports; empty if there is none."""
    done: set[str] = set()

    def visit(node: str, path: list[str]) -> list[str]:
        if node in path:
            return [*path[path.index(node) :], node]
        if node in done:
            return []
        for other in sorted(graph[node]):
            found = visit(other, [*path, node])
            if found:
                return found
        done.add(node)
        return []

    return next((c for c in (visit(node, []) for node in sorted(graph)) if c), [])
