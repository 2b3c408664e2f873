"""Values changed in a run: bodies stay where they are, contacts open, or it is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest
from frot.runtime.engine import OK, Engine

import frot

G = 9.81
FLOOR = """planar model Floor
  parameter Length h = 1 m;
  parameter Angle slope = 0;
  parameter Boolean parts = true;
  body b: particle(mass = 2 kg);
  curve floor on ground: line(through = (0 m, h), direction = (cos(slope), sin(slope)));
  liaison c: contact_ponctuel(b, floor, unilateral = parts) with coulomb(0.1);
initial
  b.position = (0, 1) m;
  b.velocity = (3, 0) m/s;
  experiment(stop = 10 s);
end Floor;
"""


class Bench:
    """A model in a run, its values by name."""

    def __init__(self, text: str, **before: float) -> None:
        self.program = frot.compile(text).program()
        self.engine = Engine(self.program)
        for name, value in before.items():
            self.set(name, value)
        assert self.engine.start(0.0, 1e-10, "rest") == OK
        self.segments = np.empty(0)
        self.to(0.0)

    def set(self, name: str, value: float) -> None:
        names = [p.name for p in self.program.parameters]
        self.engine.set_parameter(names.index(name), value)

    def get(self, name: str) -> float:
        names = [p.name for p in self.program.parameters]
        return self.engine.get_parameter(names.index(name))

    def to(self, t: float) -> list[str]:
        run = self.engine.advance(t)
        self.segments, self.t = np.concatenate((self.segments, run.segments)), t
        assert run.status == OK
        return [self.engine.event_text(e) for e in run.events]

    def __getitem__(self, name: str) -> float:
        k = [v.name for v in self.program.variables].index(name)
        return float(self.engine.sample(self.segments, np.array([self.t]))[0, k])


def test_a_floor_that_is_lowered_lets_the_block_fall() -> None:
    """It slides from 3 m/s for 1 s, then flies on as it is."""
    bench = Bench(FLOOR)
    bench.to(1.0)
    bench.set("h", -5.0)
    assert bench.engine.settle() == OK
    bench.to(1.5)
    x, v = 3 - 0.1 * G / 2, 3 - 0.1 * G
    assert bench["c.mode"] == 0
    assert bench["b.position.x"] == pytest.approx(x + 0.5 * v, rel=1e-12)
    assert bench["b.position.y"] == pytest.approx(1 - G * 0.5**2 / 2, rel=1e-12)
    assert bench["c.gap"] == pytest.approx(6 - G * 0.5**2 / 2, rel=1e-12)


def test_the_separation_is_an_event() -> None:
    bench = Bench(FLOOR)
    bench.to(1.0)
    bench.set("h", 0.0)
    assert bench.to(1.1) == ["c: slip -> open at t = 1"]


@pytest.mark.parametrize(
    ("parts", "h", "words"),
    [(1.0, 1.001, "inside by 0.001 m"), (0.0, 0.5, "cannot part"), (0.0, 1.5, "cannot part")],
)
def test_what_would_move_the_block_is_refused_and_the_run_goes_on(
    parts: float, h: float, words: str
) -> None:
    bench, same = Bench(FLOOR, parts=parts), Bench(FLOOR, parts=parts)
    bench.to(1.0), same.to(1.0)
    bench.set("h", h)
    with pytest.raises(frot.FrotError, match=r"E0908.*liaison 'c'") as told:
        bench.engine.settle()
    assert words in str(told.value)
    assert bench.get("h") == 1.0
    bench.to(5.0), same.to(5.0)
    assert np.array_equal(bench.segments.view(np.uint64), same.segments.view(np.uint64))


def test_a_refusal_in_the_midst_of_an_advance_leaves_the_instance_usable() -> None:
    bench = Bench(FLOOR)
    bench.to(1.0)
    bench.set("h", 2.0)
    with pytest.raises(frot.FrotError, match="E0908"):
        bench.engine.advance(2.0)
    assert bench.engine.time == 1.0
    bench.to(2.0)
    assert bench["b.position.y"] == 1.0


def test_a_floor_moved_by_rounding_carries_the_block() -> None:
    bench = Bench(FLOOR)
    bench.to(1.0)
    bench.set("h", 1 + 1e-13)
    bench.to(1.5)
    assert bench["c.mode"] == 2 and bench["b.position.y"] == pytest.approx(1, abs=1e-12)


@pytest.mark.parametrize("slope", [0.2, -0.2])
def test_a_floor_that_tilts_under_a_block_at_its_hinge(slope: float) -> None:
    """The block moves at 3 m/s: into the slope it would be an impact, away from it it flies."""
    bench = Bench(FLOOR)
    bench.set("slope", slope)
    if slope > 0:
        with pytest.raises(frot.FrotError, match=r"would meet with a speed of 0\.596"):
            bench.engine.settle()
        bench.to(0.5)
        assert bench["c.mode"] == 2 and bench["b.position.y"] == 1.0
    else:
        bench.to(0.1)
        assert bench["c.mode"] == 0
        gap = 3 * 0.1 * math.sin(0.2) - G * 0.1**2 / 2 * math.cos(0.2)
        assert bench["c.gap"] == pytest.approx(gap, rel=1e-10)


@pytest.mark.parametrize("h", [2.0, 3.5, 2.5])
def test_a_line_brought_to_a_body_at_rest_touches_it(h: float) -> None:
    bench = Bench(
        "planar model Hover\n  world(gravity = 0 m/s^2);\n  parameter Length h = 1 m;\n"
        "  body b: particle(mass = 1 kg);\n"
        "  curve floor on ground: line(through = (0 m, h), direction = (1, 0));\n"
        "  liaison c: contact_ponctuel(b, floor) with coulomb(0.5);\n"
        "initial\n  b.position = (0, 2.5) m;\nend Hover;\n"
    )
    bench.to(1.0)
    bench.set("h", h)
    if h > 2.5:
        with pytest.raises(frot.FrotError, match="inside by 1 m"):
            bench.engine.settle()
    bench.to(2.0)
    assert bench["c.mode"] == (1 if h == 2.5 else 0)
    assert bench["b.position.y"] == 2.5


CARRIED = {
    "pin": (
        "  parameter Length d = 0 m;\n  body b: rod(mass = 1 kg, length = 1 m);\n"
        "  frame nail on ground at (d, 0 m);\n  liaison hinge: rotoide(nail, b.start);\n",
        "hinge.angle = 30 deg;",
        "body 'b', carried by liaison 'hinge': it would move by 0.1 m at once",
    ),
    "length": (
        "  parameter Length d = 1 m;\n  body b: rod(mass = 1 kg, length = d);\n"
        "  liaison hinge: rotoide(ground, b.start);\n",
        "hinge.angle = 0 deg;",
        "carried by liaison 'hinge'",
    ),
    "line": (
        "  parameter Length d = 0 m;\n  body b: particle(mass = 1 kg);\n"
        "  curve rail on ground: line(through = (0 m, d), direction = (1, 0));\n"
        "  liaison slide: point_courbe(b, rail) with coulomb(0.1);\n",
        "b.velocity = (1, 0) m/s;",
        "carried by liaison 'slide': it would move by 0.1 m at once",
    ),
    "slope": (
        "  parameter Angle d = 0;\n  body b: particle(mass = 1 kg);\n"
        "  curve rail on ground: line(through = (0 m, 0 m), direction = (cos(d), sin(d)));\n"
        "  liaison slide: point_courbe(b, rail);\n",
        "b.position = (1, 0) m;",
        "carried by liaison 'slide'",
    ),
    "frame": (
        "  parameter Angle d = 0;\n  body b: rod(mass = 1 kg, length = 1 m);\n"
        "  frame nail on ground rotated(angle = d);\n  liaison hinge: rotoide(nail, b);\n",
        "",
        "would turn by 0.1 rad",
    ),
    "prescribed": (
        "  parameter Velocity d = 1 m/s;\n  body b: particle(mass = 1 kg);\n"
        "  Force fx, fy;\n  force drive: on(b, value = (fx, fy));\n"
        "equation\n  b.position.x = d*time;\n  b.position.y = 0 m;\n",
        "",
        "b.position.x = d*time: it would be off by -0.1",
    ),
}


@pytest.mark.parametrize("case", CARRIED)
def test_a_body_is_never_carried_along_at_once(case: str) -> None:
    declarations, initial, words = CARRIED[case]
    equations = "\nequation" in declarations
    body, tail = declarations.split("equation\n") if equations else (declarations, "")
    text = f"planar model Carried\n{body}"
    text += f"equation\n{tail}" if equations else f"initial\n  {initial}\n" if initial else ""
    bench = Bench(text + "  experiment(stop = 5 s);\nend Carried;\n")
    bench.to(1.0)
    x, old = bench["b.position.x"], bench.get("d")
    bench.set("d", old + 0.1)
    with pytest.raises(frot.FrotError, match="E0908") as told:
        bench.engine.settle()
    assert words in " ".join(str(told.value).split())
    assert bench.get("d") == old
    bench.to(1.0 + 1e-6)
    assert bench["b.position.x"] == pytest.approx(x, abs=1e-5)
    bench.to(2.0)


def test_a_relation_of_the_text_is_not_broken() -> None:
    bench = Bench(
        "model Pendulum\n  parameter Length L = 1 m;\n  parameter Acceleration g = 9.81 m/s^2;\n"
        '  Length x(start = 0.6 m);\n  Length y(start = -0.8 m);\n  Real T(unit = "1/s^2");\n'
        "initial\n  x = 0.6*L;\n  der(x) = 0 m/s;\n"
        "equation\n  der(der(x)) = -T*x;\n  der(der(y)) = -T*y - g;\n"
        "  x^2 + y^2 = L^2;\nend Pendulum;\n"
    )
    bench.to(0.3)
    bench.set("L", 1.2)
    with pytest.raises(frot.FrotError, match="E0908") as told:
        bench.engine.settle()
    assert "x^2 + y^2 = L^2" in str(told.value)
    bench.set("g", 1.62)  # what breaks no relation may change
    bench.to(0.6)
    assert bench["x"] ** 2 + bench["y"] ** 2 == pytest.approx(1, rel=1e-12)
    assert bench.get("L") == 1 and bench.get("g") == 1.62


TABLE = """planar model Table
  parameter Velocity along = 0 m/s;
  parameter AngularVelocity w = 0 rad/s;
  body plank: rod(mass = 1 kg, length = 1 m);
  body cart: particle(mass = 1 kg);
  body b: particle(mass = 2 kg);
  curve top on plank: line(through = (0, 0) m, direction = (1, 0));
  liaison hinge: rotoide(ground, plank);
  liaison rail: point_courbe(cart, ground.line);
  liaison c: contact_ponctuel(b, top) with coulomb(0.1);
  Force pull;
  Torque turn;
  force drive: on(cart, value = (pull, 0 N));
  force motor: couple(hinge, value = turn);
