"""The worked models as FMUs: the same bits as `simulate`, whatever the communication step."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.validation import validate_fmu
from fmu_host import OK, Host, unpack_library

import frot

MODELS = Path(__file__).parents[2] / "models"
NAMES = ("inclined_block", "backspin_hoop", "coulomb_oscillator")
GRAVITY = 9.81


class Case:
    """A model, its archive and its library."""

    def __init__(self, name: str, version: str, folder: Path) -> None:
        self.model = frot.load(MODELS / f"{name}.frot")
        self.program = self.model.program()
        self.archive = folder / f"{name}.fmu"
        self.model.export_fmu(self.archive, version, "native")
        self.library = unpack_library(self.archive, version, folder)
        self.version = int(version[0])
        names = [
            "time",
            *(p.name for p in self.program.parameters),
            *(i.name for i in self.program.inputs),
            *(v.name for v in self.program.variables),
        ]
        self.reference = {name: index for index, name in enumerate(names)}
        self.reals = [v.name for v in self.program.variables if v.type == "real"]
        self.modes = [v.name for v in self.program.variables if v.type == "mode"]

    def host(self) -> Host:
        """A new instance."""
        return Host(self.library, self.version, token=self.program.key.encode())

    def values(self, one: Host) -> list[float]:
        """All variables of an instance, the modes first."""
        return [
            *(one.get(self.reference[name], one.mode_type) for name in self.modes),
            *(one.get(self.reference[name]) for name in self.reals),
        ]


_MADE: dict[tuple[str, str], Case] = {}


@pytest.fixture(params=["2.0", "3.0"])
def fmi_version(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture
def case_of(fmi_version: str, tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Case]:
    def make(name: str) -> Case:
        key = (name, fmi_version)
        if key not in _MADE:
            _MADE[key] = Case(name, fmi_version, tmp_path_factory.mktemp(name))
        return _MADE[key]

    return make


@pytest.fixture(params=NAMES)
def case(request: pytest.FixtureRequest, case_of: Callable[[str], Case]) -> Case:
    return case_of(request.param)


@pytest.fixture
def host() -> Iterator[Callable[[Case], Host]]:
    made: list[Host] = []

    def make(case: Case) -> Host:
        made.append(case.host())
        return made[-1]

    yield make
    for one in made:
        one.free()


def test_fmpy_finds_no_fault(case: Case) -> None:
    assert validate_fmu(str(case.archive)) == []


@pytest.mark.parametrize("interval", [0.003, 0.05, 0.7])
def test_fmu_equals_simulation_to_the_last_bit(case: Case, interval: float) -> None:
    stop = 3.0
    result = case.model.simulate(stop=stop)
    got: Any = simulate_fmu(
        str(case.archive),
        stop_time=stop,
        output_interval=interval,
        output=[*case.modes, *case.reals],
    )
    given = got["time"]
    # The instance adds the step to the point it began at, which rounds.
    reached = np.append(given[:1], given[:-1] + np.diff(given))
    assert len(given) > stop / interval
    expected = result.at(reached)
    for name in (*case.modes, *case.reals):
        assert np.array_equal(got[name], expected[name]), name


def test_whole_run_as_one_step_logs_every_event(case: Case, host: Callable[[Case], Host]) -> None:
    experiment = case.program.experiment
    assert experiment.stop is not None
    result = case.model.simulate()
    one = host(case)
    one.start(tolerance=experiment.tolerance)
    assert one.step(0.0, experiment.stop) == OK
    events = [text for _, category, text in one.messages if category == "logEvents"]
    assert events == [event.text for event in result.events]
    assert events
    final = result.at(experiment.stop)
    assert case.values(one) == [float(final[name]) for name in (*case.modes, *case.reals)]


def test_event_inside_a_step_is_crossed_at_its_time(
    case: Case, host: Callable[[Case], Host]
) -> None:
    event = case.model.simulate().events[0]
    one = host(case)
    one.start()
    assert one.step(0.0, event.time - 1e-3) == OK
    assert one.step(event.time - 1e-3, 2e-3) == OK
    t = (event.time - 1e-3) + 2e-3
    expected = case.model.simulate().at(t)
    assert case.values(one) == [float(expected[name]) for name in (*case.modes, *case.reals)]
    assert one.last == event.text


def test_saved_state_continues_bit_for_bit(case: Case, host: Callable[[Case], Host]) -> None:
    one, two = host(case), host(case)
    one.start()

    def run(instance: Host, begin: int, end: int) -> list[list[float]]:
        rows = []
        for i in range(begin, end):
            assert instance.step(i * 0.125, 0.125) == OK
            rows.append(case.values(instance))
        return rows

    run(one, 0, 5)
    state = one.save()
    data = one.serialize(state)
    expected = run(one, 5, 24)
    assert one.restore(state) == OK
    assert run(one, 5, 24) == expected
    status, carried = two.deserialize(data)
    assert status == OK
    assert two.restore(carried) == OK
    assert run(two, 5, 24) == expected
    assert one.call("Reset") == OK
    one.start()
    run(one, 0, 5)
    assert run(one, 5, 24) == expected


def test_two_instances_interleaved(case: Case, host: Callable[[Case], Host]) -> None:
    alone, a, b = (host(case) for _ in range(3))
    changed = case.program.parameters[0]
    assert b.set(case.reference[changed.name], 1.1 * changed.default) == OK
    for one in (alone, a, b):
        one.start()
    for i in range(12):
        assert alone.step(i * 0.25, 0.25) == OK
    for i in range(12):
        assert a.step(i * 0.25, 0.25) == OK
        assert b.step(i * 0.25, 0.25) == OK
    assert case.values(a) == case.values(alone)
    assert case.values(b) != case.values(a)


def test_another_models_state_is_refused(case_of: Callable[[str], Case]) -> None:
    block, hoop = (case_of(name).host() for name in ("inclined_block", "backspin_hoop"))
    data = block.serialize(block.save())
    assert hoop.deserialize(data)[0] != OK
    block.free()
    hoop.free()


def test_less_friction_sets_a_resting_block_moving(
    case_of: Callable[[str], Case], host: Callable[[Case], Host]
) -> None:
    """From rest, s'' = g (sin slope - mu cos slope)."""
    case = case_of("inclined_block")
    one = host(case)
    one.start()
    for i in range(6):
        assert one.step(0.5 * i, 0.5) == OK
    s = case.reference["s"]
    at_rest = one.get(s)
    assert one.set(case.reference["mu"], 0.1) == OK
    slope = math.radians(20.0)
    acceleration = GRAVITY * (math.sin(slope) - 0.1 * math.cos(slope))
    for i in range(1, 5):
        assert one.step(3.0 + 0.25 * (i - 1), 0.25) == OK
        assert one.get(s) - at_rest == pytest.approx(acceleration * (0.25 * i) ** 2 / 2, rel=1e-3)
    assert one.get(case.reference["mu"]) == 0.1


def test_parameters_before_the_start_act_as_in_simulate(
    case: Case, host: Callable[[Case], Host]
) -> None:
    mu = 0.07
    result = case.model.simulate(parameters={"mu": mu}, stop=2.0)
    one = host(case)
    assert one.set(case.reference["mu"], mu) == OK
    one.start()
    for i in range(8):
        assert one.step(0.25 * i, 0.25) == OK
        expected = result.at(0.25 * (i + 1))
        assert case.values(one) == [float(expected[name]) for name in (*case.modes, *case.reals)]
