"""Checked model to mechanism: what gives coordinates, what is a contact, what is refused."""

from __future__ import annotations

from dataclasses import replace

from frot.compiler.mechanism import (
    Contact,
    Coordinates,
    FreeCoordinates,
    LineCoordinates,
    Mechanism,
    Point,
    is_unilateral,
)
from frot.compiler.walk import is_fixed, read_expressions, subexpressions
from frot.dsl import Log
from frot.dsl.checked import (
    Body,
    BodyGeometry,
    BodyPoint,
    Curve,
    CurvePlace,
    Expression,
    Frame,
    Law,
    Liaison,
    Model,
    Quantity,
)
from frot.dsl.source import Span

SHAPES = ("particle", "ring", "disc", "rod")
LIAISONS = ("point_courbe", "contact_ponctuel")
LAWS = ("coulomb", "rolling_resistance")
FORCES = ("attraction", "on", "spring")
ROUND = ("ring", "disc")
REACTION = ("force", "torque", "normal_force", "tangential_force", "power", "mode")


def mechanize(model: Model, log: Log) -> Mechanism | None:
    """Build the mechanism; what the mechanics does not take yet is reported by name (E0701)."""
    _refuse_unknown(model, log)
    if log.failed:
        return None
    contacts = [c for x in model.liaisons if (c := _contact(x, log)) is not None]
    if log.failed:
        return None
    coordinates, kept = _coordinates(model, contacts)
    read = _read_liaisons(model)
    chosen: list[Contact] = []
    ideal: list[Contact] = []
    for contact in contacts:
        reduced = contact.liaison in kept
        silent = contact.mu is None and contact.delta is None and contact.liaison not in read
        (ideal if reduced and silent else chosen).append(replace(contact, reduced=reduced))
    return Mechanism(model, coordinates, tuple(chosen), tuple(ideal), model.forces)


def owner_body(owner: Body | Frame) -> Body:
    """The body a frame, or a frame on a frame, is fixed to."""
    while isinstance(owner, Frame):
        owner = owner.owner
    return owner


def point_body(point: Point) -> Body:
    """The body a point belongs to."""
    return point.body if isinstance(point, BodyPoint) else owner_body(point)


def _refuse(log: Log, what: str, span: Span | None, help: str = "") -> None:
    log.report("E0701", f"{what} is not supported yet", span, help=help)


def _refuse_unknown(model: Model, log: Log) -> None:
    if not model.planar:
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
            _refuse_law(law, log)
    for force in model.forces:
        if force.kind.name not in FORCES:
            _refuse(log, f"the force '{force.kind.name}'", force.span, _one_of("forces", FORCES))
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


def _refuse_law(law: Law, log: Log) -> None:
    if law.kind.name not in LAWS:
        _refuse(log, f"the law '{law.kind.name}'", law.span, _one_of("laws", LAWS))
        return
    for name in ("radius", "half_length"):
        if name in law.arguments:
            _refuse(log, f"'{name}' of the law '{law.kind.name}'", law.arguments[name].span)
    for argument in law.arguments.values():
        for node in subexpressions(argument):
            if isinstance(node, Quantity) and node.name in (
                "velocity",
                "acceleration",
                "slip",
                "angular_velocity",
                "angular_acceleration",
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


def _coordinates(
    model: Model, contacts: list[Contact]
) -> tuple[tuple[Coordinates, ...], set[Liaison]]:
    """A spanning tree: the first liaison that can carries each body, in the order of the text."""
    carried: dict[Body, Contact] = {}
    for contact in contacts:
        body = point_body(contact.point)
        if (
            contact.liaison.kind.name == "point_courbe"
            and not is_unilateral(contact.liaison)
            and body is not model.ground
            and body not in carried
            and body not in _carriers(owner_body(contact.line.owner), carried)
        ):
            carried[body] = contact
    ordered: list[Coordinates] = []
    done = {model.ground}

    def place(body: Body) -> None:
        if body in done:
            return
        done.add(body)
        contact = carried.get(body)
        if contact is None:
            ordered.append(FreeCoordinates(body))
            return
        place(owner_body(contact.line.owner))
        ordered.append(LineCoordinates(body, contact.point, contact.line, contact.liaison))

    for body in model.bodies:
        place(body)
    return tuple(ordered), {contact.liaison for contact in carried.values()}


def _carriers(body: Body, carried: dict[Body, Contact]) -> set[Body]:
    """The body and all those its coordinates hang on."""
    chain = {body}
    while body in carried:
        body = owner_body(carried[body].line.owner)
        chain.add(body)
    return chain


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
