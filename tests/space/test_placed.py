"""Liaisons between points, curves and surfaces in space: Newton-Euler, what they keep, both orders.

Where figures touch is told here once more, by plain geometry.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest

import frot
from tests.space.newton_euler import Body, Link, Place, axes, box, orientation, residual, vector

TIMES = (0.0, 0.13, 0.4)
SHAPES = {
    "ball": ("sphere(mass = 2 kg, radius = 0.3 m)", (2 * 0.09 * 0.4,) * 3),
    "egg": (
        "ellipsoid(mass = 2 kg, semi_axes = (0.3, 0.4, 0.2) m)",
        tuple(0.4 * x for x in (0.16 + 0.04, 0.09 + 0.04, 0.09 + 0.16)),
    ),
    "lamina": (
        "ellipse(mass = 2 kg, a = 0.4 m, b = 0.3 m)",
        (0.5 * 0.09, 0.5 * 0.16, 0.5 * 0.25),
    ),
    "hoop": ("ring(mass = 2 kg, radius = 0.3 m)", (0.09, 0.09, 0.18)),
    "can": (
        "cylinder(mass = 2 kg, radius = 0.2 m, length = 4 m)",
        (2 * (0.01 + 16 / 12), 2 * (0.01 + 16 / 12), 0.04),
    ),
    "box": ("box(mass = 2 kg, size = (0.4, 0.2, 0.3) m)", box("", 2, (0.4, 0.2, 0.3)).moments),
}


@dataclass(frozen=True)
class Case:
    """A body of a shape, what holds it, where that acts, and how it starts."""

    shape: str
    before: str
    liaison: str
    touching: Callable[[object, str], np.ndarray]
    start: str = ""
    turn: str = "(0.7, 0.1, 0.5, 0.5)"


def centre(at: object, name: str) -> np.ndarray:
    """G of a body."""
    return vector(at, f"{name}.position")


def point(at: object, name: str) -> np.ndarray:
    """The point of a box on which its liaison acts."""
    return centre(at, name) + axes(orientation(at, name)) @ np.array([0.1, -0.1, 0.15])


def lowest(at: object, name: str, *semi_axes: float) -> np.ndarray:
    """The lowest point of an ellipsoid, flat or not."""
    turn = axes(orientation(at, name))
    spread = turn @ np.diag(np.square(semi_axes)) @ turn.T
    down = -spread[:, 2]
    return centre(at, name) + down / np.sqrt(spread[2, 2])


def nearest_of_axis(at: object, name: str) -> np.ndarray:
    """The point of a cylinder nearest to the ball of 0.5 m at (0, 0, -1)."""
    turn, middle = axes(orientation(at, name)), np.array([0, 0, -1.0])
    along = turn[:, 2] @ (middle - centre(at, name)) * turn[:, 2]
    across = centre(at, name) + along - middle
    return middle + across * 0.5 / np.linalg.norm(across)


def crossing(at: object, name: str) -> np.ndarray:
    """Where a cylinder lies across the one of 0.1 m along x."""
    first, second = np.array([1.0, 0, 0]), axes(orientation(at, name))[:, 2]
    both = np.cross(first, second)
    there, apart = np.linalg.solve(
        np.array([first, both / np.linalg.norm(both), -second]).T, centre(at, name)
    )[:2]
    return there * first + np.sign(apart) * 0.1 * both / np.linalg.norm(both)


P = "frame p_{0} on {0} at (0.1, -0.1, 0.15) m;"
CASES = {
    "ball_on_plane": Case(
        "ball",
        "",
        "contact_ponctuel(ground.plane, {0}.surface, unilateral = false)",
        lambda at, n: lowest(at, n, 0.3, 0.3, 0.3),
    ),
    "egg_on_plane": Case(
        "egg",
        "",
        "contact_ponctuel({0}.surface, ground.plane, unilateral = false)",
        lambda at, n: lowest(at, n, 0.3, 0.4, 0.2),
    ),
    "lamina_on_plane": Case(
        "lamina",
        "",
        "contact_ponctuel(ground.plane, {0}.rim, unilateral = false)",
        lambda at, n: lowest(at, n, 0.4, 0.3, 0),
    ),
    "ball_in_bowl": Case(
        "ball",
        "surface c_{0} on ground: sphere(radius = 2 m, centre = (0, 0, 1) m);",
        "contact_ponctuel(c_{0}, {0}.surface, unilateral = false)",
        lambda at, n: np.array([0, 0, 1]) + (centre(at, n) - [0, 0, 1]) * 2 / 1.7,
        "guess({0}.position = (0.5, 0.2, -0.5) m);",
    ),
    "can_on_ball": Case(
        "can",
        "surface c_{0} on ground: sphere(radius = 0.5 m, centre = (0, 0, -1) m);",
        "contact_ponctuel({0}.side, c_{0}, unilateral = false)",
        nearest_of_axis,
        "guess({0}.position = (0, 0.1, -0.2) m);",
    ),
    "can_on_can": Case(
        "can",
        "surface c_{0} on ground: cylinder(radius = 0.1 m, axis = x);",
        "contact_ponctuel(c_{0}, {0}.side, unilateral = false)",
        crossing,
        "guess({0}.position = (0.1, 0.3, 0.1) m);",
        "(1, 0, 0, 0)",
    ),
    "point_on_plane": Case("box", P, "point_surface(p_{0}, ground.plane)", point),
    "point_on_sphere": Case(
        "box",
        P + "surface c_{0} on ground: sphere(radius = 1 m);",
        "point_surface(p_{0}, c_{0})",
        point,
        "guess({0}.position = (0.2, 0.3, -1) m);",
    ),
    "point_on_cylinder": Case(
        "box",
        P + "surface c_{0} on ground: cylinder(radius = 1 m, axis = (0, 1, 0.1));",
        "point_surface(p_{0}, c_{0})",
        point,
        "guess({0}.position = (0.2, 0.3, -1) m);",
    ),
    "point_on_implicit": Case(
        "box",
        P + "surface c_{0} on ground: implicit(x^2 + 2*y^2 + z^4/(1 m^2) - 1 m^2);",
        "point_surface(p_{0}, c_{0})",
        point,
        "guess({0}.position = (0.5, 0.3, -0.7) m);",
    ),
    "point_on_line": Case(
        "box",
        P + "curve c_{0} on ground: line(through = (0, 1, 0) m, direction = (1, 0.2, -0.5));",
        "point_courbe(p_{0}, c_{0})",
        point,
    ),
    "point_on_circle": Case(
        "box",
        P + "curve c_{0} on ground: circle(radius = 1 m, normal = (0.3, 1, 0.2));",
        "point_courbe(p_{0}, c_{0})",
        point,
    ),
    "point_on_ellipse": Case(
        "box",
        P + "curve c_{0} on ground: ellipse(a = 1 m, b = 0.7 m, normal = y);",
        "point_courbe(p_{0}, c_{0})",
        point,
    ),
    "annular": Case("box", P, "lineaire_annulaire(ground, p_{0})", point),
    "line_on_plane": Case(
        "box",
        P + "curve c_{0} on p_{0}: line(through = (0, 0, 0) m, direction = (1, 0.2, 0));",
        "lineaire_rectiligne(c_{0}, ground.plane)",
        point,
    ),
    "rod": Case(
        "box",
        P,
        "tige(p_{0}, ground, length = 0.8 m)",
        point,
        "guess({0}.position = (0.4, 0.1, -0.6) m);",
    ),
    "can_on_plane": Case(
        "can",
        "",
        "contact_ponctuel(ground.plane, {0}.side, unilateral = false)",
        lambda at, n: centre(at, n) - [0, 0, 0.2],
        turn="(0.7, 0.65, 0.1, 0.1)",
    ),
    "rolling_can": Case(
        "can",
        "",
        "roulement({0}.side, ground.plane)",
        lambda at, n: centre(at, n) - [0, 0, 0.2],
        turn="(0.7, 0.65, 0.1, 0.1)",
    ),
    "corner": Case(
        "box",
        "",
        "point_surface({0}.corners[7], ground.plane)",
        lambda at, n: centre(at, n) + axes(orientation(at, n)) @ np.array([0.2, 0.1, 0.15]),
    ),
    "thread": Case(
        "box",
        P,
        "fil(ground, p_{0}, length = 0.8 m, unilateral = false)",
        point,
        "guess({0}.position = (0.4, 0.1, -0.6) m);",
    ),
    "rolling_ball": Case(
        "ball",
        "",
        "roulement(ground.plane, {0}.surface)",
        lambda at, n: lowest(at, n, 0.3, 0.3, 0.3),
    ),
    "rolling_hoop": Case(
        "hoop",
        "",
        "roulement({0}.rim, ground.plane)",
        lambda at, n: lowest(at, n, 0.3, 0.3, 0),
    ),
    "rolling_on_ball": Case(
        "ball",
        "surface c_{0} on ground: sphere(radius = 0.5 m, centre = (0, 0, -1) m);",
        "roulement(c_{0}, {0}.surface)",
        lambda at, n: np.array([0, 0, -1]) + (centre(at, n) - [0, 0, -1]) * 0.5 / 0.8,
        "guess({0}.position = (0.1, 0.1, -0.2) m);",
    ),
}


def compiled(names: list[str]) -> frot.Result:
    """All cases in one text."""
    lines = []
    starts = []
    for name in names:
        case = CASES[name]
        lines.append(f"body {name}: {SHAPES[case.shape][0]};")
        lines.append(case.before.format(name))
        lines.append(f"liaison L_{name}: {case.liaison.format(name)};")
        lines.append(f"output Force f_{name} = L_{name}.force.x;")
        starts.append(case.start.format(name))
        starts.append(f"guess({name}.orientation = {case.turn});")
        starts.append(f"guess({name}.angular_velocity = (1, -2, 3) rad/s);")
        starts.append(f"guess({name}.velocity = (0.3, 0.2, 0.1) m/s);")
    declared, stated = "\n  ".join(lines), "\n  ".join(starts)
    return frot.compile(
        f"""
