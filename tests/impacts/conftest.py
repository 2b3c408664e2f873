from __future__ import annotations

import ctypes as ct
from pathlib import Path

import pytest

import frot

MODELS = Path(__file__).parents[2] / "models"


@pytest.fixture(scope="session")
def kernel() -> ct.CDLL:
    """The kernel's functions; every program's library holds them."""
    return ct.CDLL(str(frot.load(MODELS / "inclined_block.frot").program().library))
