"""A finding is a `.frot` file of this folder; `finding("name")` compiles it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

import frot

HERE = Path(__file__).parent
Finding = Callable[..., frot.Model]


@pytest.fixture
def finding() -> Finding:
    """The model of `name.frot`; `changes` are places of its text and what stands there instead.

    Values of parameters need no change of the text: `simulate(parameters=...)` sets them.
    """

    def load(name: str, changes: dict[str, str] | None = None) -> frot.Model:
        path = HERE / f"{name}.frot"
        if not changes:
            return frot.load(path)
        text = path.read_text(encoding="utf-8")
        for old, new in changes.items():
            assert text.count(old) == 1, f"{name}: {old}"
            text = text.replace(old, new)
        return frot.compile(text)

    return load
