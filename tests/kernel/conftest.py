from __future__ import annotations

import ctypes as ct
from pathlib import Path

import pytest
from frot.runtime.program import Program

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
