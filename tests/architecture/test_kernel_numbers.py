"""What the kernel calls zero, equal or settled stands in `tolerances.h`, each with its meaning."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

KERNEL = Path(__file__).parents[2] / "runtime" / "kernel"
TOLERANCES = (KERNEL / "numerics" / "tolerances.h").read_text(encoding="utf-8")
# Solvers of one problem, which keep the numbers of their own equations beside them.
OWN_NUMBERS = ("contact", "impacts", "modes", "motion_search", "motions")
SMALLEST = 1e-5
# Steps of differences, units, and the numbers of model exchange.
KEPT = {
    "assembly/tangent_newton.c: LITTLE",
    "evaluation/algebraic_loops.c: BESIDE",
    "inertia/articulated_step.h: REAL_EPSILON",
    "numerics/extended_precision.h: FROT_WIDE_EPSILON",
    "run/exchange_guards.c: ROUNDING",
    "run/model_exchange.c: CROWDED",
    "run/model_exchange.c: ROUNDING",
}
DEFINED = re.compile(r"^#define (\w+)(\([^)]*\))? ([^\n]+)$", re.MULTILINE)
NAMES = [name for name, arguments, _ in DEFINED.findall(TOLERANCES) if not arguments]


def smallest(value: str) -> float:
    """The smallest number of a definition: a part of rounding, or what is written."""
    code = re.sub(r"/\*.*", "", value)
    numbers = [abs(float(x)) for x in re.findall(r"\d+(?:\.\d+)?(?:e[+-]?\d+)?", code)]
    return 0.0 if "EPSILON" in code else min((x for x in numbers if x > 0), default=1.0)


def test_rounding_and_small_numbers_are_seen() -> None:
    assert smallest("(8 * DBL_EPSILON)") < SMALLEST
    assert smallest("(1 + 1e-9) /* of 2 */") < SMALLEST
    assert smallest("0.5 /* 1e-9 of it */") == 0.5


@pytest.mark.parametrize("name", NAMES)
def test_a_tolerance_is_explained_and_used(name: str) -> None:
    before = TOLERANCES[: TOLERANCES.index(f"#define {name} ")].rstrip("\n").rsplit("\n", 1)[-1]
    assert before.endswith("*/") or before.startswith("#define"), "no comment before it"
    files = [path for path in KERNEL.rglob("*.[ch]") if path.name != "tolerances.h"]
    own = TOLERANCES.count(name) > 1
    assert own or any(re.search(rf"\b{name}\b", path.read_text("utf-8")) for path in files)


def test_small_numbers_are_defined_nowhere_else() -> None:
    found = [
        f"{path.relative_to(KERNEL)}: {name}"
        for path in sorted(KERNEL.rglob("*.[ch]"))
        if path.parent.name not in OWN_NUMBERS
        and path.name != "tolerances.h"
        and "_table" not in path.name
        for name, arguments, value in DEFINED.findall(path.read_text(encoding="utf-8"))
        if not arguments and smallest(value) <= SMALLEST
    ]
    assert set(found) <= KEPT
