"""Couples, dampers and drag against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from mechanical_scenes import Scenes, near

import frot

LOADED = """
planar model Loaded "A body in empty space under one force"
  parameter Length reach = 0 m;
  world(gravity = 0 m/s^2);
  body p: particle(mass = 2 kg);
  body r: rod(mass = 3 kg, length = 2 m);
  force f: {force};
initial
  p.position = (1, 0) m;
  p.velocity = (3, 0) m/s;
  r.position = (-4, 0) m;
  r.angular_velocity = 0.5 rad/s;
  experiment(stop = 2 s, tolerance = 1e-12);
end Loaded;
"""


def loaded(scenes: Scenes, force: str) -> frot.Result:
    return scenes.run(LOADED.format(force=force))


def test_a_couple_on_a_body_turns_it_and_moves_it_nowhere(scenes: Scenes) -> None:
    result = loaded(scenes, "couple(r, value = 4 N.m)")
    now = result.at(2.0)  # I = 3*2^2/12 = 1 kg.m^2
    assert near(now["r.angular_velocity"], 0.5 + 4 * 2.0, rel=1e-12)
    assert near(now["r.angle"], 0.5 * 2.0 + 4 * 2.0**2 / 2, rel=1e-12)
    assert near(now["r.position.x"], -4.0, rel=1e-15)
    assert abs(now["r.position.y"]) < 1e-15
    assert near(now["energy.work"], 4 * now["r.angle"], rel=1e-11)


def test_a_couple_that_depends_on_speed_brakes(scenes: Scenes) -> None:
    now = loaded(scenes, "couple(r, value = -0.7 N.m.s*r.angular_velocity)").at(2.0)
    assert near(now["r.angular_velocity"], 0.5 * math.exp(-0.7 * 2.0))


def test_a_damper_slows_along_its_line_only(scenes: Scenes) -> None:
    """To a fixed point ahead: v = v0 exp(-c t / m)."""
    now = loaded(scenes, "damper((20, 0) m, p, c = 1.5 N.s/m)").at(2.0)
    assert near(now["p.velocity.x"], 3 * math.exp(-1.5 / 2 * 2.0))
    across = loaded(scenes, "damper((1, -1e9) m, p, c = 1.5 N.s/m)").at(2.0)
    assert near(across["p.velocity.x"], 3.0, rel=1e-7)


def test_a_damper_takes_from_both_ends_what_it_turns_into_heat(scenes: Scenes) -> None:
    result = loaded(scenes, "damper(r.tip, p, c = 1.5 N.s/m)")
    now = result.at(np.linspace(0.0, 2.0, 30))
    momentum = 2 * now["p.velocity.x"] + 3 * now["r.velocity.x"]
    assert np.allclose(momentum, 6.0, rtol=1e-11)
    assert np.all(np.diff(now["energy.work"]) < 0)
    assert result.balance.relative < 1e-10


def test_a_damper_feels_how_fast_a_place_that_is_given_goes(scenes: Scenes) -> None:
    """v = u + (v0 - u) exp(-c t / m) to a place with speed u, however it is written."""
    exact = 2 + (3 - 2) * math.exp(-1.5 / 2 * 2.0)
    for place in ("(20 m + 2 m/s*time, 0 m)", "(20 m + 4 m/rad*r.angle, 0 m)"):
        result = loaded(scenes, f"damper({place}, p, c = 1.5 N.s/m)")
        assert near(result.at(2.0)["p.velocity.x"], exact)
        assert result.balance.relative < 1e-10


def test_a_damper_to_a_place_of_which_nobody_knows_how_fast_it_goes_is_refused() -> None:
    text = LOADED.format(force="damper((u, 0 m), p, c = 1.5 N.s/m)")
    with pytest.raises(frot.FrotError, match="the derivative of the input 'u' is not known here"):
        frot.compile(text.replace("  body p", "  input Length u;\n  body p")).simulate()


def test_drag_follows_the_power_of_the_speed_it_is_given(scenes: Scenes) -> None:
    linear = loaded(scenes, "drag(p, c = 0.8 N.s/m)").at(2.0)
    assert near(linear["p.velocity.x"], 3 * math.exp(-0.8 / 2 * 2.0))
    square = loaded(scenes, "drag(p, c = 0.8 kg/m, exponent = 2)").at(2.0)
    assert near(square["p.velocity.x"], 3 / (1 + 0.8 / 2 * 3 * 2.0))


def test_drag_on_a_point_of_a_body_brakes_its_rotation(scenes: Scenes) -> None:
    result = loaded(scenes, "drag(r.tip, c = 0.8 N.s/m)")
    assert abs(result.at(2.0)["r.angular_velocity"]) < 0.5
    assert result.at(0.0)["r.angular_acceleration"] == pytest.approx(-0.8 * 0.5 * 1.0**2)
    assert result.balance.relative < 1e-10


WALKED = """
planar model Walked "A rung walks along a rod that slides along itself, under one force"
  world(gravity = 0 m/s^2);
  body r: rod(mass = 2 kg, length = 4 m);
  frame rung on r at (0.3 m/s*time, 0 m);
  force f: {force};
