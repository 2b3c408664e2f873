"""Scenes with known values: `tests/reference/named_scenes.json`, closed forms and scalar roots."""

from __future__ import annotations

import json
import math
import textwrap
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import frot

HERE = Path(__file__).parents[1] / "reference" / "named_scenes.json"
ROWS = {row["id"]: row for row in json.loads(HERE.read_text(encoding="utf-8"))}
G = 9.81


def known(name: str) -> dict[str, Any]:
    """Expected values of a scene, as numbers where they are."""

    def number(x: Any) -> Any:
        if isinstance(x, list):
            return [number(y) for y in x]
        try:
            return float(x)
        except (TypeError, ValueError):
            return x

    return {key: number(value) for key, value in ROWS[name]["expected"].items()}


def run(text: str, **values: str) -> frot.Result:
    """The run of an indented text."""
    return frot.compile(textwrap.dedent(text)).simulate(parameters=values)


@pytest.mark.parametrize(
    ("name", "mu"), [("S03_block_on_shaking_table", 0.3), ("S03b_block_on_shaking_table", 0.2)]
)
@pytest.mark.parametrize("mass", [1, 1e6, 1e-6])
def test_a_block_on_a_shaking_table(name: str, mu: float, mass: float) -> None:
    """It slips from A w^2 sin(w t) = mu g on; where the speeds meet it sticks, or reverses."""
    want = known(name)
    result = run(f"""
        planar model Shaken
          body b: particle(mass = {mass} kg);
          frame table on ground at (0.1 m*sin(2*pi*time/(1 s)), 0 m);
          curve top on table: line(through = (0, 0) m, direction = (1, 0));
          liaison g: contact_ponctuel(top, b) with coulomb({mu});
          output Length way = b.position.x - table.position.x;
        initial
          b.position = (0, 0) m;
          g.slip = 0 m/s;
          experiment(stop = 0.7 s, tolerance = 1e-11);
        end Shaken;
        """)
    first, second = [e for e in result.events if e.liaison == "g"][:2]
    assert first.time == pytest.approx(want["t_first_slip"], abs=1e-10)
    assert second.time == pytest.approx(want["t_relative_velocity_zero"], abs=1e-9)
    slid = abs(float(result.at(second.time)["way"]))
    assert slid == pytest.approx(want["relative_slide_first_phase"], abs=1e-9)
    assert (second.after == "stick") == (want["outcome_there"] == "sticks")


def test_the_amplitude_of_a_forced_oscillator_with_dry_friction() -> None:
    """Den Hartog 1931: the steady motion slides both ways without a rest."""
    want = known("S06_den_hartog_forced")
    result = run("""
        planar model Forced
          parameter Time unit = 1 s;
          world(gravity = 10 m/s^2);
          body b: particle(mass = 1 kg);
          liaison g: prismatique(ground, b) with coulomb(0.02);
          force pull: on(b, value = (cos(0.8*time/unit) - b.position.x/(1 m), 0)*(1 N));
        initial
          b.velocity = (0, 0) m/s;
          b.position = (2.7, 0) m;
          experiment(stop = 800 s, tolerance = 1e-10);
        end Forced;
        """)
    late = result.time > 780
    assert np.abs(result["b.position.x"][late]).max() <= want["amplitude_over_P_k"] + 1e-6
    turns = [e.time for e in result.events if e.liaison == "g" and e.time > 780]
    sizes = [abs(float(result.at(t)["b.position.x"])) for t in turns]
    assert sizes == pytest.approx([want["amplitude_over_P_k"]] * len(sizes), abs=1e-6)
    assert len(sizes) > 3


def test_a_bouncing_ball_comes_to_rest() -> None:
    """The bounces add up to sqrt(2 h/g) (1 + e)/(1 - e), and the run goes on."""
    want = known("S07_bouncing_ball_zeno")
    result = run("""
        planar model Bounces
          body b: particle(mass = 1 kg);
          liaison g: contact_ponctuel(ground.line, b) with restitution(0.8);
        initial
          b.position = (0, 1) m;
          b.velocity = (0, 0) m/s;
          experiment(stop = 6 s, tolerance = 1e-11);
        end Bounces;
        """)
    times = [e.time for e in result.events]
    assert times[0] == pytest.approx(want["t_impact_1"], abs=1e-10)
    assert times[4] == pytest.approx(want["t_impact_5"], abs=1e-10)
    assert times[-1] == pytest.approx(want["t_zeno"], abs=1e-7)
    assert result.time[-1] == 6
    assert result["b.velocity.y"][-1] == 0


@pytest.mark.parametrize("way", [0.0, 1.1])
def test_a_sphere_slides_and_then_rolls(way: float) -> None:
    """It rolls with 5/7 of its first speed."""
    want = known("S08_sphere_slide_to_roll")
    c, s = math.cos(way), math.sin(way)
    result = run(f"""
        model Rolls
          body b: sphere(mass = 1 kg, radius = 0.1 m);
          liaison g: contact_ponctuel(ground.plane, b.surface) with coulomb(0.2);
        initial
          b.position = (0, 0, 0.1) m;
          b.velocity = ({3 * c}, {3 * s}, 0) m/s;
          experiment(stop = 1 s, tolerance = 1e-11);
        end Rolls;
        """)
    (stop,) = (e for e in result.events if e.time > 0)
    assert stop.time == pytest.approx(want["t_roll"], abs=1e-10)
    at = result.at(stop.time)
    along = [at[f"b.{n}.x"] * c + at[f"b.{n}.y"] * s for n in ("position", "velocity")]
    assert along == pytest.approx([want["x_roll"], want["v_roll"]], abs=1e-9)


