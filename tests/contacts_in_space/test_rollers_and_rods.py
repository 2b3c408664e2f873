"""Rims, cylinders, ellipsoids and rods on planes, faces and edges, and their models."""

from __future__ import annotations

import math
import textwrap
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

import frot

G = 9.81
MODELS = Path(__file__).parents[2] / "models"


def run(text: str, **values: object) -> frot.Result:
    return frot.compile(textwrap.dedent(text).format(**values)).simulate()


def rolls_round(k: float, radius: float, first: float, speed: float, mu: float) -> float:
    """The time that what rolls round an edge takes until it slips.

    At the angle a to the vertical, from `first` on, k = 1 + I/(m r^2): v^2 = v0^2 + 2/k g r (cos a0
    - cos a), T = (k - 1)/k m g sin a, N = m (g cos a - v^2/r).
    """

    def square(a: float) -> float:
        return speed**2 + 2 / k * G * radius * (math.cos(first) - math.cos(a))

    def missing(a: float) -> float:
        return (k - 1) / k * G * math.sin(a) - mu * (G * math.cos(a) - square(a) / radius)

    angle = brentq(missing, first, 1.2, xtol=1e-15)
    way, _ = quad(lambda a: radius / math.sqrt(square(a)), first, angle, epsabs=1e-14, epsrel=1e-13)
    return way


@pytest.mark.parametrize(
    ("name", "given", "k"),
    [
        ("ball_over_an_edge", {}, 7 / 5),
        ("ball_over_an_edge", {"mu": 0.2, "r": "0.05 m", "v": "0.2 m/s", "d": "0.1 m"}, 7 / 5),
        ("coin_over_an_edge", {}, 3 / 2),
        ("coin_over_an_edge", {"mu": 0.9, "r": "20 mm", "v": "0.3 m/s"}, 3 / 2),
    ],
)
def test_what_rolls_over_an_edge_slips_at_its_angle(
    name: str, given: dict[str, object], k: float
) -> None:
    result = frot.load(MODELS / f"{name}.frot").simulate(parameters=given)
    values = {"ball": (0.5, 0.1, 0.3, 0.2), "coin": (0.4, 0.012, 0.25, 0.06)}[name[:4]]
    mu, radius, speed, way = values
    mu = float(str(given.get("mu", mu)))
    if "r" in given:
        size, unit = str(given["r"]).split()
        radius = float(size) * (1e-3 if unit == "mm" else 1)
    speed = float(str(given.get("v", speed)).split()[0])
    way = float(str(given.get("d", way)).split()[0])
    slips = next(e for e in result.events if (e.before, e.after) == ("stick", "slip"))
    expected = way / speed + rolls_round(k, radius, 0, speed, mu)
    assert slips.time == pytest.approx(expected, abs=1e-9)
    assert result.events[-1].after == "open"


@pytest.mark.parametrize(("mu", "d", "slope"), [(0.5, 0.01, 20), (0.8, 0.02, 5)])
def test_a_cylinder_rolls_down_a_ramp_and_round_its_edge(mu: float, d: float, slope: float) -> None:
    given = {"mu": mu, "d": f"{d} m", "slope": f"{slope} deg"}
    result = frot.load(MODELS / "roller_off_a_ramp.frot").simulate(parameters=given)
    first = math.radians(slope)
    pace = 2 / 3 * G * math.sin(first)
    edge = math.sqrt(2 * d / pace)
    assert result.events[0].time == pytest.approx(edge, abs=1e-9)
    slips = next(e for e in result.events if (e.before, e.after) == ("stick", "slip"))
    expected = edge + rolls_round(1.5, 0.1, first, pace * edge, mu)
    assert slips.time == pytest.approx(expected, abs=1e-8)
    assert np.abs(result["roller.position.y"]).max() < 1e-9


def test_a_box_slides_off_a_table_and_falls() -> None:
    """Energy is lost to friction alone; at the end it falls freely."""
    result = frot.load(MODELS / "box_off_a_table.frot").simulate()
    assert result.events[-1].after == "open"
    assert result.at(0.59)["load.acceleration.z"] == pytest.approx(-G, abs=1e-9)
    smooth = frot.load(MODELS / "box_off_a_table.frot").simulate(parameters={"mu": 0})
    energy = smooth["load.kinetic_energy"] + 2 * G * smooth["load.position.z"]
    assert np.ptp(energy) < 1e-8


