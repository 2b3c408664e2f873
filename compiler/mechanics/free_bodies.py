"""Bodies free of each other: every liaison by its relations, as one counts them."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from frot.compiler.mechanics.constraint import Constraint
from frot.compiler.mechanics.liaisons.user_liaisons import bodies_of
from frot.compiler.mechanics.mechanism import Mechanism, relinked
from frot.compiler.mechanics.mechanize import link_of
from frot.compiler.mechanics.spanning import span
from frot.dsl import Log
from frot.dsl.checked import Liaison


def free(mechanism: Mechanism, wanted: Collection[Liaison]) -> Mechanism:
    """The same bodies, free of each other, with a row for each relation of the `wanted` liaisons.

    No liaison comes before another then, as a tree has it. Without laws, forces and readings; a
    liaison that coordinates alone can keep, a point on a parametric curve, is kept by them. Bodies
    that no wanted liaison holds are left out.
    """
    model, log = mechanism.model, Log()
    found = (link_of(x, model.planar, log) for x in model.liaisons if x in wanted)
    links = [link.without_friction() for link in found if link is not None]
    held = {body for link in links for body in link.bodies}
    held |= {b for link in links for x in link.liaison.relations for b in bodies_of(x)}
    own = replace(model, bodies=tuple(b for b in model.bodies if b in held))
    tree = span(own, [x for x in links if x.by_coordinates])
    rows: list[Constraint] = []
    ideal: list[Constraint] = []
    for link in links:
        if link.liaison in tree.kept:
            ideal.append(link.kept(True))
        else:
            rows += link.rows(True)
    kept = {x.liaison: x for x in ideal}
    return Mechanism(
        model=own,
        coordinates=relinked(tree.coordinates, kept),
        contacts=tuple(rows),
        ideal=tuple(ideal),
        forces=(),
        halves={},
        corners={},
    )