model Placed "Bodies by themselves, each with a liaison"
  {declared}
initial
  {stated}
  experiment(stop = 0.4 s, tolerance = 1e-11);
end Placed;
"""
    ).simulate()


def test_every_liaison_of_figures_obeys_newton_and_euler() -> None:
    result = compiled(list(CASES))
    for name, case in CASES.items():
        body = Body(name, 2, SHAPES[case.shape][1])
        second = any(x in case.liaison.split(",")[1] for x in ("{0}.", "p_{0}"))
        acting = lambda at, name=name, case=case: case.touching(at, name)  # noqa: E731
        own, ground = Place(name, (0, 0, 0)), Place(None, (0, 0, 0))
        ends = (ground, own) if second else (own, ground)
        link = Link(f"L_{name}", *ends, acting)
        assert residual(result, [body], [link], TIMES) < 1e-10, name
        assert np.abs(result[f"L_{name}.gap"]).max() < 1e-12, name
        if "roulement" in case.liaison:
            for axis in "xyz":
                assert np.abs(result[f"L_{name}.slip.{axis}"]).max() < 1e-12
    energy = result["energy.kinetic"] + result["energy.potential"]
    assert np.ptp(energy) < 1e-8


def test_a_start_is_the_same_whatever_stands_beside_it() -> None:
    """Bit for bit; also beside a rim that has no place on its plane where its guess is not met."""
    names = ("lamina_on_plane", "can_on_plane", "rolling_hoop")
    beside = compiled([*names, "can_on_ball"])
    for name in names:
        alone = compiled([name])
        for of in ("position", *(f"orientation[{k}]" for k in range(1, 5))):
            for axis in (".x", ".y", ".z") if of == "position" else ("",):
                assert alone[f"{name}.{of}{axis}"][0] == beside[f"{name}.{of}{axis}"][0], name


def test_places_that_meet_by_more_than_one_relation_are_told() -> None:
    for liaison in ("b.axis, ground.plane", "ground.plane, c"):
        with pytest.raises(frot.FrotError, match="does not join these two places"):
            frot.compile(
                f"""
model Two "A rod on a plane, two planes"
  body b: rod(mass = 1 kg, length = 1 m);
  surface c on b: plane(through = (0, 0, 0) m, normal = z);
  liaison L: contact_ponctuel({liaison}, unilateral = false);
end Two;
"""
            ).report()


def test_corners_as_places_are_told() -> None:
    for liaison in ("spherique(ground, x.corners)", "tige(ground, x.corners, length = 1 m)"):
        with pytest.raises(frot.FrotError, match="E0205"):
            frot.compile(
                f"""
model Corners "A box"
  body x: box(mass = 1 kg, size = (1, 1, 1) m);
  liaison L: {liaison};
end Corners;
"""
            ).report()
