"""Words and lengths: documents, docstrings, comments of headers and messages use the field's terms.

`vocabulary_debt.json` holds, for each file that was written before this rule, how many phrases and
sentences still break it. A count may fall, never rise; a new file has none.
`python tests/architecture/test_vocabulary.py` writes the file anew after an improvement.
"""

from __future__ import annotations

import ast
import functools
import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
DEBT = Path(__file__).with_name("vocabulary_debt.json")
# docs/glossary.md has the words to write instead.
BANNED = re.compile(
    r"\b(told|asked|looked at|what holds|falls|felt|spare|a little later|goes on|for good|"
    r"is left of|as it is asked)\b",
    re.IGNORECASE,
)
MOST_WORDS = 35
FENCE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)


def documents() -> Iterator[tuple[Path, str]]:
    for path in (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))):
        yield path, FENCE.sub("", path.read_text(encoding="utf-8"))


def docstrings() -> Iterator[tuple[Path, str]]:
    for folder in ("dsl", "compiler", "runtime", "frot"):
        for path in sorted((ROOT / folder).rglob("*.py")):
            tree = ast.parse(path.read_text(encoding="utf-8"))
            kinds = (ast.Module, ast.ClassDef, ast.FunctionDef)
            nodes = (node for node in ast.walk(tree) if isinstance(node, kinds))
            yield path, "\n".join(filter(None, map(ast.get_docstring, nodes)))


def headers() -> Iterator[tuple[Path, str]]:
    for path in sorted((ROOT / "runtime").rglob("*.h")):
        yield path, "\n".join(COMMENT.findall(path.read_text(encoding="utf-8")))


def long_sentences(text: str) -> int:
    """Sentences of prose above the limit; rows of tables and headings are none."""
    lines = [line for line in text.splitlines() if not line.lstrip().startswith(("|", "#"))]
    prose = re.sub(r"\n\s*\n|\n\s*[*\-] |\n\s*\d+\. ", ". ", "\n".join(lines))
    prose = re.sub(r"`[^`]*`|\([^)]*\)", "x", prose)
    return sum(len(s.split()) > MOST_WORDS for s in re.split(r"(?<=[.:;?!])\s", prose))


@functools.cache
def debt() -> dict[str, int]:
    """How often each file breaks the rule; files that do not are left out."""
    found: dict[str, int] = {}
    for path, text in (*documents(), *docstrings(), *headers()):
        count = len(BANNED.findall(text))
        count += long_sentences(text) if path.suffix == ".md" else 0
        if count:
            found[path.relative_to(ROOT).as_posix()] = count
    return found


ALLOWED: dict[str, int] = json.loads(DEBT.read_text()) if DEBT.is_file() else {}


@pytest.mark.parametrize("path", sorted(ALLOWED))
def test_a_file_breaks_the_rule_no_more_often_than_it_did(path: str) -> None:
    count, allowed = debt().get(path, 0), ALLOWED[path]
    assert count <= allowed, f"{path}: {count} words or sentences, {allowed} before"
    assert count == allowed, f"{path} has improved: run this file to write {DEBT.name} anew"


def test_no_other_file_breaks_the_rule() -> None:
    assert not {path: count for path, count in debt().items() if path not in ALLOWED}


if __name__ == "__main__":
    now = debt()
    DEBT.write_text(json.dumps(now, indent=0, sort_keys=True) + "\n", encoding="utf-8")
    print(f"{sum(now.values())} in {len(now)} files")
