"""Every stage of the compiler can be looked at, and one place knows the order of the passes."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest
from front_door import HOOP, Door

import frot
from frot.command_line import STAGES

ROOMS = Path(frot.__file__).parents[1]
SHOWN = {
    "tree": "BackspinHoop",
    "instance": "BackspinHoop",
    "mechanism": "contacts",
    "reduced": "M a = h + J' lam",
    "equations": "rows accelerate by J z + c",
    "cost": "operations of the generated functions",
    "c": "const frot_model frot_the_model",
}
PASSES = {"mechanize", "reduce", "assemble", "make_groups", "lower", "generate"}


@pytest.mark.parametrize("stage", STAGES)
def test_each_stage_is_printed(stage: str, door: Door) -> None:
    assert SHOWN[stage] in door("check", HOOP, "--emit", stage).succeeds().out


def test_only_the_driver_takes_a_pass() -> None:
    takers: dict[str, set[str]] = {name: set() for name in PASSES}
    for path in (ROOMS / "compiler").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom):
                for name in PASSES & {alias.name for alias in node.names}:
                    takers[name].add(path.name)
    assert takers == {name: {"driver.py"} for name in PASSES}
