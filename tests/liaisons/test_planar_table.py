"""Each liaison of the plane: on a base and on moving bodies, upside down, driven, anywhere.

All stand on a base that parameters turn, move and push; weights are forces that turn with it, so
that one text tells the motion from everywhere. Newton-Euler residuals come from the results alone.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np
import pytest
from frot.dsl.catalogue import LIAISONS

import frot

TIMES = (0.0, 0.17, 0.43, 0.8)
BOX = "box(mass = {m} kg, size = (0.3, 0.5) m)"
DISC = "disc(mass = {m} kg, radius = 0.3 m)"
INERTIA = {BOX: (0.09 + 0.25) / 12, DISC: 0.045}  # for each kg


@dataclass(frozen=True)
class Row:
    """A liaison on the base, and one of q on p: what is declared, and how it is written.

    `relations`: of one of them. `start`: what is stated of each body, its angle, x or y on the
    base; `stated` of the liaisons.
    `back`: with a and b exchanged, where that may be. `through`: the point through which the
    reaction on the second body passes, None where it is the place b.
    """

    on_base: str
    on_p: str
    relations: int
    start: str
    shape: str = BOX
    declared: str = ""
    back: tuple[str, str] | None = None
    through: Callable[[Mapping[str, float], str], np.ndarray] | None = None
    driven: str = ""
    stated: str = ""


def joint(kind: str, relations: int, start: str, options: str = "", driven: str = "") -> Row:
    """A liaison of two points."""
    return Row(
        f"{kind}(f0, g_@{options})",
        f"{kind}(h_@, k_@{options})",
        relations,
        start,
        back=(f"{kind}(g_@, f0{options})", f"{kind}(k_@, h_@{options})"),
        driven=driven,
    )


def on_curve(curve: str, u: str, driven: str = "") -> Row:
    """A point on a curve of the base, and one on the same curve of p."""
    declared = f"curve c_@ on base: {curve}; curve d_@ on p_@: {curve};"
    stated = f"A_@.u = {u}; B_@.u = {u};"
    both = "point_courbe(g_@, c_@)", "point_courbe(k_@, d_@)"
    return Row(*both, 1, "a", BOX, declared, driven=driven, stated=stated)


def centre(at: Mapping[str, float], name: str) -> np.ndarray:
    """G of a body: what touches a disc without friction pushes through its centre."""
    return np.array([at[f"{name}.position.x"], at[f"{name}.position.y"]])


def between(at: Mapping[str, float], name: str) -> np.ndarray:
    """Where a disc touches what is under its centre, or the disc that it rolls on."""
    own = centre(at, name)
    if name.startswith("p"):
        return own - np.array([0, 0.3 * np.sign(own[1])])
    return (own + centre(at, "p" + name[1:])) / 2


OVAL = "curve c_@ on base: ellipse(a = 2 m, b = 1.5 m);"
OVAL += "curve d_@ on p_@: ellipse(a = 2 m, b = 1 m);"
ROWS: dict[str, Row] = {
    "encastrement": joint("encastrement", 3, ""),
    "rotoide": joint("rotoide", 2, "a", driven="angle = S"),
    "prismatique": joint("prismatique", 2, "x", ", axis = (1, 0.3)", "displacement = S*(1 m)"),
    "libre": joint("libre", 0, "axy", driven="x = S*(1 m), angle = S"),
    "tige": joint("tige", 1, "ax", ", length = 0.7 m", "length = 0.7 m + 0.2*S*(1 m)"),
    "fil": joint("fil", 1, "ax", ", length = 0.7 m, unilateral = false"),
    "point_courbe": on_curve(
        "line(through = (0.1, 0) m, direction = (1, 0.4))", "0.3 m", "u = S*(1 m)"
    ),
    "point_courbe on a circle": on_curve("circle(radius = 0.6 m)", "-1.2", "u = S"),
    "point_courbe on an ellipse": on_curve("ellipse(a = 0.8 m, b = 0.5 m)", "-1.2", "u = S"),
    "point_courbe on a path": on_curve(
        "parametric((1 m*u, 0.3 m*u^3 - 0.2 m*u), u = (-3, 3))", "0.4"
    ),
    "contact_ponctuel": Row(
        "contact_ponctuel(c_@, p_@.rim, unilateral = false)",
        "contact_ponctuel(d_@, q_@.rim, unilateral = false)",
        1,
        "ax",
        DISC,
        OVAL,
        ("contact_ponctuel(p_@.rim, c_@, false)", "contact_ponctuel(q_@.rim, d_@, false)"),
        through=centre,
    ),
    "courbe_courbe": Row(
        "courbe_courbe(c_@, p_@.rim)",
        "courbe_courbe(p_@.rim, q_@.rim)",
        1,
        "ax",
        DISC,
        OVAL,
        ("courbe_courbe(p_@.rim, c_@)", "courbe_courbe(q_@.rim, p_@.rim)"),
        through=centre,
    ),
    "roulement": Row(
        "roulement(floor, p_@.rim)",
        "roulement(p_@.rim, q_@.rim)",
        2,
        "ax",
        DISC,
        "",
        ("roulement(p_@.rim, floor)", "roulement(q_@.rim, p_@.rim)"),
        through=between,
    ),
}
KIND = {name: f"r{k}" for k, name in enumerate(ROWS)}  # as a name


def bodies(name: str, row: Row) -> str:
    """P and q with their places, their weights, and where they begin."""
    text = f"""
  body p_@: {row.shape.format(m=2)};
  body q_@: {row.shape.format(m=1)};
  frame g_@ on p_@ at (0.15, 0.1) m rotated(angle = -30 deg);
  frame h_@ on p_@ at (-0.15, 0.1) m rotated(angle = 10 deg);
  frame k_@ on q_@ at (0.1, 0.15) m rotated(angle = 40 deg);
  force wp_@: on(p_@, value = -2 kg*g*base.ey);
  force wq_@: on(q_@, value = -1 kg*g*base.ey);
  {row.declared}"""
    return text.replace("@", name)


PLACES = {"p": (0.4, -0.5, 0.2), "q": (0.7, -0.2, -0.3)}
"""X, y and angle of each body on the base: stated as far as they are free, else guessed."""


def starts(name: str, row: Row) -> str:
    """Where the bodies begin, and with which speeds."""
    text = ""
    for body, (x, y, angle) in PLACES.items():
        own = f"{body}_{name}"
        text += f"\n  guess({own}.position = base.position + {x} m*base.ex + ({y} m)*base.ey);"
        text += f"\n  guess({own}.angle = tilt + {angle}, {own}.velocity = base.velocity);"
        for axis, value in (("x", x), ("y", y)):
            if axis in row.start:
                text += f"\n  dot({own}.position - base.position, base.e{axis}) = {value} m;"
        text += f"\n  {own}.angle = tilt + {angle};" if "a" in row.start else ""
    return text + row.stated.replace("@", name)


def chain(name: str, row: Row, end: str = "") -> str:
    """Both liaisons, upside down with an `end` to the names; reactions that are read."""
    own = KIND[name] + end
    first, second = row.back if end and row.back else (row.on_base, row.on_p)
    liaisons = f"""
  liaison A_@: {first};
  liaison B_@: {second};
  output Force a_@ = A_@.force.x;
  output Force b_@ = B_@.force.x;""".replace("@", own)
    return bodies(own, row) + liaisons.replace("_@", f"_{own}").replace("@", own)


HEAD = """
  parameter Angle tilt = 0;
  parameter Length x = 0 m, y = 0 m;
  parameter Velocity u = 0 m/s, v = 0 m/s;
  parameter Acceleration g = 9.81 m/s^2;
  world(gravity = 0 m/s^2);
  frame base on ground at (x + u*time, y + v*time) rotated(angle = tilt);
  frame f0 on base at (0.1, 0.2) m rotated(angle = 20 deg);
  curve floor on base: line(through = (0, 0) m, direction = (1, 0));"""


@pytest.fixture(scope="module")
def chains() -> tuple[frot.Model, frot.Result]:
    parts, begins = [], []
    for name, row in ROWS.items():
        for end in ("", "b") if row.back else ("",):
            parts.append(chain(name, row, end))
            begins.append(starts(KIND[name] + end, row))
    text = f"""
