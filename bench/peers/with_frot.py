"""Frot: the program compiled before, the whole call of `simulate` timed."""

from __future__ import annotations

import time
from functools import partial
from pathlib import Path

import frot
from peers.interface import Outcome, Setting

NAME = "Frot"
TOLERANCES = [10.0**-k for k in range(3, 14)]
NOTES = {
    "block": "the model's text, reaction-dependent law; time of the Python call `simulate`",
    "oscillator": "as above",
    "hoop": "as above, with `rolling_resistance`",
}
_FOLDER = Path(__file__).resolve().parents[1]
_FILES = {
    "block": _FOLDER.parent / "models" / "inclined_block.frot",
    "oscillator": _FOLDER.parent / "models" / "coulomb_oscillator.frot",
    "hoop": _FOLDER / "models" / "hoop.frot",
}
_PARAMETERS: dict[str, dict[str, object]] = {"block": {"v0": 2.0}, "oscillator": {}, "hoop": {}}
_STOP = {"block": 3.0, "oscillator": 12.0, "hoop": 60.0}


def version() -> str:
    from importlib.metadata import version

    return version("frot")


def settings(scene: str) -> list[Setting]:
    model = frot.load(_FILES[scene])
    model.program()
    return [
        Setting(
            "events, order 8", f"tolerance {x:.0e}", "evaluations", partial(_run, model, scene, x)
        )
        for x in TOLERANCES
    ]


def _run(model: frot.Model, scene: str, tolerance: float) -> Outcome:
    stop = _STOP[scene]
    begun = time.perf_counter()
    result = model.simulate(
        stop=stop, tolerance=tolerance, interval=stop, parameters=_PARAMETERS[scene]
    )
    wall = time.perf_counter() - begun
    end = result.at(stop)
    if scene == "block":
        positions, body = (float(end["s"]),), "block"
    elif scene == "oscillator":
        positions, body = (float(end["m.position.x"]),), "m"
    else:
        positions, body = (float(end["x"]), -0.5 * float(end["hoop.angle"])), "hoop"
    rates = [end[f"{body}.velocity.x"], end[f"{body}.velocity.y"]]
    speed = max(abs(float(rate)) for rate in rates)
    return Outcome(positions, speed, wall, result.figures.evaluations, result.figures.wall_time)
