"""Checked model to mechanism: what gives coordinates, what is a contact, what is refused."""

from __future__ import annotations

from dataclasses import replace

from frot.compiler.mechanism import Contact, Element, Mechanism, Pin, Point, point_body, turns
from frot.compiler.spanning import span
from frot.compiler.walk import is_fixed, read_expressions, subexpressions
from frot.dsl import Log
from frot.dsl.checked import (
    Body,
    BodyGeometry,
    BodyPoint,
    Curve,
    CurvePlace,
    Expression,
    Force,
    Law,
    Liaison,
    Literal,
    Model,
    Quantity,
)
from frot.dsl.source import Span

SHAPES = ("particle", "ring", "disc", "rod")
LIAISONS = ("point_courbe", "contact_ponctuel", "rotoide")
LAWS = ("coulomb", "rolling_resistance")
FORCES = ("attraction", "couple", "damper", "drag", "on", "spring")
ROUND = ("ring", "disc")
REACTION = ("force", "torque", "normal_force", "tangential_force", "power", "mode")


def mechanize(model: Model, log: Log) -> Mechanism | None:
    """Build the mechanism; what the mechanics does not take yet is reported by name (E0701)."""
    _refuse_unknown(model, log)
    if log.failed:
        return None
    elements = [e for x in model.liaisons if (e := _element(x, log)) is not None]
    _refuse_surface(model, elements, log)
    if log.failed:
        return None
    tree = span(model, elements)
    for pin in tree.closing:
        _refuse(
            log,
            "a rotoïde that closes a loop",
            pin.liaison.span,
            f"other rotoïdes already join '{point_body(pin.a).name}' and "
            f"'{point_body(pin.b).name}': leave one of them out",
        )
    if log.failed:
        return None
    read = _read_liaisons(model)
    chosen: list[Element] = []
    ideal: list[Element] = []
    for element in elements:
        reduced = element.liaison in tree.kept
        silent = element.mu is None and element.delta is None and element.liaison not in read
        if isinstance(element, Contact):
            element = replace(element, reduced=reduced)
        (ideal if reduced and silent else chosen).append(element)
    return Mechanism(model, tree.coordinates, tuple(chosen), tuple(ideal), model.forces)


def _refuse(log: Log, what: str, span: Span | None, help: str = "") -> None:
    log.report("E0701", f"{what} is not supported yet", span, help=help)


def _refuse_unknown(model: Model, log: Log) -> None:
    if not model.planar and (model.bodies or model.liaisons):
        _refuse(log, "a model in space", model.span, "write `planar model` if the motion is plane")
    for body in model.bodies:
        if body.shape is not None and body.shape.name not in SHAPES:
            _refuse(log, f"the shape '{body.shape.name}'", body.span, _one_of("shapes", SHAPES))
    for curve in model.curves:
        if curve.kind != "line":
            _refuse(log, f"the curve '{curve.kind}'", curve.span, "a `line` is")
        for argument in curve.arguments.values():
            if not is_fixed(argument):
                _refuse(log, "a curve that depends on time or motion", argument.span)
    for frame in model.frames:
        for value in (frame.origin, frame.angle):
            if value is not None and not is_fixed(value):
                _refuse(log, "a frame that depends on time or motion", value.span)
    for body in model.bodies:
        for argument in body.arguments.values():
            if not is_fixed(argument):
                _refuse(log, "a body that depends on time or motion", argument.span)
    for liaison in model.liaisons:
        if liaison.kind.name not in LIAISONS:
            _refuse(
                log,
                f"the liaison '{liaison.kind.name}'",
                liaison.span,
                _one_of("liaisons", LIAISONS),
            )
        for law in liaison.laws:
            _refuse_law(liaison, law, log)
    for force in model.forces:
        if force.kind.name not in FORCES:
            _refuse(log, f"the force '{force.kind.name}'", force.span, _one_of("forces", FORCES))
        if force.kind.name == "couple":
            _refuse_couple(force, log)
    if model.world.gravity is not None and not is_fixed(model.world.gravity):
        _refuse(log, "gravity that depends on time or motion", model.world.span)
    allowed = ("auto", "explicit") if model.bodies else ("auto", "explicit", "implicit")
    if model.experiment.method not in allowed:
        _refuse(
            log,
            f"the method '{model.experiment.method}'",
            model.experiment.span,
            f"{', '.join(f'`{method}`' for method in allowed)} are",
        )
    for expression in read_expressions(model):
        for node in subexpressions(expression):
            if isinstance(node, Quantity) and node.name == "mode":
                _refuse(
                    log,
                    "`mode` inside an expression",
                    node.span,
                    "every result holds the mode of each liaison by its name",
                )


def _one_of(what: str, names: tuple[str, ...]) -> str:
    return f"supported {what}: {', '.join(names)}"


def _refuse_law(liaison: Liaison, law: Law, log: Log) -> None:
    if law.kind.name not in LAWS:
        _refuse(log, f"the law '{law.kind.name}'", law.span, _one_of("laws", LAWS))
        return
    pin = liaison.kind.name == "rotoide"
    if pin and law.kind.name != "coulomb":
        _refuse(log, f"the law '{law.kind.name}' of a rotoïde", law.span, "`coulomb` is")
    for name in ("half_length",) if pin else ("radius", "half_length"):
        if name in law.arguments:
            _refuse(log, f"'{name}' of the law '{law.kind.name}'", law.arguments[name].span)
    if pin and "radius" in law.arguments and not is_fixed(law.arguments["radius"]):
        _refuse(log, "a radius that depends on time or motion", law.arguments["radius"].span)
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
                _refuse(
                    log,
                    f"a coefficient that depends on '{node.name}'",
                    node.span,
                    "coefficients may depend on positions and time",
                )


