"""Rows of the catalogue of worked examples: values of `tests/reference/worked_rows.json`.

They were solved from the texts' own scalar equations, independently of any simulator.
"""

from __future__ import annotations

import json
import math
import textwrap
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import frot

HERE = Path(__file__).parents[1] / "reference" / "worked_rows.json"
ROWS = {row["id"]: row for row in json.loads(HERE.read_text(encoding="utf-8"))}
MODELS = Path(__file__).parents[2] / "models"


def row(name: str) -> tuple[dict[str, Any], dict[str, Any]]:
    """Parameters and expected values of a row."""
    return ROWS[name]["parameters"], ROWS[name]["expected"]


def run(text: str) -> frot.Result:
    """The run of an indented text."""
    return frot.compile(textwrap.dedent(text)).simulate()


@pytest.mark.parametrize("name", ["cycloid-1", "cycloid-2"])
def test_a_bead_on_a_rough_cycloid_stops(name: str) -> None:
    """The time to the point A, where tan(alpha) = f, does not depend on the start."""
    p, want = row(name)
    result = run(f"""
        planar model Cycloid
          body b: particle(mass = 1 kg);
          curve c on ground: parametric((1 m*(2*u + sin(2*u)), 1 m*(1 - cos(2*u))),
            u = (-1.5, 1.5));
          liaison g: point_courbe(b, c) with coulomb({p["f"]});
          Boolean passed(start = false);
        initial
          g.u = {p["a0"]};
          b.velocity = (0, 0) m/s;
        equation
          when g.u < atan({p["f"]}) then
            passed = true;
          end when;
          experiment(stop = 1.97 s, tolerance = 1e-11);
        end Cycloid;
        """)
    stop = next(e for e in result.events if e.liaison == "g" and e.time > 0.1)
    assert stop.time == pytest.approx(want["t_stop"], abs=1e-8)
    assert result.at(stop.time)["g.u"] == pytest.approx(want["alpha_stop"], abs=1e-8)
    at = result.at(want["t_to_A"])
    assert at["g.u"] == pytest.approx(math.atan(p["f"]), abs=1e-8)


def test_a_bead_on_a_rough_circle_that_grows() -> None:
    """Each material element of the circle moves along its radius."""
    p, want = row("expanding_circle-1")
    result = run(f"""
        planar model Grows
          world(gravity = 0 m/s^2);
          body b: particle(mass = 1 kg);
          curve c on ground: circle(radius = {p["K"]} m/s*({p["t0"]} s + time));
          liaison g: point_courbe(b, c) with coulomb({p["f"]});
        initial
          g.u = 0;
          der(g.u) = {p["u0"]} rad/s;
          experiment(stop = {p["t"] - p["t0"]} s, tolerance = 1e-11);
        end Grows;
        """)
    assert result["g.u"][-1] == pytest.approx(want["theta"], abs=1e-9)
    x, v = ([result[f"b.{n}.{c}"][-1] for c in "xy"] for n in ("position", "velocity"))
    rate = (x[0] * v[1] - x[1] * v[0]) / (x[0] ** 2 + x[1] ** 2)
    assert rate == pytest.approx(want["theta_dot"], abs=1e-9)


def test_a_bead_on_a_rough_line_that_turns() -> None:
    """The ratio r'/r tends to its limit."""
    p, want = row("rotating_line-1")
    sine, cosine = math.sin(p["alpha"]), math.cos(p["alpha"])
    result = run(f"""
        model Turns
          world(gravity = 0 m/s^2);
          body b: particle(mass = 1 kg);
          frame f on ground rotated(axis = z, angle = {p["omega"]} rad/s*time);
          curve c on f: line(through = (0, 0, 0) m, direction = ({sine}, 0, {cosine}));
          liaison g: point_courbe(b, c) with coulomb({p["f"]});
        initial
          g.u = {p["r0"]} m;
          der(g.u) = {p["v0"]} m/s;
          experiment(stop = {p["t"]} s, tolerance = 1e-12);
        end Turns;
        """)
    assert result["g.u"][-1] == pytest.approx(want["r"], rel=1e-8)
    x, v = (np.array([result[f"b.{n}.{c}"][-1] for c in "xyz"]) for n in ("position", "velocity"))
    assert x @ v / np.linalg.norm(x) == pytest.approx(want["r_dot"], rel=1e-8)


