"""Each text of `tests/scenes` opens with a sentence on its motion, and has a test."""

from __future__ import annotations

from pathlib import Path

import pytest

TESTS = Path(__file__).parents[1]
SCENES = sorted((TESTS / "scenes").glob("*.frot"))
READ = [path.read_text(encoding="utf-8") for path in sorted(TESTS.rglob("test_*.py"))]
TEXTS = "\n".join(text for text in READ if "finding(" in text or '"scenes"' in text)


@pytest.mark.parametrize("path", SCENES, ids=lambda p: p.stem)
def test_a_scene_opens_with_a_comment_and_is_loaded_by_a_test(path: Path) -> None:
    assert path.read_text(encoding="utf-8").startswith("// ")
    assert f'"{path.stem}"' in TEXTS or f'"{path.name}"' in TEXTS


def test_there_are_scenes() -> None:
    assert SCENES