@pytest.mark.parametrize(("mass", "turn", "speed"), [(2, 0.0, 1.0), (1e5, 1.1, -0.7)])
def test_a_cylinder_slides_on_its_side_until_it_rolls(
    mass: float, turn: float, speed: float
) -> None:
    """It touches by its rims; from v0 it rolls at v0/(3 mu g), with 2/3 of its speed."""
    result = run(
        """
        model Roller
          body c: cylinder(mass = {mass} kg, radius = 0.1 m, length = 0.5 m);
          frame f on ground at (0, 0, 0) m rotated(axis = z, angle = {turn});
          frame g on f at (0, 0, 0.1) m rotated(axis = x, angle = 90 deg);
          liaison on: contact_ponctuel(c.side, ground.plane) with coulomb(0.4);
        initial
          c.position = g.position;
          c.orientation = g.orientation;
          c.velocity = {speed} m/s*f.ex;
          experiment(stop = 0.2 s, tolerance = 1e-11);
        end Roller;
        """,
        mass=mass,
        turn=turn,
        speed=speed,
    )
    assert {e.time for e in result.events} == {result.events[0].time}
    assert result.events[0].time == pytest.approx(abs(speed) / (3 * 0.4 * G), abs=1e-10)
    assert result["c.velocity.x"][-1] == pytest.approx(2 / 3 * speed * math.cos(turn), abs=1e-9)
    assert result["on.normal_force"][-1] == pytest.approx(mass * G, rel=1e-9)


EGG = """
    {model} Egg
      body t: box(mass = 1 kg, size = {size});
      body e: {shape}, inertia = {inertia});
      liaison w: encastrement(ground, t);
      liaison on: contact_ponctuel(e.{part}, t.top);
    initial
      guess(t.position = {zero});
      e.position = {place};
      e.velocity = {speed};
      experiment(stop = 1.1 s, tolerance = 1e-11);
    end Egg;
    """


@pytest.mark.parametrize(("speed", "half"), [(0.6, 0.15), (-0.3, 0.3)])
def test_an_ellipsoid_slides_over_an_edge_as_its_planar_twin(speed: float, half: float) -> None:
    at = 0.8 * math.copysign(1, speed)
    plane = run(
        EGG, model="planar model", size="(2, 0.2) m", zero="(0, 0) m", part="rim",
        shape=f"ellipse(mass = 2 kg, a = 0.2 m, b = {half} m", inertia="0.02 kg.m^2",
        place=f"({at}, {0.1 + half}) m", speed=f"({speed}, 0) m/s",
    )  # fmt: skip
    space = run(
        EGG, model="model", size="(2, 2, 0.2) m", zero="(0, 0, 0) m", part="surface",
        shape=f"ellipsoid(mass = 2 kg, semi_axes = (0.2, 0.1, {half}) m",
        inertia="(0.03, 0.02, 0.04) kg.m^2", place=f"({at}, 0, {0.1 + half}) m",
        speed=f"({speed}, 0, 0) m/s",
    )  # fmt: skip
    assert space.events[-1].after == plane.events[-1].after == "open"
    assert space.events[-1].time == pytest.approx(plane.events[-1].time, abs=1e-9)
    for one, other in (("x", "x"), ("y", "z")):
        assert np.abs(plane[f"e.position.{one}"][-1] - space[f"e.position.{other}"][-1]) < 1e-8
    assert plane["e.angle"][-1] == pytest.approx(
        -2 * math.atan2(space["e.orientation[3]"][-1], space["e.orientation[1]"][-1]), abs=1e-8
    )


