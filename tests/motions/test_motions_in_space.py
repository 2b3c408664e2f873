"""Lists of motions in space: departures, and the hypotheses at rest of a sphere."""

from __future__ import annotations

import math

import numpy as np
import pytest
from test_planar_motions import compiled

import frot

G = 9.81
POINT = """
model Push "A point on a rough plane"
  parameter Angle way = 0.7;
  parameter Angle slope = 0;
  parameter Real mu = 0.3;
  parameter Real mu_s = 0.3;
  parameter Force F = 4 N;
  parameter Mass m = 1 kg;
  frame incline on ground rotated(axis = x, angle = slope);
  surface plane on incline: plane(through = (0, 0, 0) m, normal = (0, 0, 1));
  world(gravity = 9.81 m/s^2*cos(slope));
  body p: particle(mass = m);
  liaison floor: contact_ponctuel(plane, p) with coulomb(mu, mu_s = mu_s);
  force f: on(p, value = F*(cos(way)*incline.ex + sin(way)*incline.ey));
initial
  p.position = (0, 0, 0) m;
  p.velocity = (0, 0, 0) m/s;
  experiment(stop = 1 s);
end Push;
"""


@pytest.mark.parametrize("m", [1.0, 1e6])
@pytest.mark.parametrize("way", [0.0, 0.7, 2.5, -1.9])
def test_a_point_departs_along_its_load(way: float, m: float) -> None:
    values = {"way": way, "m": m, "F": 4 * m}
    (motion,) = compiled(POINT).motions(parameters=values)
    (law,) = motion.laws
    assert law.direction == pytest.approx((math.cos(way), math.sin(way), 0), abs=1e-9)
    assert law.acceleration == pytest.approx(4 - 0.3 * G, rel=1e-9)
    assert law.painleve == pytest.approx(1 / m, rel=1e-9)


def test_the_static_coefficient_decides_and_that_of_motion_acts() -> None:
    (rest,) = compiled(POINT).motions(parameters={"mu_s": 0.41})
    assert rest.modes == {"floor": "stick"}
    assert all(x == 0 for x in rest.accelerations.values())
    (motion,) = compiled(POINT).motions(parameters={"mu_s": 0.40})
    assert motion.laws[0].acceleration == pytest.approx(4 - 0.3 * G, rel=1e-9)


SPHERE = """
model Sphere "The eight hypotheses at rest (Painlevé 1895, p. 108)"
  parameter Real mu = 0.3;
  parameter Length delta = 1 mm;
  parameter Length delta_p = 1 mm;
  parameter Force F = 0 N;
  parameter Torque C = 0 N.m;
  parameter Angle way = 0;
  body ball: sphere(mass = 1 kg, radius = 0.1 m);
  liaison floor: contact_ponctuel(ground.plane, ball.surface)
    with coulomb(mu), rolling_resistance(delta), pivoting_resistance(delta_p);
  force f: on(ball, value = (F*cos(way), F*sin(way), 0 N));
  force c: couple(ball, value = (0 N.m, 0 N.m, C));
initial
  ball.position = (0 m, 0 m, 0.1 m);
  ball.velocity = (0, 0, 0) m/s;
  ball.angular_velocity = (0, 0, 0) rad/s;
  experiment(stop = 1 s);
end Sphere;
"""
R, INERTIA = 0.1, 0.4 * 0.1**2


@pytest.mark.parametrize("way", [0.0, 2.1])
@pytest.mark.parametrize("pivots", [False, True])
@pytest.mark.parametrize(
    ("mu", "delta", "force", "slides", "rolls"),
    [
        (0.3, 1e-2, 0.5, False, False),
        (0.3, 1e-3, 2.0, False, True),
        (0.05, 1e-2, 2.0, True, False),
        (0.05, 1e-3, 6.0, True, True),
    ],
)
def test_a_sphere_slides_rolls_and_pivots_by_each_hypothesis(
    mu: float, delta: float, force: float, slides: bool, rolls: bool, pivots: bool, way: float
) -> None:
    """Rest holds within mu N, delta N and delta_p N; what departs moves against its bound."""
    spin = 0.02 if pivots else 0.005
    values = {"mu": mu, "delta": delta, "delta_p": 1e-3, "F": force, "C": spin, "way": way}
    (motion,) = compiled(SPHERE).motions(parameters=values)
    moving = {law.kind: law.moving for law in motion.laws}
    assert moving == {"slide": slides, "roll": rolls, "pivot": pivots}
    couple = delta * G if rolls else 0.0
    if slides:
        along = force - mu * G
        turning = (mu * G * R - couple) / INERTIA if rolls else 0.0
    elif rolls:
        along = (force - couple / R) / 1.4
        turning = along / R
    else:
        along = turning = 0.0
    a = motion["ball.acceleration.x"], motion["ball.acceleration.y"]
    w = motion["ball.angular_acceleration.x"], motion["ball.angular_acceleration.y"]
    assert a == pytest.approx((along * math.cos(way), along * math.sin(way)), abs=1e-9)
    assert w == pytest.approx((-turning * math.sin(way), turning * math.cos(way)), abs=1e-7)
    about = (spin - 1e-3 * G) / INERTIA if pivots else 0.0
    assert motion["ball.angular_acceleration.z"] == pytest.approx(about, abs=1e-8)


