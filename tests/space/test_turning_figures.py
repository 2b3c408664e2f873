"""Figures whose normal time turns: what follows them never jumps, wherever the normal points."""

import numpy as np
import pytest

import frot

TURNING = """
model Turning "A bead on a circle, a point on a plane; the normals of both turn"
  parameter AngularVelocity w = 3 rad/s;
  parameter Angle tilt = 0.3 rad "of the axis, about y";
  parameter Angle cone = 1 rad "of the normal to the axis";
  parameter Real c = cos(tilt);
  parameter Real s = sin(tilt);
  body bead: particle(mass = 1 kg);
  body slider: particle(mass = 2 kg);
  curve hoop on ground: circle(radius = 1 m, centre = (0, 0, 0) m, normal = (
    c*sin(cone)*cos(w*time) + s*cos(cone), sin(cone)*sin(w*time),
    c*cos(cone) - s*sin(cone)*cos(w*time)));
  surface wall on ground: plane(through = (0, 0, 0) m, normal = (-sin(w*time), cos(w*time), 0));
  liaison on: point_courbe(bead, hoop);
  liaison along: point_surface(slider, wall);
  world(gravity = 0 m/s^2);
initial
  guess(bead.position = (0, -0.6, 0.8) m);
  slider.position = (0.2, 0, 0) m;
  slider.velocity = (0 m/s, 0.2 m*w, 1 m/s);
  experiment(stop = 3 s, tolerance = 1e-11);
end Turning;
"""


@pytest.fixture(scope="module")
def turning() -> frot.Model:
    return frot.compile(TURNING)


def vectors(result: frot.Result, body: str, of: str) -> np.ndarray:
    return np.array([result[f"{body}.{of}.{axis}"] for axis in "xyz"]).T


@pytest.mark.parametrize("tilt", [0.0, 0.3, -2.0])
@pytest.mark.parametrize("cone", [np.pi / 2, np.pi / 4, 0.3, 0.0])
def test_a_bead_on_a_turning_circle_keeps_its_integral(
    turning: frot.Model, tilt: float, cone: float
) -> None:
    """Without weight E - w.L lasts (Painlevé and Jacobi), and the circle pushes across alone."""
    result = turning.simulate(parameters={"tilt": tilt, "cone": cone})
    p, v, a = (vectors(result, "bead", x) for x in ("position", "velocity", "acceleration"))
    axis, beside = (np.sin(tilt), 0, np.cos(tilt)), (np.cos(tilt), 0, -np.sin(tilt))
    turned = np.outer(np.cos(3 * result.time), beside)
    turned += np.outer(np.sin(3 * result.time), (0, 1, 0))
    n = np.cos(cone) * np.array(axis) + np.sin(cone) * turned
    assert np.abs(np.sum(p * n, 1)).max() < 1e-13
    assert np.abs(np.sum(p * p, 1) - 1).max() < 1e-13
    integral = np.sum(v * v, 1) / 2 - 3 * np.cross(p, v) @ axis
    assert np.ptp(integral) < 1e-9
    assert np.abs(np.sum(a * np.cross(n, p), 1)).max() < 1e-10


def test_a_point_on_a_turning_plane_moves_off_the_axis(turning: frot.Model) -> None:
    """x'' = w^2 x along the plane, from rest there, and nothing along the axis."""
    result = turning.simulate(stop=2)
    t, p = result.time, vectors(result, "slider", "position")
    out = 0.2 * np.cosh(3 * t)
    expected = np.array([out * np.cos(3 * t), out * np.sin(3 * t), t]).T
    assert np.abs(p - expected).max() < 1e-9 * out[-1]


def test_a_component_that_is_rounding_of_the_others_states_nothing() -> None:
    """cos(pi/2) is 6e-17: the first component of the bead's place says nothing of where it is."""
    text = TURNING.replace("guess(bead.position = (0, -0.6, 0.8) m)", "bead.position = (0 m, y, z)")
    text = text.replace(
        "  body bead", "  parameter Length y = 1 m;\n  parameter Length z = 0 m;\n  body bead"
    )
    model = frot.compile(text)
    for turn in np.arange(8) * np.pi / 4:
        place = {"y": np.cos(turn), "z": np.sin(turn)}
        result = model.simulate(stop=0.1, parameters={"tilt": 0.0, "cone": np.pi / 2, **place})
        start = vectors(result, "bead", "position")[0]
        assert start == pytest.approx([0.0, *place.values()], abs=1e-15)