def test_a_rod_slides_over_an_edge_as_its_planar_twin() -> None:
    """Its ends rest on the face; then it crosses the edge."""
    plane = run("""
        planar model Rod
          body t: box(mass = 1 kg, size = (2, 0.2) m);
          body r: rod(mass = 1 kg, length = 0.8 m);
          liaison w: encastrement(ground, t);
          liaison a: contact_ponctuel(r.start, t.top) with coulomb(0.1);
          liaison b: contact_ponctuel(r.tip, t.top) with coulomb(0.1);
          liaison c: contact_ponctuel(t.corners[3], r.axis) with coulomb(0.1);
        initial
          guess(t.position = (0, 0) m);
          r.position = (0.4, 0.1) m;
          r.velocity = (2, 0) m/s;
          experiment(stop = 0.7 s, tolerance = 1e-10);
        end Rod;
        """)
    space = run("""
        model Rod
          body t: box(mass = 1 kg, size = (2, 2, 0.2) m);
          body r: rod(mass = 1 kg, length = 0.8 m);
          liaison w: encastrement(ground, t);
          liaison on: contact_ponctuel(r.axis, t.top) with coulomb(0.1);
        initial
          guess(t.position = (0, 0, 0) m);
          r.start.position = (0, 0.3, 0.1) m;
          r.tip.position = (0.8, 0.3, 0.1) m;
          r.velocity = (2, 0, 0) m/s;
          experiment(stop = 0.7 s, tolerance = 1e-10);
        end Rod;
        """)
    ends = [sorted({round(e.time, 8) for e in x.events}) for x in (plane, space)]
    assert ends[1] == pytest.approx(ends[0], abs=2e-8)
    for one, other in (("x", "x"), ("y", "z")):
        for end in ("start", "tip"):
            own = space[f"r.{end}.position.{other}"][-1]
            assert own == pytest.approx(plane[f"r.{end}.position.{one}"][-1], abs=1e-8)


@pytest.mark.parametrize("turn", [0.0, 0.4])
def test_a_rod_slides_along_two_that_it_crosses(turn: float) -> None:
    """As over two points: it leaves one, tips about the other and leaves that."""
    plane = run("""
        planar model Rods
          body r: rod(mass = 1 kg, length = 2 m);
          frame a on ground at (-0.5, 0) m;
          frame b on ground at (0.5, 0) m;
          liaison ca: contact_ponctuel(a, r.axis);
          liaison cb: contact_ponctuel(b, r.axis);
        initial
          r.position = (0, 0) m;
          r.velocity = (1, 0) m/s;
          experiment(stop = 1.3 s, tolerance = 1e-10);
        end Rods;
        """)
    cosine = math.cos(turn)
    space = run(
        """
        model Rods
          frame f on ground at (0, 0, 0) m rotated(axis = z, angle = {turn});
          body a: rod(mass = 1 kg, length = 1 m);
          body b: rod(mass = 1 kg, length = 1 m);
          body r: rod(mass = 1 kg, length = 2 m);
          frame fa on f at (-0.5, 0, 0) m rotated(axis = z, angle = 90 deg);
          frame fb on f at (0.5, 0.2, 0) m rotated(axis = z, angle = 90 deg);
          liaison wa: encastrement(fa, a);
          liaison wb: encastrement(fb, b);
          liaison ca: contact_ponctuel(a.axis, r.axis);
          liaison cb: contact_ponctuel(r.axis, b.axis);
        initial
          r.start.position = f.position - 1 m*f.ex;
          r.tip.position = f.position + 1 m*f.ex;
          r.velocity = 1 m/s*f.ex;
          experiment(stop = 1.3 s, tolerance = 1e-10);
        end Rods;
        """,
        turn=turn,
    )
    assert [e.time for e in space.events] == pytest.approx([e.time for e in plane.events], abs=1e-9)
    assert space["r.position.x"][-1] == pytest.approx(plane["r.position.x"][-1] * cosine, abs=1e-8)
    assert space["r.position.z"][-1] == pytest.approx(plane["r.position.y"][-1], abs=1e-8)


