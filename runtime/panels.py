"""Which curves of a run are drawn, and in which panels: one unit for each panel.

The outputs of a text are what its author wants to see: where there are some, they alone are drawn.
Else what moves: positions, angles and speeds of bodies and liaisons, reactions, and the variables
that the text declares. Of many the ones that move most are taken, in the order of the variables.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from frot.runtime.program import VariableInfo
from frot.runtime.run_values import RunValues

if TYPE_CHECKING:
    from frot.runtime.number_arrays import Floats

MOST_CURVES, MOST_PANELS, MOST_MODES = 7, 8, 40
# Times at which curves are compared, and the values of all variables at them.
_TIMES, _MOST_VALUES = 2000, 2**24
# A curve that varies by less than this part of its size is the constant it is: the rest is rounding
# or an error within the tolerance. One that varies by less than this part of the largest is zero.
LEVEL, _ZERO = 1e-5, 1e-9
_AXES = ("", ".x", ".y", ".z")
# Of bodies and liaisons: title, unit, last names.
_MOTIONS = (
    ("position", "m", ("position", "displacement", "u", "x", "y", "z")),
    ("parameter", "1", ("u",)),
    ("angle", "rad", ("angle", "angle_a", "angle_b")),
    ("velocity", "m/s", ("velocity", "slip", "speed")),
    ("angular velocity", "rad/s", ("angular_velocity", "speed", "speed_angle")),
)
_REACTIONS = (
    ("reaction", "N", ("normal_force", "tangential_force", "drive")),
    ("couple", "N.m", ("drive",)),
)
# Titles of units of variables that the text declares.
_TITLES = {
    **{unit: title for title, unit, _ in _MOTIONS},
    "1": "number",
    "m": "length",
    "m/s^2": "acceleration",
    "rad/s^2": "angular acceleration",
    "N": "force",
    "N.m": "couple",
    "J": "energy",
    "W": "power",
    "N.s": "momentum",
    "V": "voltage",
    "A": "current",
    "K": "temperature",
    "Pa": "pressure",
    "kg": "mass",
    "s": "time",
    "m^2": "area",
    "m^3": "volume",
    "m^3/s": "flow",
}


@dataclass(frozen=True, slots=True)
class Panel:
    """Curves of one unit, and how many more there are. `steps`: names of the values 0, 1, ..."""

    title: str
    names: tuple[str, ...]
    hidden: int = 0
    steps: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Choice:
    """The panels of a picture, how many more there are, and the modes shown as bars."""

    panels: tuple[Panel, ...]
    hidden: int
    modes: tuple[str, ...]
    hidden_modes: int


def choose(result: RunValues) -> Choice:
    """The panels that are drawn by default."""
    variables = result.program.variables
    values = _looked_at(result)
    outputs = [v for v in variables if v.causality == "output" and v.type != "mode"]
    if outputs:
        panels = [part for one in by_unit(outputs, values, "output") for part in _parts(one)]
    else:
        local = [v for v in variables if v.type != "mode"]
        panels = list(_of_motion(local, values))
        panels = panels or [next(_parts(one)) for one in by_unit(local, values)]
    modes = [v.name for v in variables if v.type == "mode" and v.changes]
    shown = _largest(modes, {name: float(np.ptp(values[name])) for name in modes}, MOST_MODES)
    return Choice(
        tuple(panels[:MOST_PANELS]) or (Panel("", ()),),
        max(len(panels) - MOST_PANELS, 0),
        shown,
        len(modes) - len(shown),
    )


def by_unit(
    variables: Iterable[VariableInfo], values: Mapping[str, Floats], title: str = ""
) -> Iterator[Panel]:
    """All curves of these variables, a panel for each unit and each set of names of values."""
    groups: dict[tuple[str, tuple[str, ...]], list[str]] = {}
    for v in variables:
        steps = ("false", "true") if v.type == "boolean" else ("", *v.literals) * bool(v.literals)
        groups.setdefault(("" if steps else v.unit.name, steps), []).append(v.name)
    for (unit, steps), names in groups.items():
        yield Panel(title or _TITLES.get(unit, ""), tuple(_once(names, values)), steps=steps)


def _parts(panel: Panel) -> Iterator[Panel]:
    """As many panels as its curves take."""
    for first in range(0, len(panel.names), MOST_CURVES):
        yield replace(panel, names=panel.names[first : first + MOST_CURVES])


def _declared(variables: Iterable[VariableInfo], values: Mapping[str, Floats]) -> Iterator[Panel]:
    """The variables of the text that move, those of the model before those of its components."""
    for panel in by_unit(variables, values):
        names = _moving(panel.names, values)
        depths = {name: (name.count("."), -_range(values[name])) for name in names}
        shown = tuple(sorted(sorted(names, key=depths.__getitem__)[:MOST_CURVES], key=names.index))
        if shown:
            yield replace(panel, names=shown, hidden=len(names) - len(shown))


def _of_motion(variables: list[VariableInfo], values: Mapping[str, Floats]) -> Iterator[Panel]:
    """Of each kind of motion what moves, or if nothing does what is not zero; then the others."""
    kinds = [(title, _alike(variables, unit, members, values)) for title, unit, members in _MOTIONS]
    moving = [(title, _moving(names, values)) for title, names in kinds]
    chosen = moving if any(names for _, names in moving) else kinds
    chosen += [
        (title, _alike(variables, unit, members, values)) for title, unit, members in _REACTIONS
    ]
    taken = {name for _, names in chosen for name in names}
    for title, names in chosen:
        if names:
            yield _panel(title, names, values)
    yield from _declared((v for v in variables if v.declared and v.name not in taken), values)


def _alike(
    variables: list[VariableInfo],
    unit: str,
    members: tuple[str, ...],
    values: Mapping[str, Floats],
) -> list[str]:
    """Variables of this unit whose last name is one of these, not zero throughout."""
    names = [
        v.name
        for v in variables
        if v.unit.name == unit
        and _member(v.name) in members
        and not (v.declared and (unit == "1" or v.literals))
    ]
    return _once([name for name in names if np.any(values[name] != 0)], values)


def _member(name: str) -> str:
    """The last name without an axis: `position` of `hoop.position.x`, `drive` of a drive."""
    path = name.split(".")
    if len(path) > 2 and path[-2] == "drive":
        return "drive"
    return path[-2] if len(path) > 2 and f".{path[-1]}" in _AXES else path[-1]


def _moving(names: Iterable[str], values: Mapping[str, Floats]) -> list[str]:
    """The variables that vary by more than rounding."""
    sizes = {name: _size(values[name]) for name in names}
    zero = _ZERO * max(sizes.values(), default=0.0)
    return [name for name in sizes if _range(values[name]) > max(LEVEL * sizes[name], zero)]


def _panel(title: str, names: list[str], values: Mapping[str, Floats]) -> Panel:
    """The curves that move most, in the order of the names."""
    shown = _largest(names, {name: _range(values[name]) for name in names}, MOST_CURVES)
    return Panel(title, shown, len(names) - len(shown))


def _largest(names: list[str], sizes: Mapping[str, float], most: int) -> tuple[str, ...]:
    """The names of the largest sizes, the first of equal ones, in their own order."""
    kept = set(sorted(names, key=lambda name: -sizes[name])[:most])
    return tuple(name for name in names if name in kept)


def _once(names: list[str], values: Mapping[str, Floats]) -> list[str]:
    """The names without those whose curve is that of one before."""
    seen = {values[name].tobytes(): name for name in reversed(names)}
    return [name for name in names if seen[values[name].tobytes()] == name]


def _range(curve: Floats) -> float:
    finite = curve[np.isfinite(curve)]
    return float(np.ptp(finite)) if finite.size else 0.0


def _size(curve: Floats) -> float:
    finite = curve[np.isfinite(curve)]
    return float(np.abs(finite).max()) if finite.size else 0.0


def _looked_at(result: RunValues) -> Mapping[str, Floats]:
    """All variables at times spread over the run: fewer of them where variables are many."""
    count = max(min(_TIMES, _MOST_VALUES // max(len(result.program.variables), 1)), 50)
    return result.at(np.linspace(result.time[0], result.time[-1], count))
