"""Liaisons in which a paradox is possible, in words."""

from __future__ import annotations

from collections.abc import Iterator

TYPE_CHECKING = False
if TYPE_CHECKING:
    from frot.compiler.report.analysis import ParadoxLine

NO_LEAST = "from a mu that decreases with the posture, without a least one within reach"
_IN_A_LINE = 2


def paradox_lines(one: ParadoxLine) -> Iterator[str]:
    """From which coefficients, then where."""
    parts = []
    if one.at_start is not None:
        parts.append(f"from mu = {one.at_start:.4g} at the start")
    if one.least is not None:
        parts.append(f"from mu = {one.least:.4g} in the worst posture")
    yield f"{one.liaison} {', '.join(parts) or NO_LEAST}; it is {one.mu:.4g}"
    where = [f"{name} = {value}" for name, value in _coordinates(one.where)]
    lines = [", ".join(where[k : k + _IN_A_LINE]) for k in range(0, len(where), _IN_A_LINE)]
    if one.beside:
        lines.append(f"with {', '.join(one.beside)} closed")
    yield from (f"  {'at ' if where and k == 0 else ''}{line}" for k, line in enumerate(lines))


def _coordinates(where: tuple[tuple[str, float], ...]) -> Iterator[tuple[str, str]]:
    """Names and values, the components of a quaternion together."""
    together: dict[str, list[str]] = {}
    for name, value in where:
        head, angle = name.partition("[")[0], "angle" in name or "[" in name
        shown = f"{(round(value, 4) if angle else value) + 0.0:.4g}"
        together.setdefault(head, []).append(shown)
    for name, values in together.items():
        yield name, values[0] if len(values) == 1 else f"({', '.join(values)})"