FOLLOWED = """
model Followed "Each of these follows a figure that time turns"
  parameter AngularVelocity w = 1.3 rad/s;
  parameter Real moved = 1 "0: what has its place by rows begins at rest";
{places}
  body o: particle(mass = 2 kg);
  body p: particle(mass = 2 kg);
  body q: particle(mass = 2 kg);
  body b: box(mass = 2 kg, size = (0.3, 0.2, 0.5) m);
  body c: box(mass = 2 kg, size = (0.3, 0.2, 0.5) m);
  body d: box(mass = 2 kg, size = (0.3, 0.2, 0.5) m);
  body e: sphere(mass = 2 kg, radius = 0.2 m);
  body f: sphere(mass = 2 kg, radius = 0.2 m);
  curve own on c: line(through = (0, 0, 0.1) m, direction = (1, 0, 0));
  liaison O: point_surface(o, wall);
  liaison P: point_courbe(p, way);
  liaison Q: point_surface(q, tube);
  liaison B: lineaire_annulaire(b, way);
  liaison C: lineaire_rectiligne(own, wall);
  liaison D: appui_faces(d.bottom, wall, unilateral = false);
  liaison E: contact_ponctuel(e.surface, wall, unilateral = false);
  liaison F: roulement(wall, f.surface);
initial
  guess(o.position = (0.7, 0.25, 0.6) m, o.velocity = (0.1, 0.2, 0.3) m/s);
  guess(p.position = (0.7, 0.25, 0.6) m, p.velocity = (0.1, 0.2, 0.3) m/s);
  guess(b.position = (0.7, 0.25, 0.6) m, b.angular_velocity = (1, 0.2, 0.3) rad/s);
  guess(c.position = (0.7, 0.25, 0.6) m, c.angular_velocity = moved*(1, 0.2, 0.3) rad/s);
  guess(d.position = (0.7, 0.25, 0.6) m, d.velocity = moved*(0.1, 0.2, 0.3) m/s);
  guess(e.position = (0.7, 0.25, 0.6) m, e.angular_velocity = moved*(1, 0.2, 0.3) rad/s);
  guess(f.position = (0.7, 0.25, 0.6) m, f.angular_velocity = moved*(1, 0.2, 0.3) rad/s);
  q.position = (0.5, 0.2, 0.3) m;
  experiment(stop = 3 s, tolerance = 1e-10);
end Followed;
"""
# A normal that passes directions beside which others are counted, and a frame that turns alike.
BY_FRAME = """
  frame there on ground at (0.1, 0.2, 0.3) m;
  frame turning on there rotated(axis = (sqrt(0.91), 0, -0.3), angle = w*time);
  surface wall on turning: plane(through = (0, 0, 0) m, normal = (0, 1, 0));
  curve way on turning: line(through = (0, 0, 0) m, direction = (0, 1, 0));
  surface tube on turning: cylinder(radius = 0.4 m, axis = (0, 1, 0));
"""
TURNS = "(0.3*sin(w*time), cos(w*time), sqrt(0.91)*sin(w*time))"
BY_NORMAL = f"""
  frame there on ground at (0.1, 0.2, 0.3) m;
  surface wall on there: plane(through = (0, 0, 0) m, normal = {TURNS});
  curve way on there: line(through = (0, 0, 0) m, direction = {TURNS});
  surface tube on there: cylinder(radius = 0.4 m, axis = {TURNS});
"""


@pytest.fixture(scope="module")
def followed() -> tuple[frot.Model, ...]:
    return tuple(frot.compile(FOLLOWED.format(places=x)) for x in (BY_FRAME, BY_NORMAL))


@pytest.mark.parametrize("moved", [1, 0])
def test_a_normal_that_turns_moves_what_a_turning_frame_moves(
    followed: tuple[frot.Model, ...], moved: int
) -> None:
    """From rest too: what grows from zero is rounding of its terms first, no reason to crawl."""
    by_frame, by_normal = (x.simulate(parameters={"moved": moved}) for x in followed)
    for body in "opqbcdef":
        expected, found = (vectors(x, body, "position") for x in (by_frame, by_normal))
        far = np.abs(expected).max()
        assert np.abs(found - expected).max() < 1e-8 * far, body
    assert max(x.figures.steps for x in (by_frame, by_normal)) < 700
