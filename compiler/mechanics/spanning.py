"""The spanning tree: which liaison carries each body, and the coordinates that gives."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from frot.compiler.mechanics.constraint import Constraint, JointParts
from frot.compiler.mechanics.liaisons.motion import Motion
from frot.compiler.mechanics.liaisons.orientations import Attitude, Heading, Pointing, Steady
from frot.compiler.mechanics.liaisons.rolling_on_planes import can_roll
from frot.compiler.mechanics.liaisons.translations import Slide
from frot.compiler.mechanics.mechanism import Hanging, is_driven, is_slender
from frot.compiler.mechanics.points import Point, point_body, turns
from frot.compiler.mechanics.values import Axis
from frot.dsl.checked import Body, Liaison, Model


@dataclass(frozen=True, slots=True, eq=False)
class SpanningTree:
    """Coordinates, each body after the one it hangs on; the liaisons they keep."""

    coordinates: tuple[Hanging, ...]
    kept: frozenset[Liaison]


def span(model: Model, links: Iterable[Constraint]) -> SpanningTree:
    """Let joints join bodies to groups, and a point on a line carry a group that has no ground.

    Joints with friction come first, then those that lock most, then the order of the text: what
    closes a loop costs a row for each lock. A group hangs on the first line, or on the plane on
    which it rolls, that is not on itself or on what it carries; else its first body moves freely.
    """
    links = tuple(links)
    bodies = (model.ground, *model.bodies)
    groups = Groups(bodies)
    branches: dict[Body, list[tuple[JointParts, Body]]] = {b: [] for b in bodies}
    for joint in in_order(links):
        a, b = point_body(joint.a), point_body(joint.b)
        if groups.join(a, b):
            branches[a].append((joint, b))
            branches[b].append((joint, a))
    closing = [x for x in links if not any(x is joint for b in branches.values() for joint, _ in b)]
    carried: dict[Body, Constraint] = {}
    for link in closing:
        if link.can_carry or _can_roll(link, closing, groups, model):
            base, own = link.bodies
            group = groups.of(own)
            chain = _carriers(groups.of(base), carried, groups)
            if group is not groups.of(model.ground) and group not in carried and group not in chain:
                carried[group] = link
    builder = _Builder(model, groups, branches, carried)
    ordered: list[Hanging] = []
    done: set[Body] = set()
    for body in model.bodies:
        for group in reversed(_carriers(groups.of(body), carried, groups)):
            if group not in done:
                done.add(group)
                ordered += builder.hang(group)
    return SpanningTree(
        tuple(ordered), frozenset(h.link.liaison for h in ordered if h.link is not None)
    )


def in_order(links: Iterable[Constraint]) -> list[JointParts]:
    """The joints in the order in which they join bodies."""
    joints = (x.joint for x in links if x.joint is not None and x.joint.carries)
    return sorted(joints, key=lambda x: (not x.frictions, -len(x.locks)))


def _can_roll(
    link: Constraint, closing: Iterable[Constraint], groups: Groups, model: Model
) -> bool:
    """Whether it rolls, and no other row keeps a place of the bodies that it would carry."""
    joint = link.joint
    if joint is None or joint.frictions or not can_roll(joint) or is_driven(model):
        return False
    group = groups.of(link.bodies[1])
    others = (x for x in closing if x is not link and x.keeps_places)
    return not any(groups.of(body) is group for x in others for body in x.bodies)


@dataclass(frozen=True, slots=True, eq=False)
class _Builder:
    model: Model
    groups: Groups
    branches: dict[Body, list[tuple[JointParts, Body]]]
    carried: dict[Body, Constraint]

    def hang(self, group: Body) -> Iterator[Hanging]:
        """Coordinates of a group, from its root outwards."""
        if group is self.groups.of(self.model.ground):
            root = self.model.ground
        elif group in self.carried:
            link = self.carried[group]
            _, root = link.bodies
            yield self._hanging(root, link, *link.ends, link.carrying())
        else:
            root = next(b for b in self.model.bodies if self.groups.of(b) is group)
            ways = "xy" if self.model.planar else "xyz"
            slides = tuple(Slide(Axis(k), coordinates=(f"position.{k}",)) for k in ways)
            yield self._hanging(root, None, None, None, slides)
        reached, seen = [root], {root}
        for body in reached:
            for joint, other in self.branches[body]:
                if other in seen:
                    continue
                seen.add(other)
                reached.append(other)
                if other is point_body(joint.b):
                    yield self._jointed(other, joint, joint.a, joint.b, joint.motions)
                else:
                    back = tuple(m.reversed() for m in reversed(joint.motions))
                    yield self._jointed(other, joint, joint.b, joint.a, back)

    def _jointed(
        self, body: Body, joint: JointParts, base: Point, own: Point, motions: tuple[Motion, ...]
    ) -> Hanging:
        """Of a body in a joint: a particle has only the ways that the joint leaves."""
        ends = (point_body(base), body)
        if all(turns(b) or b.shape is None for b in ends) or (
            turns(body) and all(m.bare.hinges for m in motions)
        ):
            chosen = tuple(self._orient(body) if m.faces_ground else m for m in motions)
            return self._named(body, joint, base, own, chosen)
        ways = tuple(m for m in motions if not m.bare.turns)
        return self._hanging(body, joint, base, own, ways)

    def _hanging(
        self,
        body: Body,
        link: Constraint | None,
        base: Point | None,
        own: Point | None,
        ways: tuple[Motion, ...],
    ) -> Hanging:
        """Of a body whose orientation nothing keeps, and which a motion may give."""
        oriented = bool(ways) and ways[-1].faces_ground
        return self._named(body, link, base, own, ways if oriented else (*ways, self._orient(body)))

    def _orient(self, body: Body) -> Motion:
        if not turns(body):
            return Steady()
        if self.model.planar:
            return Heading()
        return Pointing() if is_slender(body, self.model) else Attitude()

    def _named(
        self,
        body: Body,
        link: Constraint | None,
        base: Point | None,
        own: Point | None,
        motions: tuple[Motion, ...],
    ) -> Hanging:
        names: list[str] = []
        speeds: list[str] = []
        for motion in motions:
            of_body = link is None or motion.faces_ground
            owner = body.name if of_body else link.liaison.name  # type: ignore[union-attr]
            names += [f"{owner}.{name}" for name in motion.coordinates]
            rates = [f"der({owner}.{name})" for name in motion.coordinates]
            own_speeds = [f"{owner}.{name}" for name in motion.speeds] or rates
            speeds += own_speeds[: motion.speed_count]
        return Hanging(body, link, base, own, motions, tuple(names), tuple(speeds))


def _carriers(group: Body, carried: dict[Body, Constraint], groups: Groups) -> list[Body]:
    """The group and those its coordinates hang on, one after another."""
    chain = [group]
    while group in carried:
        base, _ = carried[group].bodies
        group = groups.of(base)
        chain.append(group)
    return chain


class Groups:
    """Bodies joined by joints; a group is known by one of its bodies."""

    def __init__(self, bodies: Iterable[Body]) -> None:
        self._above = {body: body for body in bodies}

    def of(self, body: Body) -> Body:
        """The body a group is known by."""
        while self._above[body] is not body:
            self._above[body] = self._above[self._above[body]]
            body = self._above[body]
        return body

    def join(self, a: Body, b: Body) -> bool:
        """Make one group of two; False if they were one already."""
        first, second = self.of(a), self.of(b)
        self._above[second] = first
        return first is not second