@pytest.mark.parametrize("tilt", [(0, 0, 1), (1, 2, 2), (-2, 1, 2)])
def test_a_point_on_a_rough_sphere_runs_a_great_circle(tilt: tuple[int, ...]) -> None:
    """The speed is v0/(1 + f v0 t/R); the plane of the circle is tilted too."""
    p, want = row("great_circle-1")
    normal = np.array(tilt) / np.linalg.norm(tilt)
    first = np.cross(normal, [3.0, 1.0, 0.5])
    first /= np.linalg.norm(first)
    second = np.cross(normal, first)
    place, speed = (tuple(float(x) for x in v) for v in (first, p["v0"] * second))
    result = run(f"""
        model Sphere
          world(gravity = 0 m/s^2);
          body b: particle(mass = 1 kg);
          surface s on ground: sphere(radius = {p["R"]} m);
          liaison g: point_surface(b, s) with coulomb({p["f"]});
        initial
          b.position = {place} m;
          b.velocity = {speed} m/s;
          experiment(stop = {p["t"]} s, tolerance = 1e-11);
        end Sphere;
        """)
    x, v = (np.array([result[f"b.{n}.{c}"][-1] for c in "xyz"]) for n in ("position", "velocity"))
    assert np.linalg.norm(v) == pytest.approx(want["v"], abs=1e-9)
    angle = math.atan2(x @ second, x @ first) % (2 * math.pi)
    assert angle == pytest.approx(want["angle"], abs=1e-9)
    assert x @ normal == pytest.approx(0, abs=1e-9)


ELLIPSE = """
    planar model Disc
      body e: ellipse(mass = 1 kg, a = {a} m, b = {b} m);
      liaison g: contact_ponctuel(ground.line, e.rim, unilateral = false) with coulomb({f});
    initial
      e.angle = {th} rad;
      e.angular_velocity = {thd} rad/s;
      e.velocity.x = {xid} m/s;
      guess(e.position = (0, {b}) m);
      experiment(stop = {t} s, tolerance = 1e-11{more});
    end Disc;
    """


@pytest.mark.parametrize("number", [1, 2, 3, 4])
def test_the_sliding_motions_of_an_elliptic_disc(number: int) -> None:
    """One, none, or two past the threshold, with their reactions."""
    p, want = row(f"ellipse_acceleration-{number}")
    text = ELLIPSE.format(t=1, more="", **p)
    motions = [
        m for part in frot.compile(textwrap.dedent(text)).motions().parts for m in part.motions
    ]
    names = ("g.normal_force", "e.acceleration.x", "e.angular_acceleration")
    found = sorted([m[n] for n in names] for m in motions)
    exact = sorted([m["R_n"], m["xi_dd"], m["theta_dd"]] for m in want["motions"])
    assert len(found) == len(exact)
    for one, other in zip(found, exact, strict=True):
        assert one == pytest.approx(other, rel=1e-9)


def test_an_elliptic_disc_slides() -> None:
    """The contact holds both ways."""
    p, want = row("ellipse_slide-1")
    state = {"th": p["th0"], "thd": p["thd0"], "xid": p["xid0"]}
    result = run(ELLIPSE.format(more="", **{**p, **state}))
    names = ("e.position.x", "e.angle", "e.velocity.x", "e.angular_velocity", "g.slip")
    exact = [want[k] for k in ("xi", "theta", "xi_dot", "theta_dot", "slip")]
    assert [result[n][-1] for n in names] == pytest.approx(exact, abs=1e-8)


