"""An FMU in model exchange against `simulate`: FMPy's CVODE steps its motion."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from fmpy import simulate_fmu
from frot.runtime.fmi.arrays import elements_in, grouped
from frot.runtime.fmi.scalars import Scalar, scalars
from frot.runtime.program import Program
from frot.runtime.result import Result

POINTS = 200
# Tolerance of CVODE, and what a motion may make of it until its end.
TOLERANCE = 1e-8
AMPLIFIED = 1e5
# Size in SI that errors are measured by at least: the nominal one of states, also for CVODE.
NOMINAL = 1.0
# Part of the run next to an event in which one motion is before it and the other one behind.
NEAR = 1e-3


def followed(program: Program) -> dict[str, str]:
    """Places, speeds, outputs and states by their names in the FMU; forces jump at events."""
    words = ("position", "velocity", "angle", "speed", "energy.kinetic")
    free = [
        v
        for v in scalars(program)[1]
        if v.type == "real" and not v.motion and v.causality in ("output", "local")
    ]

    def moves(v: Scalar) -> bool:
        return v.plain in program.states or v.plain.endswith(words) or "velocity." in v.plain

    chosen = [v for v in free if v.causality == "output" or moves(v)]
    return {v.name: v.plain for v in chosen or free}


def largest_error(
    program: Program, path: Path, expected: Result, arrays: bool = False
) -> tuple[float, str]:
    """The largest error in parts of a variable's largest value, at least 1 in SI, and its name.

    `arrays`: the FMU describes vectors as arrays. Infinite where the run ends before its time.
    Exceptions are those of FMPy.
    """
    begin, end = program.experiment.times()
    names = followed(program)
    groups = [
        one
        for one in grouped(scalars(program)[1], arrays)
        if any(x.name in names for x in one.elements)
    ]
    # A text that ends the run does so in both.
    got: Any = simulate_fmu(
        str(path),
        start_time=begin,
        stop_time=end,
        relative_tolerance=TOLERANCE,
        output_interval=(end - begin) / POINTS,
        output=[one.name for one in groups],
        fmi_type="ModelExchange",
        record_events=False,
    )
    time = np.asarray(got["time"])
    if time[-1] < expected.time[-1] - (end - begin) / POINTS:
        return float("inf"), "time"
    other = expected.at(np.minimum(time, expected.time[-1]))
    clear = np.ones(len(time), dtype=bool)
    for event in expected.events:
        clear &= np.abs(time - event.time) > NEAR * (end - begin)
    apart, variable = 0.0, ""
    for element, own in elements_in(got, groups):
        if element.name not in names:
            continue
        values = np.asarray(other[element.plain], dtype=float)
        size = max(float(np.abs(values).max()), NOMINAL)
        distance = float(np.abs(own - values)[clear].max(initial=0.0)) / size
        if not distance <= apart:
            apart, variable = distance, element.plain
    return apart, variable
