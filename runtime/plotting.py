"""A picture of a run: curves over time in panels of one unit, and the modes of the liaisons."""

from __future__ import annotations

import io
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from frot.dsl.files.writing import PICTURES, check_target, write_whole
from frot.dsl.messages.source import escaped
from frot.runtime.panels import LEVEL, Choice, Panel, choose
from frot.runtime.run_report import MODES
from frot.runtime.run_values import RunValues

if TYPE_CHECKING:
    from frot.runtime.number_arrays import Floats

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000")
MODE_COLOURS = {"open": "#e8eef4", "stick": "#3a5a78", "slip": "#e9b44c"}
FINE = 2000
# Values of all variables that are made at once.
MOST_VALUES = 2**22
# More events than this are not marked: their lines would hide the curves.
MOST_MARKS = 60


def plot(result: RunValues, path: str | Path) -> None:
    """Draw the run to a `.png`, `.svg` or `.pdf`; FrotError (E0803, E0806) if it cannot be."""
    path = check_target(path, PICTURES)
    figure = draw(result)
    buffer = io.BytesIO()
    figure.savefig(buffer, format=path.suffix[1:].lower(), dpi=130)
    write_whole(path, buffer.getvalue())


def draw(result: RunValues) -> Any:
    """The picture as a matplotlib Figure."""
    from matplotlib.figure import Figure

    choice = choose(result)
    first, last = result.time[0], result.time[-1]
    events = np.array([e.time for e in result.events if first < e.time < last])
    times, values = _curves(result, choice, events)
    panels, modes = choice.panels, choice.modes
    heights = [2.0] * len(panels) + [0.3 + 0.22 * len(modes)] * bool(modes)
    figure = Figure(figsize=(9, 1.2 + sum(heights)), layout="constrained")
    axes = figure.subplots(
        len(heights), 1, sharex=True, squeeze=False, height_ratios=heights
    ).ravel()
    title = escaped(result.program.doc or result.program.name)
    figure.suptitle(title, fontsize=11, parse_math=False)
    units = {v.name: v.unit.name for v in result.program.variables}
    for axis, panel in zip(axes, panels, strict=False):
        _draw_panel(axis, panel, times, values, units)
        for event in events if len(events) <= MOST_MARKS else ():
            axis.axvline(event, color="#999999", lw=0.6, ls=":")
    if modes:
        _draw_modes(axes[-1], values, modes, times)
        if choice.hidden_modes:
            axes[-1].set_ylabel(f"({choice.hidden_modes} not shown)", fontsize=9)
    more = f" ({choice.hidden} more panels not shown)" if choice.hidden else ""
    axes[-1].set_xlabel(f"time (s){more}", fontsize=9)
    axes[-1].set_xlim(first, last)
    return figure


def _curves(result: RunValues, choice: Choice, events: Floats) -> tuple[Floats, dict[str, Floats]]:
    """The times of the picture and what is drawn at them.

    Events lie between the times of the output grid: both sides of each are drawn. Values are taken
    a block at a time, as each has all variables.
    """
    first, last = result.time[0], result.time[-1]
    few = events[:: -(-len(events) // FINE) or 1]
    times = np.unique(
        np.concatenate((np.linspace(first, last, FINE), few, np.nextafter(few, first, dtype=float)))
    )
    names = [*(name for panel in choice.panels for name in panel.names), *choice.modes]
    block = max(MOST_VALUES // max(len(result.program.variables), 1), 1)
    parts = [result.at(times[k : k + block]) for k in range(0, len(times), block)]
    return times, {name: np.concatenate([part[name] for part in parts]) for name in names}


def _draw_panel(
    axis: Any, panel: Panel, times: Floats, values: dict[str, Floats], units: dict[str, str]
) -> None:
    for colour, name in zip(COLOURS, panel.names, strict=False):
        unit = "" if units[name] == "1" else f" ({units[name]})"
        axis.plot(times, values[name], color=colour, lw=1.4, label=f"{name}{unit}")
    more = f"({panel.hidden} not shown)" if panel.hidden else ""
    axis.set_ylabel(" ".join(filter(None, (panel.title, more))), fontsize=9)
    if panel.names:
        axis.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    axis.tick_params(labelsize=8)
    axis.grid(color="#eeeeee", lw=0.6)
    axis.margins(x=0)
    if panel.steps:
        named = [k for k, step in enumerate(panel.steps) if step]
        axis.set_yticks(named, [panel.steps[k] for k in named])
        axis.set_ylim(named[0] - 0.3, named[-1] + 0.3)
    else:
        _level(axis, [values[name] for name in panel.names])


def _level(axis: Any, curves: list[Floats]) -> None:
    """See that rounding and errors within the tolerance are not drawn as a motion."""
    finite = [curve[np.isfinite(curve)] for curve in curves]
    low = min((float(c.min()) for c in finite if c.size), default=0.0)
    high = max((float(c.max()) for c in finite if c.size), default=0.0)
    size = max(abs(low), abs(high))
    if size > 0 and high - low < LEVEL * size:
        axis.set_ylim((low + high) / 2 - 0.05 * size, (low + high) / 2 + 0.05 * size)


def _draw_modes(
    axis: Any, values: dict[str, Floats], names: tuple[str, ...], times: Floats
) -> None:
    """A strip a liaison, coloured by its mode."""
    from matplotlib.patches import Patch

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
