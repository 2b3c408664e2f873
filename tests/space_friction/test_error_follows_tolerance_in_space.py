"""Errors of stops, departures and end states in space at each tolerance from 1e-3 to 1e-11."""

from __future__ import annotations

import math

import pytest
from space_models import loaded

GROOVE = 2 / (0.3 * 9.81 * math.sqrt(2))
PERIOD = 0.64961830895930177
ROLLED = 7.135575942915392

# model, parameters, times of events, variables at the end and their values
TABLE = [
    ("inclined_plane", {}, [0.4760420859136214],
     {"across": 0.39290643419627985, "up": 0.5291389183987916}),
    ("rough_sphere", {}, [], {"speed": 0.5}),
    ("rough_turning_plane", {}, [],
     {"x": 1.9834138564369534, "bead.position.z": -1.388556095712326}),
    ("sphere_on_plane", {"spin": 7}, [0.2649841088094011], {"across": 2.7194231230203663}),
    ("shaken_block", {},
     [0.133887601620939314, 0.489194975907132119, 0.633887601620939314, 0.989194975907132119,
      1.133887601620939314], {}),
    ("belt_oscillator", {},
     [0.2, 0.05 + PERIOD, 0.2 + PERIOD, 0.05 + 2 * PERIOD, 0.2 + 2 * PERIOD, 0.05 + 3 * PERIOD],
     {"along": 0.2 * (2 - 0.05 - 3 * PERIOD) + 0.01}),
    ("rolling_resistance", {"vx": -0.6, "vy": 0.8}, [ROLLED],
     {"across": -0.3 * ROLLED, "up": 0.4 * ROLLED}),
    ("v_groove", {}, [GROOVE] * 2, {"slider.position.x": GROOVE}),
]  # fmt: skip


@pytest.mark.parametrize("tolerance", [1e-3, 1e-5, 1e-7, 1e-9, 1e-11])
@pytest.mark.parametrize(("name", "parameters", "times", "values"), TABLE)
def test_events_and_end_states_are_as_exact_as_the_tolerance(
    name: str,
    parameters: dict[str, float],
    times: list[float],
    values: dict[str, float],
    tolerance: float,
) -> None:
    result = loaded(name).simulate(parameters=parameters, tolerance=tolerance)
    bound = 0.1 * tolerance + 2e-12
    assert [event.time for event in result.events] == pytest.approx(times, abs=bound)
    found = {key: float(result[key][-1]) for key in values}
    assert found == pytest.approx(values, abs=bound)
