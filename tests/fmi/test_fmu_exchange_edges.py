"""Model exchange over edges: features of figures that come to zero at one instant end together."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from fmpy import simulate_fmu

import frot

MODELS = Path(__file__).parents[2] / "models"
# The box stands askew the other way, a million times as heavy; the ramp is steeper.
CHANGED = {
    "box_off_a_table": (("yaw     = 25 deg", "yaw = -25 deg"), ("m        = 2 kg", "m = 2e6 kg")),
    "roller_off_a_ramp": (
        ("slope = 20 deg", "slope = 24 deg"),
        ("mass = 3 kg", "mass = 3e6 kg"),
        ("1e-11", "1e-7"),
    ),
}
# Events of such a corner.
BEARS_NOTHING = 2


@pytest.mark.parametrize("name", CHANGED)
def test_what_passes_an_edge_keeps_its_events(tmp_path: Path, name: str) -> None:
    """A box that tips over an edge and a cylinder that rolls round one, by CVODE through FMI 3.0.

    The place is that of `simulate` to a thousand tolerances. So are the events, but for a corner of
    the box that bears nothing beside three others: that it parts and touches moves nothing.
    """
    text = (MODELS / f"{name}.frot").read_text("utf-8")
    for old, new in CHANGED[name]:
        assert old in text
        text = text.replace(old, new)
    model = frot.compile(text)
    expected = model.simulate(tolerance=1e-10)
    model.export_fmu(tmp_path / "m.fmu", "3.0", "native")
    body = "load" if name.startswith("box") else "roller"
    places = [f"{body}.position.{axis}" for axis in "xyz"]
    for tolerance in (1e-6, 1e-8):
        told: list[str] = []
        got = simulate_fmu(
            str(tmp_path / "m.fmu"),
            fmi_type="ModelExchange",
            relative_tolerance=tolerance,
            output=places,
            record_events=False,
            debug_logging=True,
            logger=lambda *message, told=told: told.append(str(message[-1])),
        )
        other = expected.at(got["time"])
        for place in places:
            assert np.abs(got[place] - other[place]).max() < 1000 * tolerance
        assert abs(len(told) - len(expected.events)) <= BEARS_NOTHING
