"""Couples about each axis of a universal joint: `couple(..., coordinate = angle_a)`."""

from __future__ import annotations

import numpy as np
import pytest

import frot

TEXT = """model Cross
  world(gravity = 0 m/s^2);
  body b: solid(mass = 1 kg, inertia = (2, 3, 5) kg.m^2);
  liaison u: cardan(ground, b{axes});
  {forces}
initial
  u.angle_a = {a} deg;
  u.angle_b = {b} deg;
  experiment(stop = 1 s, tolerance = 1e-11);
end Cross;
"""


def run(forces: str, axes: str = "", a: float = 0, b: float = 0) -> frot.Result:
    return frot.compile(TEXT.format(forces=forces, axes=axes, a=a, b=b)).simulate()


@pytest.mark.parametrize("way", [1, -1])
def test_about_the_axis_of_the_ground(way: int) -> None:
    """Axis z of a: about it the body has 5 kg.m^2, and turns without the other axis."""
    found = run(f"force f: couple(u, value = {way}*10 N.m, coordinate = angle_a);")
    assert np.abs(found["u.angle_a"] - way * found.time**2).max() < 1e-9
    assert np.abs(found["u.angle_b"]).max() < 1e-9


@pytest.mark.parametrize("turned", [0, 40])
def test_about_the_axis_of_the_body(turned: float) -> None:
    """Axis y of b: about it the body has 3 kg.m^2, whatever its first angle is."""
    found = run("force f: couple(u, value = 6 N.m, coordinate = angle_b);", a=turned)
    assert np.abs(found["u.angle_b"] - found.time**2).max() < 1e-9


def test_the_work_of_both() -> None:
    """Their work, M_a times angle_a and M_b times angle_b, is the kinetic energy."""
    forces = (
        "force f: couple(u, value = 4 N.m, coordinate = angle_a);"
        "force g: couple(u, value = -7 N.m, coordinate = angle_b);"
        "output Energy e = b.kinetic_energy;"
    )
    axes = ", axis_a = (1, 2, 2), axis_b = (2, 1, -2)"
    found = run(forces, axes, 10, 20)
    a, b = (found[f"u.angle_{x}"] - found[f"u.angle_{x}"][0] for x in "ab")
    assert np.abs(4 * a - 7 * b - found["e"]).max() < 1e-8
    assert found["e"][-1] > 1


def test_named_where_there_is_one_angle() -> None:
    """A pin takes the name of its angle, or none."""
    text = """planar model Pin
      body b: disc(mass = 2 kg, radius = 1 m);
      liaison p: rotoide(ground, b);
      force f: couple(p, value = 2 N.m{more});
      experiment(stop = 1 s);
    end Pin;
    """
    for more in ("", ", coordinate = angle"):
        found = frot.compile(text.format(more=more)).simulate()
        assert found["p.speed"][-1] == pytest.approx(2, rel=1e-9)


@pytest.mark.parametrize(
    ("force", "words"),
    [
        ("couple(u, value = 1 N.m)", "several angles.*`coordinate = angle_a`"),
        ("couple(u, value = 1 N.m, coordinate = angle)", "no angle 'angle'.*angle_a"),
        ("couple(b, value = (1, 0, 0) N.m, coordinate = angle_a)", "a couple on a body.*leave it"),
    ],
)
def test_what_is_no_angle_is_refused(force: str, words: str) -> None:
    with pytest.raises(frot.FrotError, match=f"(?s)^error.E0205.*{words}"):
        run(f"force f: {force};")


def test_the_reaction_of_a_stop_is_that_of_its_liaison() -> None:
    """A rod that hangs down on a stop presses it by m g l/2 cos(angle): the torque of the pin."""
    text = """planar model Rests
      body b: rod(mass = 2 kg, length = 1 m);
      liaison h: rotoide(ground, b.start) with stops(-30 deg, 30 deg);
      output Torque m = h.{name};
    initial
      h.angle = 0 rad;
      experiment(stop = 1 s);
    end Rests;
    """
    found = frot.compile(text.format(name="torque")).simulate()
    assert found["m"][-1] == pytest.approx(2 * 9.81 / 2 * np.cos(np.pi / 6), rel=1e-9)
    for name in ("stops.min.normal_force", "stops.torque"):
        with pytest.raises(frot.FrotError, match=r"(?s)E0203.*stops of liaison 'h'.*'h.torque'"):
            frot.compile(text.format(name=name)).simulate()
