"""Candidates for first integrals: energy, momenta of bodies and of coordinates."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

import casadi as ca
from frot.compiler.equations.reduced import Reduced
from frot.compiler.mechanics.points import owner_body, point_body
from frot.compiler.mechanics.spatial import cross, nowhere, whole
from frot.compiler.symbolic.columns import scalars_of
from frot.compiler.translate.walk import is_fixed
from frot.dsl.checked import Body, BodyGeometry, BodyPoint, CurvePlace, Frame, Place, SurfacePlace
from frot.dsl.quantities.dimensions import Dimension, dimension

AXES = "xyz"
ENERGY, MOMENTUM, TURNING = (dimension(k, 1, -j) for k, j in ((2, 2), (1, 1), (2, 1)))
# Beyond so many bodies they are examined together only, beyond so many speeds no coordinate is.
_FEW_BODIES = 6
_FEW_SPEEDS = 20
_MOST_POINTS = 3


@dataclass(frozen=True, slots=True, eq=False)
class Candidate:
    """A function of the state that may be constant, in words."""

    text: str
    value: ca.SX
    dimension: Dimension


@dataclass(frozen=True, slots=True, eq=False)
class Twist:
    """Momentum (3) and angular momentum about the ground's origin (3) of some bodies together.

    `of` names the bodies, as an end of a text.
    """

    of: str
    momentum: ca.SX
    angular: ca.SX


@dataclass(frozen=True, slots=True, eq=False)
class Candidates:
    """Named candidates, the most significant first, and twists whose combinations are searched."""

    named: tuple[Candidate, ...]
    twists: tuple[Twist, ...]


def list_candidates(reduced: Reduced) -> Candidates:
    """All candidates."""
    mechanism = reduced.mechanism
    bodies = [b for b in mechanism.model.bodies if b.shape is not None]
    named: list[Candidate] = []
    twists: list[Twist] = []
    energy = reduced.motion.kinetic + reduced.motion.potential
    if bodies:
        named.append(Candidate("energy", energy, ENERGY))
    for group in _groups(reduced, bodies):
        of = "" if len(group) == len(bodies) else f" of {', '.join(b.name for b in group)}"
        found, twist = _momenta(reduced, group, of)
        named += found
        twists.append(twist)
    named += _of_coordinates(reduced)
    without_auxiliary = reduced.variables.without_auxiliary
    return Candidates(
        tuple(replace(c, value=without_auxiliary(c.value)) for c in named),
        tuple(
            replace(t, momentum=without_auxiliary(t.momentum), angular=without_auxiliary(t.angular))
            for t in twists
        ),
    )


def _groups(reduced: Reduced, bodies: list[Body]) -> Iterator[tuple[Body, ...]]:
    """All bodies; those that liaisons, or forces too, join; each alone."""
    model = reduced.mechanism.model
    joined = [(x.a, x.b) for x in model.liaisons]
    pulled = [
        tuple(a for a in f.arguments.values() if isinstance(a, BodyPoint | Frame))
        for f in model.forces
    ]
    seen: set[frozenset[Body]] = set()
    kinds = [[tuple(bodies)], _joined(bodies, [*joined, *pulled]), _joined(bodies, joined)]
    if len(bodies) <= _FEW_BODIES:
        kinds.append([(b,) for b in bodies])
    for group in (g for kind in kinds for g in kind):
        if group and frozenset(group) not in seen:
            seen.add(frozenset(group))
            yield group


def _joined(
    bodies: list[Body], pairs: Iterable[tuple[Place | BodyPoint | Frame, ...]]
) -> list[tuple[Body, ...]]:
    """Bodies in the groups that the pairs of places make, the ground joining nothing."""
    group = {body: {body} for body in bodies}
    for places in pairs:
        ends = [b for b in map(place_body, places) if b in group]
        for first, second in pairwise(ends):
            if group[first] is not group[second]:
                group[first] |= group[second]
                for body in group[second]:
                    group[body] = group[first]
    found = dict.fromkeys(frozenset(group[b]) for b in bodies)
    return [tuple(b for b in bodies if b in one) for one in found]


def place_body(place: Place | SurfacePlace) -> Body:
    """The body of a place of a liaison or force."""
    match place:
        case CurvePlace():
            return owner_body(place.curve.owner)
        case SurfacePlace():
            return owner_body(place.surface.owner)
        case BodyGeometry():
            return place.body
    return point_body(place)


def _momenta(reduced: Reduced, group: tuple[Body, ...], of: str) -> tuple[list[Candidate], Twist]:
    """Along the axes of the ground, about its points, about the centre of mass."""
    variables, planar = reduced.variables, reduced.mechanism.model.planar
    mass, first = ca.SX(0), nowhere()
    momentum, about_origin = nowhere(), nowhere()
    for body in group:
        moving = variables.kinematics.bodies[body]
        own = variables.mass(body)
        mass, first = mass + own, first + own * moving.pose.origin
        momentum += own * moving.linear
        spin = variables.inertia_in_ground(body) @ moving.angular
        about_origin += own * cross(moving.pose.origin, moving.linear) + spin
    ways = AXES[:2] if planar else AXES
    turns = AXES[2] if planar else AXES
    found = [Candidate(f"momentum along {e}{of}", momentum[AXES.index(e)], MOMENTUM) for e in ways]
    for name, point in _points(reduced):
        about = about_origin - cross(point, momentum)
        found += [
            Candidate(
                f"angular momentum about {e} through {name}{of}", about[AXES.index(e)], TURNING
            )
            for e in turns
        ]
    about = about_origin - cross(first / mass, momentum)
    centre = f"{group[0].name}.G" if len(group) == 1 else "the centre of mass"
    end = "" if len(group) == 1 else of
    found += [
        Candidate(
            f"angular momentum about {e} through {centre}{end}", about[AXES.index(e)], TURNING
        )
        for e in turns
    ]
    if len(group) == 1 and not planar and group[0].shape is not None and group[0].shape.turns:
        axes = variables.kinematics.pose(group[0]).axes
        found += [
            Candidate(
                f"angular momentum about {group[0].name}.e{e} through {centre}",
                ca.dot(axes[:, AXES.index(e)], about),
                TURNING,
            )
            for e in "zxy"
        ]
    return found, Twist(of, ca.densify(momentum), ca.densify(about_origin))


def _points(reduced: Reduced) -> list[tuple[str, ca.SX]]:
    """Points of the ground at which something is held or pulled, its origin first."""
    model = reduced.mechanism.model
    places = [x for liaison in model.liaisons for x in (liaison.a, liaison.b)]
    places += [
        a for f in model.forces for a in f.arguments.values() if isinstance(a, BodyPoint | Frame)
    ]
    found: dict[str, ca.SX] = {"the origin": nowhere()}
    for place in places:
        if not isinstance(place, Frame) or point_body(place).shape is not None:
            continue
        fixed = place.origin is not None and is_fixed(place.origin)
        if fixed and isinstance(place.owner, Body) and len(found) < _MOST_POINTS:
            assert place.origin is not None
            found.setdefault(
                place.name, whole(reduced.variables.kinematics.fixed.lower(place.origin))
            )
    return list(found.items())


def _of_coordinates(reduced: Reduced) -> Iterator[Candidate]:
    """The momenta that belong to the coordinates of the tree."""
    s = reduced.symbols
    if s.v.numel() > _FEW_SPEEDS:
        return
    mass, _ = reduced.motion.tree.in_full(
        reduced.motion.matrices.matrix, reduced.motion.matrices.force, s.v.numel()
    )
    speeds = scalars_of(s.v)
    momenta = scalars_of(mass[: len(speeds), : len(speeds)] @ s.v) if speeds else []
    names = scalars_of(s.q)
    for place, k in enumerate(s.q_speed):
        if k >= 0:
            name = names[place].name()
            turns = name.rpartition(".")[2].startswith("angle")
            unit = TURNING if turns else MOMENTUM
            yield Candidate(f"momentum of {name}", momenta[k], unit)
