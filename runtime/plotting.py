"""A picture of a run: positions, velocities, reactions and the modes of the liaisons over time."""

from __future__ import annotations

import io
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from frot.dsl.files.writing import PICTURES, check_target, write_whole
from frot.dsl.messages.escapes import escaped
from frot.runtime.result import MODES, Result

if TYPE_CHECKING:
    from frot.runtime.engine import Floats

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000")
MODE_COLOURS = {"open": "#e8eef4", "stick": "#3a5a78", "slip": "#e9b44c"}
MOST_CURVES = 7
MOST_PANELS = 6
FINE = 2000
# More events than this are not marked: their lines would hide the curves.
MOST_MARKS = 60
# A curve that varies by less than this part of its size is drawn as the constant it is.
LEVEL = 1e-5
PANELS = (
    ("position", (".position.x", ".position.y", ".position.z", ".u", ".displacement")),
    ("angle", (".angle",)),
    ("velocity", (".velocity.x", ".velocity.y", ".velocity.z", ".slip")),
    ("angular velocity", (".angular_velocity", *(f".angular_velocity.{k}" for k in "xyz"))),
    ("reaction", (".normal_force", ".tangential_force")),
)


def plot(result: Result, path: str | Path) -> None:
    """Draw the run to a `.png`, `.svg` or `.pdf`; FrotError (E0803, E0806) if it cannot be."""
    path = check_target(path, PICTURES)
    figure = draw(result)
    buffer = io.BytesIO()
    figure.savefig(buffer, format=path.suffix[1:].lower(), dpi=130)
    write_whole(path, buffer.getvalue())


def draw(result: Result) -> Any:
    """The picture as a matplotlib Figure."""
    from matplotlib.figure import Figure

    # Events fall between the times of the output grid: look more closely, and at both sides.
    first, last = result.time[0], result.time[-1]
    events = np.array([e.time for e in result.events if first < e.time < last])
    times = np.unique(
        np.concatenate(
            (np.linspace(first, last, FINE), events, np.nextafter(events, first, dtype=float))
        )
    )
    values = result.at(times)
    panels = [(title, _curves(result, values, suffixes)) for title, suffixes in PANELS]
    outputs = [v.name for v in result.program.variables if v.causality == "output"]
    panels = [(title, names) for title, names in [("output", outputs), *panels] if names]
    if not panels:
        panels = _by_unit(result, values)
    modes = [v.name for v in result.program.variables if v.type == "mode"]
    heights = [2.0] * len(panels) + [0.3 + 0.22 * len(modes)] * bool(modes)
    figure = Figure(figsize=(9, 1.2 + sum(heights)), layout="constrained")
    axes = figure.subplots(
        len(heights), 1, sharex=True, squeeze=False, height_ratios=heights
    ).ravel()
    title = escaped(result.program.doc or result.program.name)
    figure.suptitle(title, fontsize=11, parse_math=False)
    units = {v.name: v.unit.name for v in result.program.variables}
    for axis, (title, names) in zip(axes, panels, strict=False):
        for colour, name in zip(COLOURS, names[:MOST_CURVES], strict=False):
            unit = "" if units[name] == "1" else f" ({units[name]})"
            axis.plot(times, values[name], color=colour, lw=1.4, label=f"{name}{unit}")
        for event in events if len(events) <= MOST_MARKS else ():
            axis.axvline(event, color="#999999", lw=0.6, ls=":")
        hidden = len(names) - MOST_CURVES
        axis.set_ylabel(title if hidden <= 0 else f"{title} ({hidden} not shown)", fontsize=9)
        if names:
            axis.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
        axis.tick_params(labelsize=8)
        axis.grid(color="#eeeeee", lw=0.6)
        axis.margins(x=0)
        _level(axis, [values[name] for name in names[:MOST_CURVES]])
    if modes:
        _draw_modes(axes[-1], result, modes, times)
    axes[-1].set_xlabel("time (s)", fontsize=9)
    axes[-1].set_xlim(first, last)
    return figure


def _level(axis: Any, curves: list[Floats]) -> None:
    """See that rounding and errors within the tolerance are not drawn as a motion."""
    finite = [curve[np.isfinite(curve)] for curve in curves]
    low = min((float(c.min()) for c in finite if c.size), default=0.0)
    high = max((float(c.max()) for c in finite if c.size), default=0.0)
    size = max(abs(low), abs(high))
    if size > 0 and high - low < LEVEL * size:
        axis.set_ylim((low + high) / 2 - 0.05 * size, (low + high) / 2 + 0.05 * size)


def _curves(result: Result, values: Any, suffixes: tuple[str, ...]) -> list[str]:
    """Variables with these endings that are not zero throughout, each curve once."""
    chosen: list[str] = []
    for suffix in suffixes:
        for v in result.program.variables:
            curve = values[v.name]
            if v.name.endswith(suffix) and v.causality == "local" and np.any(curve != 0):
                known = (values[name] for name in chosen)
                if not any(np.array_equal(curve, other) for other in known):
                    chosen.append(v.name)
    return chosen


def _by_unit(result: Result, values: Any) -> list[tuple[str, list[str]]]:
    """Panels of all variables, a unit each: the shortest paths first, each curve once."""
    real = [v for v in result.program.variables if v.type != "mode"]
    panels: dict[str, list[str]] = {}
    for v in sorted(real, key=lambda v: v.name.count(".")):
        names = panels.setdefault("number" if v.unit.name == "1" else v.unit.name, [])
        if not any(np.array_equal(values[v.name], values[name]) for name in names):
            names.append(v.name)
    return list(panels.items())[:MOST_PANELS] or [("", [])]


def _draw_modes(axis: Any, result: Result, names: list[str], times: Floats) -> None:
    """A strip a liaison, coloured by its mode."""
    from matplotlib.patches import Patch

    values = result.at(times)
    for row, name in enumerate(names):
        mode = values[name].astype(int)
        starts = np.flatnonzero(np.diff(mode, prepend=mode[0] - 1))
        ends = np.append(starts[1:], len(times) - 1)
        for a, b in zip(starts, ends, strict=True):
            colour = MODE_COLOURS[MODES[mode[a]]]
            axis.barh(row, times[b] - times[a], left=times[a], height=0.8, color=colour, lw=0)
    axis.set_yticks(range(len(names)), names, fontsize=8)
    axis.tick_params(labelsize=8)
    axis.invert_yaxis()
    axis.legend(
        handles=[Patch(color=colour, label=mode) for mode, colour in MODE_COLOURS.items()],
        fontsize=7,
        loc="center left",
        bbox_to_anchor=(1.0, 0.5),
        frameon=False,
    )
