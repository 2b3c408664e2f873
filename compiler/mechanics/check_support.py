"""What the mechanics does not take yet, told by name (E0701), and what has no meaning in it."""

from __future__ import annotations

from collections.abc import Collection
from fractions import Fraction

from frot.compiler.mechanics.points import turns
from frot.compiler.translate.walk import (
    follows_time,
    is_fixed,
    is_given,
    subexpressions,
)
from frot.dsl import Log
from frot.dsl.checked import (
    BodyPoint,
    Curve,
    Expression,
    Force,
    Law,
    Liaison,
    Literal,
    Model,
    Place,
    Quantity,
    Reference,
    Surface,
)
from frot.dsl.messages.source import Span
from frot.dsl.quantities.dimensions import dimension

PLANE_LIAISONS = ("point_courbe", "contact_ponctuel", "courbe_courbe")
LAWS = ("coulomb", "rolling_resistance")
# Laws of friction of one liaison: the kernel's FROT_LAWS_OF_CONTACT.
MOST_LAWS = 2
_ONE_CONTACT = "a law of one's own acts in a `contact_ponctuel` or a `point_courbe` of the plane"
REACTION = ("force", "torque", "normal_force", "tangential_force", "power", "mode")


def refuse_unknown(model: Model, ideal: Collection[str], log: Log) -> None:
    """Tell every kind, law, force and option of the model that has no mechanics yet.

    `ideal` are the kinds of liaisons that take no laws, but for a pin.
    """
    _refuse_geometry(model, log)
    known = (*ideal, *(PLANE_LIAISONS if model.planar else ()))
    for liaison in model.liaisons:
        if liaison.kind.name not in known and not liaison.relations:
            where = "" if model.planar else " in space"
            refuse(
                log,
                f"the liaison '{liaison.kind.name}'{where}",
                liaison.span,
                _one_of("liaisons", known),
            )
        _refuse_options(liaison, log)
        for law in liaison.laws:
            _refuse_law(liaison, law, model.planar, liaison.kind.name in ideal, log)
        _refuse_many_laws(liaison, log)
    for force in model.forces:
        if force.kind.name == "couple":
            _refuse_couple(force, log)
        if force.kind.name == "drag":
            _refuse_drag(force, log)
    allowed = ("auto", "explicit", "implicit")
    if model.experiment.method not in allowed:
        refuse(
            log,
            f"the method '{model.experiment.method}'",
            model.experiment.span,
            f"{', '.join(f'`{method}`' for method in allowed)} are",
        )


def _refuse_geometry(model: Model, log: Log) -> None:
    """Shapes, frames, directions and gravity follow time and parameters, and time smoothly.

    What else moves is a body, and carries what is fixed to it.
    """
    gravity = model.world.gravity
    if gravity is not None:
        assert model.world.span is not None
        _follow_time("gravity", gravity, log, span=model.world.span)
    for body in model.bodies:
        for name, argument in body.arguments.items():
            if not is_fixed(argument):
                log.report(
                    "E0522",
                    f"'{name}' of body '{body.name}' changes, but a body keeps its mass and form",
                    argument.span,
                    help="let it follow parameters alone, and write forces for what mass that "
                    "comes or goes does",
                )
    shapes: tuple[Curve | Surface, ...] = (*model.curves, *model.surfaces)
    own = set(model.variables)
    for shaped in shapes:
        kind = "curve" if isinstance(shaped, Curve) else "surface"
        for name, argument in shaped.arguments.items():
            of_text = {
                node.target
                for node in subexpressions(argument)
                if isinstance(node, Reference) and node.target in own
            }
            what = f"'{name}' of {kind} '{shaped.name}'"
            _follow_time(what, argument, log, "" if of_text else "uvxyz")
    for frame in model.frames:
        for what, value in (("place", frame.origin), ("angle", frame.angle), ("axis", frame.axis)):
            if isinstance(value, Expression):
                _follow_time(f"the {what} of frame '{frame.name}'", value, log)


def _follow_time(
    what: str, value: Expression, log: Log, places: str = "", span: Span | None = None
) -> None:
    """Report a value of anything but time, and one that switches; `places` as `follows_time`."""
    if is_fixed(value) or follows_time(value, places):
        return
    if follows_time(value, places, switching=True):
        log.report(
            "E0522",
            f"{what} switches: what follows it would jump, or be hit where its slope jumps",
            span or value.span,
            help="write a form without switches, or one curve or surface for each part",
        )
        return
    log.report(
        "E0522",
        f"{what} follows other than time and parameters",
        span or value.span,
        help="put it on a body that moves so: a liaison can drive that by any value",
    )


def _refuse_options(liaison: Liaison, log: Log) -> None:
    """Directions and pitches may change as time tells; a length that moves otherwise is driven."""
    for argument in liaison.kind.arguments:
        value = liaison.options.get(argument.name)
        if value is None or is_given(value) or argument.name in liaison.kind.coordinates:
            continue
        _follow_time(f"'{argument.name}' of {spelled(liaison)} '{liaison.name}'", value, log)


