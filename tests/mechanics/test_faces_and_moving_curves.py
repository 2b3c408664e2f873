"""Faces on lines, shapes of one's own, curves that close loops, grow, turn, in the plane."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import frot

TEXT = """
shape Brick(Length w, Length h, Real density = 1000)
  mass = density*w*h*(1 kg/m^2);
  inertia = density*w*h*(w^2 + h^2)/12*(1 kg/m^2);
end Brick;

planar model Scene "Things beside each other"
  parameter Length w = 0.4 m;
  parameter AngularVelocity turning = 2 rad/s;

  body brick: Brick(w, 0.2 m, density = 25);
  body stone: box(mass = 2 kg, size = (0.4, 0.2) m);
  liaison feet: appui_faces(stone.bottom, ground.line) with coulomb(0.3);
  force push: on(stone, value = (if time < 0.5 s then 10 N else 0 N, 0 N));

  body plate: polygon(mass = 1 kg, vertices = ((0, 0), (1, 0), (0, 1)) m);
  curve far on ground: line(through = (0, -3) m, direction = (1, 0.1));
  liaison rests: appui_faces(far, plate.sides[1]) with coulomb(0.5);

  body crank: rod(mass = 1 kg, length = 1 m);
  curve trough on ground: parametric((5 m + 1 m*u, 0.3 m*u^2), u = (-4, 4));
  liaison A: point_courbe(crank.start, trough);
  liaison B: point_courbe(crank.tip, trough);

  body bead: particle(mass = 1 kg);
  curve needle on ground: line(
    through = (0, 0) m, direction = (cos(turning*time), sin(turning*time)));
  liaison D: point_courbe(bead, needle);

  body big: disc(mass = 1 kg, radius = 0.1 m);
  body mote: particle(mass = 1 kg);
  curve grow on big: circle(radius = 0.5 m + 0.1 m/s*time);
  liaison E: point_courbe(mote, grow);

  output Force load = feet.normal_force + rests.normal_force;
  output Length gap = feet.gap;
  output Energy spin = brick.kinetic_energy;
initial
  stone.position = (0, 0.1) m;
  brick.angular_velocity = 3 rad/s;
  guess(plate.position = (0.3, -2.5) m);
  plate.angle = atan(0.1);
  rests.gap = 0 m;
  plate.velocity = (0, 0) m/s;
  plate.angular_velocity = 0 rad/s;
  guess(B.u = 0.5);
  A.u = -0.6;
  D.abscissa = 1 m;
  guess(mote.position = (0.5, 0) m, mote.velocity = (0, 1) m/s);
  experiment(stop = 0.7 s, tolerance = 1e-10);
end Scene;
"""


def test_faces_shapes_and_curves_that_move() -> None:
    result = frot.compile(TEXT).simulate()
    early, late = result.at(0.2), result.at(0.7)
    # two corners carry the weight, and slide: a = F/m - mu g
    assert early["feet.normal_force"] == pytest.approx(2 * 9.81, rel=1e-12)
    assert early["stone.acceleration.x"] == pytest.approx(5 - 0.3 * 9.81, rel=1e-12)
    assert np.abs(result["feet.gap"]).max() < 1e-12
    # 0.1 < mu: the triangle stays where it is, on its first side
    assert late["plate.angle"] == pytest.approx(np.arctan(0.1), abs=1e-14)
    assert late["rests.normal_force"] == pytest.approx(9.81 * np.cos(np.arctan(0.1)), rel=1e-10)
    # m = density w h and I = m (w^2 + h^2)/12
    inertia = 2 * (0.4**2 + 0.2**2) / 12
    moving = 2 * result.at(0)["brick.velocity.y"] ** 2 / 2
    assert result.at(0)["spin"] == pytest.approx(inertia * 9 / 2 + moving, rel=1e-12)
    # a rod with both ends on a parabola keeps its energy and its length
    assert np.abs(result["B.gap"]).max() < 1e-12
    height = result["crank.kinetic_energy"] + 9.81 * result["crank.position.y"]
    assert np.ptp(height) < 1e-9
    ends = [np.array([5 + u, 0.3 * u**2]) for u in (late["A.u"], late["B.u"])]
    assert np.linalg.norm(ends[1] - ends[0]) == pytest.approx(1, abs=1e-12)
    # s'' = w^2 s - g sin(w t) on a line that turns (P. Painlevé 1895, p. 65)
    speed = result["bead.velocity.x"][0]
    way = solve_ivp(
        lambda t, y: [y[1], 4 * y[0] - 9.81 * np.sin(2 * t)],
        (0, 0.7),
        [1, speed],
        rtol=1e-12,
        atol=1e-13,
    )
    assert late["D.u"] == pytest.approx(way.y[0, -1], abs=1e-9)
    # a circle that grows on a moving body
    across = [result[f"mote.position.{x}"] - result[f"big.position.{x}"] for x in "xy"]
    assert np.abs(np.hypot(*across) - 0.5 - 0.1 * result.time).max() < 1e-12


def test_a_face_follows_a_variable_by_the_corners_that_tell_where_it_is() -> None:
    """A box on a plane that is lifted as x tells; all of its weight, and m x'', is on the plane."""
    result = frot.compile("""
model Lifted "A box held over a plane"
  body s: box(mass = 1 kg, size = (0.1, 0.2, 0.3) m);
  Length x;
  liaison j: appui_faces(ground.plane, s.bottom, unilateral = false) driven(gap = x);
  output Force f = j.force;
initial
  guess(s.velocity = (0.3, 0.1, 0) m/s);
equation
  x = 0.1 m*sin(time/(1 s));
  experiment(stop = 1 s, tolerance = 1e-10);
end Lifted;
""").simulate()
    wave = 0.1 * np.sin(result.time)
    assert np.abs(result["s.position.z"] - 0.15 - wave).max() < 1e-10
    assert np.abs(result["f.z"] - 9.81 + wave).max() < 1e-8
