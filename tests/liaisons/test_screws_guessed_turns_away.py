"""A body on a screw that is guessed where everything holds, many turns away: it starts there."""

from __future__ import annotations

import functools
import math

import numpy as np
import pytest

import frot


@functools.cache
def screws(bodies: int) -> frot.Model:
    """One screw after the other, each on the body before, at guesses that are parameters."""
    lines = ["model Screws", "  world(gravity = 0 m/s^2);"]
    guesses = []
    for k in range(bodies):
        before = f"b{k - 1}.G" if k else "ground.origin"
        lines += [
            f"  parameter Length r{k}[3] = (0, 0, 0) m;",
            f"  parameter Real o{k}[4] = (1, 0, 0, 0);",
            f"  body b{k}: solid(mass = 1 kg, inertia = (1, 2, 3) kg.m^2);",
            f"  liaison S{k}: helicoidale({before}, b{k}.G, pitch = 0.17 m,",
            f"    axis = (1, 2, {k - 1}));",
        ]
        guesses.append(f"  guess(b{k}.position = r{k}, b{k}.orientation = o{k});")
    lines += ["initial", *guesses, "  experiment(stop = 0.001 s);", "end Screws;"]
    return frot.compile("\n".join(lines))


def turned(axis: np.ndarray, angle: float) -> np.ndarray:
    return np.concatenate(([math.cos(angle / 2)], math.sin(angle / 2) * axis))


def product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    scalar = a[0] * b[0] - a[1:] @ b[1:]
    return np.concatenate(([scalar], a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:])))


def matrix(q: np.ndarray) -> np.ndarray:
    w, v = q[0], q[1:]
    cross = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    return np.eye(3) + 2 * w * cross + 2 * cross @ cross


@pytest.mark.parametrize("bodies", [1, 2])
@pytest.mark.parametrize("turns", [(0.2, -0.3), (5.4, 3.1), (-30.45, 12.6), (400.1, -77.7)])
def test_it_starts_on_the_turn_that_is_guessed(bodies: int, turns: tuple[float, float]) -> None:
    """The advance tells the turns that the orientation does not."""
    place, attitude = np.zeros(3), np.array([1.0, 0, 0, 0])
    given, places = {}, []
    for k in range(bodies):
        axis = np.array([1.0, 2.0, k - 1.0]) / math.sqrt(5 + (k - 1) ** 2)
        place = place + matrix(attitude) @ (0.17 * turns[k] * axis)
        attitude = product(attitude, turned(axis, 2 * math.pi * turns[k]))
        given |= {f"r{k}": place, f"o{k}": attitude}
        places.append(place)
    result = screws(bodies).simulate(parameters=given)
    for k in range(bodies):
        assert result[f"S{k}.angle"][0] == pytest.approx(2 * math.pi * turns[k], rel=1e-12)
        start = [result[f"b{k}.position.{x}"][0] for x in "xyz"]
        assert start == pytest.approx(list(places[k]), abs=1e-12 * (1 + abs(turns[k])))