planar model Chains{HEAD}{"".join(parts)}
initial{"".join(begins)}
  experiment(stop = 0.8 s, tolerance = 1e-12);
end Chains;
"""
    model = frot.compile(text)
    return model, model.simulate()


def place(at: Mapping[str, float], body: str, local: tuple[float, float]) -> np.ndarray:
    """Ground coordinates of a place of a body."""
    c, s = np.cos(at[f"{body}.angle"]), np.sin(at[f"{body}.angle"])
    return centre(at, body) + np.array([[c, -s], [s, c]]) @ local


def cross(a: np.ndarray, b: np.ndarray) -> float:
    return float(a[0] * b[1] - a[1] * b[0])


def residual(result: frot.Result, name: str, row: Row, pinned: bool = False) -> float:
    """Of p and q on the base at rest, in parts of the sizes of what acts; `pinned`: q on a pin."""
    p, q, worst = f"p_{KIND[name]}", f"q_{KIND[name]}", 0.0
    for t in TIMES:
        at = result.at(t)
        forces = []
        for liaison, body, local in (("A", p, (0.15, 0.1)), ("B", q, (0.1, 0.15))):
            full = f"{liaison}_{KIND[name]}"
            force = np.array([at[f"{full}.force.x"], at[f"{full}.force.y"]])
            there = place(at, body, local) if row.through is None else row.through(at, body)
            forces.append((force, there, at[f"{full}.torque"]))
        if name.startswith("point_courbe"):  # the body is the first place there
            signs = (-1, 1 if pinned else -1)
            forces = [(s * f, there, s * c) for s, (f, there, c) in zip(signs, forces, strict=True)]
        if name == "courbe_courbe":  # through the centres of both
            forces[1] = (forces[1][0], centre(at, q), forces[1][2])
        for body, mass, acting in ((p, 2, ((1, 0), (-1, 1))), (q, 1, ((1, 1),))):
            acceleration = np.array([at[f"{body}.acceleration.{c}"] for c in "xy"])
            force = mass * (np.array([0, -9.81]) - acceleration)
            couple = -mass * INERTIA[row.shape] * at[f"{body}.angular_acceleration"]
            size = mass * 9.81 + np.abs(force).max()
            for sign, k in acting:
                own, there, torque = forces[k]
                force = force + sign * own
                couple += sign * (cross(there - centre(at, body), own) + torque)
                size += np.abs(own).max()
            worst = max(worst, np.abs(force).max() / size, abs(couple) / size)
    return worst


@pytest.mark.parametrize("name", [x for x in ROWS if x != "libre"])
def test_its_reaction_is_that_of_newton_and_euler(
    chains: tuple[frot.Model, frot.Result], name: str
) -> None:
    _, result = chains
    assert residual(result, name, ROWS[name]) < 1e-10
    if name != "encastrement":
        assert np.ptp(result[f"q_{KIND[name]}.position.y"]) > 0.01  # it does move


@pytest.mark.parametrize("name", [x for x, row in ROWS.items() if row.back])
def test_upside_down_it_moves_alike_and_reacts_the_other_way(
    chains: tuple[frot.Model, frot.Result], name: str
) -> None:
    _, result = chains
    own = KIND[name]
    for variable in ("position.x", "position.y", "angle"):
        for body in "pq":
            apart = result[f"{body}_{own}.{variable}"] - result[f"{body}_{own}b.{variable}"]
            assert np.abs(apart).max() < 1e-10
    if name != "libre":
        assert np.abs(result[f"b_{own}"] + result[f"b_{own}b"]).max() < 1e-8


def test_perfect_liaisons_do_no_work(chains: tuple[frot.Model, frot.Result]) -> None:
    _, result = chains
    heights = [
        m * 9.81 * result[f"{b}_{KIND[name]}{end}.position.y"]
        for name, row in ROWS.items()
        for end in (("", "b") if row.back else ("",))
        for b, m in (("p", 2), ("q", 1))
    ]
    energy = result["energy.kinetic"] + sum(heights)
    assert np.ptp(energy) < 1e-10 * np.abs(result["energy.kinetic"]).max()


PLACED = ({"tilt": 0.7}, {"x": 3.0, "y": -2.0}, {"u": 2.0, "v": -1.0})
PLACED += ({"tilt": -0.9, "u": -4.0, "v": 0.5},)


@pytest.mark.parametrize("given", PLACED)
def test_turned_moved_and_gliding_they_move_alike(
    chains: tuple[frot.Model, frot.Result], given: dict[str, float]
) -> None:
    model, still = chains
    result = model.simulate(parameters=given)
    angle = given.get("tilt", 0.0)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    way = np.array([[given.get(c, 0.0)] for c in "xy"])
    way = way + np.array([[given.get(c, 0.0)] for c in "uv"]) * result.time
    for name, own in KIND.items():
        for body in (f"p_{own}", f"q_{own}"):
            here, there = (places(r, body) for r in (still, result))
            assert np.abs(there - way - turn @ here).max() < 1e-10, name
            assert np.abs(result[f"{body}.angle"] - still[f"{body}.angle"] - angle).max() < 1e-10


def places(result: frot.Result, body: str) -> np.ndarray:
    """Of G at all times."""
    return np.array([result[f"{body}.position.{c}"] for c in "xy"])


def swing(t: float) -> float:
    return 0.3 * np.sin(3 * t) + 0.4 * t**2


SWING = "(0.3*sin(3*time/(1 s)) + 0.4*(time/(1 s))^2)"
"""The same written for the text."""


@pytest.fixture(scope="module")
def driven() -> frot.Result:
    parts, begins = [], []
    for name, row in ROWS.items():
        if row.driven:
            own = KIND[name]
            told = row.driven.replace("S", SWING)
            parts.append(bodies(own, row))
            text = f"liaison A_@: {row.on_base} driven({told}); liaison B_@: rotoide(h_@, k_@);"
            text += "output Force a_@ = A_@.force.x; output Force b_@ = B_@.force.x;"
            parts.append(text.replace("@", own))
            begins.append(starts(own, replace(row, start="", stated="")))
    return frot.compile(f"""
