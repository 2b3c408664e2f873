"""Names of the scalars of coordinates and of variables with a shape."""

from __future__ import annotations

from frot.compiler.mechanics.mechanism import Coordinates, LineCoordinates, PinCoordinates, turns


def component_names(name: str, shape: tuple[int, ...]) -> list[str]:
    """`x`, or `x[1]`, `x[2]`, or `x[1,1]`, `x[1,2]`: by rows."""
    names = [""]
    for size in shape:
        names = [f"{n},{k + 1}" if n else f"{k + 1}" for n in names for k in range(size)]
    return [f"{name}[{n}]" if n else name for n in names]


def turning_coordinates(coordinates: tuple[Coordinates, ...]) -> list[bool]:
    """Of each scalar coordinate, whether it is an angle."""
    return [
        turns(c.body) and k == len(coordinate_names(c)) - 1
        for c in coordinates
        for k in range(len(coordinate_names(c)))
    ]


def coordinate_names(coordinates: Coordinates) -> tuple[str, ...]:
    """Names of the coordinates, for messages and the DAE."""
    body = coordinates.body
    if isinstance(coordinates, PinCoordinates):
        return (f"{coordinates.pin.liaison.name}.angle",) if turns(body) else ()
    turning = (f"{body.name}.angle",) if turns(body) else ()
    if isinstance(coordinates, LineCoordinates):
        return (f"{coordinates.liaison.name}.u", *turning)
    return (f"{body.name}.position.x", f"{body.name}.position.y", *turning)
