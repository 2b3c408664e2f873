"""Every variable of the language can be asked of a result; results are kept, named, tabled."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest
from view_scenes import result_of

import frot

PENDULUM = """
planar model Pendulum "A stick on a smooth pin"
  parameter Length l = 2 m;
  body stick: rod(mass = 3 kg, length = l);
  frame mark on stick at (0.25, 0) m rotated(angle = 90 deg);
  liaison pin: rotoide(ground, stick.start);
initial
  pin.angle = 0;
  experiment(stop = 1 s, tolerance = 1e-11);
end Pendulum;
"""


def test_points_and_frames_have_their_velocities() -> None:
    """The tip is at l (cos a, sin a): its velocity is l w (-sin a, cos a)."""
    result = frot.compile(PENDULUM).simulate()
    angle, rate = result["stick.angle"], result["stick.angular_velocity"]
    tip = result["stick.tip.velocity"]
    exact = 2 * rate[:, None] * np.column_stack((-np.sin(angle), np.cos(angle)))
    assert tip == pytest.approx(exact, abs=1e-12)
    assert result["stick.tip.velocity.y"] == pytest.approx(exact[:, 1], abs=1e-12)
    assert result["mark.ex.x"] == pytest.approx(-np.sin(angle), abs=1e-12)
    assert result["stick.momentum"] == pytest.approx(
        3 * np.column_stack((result["stick.velocity.x"], result["stick.velocity.y"])), abs=1e-12
    )


@pytest.mark.parametrize("length", ["2 m", "50 cm"])
def test_a_reaction_that_the_run_did_not_need_is_found(length: str) -> None:
    """Newton's law for the stick: R = m (a - g), g downwards; with another parameter too."""
    result = frot.compile(PENDULUM).simulate(parameters={"l": length})
    assert "pin.force.x" not in result
    force = result["pin.force"]
    a = np.column_stack((result["stick.acceleration.x"], result["stick.acceleration.y"] + 9.81))
    assert force == pytest.approx(3 * a, abs=1e-7)
    assert result.unit("pin.force.x") == "N"


def test_variables_are_asked_at_times_in_any_order() -> None:
    result = frot.compile(PENDULUM).simulate()
    times = np.array([0.9, 0.1, 0.5])
    asked = result.ask(["stick.tip.position.x", "stick.angle"], times)
    assert asked["stick.tip.position.x"] == pytest.approx(
        2 * np.cos(result.at(times)["stick.angle"]), abs=1e-12
    )
    assert np.array_equal(asked["stick.angle"], result.at(times)["stick.angle"])


def test_inputs_over_time_are_those_of_the_run_where_it_is_asked() -> None:
    text = PENDULUM.replace("initial", "  force f: on(stick.tip, value = (0 N, F));\ninitial")
    text = text.replace("  body", "  input Force F(start = 0 N);\n  body", 1)
    result = frot.compile(text).simulate(inputs={"F": ([0, 0.5, 0.5, 1], [0, 10, -20, 5])})
    force = result["pin.force.y"]
    push = np.where(result.time < 0.5, 20 * result.time, -20 + 50 * (result.time - 0.5))
    exact = 3 * (result["stick.acceleration.y"] + 9.81) - push
    assert force == pytest.approx(exact, abs=1e-6)
    tip = result["stick.tip.acceleration"]
    angle, rate = result["stick.angle"], result["stick.angular_velocity"]
    along = np.sum(tip * np.column_stack((np.cos(angle), np.sin(angle))), axis=1)
    assert along == pytest.approx(-2 * rate**2, abs=1e-9)


def test_an_unknown_name_gets_its_nearest_and_known_ones_are_offered() -> None:
    result = frot.compile(PENDULUM).simulate()
    with pytest.raises(KeyError, match=r"did you mean 'stick.tip.velocity"):
        result["stick.tip.velocty"]
    with pytest.raises(frot.FrotError, match=r"no variable 'stck.angle'"):
        result.ask(["stck.angle"])
    offered = result._ipython_key_completions_()
    assert {"stick.angle", "pin.force.x", "mark.ey.y", "stick.start.acceleration.y"} <= set(offered)


def test_a_result_comes_back_from_its_pickle() -> None:
    """Values at any time, events, and what is asked of it."""
    result = result_of("backspin_hoop")
    again = pickle.loads(pickle.dumps(result))
    times = np.array([0.3, 1.9])
    for name in ("hoop.position.x", "floor.tangential_force"):
        assert np.array_equal(again[name], result[name])
        assert np.array_equal(again.at(times)[name], result.at(times)[name])
    assert again.events == result.events
    assert again.balance == result.balance
    assert np.array_equal(again["hoop.momentum.x"], result["hoop.momentum.x"])