initial
  r.position = (1, 0) m;
  r.velocity = (1.5, 0) m/s;
  experiment(stop = 2 s, tolerance = 1e-12);
end Walked;
"""
WALK, MASS, STOP = 0.3, 2.0, 2.0


def pulled() -> tuple[float, float]:
    """m x'' = -0.7 N."""
    return 1.5 - 0.7 / MASS * STOP, 0.0


def braked() -> tuple[float, float]:
    """The rung is at y = x + u t: m y'' = -c y'."""
    return (1.5 + WALK) * math.exp(-0.8 / MASS * STOP) - WALK, 0.0


def swung() -> tuple[float, float]:
    """Stretched by s = x + u t - 0.5 m: m s'' = -k s, s = s0 cos wt + s'0/w sin wt."""
    w, first, rate = math.sqrt(3 / MASS), 0.5, 1.5 + WALK
    stretch = first * math.cos(w * STOP) + rate / w * math.sin(w * STOP)
    return rate * math.cos(w * STOP) - first * w * math.sin(w * STOP) - WALK, stretch


WALKS = {
    "on(rung, value = (-0.7, 0) N)": pulled,
    "drag(rung, c = 0.8 N.s/m)": braked,
    "damper((-9, 0) m, rung, c = 0.8 N.s/m)": braked,
    "attraction(rung, (0.5, 0) m, k = 3 N/m)": swung,
    "spring((0, 0) m, rung, k = 3 N/m, length = 0.5 m)": swung,
    "spring((0, 0) m, rung, k = 3 N/m + 0 N/m/s*time, length = 0.5 m)": swung,
}


@pytest.mark.parametrize("force", WALKS)
def test_work_on_a_place_that_walks_is_done_on_the_point_it_is_at(
    scenes: Scenes, force: str
) -> None:
    """What is potential is kept as such: what moves the end of a spring works against it."""
    result = scenes.run(WALKED.format(force=force))
    now = result.at(STOP)
    speed, stretch = WALKS[force]()
    assert near(now["r.velocity.x"], speed, rel=1e-11)
    gained = MASS * (speed**2 - 1.5**2) / 2
    if "time" not in force:
        gained += 3 * (stretch**2 - 0.5**2) / 2 * (WALKS[force] is swung)
    assert near(now["energy.work"], gained, rel=1e-10)
    assert result.balance.relative < 1e-11


def test_work_on_a_place_that_walks_along_a_body_that_turns(scenes: Scenes) -> None:
    """Nothing else acts: the work is what the rod's energy of motion gets."""
    across = WALKED.replace("(1.5, 0) m/s;", "(1, 2) m/s; r.angle = 0.5;")
    result = scenes.run(across.format(force="on(rung, value = (0, -3) N)"))
    kinetic = result["energy.kinetic"]
    assert kinetic[-1] < 0.9 * kinetic[0]
    assert np.allclose(result["energy.work"], kinetic - kinetic[0], atol=1e-11)


def test_a_frame_of_the_ground_that_goes_does_no_work_on_the_ground(scenes: Scenes) -> None:
    """A body on a damper whose other end goes with u: m v' = c (u - v), W = m (v^2 - v0^2)/2."""
    going = WALKED.replace("on r at", "on ground at")
    result = scenes.run(going.format(force="damper(rung, r, c = 0.8 N.s/m)"))
    speed = WALK + (1.5 - WALK) * math.exp(-0.8 / MASS * STOP)
    now = result.at(STOP)
    assert near(now["r.velocity.x"], speed, rel=1e-11)
    assert near(now["energy.work"], MASS * (speed**2 - 1.5**2) / 2, rel=1e-10)


REFUSED = {
    "couple(p, value = 1 N.m)": ("E0205", "a couple on 'p', which does not turn"),
    "couple(ground, value = 1 N.m)": ("E0205", "a couple on 'ground', which does not turn"),
    "couple(g, value = 1 N.m)": ("E0205", "liaison 'g' has no angle that a couple could drive"),
    "drag(p, c = 1 N.s/m, exponent = 2)": ("E0301", "exponent 2 is in kg/m"),
    "drag(p, c = 1 kg/m)": ("E0301", "exponent 1 is in N.s/m"),
    "drag(p, c = 1 kg/m, exponent = 1.5)": ("E0301", "exponent 1.5 is in kg/m^(1/2)/s^(1/2)"),
}


@pytest.mark.parametrize("force", REFUSED)
def test_a_force_that_means_nothing_is_refused_by_name(force: str) -> None:
    code, cause = REFUSED[force]
    text = LOADED.format(force=f"{force};\n  liaison g: point_courbe(p, ground.line)")
    with pytest.raises(frot.FrotError) as fault:
        frot.compile(text).report()
    (message,) = fault.value.diagnostics
    assert message.code == code
    assert cause in message.message