def test_a_ring_swings_on_a_rod_and_leaves_it_as_its_planar_twin() -> None:
    """The rod is inside of the ring."""
    plane = run("""
        planar model Ring
          body r: ring(mass = 1 kg, radius = 0.3 m);
          frame a on ground at (0, 0) m;
          liaison c: contact_ponctuel(a, r.rim);
        initial
          r.position = (0, -0.3) m;
          r.velocity = (2.2, 0) m/s;
          experiment(stop = 0.6 s, tolerance = 1e-10);
        end Ring;
        """)
    space = run("""
        model Ring
          body r: ring(mass = 1 kg, radius = 0.3 m);
          body a: rod(mass = 1 kg, length = 1 m);
          frame f on ground at (0, 0.1, 0) m rotated(axis = z, angle = 90 deg);
          frame g on ground at (0, 0, -0.3) m rotated(axis = x, angle = 90 deg);
          liaison w: encastrement(f, a);
          liaison c: contact_ponctuel(a.axis, r.rim);
        initial
          r.position = g.position;
          r.orientation = g.orientation;
          r.velocity = (2.2, 0, 0) m/s;
          experiment(stop = 0.6 s, tolerance = 1e-10);
        end Ring;
        """)
    assert [e.time for e in space.events] == pytest.approx([e.time for e in plane.events], abs=1e-9)
    assert space["r.position.z"][-1] == pytest.approx(plane["r.position.y"][-1], abs=1e-8)


def test_a_ball_slides_off_the_end_of_a_curve() -> None:
    """As off the end of a rod."""
    result = run("""
        model Off
          curve c on ground: parametric((u, 0 m, 0 m), u = (-1 m, 1 m));
          body b: sphere(mass = 3 kg, radius = 0.2 m);
          liaison on: contact_ponctuel(c, b.surface);
        initial
          b.position = (0.8, 0, 0.2) m;
          b.velocity = (1, 0, 0) m/s;
          experiment(stop = 1 s, tolerance = 1e-11);
        end Off;
        """)
    (leaving,) = result.events
    turn = math.acos((2 + 1 / (G * 0.2)) / 3)
    way, _ = quad(lambda a: 0.2 / math.sqrt(1 + 0.4 * G * (1 - math.cos(a))), 0, turn, epsabs=1e-13)
    assert leaving.time == pytest.approx(0.2 + way, abs=1e-9)


def test_a_point_that_cannot_sink_into_a_rough_face_leaves_it_at_its_border() -> None:
    """`point_surface` that may part: 0.2 m under the deceleration mu g, then free."""
    result = run("""
        model Over
          body t: box(mass = 2 kg, size = (2, 1, 0.2) m);
          body b: particle(mass = 1 kg);
          liaison w: encastrement(ground, t);
          liaison c: point_surface(b, t.top, unilateral = true) with coulomb(0.1);
        initial
          guess(t.position = (0, 0, 0) m);
          b.position = (0.8, 0.1, 0.1) m;
          b.velocity = (1, 0, 0) m/s;
          experiment(stop = 0.5 s, tolerance = 1e-11);
        end Over;
        """)
    (leaving,) = result.events
    brake = 0.1 * G
    expected = (1 - math.sqrt(1 - 2 * brake * 0.2)) / brake
    assert leaving.time == pytest.approx(expected, abs=1e-10)
    fall = 0.5 - expected
    assert result["b.position.z"][-1] == pytest.approx(0.1 - G * fall**2 / 2, abs=1e-9)


def test_a_cord_whose_length_swings_goes_slack() -> None:
    """The length 1 + a sin(w t) holds the point while a w^2 sin(w t) > -g."""
    result = run("""
        model Cord
          body b: particle(mass = 1 kg);
          frame o on ground at (0, 0, 2) m;
          liaison c: fil(o, b, length = 1 m + 0.05 m*sin(20 1/s*time));
        initial
          b.position = (0, 0, 1) m;
          b.velocity = (0, 0, -1) m/s;
          experiment(stop = 0.2 s, tolerance = 1e-11);
        end Cord;
        """)
    (slack,) = result.events
    assert slack.time == pytest.approx((math.pi + math.asin(G / 20)) / 20, abs=1e-11)


