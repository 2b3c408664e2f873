"""Friction of liaisons kept by relations: of the text, tangent curves, a line on a plane."""

from __future__ import annotations

import math

import numpy as np
import pytest
from space_models import G, last, model

STATED = """
    liaison OnPlane(a: frame, b: frame)
      geometric dot(b.position - a.position, a.ez) = 0;
    end OnPlane;
    liaison OnLine(a: frame, b: frame)
      geometric dot(b.position - a.position, a.ez) = 0;
      geometric 3*dot(b.position - a.position, a.ey - 2*a.ez) = 0;
    end OnLine;
    liaison AtPoint(a: frame, b: frame)
      geometric 2*(b.position - a.position) = 0;
    end AtPoint;
    liaison Hinge(a: frame, b: frame)
      geometric dot(b.ez, a.ex) = 0;
      geometric b.position.x + b.position.y = a.position.x + a.position.y;
      geometric 3*(b.position.z - a.position.z) = 0;
      geometric dot(b.ez, 2*a.ey + a.ex) = 0;
      geometric b.position.x - 2*b.position.y = a.position.x - 2*a.position.y;
    end Hinge;
    liaison OnSphere(a: frame, b: frame, Length r)
      geometric dot(b.position - a.position, b.position - a.position) = r^2;
    end OnSphere;
    """
POINT = """
    model Point
      parameter Mass m = 1 kg;
      parameter Angle slope = {slope} rad;
      body p: particle(mass = m);
      frame hill on ground at (0.3, -0.2, 0.1) m rotated(axis = {axis}, angle = slope);
      surface plane on hill: plane(through = (0, 0, 0) m, normal = (0, 0, 1));
      curve line on hill: line(through = (0, 0, 0) m, direction = (1, 0, 0));
      liaison on: {liaison} with {laws};
      force side: on(p, value = m*(1 m/s^2)*(0.5*cos(3*time/(1 s)), 2, -1));
    initial
      p.position = (0.3, -0.2, 0.1) m;
      guess(p.velocity = {velocity} m/s);
      experiment(stop = 1 s, tolerance = 1e-11);
    end Point;
    """
LAWS = [
    "coulomb(0.3, mu_s = 0.45)",
    "stribeck(0.2, mu_s = 0.4, v_s = 0.3 m/s)",
    "coulomb(0.2), viscous({c} N.s/m)",
    "viscous({c} N.s/m)",
]
PAIRS = {
    "plane": ("OnPlane(hill, p)", "point_surface(p, plane)"),
    "line": ("OnLine(hill, p)", "lineaire_annulaire(hill, p, axis = x)"),
    "curve": ("OnLine(hill, p)", "point_courbe(p, line)"),
}
STATE = [f"p.{what}.{k}" for what in ("position", "velocity") for k in "xyz"]


def ends(text: str) -> tuple[np.ndarray, list[float]]:
    """The last state of a scene, and the times of its events of `on`."""
    result = model(STATED + text).simulate()
    return np.array(last(result, *STATE)), [e.time for e in result.events if e.liaison == "on"]


@pytest.mark.parametrize("pair", PAIRS)
@pytest.mark.parametrize("laws", LAWS)
@pytest.mark.parametrize(
    ("slope", "axis", "velocity", "mass"),
    [
        (0.5, "y", (1, 0, 0), 1),
        (0.5, "y", (-1, 0, 0), 1e6),
        (-0.2, "(1, 2, 2)", (0.7, 0.4, 0), 1e-6),
        (-0.2, "(1, 2, 2)", (-0.7, -0.4, 0), 1),
        (0.1, "x", (0, 0, 0), 1),
    ],
)
def test_a_point_with_stated_relations_moves_as_in_the_liaison_of_the_catalogue(
    pair: str, laws: str, slope: float, axis: str, velocity: tuple[float, ...], mass: float
) -> None:
    """The relations are scaled and skew; friction acts across their force all the same."""
    filled = laws.format(c=0.4 * mass)
    made = [
        POINT.format(slope=slope, axis=axis, velocity=velocity, liaison=liaison, laws=filled)
        for liaison in PAIRS[pair]
    ]
    found, wanted = (ends(text.replace("m = 1 kg", f"m = {mass} kg")) for text in made)
    assert found[0] == pytest.approx(wanted[0], abs=2e-9)
    assert found[1] == pytest.approx(wanted[1], abs=1e-9)


TURNING = """
    model Turning
      body b: box(mass = {m} kg, size = (0.2, 0.3, 0.4) m);
      frame post on ground at (0.1, 0.2, 0.3) m;
      frame own on b at (0.1, 0.05, -0.2) m;
      liaison on: {liaison} with {laws};
    initial
      own.position = (0.1, 0.2, 0.3) m;
      b.orientation = (1, 0, 0, 0);
      b.angular_velocity = {spin} rad/s;
      experiment(stop = 0.6 s, tolerance = 1e-11);
    end Turning;
    """
TURNED = [f"b.angular_velocity.{k}" for k in "xyz"] + [f"b.orientation[{k}]" for k in (1, 2, 3, 4)]


@pytest.mark.parametrize(
    ("stated", "named", "spin"),
    [
        ("AtPoint(post, own)", "spherique(post, own)", (1, -2, 3)),
        ("AtPoint(post, own)", "spherique(post, own)", (-1, 2, -3)),
        ("Hinge(post, own)", "rotoide(post, own)", (0, 0, 2)),
        ("Hinge(post, own)", "rotoide(post, own)", (0, 0, -2)),
    ],
)
@pytest.mark.parametrize("mass", [1, 1e6, 1e-6])
@pytest.mark.parametrize(
    "laws", ["coulomb(0.3, radius = 2 cm)", "viscous({c} N.m.s)", "coulomb(0.2, radius = 8 cm)"]
)
def test_a_body_with_stated_relations_turns_as_in_the_liaison_of_the_catalogue(
    stated: str, named: str, spin: tuple[float, ...], mass: float, laws: str
) -> None:
    """Friction is a couple of mu*radius*norm(R), whatever the relations' scales."""
    filled = laws.format(c=0.02 * mass)
    made = [
        model(STATED + TURNING.format(liaison=x, laws=filled, spin=spin, m=mass))
        for x in (stated, named)
    ]
    found, wanted = (x.simulate() for x in made)
    assert last(found, *TURNED) == pytest.approx(last(wanted, *TURNED), abs=1e-8)
    times = [[e.time for e in x.events] for x in (found, wanted)]
    assert times[0] == pytest.approx(times[1], abs=1e-9)
