"""No kind of figure, motion, lock, link or shape is told from another by its class."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

ROOM = Path(__file__).parents[2] / "compiler"
FAMILIES = {"Figure", "Geometry", "Constraint", "Lock", "Motion", "Part", "Shape"}


def kinds(trees: list[ast.Module]) -> set[str]:
    """The classes of the families, those of those, and so on."""
    classes = [node for tree in trees for node in ast.walk(tree) if isinstance(node, ast.ClassDef)]
    found = set(FAMILIES)
    while True:
        more = {x.name for x in classes if found & {ast.unparse(base) for base in x.bases}}
        if more <= found:
            return found
        found |= more


def asked(tree: ast.Module) -> Iterator[str]:
    """The classes by which values are told apart."""
    for node in ast.walk(tree):
        called = isinstance(node, ast.Call) and ast.unparse(node.func)
        if isinstance(node, ast.Call) and called in ("isinstance", "issubclass"):
            yield from (x.id for x in ast.walk(node.args[1]) if isinstance(x, ast.Name))
        if isinstance(node, ast.MatchClass):
            yield ast.unparse(node.cls)


def test_no_dispatch_on_classes_of_families() -> None:
    trees = {path: ast.parse(path.read_text("utf-8")) for path in sorted(ROOM.rglob("*.py"))}
    own = kinds(list(trees.values()))
    assert {"SphereSurface", "Turn", "ScrewCoupling", "Contact", "Relation", "Cylinder"} <= own
    assert not {(path.name, name) for path, tree in trees.items() for name in asked(tree)} & {
        (path.name, name) for path in trees for name in own
    }


def test_one_who_asks_is_found() -> None:
    tree = ast.parse(
        "class Egg(Figure): ...\nclass Shell(Egg): ...\n"
        "isinstance(x, Shell | None)\nmatch x:\n  case Egg(a=b): ...\n"
    )
    assert set(asked(tree)) & kinds([tree]) == {"Egg", "Shell"}
