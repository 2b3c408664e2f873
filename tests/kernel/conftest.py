from __future__ import annotations

import ctypes as ct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from frot.runtime.program import Program
from frot.runtime.result import Result
from frot.runtime.run import simulate
from small_models import Small, build

import frot

MODELS = Path(__file__).parents[2] / "models"
NAMES = ("inclined_block", "backspin_hoop", "coulomb_oscillator")


@pytest.fixture(scope="session")
def programs() -> dict[str, Program]:
    return {name: frot.load(MODELS / f"{name}.frot").program() for name in NAMES}


@pytest.fixture(scope="session")
def kernel(programs: dict[str, Program]) -> ct.CDLL:
    """The kernel's functions; every program's library holds them."""
    library = ct.CDLL(str(programs["inclined_block"].library))
    library.frot_first_fall.restype = ct.c_double
    library.frot_bernstein.restype = ct.c_double
    return library


@pytest.fixture(scope="session")
def run(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Result]:
    """Compiles a small model, once for each name, and runs it as `simulate` does."""
    folder = tmp_path_factory.mktemp("small")
    made: dict[str, Program] = {}

    def run(model: Small, **options: Any) -> Result:
        if model.name not in made:
            made[model.name] = build(model, folder / model.name)
        return simulate(made[model.name], **options)

    return run
