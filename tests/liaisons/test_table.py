"""Each liaison of the table: alone, on moving bodies, upside down, told twice, driven, in loops.

Few texts hold them all, so that each is compiled once. Newton-Euler residuals come from the results
alone (tests/space/newton_euler.py), where b stands from plain geometry (table.py).
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest
from frot.dsl.catalogue import LIAISONS

import frot
from tests.liaisons.table import JOINTS, turned, unit
from tests.space.newton_euler import Link, Place, axes, box, orientation, residual, vector
from tests.space.test_placed import CASES

TIMES = (0.0, 0.31, 0.77, 1.5)
FRAMES = """
  frame f0 on ground at (0.1, 0.2, 0.3) m rotated(axis = (1, 2, 3), angle = 20 deg);"""
F0 = (np.array([0.1, 0.2, 0.3]), turned(unit(1, 2, 3), np.radians(20)))
G = (np.array([0.15, 0.1, 0.35]), turned(unit(1, 0, 1), np.radians(-30)))
H = (np.array([-0.15, 0.1, -0.35]), turned(unit(1, 0, 0), np.radians(10)))
K = (np.array([0.2, 0.1, 0.1]), turned(unit(0, 0, 1), np.radians(40)))


def first(name: str) -> str:
    """A box with a place for each of two liaisons."""
    return f"""
  body p_{name}: box(mass = 2 kg, size = (0.3, 0.5, 0.7) m);
  frame g_{name} on p_{name} at (0.15, 0.1, 0.35) m rotated(axis = (1, 0, 1), angle = -30 deg);
  frame h_{name} on p_{name} at (-0.15, 0.1, -0.35) m rotated(axis = x, angle = 10 deg);"""


def second(name: str) -> str:
    """Another, with one."""
    return f"""
  body q_{name}: box(mass = 1 kg, size = (0.4, 0.2, 0.3) m);
  frame k_{name} on q_{name} at (0.2, 0.1, 0.1) m rotated(axis = z, angle = 40 deg);"""


def chain(kind: str) -> str:
    """Two boxes from the ground on, as told and with all places exchanged; one held twice."""
    row, back = JOINTS[kind], f"{kind}_back"
    return f"""{first(kind)}{second(kind)}{first(back)}{second(back)}{first(kind + "_twice")}
  liaison A_{kind}: {kind}(f0, g_{kind}{row.options});
  liaison B_{kind}: {kind}(h_{kind}, k_{kind}{row.options});
  liaison A_{back}: {kind}(g_{back}, f0{row.back});
  liaison B_{back}: {kind}(k_{back}, h_{back}{row.back});
  liaison A_{kind}_twice: {kind}(f0, g_{kind}_twice{row.options});
  liaison B_{kind}_twice: {kind}(f0, g_{kind}_twice{row.options});
  output Real a_{kind} = A_{kind}.force.x/(1 N);
  output Real b_{kind} = B_{kind}.torque.z/(1 N.m);
  output Force c_{kind} = B_{back}.force.x;"""


@pytest.fixture(scope="module")
def chains() -> frot.Result:
    parts = "".join(chain(kind) for kind in JOINTS)
    starts = "".join(
        f"  {x}_libre{end}.angular_velocity = (1, 2, -1) rad/s;\n"
        f"  {x}_libre{end}.velocity.x = 1 m/s;\n"
        for x, end in (("p", ""), ("p", "_back"), ("p", "_twice"), ("q", ""), ("q", "_back"))
    )
    return frot.compile(
        f"""
