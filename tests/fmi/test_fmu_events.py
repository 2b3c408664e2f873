"""Event mode of FMI 3.0: an environment stops exactly where modes and conditions change."""

from __future__ import annotations

import ctypes
import math
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from fmpy import simulate_fmu
from fmu_host import ERROR, MODE, OK, PUSH, TIME, Host, V, X, unpack_library

import frot

MODELS = Path(__file__).parents[2] / "models"
# A tank is filled and emptied by a clock, a ball is thrown up again by `reinit`.
TEXT = """
model Clocks
  Real level(start = 0);
  Real height(start = 1);
  Real speed(start = 0);
  Integer ticks(start = 0);
  input Real feed(start = 1);
  output Real l = level;
  output Real h = height;
  output Real v = speed;
  output Integer n = ticks;
equation
  der(level) = (if level > 2 then 0.5 else 1)*feed/(1 s);
  der(height) = speed/(1 s);
  der(speed) = -9.81/(1 s);
  when height < 0 then
    reinit(speed, -0.8*pre(speed));
  end when;
  when sample(0.25 s, 0.25 s) then
    ticks = pre(ticks) + 1;
  end when;
  experiment(stop = 3 s);
end Clocks;
"""


class Case:
    """A model, its library of FMI 3.0, and the references of its variables."""

    def __init__(self, model: frot.Model, folder: Path) -> None:
        self.model, self.program = model, model.program()
        self.archive = folder / "case.fmu"
        model.export_fmu(self.archive, "3.0", "native")
        self.library = unpack_library(self.archive, "3.0", folder)
        infos = (*self.program.parameters, *self.program.inputs, *self.program.variables)
        self.reference = {x.name: k for k, x in enumerate(infos, 1)}
        self.reals = [x.name for x in self.program.variables if x.type == "real"]

    def host(self, early: bool = True) -> Host:
        """In step mode."""
        one = Host(self.library, 3, token=self.program.key.encode(), event_mode=True, early=early)
        one.start()
        assert update(one) == OK
        assert one.call("EnterStepMode") == OK
        return one

    def values(self, one: Host) -> list[float]:
        """All real variables."""
        return [one.get(self.reference[name]) for name in self.reals]


def update(one: Host) -> int:
    """Call UpdateDiscreteStates; the answers are in `one.updated`."""
    flags = [ctypes.c_bool(True) for _ in range(5)]
    following = ctypes.c_double(-1.0)
    pointers = [*map(ctypes.byref, flags), ctypes.byref(following)]
    status = one.call("UpdateDiscreteStates", *pointers)
    one.updated = (*(flag.value for flag in flags), following.value)  # type: ignore[attr-defined]
    return status


def handle(one: Host) -> None:
    """Go through event mode without changing anything."""
    assert one.call("EnterEventMode") == OK
    assert update(one) == OK
    assert one.call("EnterStepMode") == OK


def stops(case: Case, one: Host, end: float, step: float) -> list[tuple[float, list[float]]]:
    """The instants at which steps end at events, and the values there after these."""
    found, t = list[tuple[float, list[float]]](), 0.0
    while t < end - 1e-9:
        assert one.step(t, min(step, end - t)) == OK, one.messages
        needed, ended, early, reached = one.answers
        assert not ended and (needed or not early) and reached == one.get(TIME)
        t = reached
        if needed:
            handle(one)
            found.append((t, case.values(one)))
    return found


def apart(instants: set[float]) -> list[float]:
    """In order, without the start and without those that differ from one before by rounding."""
    found = [0.0]
    for t in sorted(instants):
        if t > found[-1] + 1e-12:
            found.append(t)
    return found[1:]