planar model Driven{HEAD}{"".join(parts)}
initial{"".join(begins)}
  experiment(stop = 0.8 s, tolerance = 1e-11);
end Driven;
""").simulate()


@pytest.mark.parametrize("name", [x for x, row in ROWS.items() if row.driven])
def test_driven_it_moves_as_told_with_the_reaction_of_its_drive(
    driven: frot.Result, name: str
) -> None:
    for told in ROWS[name].driven.split(", "):
        coordinate = told.split(" = ")[0]
        got = driven[f"A_{KIND[name]}.{coordinate}"]
        want = swing(driven.time)
        assert np.abs(got - (0.7 + 0.2 * want if name == "tige" else want)).max() < 1e-10
    assert residual(driven, name, ROWS[name], pinned=True) < 1e-10


def test_its_relations_are_counted_in_the_report() -> None:
    parts = (
        bodies(KIND[name], row) + f"\n  liaison A_@: {row.on_base};".replace("@", KIND[name])
        for name, row in ROWS.items()
    )
    report = frot.compile(f"planar model M{HEAD}{''.join(parts)}\nend M;").report()
    counted = {line.name: line.relations for line in report.liaisons}
    for name, row in ROWS.items():
        assert counted[f"A_{KIND[name]}"] == row.relations, name
    free = 6 * len(ROWS) - sum(row.relations for row in ROWS.values())
    assert report.mobility.degrees_of_freedom == free


def test_every_row_of_the_catalogue_that_has_a_meaning_in_the_plane_is_here() -> None:
    planar = {name for name, kind in LIAISONS.items() if kind.relations_planar is not None}
    assert planar - {name.split(" ")[0] for name in ROWS} == {"appui_faces"}
