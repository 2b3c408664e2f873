"""Every stage of the compiler can be looked at, and one place knows the order of the passes."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from pathlib import Path

import pytest
from front_door import HOOP, Door
from frot.compiler.driver import assembled_of, lowered_of
from frot.compiler.mechanics.mechanize import mechanize
from frot.compiler.translate.expressions import Lowering
from frot.dsl import Log

import frot
from frot.commands import STAGES

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
PASSES = {
    "mechanize",
    "place_mechanism",
    "read_text",
    "apply_loads",
    "gather_text",
    "large_trees",
    "reduce_motion",
    "make_reduced",
    "plain_system",
    "pose_equations",
    "remove_definitions",
    "order_equations",
    "solve_in_order",
    "hold_slips",
    "pose_initial_problem",
    "make_groups",
    "sort_conditions",
    "lower_switches",
    "lower",
    "generate",
}


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


def live(root: object) -> set[str]:
    """What a stage reaches that is no data: functions, logs, walks, with the way there."""
    found: set[str] = set()
    seen: list[object] = []  # keeps each alive, so that no other gets its id
    known: set[int] = set()
    pending: list[tuple[str, object]] = [(type(root).__name__, root)]
    while pending:
        way, item = pending.pop()
        kind = type(item)
        if id(item) in known or kind.__module__.startswith(("casadi", "numpy", "builtins.type")):
            continue
        known.add(id(item))
        seen.append(item)
        if isinstance(item, Log | Lowering) or (callable(item) and not isinstance(item, type)):
            found.add(f"{way}: {kind.__name__}")
        elif isinstance(item, Mapping):
            pending += [(f"{way}[]", part) for pair in item.items() for part in pair]
        elif isinstance(item, list | tuple | set | frozenset):
            pending += [(f"{way}[]", part) for part in item]
        elif not isinstance(item, str | bytes | int | float | type(None) | type):
            slots = {name for base in kind.__mro__ for name in getattr(base, "__slots__", ())}
            names = slots | set(getattr(item, "__dict__", {}))
            held = [(name, getattr(item, name, None)) for name in names - {"__weakref__"}]
            pending += [(f"{kind.__name__}.{name}", part) for name, part in held]
    return found


@pytest.mark.parametrize("name", ["slider_crank", "speed_drive", "cycloid"])
def test_a_stage_holds_data_and_nothing_that_works(name: str) -> None:
    checked = frot.load(ROOMS / "models" / f"{name}.frot").checked()
    mechanism = mechanize(checked, Log())
    system = assembled_of(checked, Log())
    lowered = lowered_of(checked, Log())
    assert [live(stage) for stage in (checked, mechanism, system, lowered)] == [set()] * 4


def test_what_works_is_found_in_a_stage() -> None:
    log = Log()
    assert live({"a": [(log,)]}) == {"dict[][][]: Log"}
    assert live((test_what_works_is_found_in_a_stage,)) == {"tuple[]: function"}
