"""The curves of a page: values of all variables over time, and which of them are shown at first."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from frot.runtime.curves import unit_of
from frot.runtime.panels import choose
from frot.runtime.plotting import COLOURS, FINE
from frot.runtime.run_report import MODES
from frot.view.colours import MODES as MODE_COLOURS
from frot.view.numbers import packed

if TYPE_CHECKING:
    from frot.runtime.run_values import RunValues
    from frot.view.outline import Array

MOST_VALUES = 2_000_000  # of a page; what is constant is one value
LEAST = 200


def curves_of(result: RunValues, chosen: Sequence[str] | None = None) -> dict[str, Any]:
    """Content of the page: `grid` (s), `curves` of all listed variables, `panels` shown at first.

    `chosen` are the variables shown at first, by default those that `plot` draws. FrotError (E0805)
    for a name that no variable has.
    """
    variables = result.program.variables
    chosen = result.numbers(chosen or ())
    names = [v.name for v in variables if "@" not in v.name]
    names += [name for name in chosen if name not in names and name != "time"]
    times = grid_of(result, len(names))
    values = result.take(names, times)
    kinds = {v.name: v for v in variables}
    curves = []
    for name in names:
        found = np.asarray(values[name], dtype=float)
        info = kinds.get(name)
        steps: Sequence[str] = ()
        if info is not None and info.type == "mode":
            steps = MODES
        elif info is not None and (info.literals or info.type == "boolean"):
            steps = ("", *info.literals) if info.literals else ("false", "true")
        unit = unit_of(result, name)
        curves.append(
            {
                "name": name,
                "unit": "" if unit in ("1", "mode") or steps else unit,
                "steps": list(steps),
                "mode": unit == "mode",
                "first": float(found[0]) if np.isfinite(found[0]) else 0.0,
                "y": packed(found - found[0]) if np.ptp(found) != 0 else "",
            }
        )
    return {
        "grid": times.tolist(),
        "curves": curves,
        "panels": _panels(result, chosen),
        "palette": COLOURS,
        "modeColours": list(MODE_COLOURS.values()),
    }


def grid_of(result: RunValues, count: int) -> Array:
    """Times of the curves: evenly, and both sides of events; the fewer, the more variables."""
    first, last = float(result.time[0]), float(result.time[-1])
    most = int(np.clip(MOST_VALUES / max(count, 1), LEAST, FINE))
    events = np.array([e.time for e in result.events if first < e.time < last])
    few = events[:: -(-len(events) // most) or 1]
    before = np.nextafter(few, first, dtype=float)
    return np.unique(np.concatenate((np.linspace(first, last, most), few, before)))


def _panels(result: RunValues, chosen: Sequence[str] | None) -> list[list[str]]:
    """The names in each panel: of one unit, modes by themselves."""
    if chosen:
        groups: dict[str, list[str]] = {}
        for name in chosen:
            if name == "time":
                continue
            groups.setdefault(unit_of(result, name), []).append(name)
        return list(groups.values())
    choice = choose(result)
    panels = [list(panel.names) for panel in choice.panels if panel.names]
    return [*panels, list(choice.modes)] if choice.modes else panels
