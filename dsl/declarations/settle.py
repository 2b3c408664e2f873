"""Declarations that wait are checked, each after those it needs."""

from __future__ import annotations

from frot.dsl.checked.order import in_order
from frot.dsl.names.scope import REFUSED, Array, Build, Entity, Instance, Pending, settled


def settle_all(build: Build) -> list[Instance]:
    """Check every declaration of every component, each after those it needs; give them all."""
    done: list[Instance] = []
    while build.fresh:
        waiting, build.fresh = build.fresh, []
        for made in waiting:
            _settle(made, build)
            done.append(made)
    return done


def _settle(made: Instance, build: Build) -> None:
    needs = {n: p.needs for n, p in made.names.items() if isinstance(p, Pending)}
    order, _ = in_order(needs)
    for name in order:
        settled(made.names[name], name, made, build)


def entities(made: Instance) -> list[Entity]:
    """Everything declared in a component and its components, in the order written."""
    found: list[Entity] = []
    pending: list[Entity] = [made]
    while pending:
        entity = pending.pop()
        if isinstance(entity, Instance):
            inner = [e for e in entity.names.values() if not isinstance(e, Pending)]
            pending.extend(reversed([e for e in inner if e is not REFUSED]))  # type: ignore[misc]
        elif isinstance(entity, Array):
            pending.extend(reversed(entity.items))
        if entity is not made and not isinstance(entity, Array):
            found.append(entity)
    return found