TABLE = """
model Table
  parameter Force F = 0 N;
  parameter Angle way = 0;
  body table: solid(mass = 3 kg, inertia = (0.2, 0.3, 0.4) kg.m^2);
{feet}
  frame hand on table at (0.05 m, 0.1 m, -0.1 m);
  force f: on(hand, value = (F*cos(way), F*sin(way), 0 N));
initial
  table.position = (0 m, 0 m, 0.2 m);
  table.orientation = (1, 0, 0, 0);
  table.velocity = (0, 0, 0) m/s;
  table.angular_velocity = (0, 0, 0) rad/s;
  experiment(stop = 0.01 s);
end Table;
"""


def table(feet: list[tuple[float, float]], mus: list[float]) -> str:
    lines = (
        f"  frame f{k} on table at ({x} m, {y} m, -0.2 m);\n"
        f"  liaison c{k}: contact_ponctuel(ground.plane, f{k}) with coulomb({mu});"
        for k, ((x, y), mu) in enumerate(zip(feet, mus, strict=True))
    )
    return TABLE.format(feet="\n".join(lines))


@pytest.mark.parametrize("way", [0.0, 1.3, -2.4])
def test_the_feet_of_a_tripod_depart_against_their_friction(way: float) -> None:
    """Newton's and Euler's laws, and friction mu N against each foot's acceleration."""
    feet, mus = [(0.3, 0.0), (-0.2, 0.25), (-0.2, -0.25)], [0.3, 0.25, 0.4]
    motions = compiled(table(feet, mus)).motions(parameters={"F": 14.0, "way": way})
    assert len(motions) == 1
    (motion,) = motions
    a = np.array([motion[f"table.acceleration.{x}"] for x in "xyz"])
    w = np.array([motion[f"table.angular_acceleration.{x}"] for x in "xyz"])
    load = 14.0 * np.array([math.cos(way), math.sin(way), 0.0])
    force = load + np.array([0, 0, -3 * G])
    couple = np.cross([0.05, 0.1, -0.1], load)
    for k, (x, y) in enumerate(feet):
        place = np.array([x, y, -0.2])
        normal = motion[f"c{k}.normal_force"]
        friction = np.array([motion[f"c{k}.tangential_force.{axis}"] for axis in "xyz"])
        slip = a + np.cross(w, place)
        assert normal > 0 and abs(slip[2]) < 1e-9
        assert np.linalg.norm(friction) == pytest.approx(mus[k] * normal, rel=1e-9)
        assert friction == pytest.approx(-mus[k] * normal * slip / np.linalg.norm(slip), abs=1e-8)
        whole = friction + np.array([0, 0, normal])
        force = force + whole
        couple = couple + np.cross(place, whole)
    assert force == pytest.approx(3 * a, abs=1e-9)
    assert couple == pytest.approx(np.array([0.2, 0.3, 0.4]) * w, abs=1e-9)


def test_a_table_on_four_legs_rests_in_one_way() -> None:
    feet = [(0.3, 0.2), (-0.3, 0.2), (-0.3, -0.2), (0.3, -0.2)]
    (rest,) = compiled(table(feet, [0.3, 0.35, 0.4, 0.45])).motions(parameters={"F": 5.0})
    assert all(mode == "stick" for mode in rest.modes.values())
    assert all(x == 0 for x in rest.accelerations.values())
    total = sum(rest[f"c{k}.normal_force"] for k in range(4))
    assert total == pytest.approx(3 * G, rel=1e-9)


def test_a_moving_slip_has_the_direction_of_its_slip() -> None:
    model = frot.load("models/sphere_on_plane.frot")
    (motion,) = model.motions()
    slip = [motion[f"support.slip.{axis}"] for axis in "xyz"]
    size = math.hypot(*slip)
    assert motion.laws[0].direction == pytest.approx([x / size for x in slip], abs=1e-12)
    # the slip of a homogeneous sphere is slowed by 7/2 mu g
    assert motion.laws[0].acceleration == pytest.approx(-3.5 * 0.3 * G, rel=1e-9)


DRAWER = """
{plane}model Drawer "A guide that is pulled off its middle"
  parameter Real mu = 0.2;
  parameter Mass m = 4 kg;
  parameter Length off = 0.15 m;
  body b: {box};
  frame handle on b at {at};
  liaison rail: prismatique(ground, b) with coulomb(mu, half_length = 0.2 m);
  force hand: on(handle, value = {pull});
  world(gravity = 0 m/s^2);
initial
  rail.displacement = 0 m;
  rail.speed = 0 m/s;
  experiment(stop = 1 s);
end Drawer;
"""
IN_PLANE = {
    "plane": "planar ",
    "box": "box(mass = m, size = (0.5, 0.4) m)",
    "at": "(0.25 m, off)",
    "pull": "(8 N, 0 N)",
}
IN_SPACE = {
    "plane": "",
    "box": "box(mass = m, size = (0.5, 0.4, 0.1) m)",
    "at": "(0.25 m, off, 0 m)",
    "pull": "(8 N, 0 N, 0 N)",
}


@pytest.mark.parametrize("where", [IN_PLANE, IN_SPACE])
@pytest.mark.parametrize("off", [0.15, -0.3])
def test_a_guide_is_bounded_by_the_sum_of_the_reactions_at_its_ends(
    where: dict[str, str], off: float
) -> None:
    """Each end bears F off/(2 half_length): it locks itself from mu = half_length/off on."""
    text, locks = DRAWER.format(**where), 0.2 / abs(off)
    (moves,) = compiled(text).motions(parameters={"mu": 0.99 * locks, "off": off})
    assert moves.accelerations["b.acceleration.x"] == pytest.approx(0.01 * 8 / 4, rel=1e-8)
    (rests,) = compiled(text).motions(parameters={"mu": 1.01 * locks, "off": off})
    assert rests.modes == {"rail": "stick"}
