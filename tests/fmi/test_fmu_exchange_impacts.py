"""Model exchange: impacts that accumulate are gone through, and end in rest at their limit."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy import simulate_fmu

import frot

# A ball falls on a floor that stays the same seen along `up`; `push` is its weight.
BALL = """planar model Falls
  parameter Mass m = {mass} kg;
  parameter Length h = {height} m;
  world(gravity = 0 m/s^2);
  body b: disc(mass = m, radius = 0.1 m);
  curve floor on ground: line(through = (0, 0) m, direction = ({cos}, {sin}));
  liaison c: contact_ponctuel(floor, b.rim) with coulomb(0.3), restitution({bounce});
  force f: on(b, value = m*(-10 m/s^2)*(-({sin}), {cos}));
  output Length y = ({cos})*b.position.y - ({sin})*b.position.x - 0.1 m;
  output Velocity v = ({cos})*b.velocity.y - ({sin})*b.velocity.x;
initial
  b.position = (h + 0.1 m)*(-({sin}), {cos});
  b.velocity = (0, 0) m/s;
  b.angle = 0 rad;
  b.angular_velocity = 0 rad/s;
  experiment(stop = {stop} s);
end Falls;
"""
GRAVITY, HEIGHT = 10.0, 0.8
# Errors of steps and of events add up over the impacts; the last flights are lower than this.
TOLERANCES = 1000
SCENES = [(1.0, 0.0, 0.5), (1e6, 0.4, 0.5), (1e-6, 2.5, 0.8), (1.0, -0.3, 0.8)]


def heights(t: np.ndarray, bounce: float) -> tuple[np.ndarray, float]:
    """The height over the floor at the times t (s), in m, and when the impacts end, in s."""
    first = np.sqrt(2 * HEIGHT / GRAVITY)
    end = first * (1 + bounce) / (1 - bounce)
    y = np.where(t < first, HEIGHT - GRAVITY * t**2 / 2, 0.0)
    begin, speed = first, bounce * GRAVITY * first
    while speed > 1e-12:
        flight = 2 * speed / GRAVITY
        inside = (t >= begin) & (t < begin + flight)
        y[inside] = (speed * (t - begin) - GRAVITY * (t - begin) ** 2 / 2)[inside]
        begin, speed = begin + flight, bounce * speed
    return y, end


def integrate(path: Path, stop: float, tolerance: float, told: list[bytes]) -> Any:
    return simulate_fmu(
        str(path),
        stop_time=stop,
        output_interval=stop / 400,
        output=["y", "v"],
        fmi_type="ModelExchange",
        relative_tolerance=tolerance,
        record_events=False,
        debug_logging=True,
        logger=lambda *message: told.append(message[-1]),
    )


@pytest.mark.parametrize("version", ["2.0", "3.0"])
@pytest.mark.parametrize(("mass", "tilt", "bounce"), SCENES)
def test_a_ball_bounces_until_it_rests(
    tmp_path: Path, version: str, mass: float, tilt: float, bounce: float
) -> None:
    """The closed form, also for tilted floors and other masses; at its limit the ball rests."""
    cos, sin, stop = float(np.cos(tilt)), float(np.sin(tilt)), 5.0
    text = BALL.format(
        mass=mass, height=HEIGHT, cos=repr(cos), sin=repr(sin), bounce=bounce, stop=stop
    )
    path = tmp_path / "ball.fmu"
    frot.compile(text).export_fmu(path, version, "native")
    for tolerance in (1e-6, 1e-8):
        told: list[bytes] = []
        got = integrate(path, stop, tolerance, told)
        time = np.asarray(got["time"])
        expected, end = heights(time, bounce)
        assert time[-1] == pytest.approx(stop)
        assert np.abs(got["y"] - expected).max() < TOLERANCES * tolerance
        late = time > end + 0.1
        assert late.sum() > 50
        assert np.abs(got["v"][late]).max() < 1e-12
        assert np.abs(got["y"][late]).max() < 1e-12
        assert sum(b"impact" in message for message in told) > 8
        assert b"further impacts end" in b"".join(told)


def test_a_block_rocks_until_it_stands(tmp_path: Path) -> None:
    """Each corner meets the floor while the other leaves it; in the end both stay there."""
    model = frot.load(Path(__file__).parents[2] / "models" / "rocking_block.frot")
    path = tmp_path / "block.fmu"
    model.export_fmu(path, "3.0", "native")
    errors = []
    for tolerance in (1e-6, 1e-8):
        got: Any = simulate_fmu(
            str(path),
            stop_time=4.0,
            output_interval=0.01,
            output=["block.angle", "block.angular_velocity", "floor[1].mode", "floor[2].mode"],
            fmi_type="ModelExchange",
            relative_tolerance=tolerance,
            record_events=False,
        )
        expected = model.simulate(tolerance=1e-10).at(np.asarray(got["time"]))
        errors.append(float(np.abs(got["block.angle"] - expected["block.angle"]).max()))
        assert abs(got["block.angle"][-1]) < 1e-12
        assert abs(got["block.angular_velocity"][-1]) < 1e-12
        assert got["floor[1].mode"][-1] == got["floor[2].mode"][-1] == 1
    assert errors[1] < 0.2 * errors[0]
    assert errors[1] < 1e-4