model Chains "Boxes in each liaison"{FRAMES}{parts}
initial
{starts}  experiment(stop = 1.5 s, tolerance = 1e-11);
end Chains;
"""
    ).simulate()


def coordinates(at: Mapping[str, float], liaison: str, names: tuple[str, ...]) -> dict[str, object]:
    """Those of a liaison, the orientation as four numbers."""
    return {
        n: orientation(at, liaison) if n == "orientation" else at[f"{liaison}.{n}"] for n in names
    }


def stands(at: Mapping[str, float], body: str, place: tuple[np.ndarray, np.ndarray]) -> tuple:
    """A place of a body in ground axes, and its own axes."""
    turn = axes(orientation(at, body))
    return vector(at, f"{body}.position") + turn @ place[0], turn @ place[1]


@pytest.mark.parametrize("kind", JOINTS)
def test_its_coordinates_tell_where_b_stands(chains: frot.Result, kind: str) -> None:
    """On the ground, on a moving body, and held twice: then the second closes a loop."""
    row = JOINTS[kind]
    for t in TIMES:
        at = chains.at(t)
        for liaison, a, b in (
            (f"A_{kind}", F0, stands(at, f"p_{kind}", G)),
            (f"B_{kind}", stands(at, f"p_{kind}", H), stands(at, f"q_{kind}", K)),
            (f"A_{kind}_twice", F0, stands(at, f"p_{kind}_twice", G)),
            (f"B_{kind}_twice", F0, stands(at, f"p_{kind}_twice", G)),
        ):
            place, turn = row.pose(coordinates(at, liaison, row.coordinates))  # type: ignore[arg-type]
            assert b[0] == pytest.approx(a[0] + a[1] @ place, abs=1e-11), liaison
            assert b[1] == pytest.approx(a[1] @ turn, abs=1e-11), liaison
    if kind != "encastrement":
        assert np.ptp(chains[f"q_{kind}.position.z"]) > 0.05  # it does move
        assert np.ptp(chains[f"p_{kind}_twice.position.z"]) > 0.01


@pytest.mark.parametrize("kind", JOINTS)
def test_its_reaction_is_that_of_newton_and_euler(chains: frot.Result, kind: str) -> None:
    p, q = f"p_{kind}", f"q_{kind}"
    bodies = [box(p, 2, (0.3, 0.5, 0.7)), box(q, 1, (0.4, 0.2, 0.3))]
    ground, g, h, k = (
        Place(None, (0.1, 0.2, 0.3)),
        Place(p, (0.15, 0.1, 0.35)),
        Place(p, (-0.15, 0.1, -0.35)),
        Place(q, (0.2, 0.1, 0.1)),
    )
    links = [Link(f"A_{kind}", ground, g), Link(f"B_{kind}", h, k)]
    assert residual(chains, bodies, links if kind != "libre" else [], TIMES) < 1e-11


@pytest.mark.parametrize("kind", JOINTS)
def test_upside_down_it_moves_alike_and_reacts_the_other_way(
    chains: frot.Result, kind: str
) -> None:
    for t in TIMES:
        at = chains.at(t)
        for name in ("position", "velocity", "angular_velocity"):
            one, other = vector(at, f"q_{kind}.{name}"), vector(at, f"q_{kind}_back.{name}")
            assert one == pytest.approx(other, rel=1e-10, abs=1e-10)
        if kind != "libre":
            one = at[f"B_{kind}.force.x"]
            assert at[f"c_{kind}"] == pytest.approx(-one, rel=1e-8, abs=1e-8)


def test_perfect_liaisons_do_no_work(chains: frot.Result) -> None:
    energy = chains["energy.kinetic"] + chains["energy.potential"]
    assert np.ptp(energy) < 1e-10 * np.abs(chains["energy.kinetic"]).max()


def swing(t: float) -> float:
    return 0.3 * np.sin(3 * t) + 0.4 * t**2


SWING = "(0.3*sin(3*time/(1 s)) + 0.4*(time/(1 s))^2)"


def value(coordinate: str, text: str) -> str:
    """A value of the coordinate's dimension."""
    return text if coordinate.startswith(("angle", "speed_angle")) else f"{text}*(1 m)"


def driven(kind: str) -> str:
    """All coordinates by time, a second box behind; one more driven once, twice in a loop."""
    row = JOINTS[kind]
    told = ", ".join(f"{c} = {value(c, SWING)}" for c in row.driven)
    return f"""{first(kind)}{second(kind)}
  liaison A_{kind}: {kind}(f0, g_{kind}{row.options}) driven({told});
  liaison B_{kind}: spherique(h_{kind}, k_{kind});
  liaison C_{kind}: {kind}(f0, g_{kind}{row.options}) driven({told});
  output Real a_{kind} = A_{kind}.force.x/(1 N) + B_{kind}.torque.z/(1 N.m);"""


@pytest.fixture(scope="module")
def told() -> frot.Result:
    parts = "".join(driven(kind) for kind in JOINTS if JOINTS[kind].driven)
    return frot.compile(
        f"""
model Driven "Each liaison driven"{FRAMES}{parts}
  experiment(stop = 1.5 s, tolerance = 1e-11);
end Driven;
"""
    ).simulate()


def test_what_is_told_twice_keeps_no_step_short(told: frot.Result) -> None:
    """Rows and gaps that cancel out are rounding, and so are their rates by time."""
    assert told.figures.steps < 400


