"""The houses of language and compiler: modules hang together one way, folders are of a size."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import pytest
from import_circles import circle

ROOT = Path(__file__).parents[2]
DSL = ROOT / "dsl"
MODULES_IN_A_FOLDER = 24
SHORTEST = 25
MOST_BY_POSITION = 8


def _modules() -> dict[str, Path]:
    found = {}
    for path in (*DSL.rglob("*.py"), *(ROOT / "compiler").rglob("*.py")):
        parts = path.relative_to(ROOT).with_suffix("").parts
        found[".".join(("frot", *(p for p in parts if p != "__init__")))] = path
    return found


MODULES = _modules()


def _imports(tree: ast.AST) -> Iterator[str]:
    """What is imported anywhere, in functions too; only what annotations alone need is left out."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
            for other in node.orelse:
                yield from _imports(other)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0
            for name in node.names:
                whole = f"{node.module}.{name.name}"
                yield whole if whole in MODULES else str(node.module)
        elif isinstance(node, ast.Import):
            yield from (name.name for name in node.names)
        else:
            yield from _imports(node)


def _graph() -> dict[str, set[str]]:
    return {
        name: {i for i in _imports(ast.parse(path.read_text("utf-8"))) if i in MODULES}
        for name, path in MODULES.items()
    }


def test_a_circle_is_found() -> None:
    late = "def f():\n    from frot.dsl.text import tree\n    import frot.dsl.checked\n"
    assert set(_imports(ast.parse(late))) == {"frot.dsl.text.tree", "frot.dsl.checked"}
    assert circle({"a": {"b"}, "b": {"c"}, "c": {"b"}}) == ["b", "c", "b"]
    assert circle({"a": {"b", "c"}, "b": {"c"}, "c": set()}) == []


def test_no_module_needs_itself_by_way_of_others() -> None:
    graph = _graph()
    assert len(graph) > 150
    assert not circle(graph)


def test_folders_hang_together_one_way() -> None:
    """The door of the language and `checking`, `warn` stand above the folders."""

    def folder(module: str) -> str:
        parts = module.split(".")
        inner = DSL / parts[2] if len(parts) > 2 else DSL
        return parts[2] if len(parts) > 2 and inner.is_dir() else ""

    graph: dict[str, set[str]] = {}
    for name, needs in _graph().items():
        if name.startswith("frot.dsl"):
            above = graph.setdefault(folder(name), set())
            above |= {folder(n) for n in needs} - {folder(name)}
    assert len(graph) > 10
    assert not circle(graph)


def test_folders_and_modules_are_of_a_size() -> None:
    for folder in {path.parent for path in MODULES.values()}:
        assert len(list(folder.glob("*.py"))) <= MODULES_IN_A_FOLDER + 1, folder
    short = {
        str(path.relative_to(ROOT)): lines
        for path in MODULES.values()
        if path.name != "__init__.py"
        and path.is_relative_to(DSL)
        and (lines := len(path.read_text("utf-8").splitlines())) < SHORTEST
    }
    assert not short


@pytest.mark.parametrize("room", ["bench", "compiler", "dsl", "frot", "runtime"])
def test_calls_name_what_they_give_past_eight_operands(room: str) -> None:
    found = [
        f"{path.relative_to(ROOT)}:{node.lineno} {ast.unparse(node.func)}"
        for path in (ROOT / room).rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(node, ast.Call) and _by_position(node) > MOST_BY_POSITION
    ]
    assert not found


def _by_position(call: ast.Call) -> int:
    """The operands without names, those of a display after a star among them."""
    return sum(
        len(a.value.elts) if isinstance(a, ast.Starred) and isinstance(a.value, ast.Tuple) else 1
        for a in call.args
    )


@pytest.mark.parametrize("room", ["frot", "frot.compiler", "frot.dsl", "frot.runtime"])
def test_every_door_opens(room: str) -> None:
    """What a room offers by name, and loads when it is asked for, is there."""
    module = import_module(room)
    offered = set(module.__all__) | set(getattr(module, "_HOMES", ()))
    assert offered
    for name in offered:
        assert getattr(module, name) is not None
