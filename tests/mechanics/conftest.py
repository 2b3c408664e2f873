"""Each structure is compiled once in a session; its parameters vary from run to run."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from mechanical_scenes import Scenes


@pytest.fixture(scope="session")
def scenes() -> Scenes:
    return Scenes()
