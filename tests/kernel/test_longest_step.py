"""Of equations without speeds the longest step grows with the time already run."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from fmpy import simulate_fmu

import frot

DECAY = """
model Decay
  Real x(start = 1);
initial
  x = 1;
equation
  der(x) = -x*(1 1/s);
  {experiment}
end Decay;
"""
GLIDER = """
planar model Glider "A particle that a drag slows down on a line: v = V exp(-t/T), T = m/c"
  world(gravity = 0 m/s^2);
  body p: particle(mass = 2 kg);
  force air: drag(p, c = 4 N.s/m, exponent = 1);
initial
  p.velocity = (3, 4) m/s;
  {experiment}
end Glider;
"""
ORBIT = """
planar model Orbit "A particle on a spring of no length turns for ever: x = r cos(omega t)"
  world(gravity = 0 m/s^2);
  body p: particle(mass = 1 kg);
  force pull: attraction(p, ground, k = 1 N/m);
initial
  p.position = (1, 0) m;
  p.velocity = (0, 1) m/s;
  {experiment}
end Orbit;
"""
WRITTEN = "experiment(stop = 1 s);"


@pytest.mark.parametrize("stop", [1e4, 1e6, 1e9])
def test_what_has_died_out_takes_few_steps_whatever_the_stop_of_the_text(stop: float) -> None:
    model = frot.compile(DECAY.format(experiment=WRITTEN))
    assert model.simulate(stop=stop).figures.steps < 600


def test_values_do_not_depend_on_the_stop_of_the_run() -> None:
    for text in (DECAY, GLIDER, ORBIT):
        model = frot.compile(text.format(experiment=WRITTEN))
        times = np.linspace(0, 1, 37)
        short, long = (model.simulate(stop=stop).at(times) for stop in (1.0, 1e3))
        for name in model.simulate():
            if name != "time":
                assert np.array_equal(short[name], long[name]), name


def test_a_motion_that_lasts_is_followed_as_before() -> None:
    """The error control bounds its steps."""
    result = frot.compile(ORBIT.format(experiment=WRITTEN)).simulate(stop=400.0, tolerance=1e-10)
    assert np.abs(result["p.position.x"] - np.cos(result.time)).max() < 1e-6


def test_what_died_out_keeps_its_place() -> None:
    """The particle comes to rest at V T."""
    result = frot.compile(GLIDER.format(experiment=WRITTEN)).simulate(stop=1e3, tolerance=1e-10)
    assert result["p.position.x"][-1] == pytest.approx(3 * 0.5, rel=1e-8)
    assert result.at(0.7)["p.velocity.y"] == pytest.approx(4 * math.exp(-1.4), rel=1e-8)


def test_max_step_bounds_the_steps_of_a_long_run() -> None:
    text = DECAY.format(experiment="experiment(stop = 1 s, max_step = 2 s);")
    assert 500 <= frot.compile(text).simulate(stop=1000.0).figures.steps < 700


@pytest.mark.parametrize("interval", [0.7, 130.0])
@pytest.mark.parametrize("text", [DECAY, GLIDER], ids=["equation", "mechanics"])
def test_an_fmu_takes_the_same_steps(text: str, interval: float, tmp_path: Path) -> None:
    model = frot.compile(text.format(experiment=WRITTEN))
    archive = tmp_path / "long.fmu"
    model.export_fmu(archive, platforms="native")
    names = [v.name for v in model.program().variables if v.type == "real"]
    got = simulate_fmu(str(archive), stop_time=1300.0, output_interval=interval, output=names)
    given = got["time"]
    reached = np.append(given[:1], given[:-1] + np.diff(given))
    expected = model.simulate(stop=1301.0).at(reached)
    for name in names:
        assert np.array_equal(got[name], expected[name]), name