def test_a_bar_with_its_middle_on_a_rough_axis() -> None:
    """Its end stays on a smooth plane across the axis; gravity across presses it on the axis."""
    p, want = row("bar_axis-1")
    values = {
        "mu": p["f"], "l": f"{p['l']} m", "along": f"{p['gam']} m/s^2",
        "across": f"{p['gamp']} m/s^2", "start": p["th0"], "fall": f"{p['thd0']} rad/s",
        "turn": f"{p['a']} rad/s",
    }  # fmt: skip
    result = frot.load(MODELS / "bar_on_an_axis.frot").simulate(stop=p["t"], parameters=values)
    theta, speed = result["theta"][-1], result["bar.velocity.z"][-1]
    assert theta == pytest.approx(want["theta"], abs=1e-9)
    assert -speed / math.sin(theta) == pytest.approx(want["theta_dot"], abs=1e-8)


def test_a_hoop_rolls_without_slipping() -> None:
    """Euler angles: theta of the axis to the vertical, psi of precession, phi of rolling."""
    p, want = row("rolling_hoop-1")
    half, sine, cosine = p["th0"] / 2, math.sin(p["th0"]), math.cos(p["th0"])
    result = run(f"""
        model Hoop
          body hoop: ring(mass = 1 kg, radius = {p["a"]} m);
          liaison floor: roulement(ground.plane, hoop.rim);
          output Real own = hoop.ez.z;
          output AngularVelocity spin = dot(hoop.angular_velocity, hoop.ez);
        initial
          hoop.position = (0, 0, {p["a"] * sine}) m;
          hoop.orientation = ({math.cos(half)}, {math.sin(half)}, 0, 0);
          hoop.angular_velocity = ({p["thd0"]}, {-p["phid0"] * sine},
            {p["psid0"] + p["phid0"] * cosine}) rad/s;
          experiment(stop = {p["t"]} s, tolerance = 1e-12);
        end Hoop;
        """)
    theta = math.acos(result["own"][-1])
    assert theta == pytest.approx(want["theta"], abs=1e-9)
    fall = result["hoop.velocity.z"][-1] / (p["a"] * math.cos(theta))
    assert fall == pytest.approx(want["theta_dot"], abs=1e-8)
    w3, up = result["spin"][-1], result["hoop.angular_velocity.z"][-1]
    assert w3 == pytest.approx(want["w3"], abs=1e-9)
    precession = (up - w3 * math.cos(theta)) / math.sin(theta) ** 2
    assert precession == pytest.approx(want["psi_dot"], abs=1e-8)


def test_a_rod_on_a_fixed_point_describes_a_cone() -> None:
    """Its precession, the size of the reaction and its inclination."""
    p, want = row("conical_rod-1")
    values = {"L": f"{2 * p['a']} m", "slope": f"{p['alpha']} rad"}
    result = frot.load(MODELS / "conical_rod.frot").simulate(parameters=values)
    assert result["rod.angular_velocity.z"][0] == pytest.approx(
        want["precession"] * math.sin(p["alpha"]) ** 2, rel=1e-9
    )
    assert result["rod.tip.position.z"] == pytest.approx(
        -2 * p["a"] * math.cos(p["alpha"]), abs=1e-8
    )
    for t in (0.0, 1.7, 4.0):
        force = np.array([result.at(t)[f"pivot.force.{c}"] for c in "xyz"])
        slope = math.hypot(force[0], force[1]) / force[2]
        assert slope == pytest.approx(want["tan_gamma"], rel=1e-8)
        assert np.linalg.norm(force) / 9.81 == pytest.approx(want["reaction_over_weight"], rel=1e-8)


def test_a_ball_in_the_channel_of_a_rolling_wheel() -> None:
    """The liaison depends on time."""
    p, want = row("wheel_channel-1")
    values = {"tilt": p["alpha"], "k": f"{p['k']} rad/s", "start": p["w0"]}
    result = frot.load(MODELS / "wheel_channel.frot").simulate(parameters=values)
    assert result["q"][-1] == pytest.approx(want["omega"], abs=1e-9)
    near = result.time > 1.9
    slope = np.polynomial.Polynomial.fit(result.time[near] - 2, result["q"][near], 6).deriv()(0)
    assert slope == pytest.approx(want["omega_dot"], abs=1e-7)
