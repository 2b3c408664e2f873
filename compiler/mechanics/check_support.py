"""What the mechanics does not support yet (E0701), and what has no meaning in it."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from frot.compiler.mechanics.laws.law_models import check_laws
from frot.compiler.mechanics.points import is_particle, point_body
from frot.compiler.mechanics.unsupported import one_of, refuse
from frot.compiler.translate.walk import (
    follows_time,
    is_fixed,
    is_given,
    subexpressions,
)
from frot.dsl import Log
from frot.dsl.catalogue import LIAISONS
from frot.dsl.checked import (
    BodyPoint,
    Curve,
    Expression,
    Force,
    Frame,
    Liaison,
    Model,
    Reference,
    Surface,
)
from frot.dsl.messages.source import Span


def refuse_unknown(model: Model, ideal: Collection[str], log: Log) -> None:
    """Report every kind, law, force and option of the model that has no mechanics yet.

    `ideal` are the kinds of liaisons that take no laws, but for a pin.
    """
    _refuse_geometry(model, log)
    contacts = (kind.name for kind in LIAISONS.values() if kind.in_plane == "contact")
    known = (*ideal, *(contacts if model.planar else ()))
    for liaison in model.liaisons:
        if liaison.kind.name not in known and not liaison.relations:
            where = "" if model.planar else " in space"
            refuse(
                log,
                f"the liaison '{liaison.kind.name}'{where}",
                liaison.span,
                one_of("liaisons", known),
            )
        _refuse_options(liaison, log)
        _refuse_turning(liaison, log)
        check_laws(liaison, model.planar, liaison.kind.name in known, log)
    _check_forces(model.forces, log)
    allowed = ("auto", "explicit", "implicit")
    if model.experiment.method not in allowed:
        refuse(
            log,
            f"the method '{model.experiment.method}'",
            model.experiment.span,
            f"{', '.join(f'`{method}`' for method in allowed)} are",
        )


def _check_forces(forces: Sequence[Force], log: Log) -> None:
    """What arguments of forces have no meaning; the models of forces need CasADi."""
    if not forces:
        return
    from frot.compiler.mechanics.forces.force_models import FORCE_MODELS

    for force in forces:
        FORCE_MODELS[force.kind.name].check(force, log)


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


def _refuse_turning(liaison: Liaison, log: Log) -> None:
    """What does not turn has no angular velocity to drive."""
    for place in (liaison.a, liaison.b):
        if "angular_velocity" in liaison.driven and isinstance(place, BodyPoint | Frame):
            body = point_body(place)
            if is_particle(body):
                log.report(
                    "E0511",
                    f"the angular velocity of '{liaison.name}' is driven, but '{body.name}' is a "
                    "particle and does not turn",
                    liaison.driven["angular_velocity"].span,
                    help="use a shape that turns, or drive coordinates of its place",
                )


def _refuse_options(liaison: Liaison, log: Log) -> None:
    """Directions and pitches may change as time tells; a length that moves otherwise is driven."""
    for argument in liaison.kind.arguments:
        value = liaison.options.get(argument.name)
        if value is None or is_given(value) or argument.name in liaison.kind.coordinates:
            continue
        _follow_time(f"'{argument.name}' of {liaison.kind.title} '{liaison.name}'", value, log)
