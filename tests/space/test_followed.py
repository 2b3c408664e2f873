"""Figures without a closed form that touch, both on moving bodies: Newton-Euler, both orders.

Where they touch is found here once more, by least squares between points of both figures.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest
from scipy.optimize import least_squares

import frot
from tests.space.newton_euler import Body, Link, Place, axes, orientation, residual, vector

TIMES = (0.0, 0.11, 0.3)
BOTH_ORDERS = ("two_rims",)
Points = Callable[[np.ndarray, np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Figure:
    """A body with a figure: its text, its place, its inertia, its points and their parameters."""

    shape: str
    place: str
    moments: tuple[float, float, float]
    points: Points
    curve: bool = False
    before: str = ""
    bounds: tuple[tuple[float, float], tuple[float, float]] = ((0, 2 * np.pi), (-1.57, 1.57))


def _egg(a: float, b: float, c: float) -> Points:
    return lambda u, v: np.array(
        [a * np.cos(u) * np.cos(v), b * np.sin(u) * np.cos(v), c * np.sin(v)]
    )


def _sheet(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    return np.array([u, v, 0.2 * u**2 + 0.1 * v**2 + 0.05 * u * v])


def _thread(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    return np.array([u, 0.3 * u**2 + 0 * v, 0.2 * np.sin(u)])


BOX = "box(mass = 2*m, size = (0.4, 0.2, 0.3) m)"
MOMENTS = tuple(2 / 12 * (x**2 + y**2) for x, y in ((0.2, 0.3), (0.3, 0.4), (0.4, 0.2)))
FIGURES = {
    "egg": Figure(
        "ellipsoid(mass = 2*m, semi_axes = (0.3, 0.4, 0.2) m)",
        "{0}.surface",
        tuple(0.4 * x for x in (0.16 + 0.04, 0.09 + 0.04, 0.09 + 0.16)),
        _egg(0.3, 0.4, 0.2),
    ),
    "level": Figure(
        BOX,
        "s_{0}",
        MOMENTS,
        _egg(0.5, 0.4, 0.6),
        before="surface s_{0} on {0}: implicit(4*x^2 + y^2/0.16 + z^2/0.36 - 1 m^2);",
    ),
    "bowl": Figure(
        BOX,
        "s_{0}",
        MOMENTS,
        _egg(1.5, 1.4, 1.6),
        before="surface s_{0} on {0}: implicit(x^2/2.25 + y^2/1.96 + z^2/2.56 - 1 m^2);",
    ),
    "hoop": Figure(
        "ring(mass = 2*m, radius = 0.3 m)",
        "{0}.rim",
        (0.09, 0.09, 0.18),
        lambda u, v: np.array([0.3 * np.cos(u), 0.3 * np.sin(u), 0 * u]),
        True,
    ),
    "lamina": Figure(
        "ellipse(mass = 2*m, a = 0.4 m, b = 0.3 m)",
        "{0}.rim",
        (0.5 * 0.09, 0.5 * 0.16, 0.5 * 0.25),
        lambda u, v: np.array([0.4 * np.cos(u), 0.3 * np.sin(u), 0 * u]),
        True,
    ),
    "can": Figure(
        "cylinder(mass = 2*m, radius = 0.2 m, length = 1 m)",
        "{0}.side",
        (2 * (0.01 + 1 / 12), 2 * (0.01 + 1 / 12), 0.04),
        lambda u, v: np.array([0.2 * np.cos(u), 0.2 * np.sin(u), v]),
    ),
    "ball": Figure(
        "sphere(mass = 2*m, radius = 0.3 m)",
        "{0}.surface",
        (0.072,) * 3,
        _egg(0.3, 0.3, 0.3),
    ),
    "rod": Figure(
        BOX,
        "c_{0}",
        MOMENTS,
        lambda u, v: np.array([u - 3, 0 * u, 0 * u]),
        True,
        before="curve c_{0} on {0}: line(through = (0, 0, 0) m, direction = (1, 0, 0));",
    ),
    "thread": Figure(
        BOX,
        "c_{0}",
        MOMENTS,
        _thread,
        True,
        before="curve c_{0} on {0}: parametric((1 m*u, 0.3 m*u^2, 0.2 m*sin(u)), u = (-2, 2));",
        bounds=((-2, 2), (0, 1)),
    ),
    "sheet": Figure(
        BOX,
        "s_{0}",
        MOMENTS,
        _sheet,
        before="surface s_{0} on {0}: parametric((1 m*u, 1 m*v, 0.2 m*u^2 + 0.1 m*v^2 "
        "+ 0.05 m*u*v), u = (-2, 2), v = (-2, 2));",
        bounds=((-2, 2), (-2, 2)),
    ),
}
FIGURES["point"] = Figure(
    BOX,
    "p_{0}",
    MOMENTS,
    lambda u, v: np.array([0.1, -0.1, 0.15])[:, None] + 0 * u,
    True,
    before="frame p_{0} on {0} at (0.1, -0.1, 0.15) m;",
)
DOME = Figure(
    BOX,
    "s_{0}",
    MOMENTS,
    lambda u, v: np.array([u, v, -0.3 * u**2 - 0.4 * v**2]),
    before="surface s_{0} on {0}: parametric((1 m*u, 1 m*v, -0.3 m*u^2 - 0.4 m*v^2), "
    "u = (-2, 2), v = (-2, 2));",
    bounds=((-2, 2), (-2, 2)),
)
FIGURES["dome"] = DOME
CONTACT = "contact_ponctuel({0}, {1}, unilateral = false)"
ROLLING = "roulement({0}, {1})"
# two figures, what joins them, where the second begins from the first
CASES = {
    "egg_in_bowl": ("bowl", "egg", CONTACT, (0.1, 0.2, -1.2)),
    "two_rims": ("hoop", "hoop", CONTACT, (0.3, 0.2, 0.05)),
    "point_on_sheet": ("sheet", "point", "point_surface({1}, {0})", (0.1, 0.2, 0.1)),
    "tangent_curves": ("hoop", "thread", "courbe_courbe({0}, {1})", (0.2, 0.3, 0.1)),
    "rolling_rim": ("can", "hoop", ROLLING, (0.4, 0.2, 0.1)),
}


def orders(name: str) -> tuple[str, ...]:
    """Which orders of the two places are looked at."""
    return ("ab", "ba") if name in BOTH_ORDERS else ("ab",)


def text(cases: list[str]) -> str:
    """All cases in one text, some of them twice: with their places exchanged too."""
    declared, stated = [], []
    for name in cases:
        first, second, liaison, apart = CASES[name]
        for order in orders(name):
            a, b = f"{name}_{order}_a", f"{name}_{order}_b"
            for body, key in ((a, first), (b, second)):
                figure = FIGURES[key]
                declared += [f"body {body}: {figure.shape};", figure.before.format(body)]
                upright = key == "dome"
                turn = "(0.9, 0.1, 0.2, -0.3)" if body == a or upright else "(0.7, 0.3, 0.5, 0.4)"
                stated.append(f"guess({body}.orientation = {turn});")
                spin = "(1, -2, 0.5)" if body == a else "(-0.5, 1, 1.5)"
                stated.append(f"guess({body}.angular_velocity = {spin} rad/s);")
            stated.append(f"guess({a}.position = (0, 0, 0) m, {b}.position = {apart} m);")
            stated.append(f"guess({b}.velocity = (0.3, 0.2, 0.1) m/s);")
            places = [FIGURES[first].place.format(a), FIGURES[second].place.format(b)]
            if order == "ba" and liaison in (CONTACT, ROLLING):
                places.reverse()
            declared.append(f"liaison L_{name}_{order}: {liaison.format(*places)};")
            declared.append(f"output Force f_{name}_{order} = L_{name}_{order}.force.x;")
    return "\n  ".join(
        [
            'model Followed "Pairs of bodies, each with a contact"',
            "parameter Mass m = 1 kg;",
            *declared,
            "initial",
            *stated,
            "experiment(stop = 0.3 s, tolerance = 1e-11);\nend Followed;\n",
        ]
    )


def touching(at: object, ends: list[tuple[str, str]]) -> np.ndarray:
    """The place where two figures meet, from their postures."""

    def points(end: tuple[str, str], s: np.ndarray, t: np.ndarray) -> np.ndarray:
        body, key = end
        turned = axes(orientation(at, body)) @ FIGURES[key].points(s, t)
        return vector(at, f"{body}.position")[:, None] + turned

    grids = []
    for _, key in ends:
        (low, high), (left, right) = FIGURES[key].bounds
        u = np.linspace(low, high, 60)
        v = np.zeros(1) if FIGURES[key].curve else np.linspace(left, right, 40)
        grids.append([x.ravel() for x in np.meshgrid(u, v)])
    first, second = (points(end, *g) for end, g in zip(ends, grids, strict=True))
    apart = ((first[:, :, None] - second[:, None, :]) ** 2).sum(axis=0)
    i, j = np.unravel_index(apart.argmin(), apart.shape)
    start = np.array([*(x[i] for x in grids[0]), *(x[j] for x in grids[1])])

    def off(x: np.ndarray) -> np.ndarray:
        return (points(ends[0], x[:1], x[1:2]) - points(ends[1], x[2:3], x[3:]))[:, 0]

    found = least_squares(off, start, xtol=1e-15, ftol=1e-15, gtol=1e-15).x
    assert np.abs(off(found)).max() < 1e-7
    return points(ends[1], found[2:3], found[3:])[:, 0]


@pytest.fixture(scope="module")
def model() -> frot.Model:
    return frot.compile(text(list(CASES)))


def test_every_pair_of_moving_figures_obeys_newton_and_euler(model: frot.Model) -> None:
    result = model.simulate()
    for name, (first, second, liaison, _) in CASES.items():
        for order in orders(name):
            ends = [(f"{name}_{order}_a", first), (f"{name}_{order}_b", second)]
            bodies = [Body(body, 2, FIGURES[key].moments) for body, key in ends]
            acting = lambda at, ends=ends: touching(at, ends)  # noqa: E731
            places = [Place(body, (0, 0, 0)) for body, _ in ends]
            if order == "ba" or "({1}" in liaison:
                places.reverse()
            link = Link(f"L_{name}_{order}", *places, acting)
            assert residual(result, bodies, [link], TIMES) < 1e-6, (name, order)
            assert np.abs(result[f"L_{name}_{order}.gap"]).max() < 1e-12, name
            if liaison is ROLLING:
                slips = [result[f"L_{name}_{order}.slip.{axis}"] for axis in "xyz"]
                assert np.abs(slips).max() < 1e-11, name
        for axis in "xyz" if name in BOTH_ORDERS else "":
            one, other = (result[f"{name}_{order}_b.position.{axis}"] for order in ("ab", "ba"))
            assert np.abs(one - other).max() < 1e-9, name
    energy = result["energy.kinetic"] + result["energy.potential"]
    assert np.ptp(energy) < 1e-8
