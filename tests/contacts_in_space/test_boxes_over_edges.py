"""Boxes on faces that end: corners, and edges that cross, carry them over an edge and off."""

from __future__ import annotations

import math
import textwrap

import numpy as np
import pytest
from scipy.optimize import linprog

import frot

G = 9.81


def compiled(text: str) -> frot.Model:
    return frot.compile(textwrap.dedent(text))


PLANE = """
    planar model Table
      parameter Velocity v = 3 m/s;
      parameter Real mu = 0;
      parameter Mass m = 1 kg;
      body t: box(mass = m, size = (4 m, 1 m));
      body load: box(mass = m, size = (1 m, 1 m));
      liaison w: encastrement(ground, t);
      liaison on: appui_faces(load.bottom, t.top) with coulomb(mu);
    initial
      guess(t.position = (0, 0) m);
      load.position = (0, 1) m;
      load.velocity = (v, 0 m/s);
      experiment(stop = 1.3 s, tolerance = 1e-10);
    end Table;
    """

# The table leans by `tilt`, gravity with it; the load is turned by `yaw` about the normal.
SPACE = """
    model Table
      parameter Velocity v = 3 m/s;
      parameter Velocity w = 0 m/s;
      parameter AngularVelocity spin = 0 1/s;
      parameter Real mu = 0;
      parameter Mass m = 1 kg;
      parameter Angle tilt = 0;
      parameter Angle yaw = 0;
      world(gravity = 9.81 m/s^2, down = (-sin(tilt), 0, -cos(tilt)));
      frame f on ground at (1, 2, 3) m rotated(axis = y, angle = tilt);
      frame g on f at (0, 0.2, 1) m rotated(axis = z, angle = yaw);
      body t: box(mass = m, size = (4, 3, 1) m);
      body load: box(mass = m, size = (1, 1, 1) m);
      liaison weld: encastrement(f, t);
      liaison on: appui_faces({places}) with coulomb(mu);
    initial
      load.position = g.position;
      load.orientation = g.orientation;
      load.velocity = v*f.ex + w*f.ey;
      load.angular_velocity = spin*f.ez;
      experiment(stop = 1.3 s, tolerance = 1e-10);
    end Table;
    """


@pytest.fixture(scope="module")
def plane() -> frot.Model:
    return compiled(PLANE)


@pytest.fixture(scope="module")
def space() -> frot.Model:
    return compiled(SPACE.format(places="load.bottom, t.top"))


def instants(result: frot.Result) -> list[float]:
    found: list[float] = []
    for event in result.events:
        if not found or event.time - found[-1] > 1e-9:
            found.append(event.time)
    return found


@pytest.mark.parametrize(
    ("v", "mu", "tilt", "mass"),
    [(3, 0, 0, 1), (-4.1, 0, 0.9, 1e6), (4, 0.1, 0, 1e-6), (-3.3, 0.1, 2, 1)],
)
def test_a_box_slides_off_a_table_as_its_planar_twin(
    plane: frot.Model, space: frot.Model, v: float, mu: float, tilt: float, mass: float
) -> None:
    """Two edges of its bottom cross the edge of the table where the planar corner is."""
    given = {"v": f"{v} m/s", "mu": mu, "m": f"{mass} kg"}
    twin = plane.simulate(parameters=given)
    result = space.simulate(parameters=given | {"tilt": tilt})
    assert instants(result) == pytest.approx(instants(twin), abs=1e-9)
    times = np.linspace(0, 1.3, 27)
    one, other = twin.at(times), result.at(times)
    ex = np.array([math.cos(tilt), 0, -math.sin(tilt)])
    ez = np.array([math.sin(tilt), 0, math.cos(tilt)])
    way = np.array([other[f"load.position.{k}"] for k in "xyz"]).T - [1, 2, 3]
    assert way @ ex == pytest.approx(one["load.position.x"], abs=1e-8)
    assert way @ ez == pytest.approx(one["load.position.y"], abs=1e-8)
    assert way[:, 1] == pytest.approx(0.2, abs=1e-9)
    turn = np.array([other[f"load.angular_velocity.{k}"] for k in "xyz"])
    assert turn[1] == pytest.approx(-one["load.angular_velocity"], abs=1e-7)


def axes(q: np.ndarray) -> np.ndarray:
    w, (x, y, z) = q[0], q[1:]
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + 2 * w * skew + 2 * skew @ skew