initial
  b.position = (0.4, 0) m;
equation
  cart.velocity.x = along;
  hinge.angle = w*time;
  experiment(stop = 5 s);
end Table;
"""


def test_no_speed_that_the_text_prescribes_jumps() -> None:
    bench = Bench(TABLE)
    bench.to(1.0)
    bench.set("along", 0.5)
    with pytest.raises(frot.FrotError, match=r"E0908.*\n?.*cart.velocity.x = along"):
        bench.engine.settle()
    bench.to(2.0)
    assert bench["cart.velocity.x"] == 0 and bench["c.mode"] == 1


@pytest.mark.parametrize("w", [1.0, -40.0])
def test_nor_does_one_that_follows_from_a_prescribed_place(w: float) -> None:
    """At t = 0 the place of the plank is the same for any w."""
    bench = Bench(TABLE)
    bench.set("w", w)
    with pytest.raises(frot.FrotError, match=r"hinge.angle = w\*time"):
        bench.engine.settle()
    bench.to(0.1)
    assert bench["c.mode"] == 1 and bench["hinge.angle"] == 0


REINIT = """planar model Moved
  parameter Boolean parts = true;
  body b: particle(mass = 1 kg);
  curve floor on ground: line(through = (0, 1) m, direction = (1, 0));
  liaison c: contact_ponctuel(b, floor, unilateral = parts) with coulomb(0.1);
