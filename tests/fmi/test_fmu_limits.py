"""Steps without end: a stated limit of work ends them, by name, at a time that is told."""

from __future__ import annotations

import ctypes
import math
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from fmu_host import DISCARD, MOST_WORK, MU, OK, STIFFNESS, TIME, Host, X


@pytest.fixture
def one(hasty: dict[int, Path], version: int) -> Host:
    return Host(hasty[version], version)


def reached(one: Host) -> float:
    """The last successful time, as each version tells it."""
    if one.version == 3:
        assert one.answers[:3] == (False, True, False)
        return float(one.answers[3])
    ended, t = ctypes.c_int(0), ctypes.c_double(0)
    assert one.call("GetBooleanStatus", 3, ctypes.byref(ended)) == OK
    assert one.call("GetRealStatus", 2, ctypes.byref(t)) == OK
    assert ended.value == 1
    return t.value


@pytest.mark.parametrize("step", [1e6, 1e18, 1e300])
def test_a_step_of_aeons_ends(one: Host, step: float) -> None:
    """Without friction the block swings for ever: x = 2 cos 3t."""
    assert one.set(MU, 0.0) == OK
    one.start()
    begun = time.process_time()
    assert one.step(0.0, step) == DISCARD
    assert time.process_time() - begun < 60.0
    assert f"has taken {MOST_WORK} evaluations of the model" in one.last
    assert "make shorter steps" in one.last
    t = reached(one)
    assert 10.0 < t < step and one.get(TIME) == t
    assert one.get(X) == pytest.approx(2.0 * math.cos(3.0 * t), abs=1e-4)
    assert one.step(t, 1.0) == DISCARD
    assert "has ended early" in one.last
    assert one.call("Terminate") == OK


def test_an_age_at_rest_is_no_work(one: Host) -> None:
    """Painlevé 1895, p. 61: nine half swings, each shorter by 2 mu g/omega^2, then rest."""
    one.start()
    assert one.step(0.0, 1e6) == OK
    assert one.get(X) == pytest.approx(-(2.0 - 18 * 0.1 * 9.81 / 9.0), abs=1e-8)
    assert one.step(1e6, 1e300) == DISCARD
    assert reached(one) > 1e6


def test_a_spring_set_stiff_in_a_run_ends_it_by_name(one: Host) -> None:
    one.start()
    one.run(0.0, 1.0, 0.5)
    assert one.set(STIFFNESS, 1e20) == OK
    assert one.step(1.0, 1e3) == DISCARD
    assert 1.0 <= reached(one) < 1001.0
    told = ("values that make the motion stiff", "step goes to zero", "modes do not settle")
    assert any(words in one.last for words in told)


def test_the_limit_counts_one_step_not_the_run(one: Host) -> None:
    one.start()
    t = 0.0
    while t < 60.0:
        assert one.step(t, 0.01) == OK, one.last
        t = one.get(TIME)


def test_after_the_limit_a_saved_state_goes_on(one: Host) -> None:
    assert one.set(MU, 0.0) == OK
    one.start()
    state = one.save()
    assert one.step(0.0, 1e12) == DISCARD
    assert one.restore(state) == OK
    assert one.step(0.0, 1.0) == OK


@pytest.mark.parametrize("step", [1e12, 1e300])
def test_a_step_whose_end_is_beyond_reach_ends_in_seconds(
    host: Callable[..., Host], step: float
) -> None:
    """Without a smaller limit than the model's own, twenty million evaluations."""
    one = host()
    assert one.set(MU, 0.0) == OK
    one.start()
    begun = time.process_time()
    assert one.step(0.0, step) == DISCARD
    assert time.process_time() - begun < 20.0
    assert "at its pace" in one.last and "20000000 evaluations" in one.last
    t = reached(one)
    assert 1e3 < t < 1e6 and one.get(TIME) == t


def test_the_environment_sets_the_evaluations_of_a_step(
    host: Callable[..., Host], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("FROT_FMU_EVALUATIONS", "5e3")
    one = host()
    assert one.set(MU, 0.0) == OK
    one.start()
    assert one.step(0.0, 1e4) == DISCARD
    assert "has taken 5000 evaluations of the model" in one.last
    assert 1.0 < reached(one) < 1e3


def test_the_environment_sets_the_seconds_of_a_step(
    host: Callable[..., Host], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("FROT_FMU_SECONDS", "1")
    one = host()
    assert one.set(MU, 0.0) == OK
    one.start()
    begun = time.monotonic()
    assert one.step(0.0, 2e6) == DISCARD
    assert time.monotonic() - begun < 20.0
    assert "has taken 1 s, the most by FROT_FMU_SECONDS" in one.last
    assert one.get(X) == pytest.approx(2.0 * math.cos(3.0 * reached(one)), abs=1e-2)


@pytest.mark.parametrize("text", ["soon", "-1", "0", "nan", "3 s"])
def test_a_limit_that_is_no_number_is_refused_by_name(
    host: Callable[..., Host], monkeypatch: pytest.MonkeyPatch, text: str
) -> None:
    monkeypatch.setenv("FROT_FMU_SECONDS", text)
    one = host()
    assert one.instance is None
    assert f"FROT_FMU_SECONDS is '{text}', which is not a positive number" in one.last


def test_a_state_without_a_name_that_grows_without_limit_ends_the_motion(
    host: Callable[..., Host],
) -> None:
    """A spring that pushes away, x ~ e^(3 t); the hand-written model does not name its states."""
    one = host()
    assert one.set(MU, 0.0) == OK and one.set(STIFFNESS, -9.0) == OK
    one.start()
    assert one.step(0.0, 1e4) == DISCARD
    assert "'a state' grows without limit" in one.last
    assert 10.0 < reached(one) < 1e3