def depth(centre: np.ndarray, turn: np.ndarray, tilt: float) -> float:
    """How deep the solids are in each other: the largest common distance from all faces."""
    c, s = math.cos(tilt), math.sin(tilt)
    table = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    rows, bounds = [], []
    for frame, middle, halves in ((table, np.array([1, 2, 3]), (2, 1.5, 0.5)),
                                  (turn, centre, (0.5, 0.5, 0.5))):  # fmt: skip
        for k in range(3):
            for sign in (1, -1):
                normal = sign * frame[:, k]
                rows.append([*normal, 1])
                bounds.append(halves[k] + normal @ middle)
    found = linprog([0, 0, 0, -1], rows, bounds, bounds=[(None, None)] * 4, method="highs",
                    options={"primal_feasibility_tolerance": 1e-10,
                             "dual_feasibility_tolerance": 1e-10})  # fmt: skip
    return float(found.x[3])


@pytest.mark.parametrize(
    ("given", "until"),
    [
        ({"yaw": 0.5}, 0.9),
        ({"yaw": 1.1, "w": "1 m/s"}, 0.9),
        ({"yaw": 0.3, "spin": "2 1/s", "v": "4 m/s"}, 0.75),
        ({"yaw": 0.7, "tilt": 0.6, "spin": "0.5 1/s"}, 0.9),
        ({"yaw": -0.4, "w": "-3.3 m/s", "v": "2.6 m/s"}, 0.8),
        ({"yaw": math.pi / 4, "m": "1e5 kg"}, 0.9),
    ],
)
def test_a_box_that_stands_askew_neither_enters_the_table_nor_loses_energy(
    space: frot.Model, given: dict[str, object], until: float
) -> None:
    """Smooth contacts keep the energy, push, and act only where the solids touch."""
    result = space.simulate(parameters=given)
    mass = float(str(given.get("m", "1 kg")).split()[0])
    tilt = float(str(given.get("tilt", 0)))
    down = np.array([-math.sin(tilt), 0, -math.cos(tilt)])
    times = np.linspace(0, until, 91)
    there = result.at(times)
    energies = []
    for k in range(len(times)):
        centre = np.array([there[f"load.position.{c}"][k] for c in "xyz"])
        turn = axes(np.array([there[f"load.orientation[{c}]"][k] for c in (1, 2, 3, 4)]))
        deep, load = depth(centre, turn, tilt), there["on.normal_force"][k]
        assert deep < 1e-8
        assert load >= 0
        if load > 1e-9 * mass:
            assert deep > -1e-8
        energies.append(there["load.kinetic_energy"][k] - mass * G * centre @ down)
        step = 1e-5
        if k > 0 and all(abs(times[k] - e.time) > 2 * step for e in result.events):
            before, after = result.at(times[k] - step), result.at(times[k] + step)
            rate = np.array([after[f"load.velocity.{c}"] - before[f"load.velocity.{c}"]
                             for c in "xyz"]) / (2 * step)  # fmt: skip
            force = np.array([there[f"on.force.{c}"][k] for c in "xyz"])
            assert mass * (rate - G * down) == pytest.approx(-force, abs=2e-4 * mass)
    assert np.ptp(energies) < 1e-8 * abs(energies[0])
    assert len(instants(result)) >= 4


def test_the_faces_in_the_other_order_and_the_sides_of_a_box(space: frot.Model) -> None:
    other = compiled(SPACE.format(places="t.top, load.bottom"))
    one = space.simulate(parameters={"yaw": 0.5})
    two = other.simulate(parameters={"yaw": 0.5})
    assert instants(two) == pytest.approx(instants(one), abs=1e-9)
    assert two["load.position.z"][-1] == pytest.approx(one["load.position.z"][-1], abs=1e-8)
    assert two["on.force.z"][0] == pytest.approx(-one["on.force.z"][0], rel=1e-12)


STACK = """
    model Stack
      parameter Real foot = 0.3;
      parameter Velocity v = 0.4 m/s;
      parameter Angle yaw = 0;
      frame h on ground at (0, 0, 0.15) m rotated(axis = z, angle = yaw);
      frame l on ground at (0, 0, 0.05) m rotated(axis = z, angle = yaw);
      body low: box(mass = 50 g, size = (0.2, 0.4, 0.1) m);
      body load: box(mass = 50 g, size = (0.2, 0.3, 0.1) m);
      liaison feet: appui_faces(low.bottom, ground.plane) with coulomb(foot);
      liaison on: appui_faces(load.bottom, low.top);
    initial
      low.position = l.position;
      low.orientation = l.orientation;
      load.position = h.position;
      load.orientation = h.orientation;
      load.velocity = v*h.ex;
      experiment(stop = 0.6 s, tolerance = 1e-9);
    end Stack;
    """


