"""The start is the least change from the guesses, whatever the order of the text and the masses."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq

import frot

IMPLICIT = (
    "body {0}: solid(mass = 2*{m} kg, inertia = (0.04*{m}, 0.05*{m}, 0.06*{m}) kg.m^2);\n"
    "  surface s_{0} on {0}: implicit(x^2 + 2*y^2 + z^4/(1 m^2) - 0.1 m^2);"
)
EGG = "body {0}: ellipsoid(mass = 2*{m} kg, semi_axes = (0.3, 0.4, 0.2) m);"
HOOP = "body {0}: ring(mass = 2*{m} kg, radius = 0.3 m);"
PAIRS = {
    "egg": (EGG, IMPLICIT, "{0}.surface", "s_{0}"),
    "hoop": (HOOP, HOOP, "{0}.rim", "{0}.rim"),
}
# the order of the places, that of the bodies, the masses
WAYS = {"plain": (True, True, 1), "places": (False, True, 1), "bodies": (True, False, 1)}
WAYS["masses"] = (True, True, 1e6)


def text() -> str:
    declared, stated = [], []
    for pair, (first, second, one, other) in PAIRS.items():
        for way, (forth, before, mass) in WAYS.items():
            p, q = f"p_{pair}_{way}", f"q_{pair}_{way}"
            bodies = [first.format(p, m=mass), second.format(q, m=mass)]
            places = [one.format(p), other.format(q)]
            declared += bodies if before else bodies[::-1]
            a, b = places if forth else places[::-1]
            touching = f"contact_ponctuel({a}, {b}, unilateral = false)"
            declared.append(f"liaison L_{pair}_{way}: {touching};")
            stated.append(
                f"guess({p}.orientation = (0.9, 0.1, 0.2, -0.3), "
                f"{q}.orientation = (0.7, 0.3, 0.5, 0.4), {q}.position = (0.3, 0.4, 0.9) m);"
            )
    declared.append("body point: particle(mass = 3 kg);")
    declared.append("surface bowl on ground: implicit(x^2 + y^2/4 + z^2/9 - 1 m^2);")
    declared.append("liaison on_bowl: point_surface(point, bowl);")
    stated.append("guess(point.position = (1.5, 2.5, -2) m);")
    return "\n  ".join(["model Starts", *declared, "initial", *stated, "end Starts;"])


@pytest.fixture(scope="module")
def start() -> frot.Result:
    return frot.compile(text()).simulate(stop=1e-9)


@pytest.mark.parametrize("pair", PAIRS)
@pytest.mark.parametrize("way", ["places", "bodies", "masses"])
def test_it_does_not_depend_on(start: frot.Result, pair: str, way: str) -> None:
    names = [*(f"position.{c}" for c in "xyz"), *(f"orientation[{k}]" for k in range(1, 5))]
    for body in "pq":
        for name in names:
            want = start[f"{body}_{pair}_plain.{name}"][0]
            assert start[f"{body}_{pair}_{way}.{name}"][0] == pytest.approx(want, abs=3e-9), name
    assert abs(start[f"q_{pair}_plain.position.z"][0] - 0.9) > 0.05  # something was to be moved


def test_a_point_comes_to_the_nearest_place_of_its_surface(start: frot.Result) -> None:
    """x0 = x + t grad F: x = x0/(1 + t/a^2), the root t of F = 0 that is the largest."""
    guess, squares = np.array([1.5, 2.5, -2]), np.array([1, 4, 9])

    def nearest(t: float) -> np.ndarray:
        return guess / (1 + t / squares)

    t = brentq(lambda t: (nearest(t) ** 2 / squares).sum() - 1, 0, 100, xtol=1e-14)
    got = np.array([start[f"point.position.{c}"][0] for c in "xyz"])
    assert got == pytest.approx(nearest(t), abs=1e-9)
