"""Calls in order, calls out of order, wrong arguments: a status and a sentence, never a crash."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable

import pytest
from fmu_host import (
    COUNT,
    DISCARD,
    ERROR,
    MASS,
    MODE,
    MU,
    OK,
    PULLED,
    PUSH,
    STIFFNESS,
    TIME,
    WEIGHT,
    X0,
    Host,
    V,
    X,
)

Make = Callable[..., Host]


def test_block_oscillates_about_shifted_centres_and_rests(host: Make) -> None:
    """Half swings last pi/omega, each shorter by 2 mu g / omega^2 (Painlevé 1895, p. 61)."""
    one = host()
    one.start()
    for n in range(1, 9):
        assert one.step((n - 1) * math.pi / 3, math.pi / 3) == OK
        expected = (-1) ** n * (2.0 - 2 * n * 0.1 * 9.81 / 9.0)
        assert one.get(X) == pytest.approx(expected, abs=1e-8)
    assert one.step(8 * math.pi / 3, 4.0) == OK
    assert one.get(V) == 0.0
    assert one.get(MODE, one.mode_type) == 1


def test_events_inside_a_step_are_logged_with_the_liaison(host: Make) -> None:
    one = host()
    one.start()
    assert one.step(0.0, 12.0) == OK
    events = [text for _, category, text in one.messages if category == "logEvents"]
    assert len(events) == 9
    assert events[-1].startswith("guide: slip -> stick at t = 9.42477796")


def test_results_do_not_depend_on_the_communication_step(host: Make) -> None:
    coarse, fine, silent = host(), host(), host(logging=False)
    for one in (coarse, fine, silent):
        one.start()
    rows = fine.run(0.0, 12.0, 0.0625)
    assert coarse.run(0.0, 12.0, 0.5) == rows[7::8]
    assert silent.run(0.0, 12.0, 0.25) == rows[3::4]


def test_types_of_values(host: Make) -> None:
    one = host()
    assert one.set(COUNT, 5, one.integer) == OK
    assert one.set(PULLED, False, "Boolean") == OK
    assert one.set(MASS, 2.0) == OK
    one.start()
    assert one.get(COUNT, one.integer) == 5
    assert not one.get(PULLED, "Boolean")
    assert one.get(WEIGHT) == pytest.approx(19.62)
    assert one.step(0.0, 1.0) == OK
    assert one.get(X) == 2.0
    assert one.get(TIME) == 1.0


def test_outputs_in_initialization_mode_follow_what_is_set(host: Make) -> None:
    one = host()
    assert one.set(X0, 3.0) == OK
    assert one.try_get(X)[0] == ERROR
    assert one.get(X0) == 3.0
    assert one.setup(start=1.5) == OK
    assert one.get(X) == 3.0
    assert one.get(TIME) == 1.5
    assert one.set(X0, 0.5) == OK
    assert one.set(MASS, 3.0) == OK
    assert one.get(WEIGHT) == pytest.approx(3 * 9.81)
    assert one.get(X) == 0.5
    assert one.call("ExitInitializationMode") == OK
    assert one.get(X) == 0.5


def test_tunable_parameter_and_input_take_effect_at_the_time_reached(host: Make) -> None:
    one = host()
    one.start()
    one.run(0.0, 10.0, 0.5)
    rest = one.get(X)
    assert one.get(V) == 0.0
    assert one.set(PUSH, 0.5) == OK
    assert one.step(10.0, 0.5) == OK
    assert one.get(X) == rest  # not enough to move it
    assert one.set(PUSH, 9.0 * rest + 5.0) == OK
    assert one.get(MODE, one.mode_type) == 2  # slips at once
    assert one.step(10.5, 0.5) == OK
    assert one.get(X) > rest
    assert one.set(MU, 1e6) == OK
    assert one.step(11.0, 0.5) == OK
    assert one.get(V) == 0.0


def test_reset_gives_the_same_bits_and_the_default_values(host: Make) -> None:
    one = host()
    one.start()
    first = one.run(0.0, 3.0, 0.1)
    assert one.set(STIFFNESS, 4.0) == OK
    one.run(one.get(TIME), 4.0, 0.1)
    assert one.call("Reset") == OK
    assert one.get(STIFFNESS) == 9.0
    one.start()
    assert one.run(0.0, 3.0, 0.1) == first


def test_two_instances_interleaved(host: Make) -> None:
    alone, a, b = host(), host(), host()
    alone.start()
    expected = alone.run(0.0, 5.0, 0.25)
    a.start()
    assert b.set(X0, 1.0) == OK
    b.start()
    rows = []
    for i in range(20):
        rows += a.run(i * 0.25, (i + 1) * 0.25, 0.25)
        b.run(i * 0.25, (i + 1) * 0.25, 0.25)
    assert rows == expected
    assert b.get(X) != a.get(X)


def test_the_end_keeps_the_values(host: Make) -> None:
    one = host()
    one.start()
    one.run(0.0, 1.0, 0.5)
    values = one.values()
    assert one.call("Terminate") == OK
    assert one.values() == values
    assert one.step(1.0, 0.5) == ERROR
    assert one.set(MU, 0.2) == ERROR
    assert "after the end" in one.last


def test_misplaced_calls_are_refused_with_a_sentence(host: Make) -> None:
    one = host()
    for call in ("ExitInitializationMode", "Terminate"):
        assert one.call(call) == ERROR
        assert (
            one.last == f"fmi{one.version}{call} must not be called before the initialization mode."
        )
    assert one.step(0.0, 1.0) == ERROR
    one.start()
    assert one.setup() == ERROR
    assert "must not be called between steps" in one.last
    assert one.call("ExitInitializationMode") == ERROR
    assert one.step(0.0, 1.0) == OK


@pytest.mark.parametrize("step", [0.0, -0.1, math.nan, math.inf])
def test_steps_must_be_positive(host: Make, step: float) -> None:
    one = host()
    one.start()
    assert one.step(0.0, step) == ERROR
    assert "not positive" in one.last
    assert one.step(0.0, 0.5) == OK


def test_steps_must_begin_where_the_instance_is(host: Make) -> None:
    one = host()
    one.start(stop=2.0)
    assert one.step(0.5, 0.5) == ERROR
    assert one.last.endswith("the step begins at 0.5 s, but the instance is at 0 s.")
    assert one.step(0.0, 0.5) == OK
    assert one.step(math.nan, 0.5) == ERROR
    assert one.step(0.5 + 1e-13, 0.5) == OK  # rounding of the environment
    assert one.step(1.0, 1.5) == ERROR
    assert "passes the stop time" in one.last
    assert one.step(1.0, 1.0) == OK
    assert one.step(2.0, 1e-20) == ERROR


def test_experiment_is_checked(host: Make) -> None:
    one = host()
    for bad in ({"start": math.nan}, {"start": 1.0, "stop": 0.5}, {"tolerance": -1.0}):
        assert one.setup(**bad) == ERROR
    assert one.setup(start=1.0, stop=2.0, tolerance=1e-6) == OK


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_values_that_are_no_numbers_are_refused_by_name(host: Make, value: float) -> None:
    one = host()
    for reference, name in ((MU, "mu"), (MASS, "block.mass"), (PUSH, "push")):
        before = one.get(reference)
        assert one.set(reference, value) == ERROR
        assert f"the value for '{name}' is not a finite number" in one.last
        assert one.get(reference) == before


def test_wrong_references_types_and_roles(host: Make) -> None:
    one = host()
    one.start()
    assert one.try_get(15)[0] == ERROR
    assert one.last.endswith("there is no value reference 15.")
    assert one.try_get(2**32 - 1)[0] == ERROR
    assert one.try_get(MODE)[0] == ERROR
    assert "'guide.mode' (value reference 9) is not a real number" in one.last
    assert one.try_get(X, one.integer)[0] == ERROR
    assert one.set(X, 1.0) == ERROR
    assert "'x' cannot be set" in one.last
    for reference in (TIME, WEIGHT):
        assert one.set(reference, 1.0) == ERROR
    assert one.set(COUNT, 1.0) == ERROR
    assert one.set(MODE, 1, one.mode_type) == ERROR


def test_one_wrong_value_among_several_sets_none(host: Make) -> None:
    one = host()
    references = (ctypes.c_uint32 * 2)(MU, MASS)
    values = (ctypes.c_double * 2)(0.7, math.nan)
    count = ctypes.c_size_t(2)
    counts = (count,) if one.version == 3 else ()
    assert one.call(f"Set{one.real}", references, count, values, *counts) == ERROR
    assert one.get(MU) == 0.1


def test_no_values_at_all_are_no_error(host: Make) -> None:
    one = host()
    none = ctypes.c_size_t(0)
    for kind in (one.real, one.integer, "Boolean", "String"):
        for way in ("Get", "Set"):
            assert one.call(f"{way}{kind}", None, none, None, none) == OK


def test_null_arguments_are_refused(host: Make) -> None:
    one = host()
    count = ctypes.c_size_t(1)
    references = (ctypes.c_uint32 * 1)(MU)
    assert one.call(f"Get{one.real}", None, count, None, count) == ERROR
    assert one.call(f"Set{one.real}", references, count, None, count) == ERROR
    assert "NULL" in one.last
    for function in ("Reset", "Terminate", "ExitInitializationMode"):
        assert getattr(one.library, f"fmi{one.version}{function}")(None) == ERROR


def test_bad_parameter_is_an_error_that_names_its_subject(host: Make) -> None:
    one = host()
    assert one.set(MASS, -1.0) == OK
    assert one.setup() == OK
    assert one.call("ExitInitializationMode") == ERROR
    assert "mass of body 'block'" in one.last
    assert one.set(MASS, 1.0) == OK
    assert one.call("ExitInitializationMode") == OK


def test_a_bad_parameter_in_a_run_is_refused_and_a_good_one_goes_on(host: Make) -> None:
    """The former value stays, and the motion is that of an instance that never saw the bad one."""
    one, other = host(), host()
    for each in (one, other):
        each.start()
        each.run(0.0, 1.0, 0.5)
    before = one.values()
    assert one.set(MASS, -1.0) == OK
    assert one.step(1.0, 0.5) == ERROR
    assert "mass of body 'block'" in one.last
    assert one.last.endswith("What was set at t = 1 s is refused, the former values hold.")
    assert one.step(1.0, 0.5) == ERROR
    assert "other values must be set" in one.last
    assert one.get(MASS) == 1.0 and one.values() == before
    for each in (one, other):
        assert each.set(MASS, 2.0) == OK
    assert one.run(1.0, 3.0, 0.25) == other.run(1.0, 3.0, 0.25)


def test_a_bad_parameter_is_refused_by_the_first_value_that_is_read(host: Make) -> None:
    one = host()
    one.start()
    one.run(0.0, 1.0, 0.5)
    x = one.get(X)
    assert one.set(MASS, -1.0) == OK
    assert one.try_get(X)[0] == ERROR
    assert "mass of body 'block'" in one.last
    assert one.get(X) == x and one.get(WEIGHT) == pytest.approx(9.81)
    assert one.set(MASS, 1.0) == OK
    assert one.step(1.0, 0.5) == OK


def test_values_that_are_good_only_together_are_set_one_by_one(host: Make) -> None:
    """Nothing is judged before the step: the order in which an environment sets does not count."""
    one = host()
    one.start()
    one.run(0.0, 1.0, 0.5)
    assert one.set(MASS, -1.0) == OK
    assert one.set(MU, 0.2) == OK
    assert one.set(MASS, 1.0) == OK
    assert one.step(1.0, 0.5) == OK
    assert one.get(MU) == 0.2


def test_an_end_after_a_refusal_is_no_error(host: Make) -> None:
    one = host()
    one.start()
    one.run(0.0, 1.0, 0.5)
    assert one.set(MASS, -1.0) == OK
    assert one.call("Terminate") == OK
    assert one.set(MASS, 1.0) == ERROR


def test_a_bad_value_that_came_with_a_saved_state_is_refused_as_well(host: Make) -> None:
    one = host()
    one.start()
    one.run(0.0, 1.0, 0.5)
    assert one.set(MASS, -1.0) == OK
    bad = one.save()
    assert one.set(MASS, 1.0) == OK
    assert one.restore(bad) == OK
    assert one.step(1.0, 0.5) == ERROR and one.get(MASS) == 1.0
    assert one.set(MASS, 2.0) == OK
    assert one.step(1.0, 0.5) == OK


def test_a_force_without_number_discards_the_step(host: Make) -> None:
    """The motion up to the fault stays, and so does the sentence."""
    one = host()
    one.start()
    one.run(0.0, 1.0, 0.5)
    assert one.set(STIFFNESS, 1e308) == OK
    assert one.step(1.0, 1.0) == DISCARD
    status, category, text = one.messages[-1]
    assert (status, category) == (DISCARD, "logStatusDiscard")
    assert "no finite number" in text or "step goes to zero" in text
    if one.version == 3:
        handling, terminate, early, reached = one.answers
        assert (handling, terminate, early) == (False, True, False)
    else:
        value, flag = ctypes.c_double(), ctypes.c_int()
        assert one.call("GetRealStatus", 2, ctypes.byref(value)) == OK
        assert one.call("GetBooleanStatus", 3, ctypes.byref(flag)) == OK
        assert flag.value == 1
        reached = value.value
    assert reached >= 1.0
    assert one.get(TIME) == reached
    assert one.step(1.0, 1.0) == DISCARD
    assert one.messages[-1][2] == text or "other values must be set" in one.last
    assert one.call("Terminate") == OK


def test_instantiation_is_refused_with_a_sentence(host: Make) -> None:
    for options, part in (
        ({"token": b"another"}, "the token 'another' is not that of this model"),
        ({"token": None}, "token"),
        ({"name": b" "}, "the instance name is empty"),
        ({"name": None}, "the instance name is empty"),
    ):
        one = host(logging=False, **options)
        assert one.instance is None
        assert part in one.last


def test_abilities_not_declared_are_refused(host: Make, version: int) -> None:
    if version == 2:
        one = host(kind=0)
        assert one.instance is None
        one = host()
        for name in ("EnterEventMode", "EnterContinuousTimeMode", "CancelStep"):
            assert one.call(name) == ERROR
        assert one.call("GetDerivatives", None, ctypes.c_size_t(0)) == ERROR
        assert "made for co-simulation" in one.last or "not offered" in one.last
    else:
        one = host()
        for name in ("EnterEventMode", "EnterStepMode", "EnterConfigurationMode"):
            assert one.call(name) == ERROR
        for name in ("ModelExchange", "ScheduledExecution"):
            make = getattr(one.library, f"fmi3Instantiate{name}")
            make.restype = ctypes.c_void_p
            assert make(b"one", b"hand-model-key", None, *[None] * 7) is None
        assert one.call("GetVariableDependencies", 0, *[None] * 5) == ERROR
        assert "not offered" in one.last


def test_log_categories(host: Make) -> None:
    one = host(logging=False)
    one.start()
    assert one.step(0.0, 2.0) == OK
    assert one.step(0.0, 2.0) == ERROR
    assert one.messages == []
    assert one.log(True, b"logStatusError") == OK
    assert one.step(2.0, 2.0) == OK
    assert one.messages == []
    assert one.step(0.0, 2.0) == ERROR
    assert [category for _, category, _ in one.messages] == ["logStatusError"]
    assert one.log(True, b"logEvents", b"logPoetry") == ERROR
    assert "no log category 'logPoetry'" in one.last
    assert one.log(True) == OK
    assert one.step(4.0, 2.0) == OK
    assert one.messages[-1][1] == "logEvents"
    one.messages.clear()
    assert one.log(False) == OK
    assert one.step(6.0, 1.0) == OK
    assert one.step(0.0, 2.0) == ERROR
    assert one.messages == []


def test_memory_of_the_environment_is_left_alone(host: Make, version: int) -> None:
    if version == 3:  # FMI 3.0 has no such callbacks
        return
    one = host(allocator=True)
    one.start()
    one.save()
    one.drop(one.save())
    assert not one.allocated
