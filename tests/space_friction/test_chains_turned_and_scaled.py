"""Three rough points in a chain: tilted, turned and with other masses they do the same."""

from __future__ import annotations

import random
from functools import cache

import pytest

import frot

CHAIN = """
model Chain
  parameter Angle turn = 0 deg "of the scene about the normal of the floor";
  parameter Angle tilt = 0 deg "of the scene and of gravity";
  parameter Mass m = 1 kg;
  parameter Acceleration px = 0 m/s^2; parameter Acceleration py = 0 m/s^2;
  parameter Acceleration rx = 0 m/s^2;
  parameter Velocity vp = 0 m/s; parameter Velocity vq = 0 m/s; parameter Velocity vr = 0 m/s;
  world(down = (-sin(tilt), 0, -cos(tilt)));
  frame floor on ground rotated(axis = y, angle = tilt);
  frame axes on floor rotated(axis = z, angle = turn);
  surface s on floor: plane(through = (0, 0, 0) m, normal = (0, 0, 1));
  body p: particle(mass = m);
  body q: particle(mass = 2*m);
  body r: particle(mass = 3*m);
  liaison cp: contact_ponctuel(p.G, s) with coulomb(0.2, 0.25);
  liaison cq: contact_ponctuel(q.G, s) with coulomb(0.4);
  liaison cr: contact_ponctuel(r.G, s) with coulomb(0.1, 0.3);
  liaison one: tige(p, q, length = 1 m);
  liaison two: tige(q, r, length = 1 m);
  force f: on(p, value = m*(px*axes.ex + py*sin(2 1/s*time)*axes.ey));
  force g: on(r, value = m*rx*sin(3 1/s*time)*axes.ex);
  output Length x = dot(p.position, axes.ex);
  output Length y = dot(r.position, axes.ey);
initial
  p.position = (0, 0, 0) m;
  q.position = 1 m*axes.ex;
  r.position = 1 m*axes.ex + 1 m*axes.ey;
  p.velocity = vp*axes.ey;
  q.velocity = vq*axes.ey;
  r.velocity = vq*axes.ey + vr*axes.ex;
  experiment(stop = 1.5 s, tolerance = 1e-10);
end Chain;
"""
VARIANTS = (
    {"turn": "77 deg"},
    {"tilt": "50 deg", "turn": "-20 deg"},
    {"m": "1e5 kg"},
    {"m": "1e-5 kg", "turn": "77 deg"},
)


@cache
def chain() -> frot.Model:
    return frot.compile(CHAIN)


def run(parameters: dict[str, object]) -> tuple[list[tuple[str, str]], list[float], list[float]]:
    """The events, their times, and where p and r end."""
    result = chain().simulate(parameters=parameters)
    kinds = [(e.liaison, e.after) for e in result.events]
    return kinds, [e.time for e in result.events], [float(result[n][-1]) for n in "xy"]


@pytest.mark.parametrize("seed", range(12))
def test_a_chain_does_the_same_turned_tilted_and_scaled(seed: int) -> None:
    draw = random.Random(seed)
    loads = {"px": 4.0, "py": 6.0, "rx": 8.0}
    scene: dict[str, object] = {
        name: f"{draw.uniform(-most, most):.3f} m/s^2" for name, most in loads.items()
    }
    for name in ("vp", "vq", "vr"):
        scene[name] = f"{draw.choice([0, draw.uniform(-1, 1)]):.3f} m/s"
    kinds, times, places = run(scene)
    for variant in VARIANTS:
        other_kinds, other_times, other_places = run(scene | variant)
        assert other_kinds == kinds
        assert other_times == pytest.approx(times, abs=1e-8)
        assert other_places == pytest.approx(places, abs=1e-8)
