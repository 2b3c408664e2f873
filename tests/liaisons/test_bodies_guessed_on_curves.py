"""Bodies on curves of each other, guessed where all liaisons hold, start there.

The place on a curve is looked for; what counts its turns follows it and moves nothing else.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import frot

SCENE = """
model OnCurves
  world(gravity = 0 m/s^2);
  parameter Real x[2] = (0, 0);
  parameter Real y[2] = (0, 0);
  parameter Real a[2] = (0, 0);
  body b: box(mass = 0.6 kg, size = (0.3, 0.2, 0.1) m);
  liaison flat: appui_plan(ground, b);
  body c: rod(mass = 0.1 kg, length = 0.6 m);
  liaison other: appui_plan(ground, c);
  curve path on b: parametric((0.6 m*u, 0.3 m*u^2 - 0.2 m*sin(u), 0 m), u = (-9, 9));
  frame f on c at (0.32, 0.13, 0) m;
  liaison point: point_courbe(f, path);
initial
  guess(b.position = (x[1], y[1], 0)*(1 m));
  guess(b.orientation = (cos(a[1]/2), 0, 0, sin(a[1]/2)));
  guess(c.position = (x[2], y[2], 0)*(1 m));
  guess(c.orientation = (cos(a[2]/2), 0, 0, sin(a[2]/2)));
end OnCurves;
"""


@cache
def on_curves() -> frot.Model:
    return frot.compile(SCENE)


def rotated(angle: float, x: tuple[float, float]) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([c * x[0] - s * x[1], s * x[0] + c * x[1]])


@pytest.mark.parametrize("u", [1.8, -1.3, 2.6, 0.2])
@pytest.mark.parametrize("turned", [0.9, -2.8])
def test_they_start_where_they_are_guessed(u: float, turned: float) -> None:
    first, second = np.array([-0.02, -0.42]), 1.77
    on_path = (0.6 * u, 0.3 * u**2 - 0.2 * np.sin(u))
    at = first + rotated(turned, on_path) - rotated(second, (0.32, 0.13))
    parameters = {"x": [first[0], at[0]], "y": [first[1], at[1]], "a": [turned, second]}
    result = on_curves().simulate(stop=1e-6, parameters=parameters)
    found = [result[f"{body}.position.{x}"][0] for body in "bc" for x in "xyz"]
    assert np.allclose(found, [*first, 0, *at, 0], rtol=0, atol=1e-14)
    assert result["point.u"][0] == pytest.approx(u, abs=1e-13)


@cache
def on_a_helix() -> frot.Model:
    return frot.compile(
        "model OnAHelix parameter Real p[3] = (0, 0, 0); parameter Real o[4] = (1, 0, 0, 0);"
        "body b: ellipsoid(mass = 54 kg, semi_axes = (0.29 m, 0.23 m, 0.17 m));"
        "curve helix on ground: "
        "parametric((0.7 m*cos(u), 0.9 m*sin(u), 0.26 m*u), u = (-12, 12));"
        "frame f on b at (0.18, -0.17, 0.15) m; liaison point: point_courbe(f, helix);"
        "initial guess(b.position = (p[1], p[2], p[3])*(1 m));"
        "guess(b.orientation = (o[1], o[2], o[3], o[4])); end OnAHelix;"
    )


@pytest.mark.parametrize("u", [-4.6, 5.2, -9.0, 0.5])
def test_the_turn_of_a_helix_is_the_one_that_is_guessed(u: float) -> None:
    o = np.array([0.12, 0.27, 0.91, -0.29])
    o /= np.linalg.norm(o)
    arm, way = np.array([0.18, -0.17, 0.15]), o[1:]
    turned = arm + 2 * np.cross(way, np.cross(way, arm) + o[0] * arm)
    at = np.array([0.7 * np.cos(u), 0.9 * np.sin(u), 0.26 * u]) - turned
    parameters = {"p": [float(x) for x in at], "o": [float(x) for x in o]}
    result = on_a_helix().simulate(stop=1e-6, parameters=parameters)
    assert result["point.u"][0] == pytest.approx(u, abs=1e-13)
    found = [result[f"b.position.{x}"][0] for x in "xyz"]
    assert np.allclose(found, at, rtol=0, atol=1e-13)


@pytest.mark.parametrize("guess", [(-0.5, 0.6), (0.5, 0.6), (-0.9, 0.1)])
@pytest.mark.parametrize("space", [False, True])
def test_no_cusp_where_the_search_begins_stops_it(guess: tuple[float, float], space: bool) -> None:
    """The curve (u^3, u^2) has no tangent at u = 0; the place nearest to the guess has one."""
    kind, none = ("model", ", 0 m") if space else ("planar model", "")
    text = f"""
{kind} Cusp
  body b: particle(mass = 1 kg);
  curve c on ground: parametric((1 m*u^3, 1 m*u^2{none}), u = (-1, 1));
  liaison p: point_courbe(b, c);
initial
  guess(b.position = ({guess[0]} m, {guess[1]} m{none}));
  experiment(stop = 1 us);
end Cusp;"""
    u = np.linspace(-1, 1, 200001)
    nearest = u[np.argmin((u**3 - guess[0]) ** 2 + (u**2 - guess[1]) ** 2)]
    assert frot.compile(text).simulate()["p.u"][0] == pytest.approx(nearest, abs=1e-5)