def _law(liaison: Liaison, kind: str) -> Law | None:
    """The law of this kind; a liaison has each kind once at most."""
    return next((law for law in liaison.laws if law.kind.name == kind), None)


def _refuse_couple(force: Force, log: Log) -> None:
    holder = force.arguments["holder"]
    if isinstance(holder, Liaison):
        if "angle" not in holder.kind.coordinates:
            log.report(
                "E0205",
                f"liaison '{holder.name}' has no angle that a couple could drive",
                force.span,
                help="a couple acts in a `rotoide`, or on a body",
            )
    elif isinstance(holder, BodyPoint) and not turns(holder.body):
        log.report(
            "E0205",
            f"a couple on '{holder.body.name}', which does not turn",
            force.span,
            help="name a body that turns, or a `rotoide`",
        )


def _refuse_surface(model: Model, elements: list[Element], log: Log) -> None:
    """What happens at the surface of a pin is known with its radius only."""
    plain = {e.liaison for e in elements if isinstance(e, Pin) and e.radius is None}
    for expression in read_expressions(model):
        for node in subexpressions(expression):
            if (
                isinstance(node, Quantity)
                and node.owner in plain
                and node.name in ("slip", "tangential_force")
            ):
                log.report(
                    "E0203",
                    f"no '{node.name}' on '{node.owner.name}': its pin has no radius",
                    node.span,
                    help="read `speed` or `torque`, or give the law `coulomb(..., radius = ...)`",
                )


def _element(liaison: Liaison, log: Log) -> Element | None:
    return _pin(liaison, log) if liaison.kind.name == "rotoide" else _contact(liaison, log)


def _pin(liaison: Liaison, log: Log) -> Pin | None:
    a, b, unilateral = liaison.a, liaison.b, liaison.options["unilateral"]
    assert isinstance(a, Point) and isinstance(b, Point)
    if not (isinstance(unilateral, Literal) and unilateral.value is False):
        _refuse(log, "a rotoïde that can part", unilateral.span)
        return None
    if not (turns(point_body(a)) or turns(point_body(b))):
        _refuse(
            log,
            "a rotoïde of two bodies that do not turn",
            liaison.span,
            "a particle has no angle: use a rod, a disc or a ring",
        )
        return None
    law = _law(liaison, "coulomb")
    if law is not None and "radius" not in law.arguments:
        log.report(
            "E0204",
            f"'coulomb' of the rotoïde '{liaison.name}' needs radius",
            law.span,
            notes=("radius: radius of the pin; its friction couple is mu*radius*norm(R)",),
            help="write `coulomb(..., radius = 8 mm)`",
        )
        return None
    if law is None:
        return Pin(liaison, a, b, unilateral, None, None, None)
    mu, mu_s, radius = (law.arguments[name] for name in ("mu", "mu_s", "radius"))
    return Pin(liaison, a, b, unilateral, mu, mu_s, radius)


def _contact(liaison: Liaison, log: Log) -> Contact | None:
    line_first = isinstance(liaison.a, CurvePlace)
    line_place, other = (liaison.a, liaison.b) if line_first else (liaison.b, liaison.a)
    if not isinstance(line_place, CurvePlace) or isinstance(other, CurvePlace):
        _refuse(
            log,
            f"the liaison '{liaison.kind.name}' between these two places",
            liaison.span,
            "a point, or the rim of a disc or ring, on a line is supported",
        )
        return None
    line: Curve = line_place.curve
    round_body: Body | None = None
    if isinstance(other, BodyGeometry):
        if other.name != "rim" or other.body.shape is None or other.body.shape.name not in ROUND:
            _refuse(log, f"'{other.body.name}.{other.name}' in a contact", other.span)
            return None
        round_body = other.body
        point: Point = BodyPoint(other.body, "G", other.span)
    else:
        point = other
    if not is_fixed(liaison.options["unilateral"]):
        _refuse(log, "an option `unilateral` that changes", liaison.options["unilateral"].span)
        return None
    coulomb = _law(liaison, "coulomb")
    rolling = _law(liaison, "rolling_resistance")
    moving = point_body(point)
    if rolling is not None and moving.shape is not None and not moving.shape.turns:
        log.report(
            "E0511",
            f"rolling resistance on '{moving.name}', which does not turn",
            rolling.span,
            help="a particle has no angle; use a disc or a ring",
        )
    return Contact(
        liaison,
        point,
        round_body,
        line,
        line_first,
        False,
        liaison.options["unilateral"],
        coulomb.arguments["mu"] if coulomb else None,
        coulomb.arguments["mu_s"] if coulomb else None,
        rolling.arguments["delta"] if rolling else None,
    )


def _read_liaisons(model: Model) -> set[Liaison]:
    """Liaisons whose reaction an expression reads."""

    def reads(expression: Expression) -> set[Liaison]:
        return {
            node.owner
            for node in subexpressions(expression)
            if isinstance(node, Quantity)
            and isinstance(node.owner, Liaison)
            and node.name in REACTION
        }

    return set().union(*(reads(e) for e in read_expressions(model)))