@pytest.mark.parametrize("turn", [0.0, 0.5])
def test_a_plane_that_shakes_throws_off_what_lies_on_it(turn: float) -> None:
    """A sin(w t) along the normal: the point leaves where A w^2 sin(w t) = g cos(turn)."""
    result = run(
        """
        model Shaken
          frame f on ground at (0, 0, 0) m rotated(axis = y, angle = {turn});
          surface s on f: plane((0 m, 0 m, 0.1 m*sin(12 1/s*time)), normal = (0, 0, 1));
          body b: particle(mass = 1 kg);
          liaison c: contact_ponctuel(b, s);
        initial
          b.position = (0, 0, 0) m;
          b.velocity = 1.2 m/s*f.ez;
          experiment(stop = 0.15 s, tolerance = 1e-11);
        end Shaken;
        """,
        turn=turn,
    )
    (leaving,) = result.events
    expected = math.asin(G * math.cos(turn) / (0.1 * 144)) / 12
    assert leaving.time == pytest.approx(expected, abs=1e-10)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("body b: disc(mass = 1 kg, radius = 0.1 m); liaison c: contact_ponctuel(b.rim, "
         "ground.plane); initial b.position = (0, 0, 0) m;", "E0911.*'c'.*no single place"),
        ("body b: cylinder(mass = 1 kg, radius = 0.1 m, length = 0.4 m); liaison c: "
         "contact_ponctuel(b.side, ground.plane); initial b.position = (0, 0, 0.2) m;", "E0911"),
        ("curve l on ground: line((0, 0, 0) m, direction = (1, 0, 0)); "
         "body b: particle(mass = 1 kg); liaison c: point_courbe(b, l, unilateral = true); "
         "initial b.position = (0, 0, 0) m;",
         "E0204.*holds a point from all sides"),
        ("body t: box(mass = 1 kg, size = (1, 1, 0.1) m); liaison w: encastrement(ground, t); "
         "body b: box(mass = 1 kg, size = (0.2, 0.2, 0.2) m); liaison c: appui_faces(b.bottom, "
         "t.top); initial guess(t.position = (0, 0, 0) m); b.position = (0, 0, 0.14) m;",
         "E0601.*puts the bodies into each other"),
        ("body t: box(mass = 1 kg, size = (1, 1, 0.1) m); liaison w: encastrement(ground, t); "
         "body b: sphere(mass = 1 kg, radius = 0.2 m); liaison c: contact_ponctuel(b.surface, "
         "t.top); initial guess(t.position = (0, 0, 0) m); b.position = (0, 0, 0.24) m;",
         "E0601.*puts the bodies into each other"),
    ],
)  # fmt: skip
def test_what_begins_without_a_place_or_inside_is_refused(text: str, told: str) -> None:
    with pytest.raises(frot.FrotError, match=told):
        frot.compile(f"model Bad {text} experiment(stop = 1 s); end Bad;").simulate()


@pytest.mark.parametrize("mass", [1, 1e6])
def test_a_rod_on_a_surface_given_by_a_function_moves_as_on_the_sphere(mass: float) -> None:
    """The function of a sphere; the rod lands on it, slides and leaves."""
    text = """
        model Slides
          body p: rod(mass = MASS kg, length = 1 m, inertia = MASS*(0.01, 0.1, 0.1) kg.m^2);
          surface s on ground: SURFACE;
          liaison l: contact_ponctuel(s, p.axis) with coulomb(0.2);
        initial
          p.position = (0.1, 0.05, 1.5) m;
          p.orientation = (cos(0.3), 0, 0, sin(0.3));
          p.velocity = (1, 0.3, 0) m/s;
          p.angular_velocity = (0, 0.3, 0.5) rad/s;
          experiment(stop = 0.8 s, tolerance = 1e-10);
        end Slides;
        """.replace("MASS", str(mass))
    forms = (
        "implicit(x^2 + y^2 + z^2 - 1 m^2)",
        "ellipsoid(semi_axes = (1, 1, 1) m)",
        "sphere(radius = 1 m)",
    )
    results = [frot.compile(text.replace("SURFACE", form)).simulate() for form in forms]
    ends = [[r[f"p.position.{c}"][-1] for c in "xyz"] for r in results]
    assert ends[0] == pytest.approx(ends[2], abs=1e-8)
    assert ends[1] == pytest.approx(ends[2], abs=1e-8)
    assert [e.after for e in results[0].events] == [e.after for e in results[2].events]
    assert "slip" in [e.after for e in results[0].events]