@pytest.mark.parametrize("kind", [k for k, row in JOINTS.items() if row.driven])
def test_driven_it_moves_as_told_with_the_reaction_of_its_drive(
    told: frot.Result, kind: str
) -> None:
    row, p, q = JOINTS[kind], f"p_{kind}", f"q_{kind}"
    for t in TIMES:
        for name in row.driven:
            for liaison in "AC":
                got = told.at(t)[f"{liaison}_{kind}.{name}"]
                assert got == pytest.approx(swing(t), abs=1e-11)
    bodies = [box(p, 2, (0.3, 0.5, 0.7)), box(q, 1, (0.4, 0.2, 0.3))]
    links = [
        Link(f"A_{kind}", Place(None, (0.1, 0.2, 0.3)), Place(p, (0.15, 0.1, 0.35))),
        Link(f"B_{kind}", Place(p, (-0.15, 0.1, -0.35)), Place(q, (0.2, 0.1, 0.1))),
    ]
    assert residual(told, bodies, links, TIMES) < 1e-11


def servo(kind: str) -> str:
    """A coordinate follows a variable, and its speed one that switches."""
    row = JOINTS[kind]
    name = row.driven[0]
    text = f"""{first(kind)}
  liaison A_{kind}: {kind}(f0, g_{kind}{row.options}) driven({name} = {value(name, "x")});
  output Force a_{kind} = A_{kind}.force.x;"""
    for speed in row.speeds:
        own = f"{kind}_{speed}"
        rate = "1 1/s" if speed == "speed_angle" or "angle" in row.coordinates[:1] else "1 m/s"
        rate = "1 m/s" if speed == "speed" and "displacement" in row.coordinates else rate
        text += f"""{first(own)}
  liaison A_{own}: {kind}(f0, g_{own}{row.options})
    driven({speed} = (if time > 0.5 s then x + (time/(1 s) - 0.5)^2 else x)*({rate}));
  output Force a_{own} = A_{own}.force.x;"""
    return text


@pytest.fixture(scope="module")
def followed() -> frot.Result:
    parts = "".join(servo(kind) for kind in JOINTS if JOINTS[kind].driven)
    return frot.compile(
        f"""
model Followed "Each liaison driven by a variable of the text"{FRAMES}{parts}
  Real x;
  AngularVelocity w;
initial
  x = 0;
  w = 0.5 rad/s;
equation
  der(x) = w;
  der(w) = -4 1/s^2*x;
  experiment(stop = 1.5 s, tolerance = 1e-11);
end Followed;
"""
    ).simulate()


@pytest.mark.parametrize("kind", [k for k, row in JOINTS.items() if row.driven])
def test_driven_by_a_variable_or_by_a_speed_that_switches(followed: frot.Result, kind: str) -> None:
    """x = sin(2 t)/4; a speed x + (t - 1/2)^2 from t = 1/2 on."""
    row = JOINTS[kind]
    links = {kind: (row.driven[0], 0.25 * np.sin(2 * followed.time))}
    grown = np.maximum(followed.time - 0.5, 0) ** 3 / 3
    way = 0.125 * (1 - np.cos(2 * followed.time)) + grown
    for speed in row.speeds:
        slides = speed == "speed" and "displacement" in row.coordinates
        links[f"{kind}_{speed}"] = ("displacement" if slides else "angle", way)
    for own, (name, want) in links.items():
        assert np.abs(followed[f"A_{own}.{name}"] - want).max() < 1e-9, own
        ends = Place(None, (0.1, 0.2, 0.3)), Place(f"p_{own}", (0.15, 0.1, 0.35))
        bodies = [box(f"p_{own}", 2, (0.3, 0.5, 0.7))]
        assert residual(followed, bodies, [Link(f"A_{own}", *ends)], TIMES) < 1e-10, own


@pytest.mark.parametrize("kind", JOINTS)
def test_its_relations_are_counted_in_the_report(kind: str) -> None:
    row = JOINTS[kind]
    text = f"model M{FRAMES}{first('m')}\n liaison A: {kind}(f0, g_m{row.options});\nend M;"
    assert frot.compile(text).report().mobility.degrees_of_freedom == 6 - row.relations


def test_every_row_of_the_catalogue_is_in_a_table() -> None:
    """Those between figures are in tests/space/test_placed.py; faces stand on their corners."""
    placed = {case.liaison.split("(")[0] for case in CASES.values()}
    assert set(LIAISONS) - set(JOINTS) - placed <= {"appui_faces", "courbe_courbe"}
