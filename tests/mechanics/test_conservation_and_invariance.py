"""Energy, friction cone, sense of friction, momentum, translations, Galilean frames, start time."""

from __future__ import annotations

import math

import numpy as np
import pytest
from mechanical_scenes import (
    BAR,
    BEAD_AND_SPRING,
    BLOCK,
    DRAGGED,
    FIVE_BLOCKS,
    GROOVE,
    HOOP,
    LIFTED,
    OSCILLATOR,
    PAINLEVE_ROD,
    PULLED,
    TWO_BLOCKS,
    WEDGE_AND_BEAD,
    WEDGE_AND_HOOP,
    Scenes,
    rests_from,
    weighed,
)

# text, parameters, static coefficient of each liaison, rolling resistance (a length)
SCENES: dict[str, tuple[str, dict, dict[str, float], float]] = {
    "block": (weighed(BLOCK, "b"), {"slope": -0.2}, {"support": 0.3}, 0.0),
    "oscillator": (OSCILLATOR, {"slope": 0.1, "stop": 12.0}, {"guide": 0.1}, 0.0),
    "hoop": (weighed(HOOP, "hoop"), {"slope": 0.05, "delta": 0.01}, {"floor": 0.3}, 0.01),
    "bead": (BEAD_AND_SPRING, {"stop": 4.0, "k": 40.0}, {"guide": 0.2}, 0.0),
    "pulled": (PULLED, {"slope": 0.1}, {"support": 0.4}, 0.0),
    "dragged": (DRAGGED, {}, {"support": 0.4}, 0.0),
    "two blocks": (TWO_BLOCKS, {}, {"left": 0.2, "right": 0.2}, 0.0),
    "five blocks": (FIVE_BLOCKS, {}, {f"l{i}": 0.15 for i in range(5)}, 0.0),
    "wedge and hoop": (WEDGE_AND_HOOP, {"f": 0.2}, {"side": 0.2}, 0.0),
    "wedge and bead": (WEDGE_AND_BEAD, {"C": -0.4, "v0": 3.0}, {"floor": 0.05, "side": 0.1}, 0.0),
    "bar": (BAR.format(angle="th0", rate="w0"), {"stop": 5.0}, {"a": 0.3, "b": 0.2}, 0.0),
    "groove": (GROOVE, {"w0": 15.0, "delta": 0.01}, {"a": 0.3, "b": 0.3}, 0.01),
    "lifted ring": (LIFTED, {"stop": 1.9}, {"floor": 0.2}, 0.0),
    "painleve rod": (
        PAINLEVE_ROD.format(option=""),
        {"f": 0.5, "th": 1.1, "stop": 0.3},
        {"tip": 0.5},
        0.0,
    ),
}


@pytest.mark.parametrize("name", SCENES)
def test_energy_is_kept_and_friction_stays_in_its_cone_and_never_drives(
    scenes: Scenes, name: str
) -> None:
    text, parameters, bounds, delta = SCENES[name]
    result = scenes.run(text, **parameters)
    grid = np.linspace(result.time[0], result.time[-1], 2000)
    now = result.at(np.unique(np.concatenate([grid, [e.time for e in result.events]])))
    assert result.balance.relative < 1e-9
    for liaison, mu in bounds.items():
        normal, tangent = now[f"{liaison}.normal_force"], now[f"{liaison}.tangential_force"]
        largest = np.max(np.abs(normal))
        assert np.all(np.abs(tangent) <= mu * np.abs(normal) + 1e-10 * largest)
        assert np.all(np.abs(now[f"{liaison}.torque"]) <= delta * np.abs(normal) + 1e-10 * largest)
        power = now[f"{liaison}.power"]
        assert np.all(power <= 1e-12 * (1 + np.max(np.abs(power))))
        held = now[f"{liaison}.mode"] == 1
        assert np.max(np.abs(now[f"{liaison}.slip"][held]), initial=0.0) < 1e-13
        slides = now[f"{liaison}.mode"] == 2
        assert np.all(now[f"{liaison}.slip"][slides] * tangent[slides] <= 1e-12 * largest)
    assert np.all(np.diff(now["energy.dissipated"]) >= -1e-13 * (1 + now["energy.dissipated"][-1]))


@pytest.mark.parametrize("name", SCENES)
def test_a_motion_repeats_to_the_bit(scenes: Scenes, name: str) -> None:
    """Nothing is carried from run to run."""
    text, parameters, _, _ = SCENES[name]
    one, two = scenes.run(text, **parameters), scenes.run(text, **parameters)
    assert one.events == two.events
    for variable in one:
        assert np.array_equal(one[variable], two[variable])


