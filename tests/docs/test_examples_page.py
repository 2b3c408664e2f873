"""The page of worked examples: each model once, with a small picture."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "examples.md").read_text(encoding="utf-8")
PICTURES = ROOT / "docs" / "pictures"
# Packages have capitals, and a page of their own.
MODELS = sorted(p.stem for p in (ROOT / "models").glob("*.frot") if p.stem.islower())
MOST_BYTES = 40_000


@pytest.mark.parametrize("name", MODELS)
def test_a_worked_example_has_a_row_and_a_small_picture(name: str) -> None:
    """`python docs/pictures/draw.py NAME` draws it."""
    assert len(re.findall(rf"\(\.\./models/{name}\.frot\)", PAGE)) == 1
    assert len(re.findall(rf'<img src="pictures/{name}\.png"', PAGE)) == 1
    assert 1000 < (PICTURES / f"{name}.png").stat().st_size < MOST_BYTES


def test_every_picture_is_shown_somewhere() -> None:
    documents = [ROOT / "README.md", *(ROOT / "docs").rglob("*.md")]
    text = "".join(path.read_text(encoding="utf-8") for path in documents)
    assert [p.name for p in PICTURES.glob("*.png") if p.name not in text] == []
    assert all(p.stat().st_size < MOST_BYTES for p in PICTURES.glob("*.png"))
