"""Chosen curves of one or several runs: over time with one unit an axis, or against each other."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from frot.dsl.files.writing import PICTURES, check_target, write_whole
from frot.dsl.messages.errors import fail
from frot.runtime.plotting import COLOURS, FINE, MODE_COLOURS, MOST_MARKS
from frot.runtime.run_report import MODES
from frot.runtime.run_values import RunValues

if TYPE_CHECKING:
    from frot.runtime.number_arrays import Floats

STYLES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)))
SMALL = 8


def plot_curves(
    runs: RunValues | Mapping[str, RunValues],
    path: str | Path,
    names: Sequence[str],
    xy: bool = False,
) -> None:
    """Write chosen curves to a `.png`, `.svg` or `.pdf`; see `draw_curves`.

    Raises:
        FrotError: E0803 and E0806: the file cannot be written; E0805: there is no such variable.
    """
    target = check_target(path, PICTURES)
    figure = draw_curves(runs, names, xy)
    buffer = io.BytesIO()
    figure.savefig(buffer, format=target.suffix[1:].lower(), dpi=130)
    write_whole(target, buffer.getvalue())


def draw_curves(
    runs: RunValues | Mapping[str, RunValues], names: Sequence[str], xy: bool = False
) -> Any:
    """The curves as a matplotlib Figure.

    `runs` by their labels, or one alone. Over time curves of one unit share an axis, and events are
    marked; of several runs each has a style of line. With `xy` the first of each pair of names is
    the abscissa of the second. FrotError (E0805) for a name that no variable has.
    """
    labelled = {"": runs} if isinstance(runs, RunValues) else dict(runs)
    if not labelled or not names:
        raise fail("E0806", "there are no curves to draw", help="name one, as ball.position.x")
    names = next(iter(labelled.values())).numbers(names)
    if xy and len(names) % 2:
        raise fail("E0806", "a phase plane has pairs of variables", help="name an even number")
    taken = {label: _taken(result, names) for label, result in labelled.items()}
    one = next(iter(labelled.values()))
    units = {name: unit_of(one, name) for name in names}
    return _phases(labelled, taken, names, units) if xy else _over_time(labelled, taken, units)


def unit_of(result: RunValues, name: str) -> str:
    """The unit of a variable; `1` for a number, `mode` for a mode."""
    found = next((v for v in result.program.variables if v.name == name), None)
    if name == "time":
        return "s"
    if found is None:
        return result.unit(name)
    return "mode" if found.type == "mode" else found.unit.name


def moments(result: RunValues) -> Floats:
    """Times close enough for a drawing, with both sides of each event."""
    first, last = result.time[0], result.time[-1]
    events = np.array([e.time for e in result.events if first < e.time < last])
    before = np.nextafter(events, first, dtype=float)
    return np.unique(np.concatenate((np.linspace(first, last, FINE), events, before)))


def _taken(result: RunValues, names: Sequence[str]) -> dict[str, Floats]:
    times = moments(result)
    return {"time": times, **result.take(names, times)}


def _over_time(
    runs: Mapping[str, RunValues],
    taken: Mapping[str, Mapping[str, Floats]],
    units: Mapping[str, str],
) -> Any:
    from matplotlib.figure import Figure

    panels: dict[str, list[str]] = {}
    for name, unit in units.items():
        panels.setdefault(unit, []).append(name)
    modes = panels.pop("mode", [])
    bars = [(label, name) for name in modes for label in runs]
    heights = [2.2] * len(panels) + [0.3 + 0.22 * len(bars)] * bool(bars)
    figure = Figure(figsize=(9, 0.9 + sum(heights)), layout="constrained")
    axes = figure.subplots(
        len(heights), 1, sharex=True, squeeze=False, height_ratios=heights
    ).ravel()
    _title(figure, runs)
    colours = {name: COLOURS[k % len(COLOURS)] for k, name in enumerate(units)}
    for axis, (unit, names) in zip(axes, panels.items(), strict=False):
        for style, (label, values) in zip(_styles(taken), taken.items(), strict=True):
            for name in names:
                shown = _label(name, unit, label)
                axis.plot(
                    values["time"], values[name], color=colours[name], ls=style, lw=1.4, label=shown
                )
        _mark(axis, runs)
        axis.set_ylabel("number" if unit == "1" else unit, fontsize=SMALL + 1)
        _dress(axis)
    if bars:
        _draw_bars(axes[-1], bars, taken)
    axes[-1].set_xlabel("time (s)", fontsize=SMALL + 1)
    starts = [values["time"][0] for values in taken.values()]
    ends = [values["time"][-1] for values in taken.values()]
    axes[-1].set_xlim(min(starts), max(ends))
    return figure


def _phases(
    runs: Mapping[str, RunValues],
    taken: Mapping[str, Mapping[str, Floats]],
    names: Sequence[str],
    units: Mapping[str, str],
) -> Any:
    from matplotlib.figure import Figure

    pairs = list(zip(names[::2], names[1::2], strict=True))
    figure = Figure(figsize=(6.5, 0.6 + 4.6 * len(pairs)), layout="constrained")
    axes = figure.subplots(len(pairs), 1, squeeze=False).ravel()
    _title(figure, runs)
    for axis, (x, y) in zip(axes, pairs, strict=True):
        for colour, (label, values) in zip(_colours(taken), taken.items(), strict=True):
            axis.plot(values[x], values[y], color=colour, lw=1.3, label=label or "_")
            axis.plot(values[x][:1], values[y][:1], "o", color=colour, ms=4, label="_")
        axis.set_xlabel(_label(x, units[x], ""), fontsize=SMALL + 1)
        axis.set_ylabel(_label(y, units[y], ""), fontsize=SMALL + 1)
        _dress(axis, margins=True)
    return figure


def _styles(taken: Mapping[str, object]) -> list[Any]:
    return [STYLES[k % len(STYLES)] for k in range(len(taken))]


def _colours(taken: Mapping[str, object]) -> list[str]:
    return [COLOURS[k % len(COLOURS)] for k in range(len(taken))]


def _label(name: str, unit: str, run: str) -> str:
    """The curve with its unit; of several runs, that too."""
    text = name if unit in ("1", "mode") else f"{name} ({unit})"
    return f"{text}, {run}" if run else text


def _title(figure: Any, runs: Mapping[str, RunValues]) -> None:
    titles = dict.fromkeys(r.program.doc or r.program.name for r in runs.values())
    figure.suptitle(", ".join(titles), fontsize=11)


def _dress(axis: Any, margins: bool = False) -> None:
    labels = [x for x in axis.get_legend_handles_labels()[1] if not x.startswith("_")]
    if labels:
        axis.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    axis.tick_params(labelsize=SMALL)
    axis.grid(color="#eeeeee", lw=0.6)
    if not margins:
        axis.margins(x=0)


def _mark(axis: Any, runs: Mapping[str, RunValues]) -> None:
    """The events of the first run, where there are not too many to tell apart."""
    result = next(iter(runs.values()))
    if len(result.events) <= MOST_MARKS:
        for event in result.events:
            axis.axvline(event.time, color="#999999", lw=0.6, ls=":", label="_event")


def _draw_bars(
    axis: Any, bars: Sequence[tuple[str, str]], taken: Mapping[str, Mapping[str, Floats]]
) -> None:
    """A strip a liaison and run, coloured by its mode."""
    from matplotlib.patches import Patch

    for row, (label, name) in enumerate(bars):
        times, mode = taken[label]["time"], taken[label][name].astype(int)
        starts = np.flatnonzero(np.diff(mode, prepend=mode[0] - 1))
        ends = np.append(starts[1:], len(times) - 1)
        for a, b in zip(starts, ends, strict=True):
            colour = MODE_COLOURS[MODES[mode[a]]]
            axis.barh(row, times[b] - times[a], left=times[a], height=0.8, color=colour, lw=0)
    words = [_label(name, "mode", label) for label, name in bars]
    axis.set_yticks(range(len(bars)), words, fontsize=SMALL)
    axis.tick_params(labelsize=SMALL)
    axis.invert_yaxis()
    handles = [Patch(color=colour, label=mode) for mode, colour in MODE_COLOURS.items()]
    axis.legend(
        handles=handles, fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False
    )