@pytest.mark.parametrize("factor", [1 - 1e-7, 1 + 1e-7])
@pytest.mark.parametrize("force", [1, 1e6])
def test_a_sleeve_jams_by_an_offset_of_the_force(factor: float, force: float) -> None:
    """From d = L/(2 mu) on, whatever the force."""
    offset = known("S11_arc_boutement_jam")["d_critical"] * factor
    result = run(f"""
        planar model Sleeve
          world(gravity = 0 m/s^2);
          body b: box(mass = 1 kg, size = (0.1, 0.02) m);
          frame arm on b at (0, {offset}) m;
          liaison g: prismatique(ground, b) with coulomb(0.3, half_length = 5 cm);
          force pull: on(arm, value = ({force}, 0) N);
        initial
          b.position = (0, 0) m;
          b.velocity = (0, 0) m/s;
          experiment(stop = 0.1 s);
        end Sleeve;
        """)
    assert (result["b.velocity.x"][-1] == 0) == (factor > 1)


def test_a_pendulum_with_a_constant_friction_couple() -> None:
    """Each half swing loses the angle by m g l (cos b - cos a) = T (a + b)."""
    want = known("S12_pendulum_constant_friction_torque")["turning_points_abs"]
    result = run("""
        planar model Swings
          body b: solid(mass = 1 kg, inertia = 1e-12 kg.m^2, com = (1, 0) m);
          Torque brake;
          liaison pin: rotoide(ground, b.origin);
          force drag: couple(pin, value = brake);
        initial
          pin.angle = 1.2 rad - pi/2;
          pin.speed = 0 rad/s;
        equation
          brake = friction(pin.speed, 0.5 N.m);
          experiment(stop = 20 s, tolerance = 1e-11);
        end Swings;
        """)
    turns = [e.time for e in result.events if e.time > 0]
    angles = [float(result.at(t)["pin.angle"]) + math.pi / 2 for t in turns]
    assert [abs(x) for x in angles] == pytest.approx([abs(x) for x in want], abs=1e-9)


@pytest.mark.parametrize("key", ["1_4", "2"])
@pytest.mark.parametrize("mirror", [1, -1])
def test_painleves_coefficient_of_a_rod_vanishes_at_two_angles(key: str, mirror: int) -> None:
    """P = (1 + 3 cos^2 - 3 mu sin cos)/m of a rod with one end on a rough line, in between < 0."""
    first, second = known("S13_painleve_rod_classification")[f"theta_range_deg_mu_{key}"]
    mu = float(key.replace("_", "."))
    for degrees, lift in (
        (first - 1e-3, 0), (first + 1e-3, 20), (second - 1e-3, 20), (second + 1e-3, 0),
    ):  # fmt: skip
        angle = math.radians(degrees)
        text = f"""
            planar model Rod
              body r: rod(mass = 1 kg, length = 2 m);
              liaison g: contact_ponctuel(ground.line, r.start) with coulomb({mu});
              force up: on(r, value = (0, {lift}) N);
            initial
              r.start.position = (0, 0) m;
              r.angle = {angle if mirror > 0 else math.pi - angle} rad;
              r.start.velocity = ({-mirror}, 0) m/s;
              r.angular_velocity = 0 rad/s;
              experiment(stop = 1 s);
            end Rod;
            """
        motions = frot.compile(textwrap.dedent(text)).motions().parts[0].motions
        found = [law.painleve for m in motions for law in m.laws if law.painleve is not None]
        sine, cosine = math.sin(angle), math.cos(angle)
        assert found == pytest.approx([1 + 3 * cosine**2 - 3 * mu * sine * cosine], abs=1e-9)
        assert (found[0] < 0) == (lift > 0)


def test_a_disc_rolls_steadily_with_its_centre_at_rest() -> None:
    """Omega^2 = 4 g/(a sin(alpha)), alpha the inclination of the disc (Moffatt 2000)."""
    omega = known("S18_steady_rolling_disc")["Omega_precession"]
    a, alpha = 0.05, math.radians(20)
    # The angular velocity is along the diameter through the place of contact.
    spin = -omega * math.sin(alpha)
    result = run(f"""
        model Disc
          body d: disc(mass = 1 kg, radius = {a} m);
          liaison g: roulement(ground.plane, d.rim);
        initial
          d.position = (0, 0, {a * math.sin(alpha)}) m;
          d.orientation = ({math.cos(alpha / 2)}, {math.sin(alpha / 2)}, 0, 0);
          d.angular_velocity = (0, {-spin * math.cos(alpha)}, {-spin * math.sin(alpha)}) rad/s;
          experiment(stop = 0.5 s, tolerance = 1e-11);
        end Disc;
        """)
    assert np.abs(result["d.position.z"] - a * math.sin(alpha)).max() < 1e-9
    for c in "xyz":
        assert np.abs(result[f"d.velocity.{c}"]).max() < 1e-7


