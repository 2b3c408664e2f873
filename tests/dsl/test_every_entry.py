"""Every entry of the catalogue has its place in the manual, an example that runs, and a test.

The same holds of the messages and commands. A new row of a table fails here until it has them.
"""

from __future__ import annotations

import argparse
import ast
import functools
import math
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from frot.compiler import driver
from frot.compiler.mechanics.forces.force_models import FORCE_MODELS
from frot.compiler.mechanics.laws.law_models import LAW_MODELS
from frot.compiler.mechanics.mechanism import relations_of
from frot.compiler.mechanics.points import Point, is_particle, point_body
from frot.compiler.mechanics.shapes import SHAPES as SHAPE_MODELS
from frot.dsl import CODES, Log, compile_text, load
from frot.dsl.catalogue import FORCES, FUNCTIONS, LAWS, LIAISONS, SHAPES

import frot
from frot import commands

ROOT = Path(__file__).parents[2]
SOUND = Path(__file__).parent / "sound"
RUN = [SOUND / f"every_{name}.frot" for name in ("function", "planar_figure", "space_liaison")]
TABLES = {
    "shape": SHAPES,
    "liaison": LIAISONS,
    "law": LAWS,
    "force": FORCES,
    "function": FUNCTIONS,
}
ROWS = [(table, name) for table, rows in TABLES.items() for name in rows]
FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
# Values of `every_function` at its end, where x is 0.5, in Python's words.
VALUES = {
    "acosh": "acosh(1 + x)",
    "floor": "floor(4*x)",
    "ceil": "ceil(4*x)",
    "abs": "fabs(-x)",
    "sign": "-1",
    "min": "0.5",
    "max": "0.5",
    "mod": "(4*x) % 0.7",
    "hypot": "hypot(x, 2)",
    "atan2": "atan2(x, -1)",
    "dot": "-1",
    "cross": "-5",
    "norm": "sqrt(14)",
    "der": "0.4",
    "sum": "6",
    "size": "2",
    "zeros": "6",
    "ones": "3",
    "fill": "x*2",
    "transpose": "2*0.5 + 4*0.25",
    "noEvent": "1",
    "smooth": "x - 0.4",
}
OF_EVENTS = {"pre", "edge", "change", "sample", "initial", "friction"}


def _words(text: str) -> set[str]:
    return set(re.findall(r"\w+", text))


def _code(text: str) -> set[str]:
    """The words of a model, without comments and descriptions."""
    return _words(re.sub(r"//[^\n]*|/\*.*?\*/|\"[^\"\n]*\"", " ", text, flags=re.DOTALL))


def _documents() -> Iterator[str]:
    for path in (ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))):
        yield path.read_text("utf-8")


@functools.cache
def _named_in_the_manual() -> set[str]:
    """Every word in backticks, outside of blocks."""
    found: set[str] = set()
    for text in _documents():
        for quoted in re.findall(r"`([^`]+)`", FENCE.sub("", text)):
            found |= _words(quoted)
    return found


@functools.cache
def _used_in_examples() -> set[str]:
    """Every word of a model that a test runs: those of `models/`, of the documents, and of RUN."""
    found: set[str] = set()
    for path in (*(ROOT / "models").glob("*.frot"), *RUN):
        found |= _code(path.read_text("utf-8"))
    for text in _documents():
        for language, block in FENCE.findall(text):
            found |= _code(block) if language == "frot" else set()
    return found


@functools.cache
def _named_in_tests() -> set[str]:
    found: set[str] = set()
    for pattern in ("**/*.py", "**/*.frot"):
        for path in (ROOT / "tests").glob(pattern):
            if path != Path(__file__) and path not in RUN:
                found |= _words(path.read_text("utf-8"))
    return found


def _spellings(table: str, name: str) -> set[str]:
    return {name, *getattr(TABLES[table][name], "aliases", ())}


@pytest.mark.parametrize(("table", "name"), ROWS)
def test_an_entry_is_in_the_manual(table: str, name: str) -> None:
    assert _spellings(table, name) & _named_in_the_manual()


@pytest.mark.parametrize(("table", "name"), ROWS)
def test_an_entry_has_an_example_that_runs(table: str, name: str) -> None:
    if table == "law" and name not in LAW_MODELS:
        return  # refused by name: see below
    assert _spellings(table, name) & _used_in_examples()


@pytest.mark.parametrize(("table", "name"), [x for x in ROWS if x[0] != "function"])
def test_an_entry_has_a_test(table: str, name: str) -> None:
    assert _spellings(table, name) & _named_in_tests()


@pytest.mark.parametrize("path", RUN, ids=lambda path: path.stem)
def test_an_example_of_entries_runs(path: Path) -> None:
    result = frot.load(path).simulate()
    assert result.time[-1] == pytest.approx({"every_function": 0.5}.get(path.stem, 0.2))


