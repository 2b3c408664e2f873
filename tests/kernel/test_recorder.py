"""No event is lost: an instant that brings more events than the recorder has room for drains it."""

from __future__ import annotations

import ctypes as ct

import pytest
from frot.runtime import engine as engine_module
from frot.runtime.engine import OK, Engine
from frot.runtime.library import RawEvent, Recorder

import frot

# At 0.5 s `k` switches between 0 and 1 in 60 rounds; each round is an event of `k > 0.5`.
ROUNDS = """
model Rounds
  Integer n(start = 0);
  Real k(start = 0);
  Real x(start = 0);
initial
  x = 0;
equation
  der(x) = 1 1/s;
  when x > 0.5 then
    k = 1;
    n = 1;
  elsewhen k > 0.5 and n < 60 then
    k = 0;
    n = pre(n) + 1;
  elsewhen k < 0.5 and n > 0 and n < 60 then
    k = 1;
    n = pre(n) + 1;
  end when;
  experiment(stop = 1 s);
end Rounds;
"""


@pytest.fixture(scope="module")
def program() -> frot.Program:
    return frot.compile(ROUNDS).program()


def started(program: frot.Program) -> Engine:
    engine = Engine(program)
    assert engine.start(0.0, 0.0, "rest") == OK
    return engine


def test_the_instant_brings_more_events_than_the_reserve(program: frot.Program) -> None:
    engine = started(program)
    reserve = engine._library.frot_events_at_once(engine._model)
    assert len(engine.advance(1.0).events) > reserve


def test_a_small_recorder_gives_the_events_of_a_large_one(
    program: frot.Program, monkeypatch: pytest.MonkeyPatch
) -> None:
    large = started(program).advance(1.0).events
    monkeypatch.setattr(engine_module, "_EVENTS", 0)
    engine = started(program)
    small = engine.advance(1.0).events
    assert [(e.t, e.kind, e.contact, e.after) for e in small] == [
        (e.t, e.kind, e.contact, e.after) for e in large
    ]
    assert len(small) == engine.statistics.events


def test_events_without_room_are_counted(program: frot.Program) -> None:
    """A host in C that gives no `drain` learns how many events it has missed."""
    engine = started(program)
    reserve = engine._library.frot_events_at_once(engine._model)
    events = (RawEvent * reserve)()
    recorder = Recorder(None, 0, 0, events, reserve, 0)
    call = engine._library.frot_advance
    status = call(engine._model, engine._s, engine._w, 1.0, ct.byref(recorder), None, None)
    assert status == OK
    assert recorder.lost > 0
    assert recorder.event_count + recorder.lost == engine.statistics.events