@pytest.mark.parametrize("start", [-7.0, 3.0, 1000.0])
def test_a_scene_without_clock_moves_alike_whenever_it_starts(scenes: Scenes, start: float) -> None:
    plain = scenes.run(weighed(HOOP, "hoop"), delta=0.01, stop=3.0)
    later = scenes.run(weighed(HOOP, "hoop"), delta=0.01, start=start, stop=start + 3.0)
    assert [e.kind for e in plain.events] == [e.kind for e in later.events]
    assert len(plain.events) > 0
    for a, b in zip(plain.events, later.events, strict=True):
        assert abs(b.time - start - a.time) < 1e-13 * (abs(start) + 3)
    for name in ("hoop.position.x", "hoop.angle", "hoop.velocity.x"):
        assert abs(plain[name][-1] - later[name][-1]) < 1e-12 * (abs(start) + 3)


def test_the_two_blocks_keep_the_momentum_that_friction_does_not_take(scenes: Scenes) -> None:
    """No friction: the centre of mass of two blocks on one line goes on at its speed."""
    result = scenes.run(TWO_BLOCKS, mu=0.0, stop=5.0)
    total = result["a.velocity.x"] + result["b.velocity.x"]
    assert np.max(np.abs(total)) < 1e-12
    assert result.events == ()


@pytest.mark.parametrize("move", [(100.0, -100.0), (-1e4, 3e3)])
def test_a_scene_far_away_moves_alike(scenes: Scenes, move: tuple[float, float]) -> None:
    here = scenes.run(weighed(HOOP, "hoop"), slope=0.3, delta=0.02, v0=5.0)
    there = scenes.run(weighed(HOOP, "hoop"), slope=0.3, delta=0.02, v0=5.0, x0=move[0], y0=move[1])
    size = max(map(abs, move))
    assert [e.kind for e in here.events] == [e.kind for e in there.events]
    for a, b in zip(here.events, there.events, strict=True):
        assert abs(a.time - b.time) < 1e-14 * size
    for axis, by in zip("xy", move, strict=True):
        name = f"hoop.position.{axis}"
        assert np.max(np.abs(there[name] - here[name] - by)) < 1e-14 * size


def test_momentum_along_a_smooth_ground_is_kept(scenes: Scenes) -> None:
    """Wedge and hoop push each other; nothing pushes them along the ground."""
    result = scenes.run(WEDGE_AND_HOOP, f=0.2, M=2.0, v0=1.0)
    momentum = 2.0 * result["wedge.velocity.x"] + result["hoop.velocity.x"]
    assert np.max(np.abs(momentum - momentum[0])) < 1e-13 * (1 + abs(momentum[0]))


@pytest.mark.parametrize("speed", [5.0, -300.0])
def test_a_wedge_on_smooth_ground_with_its_bead_moves_alike_in_every_galilean_frame(
    scenes: Scenes, speed: float
) -> None:
    text = WEDGE_AND_BEAD.replace("v0 = 1 m/s;", "v0 = 1 m/s;\n  parameter Velocity V = 0 m/s;")
    text = text.replace("wedge.velocity = (0, 0) m/s", "wedge.velocity = (V, 0 m/s)")
    text = text.replace("(v0*cos(C), -v0*sin(C))", "(V + v0*cos(C), -v0*sin(C))")
    given = {"M": 2.0, "C": -0.4, "v0": 3.0, "f": 0.5, "f_ground": 0.0, "stop": 2.0}
    still, gliding = scenes.run(text, **given), scenes.run(text, V=speed, **given)
    assert [e.kind for e in still.events] == [e.kind for e in gliding.events] == ["stick"]
    assert abs(still.events[0].time - gliding.events[0].time) < 1e-14 * abs(speed) + 1e-13
    drift = gliding["wedge.position.x"] - still["wedge.position.x"] - speed * still.time
    assert np.max(np.abs(drift)) < 1e-14 * abs(speed) + 1e-12
    assert np.max(np.abs(gliding["side.abscissa"] - still["side.abscissa"])) < 1e-12 * abs(speed)


@pytest.mark.parametrize("stop", [1e2, 1e4, 1e6])
def test_rest_lasts(scenes: Scenes, stop: float) -> None:
    """A block at rest does not creep, however long and however near its bound."""
    mu = 0.3
    slope = -math.atan(mu * (1 - 1e-9))
    result = scenes.run(weighed(BLOCK, "b"), slope=slope, mu=mu, v0=0.0, x0=1 / 3, stop=stop)
    assert result.events == ()
    assert rests_from(result, 0.0, "b")
