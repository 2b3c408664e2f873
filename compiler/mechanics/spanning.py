"""The spanning tree: which liaison carries each body, and the coordinates that gives."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from frot.compiler.mechanics.mechanism import (
    Contact,
    Coordinates,
    FreeCoordinates,
    Joint,
    LineCoordinates,
    Pin,
    PinCoordinates,
    is_unilateral,
    owner_body,
    point_body,
)
from frot.dsl.checked import Body, Liaison, Model


@dataclass(frozen=True, slots=True, eq=False)
class Tree:
    """Coordinates, each body after the one it hangs on; the liaisons they keep; loops of pins."""

    coordinates: tuple[Coordinates, ...]
    kept: frozenset[Liaison]
    closing: tuple[Pin, ...]


def span(model: Model, joints: Iterable[Joint]) -> Tree:
    """Let pins join bodies to groups, and a point on a line carry a group that has no ground.

    In the order of the text: a pin within a group closes a loop; a group hangs on the first line
    that is not on itself or on what it carries; else its first body moves freely.
    """
    joints = tuple(joints)
    groups = _Groups((model.ground, *model.bodies))
    branches: dict[Body, list[tuple[Pin, Body]]] = {b: [] for b in (model.ground, *model.bodies)}
    closing: list[Pin] = []
    for pin in joints:
        if isinstance(pin, Pin):
            a, b = point_body(pin.a), point_body(pin.b)
            if groups.join(a, b):
                branches[a].append((pin, b))
                branches[b].append((pin, a))
            else:
                closing.append(pin)
    carried: dict[Body, Contact] = {}
    for contact in joints:
        if isinstance(contact, Contact) and _can_carry(contact):
            group = groups.of(point_body(contact.point))
            chain = _carriers(groups.of(owner_body(contact.line.owner)), carried, groups)
            if group is not groups.of(model.ground) and group not in carried and group not in chain:
                carried[group] = contact
    ordered: list[Coordinates] = []
    done: set[Body] = set()
    for body in model.bodies:
        for group in reversed(_carriers(groups.of(body), carried, groups)):
            if group not in done:
                done.add(group)
                ordered += _coordinates(group, carried.get(group), model, groups, branches)
    pins = (c.pin.liaison for c in ordered if isinstance(c, PinCoordinates))
    lines = (contact.liaison for contact in carried.values())
    return Tree(tuple(ordered), frozenset((*pins, *lines)), tuple(closing))


def _can_carry(contact: Contact) -> bool:
    return contact.liaison.kind.name == "point_courbe" and not is_unilateral(contact.liaison)


def _coordinates(
    group: Body,
    contact: Contact | None,
    model: Model,
    groups: _Groups,
    branches: dict[Body, list[tuple[Pin, Body]]],
) -> Iterator[Coordinates]:
    """Those of a group, from its root outwards."""
    if group is groups.of(model.ground):
        root = model.ground
    elif contact is not None:
        root = point_body(contact.point)
        yield LineCoordinates(root, contact.point, contact.line, contact.liaison)
    else:
        root = next(body for body in model.bodies if groups.of(body) is group)
        yield FreeCoordinates(root)
    reached, seen = [root], {root}
    for body in reached:
        for pin, other in branches[body]:
            if other not in seen:
                seen.add(other)
                reached.append(other)
                yield PinCoordinates(other, pin, other is point_body(pin.b))


def _carriers(group: Body, carried: dict[Body, Contact], groups: _Groups) -> list[Body]:
    """The group and those its coordinates hang on, one after another."""
    chain = [group]
    while group in carried:
        group = groups.of(owner_body(carried[group].line.owner))
        chain.append(group)
    return chain


class _Groups:
    """Bodies joined by pins; a group is known by one of its bodies."""

    def __init__(self, bodies: Iterable[Body]) -> None:
        self._above = {body: body for body in bodies}

    def of(self, body: Body) -> Body:
        while self._above[body] is not body:
            self._above[body] = self._above[self._above[body]]
            body = self._above[body]
        return body

    def join(self, a: Body, b: Body) -> bool:
        """Make one group of two; False if they were one already."""
        first, second = self.of(a), self.of(b)
        self._above[second] = first
        return first is not second
