"""A model whose text ends the run: the environment learns it, and values stay readable."""

from __future__ import annotations

import ctypes
import math
import sys
from pathlib import Path

import pytest
from fmpy import simulate_fmu
from fmu_host import DISCARD, OK, Host, compile_libraries, unpack_library
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
def archives_that_end(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("ending")
    program = build(MODEL, folder / "model")
    archives = {}
    for version in ("2.0", "3.0"):
        archives[version] = folder / f"Ending{version[0]}.fmu"
        fmi.export(program, archives[version], version, compile_libraries)
    return archives


@pytest.fixture(scope="module")
def endings(
    archives_that_end: dict[str, Path], tmp_path_factory: pytest.TempPathFactory
) -> dict[int, Path]:
    return {
        int(version[0]): unpack_library(archive, version, tmp_path_factory.mktemp("ended"))
        for version, archive in archives_that_end.items()
    }


T_END = math.sqrt(2 / 9.81)
BOUNCES = len(MODEL.parameters) + 1 + 2


def test_in_fmi_2_a_step_that_meets_terminate_is_discarded_at_its_instant(
    endings: dict[int, Path],
) -> None:
    one = Host(endings[2], 2, token=b"small-Ending")
    one.start()
    assert one.step(0.0, 0.4) == OK
    assert one.step(0.4, 0.4) == DISCARD
    assert "the model has ended the run at t = 0.4515" in one.last
    ended, t = ctypes.c_int(0), ctypes.c_double(0)
    assert one.call("GetBooleanStatus", 3, ctypes.byref(ended)) == OK
    assert one.call("GetRealStatus", 2, ctypes.byref(t)) == OK
    assert ended.value == 1 and t.value == pytest.approx(T_END, rel=1e-10)
    assert one.get(BOUNCES) == 1.0
    assert one.step(0.8, 0.1) == DISCARD
    assert one.call("Terminate") == OK
    one.free()


@pytest.mark.parametrize("early", [False, True])
def test_in_fmi_3_the_environment_is_asked_to_stop_and_nothing_has_failed(
    endings: dict[int, Path], early: bool
) -> None:
    one = Host(endings[3], 3, token=b"small-Ending", early=early)
    one.start()
    assert one.step(0.0, 0.4) == OK
    assert one.answers[:3] == (False, False, False)
    assert one.step(0.4, 0.4) == OK
    assert "the model has ended the run at t = 0.4515" in one.last
    assert {status for status, _, _ in one.messages} == {OK}
    # A step that returns early is an error to environments that have not allowed it.
    assert one.answers[:3] == (False, True, early)
    assert one.answers[3] == pytest.approx(T_END, rel=1e-10)
    assert one.get(BOUNCES) == 1.0
    assert one.step(0.8, 0.1) == OK and one.answers[1]
    assert one.get(BOUNCES) == 1.0
    assert one.call("Terminate") == OK
    one.free()


@pytest.mark.parametrize("version", ["2.0", "3.0"])
@pytest.mark.parametrize("early", [False, True])
def test_fmpy_takes_it_for_a_good_end(
    archives_that_end: dict[str, Path], version: str, early: bool
) -> None:
    result = simulate_fmu(
        str(archives_that_end[version]),
        stop_time=2.0,
        output_interval=0.1,
        output=["h"],
        early_return_allowed=early,
    )
    # Where FMPy hears of the instant it records it; else the communication point after it.
    told = version == "2.0" or early
    assert result["time"][-1] == pytest.approx(T_END if told else 0.5, rel=1e-9)
    # It falls from 1 m and stays where the text has ended the run.
    assert result["h"][-1] == pytest.approx(0.0, abs=1e-9)
