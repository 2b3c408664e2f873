"""Between calls nothing is kept in scratch memory: whatever a host leaves there, all bits agree."""

from __future__ import annotations

import math
import struct
from pathlib import Path

import pytest
from frot.runtime.engine import OK, Engine

import frot

# What scratch is filled with: bytes, and a number that is one.
PATTERNS = (*(bytes([k]) * 8 for k in (0x00, 0x3F, 0x77, 0xFF)), struct.pack("d", 1.0))

MODELS = Path(__file__).parents[2] / "models"
FILES = Path(__file__).parents[1] / "scenes"
BAR = """
planar model Thrown
  body bar: rod(mass = 1 kg, length = 1 m);
  liaison a: contact_ponctuel(bar.start, ground.line) with coulomb(0.3);
  liaison b: contact_ponctuel(bar.tip, ground.line) with coulomb(0.3);
initial
  bar.position.y = 0 m;
  bar.velocity = (1, 1) m/s;
  experiment(stop = 0.19 s);
end Thrown;
"""

# Implicit steps, and a `when` that is not to fire again before what it waits for has risen.
STIFF_BALL = """
model StiffBall
  Real h(start = 1); Real v; Real y(start = 1);
equation
  der(h) = v/(1 s);
  der(v) = -9.81/(1 s);
  der(y) = -1e5*(y - cos(time/(1 s)))/(1 s);
  when h < 0 then
    reinit(v, -0.5*pre(v));
  end when;
  experiment(stop = 1.2 s, tolerance = 1e-6, method = implicit);
end StiffBall;
"""
# The rate of s follows the acceleration of another group, whose modes are found later.
LATE = """
planar model Late
  body block: particle(mass = 1 kg);
  body two: particle(mass = 1 kg);
  liaison A: contact_ponctuel(block, ground.line) with coulomb(0.5);
  liaison B: contact_ponctuel(two, ground.line) with coulomb(0.3);
  Velocity s;
  force F: on(block, value = (0.5*9.81 N + 1 N.s/m*s, 0 N));
initial
  block.position = (0, 0) m; two.position = (3, 0) m;
  block.velocity = (0, 0) m/s; two.velocity = (2, 0) m/s; s = 0 m/s;
equation
  der(s) = two.acceleration.x;
  experiment(stop = 1 s);
end Late;
"""
# What y is has two solutions, between which a condition on another unknown decides.
BISTABLE = """
model Bistable
  Real x(start = -1); Real y(start = 1); Real z; Real w;
initial
  x = -1;
  z = 0;
equation
  der(x) = -x/(1 s);
  y*y*y*y + y*y = x + 10*w;
  der(z) = (w + 0*y)/(1 s);
  w = if w > 0.5 then 1 else 0;
  experiment(stop = 1 s);
end Bistable;
"""


def scissors(n: int) -> str:
    """Rods crossed in pairs, one pair above the other, which pass through flat postures."""
    lines = ["planar model Scissors"]
    guesses = []
    for i in range(n):
        for k, side in (("a", 1), ("b", -1)):
            lines.append(f"  body {k}{i}: rod(mass = 2 kg, length = 1 m);")
            angle = f"{0.5 if side > 0 else math.pi - 0.5!r}"
            place = f"(0.44, {(i + 0.5) * math.sin(0.5)!r}) m"
            guesses.append(f"  guess({k}{i}.position = {place}, {k}{i}.angle = {angle} rad);")
        lines.append(f"  liaison m{i}: rotoide(a{i}, b{i});")
        if i:
            lines.append(f"  liaison l{i}: rotoide(b{i - 1}.tip, a{i}.start);")
            lines.append(f"  liaison r{i}: rotoide(a{i - 1}.tip, b{i}.start);")
    lines += ["  liaison foot: rotoide(ground, a0.start);"]
    lines += ["  liaison slide: point_courbe(b0.start, ground.line);"]
    lines += ["  force push: on(b0.start, value = (-(40 + 300*(1 + sin(2 rad/s*time))) N, 0 N));"]
    return "\n".join([*lines, "initial", *guesses, "  experiment(stop = 1 s);", "end Scissors;"])


SCENES = {
    "thrown": BAR,
    "scissors": scissors(3),
    "stiff ball": STIFF_BALL,
    "late rates": LATE,
    "late rates at rest": LATE.replace("(2, 0) m/s", "(0, 0) m/s"),
    **dict.fromkeys(("slider_crank", "bar_on_two_lines", "slack_threads", "rolling_cone"), ""),
}


def fill(engine: Engine, pattern: bytes) -> None:
    scratch = memoryview(engine._work).cast("B")
    scratch[:] = pattern * (len(scratch) // len(pattern))


def states(program: frot.Program, stop: float, pattern: bytes) -> list[bytes]:
    """The whole state after the start and at some times, scratch filled before each call."""
    engine = Engine(program)

    def spoil() -> None:
        fill(engine, pattern)

    spoil()
    assert engine.settle_parameters()[0] == OK
    spoil()
    assert engine.start(0.0, 1e-7, program.experiment.on_indeterminate) == OK
    found = [engine.save()]
    for part in (0.013, 0.3, 0.31, 0.75, 1.0):
        spoil()
        assert engine.advance(part * stop).status == OK
        found.append(engine.save())
    spoil()
    assert engine.start(0.0, 1e-7, program.experiment.on_indeterminate) == OK
    assert engine.save() == found[0], "a state that was used starts like a new one"
    return found


@pytest.mark.parametrize("scene", SCENES)
def test_what_scratch_holds_before_a_call_changes_nothing(scene: str) -> None:
    text = SCENES[scene]
    model = frot.compile(text) if text else frot.load(MODELS / f"{scene}.frot")
    stop = model.simulate().time[-1]
    first, *others = (states(model.program(), stop, pattern) for pattern in PATTERNS)
    assert all(each == first for each in others)


@pytest.mark.parametrize("calls", [1, 2000])
def test_what_ends_a_run_is_not_read_from_scratch(calls: int) -> None:
    """Past a pole of its reactions no modes last: the same is told, after as many evaluations.

    Where calls are shorter than steps, events are the first thing that a call finds.
    """
    program = frot.load(FILES / "ends_at_a_pole.frot").program()
    told = set()
    for pattern in PATTERNS:
        engine = Engine(program)
        engine.settle_parameters()
        assert engine.start(0.0, 1e-8, program.experiment.on_indeterminate) == OK
        for k in range(calls):
            fill(engine, pattern)
            status = engine.advance((k + 1) / calls * program.experiment.stop).status
        told.add((status, engine.fault_text, engine.statistics.evaluations))
    assert len(told) == 1
    assert status != OK


def test_conditions_at_a_start_without_values_are_not_read_from_scratch() -> None:
    program = frot.compile(BISTABLE).program()
    told = set()
    for pattern in PATTERNS:
        engine = Engine(program)
        engine.settle_parameters()
        fill(engine, pattern)
        told.add((engine.start(0.0, 1e-8, program.experiment.on_indeterminate), engine.fault_text))
    assert len(told) == 1