@pytest.fixture(scope="module", params=["inclined_block", "backspin_hoop", "clocks"])
def case(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Case:
    name = str(request.param)
    model = frot.compile(TEXT) if name == "clocks" else frot.load(MODELS / f"{name}.frot")
    return Case(model, tmp_path_factory.mktemp(name))


@pytest.fixture
def clocks(tmp_path: Path) -> Case:
    return Case(frot.compile(TEXT), tmp_path)


@pytest.fixture
def one(libraries: dict[int, Path]) -> Iterator[Host]:
    """The block on a spring, in step mode."""
    made = Host(libraries[3], 3, event_mode=True, early=True)
    made.start()
    assert made.call("EnterStepMode") == OK
    yield made
    made.free()


@pytest.mark.parametrize("step", [0.7, 3.0])
def test_steps_end_at_the_events_of_simulate_with_its_values(case: Case, step: float) -> None:
    """To the last bit, after each event; what a clock does alone counts too."""
    result = case.model.simulate(stop=3.0)
    one = case.host()
    found = stops(case, one, 3.0, step)
    ticks = {0.25 * k for k in range(1, 13)} if "ticks" in case.reference else set()
    assert [t for t, _ in found] == apart({event.time for event in result.events} | ticks)
    for t, values in found:
        at = result.at(t)
        assert values == [at[name] for name in case.reals]
    final = result.at(one.get(TIME))
    assert case.values(one) == [final[name] for name in case.reals]
    one.free()


def test_events_are_logged_once_though_a_step_is_tried_beyond_them(case: Case) -> None:
    one = case.host()
    stops(case, one, 3.0, 1.0)
    logged = [text for _, category, text in one.messages if category == "logEvents"]
    assert logged == [event.text for event in case.model.simulate(stop=3.0).events]
    one.free()


def test_without_early_return_a_step_tells_of_events_at_its_end(clocks: Case) -> None:
    one = clocks.host(early=False)
    assert one.step(0.0, 0.2) == OK
    assert one.answers == (False, False, False, 0.2)
    assert one.step(0.2, 1.0) == OK
    assert one.answers == (True, False, False, 1.2)
    handle(one)
    one.free()


def test_the_next_instant_of_a_clock_is_told(clocks: Case) -> None:
    one = clocks.host()
    assert one.updated[4:] == (True, 0.25)  # type: ignore[attr-defined]
    assert one.step(0.0, 0.4) == OK
    assert one.answers == (True, False, True, 0.25)
    assert one.get(clocks.reference["n"], "Int32") == 1
    assert one.call("EnterEventMode") == OK
    assert update(one) == OK
    assert one.updated == (False, False, False, False, True, 0.5)  # type: ignore[attr-defined]
    one.free()


def test_what_is_set_in_event_mode_acts_from_that_instant(clocks: Case) -> None:
    """The level rises by 1 a second up to a tick, then by 3."""
    one = clocks.host()
    assert one.step(0.0, 0.4) == OK
    assert one.call("EnterEventMode") == OK
    assert one.set(clocks.reference["feed"], 3.0) == OK
    assert update(one) == OK
    assert one.call("EnterStepMode") == OK
    assert one.step(0.25, 0.125) == OK
    assert one.answers == (False, False, False, 0.375)
    assert one.get(clocks.reference["l"]) == pytest.approx(0.25 + 3 * 0.125, abs=1e-9)
    one.free()


def test_a_push_at_the_instant_of_rest_sets_the_block_moving(one: Host) -> None:
    """Nine half swings, each shorter by 2 mu g/omega^2, then rest (Painlevé 1895, p. 61)."""
    t = 0.0
    while one.get(MODE, "Int64") != 1:
        assert one.step(t, 20.0) == OK
        t = one.answers[3]
        assert one.answers[0] and one.call("EnterEventMode") == OK
        if one.get(MODE, "Int64") != 1:
            assert one.call("EnterStepMode") == OK
    assert t == pytest.approx(9 * math.pi / 3, abs=1e-6)
    rest = one.get(X)
    assert one.get(V) == 0.0
    assert one.set(PUSH, 5.0) == OK
    assert update(one) == OK
    assert one.get(MODE, "Int64") == 2
    assert one.call("EnterStepMode") == OK
    assert one.step(t, 0.1) == OK
    # x'' = push - mu g - 9 x
    acceleration = 5.0 - 0.981 - 9 * rest
    assert one.get(X) - rest == pytest.approx(acceleration * 0.1**2 / 2, rel=1e-2)


def test_a_step_without_end_stops_at_the_first_event(one: Host) -> None:
    begun = time.process_time()
    assert one.step(0.0, 1e300) == OK
    assert one.answers[:3] == (True, False, True)
    assert one.answers[3] == pytest.approx(math.pi / 3, abs=1e-9)
    assert time.process_time() - begun < 0.5


def test_calls_out_of_their_mode_are_refused_with_a_sentence(
    libraries: dict[int, Path], one: Host
) -> None:
    assert one.call("EnterStepMode") == ERROR
    assert "EnterStepMode must not be called between steps" in one.last
    assert update(one) == ERROR
    assert one.call("EnterEventMode") == OK
    assert one.call("EnterEventMode") == ERROR
    assert one.step(0.0, 1.0) == ERROR
    assert "DoStep must not be called in event mode" in one.last
    assert one.call("UpdateDiscreteStates", *[None] * 6) == ERROR
    assert "a pointer to an answer is NULL" in one.last
    assert one.call("Terminate") == OK
    plain = Host(libraries[3], 3)
    plain.start()
    assert plain.call("EnterEventMode") == ERROR
    assert "made without event mode" in plain.last
    assert plain.step(0.0, 12.0) == OK and plain.answers == (False, False, False, 12.0)
    plain.free()


def test_what_is_refused_in_event_mode_leaves_it_there(one: Host) -> None:
    assert one.step(0.0, 0.5) == OK
    assert one.call("EnterEventMode") == OK
    assert one.set(4, -1.0) == OK  # the mass
    assert update(one) == ERROR
    assert "is refused, the former values hold" in one.last
    assert one.set(4, 2.0) == OK
    assert update(one) == OK and one.get(4) == 2.0
    assert one.call("EnterStepMode") == OK
    assert one.step(0.5, 0.1) == OK


def test_a_state_saved_in_event_mode_goes_on(case: Case) -> None:
    """In an instance without event mode too, from the same instant."""
    one = case.host()
    assert one.step(0.0, 3.0) == OK and one.answers[0]
    t = one.answers[3]
    assert one.call("EnterEventMode") == OK
    state = one.save()
    data = one.serialize(state)
    assert one.call("EnterStepMode") == OK
    one.step(t, 0.01)
    expected = case.values(one)
    assert one.restore(state) == OK
    assert one.step(t, 0.01) == ERROR
    assert one.call("EnterStepMode") == OK
    one.step(t, 0.01)
    assert case.values(one) == expected
    plain = Host(case.library, 3, token=case.program.key.encode())
    status, carried = plain.deserialize(data)
    assert status == OK and plain.restore(carried) == OK
    assert plain.step(t, 0.01) == OK
    assert case.values(plain) == expected
    one.free()
    plain.free()


def test_fmpy_runs_it_in_event_mode(case: Case) -> None:
    outputs = [x.name for x in case.program.variables if x.causality == "output"]
    common: dict[str, Any] = {"stop_time": 3.0, "output_interval": 0.1, "output": outputs}
    plain = simulate_fmu(str(case.archive), **common)
    events = simulate_fmu(
        str(case.archive), use_event_mode=True, early_return_allowed=True, **common
    )
    assert len(events) > len(plain)
    for name in outputs:
        assert events[name][-1] == pytest.approx(plain[name][-1], abs=1e-12)
