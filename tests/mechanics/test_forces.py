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
