"""Dependencies of outputs and of the rates of states are true: each known is moved."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from test_fmu_derivatives import Instance

import frot

MODELS = Path(__file__).parents[2] / "models"
# Of the largest derivative: below it one is zero.
NONE = 1e-9

# Two mechanisms and a filter: the filter reads the first one, a force on the second one the filter.
PARTS = """planar model Parts
  input Force push(start = 0.1 N);
  input Real level(start = 0.2);
  parameter Mass m = 2 kg;
  body a: particle(mass = m);
  body b: particle(mass = 1 kg);
  curve low on ground: line(through = (0, 0) m, direction = (1, 0));
  curve high on ground: line(through = (0, 1) m, direction = (1, 0.2));
  liaison la: point_courbe(a, low) with coulomb(0.1);
  liaison lb: point_courbe(b, high);
  force f: on(a, value = (push + 0.3 N*sin(a.position.x/(1 m)), -1 N));
  force g: on(b, value = (0.1 N*filtered^2, 0 N) - 0.2 N.s/m*b.velocity);
  Real filtered(start = 0.3, nominal = 10);
  output Real shown = filtered + level^2;
  output Real late = sin(time/(1 s));
  output Force held = la.normal_force;
  output Acceleration first = a.acceleration.x;
  output Acceleration second = b.acceleration.x;
equation
  der(filtered) = (a.position.x/(1 m) - filtered)/(1 s);
initial
  a.position = (0.4, 0) m;
  a.velocity = (1, 0) m/s;
  b.position = (0.5, 1.1) m;
  b.velocity = (1, 0.2) m/s;
  filtered = 0.3;
  experiment(stop = 1 s);
end Parts;
"""


def listed(one: Instance) -> dict[str, set[str]]:
    """What each output and each rate of a coordinate or speed depends on, by the description."""
    unknowns = [*one.description.outputs, *one.description.derivatives[:-2]]
    every = set(knowns(one))
    found = {}
    for unknown in unknowns:
        given = unknown.dependencies
        found[unknown.variable.name] = every if given is None else {v.name for v in given} & every
    return found


def knowns(one: Instance) -> list[str]:
    """States, inputs that are real, and time."""
    states = [v.variable.derivative.name for v in one.description.derivatives[:-2]]
    inputs = [
        v.name
        for v in one.description.modelVariables
        if v.causality == "input" and v.type in ("Real", "Float64")
    ]
    return [*states, *inputs, "time"]


def acting(one: Instance) -> dict[str, set[str]]:
    """What changes each of them, where the instance is."""
    unknowns = [
        v.variable
        for v in (*one.description.outputs, *one.description.derivatives[:-2])
        if v.variable.type in ("Real", "Float64")
    ]
    names = knowns(one)
    references = [v.valueReference for v in unknowns]
    matrix = np.array([one.derive(references, [one.references[name]], [1.0]) for name in names])
    return {
        v.name: {names[k] for k in np.nonzero(np.abs(matrix[:, i]) > NONE)[0]}
        for i, v in enumerate(unknowns)
    }


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_dependencies_are_those_that_act(tmp_path: Path, version: str) -> None:
    """In a motion without special values each dependency acts, and nothing else does."""
    path = tmp_path / "m.fmu"
    frot.compile(PARTS).export_fmu(path, version, "native")
    one = Instance(path, "ModelExchange")
    found = acting(one)
    given = listed(one)
    outputs = {v.variable.name for v in one.description.outputs}
    for name, acts in found.items():
        assert acts <= given[name], name
        # modes follow all that acts on them: of rates and reactions more is listed than acts here
        if name in ("shown", "late"):
            assert acts == given[name], name
    assert {"first", "second", "shown", "late", "held"} <= outputs
    # the block on the rough line knows nothing of the filter and of the other one
    states = dict(zip(frot.compile(PARTS).program().states, knowns(one), strict=False))
    assert states["filtered"] not in given["first"]
    assert "level" not in given["first"] | given["second"]
    assert {"push", states["filtered"]} & given["second"] == {states["filtered"]}
    (nominal,) = {v.nominal for v in one.description.modelVariables if v.name == states["filtered"]}
    assert float(nominal) == 10


@pytest.mark.parametrize(
    "name", ["geared_motor", "bicycle", "speed_drive", "slider_crank", "two_hoops", "wheelset"]
)
def test_nothing_acts_that_is_not_listed(tmp_path: Path, name: str) -> None:
    path = tmp_path / "m.fmu"
    frot.load(MODELS / f"{name}.frot").export_fmu(path, "3.0", "native")
    one = Instance(path, "ModelExchange")
    given = listed(one)
    for unknown, acts in acting(one).items():
        assert acts <= given[unknown], unknown
