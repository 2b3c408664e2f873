"""First integrals that mechanics knows are found, no others are, and runs keep them."""

import numpy as np
import pytest

import frot

BALL = """
model Ball "Kravtchenko 1946, sect. 19: a homogeneous sphere rolls on a horizontal plane"
  parameter Mass m = 1 kg;
  body ball: sphere(mass = m, radius = 0.5 m);
  liaison floor: roulement(ground.plane, ball.surface);
initial
  ball.position = (0, 0, 0.5) m;
  ball.orientation = (cos(0.3), sin(0.3), 0, 0);
  ball.angular_velocity = (1, 2, 3) rad/s;
  experiment(stop = 100 s, tolerance = 1e-12);
end Ball;
"""
HOOP = """
model Hoop "Kravtchenko 1946, sect. 18: a hoop rolls on a horizontal plane"
  body hoop: ring(mass = 1 kg, radius = 1 m);
  liaison floor: roulement(ground.plane, hoop.rim);
initial
  hoop.position = (0, 0, sin(1.2)) m;
  hoop.orientation = (cos(0.6), sin(0.6), 0, 0);
  hoop.angular_velocity = (0.1, -6*sin(1.2), 0.5 + 6*cos(1.2)) rad/s;
  experiment(stop = 100 s, tolerance = 1e-12);
end Hoop;
"""


def test_what_a_rolling_sphere_keeps_is_found_and_kept() -> None:
    """(28): about the vertical through G; (29): about its own axis; with them both speeds of G."""
    model = frot.compile(BALL)
    found = [x.text for x in model.report().analysis.integrals]
    vertical, own = (f"angular momentum about {e} through ball.G" for e in ("z", "ball.ez"))
    assert {"energy", "momentum along x", "momentum along y", vertical, own} < set(found)
    result = model.simulate(parameters={"m": 2.0})
    kept = result.first_integrals
    assert list(kept) == found
    for name in ("energy", "momentum along x", "momentum along y", vertical, own):
        assert kept[name].drift < 1e-11 * kept[name].largest
    inertia = 0.4 * 2 * 0.25
    assert kept[vertical].value == pytest.approx(3 * inertia, rel=1e-14)
    axis = np.array([0, -np.sin(0.6), np.cos(0.6)])
    assert kept[own].value == pytest.approx(inertia * axis @ [1, 2, 3], rel=1e-13)
    assert kept["momentum along x"].value == pytest.approx(2 * 0.5 * 2, rel=1e-14)
    assert f"{kept[own].unit}: {own}" in result.summary()


def test_a_rolling_hoop_keeps_its_energy_alone() -> None:
    """(25); its other two integrals are no polynomials of momenta."""
    model = frot.compile(HOOP)
    assert [x.text for x in model.report().analysis.integrals] == ["energy"]
    drift = model.simulate().first_integrals["energy"]
    assert drift.drift < 1e-11 * drift.largest


def integrals(text: str) -> list[tuple[str, bool]]:
    return [(x.text, x.always) for x in frot.compile(text).report().analysis.integrals]


ABOUT_G = [f"angular momentum about {e} through b.G" for e in "xyz"]
FOUND = {
    "a heavy top: energy, vertical and own axis": (
        """model M body b: cylinder(mass = 1 kg, radius = 0.2 m, length = 0.1 m);
        frame tip on b at (0, 0, -0.4) m; liaison r: spherique(ground, tip); end M;""",
        ["energy", "angular momentum about z through the origin",
         "angular momentum about b.ez through b.G"],
    ),
    "a heavy body without symmetry about a point": (
        """model M body b: box(mass = 1 kg, size = (1, 2, 3) m);
        frame tip on b at (0, 0, -0.4) m; liaison r: spherique(ground, tip); end M;""",
        ["energy", "angular momentum about z through the origin"],
    ),
    "a thrown body turns about G as if it did not fall": (
        "model M body b: box(mass = 1 kg, size = (1, 2, 3) m); end M;",
        ["energy", "momentum along x", "momentum along y",
         "angular momentum about z through the origin", *ABOUT_G],
    ),
    "a spring between two bodies on a line: their momentum": (
        """planar model M world(gravity = 0 m/s^2);
        body a: particle(mass = 1 kg); body b: particle(mass = 2 kg);
        force f: spring(a, b, 3 N/m, length = 0.5 m);
        liaison x: point_courbe(a, ground.line); liaison y: point_courbe(b, ground.line);
        initial a.position.x = 0 m; b.position.x = 1 m; end M;""",
        ["energy", "momentum along x"],
    ),
    "a hoop that slips": (
        """planar model M body h: ring(mass = 1 kg, radius = 0.5 m);
        liaison f: contact_ponctuel(ground.line, h.rim) with coulomb(0.3);
        initial h.position = (0, 0.5) m; end M;""",
        [],
    ),
    "two bodies with a dry pin between them: what is inside does not count": (
        """planar model M world(gravity = 0 m/s^2);
        body a: rod(mass = 1 kg, length = 1 m); body b: rod(mass = 2 kg, length = 1 m);
        liaison p: rotoide(a.tip, b.start) with coulomb(0.3, radius = 1 cm); end M;""",
        ["momentum along x", "momentum along y", "angular momentum about z through the origin",
         "angular momentum about z through the centre of mass"],
    ),
    "a pendulum with a damper": (
        """planar model M body b: rod(mass = 1 kg, length = 1 m); frame o on ground at (1, 1) m;
        liaison p: rotoide(ground, b.start); force d: damper(o, b.tip, 1 N.s/m); end M;""",
        [],
    ),
    "a pendulum that an input pushes": (
        """planar model M input Force F(start = 0 N); body b: rod(mass = 1 kg, length = 1 m);
        liaison p: rotoide(ground, b.start); force f: on(b.tip, value = (F, 0 N)); end M;""",
        [],
    ),
}  # fmt: skip


