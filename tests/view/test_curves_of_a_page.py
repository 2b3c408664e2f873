"""The curves that a page has: all variables of the run, at both sides of each event."""

from __future__ import annotations

import base64

import numpy as np
import pytest
from view_scenes import result_of

import frot
from frot.view.curves import curves_of


def values_of(content: dict, name: str) -> np.ndarray:
    (curve,) = (x for x in content["curves"] if x["name"] == name)
    if not curve["y"]:
        return np.full(len(content["grid"]), curve["first"])
    return curve["first"] + np.frombuffer(base64.b64decode(curve["y"]), dtype=np.float32)


def test_all_variables_are_there_to_seven_digits() -> None:
    result = result_of("backspin_hoop")
    content = curves_of(result)
    grid = np.array(content["grid"])
    assert {x["name"] for x in content["curves"]} == set(result) - {"time"}
    for name in ("hoop.position.x", "floor.slip", "hoop.position.y"):
        exact = result.at(grid)[name]
        scale = np.abs(exact).max()
        assert values_of(content, name) == pytest.approx(exact, abs=2e-7 * scale)
    (event,) = result.events
    assert {event.time, np.nextafter(event.time, 0)} <= set(content["grid"])


def test_modes_are_a_panel_of_their_own_and_the_last() -> None:
    content = curves_of(result_of("backspin_hoop"))
    assert content["panels"][-1] == ["floor.mode"]
    mode = values_of(content, "floor.mode")
    assert set(mode) == {1.0, 2.0}


def test_chosen_ones_are_grouped_by_their_units() -> None:
    """A variable that the run does not list is asked."""
    names = ["hoop.position.x", "floor.normal_force", "hoop.position.y", "hoop.momentum.x"]
    content = curves_of(result_of("backspin_hoop"), names)
    assert content["panels"] == [
        ["hoop.position.x", "hoop.position.y"],
        ["floor.normal_force"],
        ["hoop.momentum.x"],
    ]
    assert values_of(content, "hoop.momentum.x")[0] == pytest.approx(1.0)


def test_a_vector_is_drawn_by_its_components() -> None:
    content = curves_of(result_of("backspin_hoop"), ["hoop.momentum", "floor.slip"])
    assert content["panels"] == [["hoop.momentum.x", "hoop.momentum.y"], ["floor.slip"]]
    with pytest.raises(frot.FrotError, match="did you mean"):
        curves_of(result_of("backspin_hoop"), ["hoop.momentm"])


def test_many_variables_have_fewer_points() -> None:
    """A page of a thousand variables stays below some megabytes."""
    from frot.view.curves import LEAST, MOST_VALUES, grid_of

    result = result_of("backspin_hoop", stop=1.0)
    assert len(grid_of(result, 20)) == 2000
    assert len(grid_of(result, 10_000)) == max(LEAST, MOST_VALUES // 10_000)
