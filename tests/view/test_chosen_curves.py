"""Chosen curves: one unit an axis, runs compared, variables against each other."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from frot.runtime.curves import draw_curves
from in_process import command
from view_scenes import MODELS, result_of

import frot


def named(axis: object) -> list[str]:
    lines = axis.get_lines()  # type: ignore[attr-defined]
    return [x.get_label() for x in lines if not x.get_label().startswith("_")]


def test_curves_of_one_unit_share_an_axis() -> None:
    result = result_of("backspin_hoop")
    names = ["hoop.position.x", "floor.normal_force", "hoop.position.y", "floor.mode"]
    figure = draw_curves(result, names)
    assert [axis.get_ylabel() for axis in figure.axes] == ["m", "N", ""]
    assert named(figure.axes[0]) == ["hoop.position.x (m)", "hoop.position.y (m)"]
    assert [x.get_text() for x in figure.axes[2].get_yticklabels()] == ["floor.mode"]
    # the event is marked on every axis of curves
    (event,) = result.events
    for axis in figure.axes[:2]:
        marks = [x for x in axis.get_lines() if x.get_label() == "_event"]
        assert [x.get_xdata()[0] for x in marks] == [event.time]


def test_a_curve_is_the_run_to_the_last_digit_and_has_its_corners() -> None:
    """The slip comes to zero at t = 11/(0.3*9.81)/2: both sides of that instant are drawn."""
    result = result_of("backspin_hoop")
    line = draw_curves(result, ["floor.slip"]).axes[0].get_lines()[0]
    assert np.array_equal(line.get_ydata(), result.at(line.get_xdata())["floor.slip"])
    assert result.events[0].time in line.get_xdata()


def test_runs_are_compared_by_their_styles_of_line() -> None:
    runs = {f"mu = {mu}": result_of("backspin_hoop", parameters={"mu": mu}) for mu in (0.1, 0.3)}
    figure = draw_curves(runs, ["floor.slip", "floor.mode"])
    assert named(figure.axes[0]) == ["floor.slip (m/s), mu = 0.1", "floor.slip (m/s), mu = 0.3"]
    styles = {x.get_linestyle() for x in figure.axes[0].get_lines() if x.get_label()[0] != "_"}
    assert len(styles) == 2
    assert len(figure.axes[1].get_yticklabels()) == 2


def test_a_phase_plane_has_one_variable_over_the_other() -> None:
    """Free vibrations at the frequency w: (w x)^2 + v^2 shrinks from one turn to the next."""
    result = result_of("coulomb_oscillator")
    figure = draw_curves(result, ["m.position.x", "m.velocity.x"], xy=True)
    (axis,) = figure.axes
    assert (axis.get_xlabel(), axis.get_ylabel()) == ("m.position.x (m)", "m.velocity.x (m/s)")
    line = axis.get_lines()[0]
    assert line.get_xdata()[0] == result["m.position.x"][0]
    assert line.get_ydata()[-1] == result["m.velocity.x"][-1]


@pytest.mark.parametrize(
    ("names", "xy", "words"),
    [
        (["hoop.positon.x"], False, r"no variable 'hoop.positon.x'"),
        ([], False, "no curves"),
        (["hoop.position.x"], True, "pairs"),
    ],
)
def test_what_cannot_be_drawn_is_refused(names: list[str], xy: bool, words: str) -> None:
    with pytest.raises(frot.FrotError, match=words):
        draw_curves(result_of("backspin_hoop"), names, xy)


def test_the_command_draws_a_run_for_each_value(tmp_path: Path) -> None:
    target = tmp_path / "compared.svg"
    words = ["plot", str(MODELS / "backspin_hoop.frot"), "--compare", "mu=0.1,0.2"]
    words += ["--curves", "hoop.position.x,floor.slip", "-o", str(target)]
    done = command(tmp_path, *words)
    assert done.returncode == 0, done.stderr
    assert target.read_text("utf-8").count("mu = 0.1") >= 2


def test_the_command_tells_the_nearest_name(tmp_path: Path) -> None:
    words = ["plot", str(MODELS / "backspin_hoop.frot"), "--curves", "hoop.positon.x"]
    done = command(tmp_path, *words, "-o", "a.png")
    assert done.returncode == 1
    assert "did you mean 'hoop.position.x'?" in done.stderr
