"""Bodies free of each other: every liaison by its relations, as one counts them."""

from __future__ import annotations

from collections.abc import Collection

from frot.compiler.mechanics.mechanism import (
    Contact,
    Joint,
    Link,
    Mechanism,
    Relation,
    point_body,
    relinked,
)
from frot.compiler.mechanics.mechanize import link_of
from frot.compiler.mechanics.spanning import span
from frot.dsl import Log
from frot.dsl.checked import Body, Liaison
from frot.dsl.data.classes import replace


def free(mechanism: Mechanism, wanted: Collection[Liaison]) -> Mechanism:
    """The same bodies, free of each other, with a row for each relation of the `wanted` liaisons.

    No liaison comes before another then, as a tree has it. Without laws, forces and readings; a
    liaison that coordinates alone can keep, a point on a parametric curve, is kept by them. Bodies
    that no wanted liaison holds are left out.
    """
    model, log = mechanism.model, Log()
    found = (link_of(x, model.planar, log) for x in model.liaisons if x in wanted)
    links = [_lawless(link) for link in found if link is not None]
    held = {body for link in links for body in _ends(link)}
    own = replace(model, bodies=tuple(b for b in model.bodies if b in held))
    tree = span(own, [x for x in links if _needs_coordinates(x)])
    rows: list[Link] = []
    ideal: list[Contact | Joint] = []
    for link in links:
        if link.liaison in tree.kept:
            ideal.append(replace(link, reduced=True))
        elif isinstance(link, Contact):
            rows.append(link)
        else:
            rows += [Relation(link, lock, k == 0) for k, lock in enumerate(link.locks)]
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


def _lawless(link: Contact | Joint) -> Contact | Joint:
    if isinstance(link, Contact):
        return replace(link, mu=None, mu_s=None, delta=None)
    return replace(link, mu=None, mu_s=None, radius=None)


def _ends(link: Contact | Joint) -> tuple[Body, Body]:
    if isinstance(link, Contact):
        return point_body(link.point), point_body(link.track.point)
    return point_body(link.a), point_body(link.b)


def _needs_coordinates(link: Contact | Joint) -> bool:
    if isinstance(link, Contact):
        follows = link.liaison.kind.name == "point_courbe"
        figure = link.track.figure
        return follows and figure.plane is None and not figure.is_round
    return any(lock.by_coordinates for lock in link.locks)