@pytest.mark.parametrize("scene", FOUND)
def test_what_mechanics_knows_is_found_and_nothing_else(scene: str) -> None:
    text, expected = FOUND[scene]
    assert integrals(text) == [(one, True) for one in expected]


def test_axes_that_are_not_those_of_the_ground() -> None:
    """On a slope the momentum along its horizontals; round a fixed axis somewhere that about it."""
    slope = """
model Slope "A point on a plane that is turned about the diagonal of x and y"
  frame f on ground rotated(axis = (1, 1, 0), angle = 0.3 rad);
  surface s on f: plane(through = (0, 0, 0) m, normal = (0, 0, 1));
  body b: particle(mass = 1 kg);
  liaison c: contact_ponctuel(s, b, unilateral = false);
end Slope;
"""
    diagonal = "momentum along (0.707107, 0.707107, 0)"
    assert integrals(slope) == [("energy", True), (diagonal, True)]


def test_the_energy_in_a_frame_that_turns_steadily() -> None:
    """A ball on a circle that is turned with w about the vertical keeps E - w L."""
    text = """
model Channel "A ball in a turning circle"
  parameter AngularVelocity w = 2 rad/s;
  body ball: particle(mass = 1 kg);
  frame turning on ground rotated(axis = z, angle = w*time);
  frame wheel on turning rotated(axis = x, angle = 1 rad);
  curve rim on wheel: circle(radius = 1 m);
  liaison channel: point_courbe(ball, rim);
initial
  channel.u = 0.3 rad;
  experiment(stop = 5 s, tolerance = 1e-11);
end Channel;
"""
    model = frot.compile(text)
    name = "energy in a frame that moves: energy - 2 rad/s * angular momentum about z"
    assert integrals(text) == [(name, False)]
    drift = model.simulate().first_integrals[name]
    assert drift.relative < 1e-10
    assert model.simulate(parameters={"w": 3}).first_integrals == {}


def test_where_figures_touch_without_a_closed_form() -> None:
    """Two smooth eggs that cannot part push each other: nothing acts from outside."""
    model = frot.compile("""
planar model Eggs
  world(gravity = 0 m/s^2);
  body a: ellipse(mass = 1 kg, a = 30 cm, b = 20 cm);
  body b: ellipse(mass = 2 kg, a = 40 cm, b = 20 cm);
  liaison C: contact_ponctuel(a.rim, b.rim, unilateral = false);
initial
  a.position = (0, 0) m;
  b.position.x = 0 m;
  guess(b.position.y = 0.4 m);
  a.angle = 0.3;
  a.angular_velocity = 1 rad/s;
  b.velocity.x = 1 m/s;
  experiment(stop = 1 s, tolerance = 1e-10);
end Eggs;""")
    told = [x.text for x in model.report().analysis.integrals]
    assert told[:3] == ["energy", "momentum along x", "momentum along y"]
    kept = model.simulate().first_integrals
    assert list(kept) == told
    assert all(x.drift < 1e-9 for x in kept.values())


def test_a_summary_tells_the_first_of_many() -> None:
    """Each particle keeps three momenta of its own."""
    bodies = "".join(f"  body b{i}: particle(mass = 1 kg);\n" for i in range(6))
    text = f"planar model Many\n  world(gravity = 0 m/s^2);\n{bodies}end Many;\n"
    result = frot.compile(text).simulate(stop=1.0)
    kept = [line for line in result.summary().splitlines() if "kept to" in line]
    assert len(result.first_integrals) > 12 > len(kept) > 3
    assert f"{len(result.first_integrals) - 1 - len(kept)} more first integrals" in result.summary()
