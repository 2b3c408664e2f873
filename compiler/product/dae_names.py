"""The names of the scalars of the DAE's vectors."""

from __future__ import annotations

from dataclasses import dataclass

from frot.compiler.equations.assembled import Assembled
from frot.compiler.product.dae_switching import GUARDS, PARTS, Switch, reads_of_closed
from frot.compiler.symbolic.columns import scalars_of


@dataclass(frozen=True, slots=True)
class Names:
    """Names in the order of the functions' vectors; all values are in SI.

    `fired` are the conditions that `update` asks for, by their names in `mode`.
    """

    x: tuple[str, ...]
    z: tuple[str, ...]
    u: tuple[str, ...]
    p: tuple[str, ...]
    mode: tuple[str, ...]
    guards: tuple[str, ...]
    invariants: tuple[str, ...]
    fired: tuple[str, ...]
    outcomes: tuple[str, ...]


def names_of(system: Assembled, switches: list[Switch]) -> Names:
    """The names in the order of the functions' vectors."""
    reduced, read = system.reduced, reads_of_closed(system, switches)
    conditions = tuple(f"condition_{k + 1}" for k in range(len(reduced.conditions.flags)))
    speeds = [x.name() for x in scalars_of(system.v)]
    unknowns = scalars_of(system.z)[system.nv + system.na :]
    return Names(
        x=system.names,
        z=(
            *(f"der({name})" for name in speeds),
            *(x.name() for x in unknowns),
            *(label for w in switches for label in w.labels),
            *(x.name() for x in scalars_of(system.y)),
        ),
        u=tuple(i.name for i in reduced.symbols.inputs),
        p=tuple(p.name for p in reduced.symbols.parameters),
        mode=(
            *(f"{w.name}.{part}" for w in switches if w.ruled for part in PARTS),
            *conditions,
            *(f"{link.liaison.name}.side" for link in reduced.mechanism.contacts if link.opens),
            *(x.name() for k, x in enumerate(scalars_of(system.discrete)) if k not in read),
        ),
        guards=(
            *(f"{w.name}.{part}" for w in switches if w.ruled for part in GUARDS),
            *conditions,
        ),
        invariants=tuple(origin.text for origin in system.invariants.origins),
        fired=tuple(conditions[k] for k in reduced.events.conditions),
        outcomes=tuple(outcome.text for outcome in reduced.events.outcomes),
    )
