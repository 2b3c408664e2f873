"""The report looks at the posture at which the run starts.

It finds that posture by itself, since `frot check` needs no C compiler. Over all models both are
the same.
"""

from __future__ import annotations

from pathlib import Path

import casadi as ca
import numpy as np
import pytest
from frot.compiler import driver
from frot.compiler.lowering.initial_problem import pose_initial_problem
from frot.compiler.lowering.result_variables import list_variables
from frot.compiler.lowering.state import state_arguments
from frot.compiler.report.numbers import Numbers
from frot.compiler.report.start import find_start
from frot.compiler.symbolic.columns import column
from frot.dsl import Log, load
from frot.runtime import run

import frot

MODELS = Path(__file__).parents[2] / "models"
LIBRARIES = {"Blocks", "Electrical", "Rotational", "Translational"}
OPEN = 0.0
BOUND = 1e-8
# Statements and relations leave the turn of this cone about its own axis free. Both searches take
# one near the guess, which is 0.08 away; the two ways there differ by the cube of that.
LEFT_FREE = {"rolling_cone": 1e-4}


def _places(path: Path) -> tuple[dict[str, float], dict[str, bool]] | None:
    """Positions, angles and gaps where the report starts, and which contacts touch there."""
    log = Log()
    model = load(path, log)
    assert model is not None
    if not model.bodies:
        return None
    system = driver.assembled_of(model, log)
    assert system is not None
    problem = pose_initial_problem(system, log)
    start = find_start(system, problem)
    assert start.found
    variables = list_variables(system, problem.display)
    without_auxiliary = system.reduced.variables.without_auxiliary
    values = [system.resolve(without_auxiliary(v.value)) for v in variables]
    state = state_arguments(system)
    unknown = ca.vertcat(system.v, system.z, system.lam, system.reduced.symbols.energy)
    known = [
        (variable.name, value)
        for variable, value in zip(variables, values, strict=True)
        if not variable.mode and not (unknown.numel() and ca.depends_on(value, unknown))
    ]
    posture = start.posture
    elements = np.ones(len(system.elements))
    d = np.concatenate([start.flags, posture.sides, elements, start.discrete])
    function = Numbers("values", state, [column(value for _, value in known)])
    speeds = np.zeros(system.nv)
    found = function(posture.t, start.system_q, speeds, posture.u, posture.p, d, start.y)[0].ravel()
    contacts = system.reduced.mechanism.contacts
    touching = {
        x.liaison.name: bool(closed)
        for x, closed in zip(contacts, start.closed, strict=True)
        if x.opens and x.has_gap
    }
    return {name: float(x) for (name, _), x in zip(known, found, strict=True)}, touching


@pytest.mark.parametrize(
    "name", [x.stem for x in sorted(MODELS.glob("*.frot")) if x.stem not in LIBRARIES]
)
def test_the_report_starts_where_the_run_does(name: str) -> None:
    here = _places(MODELS / f"{name}.frot")
    if here is None:
        assert not frot.load(MODELS / f"{name}.frot").checked().bodies
        return
    places, touching = here
    program = frot.load(MODELS / f"{name}.frot").program()
    values = run.begin(program).now()
    names = [v.name for v in program.variables]
    there = dict(zip(names, values, strict=True))
    assert places
    bound = LEFT_FREE.get(name, BOUND)
    for place, value in places.items():
        assert there[place] == pytest.approx(value, rel=bound, abs=bound), place
    for liaison, closed in touching.items():
        mode = there.get(f"{liaison}.mode")
        if mode is not None:
            assert (mode != OPEN) == closed, liaison
