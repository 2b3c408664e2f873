"""The repository needs nothing beside it: a copy anywhere else passes the same tests."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
ROOMS = (".ci", "bench", "compiler", "docs", "dsl", "frot", "models", "runtime", "tests")
# A worktree's `.git` is a file that names where it comes from, and what installing has made names
# where it was made: no part of the repository.
FILES = [
    *(p for p in ROOT.iterdir() if p.is_file() and p.name != ".git"),
    *(p for room in ROOMS for p in (ROOT / room).rglob("*") if p.is_file()),
]
MADE = (Path("runtime/made"), Path("dsl/text/made"))
TEXTS = sorted(
    p
    for p in (p.relative_to(ROOT) for p in FILES)
    if p.suffix not in {".png", ".pyc"} and not any(p.is_relative_to(m) for m in MADE)
)
# Written apart, so that this file does not name them.
OUTSIDE = ("sha" + "red", "wo" + "rk")
NAMED = re.compile(
    rf"""\.\./{OUTSIDE[0]}\b|["']{OUTSIDE[0]}["'/]|/{OUTSIDE[1]}/(?:\w|\.)|\b{OUTSIDE[0]}/\w"""
)
UPWARDS = re.compile(r"__file__\)(?:\.resolve\(\))?\.parents\[(\d+)\]")
CLIMBS = re.compile(r"(?:\.\./)+")


def outside(path: Path, text: str) -> list[str]:
    """What in the text of this file leads out of the repository."""
    depth = len(path.parts) - 1
    found = [m[0] for m in NAMED.finditer(text)]
    found += [m[0] for m in UPWARDS.finditer(text) if int(m[1]) > depth]
    found += [m[0] for m in CLIMBS.finditer(text) if m[0].count("../") > depth]
    return found


def test_no_file_names_a_folder_outside_the_repository() -> None:
    assert len(TEXTS) > 250
    found = {}
    for path in TEXTS:
        leads = outside(path, (ROOT / path).read_text(encoding="utf-8", errors="replace"))
        if leads:
            found[str(path)] = leads
    assert not found


@pytest.mark.parametrize(
    "text",
    [
        f'ROOT / "{OUTSIDE[0]}" / "reference"',
        f"../{OUTSIDE[0]}/examples",
        f"/{OUTSIDE[1]}/{OUTSIDE[0]}",
        "Path(__file__).parents" + "[3]",
        "../" * 3 + "examples",
    ],
)
def test_a_way_out_is_seen(text: str) -> None:
    assert outside(Path("tests/docs/test_documents.py"), text)
