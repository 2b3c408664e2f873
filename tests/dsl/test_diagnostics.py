"""Texts with faults: each file says on its lines which codes must appear there, and no others."""

import re
from pathlib import Path

import pytest
from frot.dsl import CODES, Log, compile_text, render_log

FILES = sorted((Path(__file__).parent / "diagnostics").glob("*.frot"))


def expected(text: str) -> list[tuple[int, str]]:
    found = []
    for number, line in enumerate(text.splitlines(), 1):
        said = re.search(r"//! (.*)", line)
        if said:
            found += [(number, code) for code in said[1].split()]
    return sorted(found)


@pytest.mark.parametrize("path", FILES, ids=lambda p: p.stem)
def test_each_fault_is_told_once_where_it_stands(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    log = Log()
    assert compile_text(text, log, path.name) is None
    told = sorted((d.span.source.line_column(d.span.start)[0], d.code) for d in log)
    assert told == expected(text), render_log(log)


@pytest.mark.parametrize(
    "code", [c for c in CODES if CODES[c].example and (c < "E0801" or c[0] == "W")]
)
def test_the_example_of_a_code_triggers_it_and_nothing_else(code: str) -> None:
    log = Log()
    compile_text(CODES[code].example, log)
    # What the compiler judges must be a sound text here.
    judged_later = code.startswith("E06") or code in ("E0511", "E0522")
    assert [d.code for d in log] == ([] if judged_later else [code]), render_log(log)


def test_every_code_is_explained() -> None:
    for code, entry in CODES.items():
        assert re.fullmatch(r"[EW]\d{4}", code)
        assert len(entry.explanation) > 30
        assert entry.remedy.endswith(".")


@pytest.mark.parametrize(
    ("statement", "help_text"),
    [
        ("output Length x = bar.postion.x;", "position"),
        ("output Length x = bar.tpi.position.x;", "tip"),
        ("liaison a: rotoid(ground, bar.tip);", "rotoide"),
        ("body b: rode(mass = 1 kg, length = 1 m);", "rod"),
        ("parameter Lenght y = 1 m;", "Length"),
        ("parameter Length y = 2*Longueur;", "longueur"),
        ("parameter Time y = 3 sec;", "s"),
        ("parameter Force y = 3 n;", "N"),
    ],
)
def test_a_near_name_is_proposed(statement: str, help_text: str) -> None:
    log = Log()
    compile_text(
        "planar model M\n parameter Length longueur = 1 m;\n"
        f" body bar: rod(mass = 1 kg, length = 1 m);\n {statement}\nend M;\n",
        log,
    )
    assert [d.help for d in log] == [f"did you mean {help_text!r}?"]


def test_a_mismatch_names_both_dimensions() -> None:
    log = Log()
    compile_text("planar model M\n body b: disc(mass = 1 kg, radius = 2 kg);\nend M;\n", log)
    assert [d.message for d in log] == ["expected a length (m), found a mass (kg)"]


def test_the_spelling_of_the_author_is_echoed() -> None:
    log = Log()
    compile_text("planar model M\n joint j: rotul(ground, ground);\nend M;\n", log)
    assert [d.message for d in log] == ["unknown joint 'rotul'"]
