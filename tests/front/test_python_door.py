"""The same from Python: load, simulate, results, messages as exceptions."""

from pathlib import Path

import numpy as np
import pytest
from front_door import HOOP

import frot


@pytest.fixture(scope="module")
def model(warm_cache: object) -> frot.Model:
    text = HOOP.read_text(encoding="utf-8")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("FROT_CACHE", str(warm_cache))
        made = frot.compile(text)
        made.program()
        return made


@pytest.fixture(scope="module")
def result(model: frot.Model) -> frot.Result:
    return model.simulate()


def test_values_at_any_time_are_those_of_the_grid(result: frot.Result) -> None:
    for k in (0, 17, 311, len(result.time) - 1):
        values = result.at(result.time[k])
        assert all(values[name] == result[name][k] for name in values)


@pytest.mark.parametrize("bad", [{"stop": 10**400}, {"parameters": {"mu": -(10**400)}}])
def test_a_number_of_too_many_digits_is_told(bad: dict[str, object], model: frot.Model) -> None:
    with pytest.raises(frot.FrotError, match=r"E0806.*too large"):
        model.simulate(**bad)  # type: ignore[arg-type]


def test_a_place_is_told_in_the_file_that_its_user_names(tmp_path: Path) -> None:
    text = "model M\n parameter Integer n = 2;\n Real x[n] = ones(n);\nend M;\n"
    for name in ("one.frot", "other.frot"):
        (tmp_path / name).write_text(text)
        with pytest.raises(frot.FrotError, match=rf"the size of 'x' .*{name}:3:9"):
            frot.load(tmp_path / name).simulate(parameters={"n": 3})


def test_values_at_many_times_may_be_in_any_order(result: frot.Result) -> None:
    times = np.array([2.5, 0.1, 1.2])
    values = result.at(times)["hoop.position.x"]
    assert values.tolist() == [result.at(t)["hoop.position.x"] for t in times]


@pytest.mark.parametrize("time", [-1e-9, 3.0000001, float("nan"), float("inf"), [1.0, 9.0]])
def test_times_outside_of_the_run_are_refused(time: object, result: frot.Result) -> None:
    with pytest.raises(ValueError, match="the run goes from 0 s to 3 s"):
        result.at(time)  # type: ignore[arg-type]


def test_an_unknown_variable_gets_a_suggestion(result: frot.Result) -> None:
    for values in (result, result.at(1.0)):
        with pytest.raises(KeyError, match=r"no variable 'hoop.postion.x'; did you mean"):
            values["hoop.postion.x"]
    assert "hoop.postion.x" not in result


def test_an_event_has_time_kind_liaison_and_modes(result: frot.Result) -> None:
    (event,) = result.events
    assert (event.kind, event.liaison, event.before, event.after) == (
        "stick",
        "floor",
        "slip",
        "stick",
    )
    # Painlevé: slip 1 + r*20 = 11 m/s, falling at 2 mu g for a hoop.
    assert event.time == pytest.approx(11 / (2 * 0.3 * 9.81), rel=1e-10)


def test_parameters_are_numbers_in_si_or_texts_with_a_unit(model: frot.Model) -> None:
    runs = [
        model.simulate(stop=1, parameters={"r": value})["hoop.position.y"]
        for value in (0.6, "60 cm", "0.6", np.float64(0.6))
    ]
    assert all(np.array_equal(run, runs[0]) for run in runs)
    assert runs[0][0] == 0.6


@pytest.mark.parametrize(
    ("options", "code"),
    [
        ({"parameters": {"radius": 1}}, "E0805"),
        ({"parameters": {"r": None}}, "E0806"),
        ({"parameters": {"r": [1, 2]}}, "E0806"),
        ({"parameters": {"r": float("nan")}}, "E0806"),
        ({"parameters": {"r": "1 kg"}}, "E0806"),
        ({"parameters": {"r": -1}}, "E0401"),
        ({"inputs": {"f": 1}}, "E0805"),
        ({"stop": float("inf")}, "E0806"),
        ({"stop": float("nan")}, "E0806"),
        ({"start": 3.0}, "E0806"),
        ({"tolerance": 1.0}, "E0806"),
        ({"tolerance": float("nan")}, "E0806"),
        ({"interval": 0.0}, "E0806"),
    ],
)
def test_bad_options_raise_the_messages_of_the_command(
    options: dict[str, object], code: str, model: frot.Model
) -> None:
    with pytest.raises(frot.FrotError) as told:
        model.simulate(**options)  # type: ignore[arg-type]
    assert [d.code for d in told.value.diagnostics] == [code]
    assert f"error[{code}]" in str(told.value)


def test_a_fault_in_the_text_is_raised_when_it_is_compiled() -> None:
    with pytest.raises(frot.FrotError, match="E0104") as told:
        frot.compile("planar model M\n  body b: particle(mass = 1 kg);\n")
    assert "<text>:2:" in str(told.value)


def test_a_missing_file_is_raised_when_it_is_loaded() -> None:
    with pytest.raises(frot.FrotError, match="E0804"):
        frot.load("none.frot")


def test_a_run_that_fails_raises_with_the_motion_up_to_there() -> None:
    drop = frot.compile(
        "planar model Drop\n  body b: particle(mass = 1 kg);\n"
        "  liaison floor: contact_ponctuel(b, ground.line);\n"
        "initial\n  b.position = (0, 1) m;\n"
        'equation\n  assert(b.position.y > 0.2 m, "too low");\n'
        "  experiment(stop = 1 s);\nend Drop;\n"
    )
    with pytest.raises(frot.SimulationError, match="E0906") as told:
        drop.simulate()
    result = told.value.result
    assert result is not None
    # Free fall from 1 m to 0.2 m.
    assert result.time[-1] == pytest.approx((1.6 / 9.81) ** 0.5, rel=1e-9)
    assert result["b.position.y"][-1] == pytest.approx(0.2, abs=1e-9)


def test_a_watcher_can_end_the_run(model: frot.Model) -> None:
    seen: list[float] = []

    def watch(time: float) -> bool:
        seen.append(time)
        return len(seen) == 3

    result = model.simulate(stop=1e5, interval=100.0, watch=watch)
    assert len(seen) == 3 and result.time[-1] == seen[-1] < 1e5


def test_a_watcher_that_fails_is_heard(model: frot.Model) -> None:
    def watch(_: float) -> bool:
        raise RuntimeError("watcher")

    with pytest.raises(RuntimeError, match="watcher"):
        model.simulate(stop=1e5, interval=100.0, watch=watch)


def test_results_of_one_model_do_not_disturb_each_other(model: frot.Model) -> None:
    first = model.simulate(parameters={"mu": 0.2})
    before = first.at(1.0)["hoop.position.x"]
    model.simulate(parameters={"mu": 0.9})
    assert first.at(1.0)["hoop.position.x"] == before


def test_an_fmu_for_another_platform_or_version_is_refused(
    model: frot.Model, folder: object
) -> None:
    with pytest.raises(frot.FrotError, match=r"E0806.*no library is made for vax"):
        model.export_fmu("a.fmu", platforms=["vax"])
    with pytest.raises(frot.FrotError, match="E0806"):
        model.export_fmu("a.fmu", fmi="1.0")


def test_an_unknown_name_of_the_package_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="speed"):
        frot.speed  # type: ignore[attr-defined]  # noqa: B018
    assert "load" in frot.__all__ and all(hasattr(frot, name) for name in frot.__all__)
