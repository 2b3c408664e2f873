"""The motion does not depend on the times at which somebody asks for values."""

from __future__ import annotations

import ctypes as ct
import random
from pathlib import Path

import pytest
from frot.runtime.engine import Engine
from frot.runtime.number_arrays import zeros
from frot.runtime.program import Program

import frot

ROOT = Path(__file__).parents[2]
LIBRARY = {"Blocks", "Electrical", "Rotational", "Translational"}
MODELS = [
    path
    for folder in (ROOT / "models", ROOT / "tests" / "scenes")
    for path in sorted(folder.glob("*.frot"))
    if path.stem not in LIBRARY
]


def end_of(
    program: Program, start: float, points: list[float], recorded: bool
) -> tuple[object, ...]:
    """Status and time of the run to the last of the points, and the bits of all values there."""
    engine = Engine(program)
    engine.settle_parameters()
    engine.start(start, 0.0, program.experiment.on_indeterminate)
    instance = (engine._model, engine._s, engine._w)
    values = zeros(max(1, len(program.variables)))
    read = engine._library.frot_values
    read.restype, read.argtypes = ct.c_int, (ct.c_void_p,) * 4
    status = 0
    for t in points:
        if recorded:
            status = engine.advance(t).status
        else:
            status = engine._library.frot_advance(*instance, t, None, None, None)
        read(*instance, values.buffer_info()[0])
    return status, engine.time, values.tobytes(), engine.fault_text


@pytest.mark.parametrize("path", MODELS, ids=lambda path: path.stem)
def test_random_communication_points_change_no_bit(path: Path) -> None:
    program = frot.load(path).program()
    start, stop = program.experiment.times()
    rng = random.Random(path.stem)
    whole = end_of(program, start, [stop], recorded=False)
    assert end_of(program, start, [stop], recorded=True) == whole
    for count in (1, 7, rng.choice((2, 40, 200))):
        points = sorted(rng.uniform(start, stop) for _ in range(count))
        assert end_of(program, start, [*points, stop], rng.random() < 0.3) == whole, points


def test_a_point_inside_a_step_before_rounding_is_measured_changes_no_bit() -> None:
    """Of this run rounding is measured after a step inside which 4.1 s lies."""
    program = frot.load(ROOT / "models" / "dry_pendulum.frot").program()
    assert end_of(program, 0.0, [4.1, 25.0], False) == end_of(program, 0.0, [25.0], False)