def test_a_pickle_keeps_inputs_over_time() -> None:
    text = PENDULUM.replace("initial", "  force f: on(stick.tip, value = (0 N, F));\ninitial")
    text = text.replace("  body", "  input Force F(start = 0 N);\n  body", 1)
    result = frot.compile(text).simulate(inputs={"F": ([0, 1], [0, 10])})
    again = pickle.loads(pickle.dumps(result))
    assert np.array_equal(again["stick.acceleration.y"], result["stick.acceleration.y"])


def test_results_say_what_they_are() -> None:
    model = frot.compile(PENDULUM)
    result = model.simulate()
    assert repr(result).startswith("<Result of Pendulum: 0 s to 1 s, 0 events, ")
    assert repr(model) == "<Model Pendulum of <text>>"
    assert result._repr_html_().startswith('<iframe srcdoc="')
    assert 'src="data:image/png;base64,' in model._repr_html_()


def test_columns_of_a_file_carry_their_units(tmp_path: Path) -> None:
    result = result_of("backspin_hoop")
    result.save(tmp_path / "plain.csv")
    result.save(tmp_path / "units.csv", units=True)
    plain, units = (
        (tmp_path / f"{name}.csv").read_text().splitlines() for name in ("plain", "units")
    )
    assert plain[1:] == units[1:]
    head = dict(zip(plain[0].split(","), units[0].split(","), strict=True))
    assert head["time"] == "time (s)"
    assert head["hoop.velocity.x"] == "hoop.velocity.x (m/s)"
    assert head["floor.mode"] == "floor.mode"


def test_the_version_and_the_names_of_the_package() -> None:
    assert frot.__version__ == "0.1.0"  # type: ignore[attr-defined]
    assert {"load", "compile", "Model", "Result", "__version__"} <= set(dir(frot))
    shown = [name for name in dir(frot) if not name.startswith("_")]
    assert sorted(shown) == sorted(frot.__all__)


def test_a_frame_of_pandas_has_the_grid_as_its_index() -> None:
    result = result_of("backspin_hoop")
    frame = result.to_frame()
    assert frame.index.name == "time"
    assert np.array_equal(frame.index.to_numpy(), result.time)
    assert np.array_equal(frame["hoop.position.x"].to_numpy(), result["hoop.position.x"])
    assert frame.attrs["units"]["floor.normal_force"] == "N"


def test_a_series_of_pandas_is_an_input_over_time() -> None:
    import pandas

    text = PENDULUM.replace("initial", "  force f: on(stick.tip, value = (0 N, F));\ninitial")
    model = frot.compile(text.replace("  body", "  input Force F(start = 0 N);\n  body", 1))
    series = pandas.Series([0.0, 10.0, 5.0], index=[0.0, 0.5, 1.0])
    one = model.simulate(inputs={"F": series})
    two = model.simulate(inputs={"F": ([0, 0.5, 1], [0, 10, 5])})
    assert np.array_equal(one["stick.angle"], two["stick.angle"])


@pytest.mark.parametrize("name", ["bell_and_clapper", "slack_threads", "rolling_cone"])
def test_all_that_is_offered_can_be_asked(name: str) -> None:
    result = result_of(name, stop=0.2)
    names = result._ipython_key_completions_()
    assert len(names) > 40
    values = result.ask(names)
    assert [x for x in names if not np.all(np.isfinite(values[x]))] == []


def test_the_items_of_an_orientation_are_read_by_their_names() -> None:
    """`.w .x .y .z` are `[1]` to `[4]`, of bodies, liaisons, points and frames, at any time."""
    result = frot.compile(
        """
model M
  body b: box(mass = 1 kg, size = (1, 2, 3) m);
  frame f on b at (1, 0, 0) m rotated(axis = x, angle = 0.3);
  liaison k: spherique(ground, b.top);
initial
  b.angular_velocity = (1, 2, 3) rad/s;
  experiment(stop = 0.1 s);
end M;
"""
    ).simulate()
    for owner in ("b", "k", "b.top", "f"):
        for number, item in enumerate("wxyz", 1):
            name = f"{owner}.orientation.{item}"
            assert np.array_equal(result[name], result[f"{owner}.orientation[{number}]"])
    assert result.at(0.05)["b.orientation.w"] == result.at(0.05)["b.orientation[1]"]
    assert result.unit("f.orientation.x") == "1"
    with pytest.raises(KeyError, match=r"no variable 'b\.orientation\.v'"):
        result["b.orientation.v"]
