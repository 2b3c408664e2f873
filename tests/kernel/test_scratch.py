"""Between calls nothing is kept in scratch memory: whatever a host leaves there, all bits agree."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from frot.runtime.engine import OK, Engine

import frot

MODELS = Path(__file__).parents[2] / "models"
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
    **dict.fromkeys(("slider_crank", "bar_on_two_lines", "slack_threads", "rolling_cone"), ""),
}


def states(program: frot.Program, stop: float, fill: int) -> list[bytes]:
    """The whole state after the start and at some times, scratch filled before each call."""
    engine = Engine(program)
    scratch = memoryview(engine._work).cast("B")

    def spoil() -> None:
        scratch[:] = bytes([fill]) * len(scratch)

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
    found = {fill: states(model.program(), stop, fill) for fill in (0x00, 0x3F, 0x77, 0xFF)}
    assert all(each == found[0] for each in found.values())
