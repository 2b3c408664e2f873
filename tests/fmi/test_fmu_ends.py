"""A model whose text ends the run: the environment learns it, and values stay readable."""

from __future__ import annotations

import ctypes
import functools
import math
import sys
from pathlib import Path

import pytest
from fmu_host import DISCARD, OK, Host, compile_library, unpack_library
from frot.runtime import fmi

sys.path.insert(0, str(Path(__file__).parents[1] / "kernel"))

from small_models import Small, build
from test_text_events import ball

MODEL: Small = ball(
    "Ending",
    outcomes=[("terminate", "on the floor")],
    update=lambda s: (s.q, s.v * 0, s.discrete + 1, 1),
)


@pytest.fixture(scope="module")
def endings(tmp_path_factory: pytest.TempPathFactory) -> dict[int, Path]:
    folder = tmp_path_factory.mktemp("ending")
    program = build(MODEL, folder / "model")
    libraries, compiler = {}, functools.partial(compile_library, generated="model.c")
    for number in (2, 3):
        archive, version = folder / f"Ending{number}.fmu", f"{number}.0"
        fmi.export(program, archive, version, compiler)
        libraries[number] = unpack_library(archive, version, folder / version)
    return libraries


def test_a_step_that_meets_terminate_is_discarded_at_its_instant(
    endings: dict[int, Path], version: int
) -> None:
    one = Host(endings[version], version, token=b"small-Ending")
    one.start()
    assert one.step(0.0, 0.4) == OK
    assert one.step(0.4, 0.4) == DISCARD
    assert "the model has ended the run at t = 0.4515" in one.last
    if version == 2:
        ended, t = ctypes.c_int(0), ctypes.c_double(0)
        assert one.call("GetBooleanStatus", 3, ctypes.byref(ended)) == OK
        assert one.call("GetRealStatus", 2, ctypes.byref(t)) == OK
        assert ended.value == 1 and t.value == pytest.approx(math.sqrt(2 / 9.81), rel=1e-10)
    else:
        _, ended, early, t = one.answers
        assert (ended, early) == (True, False)
        assert t == pytest.approx(math.sqrt(2 / 9.81), rel=1e-10)
    bounces = one.get(len(MODEL.parameters) + 1 + 2)
    assert bounces == 1.0
    assert one.step(0.8, 0.1) == DISCARD
    one.free()