@pytest.mark.parametrize("name", sorted(FUNCTIONS.keys() - OF_EVENTS))
def test_a_function_has_its_value(name: str) -> None:
    result = frot.load(RUN[0]).simulate()
    x = result["x"][-1]
    assert x == pytest.approx(0.5, abs=1e-9)
    expected = eval(VALUES.get(name, f"{name}(x)"), {**vars(math), "x": float(x)})
    assert result[f"of_{name}"][-1] == pytest.approx(expected, abs=1e-12)


def test_functions_of_events_act_once_each() -> None:
    """Ticks at 0.1, 0.3 and 0.5 s; one start; one change, which is an edge; rest by friction."""
    result = frot.load(RUN[0]).simulate()
    assert (result["ticks"][-1], result["begun"][-1], result["jumps"][-1]) == (3, 1, 10)
    # 0.08 m/s is lost at 0.2 m/s^2
    assert result["v"][-1] == 0
    assert any(
        "stick" in event.text and event.time == pytest.approx(0.4) for event in result.events
    )


@pytest.mark.parametrize(
    ("models", "table"), [(FORCE_MODELS, FORCES), (SHAPE_MODELS, SHAPES)], ids=["force", "shape"]
)
def test_every_entry_has_a_model(models: dict[str, object], table: dict[str, object]) -> None:
    assert models.keys() == table.keys()


@pytest.mark.parametrize("name", sorted(LAWS.keys() - LAW_MODELS.keys()))
def test_a_law_without_a_model_is_refused_by_name(name: str) -> None:
    values = {"expression": "0.1", "word": "newton", "number": "1"}
    units = {"N.s/m", "m/s", "m"}
    arguments = ", ".join(
        f"{a.name} = {values[a.kind]}" + (f" {u}" if (u := a.type.dimension.unit) in units else "")
        for a in LAWS[name].arguments
        if a.required
    ).replace("max = 0.1", "max = 0.2")
    text = f"""planar model Refused
  body disc: disc(mass = 1 kg, radius = 0.1 m);
  liaison floor: contact_ponctuel(disc.rim, ground.line) with {name}({arguments});
end Refused;
"""
    log = Log()
    model = compile_text(text, log)
    assert model is not None, list(log)
    assert driver.mechanism_of(model, log) is None
    assert [x.code for x in log] == ["E0701"]
    assert f"'{name}'" in next(iter(log)).message


@functools.cache
def _strings_of_sources() -> set[str]:
    found: set[str] = set()
    for top in ("compiler", "dsl", "runtime", "frot"):
        for path in (ROOT / top).rglob("*.py"):
            if path.parent.name == "messages" and path.name.startswith("codes"):
                continue
            for node in ast.walk(ast.parse(path.read_text("utf-8"))):
                if isinstance(node, ast.Constant) and isinstance(node.value, str):
                    found.add(node.value)
    return found


@pytest.mark.parametrize("code", CODES)
def test_a_message_is_reported_somewhere_and_says_what_to_do(code: str) -> None:
    assert code in _strings_of_sources()
    entry = CODES[code]
    assert entry.title and entry.explanation.endswith(".") and entry.remedy.endswith(".")
    # what one text can cause has an example, which tests/dsl/test_diagnostics.py runs
    assert entry.example or code >= "E0801" or code in _named_in_tests()


def _commands() -> list[str]:
    parser = commands._parser()
    actions = [x for x in parser._actions if isinstance(x, argparse._SubParsersAction)]
    return list(actions[0].choices)


@pytest.mark.parametrize("name", _commands())
def test_a_command_is_in_the_manual_and_has_a_test(name: str) -> None:
    documents = "\n".join(_documents())
    assert re.search(rf"frot {name}\b", documents)
    called = re.compile(rf"[\"'\[(]{name}[\"']")
    assert any(called.search(p.read_text("utf-8")) for p in (ROOT / "tests").rglob("*.py"))


def _counted(path: Path) -> Iterator[tuple[str, bool, int]]:
    """Kind, planar or not, and number of relations of each liaison that is not driven.

    Those of particles, which do not turn, are left out.
    """
    log = Log()
    model = load(path, log)
    if model is None or not model.liaisons:
        return
    mechanism = driver.mechanism_of(model, log)
    assert mechanism is not None
    driven = {x.liaison for x in model.flanges}
    for liaison, count in relations_of(mechanism).items():
        ends = (point_body(x) for x in (liaison.a, liaison.b) if isinstance(x, Point))
        if liaison.driven or liaison.relations or liaison in driven or any(map(is_particle, ends)):
            continue
        if liaison.kind.name in LIAISONS:
            yield liaison.kind.name, model.planar, count


def test_the_catalogue_counts_relations_as_the_mechanics_does() -> None:
    texts = [*(ROOT / "models").glob("*.frot"), *RUN]
    found = {one for path in texts for one in _counted(path)}
    assert len(found) >= 14
    for name, planar, count in found - {("appui_faces", True, 2)}:  # each corner has its own
        kind = LIAISONS[name]
        assert count == (kind.relations_planar if planar else kind.relations_space), name
