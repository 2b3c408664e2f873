"""FMI 3.0's intermediate update: values given and read inside a step, and steps that are ended."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from typing import Any

import pytest
from fmu_host import ERROR, MODE, OK, PUSH, TIME, Host, X

Make = Callable[..., Host]


@pytest.fixture(params=[3], ids=["fmi3"])
def version(request: pytest.FixtureRequest) -> int:
    return int(request.param)


class Update:
    """A callback that notes its calls, and does what it is given."""

    def __init__(self, act: Callable[[float, bool, bool], bool]) -> None:
        self.calls: list[tuple[float, bool, bool, bool]] = []
        self.act = act

    def __call__(
        self,
        _env: Any,
        t: float,
        asks: bool,
        shows: bool,
        done: bool,
        may: bool,
        ends: Any,
        _when: Any,
    ) -> None:
        assert shows == done
        self.calls.append((t, asks, shows, may))
        ends[0] = self.act(t, asks, shows)


def test_inputs_are_asked_for_and_values_shown_at_eight_points(host: Make) -> None:
    """Alternately; in between the input is linear, and the step arrives at its end exactly."""
    seen: list[tuple[float, float]] = []

    def act(t: float, asks: bool, shows: bool) -> bool:
        if asks:
            assert one.set(PUSH, 2 * t) == OK, one.last
        if shows:
            seen.append((one.get(TIME), one.get(X)))
        return False

    update = Update(act)
    one = host(update=update, required=[PUSH, X, TIME])
    one.start()
    assert one.step(0.0, 0.4) == OK, one.messages
    assert [(asks, shows) for _, asks, shows, _ in update.calls] == 8 * [
        (True, False),
        (False, True),
    ]
    assert [t for t, _, shows, _ in update.calls if shows] == pytest.approx(
        [0.05 * k for k in range(1, 9)]
    )
    assert [t for t, _ in seen] == pytest.approx([0.05 * k for k in range(1, 9)])
    assert one.get(X) == seen[-1][1]
    assert one.get(PUSH) == pytest.approx(0.8)
    assert one.answers == (False, False, False, 0.4)


def test_a_step_can_be_ended_at_a_point_and_goes_on(host: Make) -> None:
    update = Update(lambda t, _asks, shows: shows and t > 0.2)
    one = host(update=update, required=[X], early=True)
    one.start()
    assert one.step(0.0, 0.8) == OK
    assert one.answers[2:] == (True, pytest.approx(0.3))
    same = host(early=True)
    same.start()
    assert same.step(0.0, one.answers[3]) == OK
    assert one.get(X) == same.get(X)
    assert one.step(one.answers[3], 0.1) == OK
    # an importer that does not allow early return is not asked for it
    one = host(update=update, required=[X])
    one.start()
    assert one.step(0.0, 0.8) == OK
    assert one.answers[2:] == (False, 0.8)


def test_an_endless_step_can_be_cancelled(host: Make) -> None:
    """The kernel asks now and then, also where no variable is required."""
    left = iter(range(3))
    update = Update(lambda *_: next(left, None) is None)
    one = host(update=update, early=True)
    one.start()
    assert one.step(0.0, 1e300) == OK, one.messages
    _, terminates, early, t = one.answers
    assert (terminates, early) == (False, True)
    assert 0 < t < 1e300
    assert len(update.calls) == 4
    assert not any(asks or shows for _, asks, shows, _ in update.calls)
    assert one.step(t, 0.1) == OK


def test_what_is_not_allowed_inside_a_step_is_refused(host: Make) -> None:
    """Each by an error; the step is then the one without it."""
    faults: list[int] = []

    def act(_t: float, asks: bool, shows: bool) -> bool:
        faults.extend(
            (
                one.step(0.0, 0.1),
                one.call("Reset"),
                one.call("Terminate"),
                one.restore(state),
                one.try_get(MODE, "Int64")[0],
                one.set(X if asks else PUSH, 1.0),
                one.try_get(X)[0] if not shows else ERROR,
                one.call("EnterEventMode"),
            )
        )
        held = ctypes.c_void_p(None)
        faults.append(one.call("GetFMUState", ctypes.byref(held)))
        return False

    one = host(update=Update(act), required=[PUSH, X])
    one.start()
    state = one.save()
    assert one.step(0.0, 0.4) == OK, one.messages
    assert len(faults) == 9 * 16 and set(faults) == {ERROR}
    other = host()
    other.start()
    assert other.step(0.0, 0.4) == OK
    assert one.get(X) == pytest.approx(other.get(X), rel=1e-9)


def test_a_callback_or_a_variable_that_is_missing_is_named(host: Make) -> None:
    one = host(required=[X])
    assert one.instance is None
    assert "the callback is NULL" in one.last
    one = host(update=Update(lambda *_: False), required=[10_000])
    assert one.instance is None
    assert "no value reference 10000" in one.last
