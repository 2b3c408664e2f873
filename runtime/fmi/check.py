"""An FMU against the program it was made from: FMPy's rules, and the values of `simulate`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu
from frot.runtime.fmi import check_exchange
from frot.runtime.fmi.arrays import elements_in, grouped
from frot.runtime.fmi.scalars import scalars
from frot.runtime.fmi.terminals import terminal_problems
from frot.runtime.program import Program
from frot.runtime.result import Result

POINTS = 100
# Rounding of the functions of mathematics of another system, of a variable's largest value.
ALIKE = 1e-9
# Tolerance of the motion that model exchange is held against.
TIGHT = 1e-10


@dataclass(frozen=True, slots=True)
class Checked:
    """Objections of FMPy, and the largest relative difference of values with its place.

    `same`: the archive was made from this text, by this version of Frot. `exchanged`: the largest
    relative error in model exchange, by CVODE; None where that is not offered or not run.
    """

    problems: tuple[str, ...]
    same: bool
    apart: float = 0.0
    variable: str = ""
    exchanged: float | None = None

    @property
    def good(self) -> bool:
        """Whether nothing is wrong."""
        most = check_exchange.AMPLIFIED * check_exchange.TOLERANCE
        follows = self.exchanged is None or self.exchanged <= most
        return not self.problems and self.same and self.apart <= ALIKE and follows


def check(program: Program, path: Path, simulate: Callable[..., Result]) -> Checked:
    """Run the FMU at `path` over its default experiment and compare all numbers with `simulate`.

    In model exchange CVODE makes its own steps: `simulate` runs at a tight tolerance then, where
    co-simulation was right. An archive of another text, or one with faults, is not run. Exceptions
    are those of FMPy where it cannot be read or run.
    """
    description = read_model_description(str(path), validate=False)
    names = {v.name for v in description.modelVariables}
    problems = (*validate_fmu(str(path)), *terminal_problems(path, names))
    same = (description.guid or description.instantiationToken) == program.key
    if problems or not same:
        return Checked(problems, same)
    begin, end = program.experiment.times()
    arrays = any(v.dimensions for v in description.modelVariables)
    groups = [
        one
        for one in grouped(scalars(program)[1], arrays)
        if one.first.causality in ("output", "local") and not one.first.motion
    ]
    got: Any = simulate_fmu(
        str(path),
        start_time=begin,
        stop_time=end,
        output_interval=(end - begin) / POINTS,
        output=[one.name for one in groups],
        # Importers may set what is described.
        start_values={v.name: v.start for v in description.modelVariables if v.start is not None},
        fmi_type="CoSimulation",
    )
    # An instance adds each step to the point it began at, which rounds.
    reached = np.append(got["time"][:1], got["time"][:-1] + np.diff(got["time"]))
    expected = simulate().at(reached)
    apart, variable = 0.0, ""
    for element, own in elements_in(got, groups):
        other = np.asarray(expected[element.plain], dtype=float)
        size = float(np.abs(other).max()) or 1.0
        distance = float(np.abs(own - other).max()) / size
        if not distance <= apart:
            apart, variable = distance, element.plain
    if apart > ALIKE or not program.exchanges:
        return Checked(problems, same=True, apart=apart, variable=variable)
    tight = simulate(tolerance=TIGHT)
    exchanged, worst = check_exchange.largest_error(program, path, tight, arrays)
    done = Checked(problems, True, apart, variable, exchanged)
    return done if done.good else replace(done, variable=worst)
