"""Pages on the design: short, complete, and true to the names of files and tests."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
DESIGN = sorted((ROOT / "docs" / "design").glob("*.md"))
PAGES = (ROOT / "docs" / "architecture.md", ROOT / "docs" / "contributing.md", *DESIGN)
FOLDERS = ("bench", "compiler", "docs", "dsl", "frot", "models", "runtime", "tests")
HEADINGS = ["What it does", "Equations", "Claims", "Limits", "Papers"]
MOST_WORDS = 900
FILE = re.compile(r"`([\w/.]+\.(?:py|c|h|md|frot|json|toml|lark))`")
FILES = {
    path.relative_to(ROOT).as_posix()
    for folder in FOLDERS
    for path in (ROOT / folder).rglob("*.*")
    if path.is_file()
} | {path.name for path in ROOT.glob("*.*")}


def is_there(name: str) -> bool:
    """Whether the name is a path from the root, or the end of one."""
    return name in FILES or any(path.endswith(f"/{name}") for path in FILES)


def test_there_are_seven_pages() -> None:
    names = "contacts equations impacts integration language mechanics start switching"
    assert [page.stem for page in DESIGN] == names.split()


@pytest.mark.parametrize("page", DESIGN, ids=lambda p: p.stem)
def test_a_page_has_its_parts_in_900_words(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    assert len(text.split()) <= MOST_WORDS
    assert re.findall(r"^## (.+)$", text, re.MULTILINE) == HEADINGS


@pytest.mark.parametrize("page", PAGES, ids=lambda p: p.stem)
def test_every_file_a_page_names_exists(page: Path) -> None:
    named = FILE.findall(page.read_text(encoding="utf-8"))
    assert named
    assert [name for name in named if not is_there(name)] == []


@pytest.mark.parametrize("page", DESIGN, ids=lambda p: p.stem)
def test_every_claim_names_its_test(page: Path) -> None:
    claims = page.read_text(encoding="utf-8").partition("## Claims")[2].partition("## Limits")[0]
    rows = [line for line in claims.splitlines() if line.startswith("| ")][1:]
    assert rows
    for row in rows:
        assert FILE.findall(row.rpartition(" | ")[2]), row


def test_a_name_of_no_file_is_found() -> None:
    assert is_there("frot.h") and not is_there("no_such_file.c") and not is_there("rot.h")
