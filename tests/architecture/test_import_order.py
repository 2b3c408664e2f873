"""Imports between modules run one way, late ones and those for annotations included."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest
from import_circles import circle

ROOT = Path(__file__).parents[2]
TOP_FOLDERS = ("dsl", "compiler", "runtime", "frot")
# Folders of the compiler, each of which may import those before it; the driver imports all.
# `report` and `product` do not know each other, and `toolchain` knows none of them.
RANKS = {
    "symbolic": 0,
    "translate": 1,
    "mechanics": 2,
    "equations": 3,
    "lowering": 4,
    "report": 5,
    "product": 5,
    "driver": 6,
}


def _imported(source: str) -> Iterator[str]:
    """Every module that a text may import, anywhere in it."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.ImportFrom):
            assert node.level == 0, "relative imports are not used"
            yield str(node.module)
            yield from (f"{node.module}.{name.name}" for name in node.names)
        elif isinstance(node, ast.Import):
            yield from (name.name for name in node.names)


def _modules(top: str) -> dict[str, Path]:
    found: dict[str, Path] = {}
    for path in sorted((ROOT / top).rglob("*.py")):
        parts = path.relative_to(ROOT).with_suffix("").parts
        whole = parts if top == "frot" else ("frot", *parts)
        found[".".join(p for p in whole if p != "__init__")] = path
    return found


def _graph(modules: Mapping[str, Path]) -> dict[str, set[str]]:
    return {
        name: set(_imported(path.read_text("utf-8"))) & modules.keys() - {name}
        for name, path in modules.items()
    }


def _room(module: str) -> str:
    """The folder of the compiler that a module is in; the driver is one of its own."""
    return module.split(".")[2] if module.count(".") > 1 else ""


def _runs_up(graph: Mapping[str, set[str]]) -> list[str]:
    found = []
    for name, others in graph.items():
        own = _room(name)
        for other in sorted(others):
            there = _room(other)
            if own == there or not own or not there:
                continue
            if own == "driver":
                continue
            if own == "product" and there == "toolchain":
                continue
            if there not in RANKS or own not in RANKS or RANKS[there] >= RANKS[own]:
                found.append(f"{name} -> {other}")
    return found


def test_annotation_and_late_imports_are_counted() -> None:
    text = (
        "TYPE_CHECKING = False\nif TYPE_CHECKING:\n    from frot.compiler.a import B\n"
        "def f():\n    import frot.compiler.c\n"
    )
    assert {"frot.compiler.a", "frot.compiler.c"} <= set(_imported(text))


def test_an_upward_import_is_found() -> None:
    up = {"frot.compiler.mechanics.a": {"frot.compiler.equations.b"}}
    beside = {"frot.compiler.report.a": {"frot.compiler.product.b"}}
    apart = {"frot.compiler.lowering.a": {"frot.compiler.toolchain.b"}}
    down = {"frot.compiler.equations.b": {"frot.compiler.mechanics.a"}}
    assert _runs_up(up) and _runs_up(beside) and _runs_up(apart) and not _runs_up(down)


def test_folders_of_the_compiler_import_one_way() -> None:
    graph = _graph(_modules("compiler"))
    assert len(graph) > 100
    assert {_room(name) for name in graph} <= {*RANKS, "toolchain", ""}
    assert not _runs_up(graph)


@pytest.mark.parametrize("top", TOP_FOLDERS)
def test_no_modules_import_each_other_in_a_circle(top: str) -> None:
    assert circle({"a": {"b"}, "b": {"c"}, "c": {"b"}}) == ["b", "c", "b"]
    door = "frot" if top == "frot" else f"frot.{top}"
    graph = _graph(_modules(top))
    # the door of the package names what it loads when it is first used
    graph.pop(door)
    assert not circle({k: v - {door} for k, v in graph.items()})


def test_folders_of_the_language_import_one_way() -> None:
    """The door of the language, `checking` and `warn` stand above the folders."""
    inner = {path.name for path in (ROOT / "dsl").iterdir() if path.is_dir()}
    folders: dict[str, set[str]] = {}
    for name, others in _graph(_modules("dsl")).items():
        own = _room(name)
        if own in inner:
            there = {_room(other) for other in others} & inner
            folders.setdefault(own, set()).update(there - {own})
    assert len(folders) > 10
    assert not circle(folders)


@pytest.mark.parametrize("top", TOP_FOLDERS)
def test_modules_of_one_top_folder_have_names_of_their_own(top: str) -> None:
    by_name: dict[str, list[str]] = {}
    for path in _modules(top).values():
        if path.name != "__init__.py":
            by_name.setdefault(path.name, []).append(str(path.relative_to(ROOT)))
    assert by_name
    assert not {name: paths for name, paths in by_name.items() if len(paths) > 1}
