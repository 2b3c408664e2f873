"""Model exchange: integrated by FMPy's CVODE, a motion is that of `simulate` to its tolerance."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu

import frot

MODELS = Path(__file__).parents[2] / "models"
VERSIONS = ("2.0", "3.0")
# Errors of steps add up, and each event is met with an error of its own.
TOLERANCES = 100

# On the floor the body slips, sticks, slips, turns round and leaves; `way` mirrors it.
STICK = """planar model Stick
  parameter Real mu = 0.3;
  parameter Mass m = {mass} kg;
  body b: particle(mass = m);
  curve floor on ground: line(through = (0, 0) m, direction = ({cos}, {sin}));
  liaison c: contact_ponctuel(b, floor) with coulomb(mu);
  force f: on(b, value = ({along_x}, {along_y}) * ({mass} N));
  output Length x = ({cos})*b.position.x + ({sin})*b.position.y;
  output Length y = ({cos})*b.position.y - ({sin})*b.position.x;
initial
  b.position = (0, 0) m;
  b.velocity = ({way}*({cos}), {way}*({sin})) m/s;
  experiment(stop = 1.1 s);
end Stick;
"""
GRAVITY = "9.81"
SCENES = [(1.0, 0.0, 1.0), (-1.0, 0.0, 1.0), (1.0, 0.4, 1.0), (1.0, 0.0, 1e6), (-1.0, -0.3, 1e-6)]

TICKS = """model Ticks
  Integer k(start = 0);
  Real held(start = 0), x, y;
initial
  x = 1;
  y = 0;
equation
  der(x) = -x/(1 s);
  der(y) = (held - y)/(1 s);
  when sample(0.1 s, 0.1 s) then
    k = pre(k) + 1;
    held = x;
  end when;
  when x < 0.5 then
    reinit(y, -1);
  end when;
  experiment(stop = 1.5 s);
end Ticks;
"""

ENDS = """planar model Ends
  body b: particle(mass = 1 kg);
  output Length y = b.position.y;
initial
  b.position = (0, 0) m;
  b.velocity = (0, 2) m/s;
when b.velocity.y < (0 m/s) then
  terminate("at the top");
end when;
end Ends;
"""


def exported(model: frot.Model, folder: Path, version: str) -> Path:
    path = folder / f"m{version[0]}.fmu"
    model.export_fmu(path, version, "native")
    assert not validate_fmu(str(path))
    return path


def integrate(path: Path, names: list[str], stop: float, tolerance: float, **more: Any) -> Any:
    return simulate_fmu(
        str(path),
        stop_time=stop,
        output_interval=stop / 100,
        output=names,
        fmi_type="ModelExchange",
        relative_tolerance=tolerance,
        record_events=False,
        **more,
    )


def apart(got: Any, expected: frot.Result, name: str) -> float:
    other = np.asarray(expected.at(np.asarray(got["time"]))[name], dtype=float)
    return float(np.abs(got[name] - other).max() / np.abs(other).max())


def stick(way: float, tilt: float, mass: float) -> frot.Model:
    cos, sin = float(np.cos(tilt)), float(np.sin(tilt))
    # weight along the floor is taken away by the force: the motion is the same at any tilt
    along = f"{way!r}*4*sin(8*time/(1 s)) + {GRAVITY}*({sin!r})"
    up = f"12*sin(1.1*time/(1 s)) - {GRAVITY} + {GRAVITY}*({cos!r})"
    values = {"way": -0.3 * way, "cos": cos, "sin": sin, "mass": mass}
    values["along_x"] = f"({along})*({cos!r}) - ({up})*({sin!r})"
    values["along_y"] = f"({along})*({sin!r}) + ({up})*({cos!r})"
    return frot.compile(STICK.format(**values))


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize(("way", "tilt", "mass"), SCENES)
def test_a_body_slips_sticks_turns_round_and_leaves(
    tmp_path: Path, version: str, way: float, tilt: float, mass: float
) -> None:
    """The same to the tolerance of the other integrator, which is tightened four times."""
    model = stick(way, tilt, mass)
    expected = model.simulate(tolerance=1e-11)
    assert [event.kind for event in expected.events] == ["stick", "slip", "reversal", "separation"]
    path = exported(model, tmp_path, version)
    for tolerance in (1e-5, 1e-7, 1e-9):
        got = integrate(path, ["x", "y"], 1.1, tolerance)
        assert got["time"][-1] == pytest.approx(1.1)
        for name in ("x", "y"):
            other = np.asarray(expected.at(np.asarray(got["time"]))[name])
            # errors are bounded beside the nominal values of the states, 1 m and 1 m/s
            assert np.abs(got[name] - other).max() < TOLERANCES * tolerance


@pytest.mark.parametrize("version", VERSIONS)
def test_samples_and_jumps_of_the_text(tmp_path: Path, version: str) -> None:
    """A sampled value is held, a state jumps where another one passes a threshold."""
    model = frot.compile(TICKS)
    path = exported(model, tmp_path, version)
    expected = model.simulate(tolerance=1e-11)
    got = integrate(path, ["y"], 1.5, 1e-8)
    # near the jump one may be before it and the other one behind
    jump = np.abs(got["time"] - np.log(2)) > 1e-5
    other = np.asarray(expected.at(np.asarray(got["time"]))["y"])
    assert np.abs(got["y"] - other)[jump].max() < TOLERANCES * 1e-8
    assert float(got["y"].min()) < -0.9


@pytest.mark.parametrize("name", ["wheel_channel", "coulomb_oscillator", "geared_motor"])
def test_worked_models(tmp_path: Path, name: str) -> None:
    """A rolling wheel, an oscillator that comes to rest, a motor: their energies agree."""
    model = frot.load(MODELS / f"{name}.frot")
    path = exported(model, tmp_path, "3.0")
    _, stop = model.program().experiment.times()
    got = integrate(path, ["energy.kinetic"], stop, 1e-9)
    assert apart(got, model.simulate(tolerance=1e-11), "energy.kinetic") < 1e-6


@pytest.mark.parametrize("version", VERSIONS)
def test_a_chaotic_pendulum(tmp_path: Path, version: str) -> None:
    """Two bars hang from a pin and from each other, in coordinates of their joints."""
    model = frot.load(MODELS / "double_pendulum.frot")
    path = exported(model, tmp_path, version)
    names = ["second.position.x", "second.position.y"]
    _, stop = model.program().experiment.times()
    expected = model.simulate(tolerance=1e-11)
    got = integrate(path, names, stop, 1e-9)
    assert max(apart(got, expected, name) for name in names) < 1e-5


@pytest.mark.parametrize("version", VERSIONS)
def test_states_are_those_of_the_text(tmp_path: Path, version: str) -> None:
    model = stick(1.0, 0.0, 1.0)
    path = exported(model, tmp_path, version)
    described = read_model_description(str(path))
    rates = [v.variable for v in described.derivatives]
    states = [rate.derivative for rate in rates]
    assert described.modelExchange is not None
    assert described.coSimulation is not None
    count = len(model.program().states)
    assert [s.description for s in states][:count] == list(model.program().states)
    # dissipated energy, work
    assert len(states) == count + 2
    assert described.numberOfEventIndicators == model.program().guards or version == "3.0"
