"""Bodies and their points: named ones and the origins of frames."""

from __future__ import annotations

from collections.abc import Iterator

from frot.dsl.checked import Body, BodyPoint, Frame

Point = BodyPoint | Frame


def point_body(point: Point) -> Body:
    """The body a point belongs to."""
    return point.body if isinstance(point, BodyPoint) else owner_body(point)


def owner_body(owner: Body | Frame) -> Body:
    """The body a frame, or a frame on a frame, is fixed to."""
    while isinstance(owner, Frame):
        owner = owner.owner
    return owner


def frames_of(point: Point) -> Iterator[Frame]:
    """The frames between a point and its body, from the point on."""
    frame: Body | Frame = point.body if isinstance(point, BodyPoint) else point
    while isinstance(frame, Frame):
        yield frame
        frame = frame.owner


def is_particle(body: Body) -> bool:
    """Whether the body has no orientation."""
    return body.shape is not None and not body.shape.turns


def turns(body: Body) -> bool:
    """Whether the body can have an angular velocity: neither the ground nor a particle."""
    return body.shape is not None and body.shape.turns
