"""Checked model to mechanism: what gives coordinates, what is a contact, what is refused."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from frot.compiler.mechanics.check_support import refuse_unknown
from frot.compiler.mechanics.constraint import Constraint
from frot.compiler.mechanics.geometry.closest_solved import can_touch
from frot.compiler.mechanics.geometry.contacts import Contact
from frot.compiler.mechanics.geometry.faces import part_faces
from frot.compiler.mechanics.geometry.figure import Placed
from frot.compiler.mechanics.geometry.figure_liaisons import IN_SPACE, in_plane, pair
from frot.compiler.mechanics.geometry.figures import figure_of
from frot.compiler.mechanics.geometry.nearest_with_ends import may_part
from frot.compiler.mechanics.geometry.planes import CordCircle, PointFigure
from frot.compiler.mechanics.geometry.space_contact import SpaceContact
from frot.compiler.mechanics.laws.law import REACTION
from frot.compiler.mechanics.laws.law_models import frictions_of
from frot.compiler.mechanics.laws.stops import is_stop
from frot.compiler.mechanics.liaisons.drives import free_drives, told_by_time
from frot.compiler.mechanics.liaisons.guides import with_guide
from frot.compiler.mechanics.liaisons.joint import Joint
from frot.compiler.mechanics.liaisons.joints import JOINTS, Pairing, let_go, make_joint
from frot.compiler.mechanics.liaisons.kinematic_relations import (
    OF_PLACES,
    OF_SPEEDS,
    drives_of,
    is_row,
)
from frot.compiler.mechanics.liaisons.split_bodies import halve
from frot.compiler.mechanics.liaisons.stop import stops_of
from frot.compiler.mechanics.liaisons.user_liaisons import Stated, with_unit_forces
from frot.compiler.mechanics.mechanism import (
    Mechanism,
    is_thread,
    is_unilateral,
    relinked,
)
from frot.compiler.mechanics.points import Point, is_particle
from frot.compiler.mechanics.refused_threads import refuses_thread
from frot.compiler.mechanics.spanning import span
from frot.compiler.mechanics.unsupported import refuse, refuse_places
from frot.compiler.translate.walk import read_quantities, subexpressions
from frot.dsl import Log
from frot.dsl.checked import (
    CurvePlace,
    Liaison,
    Literal,
    Model,
    Quantity,
    SurfacePlace,
)


def mechanize(model: Model, log: Log) -> Mechanism | None:
    """Build the mechanism; what the mechanics does not take yet is reported by name (E0701)."""
    faced = part_faces(model, log)
    if log.failed:
        return None
    model = faced.model
    refuse_unknown(model, (*JOINTS, *(in_plane() if model.planar else IN_SPACE)), log)
    if log.failed:
        return None
    model = free_drives(model)
    links = [e for x in model.liaisons if (e := link_of(x, model.planar, log)) is not None]
    _refuse_surface(model, links, log)
    if log.failed:
        return None
    halved = halve(model, links)
    tree = span(replace(model, bodies=(*model.bodies, *halved.halves)), halved.links)
    read = _read_liaisons(model)
    read |= {corner for x in read for corner in faced.corners.get(x, ())}
    chosen: list[Constraint] = []
    ideal: list[Constraint] = []
    for whole in halved.links:
        link = whole.kept(whole.liaison in tree.kept)
        silent = not link.frictions and link.liaison not in read
        if link.reduced and link.rolls:
            chosen += [x for x in link.rows(True) if not x.kinematic]
        if (link.reduced and silent) or not link.relation_count:
            ideal.append(link)
        elif link.reduced:
            chosen.append(link)
        else:
            rows = link.rows(link.liaison in model.liaisons)
            _refuse_lost(link, rows, log)
            chosen += rows
        chosen += stops_of(link, model.planar)
    if log.failed:
        return None
    kept = {x.liaison: x for x in (*chosen, *ideal) if x.whole is x}
    return Mechanism(
        model=model,
        coordinates=relinked(tree.coordinates, kept),
        contacts=tuple(chosen),
        ideal=tuple(ideal),
        forces=model.forces,
        halves=halved.halves,
        corners=faced.corners,
    )


def _refuse_lost(link: Constraint, rows: tuple[Constraint, ...], log: Log) -> None:
    """Friction that a liaison would lose where it is kept relation by relation."""
    if link.frictions and not any(row.frictions for row in rows):
        refuse(
            log,
            f"friction in a {link.liaison.kind.title} that closes a loop",
            link.liaison.span,
            "all liaisons of a loop cannot have friction: leave it out of one of them",
        )


def link_of(liaison: Liaison, planar: bool, log: Log) -> Constraint | None:
    """What a liaison joins and how, kept by nothing yet; None where that is reported."""
    if liaison.relations:
        return _stated(liaison, planar, log)
    if liaison.kind.name in JOINTS:
        return _joint(liaison, planar, log)
    figures = in_plane() if planar else IN_SPACE
    thread = is_thread(liaison)
    if thread and refuses_thread(liaison, log):
        return None
    if planar and thread:
        return _thread(liaison, log)
    one_place = liaison.kind.relations_space <= 1 and (thread or not liaison.kind.pin)
    if not planar and liaison.kind.along_curve and is_unilateral(liaison):
        log.report(
            "E0204",
            f"'unilateral' of '{liaison.name}': a curve in space holds a point from all sides",
            liaison.options["unilateral"].span,
            help="leave it out; what can part is a `contact_ponctuel` with a surface",
        )
        return None
    if not planar and liaison.kind.name in IN_SPACE and one_place and parts_or_rubs(liaison):
        return _space_contact(liaison, log)
    if liaison.kind.name in figures or "gap" in liaison.driven:
        return _placed(liaison, planar, log)
    return _contact(liaison, log)


def _joint(liaison: Liaison, planar: bool, log: Log) -> Joint | None:
    a, b, unilateral = liaison.a, liaison.b, liaison.options["unilateral"]
    name, told = liaison.kind.name, liaison.kind.title
    for place in (a, b):
        if not isinstance(place, Point):
            refuse_places(liaison, log)
            return None
    assert isinstance(a, Point) and isinstance(b, Point)
    if is_unilateral(liaison):
        log.report(
            "E0204",
            f"'unilateral' of '{liaison.name}': a {told} holds from all sides and cannot part",
            unilateral.span,
            help="leave it out; what can part is a `contact_ponctuel`, an `appui_faces` or a `fil`",
        )
        return None
    pairing = with_guide(JOINTS[name](liaison.options, planar), liaison, planar)
    joint = make_joint(liaison, a, b, pairing, told_by_time(liaison, planar))
    frictions = frictions_of(joint, log)
    return None if frictions is None else replace(joint, frictions=frictions)


def _stated(liaison: Liaison, planar: bool, log: Log) -> Joint | None:
    """A liaison of the user."""
    locks: list[Stated] = []
    for relation in liaison.relations:
        names = (*OF_PLACES, *(OF_SPEEDS if relation.kinematic else ()))
        for side in (relation.left, relation.right):
            for node in subexpressions(side):
                if isinstance(node, Quantity) and not _may_relate(node, names, relation.kinematic):
                    kind = "kinematic" if relation.kinematic else "geometric"
                    log.report(
                        "E0205",
                        f"a {kind} relation does not hold '{' '.join(node.span.text.split())}'",
                        node.span,
                        help=f"it may hold time, values, coordinates and: {', '.join(names)}",
                    )
                    return None
        if is_row(relation):
            locks.append(Stated(relation.left, relation.right, relation.kinematic))
    a, b = figure_of(liaison.a, planar), figure_of(liaison.b, planar)
    assert a is not None and b is not None  # points, as the text's check has seen to
    if not liaison.laws:
        return make_joint(liaison, a.point, b.point, Pairing((), tuple(locks), carries=False), {})
    if len(locks) < len(liaison.relations):
        refuse(
            log,
            f"friction of '{liaison.name}', a relation of which is an equation of the text,",
            liaison.laws[0].span,
            "its relations may hold places, velocities in the first power, time and parameters",
        )
        return None
    pairing = Pairing((), with_unit_forces(locks), carries=False)
    return _with_laws(make_joint(liaison, a.point, b.point, pairing, {}), planar, log)


def _with_laws(joint: Joint, planar: bool, log: Log) -> Joint | None:
    """A joint with its laws, which oppose what no coordinate counts; None where one is refused."""
    rubs = parts_or_rubs(joint.liaison)
    if rubs and joint.liaison.kind.pin and not joint.carries:
        if not joint.pressing:
            refuse(
                log,
                f"friction of '{joint.liaison.name}', whose length an equation prescribes,",
                joint.liaison.laws[0].span,
                "let the length follow time",
            )
            return None
        ends = tuple(k for k, body in enumerate(joint.bodies) if not is_particle(body))
        joint = replace(joint, pinned=ends, turnings=1 if planar else 2)
    elif rubs and not joint.carries and not joint.rolls:
        ways, turns = (2, 1) if planar else (3, 3)
        pressing = len(joint.pressing)
        twists = sum(x.presses is None for x in joint.locks)
        left = max(ways - pressing, 0), max(turns - twists, 0) if pressing == ways else 0
        joint = replace(joint, uncounted=left)
    frictions = frictions_of(joint, log)
    return None if frictions is None else replace(joint, frictions=frictions)


def _may_relate(node: Quantity, names: tuple[str, ...], kinematic: bool) -> bool:
    """Whether a relation may hold a variable: places and coordinates, or their rates too."""
    if not isinstance(node.owner, Liaison):
        return node.name in names
    rate = node.name in ("speed", "speed_angle", "angular_velocity", "slip")
    return node.name in node.owner.kind.coordinates and (kinematic or not rate)


def _placed(liaison: Liaison, planar: bool, log: Log) -> Joint | None:
    """A liaison between figures."""
    unilateral = liaison.options["unilateral"]
    if is_unilateral(liaison):
        refuse(
            log,
            f"a {liaison.kind.title} that can part" + ("" if planar else " in space"),
            unilateral.span if isinstance(unilateral, Literal) else liaison.span,
            "give it the ends where it presses: `coulomb(mu, half_length = ...)`, or a rod's axis"
            if liaison.kind.name == "lineaire_rectiligne"
            else "write `unilateral = false` where it keeps what it joins",
        )
        return None
    a, b = figure_of(liaison.a, planar), figure_of(liaison.b, planar)
    found = None
    if a is not None and b is not None:
        found = pair(liaison.kind.name, a, b, liaison.options, planar)
    if a is None or b is None or found is None:
        refuse_places(liaison, log)
        return None
    pairing, swapped = found
    first, second = (b.point, a.point) if swapped else (a.point, b.point)
    told = told_by_time(liaison, planar)
    pairing = let_go(pairing, drives_of(liaison).keys() - told.keys())
    joint = make_joint(liaison, first, second, pairing, told, swapped=swapped)
    return _with_laws(joint, planar, log)


def parts_or_rubs(liaison: Liaison) -> bool:
    """Whether a liaison between figures may part, or has friction."""
    return is_unilateral(liaison) or any(not is_stop(law) for law in liaison.laws)


def _space_contact(liaison: Liaison, log: Log) -> SpaceContact | None:
    """Two figures in space that touch at one place; a cord is the inside of a sphere."""
    a, b = _cord(liaison), figure_of(liaison.b, False)
    if not is_thread(liaison):
        a = figure_of(liaison.a, False)
    if a is None or b is None:
        refuse_places(liaison, log)
        return None
    orders = [(x, y) for x, y in ((a, b), (b, a)) if can_touch(x.figure, y.figure, False)]
    if not orders:
        refuse_places(liaison, log)
        return None
    parting = [pair for pair in orders if may_part(pair[0].figure, pair[1].figure)]
    exchanged = (parting or orders)[0] != (a, b)
    a, b = (parting or orders)[0]
    if is_unilateral(liaison) and not parting:
        refuse(
            log,
            f"a {liaison.kind.title} in space that can part, on a face or curve with ends",
            liaison.span,
            "use a `surface`: a plane or a sphere has no edge",
        )
        return None
    place = liaison.b if exchanged else liaison.a
    floor = isinstance(place, SurfacePlace) and place.surface.span is None
    contact = SpaceContact(
        liaison=liaison,
        a=a,
        b=b,
        floor=floor or is_thread(liaison),
        unilateral=liaison.options["unilateral"],
        exchanged=exchanged,
    )
    frictions = frictions_of(contact, log)
    return None if frictions is None else replace(contact, frictions=frictions)


def _cord(liaison: Liaison) -> Placed | None:
    """The place and the reach of a cord, None of other liaisons."""
    if not is_thread(liaison) or not isinstance(liaison.a, Point):
        return None
    return Placed(liaison.a, CordCircle(liaison.options["length"]))


def _contact(liaison: Liaison, log: Log) -> Contact | None:
    places = (liaison.a, liaison.b)
    figures = [figure_of(place, True) for place in places]
    first = next((k for k in (0, 1) if _is_contact(liaison, figures[k], figures[1 - k])), None)
    if first is None:
        refuse_places(liaison, log)
        return None
    track, rim = figures[first], figures[1 - first]
    assert track is not None and rim is not None
    place = places[first]
    contact = Contact(
        liaison=liaison,
        point=rim.point,
        figure=rim.figure,
        track=track,
        track_first=first == 0,
        floor=isinstance(place, CurvePlace) and place.curve.span is None,
        unilateral=liaison.options["unilateral"],
    )
    frictions = frictions_of(contact, log)
    return None if frictions is None else replace(contact, frictions=frictions)


def _thread(liaison: Liaison, log: Log) -> Contact | None:
    """What keeps b inside of a circle about a, whatever the place a turns with."""
    a, b, length = liaison.a, liaison.b, liaison.options["length"]
    if not (isinstance(a, Point) and isinstance(b, Point)):
        refuse_places(liaison, log)
        return None
    return Contact(
        liaison=liaison,
        point=b,
        figure=PointFigure(),
        track=Placed(a, CordCircle(length)),
        track_first=True,
        floor=False,
        unilateral=liaison.options["unilateral"],
    )


def _is_contact(liaison: Liaison, track: Placed | None, rim: Placed | None) -> bool:
    """Whether a figure can touch another; a point on a curve has the curve first."""
    if track is None or rim is None:
        return False
    on_curve = liaison.kind.along_curve
    if on_curve and track.figure.plane is not None and rim.figure.is_point:
        return True
    return can_touch(track.figure, rim.figure, True)


def _read_liaisons(model: Model) -> set[Liaison]:
    """Liaisons whose reaction an expression reads."""
    return {
        node.owner
        for node in read_quantities(model)
        if isinstance(node.owner, Liaison) and node.name in REACTION
    }


def _refuse_surface(model: Model, links: Iterable[Constraint], log: Log) -> None:
    """In the plane slip has a sign where there is one way to slip: at the surface of a pin, ..."""
    plain = {e.liaison for e in links if model.planar and not e.slips}
    for node in read_quantities(model):
        if node.owner in plain and node.name in ("slip", "tangential_force"):
            pin = node.owner.kind.name == "rotoide"
            why = "its pin has no radius" if pin else "it leaves no one way along which to slip"
            log.report(
                "E0203",
                f"no '{node.name}' on '{node.owner.name}': {why}",
                node.span,
                help="read `speed` or `torque`, or give the law `coulomb(..., radius = ...)`"
                if pin
                else "read `force`, or the velocities of the two places",
            )
