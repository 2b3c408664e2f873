"""The instance as one block: saved, restored, run in pieces, run beside another."""

from __future__ import annotations

import ctypes as ct

import numpy as np
import pytest
from frot.runtime.engine import OK, Engine
from frot.runtime.library import RawEvent
from frot.runtime.program import Program

STOPS = {"inclined_block": 3.0, "backspin_hoop": 3.0, "coulomb_oscillator": 12.0}


def started(program: Program) -> Engine:
    engine = Engine(program)
    assert engine.start(0.0, 1e-9, "rest") == OK
    return engine


@pytest.mark.parametrize("name", STOPS)
def test_a_run_in_pieces_is_the_whole_run_to_the_last_bit(
    programs: dict[str, Program], name: str
) -> None:
    whole, pieces = started(programs[name]), started(programs[name])
    expected = whole.advance(STOPS[name]).segments
    times = np.linspace(0, STOPS[name], 237)[1:]
    found = np.concatenate([pieces.advance(t).segments for t in times])
    assert np.array_equal(found.view(np.uint64), expected.view(np.uint64))


def run_unseen(engine: Engine, t: float) -> None:
    """To time t, where nobody records what is between the steps."""
    instance = (engine._model, engine._s, engine._w)
    assert engine._library.frot_advance(*instance, t, None, None, None) == OK


@pytest.mark.parametrize("name", STOPS)
def test_the_motion_does_not_depend_on_who_looks(programs: dict[str, Program], name: str) -> None:
    """Three evaluations make the dense output of a step: where nothing can fall they are made only
    where somebody looks, and are no part of the run."""
    seen, unseen = started(programs[name]), started(programs[name])
    expected = seen.advance(STOPS[name]).segments
    run_unseen(unseen, STOPS[name] / 2)
    assert unseen.statistics.steps > 0
    found = unseen.advance(STOPS[name]).segments
    assert len(found) > 0
    assert np.array_equal(found.view(np.uint64), expected[-len(found) :].view(np.uint64))
    assert seen.statistics.evaluations == unseen.statistics.evaluations


@pytest.mark.parametrize("name", STOPS)
def test_a_restored_instance_goes_on_to_the_same_bits(
    programs: dict[str, Program], name: str
) -> None:
    engine = started(programs[name])
    engine.advance(STOPS[name] / 3)
    saved = engine.save()
    first = engine.advance(STOPS[name])
    other = Engine(programs[name])
    other.restore(saved)
    second = other.advance(STOPS[name])
    assert np.array_equal(first.segments.view(np.uint64), second.segments.view(np.uint64))
    assert [e.t for e in first.events] == [e.t for e in second.events]
    assert engine.save() == other.save()


def test_two_instances_side_by_side_do_not_disturb_each_other(
    programs: dict[str, Program],
) -> None:
    program = programs["coulomb_oscillator"]
    alone = started(program).advance(12.0).segments
    one, two = started(program), started(program)
    two.set_parameter(0, 0.3)
    assert two.settle() == OK
    found = []
    for t in np.linspace(0, 12, 49)[1:]:
        found.append(one.advance(t).segments)
        two.advance(t)
    assert np.array_equal(np.concatenate(found).view(np.uint64), alone.view(np.uint64))


def test_a_parameter_changed_on_the_way_acts_from_there(programs: dict[str, Program]) -> None:
    """Block on a slope (Painlevé 1895, p. 58): with more friction from t = 1 it stops earlier."""
    engine = started(programs["inclined_block"])
    engine.advance(1.0)
    mu = [p.name for p in programs["inclined_block"].parameters].index("mu")
    engine.set_parameter(mu, 0.8)
    events = engine.advance(3.0).events
    g, slope = 9.81, np.deg2rad(20)
    v = 3 - g * (0.5 * np.cos(slope) - np.sin(slope))
    expected = 1 + v / (g * (0.8 * np.cos(slope) - np.sin(slope)))
    assert [e.t for e in events] == pytest.approx([expected], rel=1e-12)


def test_the_energy_balance_survives_a_changed_parameter(programs: dict[str, Program]) -> None:
    program = programs["coulomb_oscillator"]
    engine = started(program)
    engine.advance(2.0)
    engine.set_parameter([p.name for p in program.parameters].index("k"), 25.0)
    engine.advance(12.0)
    residual, scale = engine.energy()[:2]
    assert abs(residual) < 1e-9 * scale


# Which indices the sentence of a fault looks up in tables of the model, by its status.
LOOKED_UP = {
    **dict.fromkeys((10, 22, 23, 30, 32, 33, 34), ("item",)),
    **dict.fromkeys((11, 16, 17), ("item", "other")),
    **dict.fromkeys((18, 31), ("other",)),
}


@pytest.mark.parametrize("status", range(40))
@pytest.mark.parametrize("field", ["contact", "item", "other"])
def test_a_state_whose_fault_names_nothing_of_the_model_is_refused(
    programs: dict[str, Program], status: int, field: str
) -> None:
    """A damaged FMU state must not be read outside of the tables of the model."""
    engine = started(programs["backspin_hoop"])
    library, instance = engine._library, (engine._model, engine._s)
    valid = library.frot_state_valid
    valid.restype, valid.argtypes = ct.c_int, (ct.c_void_p, ct.c_void_p, ct.c_size_t)
    size = len(engine.save())
    assert valid(*instance, size)
    fault = library.frot_last_fault(engine._s).contents
    read = ("contact", *LOOKED_UP.get(status, ()))
    for index in (-(2**31), -1000, 1000, 2**31 - 1):
        fault.status, fault.contact, fault.item, fault.other = status, -1, -1, -1
        if status in (10, 23, 30, 32, 33, 34):  # their sentences need an entry
            fault.item = 0
        setattr(fault, field, index)
        expected = field not in read and holds_entries(status)
        assert bool(valid(*instance, size)) == expected
        if valid(*instance, size):
            assert engine.fault_text is not None
            assert engine.fault_places is not None


def holds_entries(status: int) -> bool:
    """Whether the hoop has what the fault is about: the hoop has no equations or events."""
    return status not in (23, 30, 33, 34)


def test_the_number_of_motions_is_a_lower_bound_where_no_more_are_counted(
    programs: dict[str, Program],
) -> None:
    engine = started(programs["backspin_hoop"])
    several, most = 10, 31

    def sentence(solutions: int) -> str:
        text = ct.create_string_buffer(256)
        event = RawEvent(0.0, several, 0, 0, 0, solutions, 0)
        engine._library.frot_event_text(engine._model, ct.byref(event), text, 256)
        return text.value.decode()

    assert ": 30 motions are admissible" in sentence(most - 1)
    assert ": at least 31 motions are admissible" in sentence(most)