RIMLESS = """
    planar model Rimless
      world(down = ({sine}, {cosine}));
      body w: polygon(mass = 1 kg, vertices = ({vertices}) m, inertia = {inertia} kg.m^2);
      curve ramp on ground: line(through = (0, 0) m, direction = (1, 0));
      {feet}
    initial
      w.corners[1].position = (0, 0) m;
      w.angle = 0;
      w.corners[1].velocity = (0, 0) m/s;
      w.angular_velocity = {speed} rad/s;
      experiment(stop = {stop} s, tolerance = 1e-10);
    end Rimless;
    """


def rimless(inertia: float, speed: float, stop: float) -> frot.Result:
    """Eight spokes of 1 m on a slope of 0.08 rad, its mass in the hub but for the inertia."""
    angles = [math.pi / 4 * k + math.pi / 8 for k in range(8)]
    return run(
        RIMLESS.format(
            sine=math.sin(0.08),
            cosine=-math.cos(0.08),
            vertices=", ".join(f"({math.sin(x)}, {-math.cos(x)})" for x in angles),
            inertia=inertia,
            feet=" ".join(
                f"liaison g{k}: contact_ponctuel(ramp, w.corners[{k}]) with coulomb(5);"
                for k in range(1, 9)
            ),
            speed=speed,
            stop=stop,
        )
    )


@pytest.mark.parametrize("inertia", [1e-2, 1e-4, 1e-6, 1e-8])
def test_a_rimless_wheel_keeps_its_momentum_about_the_next_foot(inertia: float) -> None:
    """W+ (m l^2 + I) = w- (m l^2 cos(2a) + I); the rows have no inertia (McGeer 1990)."""
    want = known("S16_rimless_wheel")
    result = rimless(inertia, -want["omega_after_impact_fixed_point"], 1.2)
    time = next(e.time for e in result.events if e.kind == "impact")
    before, after = (float(result.at(time + x)["w.angular_velocity"]) for x in (-1e-9, 1e-9))
    ratio = (math.cos(math.pi / 4) + inertia) / (1 + inertia)
    assert after / before == pytest.approx(ratio, abs=1e-8)
    if inertia < 1e-5:
        assert -before == pytest.approx(want["omega_before"], abs=1e-6)
        assert -after == pytest.approx(want["omega_after_impact_fixed_point"], abs=1e-6)


def test_a_rimless_wheel_comes_to_its_limit_cycle() -> None:
    """W+ = c w-, w-^2 = w+^2 + 4 g/l sin(a) sin(slope)/(1 + I)."""
    result = rimless(1e-4, -1.2, 40)
    ratio = (math.cos(math.pi / 4) + 1e-4) / (1 + 1e-4)
    gained = 4 * G * math.sin(math.pi / 8) * math.sin(0.08) / (1 + 1e-4)
    speed = ratio * math.sqrt(gained / (1 - ratio**2))
    times = [e.time for e in result.events if e.kind == "impact"]
    assert len(times) > 30
    found = [-float(result.at(t + 1e-9)["w.angular_velocity"]) for t in times[-5:]]
    assert found == pytest.approx([speed] * 5, abs=1e-7)


def test_a_row_of_four_bars_passes_its_flat_postures() -> None:
    """Three rods and two bars of 1 m and 1 kg, upright with 1 m/s; they are flat twice a turn."""
    name = "S17_N_four_bar_singular"
    rods = " ".join(f"body r{k}: rod(mass = 1 kg, length = 1 m);" for k in range(3))
    bars = " ".join(f"body b{k}: rod(mass = 1 kg, length = 1 m);" for k in range(2))
    feet = " ".join(
        f"frame f{k} on ground at ({k}, 0) m; liaison p{k}: rotoide(f{k}, r{k}.start);"
        for k in range(3)
    )
    joints = " ".join(
        f"liaison s{k}: rotoide(r{k}.tip, b{k}.start); "
        f"liaison t{k}: rotoide(b{k}.tip, r{k + 1}.tip);"
        for k in range(2)
    )
    upright = " ".join(f"guess(r{k}.angle = pi/2);" for k in (1, 2))
    result = run(f"""
        planar model Row
          {rods} {bars} {feet} {joints}
        initial
          r0.angle = pi/2;
          r0.angular_velocity = -1 rad/s;
          {upright} guess(b0.angle = 0, b1.angle = 0);
          experiment(stop = 10 s, tolerance = 1e-12);
        end Row;
        """)
    for key, want in ROWS[name]["expected"].items():
        at = result.at(float(key.removeprefix("t=")))
        place = [2 * float(at["r0.position.x"]), 2 * float(at["r0.position.y"])]
        found = [*place, abs(float(at["r0.angular_velocity"]))]
        exact = [float(want[k]) for k in ("B0x", "B0y", "omega")]
        assert found == pytest.approx(exact, abs=1e-6)
