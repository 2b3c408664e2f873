"""The kernel's folders are layers: includes run down, in no circle, and every file has one name."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
KERNEL = ROOT / "runtime" / "kernel"
# A folder includes itself and those before it; docs/architecture.md says what each is for.
LAYERS = (
    "numerics",
    "contact",
    "motion_search",
    "model",
    "inertia",
    "evaluation",
    "constraints",
    "reactions",
    "singular",
    "methods",
    "guards",
    "recording",
    "stepping",
    "motions",
    "modes",
    "mode_choice",
    "impacts",
    "events",
    "assembly",
    "starts",
    "run",
)
CONTRACT = "frot.h"
MOST_FILES = 20
FILES = sorted(path for path in KERNEL.rglob("*.[ch]") if path.name != CONTRACT)
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)


def included(path: Path) -> list[str]:
    return INCLUDE.findall(path.read_text(encoding="utf-8"))


def test_every_folder_is_a_layer() -> None:
    assert {path.parent.relative_to(KERNEL).as_posix() for path in FILES} == set(LAYERS)


@pytest.mark.parametrize("folder", LAYERS)
def test_a_folder_can_be_taken_in_at_a_glance(folder: str) -> None:
    assert len([path for path in FILES if path.parent.name == folder]) <= MOST_FILES


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.relative_to(KERNEL).as_posix())
def test_an_include_names_a_file_of_the_same_or_a_lower_layer(path: Path) -> None:
    layer = LAYERS.index(path.parent.name)
    for name in included(path):
        assert (KERNEL / name).is_file(), f"{name} is not written from the kernel's root"
        if name != CONTRACT:
            assert LAYERS.index(Path(name).parent.name) <= layer, f"{name} lies above"


def test_no_headers_include_each_other_in_a_circle() -> None:
    below = {path.relative_to(KERNEL).as_posix(): included(path) for path in KERNEL.rglob("*.h")}
    done: set[str] = set()

    def visit(name: str, way: tuple[str, ...]) -> None:
        assert name not in way, " -> ".join((*way, name))
        if name not in done:
            for other in below[name]:
                visit(other, (*way, name))
            done.add(name)

    for name in below:
        visit(name, ())


def test_two_files_never_share_a_name() -> None:
    """An FMU carries its sources in one flat folder, with those of its FMI face."""
    face = (ROOT / "runtime" / "fmi").glob("*.[ch]")
    names = Counter(path.name for path in (*KERNEL.rglob("*.[ch]"), *face))
    assert [name for name, count in names.items() if count > 1] == []
    stems = Counter(path.stem for path in KERNEL.rglob("*.c"))
    assert [stem for stem, count in stems.items() if count > 1] == []
