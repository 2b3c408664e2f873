"""`viscous` twice on what slides and turns: a coefficient in N.s/m and one in N.m.s."""

from __future__ import annotations

import math

import numpy as np
import pytest

import frot

TEXT = """model Two
  parameter Mass m = {mass!r} kg;
  world(gravity = 0 m/s^2);
  body b: cylinder(mass = m, radius = 0.1 m, length = 0.3 m);
  liaison g: {kind} with {laws};
initial
  {start}
  experiment(stop = 2 s, tolerance = 1e-11);
end Two;
"""
SLIDE, TURN = 0.7, 1.3
PIN = "verrou(ground, b, axis = z)"
TILTED = "verrou(ground, b, axis = (1, -2, 2))"
PLANE = "appui_plan(ground, b)"


@pytest.mark.parametrize("mass", [1e-6, 1.0, 1e6])
@pytest.mark.parametrize("order", [1, -1])
@pytest.mark.parametrize("kind", [PIN, TILTED])
def test_a_pin_that_slides_has_one_for_each_coordinate(kind: str, order: int, mass: float) -> None:
    """Both speeds decay, each by its own coefficient, whatever the order of the laws."""
    inertia = mass * 0.1**2 / 2
    if kind is TILTED:  # axis e = (1, -2, 2)/3 of the body: Izz e_z^2 + Ixx (1 - e_z^2)
        inertia = inertia * 4 / 9 + mass * (0.1**2 / 4 + 0.3**2 / 12) * 5 / 9
    laws = [f"viscous({SLIDE * mass!r} N.s/m)", f"viscous({TURN * inertia!r} N.m.s)"][::order]
    start = "g.speed = -1.5 m/s; g.speed_angle = 2 rad/s;"
    run = frot.compile(
        TEXT.format(mass=mass, kind=kind, laws=", ".join(laws), start=start)
    ).simulate()
    assert np.abs(run["g.speed"] + 1.5 * np.exp(-SLIDE * run.time)).max() < 1e-9
    assert np.abs(run["g.speed_angle"] - 2 * np.exp(-TURN * run.time)).max() < 1e-9
    power = mass * SLIDE * run["g.speed"] ** 2 + inertia * TURN * run["g.speed_angle"] ** 2
    assert run["g.power"] == pytest.approx(-power, rel=1e-9)
    assert run.balance.relative < 1e-9


def test_a_plane_has_one_for_the_slip_and_one_for_the_turning() -> None:
    inertia = 2 * 0.1**2 / 2
    laws = f"viscous({2 * SLIDE} N.s/m), viscous({TURN * inertia!r} N.m.s)"
    start = "b.velocity = (1, 0.5, 0) m/s; b.angular_velocity = (0, 0, 2) rad/s;"
    run = frot.compile(TEXT.format(mass=2.0, kind=PLANE, laws=laws, start=start)).simulate()
    decay = math.exp(-SLIDE * 2)
    assert run["b.velocity.x"][-1] == pytest.approx(decay, rel=1e-9)
    assert run["b.velocity.y"][-1] == pytest.approx(0.5 * decay, rel=1e-9)
    assert run["b.angular_velocity.z"][-1] == pytest.approx(2 * math.exp(-TURN * 2), rel=1e-9)


def test_beside_dry_friction() -> None:
    """A pin that only slides stops by mu R and c v together; it turns by neither then."""
    text = TEXT.format(
        mass=1.0,
        kind=PIN,
        laws="coulomb(0.2, radius = 0.05 m), viscous(0.7 N.s/m), viscous(0.01 N.m.s)",
        start="g.speed = 1 m/s; g.speed_angle = 0 rad/s;",
    ).replace("gravity = 0 m/s^2", "down = x")
    run = frot.compile(text).simulate()
    least = 0.2 * 9.81 / 0.7
    (stop,) = run.events
    assert stop.time == pytest.approx(math.log(1 + 1 / least) / 0.7, rel=1e-9)
    assert run["g.speed"][-1] == 0


@pytest.mark.parametrize(
    ("laws", "words"),
    [
        ("viscous(1 N.s/m), viscous(2 N.s/m)", "twice for what slides"),
        ("viscous(1 N.m.s), viscous(1 N.s/m), viscous(2 N.m.s)", "twice for what turns"),
    ],
)
def test_two_of_one_unit_are_refused(laws: str, words: str) -> None:
    with pytest.raises(frot.FrotError, match=f"(?s)^error.E0502.*{words}.*give one with the sum"):
        frot.compile(TEXT.format(mass=1.0, kind=PIN, laws=laws, start="")).report()
