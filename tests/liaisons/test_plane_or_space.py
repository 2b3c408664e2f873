"""The same mechanisms written in the plane and in space: one motion, and one reaction.

The plane's x and y are the space's x and z, so that angles count about -y. Each side is one text.
"""

from __future__ import annotations

import numpy as np
import pytest

import frot

FLAT = """
planar model Flat "Slider crank, chain, cam, wheel in a hollow, a body on a rod and a thread"
  body crank: rod(mass = 1 kg, length = 0.5 m);
  body link: rod(mass = 2 kg, length = 1.2 m);
  body block: box(mass = 1 kg, size = (0.2, 0.1) m);
  liaison A: rotoide(ground, crank.start);
  liaison B: rotoide(crank.tip, link.start);
  liaison C: rotoide(link.tip, block);
  liaison D: prismatique(ground, block);

  body l[4]: rod(mass = 1 kg, length = 0.4 m);
  liaison p0: rotoide(ground, l[1].start);
  liaison p[3]: rotoide(l[1:3].tip, l[2:4].start);

  body cam: ellipse(mass = 1 kg, a = 0.4 m, b = 0.2 m);
  body roller: disc(mass = 2 kg, radius = 0.1 m);
  frame axle on cam at (0.2, 0.05) m;
  frame guide on ground at (0.1, 0.5) m rotated(angle = 90 deg);
  liaison E: rotoide(ground, axle);
  liaison F: prismatique(guide, roller);
  liaison G: contact_ponctuel(cam.rim, roller.rim, unilateral = false);

  body wheel: disc(mass = 1 kg, radius = 0.2 m);
  curve hollow on ground: circle(radius = 1 m);
  liaison H: roulement(hollow, wheel.rim);

  body hung: box(mass = 1 kg, size = (0.3, 0.5) m);
  frame k on hung at (0.1, 0.2) m;
  frame h on hung at (-0.1, 0.2) m;
  frame g on ground at (1, 0) m;
  liaison I: tige(ground, k, length = 0.7 m);
  liaison J: fil(g, h, length = 0.9 m, unilateral = false);

  output Force d = D.force, e = p0.force, f = G.force, r = H.force, s = I.force;
initial
  A.angle = 0.9;
  A.speed = 7 rad/s;
  guess(block.position = (1.5, 0) m);
  p0.angle = 0.2;
  p[3].angle = 0.4;
  p[1].speed = 2 rad/s;
  E.angle = 0.7;
  E.speed = 6 rad/s;
  guess(roller.position = (0.1, 0.4) m);
  guess(wheel.position = (0.5, -0.6) m);
  guess(hung.position = (0.3, -0.6) m, hung.angle = 0.3, hung.angular_velocity = 1 rad/s);
  experiment(stop = 0.5 s, tolerance = 1e-12);
end Flat;
"""
SOLID = """
model Solid "The same in space"
  frame flat on ground rotated(axis = x, angle = 90 deg);
  body crank: rod(mass = 1 kg, length = 0.5 m);
  body link: rod(mass = 2 kg, length = 1.2 m);
  body block: box(mass = 1 kg, size = (0.2, 0.1, 0.1) m);
  liaison A: rotoide(ground, crank.start, axis = (0, -1, 0));
  liaison B: rotoide(crank.tip, link.start, axis = (0, -1, 0));
  liaison C: rotoide(link.tip, block, axis = (0, -1, 0));
  liaison D: prismatique(ground, block);

  body l[4]: rod(mass = 1 kg, length = 0.4 m);
  liaison p0: rotoide(ground, l[1].start, axis = (0, -1, 0));
  liaison p[3]: rotoide(l[1:3].tip, l[2:4].start, axis = (0, -1, 0));

  body cam: ellipse(mass = 1 kg, a = 0.4 m, b = 0.2 m);
  body roller: disc(mass = 2 kg, radius = 0.1 m);
  frame axle on cam at (0.2, 0.05, 0) m;
  frame guide on ground at (0.1, 0, 0.5) m rotated(axis = (0, -1, 0), angle = 90 deg);
  frame up on guide rotated(axis = x, angle = 90 deg);
  liaison E: rotoide(flat, axle);
  liaison F: prismatique(up, roller);
  liaison G: courbe_courbe(cam.rim, roller.rim);

  body wheel: cylinder(mass = 1 kg, radius = 0.2 m, length = 0.1 m);
  surface hollow on ground: cylinder(radius = 1 m, axis = y);
  liaison H: roulement(hollow, wheel.side);

  body hung: box(mass = 1 kg, size = (0.3, 0.1, 0.5) m);
  frame k on hung at (0.1, 0, 0.2) m;
  frame h on hung at (-0.1, 0, 0.2) m;
  frame g on ground at (1, 0, 0) m;
  liaison Z: appui_plan(ground, hung, normal = y);
  liaison I: tige(ground, k, length = 0.7 m);
  liaison J: fil(g, h, length = 0.9 m, unilateral = false);

  output Force d = D.force, e = p0.force, f = G.force, r = H.force, s = I.force;
initial
  A.angle = 0.9;
  A.speed = 7 rad/s;
  guess(block.position = (1.5, 0, 0) m);
  p0.angle = 0.2;
  p[3].angle = 0.4;
  p[1].speed = 2 rad/s;
  E.angle = 0.7;
  E.speed = 6 rad/s;
  guess(roller.position = (0.1, 0, 0.4) m);
  guess(wheel.position = (0.5, 0, -0.6) m, wheel.orientation = (1, 1, 0, 0));
  guess(hung.position = (0.3, 0, -0.6) m, Z.angle = -0.3);
  guess(hung.angular_velocity = (0, -1, 0) rad/s);
  experiment(stop = 0.5 s, tolerance = 1e-12);
end Solid;
"""
BODIES = ("crank", "link", "block", "l[2]", "l[4]", "cam", "roller", "wheel", "hung")


@pytest.fixture(scope="module")
def both() -> tuple[frot.Result, frot.Result]:
    return frot.compile(FLAT).simulate(), frot.compile(SOLID).simulate()


@pytest.mark.parametrize("body", BODIES)
def test_bodies_move_alike(both: tuple[frot.Result, frot.Result], body: str) -> None:
    flat, solid = both
    for one, other in (("x", "x"), ("y", "z")):
        apart = flat[f"{body}.position.{one}"] - solid[f"{body}.position.{other}"]
        assert np.abs(apart).max() < 1e-10
    assert np.abs(solid[f"{body}.position.y"]).max() < 1e-12
    moved = max(np.ptp(flat[f"{body}.position.{e}"]) for e in "xy")
    assert moved > 0.01


@pytest.mark.parametrize("force", "defrs")
def test_liaisons_push_alike(both: tuple[frot.Result, frot.Result], force: str) -> None:
    flat, solid = both
    size = np.abs(flat[f"{force}.y"]).max()
    for one, other in (("x", "x"), ("y", "z")):
        assert np.abs(flat[f"{force}.{one}"] - solid[f"{force}.{other}"]).max() < 1e-9 * size