def _refuse_law(liaison: Liaison, law: Law, planar: bool, ideal: bool, log: Log) -> None:
    if "gap" in liaison.driven:
        log.report(
            "E0511",
            f"the law '{law.kind.name}' of '{liaison.name}', whose gap is driven: what is apart "
            "has no friction",
            law.span,
            help="leave out the law, or the drive",
        )
        return
    if "tangential" in law.arguments:
        if not planar or liaison.kind.name not in PLANE_LIAISONS:
            where = f"of a {spelled(liaison)}" + ("" if planar else " in space")
            refuse(log, f"the law '{law.kind.name}' {where}", law.span, _ONE_CONTACT)
        return
    if law.kind.name not in LAWS:
        refuse(log, f"the law '{law.kind.name}'", law.span, _one_of("laws", LAWS))
        return
    if not planar:
        refuse(log, f"the law '{law.kind.name}' in space", law.span, "planar models take it")
        return
    pin = liaison.kind.name == "rotoide"
    if (ideal or liaison.relations) and not (pin and law.kind.name == "coulomb"):
        kind = spelled(liaison)
        refuse(log, f"the law '{law.kind.name}' of a {kind}", law.span, "`coulomb` of a rotoïde is")
        return
    for name in ("half_length",) if pin else ("radius", "half_length"):
        if name in law.arguments:
            refuse(log, f"'{name}' of the law '{law.kind.name}'", law.arguments[name].span)
    if pin and "radius" in law.arguments and not is_fixed(law.arguments["radius"]):
        refuse(log, "a radius that depends on time or motion", law.arguments["radius"].span)
    for argument in law.arguments.values():
        for node in subexpressions(argument):
            if isinstance(node, Quantity) and node.name in (
                "velocity",
                "acceleration",
                "slip",
                "angular_velocity",
                "angular_acceleration",
                "speed",
                *REACTION,
            ):
                refuse(
                    log,
                    f"a coefficient that depends on '{node.name}'",
                    node.span,
                    "coefficients may depend on positions and time",
                )


def _refuse_many_laws(liaison: Liaison, log: Log) -> None:
    """Report more laws of friction than the kernel solves for in one liaison."""
    dry = [law for law in liaison.laws if law.kind.name in LAWS]
    if len(dry) <= MOST_LAWS:
        return
    names = ", ".join(f"'{law.kind.name}'" for law in dry)
    refuse(
        log,
        f"liaison '{liaison.name}' with the laws {names}, more than {MOST_LAWS} of friction,",
        dry[MOST_LAWS].span,
        f"leave out all but {MOST_LAWS}, or give the others to another liaison of the bodies",
    )


def _refuse_couple(force: Force, log: Log) -> None:
    holder = force.arguments["holder"]
    if isinstance(holder, Liaison):
        if "angle" not in holder.kind.coordinates:
            log.report(
                "E0205",
                f"liaison '{holder.name}' has no angle that a couple could drive",
                force.span,
                help="a couple acts in a liaison with an angle, or on a body",
            )
    elif isinstance(holder, BodyPoint) and not turns(holder.body):
        log.report(
            "E0205",
            f"a couple on '{holder.body.name}', which does not turn",
            force.span,
            help="name a body that turns, or a `rotoide`",
        )


def _refuse_drag(force: Force, log: Log) -> None:
    """The exponent is a number, for the unit of the coefficient follows from it."""
    exponent, c = force.arguments["exponent"], force.arguments["c"]
    assert not isinstance(exponent, Place | Liaison) and not isinstance(c, Place | Liaison)
    if not (isinstance(exponent, Literal) and float(exponent.value) >= 1):
        log.report(
            "E0305",
            "the exponent of a drag is a number, 1 or more: the unit of c follows from it",
            exponent.span,
            help="write `exponent = 2`; for another law write a force `on` the body",
        )
        return
    power = Fraction(float(exponent.value)).limit_denominator(1000)
    unit = dimension(m=1, kg=1, s=-2) / dimension(m=1, s=-1) ** power
    if c.type.dimension != unit:
        log.report(
            "E0301",
            f"c of a drag with exponent {exponent.value:g} is in {unit.unit}",
            c.span,
            help="give the other exponent, or c in that unit",
        )


_JOINED = {
    "appui_faces": "it takes a face of a box, or a side of a polygon, and a plane or line",
    "contact_ponctuel": "by one relation touch a point and a surface, and any two of curve, rim "
    "and surface; two points are a `spherique`, a point and a curve in space a `point_courbe`, a "
    "line on a plane a `lineaire_rectiligne`, two planes an `appui_plan`",
    "courbe_courbe": "it takes two curves or rims, not both straight",
    "lineaire_annulaire": "it takes a point and a straight line, or two points with `axis`",
    "lineaire_rectiligne": "it takes a straight line and a plane",
    "point_courbe": "it takes a point, then a curve",
    "point_surface": "it takes a point, then a surface",
    "roulement": "it takes two of curve, rim and surface",
}


def refuse_places(liaison: Liaison, log: Log) -> None:
    """Tell that a liaison of this kind has no meaning between its two places."""
    name = spelled(liaison)
    message = f"liaison '{liaison.name}': {name} does not join these two places"
    help_text = _JOINED.get(liaison.kind.name, "name a body, a point of one or a frame")
    log.report("E0205", message, liaison.span, help=help_text)


def spelled(liaison: Liaison) -> str:
    """The French name of its type with its accents, for sentences."""
    accents = {"rotoide": "rotoïde", "spherique": "sphérique", "helicoidale": "hélicoïdale"}
    return accents.get(liaison.kind.name, liaison.kind.name)


def refuse(log: Log, what: str, span: Span | None, help: str = "") -> None:
    """Tell what is not supported yet, with a remedy."""
    log.report("E0701", f"{what} is not supported yet", span, help=help)


def _one_of(what: str, names: tuple[str, ...]) -> str:
    return f"supported {what}: {', '.join(names)}"
