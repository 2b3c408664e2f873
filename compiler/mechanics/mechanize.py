"""Checked model to mechanism: what gives coordinates, what is a contact, what is refused."""

from __future__ import annotations

from dataclasses import replace

from frot.compiler.lowering.walk import is_fixed, read_expressions, subexpressions
from frot.compiler.mechanics.mechanism import (
    Contact,
    Joint,
    Mechanism,
    Pin,
    Point,
    point_body,
    turns,
)
from frot.compiler.mechanics.refuse import REACTION, refuse, refuse_surface, refuse_unknown
from frot.compiler.mechanics.spanning import span
from frot.dsl import Log
from frot.dsl.checked import (
    Body,
    BodyGeometry,
    BodyPoint,
    Curve,
    CurvePlace,
    Expression,
    Law,
    Liaison,
    Literal,
    Model,
    Quantity,
)

ROUND = ("ring", "disc")


def mechanize(model: Model, log: Log) -> Mechanism | None:
    """Build the mechanism; what the mechanics does not take yet is reported by name (E0701)."""
    refuse_unknown(model, log)
    if log.failed:
        return None
    joints = [e for x in model.liaisons if (e := _joint(x, log)) is not None]
    refuse_surface(model, joints, log)
    if log.failed:
        return None
    tree = span(model, joints)
    for pin in tree.closing:
        refuse(
            log,
            "a rotoïde that closes a loop",
            pin.liaison.span,
            f"other rotoïdes already join '{point_body(pin.a).name}' and "
            f"'{point_body(pin.b).name}': leave one of them out",
        )
    if log.failed:
        return None
    read = _read_liaisons(model)
    chosen: list[Joint] = []
    ideal: list[Joint] = []
    for joint in joints:
        reduced = joint.liaison in tree.kept
        silent = joint.mu is None and joint.delta is None and joint.liaison not in read
        if isinstance(joint, Contact):
            joint = replace(joint, reduced=reduced)
        (ideal if reduced and silent else chosen).append(joint)
    return Mechanism(model, tree.coordinates, tuple(chosen), tuple(ideal), model.forces)


def _law(liaison: Liaison, kind: str) -> Law | None:
    """The law of this kind; a liaison has each kind once at most."""
    return next((law for law in liaison.laws if law.kind.name == kind), None)


def _joint(liaison: Liaison, log: Log) -> Joint | None:
    return _pin(liaison, log) if liaison.kind.name == "rotoide" else _contact(liaison, log)


def _pin(liaison: Liaison, log: Log) -> Pin | None:
    a, b, unilateral = liaison.a, liaison.b, liaison.options["unilateral"]
    assert isinstance(a, Point) and isinstance(b, Point)
    if not (isinstance(unilateral, Literal) and unilateral.value is False):
        refuse(log, "a rotoïde that can part", unilateral.span)
        return None
    if not (turns(point_body(a)) or turns(point_body(b))):
        refuse(
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
        refuse(
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
            refuse(log, f"'{other.body.name}.{other.name}' in a contact", other.span)
            return None
        round_body = other.body
        point: Point = BodyPoint(other.body, "G", other.span)
    else:
        point = other
    if not is_fixed(liaison.options["unilateral"]):
        refuse(log, "an option `unilateral` that changes", liaison.options["unilateral"].span)
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
        liaison=liaison,
        point=point,
        round=round_body,
        line=line,
        line_first=line_first,
        reduced=False,
        unilateral=liaison.options["unilateral"],
        mu=coulomb.arguments["mu"] if coulomb else None,
        mu_s=coulomb.arguments["mu_s"] if coulomb else None,
        delta=rolling.arguments["delta"] if rolling else None,
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
