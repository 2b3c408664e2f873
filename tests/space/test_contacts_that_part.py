"""Smooth contacts in space that part, against closed forms and their planar twins."""

from __future__ import annotations

import math
import textwrap

import pytest

import frot

G = 9.81


def run(text: str, **options: object) -> frot.Result:
    return frot.compile(textwrap.dedent(text)).simulate(**options)


def ending(result: frot.Result, *names: str) -> list[float]:
    return [float(result[name][-1]) for name in names]


@pytest.mark.parametrize(("radius", "speed", "tilt"), [(1.0, 0.5, 0.0), (2.5, 1.0, 0.7)])
def test_a_point_leaves_a_sphere_where_its_weight_bends_its_way_no_more(
    radius: float, speed: float, tilt: float
) -> None:
    """N = 0 where g cos = v^2/R, with v^2 = v0^2 + 2 g R (1 - cos)."""
    result = run(f"""
        model Leave
          body b: particle(mass = 1.3 kg);
          surface s on ground: sphere(radius = {radius} m);
          liaison c: contact_ponctuel(b.G, s);
        initial
          b.position = (0 m, 0 m, {radius} m);
          b.velocity = ({speed * math.cos(tilt)} m/s, {speed * math.sin(tilt)} m/s, 0 m/s);
          experiment(stop = 2 s, tolerance = 1e-11);
        end Leave;
        """)
    (leaving,) = result.events
    assert leaving.kind == "separation"
    height = result.at(leaving.time)["b.position.z"]
    cosine = (speed**2 + 2 * G * radius) / (3 * G * radius)
    assert height == pytest.approx(radius * cosine, abs=1e-9)


TWO_BALLS = """
    {model} Twin
      body b: {ball}(mass = 1 kg, radius = 0.2 m);
      body s: {ball}(mass = 3 kg, radius = 0.8 m);
      liaison c: contact_ponctuel(b.{surface}, s.{surface});
      liaison f: contact_ponctuel(s.{surface}, ground.{ground});
    initial
      b.position = {b};
      b.velocity = {v};
      s.position = {s};
      s.velocity = {zero};
      experiment(stop = 0.9 s, tolerance = 1e-11);
    end Twin;
    """


@pytest.mark.parametrize("turn", [0.0, 0.9, 2.5])
def test_a_ball_leaves_another_as_its_planar_twin_does(turn: float) -> None:
    planar = run(
        TWO_BALLS.format(
            model="planar model", ball="disc", surface="rim", ground="line",
            b="(0 m, 1.8 m)", v="(0.5 m/s, 0 m/s)", s="(0 m, 0.8 m)", zero="(0 m/s, 0 m/s)",
        )
    )  # fmt: skip
    cosine, sine = math.cos(turn), math.sin(turn)
    space = run(
        TWO_BALLS.format(
            model="model", ball="sphere", surface="surface", ground="plane",
            b="(0 m, 0 m, 1.8 m)", v=f"({0.5 * cosine} m/s, {0.5 * sine} m/s, 0 m/s)",
            s="(0 m, 0 m, 0.8 m)", zero="(0 m/s, 0 m/s, 0 m/s)",
        )
    )  # fmt: skip
    assert [e.time for e in space.events] == pytest.approx(
        [e.time for e in planar.events], abs=1e-10
    )
    x, height = ending(planar, "b.position.x", "b.position.y")
    assert ending(space, "b.position.x", "b.position.y", "b.position.z") == pytest.approx(
        [x * cosine, x * sine, height], abs=1e-9
    )
    assert ending(space, "s.position.z") == pytest.approx([0.8], abs=1e-12)


def test_a_box_on_its_four_corners_leaves_the_ground_when_it_is_lifted() -> None:
    """The lift k t is the weight at m g/k; from there on z'' = k (t - t1)/m."""
    mass, growth = 2.0, 10.0
    result = run(f"""
        model Lift
          body b: box(mass = {mass} kg, size = (0.4 m, 0.3 m, 0.2 m));
          liaison c: appui_faces(b.bottom, ground.plane);
          force f: on(b, value = (0 N, 0 N, {growth} N/s*time));
        initial
          b.position = (0 m, 0 m, 0.1 m);
          b.velocity = (0.1 m/s, 0 m/s, 0 m/s);
          b.angular_velocity = (0 rad/s, 0 rad/s, 1 rad/s);
          experiment(stop = 3 s, tolerance = 1e-11);
        end Lift;
        """)
    start = mass * G / growth
    assert [e.kind for e in result.events] == ["separation"] * 4
    assert [e.time for e in result.events] == pytest.approx([start] * 4, abs=1e-10)
    after = 3 - start
    height = 0.1 + growth * after**3 / (6 * mass)
    assert ending(result, "b.position.z") == pytest.approx([height], abs=1e-9)


def test_a_cord_goes_slack_where_a_point_is_too_slow() -> None:
    """Thrown up from the side with v0, the tension is zero at the height h = v0^2/(3 g)."""
    speed = 3.5
    result = run(f"""
        model Cord
          body b: particle(mass = 1 kg);
          frame o on ground at (0 m, 0 m, 2 m);
          liaison c: fil(o, b.G, length = 1 m);
        initial
          b.position = (0.6 m, 0.8 m, 2 m);
          b.velocity = (0 m/s, 0 m/s, {speed} m/s);
          experiment(stop = 0.5 s, tolerance = 1e-11);
        end Cord;
        """)
    (slack,) = result.events
    there = result.at(slack.time)
    assert there["b.position.z"] - 2 == pytest.approx(speed**2 / (3 * G), abs=1e-9)
    assert there["c.length"] == pytest.approx(1, abs=1e-12)
    assert 0 < result["c.length"][-1] < 1
    assert result["c.gap"][-1] == pytest.approx(1 - result["c.length"][-1], abs=1e-12)


def test_a_ball_that_falls_meets_the_ground_with_its_speed() -> None:
    result = run("""
            model Fall
              body b: sphere(mass = 1 kg, radius = 0.1 m);
              liaison c: contact_ponctuel(b.surface, ground.plane);
            initial
              b.position = (0 m, 0 m, 1.1 m);
              b.velocity = (1 m/s, 2 m/s, 0 m/s);
              experiment(stop = 2 s);
            end Fall;
            """)
    met = result.events[0]
    assert met.kind == "impact"
    assert met.time == pytest.approx(math.sqrt(2 / 9.81), rel=1e-10)
    assert met.impulse == pytest.approx(math.sqrt(2 * 9.81), rel=1e-10)
    assert met.energy_lost == pytest.approx(9.81, rel=1e-10)


def test_a_pair_with_unknown_ends_is_refused_by_name() -> None:
    with pytest.raises(frot.FrotError, match="on a face or curve with ends is not supported yet"):
        run("""
            model Edge
              body t: box(mass = 2 kg, size = (1, 1, 1) m);
              body b: ellipsoid(mass = 1 kg, semi_axes = (0.1, 0.2, 0.3) m);
              surface s on b: parametric((u, v, u^2/1 m), u = (-1 m, 1 m), v = (-1 m, 1 m));
              liaison c: contact_ponctuel(t.top, s);
            initial
              b.position = (0.5 m, 0 m, 0 m);
            end Edge;
            """)
