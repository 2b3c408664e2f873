"""Curves without a closed form that touch in the plane: Newton-Euler, friction, closed forms.

Where they touch is found here once more, by least squares between points of both curves.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.optimize import least_squares

import frot

Points = Callable[[np.ndarray], np.ndarray]


def _round(a: float, b: float) -> Points:
    return lambda u: np.array([a * np.cos(u), b * np.sin(u)])


OVAL, DISC = _round(0.4, 0.2), _round(0.3, 0.3)
LAMINA = ("ellipse(mass = 2*m, a = 0.4 m, b = 0.2 m)", 2 * (0.16 + 0.04) / 4)
WHEEL = ("disc(mass = 2*m, radius = 0.3 m)", 0.09)
PLATE = ("solid(mass = 2*m, inertia = 0.5*m*(1 m^2))", 0.5)
TROUGH = "curve t_{0} on {0}: parametric((1 m*u, 0.2 m*u^2), u = (-3, 3));"
LOOP = "curve t_{0} on {0}: ellipse(a = 1.5 m, b = 1 m);"


def _trough(u: np.ndarray) -> np.ndarray:
    return np.array([u, 0.2 * u**2])


# shape and moment, what is declared, the place and its points of a; the same of b; b's start
CASES: dict[str, tuple[tuple[str, float], str, str, Points, tuple[str, float], str, Points, str]]
CASES = {
    "two_ovals": (LAMINA, "", "{0}.rim", OVAL, LAMINA, "{0}.rim", OVAL, "(0.5, 0.4)"),
    "oval_inside": (PLATE, LOOP, "t_{0}", _round(1.5, 1), LAMINA, "{0}.rim", OVAL, "(0.4, -0.6)"),
    "wheel_inside": (PLATE, LOOP, "t_{0}", _round(1.5, 1), WHEEL, "{0}.rim", DISC, "(0.4, -0.5)"),
    "wheel_on_oval": (LAMINA, "", "{0}.rim", OVAL, WHEEL, "{0}.rim", DISC, "(0.2, 0.5)"),
    "two_wheels": (WHEEL, "", "{0}.rim", DISC, WHEEL, "{0}.rim", DISC, "(0.2, 0.5)"),
    "oval_in_trough": (PLATE, TROUGH, "t_{0}", _trough, LAMINA, "{0}.rim", OVAL, "(0.3, 0.4)"),
    "wheel_in_trough": (PLATE, TROUGH, "t_{0}", _trough, WHEEL, "{0}.rim", DISC, "(0.3, 0.4)"),
}
LIAISONS = (
    "contact_ponctuel({0}, {1}, unilateral = false) with coulomb(0.3)",
    "roulement({1}, {0})",
    "courbe_courbe({0}, {1})",
)


def _text() -> str:
    lines, starts = [], []
    for name, (first, before, pa, _, second, pb, _, start) in CASES.items():
        for k, liaison in enumerate(LIAISONS):
            a, b = f"{name}_a{k}", f"{name}_b{k}"
            lines += [f"body {a}: {first[0]};", f"body {b}: {second[0]};", before.format(a)]
            places = pa.format(a), pb.format(b)
            lines.append(f"liaison L_{name}_{k}: {liaison.format(*places)};")
            lines.append(f"output Force f_{name}_{k} = L_{name}_{k}.force.x;")
            starts.append(f"guess({b}.position = {start} m, {a}.angle = 0.1, {b}.angle = 0.3);")
            starts.append(f"guess({a}.angular_velocity = 1 rad/s, {b}.velocity = (1, 0.2) m/s);")
    declared, stated = "\n  ".join(lines), "\n  ".join(starts)
    return f"""
planar model Touching "Pairs of bodies whose curves touch"
  parameter Mass m = 1 kg;
  {declared}
initial
  {stated}
  experiment(stop = 0.3 s, tolerance = 1e-11);
end Touching;
"""


def _place(at: object, ends: list[tuple[str, Points]]) -> np.ndarray:
    """Where two curves of bodies meet, from their postures."""

    def points(end: tuple[str, Points], u: np.ndarray) -> np.ndarray:
        body, own = end
        c, s = np.cos(at[f"{body}.angle"]), np.sin(at[f"{body}.angle"])
        centre = np.array([at[f"{body}.position.x"], at[f"{body}.position.y"]])
        return centre[:, None] + np.array([[c, -s], [s, c]]) @ own(u)

    grid = np.linspace(-3.2, 3.2, 500)
    first, second = (points(end, grid) for end in ends)
    apart = ((first[:, :, None] - second[:, None, :]) ** 2).sum(axis=0)
    i, j = np.unravel_index(apart.argmin(), apart.shape)

    def slope(end: tuple[str, Points], u: np.ndarray) -> np.ndarray:
        return (points(end, u + 1e-5) - points(end, u - 1e-5))[:, 0] / 2e-5

    def off(x: np.ndarray) -> np.ndarray:
        way = (points(ends[0], x[:1]) - points(ends[1], x[1:]))[:, 0]
        first, second = slope(ends[0], x[:1]), slope(ends[1], x[1:])
        return np.array([*way, first[0] * second[1] - first[1] * second[0]])

    found = least_squares(off, [grid[i], grid[j]], xtol=1e-15, ftol=1e-15, gtol=1e-15).x
    assert np.abs(off(found)).max() < 1e-7
    return points(ends[1], found[1:])[:, 0]


def _pair(at: object, name: str) -> np.ndarray:
    return np.array([at[f"{name}.x"], at[f"{name}.y"]])


def test_pairs_of_curves_obey_newton_and_euler_with_friction_and_without() -> None:
    result = frot.compile(_text()).simulate()
    for name, (first, _, _, one, second, _, other, _) in CASES.items():
        for k in range(len(LIAISONS)):
            a, b, joint = f"{name}_a{k}", f"{name}_b{k}", f"L_{name}_{k}"
            assert np.abs(result[f"{joint}.gap"]).max() < 1e-12, joint
            for t in (0.0, 0.13, 0.3):
                at = result.at(t)
                place = _place(at, [(a, one), (b, other)])
                force = _pair(at, f"{joint}.force") * (-1 if k == 1 else 1)
                for body, sign, moment in ((a, -1, first[1]), (b, 1, second[1])):
                    acceleration = _pair(at, f"{body}.acceleration") + np.array([0, 9.81])
                    off = 2 * acceleration - sign * force
                    arm = place - _pair(at, f"{body}.position")
                    couple = moment * at[f"{body}.angular_acceleration"]
                    couple -= sign * (arm[0] * force[1] - arm[1] * force[0])
                    size = 1 + np.abs(force).max()
                    assert max(np.abs(off).max(), abs(couple)) < 1e-7 * size, (joint, t)
                if k == 0 and abs(at[f"{joint}.slip"]) > 1e-3:
                    tangential, normal = (
                        at[f"{joint}.{n}_force"] for n in ("tangential", "normal")
                    )
                    assert abs(tangential) == pytest.approx(0.3 * abs(normal), rel=1e-9)
                    assert tangential * at[f"{joint}.slip"] <= 0
            if k == 1:
                assert np.abs(result[f"{joint}.slip"]).max() < 1e-11