@pytest.mark.parametrize("yaw", [0.0, 0.8])
def test_what_rests_below_does_not_creep_while_a_box_slides_off(yaw: float) -> None:
    """The load tips with its middle over the edge, at 0.1 m, and falls."""
    result = compiled(STACK).simulate(parameters={"yaw": yaw})
    tips = min(e.time for e in result.events if e.liaison in ("on[1]", "on[4]"))
    assert tips == pytest.approx(0.25, abs=1e-9)
    assert not result["on.normal_force"][-1]
    assert np.abs(result["low.position.x"]).max() < 1e-14
    assert np.abs(result["low.velocity.x"]).max() == 0


BACK = """
    model Back
      parameter Angle yaw = 20 deg;
      body t: box(mass = 1 kg, size = (4, 3, 1) m);
      body load: box(mass = 1 kg, size = (1, 1, 1) m);
      frame g on ground at (1.2, 0.2, 1) m rotated(axis = z, angle = yaw);
      frame o on ground at (1.2, 0.2, 1) m;
      liaison w: encastrement(ground, t);
      liaison on: appui_faces(load.bottom, t.top);
      force s: spring(o, load, k = 16 N/m, length = 0 m);
    initial
      load.position = g.position;
      load.orientation = g.orientation;
      load.velocity = (2.5, 0.5, 0) m/s;
      experiment(stop = 3 s, tolerance = 1e-10);
    end Back;
    """


@pytest.mark.parametrize(("yaw", "events"), [(0.0, 12), (0.35, 12), (-1.0, 2)])
def test_a_box_that_overhangs_and_is_drawn_back_stays_on_the_table(yaw: float, events: int) -> None:
    """Its middle stays over the table: it oscillates as on a plane, over the edge and back."""
    result = compiled(BACK).simulate(parameters={"yaw": yaw})
    assert len(result.events) >= events
    assert result["load.position.x"] == pytest.approx(
        1.2 + 0.625 * np.sin(4 * result.time), abs=1e-8
    )
    assert result["load.position.y"] == pytest.approx(
        0.2 + 0.125 * np.sin(4 * result.time), abs=1e-8
    )
    assert result["load.position.z"] == pytest.approx(1, abs=1e-12)
    assert result["on.normal_force"] == pytest.approx(G, abs=1e-9)


@pytest.mark.parametrize("mass", [1, 1e4])
def test_beams_that_lie_crosswise_on_edges_are_lifted(mass: float) -> None:
    """A bar with an edge down on the edges of two others leaves them at the time m g/k."""
    result = compiled(f"""
        model Beams
          body a: box(mass = 1 kg, size = (0.2, 2, 0.2) m);
          body b: box(mass = 1 kg, size = (0.2, 2, 0.2) m);
          body bar: box(mass = {mass} kg, size = (3, 0.1, 0.1) m);
          frame f on ground at (-0.5, 0, 0) m rotated(axis = y, angle = pi/4);
          frame g on ground at (0.5, 0, 0) m rotated(axis = y, angle = pi/4);
          frame h on ground at (0, 0, 0.15*sqrt(2)) m rotated(axis = x, angle = pi/4);
          liaison wa: encastrement(f, a);
          liaison wb: encastrement(g, b);
          liaison ca: contact_ponctuel(a.edges[8], bar.edges[1]);
          liaison cb: contact_ponctuel(bar.edges[1], b.edges[8]);
          force lift: on(bar, value = (0 N, 0 N, {10 * mass} N/s*time));
        initial
          bar.position = h.position;
          bar.orientation = h.orientation;
          experiment(stop = 1.5 s, tolerance = 1e-11);
        end Beams;
        """).simulate()
    assert [e.time for e in result.events] == pytest.approx([G / 10] * 2, abs=1e-10)
    after = 1.5 - G / 10
    height = 0.15 * math.sqrt(2) + 10 * after**3 / 6
    assert result["bar.position.z"][-1] == pytest.approx(height, abs=1e-9)
