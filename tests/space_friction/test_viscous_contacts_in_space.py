"""Viscous friction in space of contacts that can part: while closed -c times the slip in all."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import brentq

import frot

G, K, R = 9.81, 0.7, 0.1
LANDS = brentq(lambda t: 0.2 - G * t**2 / 2 + G * t**3 / 6, 0, 0.5, xtol=1e-16)

# `n` is the normal of the floor, against gravity; e and h span it.
BALL = """model Ball
  parameter Mass m = {mass!r} kg;
  world(down = (-({n[0]!r}), -({n[1]!r}), -({n[2]!r})));
  surface floor on ground: plane(through = (0, 0, 0) m, normal = ({n[0]!r}, {n[1]!r}, {n[2]!r}));
  body b: sphere(mass = m, radius = 0.1 m);
  liaison contact: contact_ponctuel({places}) with viscous({damping!r} N.s/m);
  force lift: on(b.G, value = m*9.81 m/s^2*time/(1 s)*({n[0]!r}, {n[1]!r}, {n[2]!r}));
initial
  b.position = 0.3 m*({n[0]!r}, {n[1]!r}, {n[2]!r});
  b.velocity = ({v[0]!r}, {v[1]!r}, {v[2]!r}) m/s;
  b.angular_velocity = ({w[0]!r}, {w[1]!r}, {w[2]!r}) rad/s;
  experiment(stop = 1.3 s, tolerance = 1e-11);
end Ball;
"""


def vector(run: frot.Result, name: str, t: float) -> np.ndarray:
    now = run.at(t)
    return np.array([float(now[f"{name}.{axis}"]) for axis in "xyz"])


@pytest.mark.parametrize("places", ["floor, b.surface", "b.surface, floor"])
@pytest.mark.parametrize("mass", [1e-6, 1.0, 1e6])
@pytest.mark.parametrize("seed", [0, 1])
def test_a_ball_lands_slides_and_is_lifted_off(seed: int, mass: float, places: str) -> None:
    """S' = -(1/m + r^2/I) c s = -3.5 k s for any tilt and direction; then nothing acts."""
    random = np.random.default_rng(seed)
    n = random.normal(size=3)
    n /= np.linalg.norm(n)
    v, w = random.normal(size=3), 5 * random.normal(size=3)
    v -= (v @ n) * n
    fields = {"n": n.tolist(), "v": v.tolist(), "w": w.tolist(), "places": places}
    run = frot.compile(BALL.format(mass=mass, damping=K * mass, **fields)).simulate()
    assert [e.kind for e in run.events] == ["impact", "contact", "separation"]
    assert [e.time for e in run.events] == pytest.approx([LANDS, LANDS, 1], abs=1e-9)
    slip = v + np.cross(w, -R * n)
    for t in (0.5 * LANDS, LANDS + 1e-6, 0.6, 1 - 1e-6, 1.2):
        closed = min(max(t - LANDS, 0), 1 - LANDS)
        lost = slip * (1 - math.exp(-3.5 * K * closed)) / 3.5
        want = v - lost + G * (t**2 / 2 - t) * n * (t < LANDS)
        got = vector(run, "b.velocity", t)
        across = got - (got @ n) * n
        assert np.abs(across - (want - (want @ n) * n)).max() < 1e-9
        spin = w + np.cross(-R * n, -lost) / (0.4 * R**2)
        assert np.abs(vector(run, "b.angular_velocity", t) - spin).max() < 1e-8
    assert run.balance.relative < 1e-9


FLAT = """model Flat
  parameter Mass m = {mass!r} kg;
  body b: {body};
  liaison contact: {contact} with viscous({damping!r} N.s/m);
initial
  b.position = (0, 0, {height}) m;
  b.orientation = ({c!r}, 0, 0, {s!r});
  b.velocity = (1.5, -0.5, 0) m/s;
  b.angular_velocity = (0, 0, {spin}) rad/s;
  experiment(stop = 2 s, tolerance = 1e-11);
end Flat;
"""
BOX = "box(mass = m, size = (0.4, 0.2, 0.1) m)"
ROD = "rod(mass = m, length = 0.6 m)"


@pytest.mark.parametrize("turned", [0.0, 0.7])
@pytest.mark.parametrize("mass", [1.0, 1e6])
@pytest.mark.parametrize(
    ("body", "contact", "height", "square", "inertia"),
    [
        (BOX, "appui_faces(b.bottom, ground.plane)", 0.05, 0.05, 0.2 / 12),
        (BOX, "appui_faces(ground.plane, b.bottom)", 0.05, 0.05, 0.2 / 12),
        (ROD, "lineaire_rectiligne(b.axis, ground.plane, unilateral = true)", 0.0, 0.09, 0.03),
        (ROD, "lineaire_rectiligne(b.axis, ground.plane)", 0.0, 0.09, 0.03),
        (ROD, "contact_ponctuel(b.axis, ground.plane)", 0.0, 0.09, 0.03),
    ],
)
def test_what_touches_by_several_points_has_the_friction_of_one(
    body: str,
    contact: str,
    height: float,
    square: float,
    inertia: float,
    mass: float,
    turned: float,
) -> None:
    """V' = -k v, and the couple is -c times the mean square of the distances of the points."""
    text = FLAT.format(
        body=body,
        contact=contact,
        mass=mass,
        damping=K * mass,
        height=height,
        c=math.cos(turned / 2),
        s=math.sin(turned / 2),
        spin=2.0,
    )
    run = frot.compile(text).simulate()
    assert not run.events
    for t in (0.3, 2.0):
        want = math.exp(-K * t) * np.array([1.5, -0.5, 0])
        assert np.abs(vector(run, "b.velocity", t) - want).max() < 1e-9
        spin = 2 * math.exp(-K * square / inertia * t)
        assert float(run.at(t)["b.angular_velocity.z"]) == pytest.approx(spin, abs=1e-8)
    assert run.balance.relative < 1e-9


def test_a_box_slides_over_an_edge_as_its_planar_twin() -> None:
    """With coulomb too, over the edge of a table, tipping, then in free flight."""
    planar = """planar model Over
      body table: box(mass = 1 kg, size = (2, 1) m);
      liaison fix: encastrement(ground, table);
      body b: box(mass = 1 kg, size = (0.4, 0.1) m);
      liaison top: appui_faces(b.bottom, table.top) with {laws};
    initial
      b.position = (0, 0.55) m;
      b.velocity = (3, 0) m/s;
      experiment(stop = 0.6 s, tolerance = 1e-10);
    end Over;
    """
    space = """model Over
      body table: box(mass = 1 kg, size = (2, 1, 1) m);
      liaison fix: encastrement(ground, table);
      body b: box(mass = 1 kg, size = (0.4, 0.3, 0.1) m);
      liaison top: appui_faces(b.bottom, table.top) with {laws};
    initial
      b.position = (0, 0, 0.55) m;
      b.velocity = (3, 0, 0) m/s;
      experiment(stop = 0.6 s, tolerance = 1e-10);
    end Over;
    """
    laws = "coulomb(0.1), viscous(0.5 N.s/m)"
    flat, whole = (frot.compile(text.format(laws=laws)).simulate() for text in (planar, space))
    for t in (0.25, 0.36, 0.45, 0.6):
        one, other = flat.at(t), whole.at(t)
        for what in ("b.position", "b.velocity"):
            for a, b in (("x", "x"), ("y", "z")):
                want = float(one[f"{what}.{a}"])
                assert float(other[f"{what}.{b}"]) == pytest.approx(want, abs=1e-7)
    assert whole.balance.relative < 1e-9