initial
  b.position = (0, 1) m;
  b.velocity = (3, 0) m/s;
equation
  when time > 0.5 s then
    reinit({what});
  end when;
  experiment(stop = 0.6 s);
end Moved;
"""


@pytest.mark.parametrize(
    ("what", "parts", "words"),
    [
        ("b.position.y, 0.5 m", True, "the body would be inside by 0.5 m"),
        ("b.position.y, 1.5 m", False, "it cannot part, and would be apart by 0.5 m"),
        ("b.velocity.y, 2 m/s", False, "it cannot part, and would part with a speed of 2 m/s"),
    ],
)
def test_a_reinit_against_the_liaisons_ends_the_run(what: str, parts: bool, words: str) -> None:
    with pytest.raises(frot.SimulationError, match="E0908") as told:
        frot.compile(REINIT.format(what=what)).simulate(parameters={"parts": parts})
    assert words in " ".join(str(told.value).split()) and "reinit" in str(told.value)
    assert told.value.result is not None and told.value.result.time[-1] == 0.5


def test_a_reinit_that_lifts_a_block_lets_it_fall() -> None:
    run = frot.compile(REINIT.format(what="b.position.y, 1.5 m")).simulate()
    assert "c: slip -> open at t = 0.5" in [e.text for e in run.events]
    assert run.at(0.6)["b.position.y"] == pytest.approx(1.5 - G * 0.1**2 / 2)
