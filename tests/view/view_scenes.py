"""Scenes of models for the tests of pictures."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import frot
from frot.view.parts import Scene
from frot.view.show import scene

MODELS = Path(__file__).parents[2] / "models"


def result_of(name: str, **options: object) -> frot.Result:
    return frot.load(MODELS / f"{name}.frot").simulate(**options)  # type: ignore[arg-type]


def scene_at(result: frot.Result, times: list[float]) -> Scene:
    return scene(result, np.array(times))
