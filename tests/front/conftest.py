"""An empty folder for each test, and commands run in it."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from front_door import Door, Shell


@pytest.fixture(scope="module")
def one_compiler() -> Iterator[None]:
    """The compiler of `FROT_CC` makes all, as for a user who sets nothing else.

    For tests of compilers and of what is kept: others share the programs of the session.
    """
    with pytest.MonkeyPatch.context() as patch:
        patch.delenv("FROT_MODEL_CC", raising=False)
        yield


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder, where the command is run."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def door(folder: Path, capfd: pytest.CaptureFixture[str]) -> Door:
    return Door(folder, capfd)


@pytest.fixture
def shell(folder: Path) -> Shell:
    return Shell(folder)
