"""The table of functions: on each row a type, a value and a form, and they say the same."""

from __future__ import annotations

import math

import casadi as ca
import pytest
from frot.compiler.translate.expressions import Lowering
from frot.dsl import Log, checked, compile_text, render_log
from frot.dsl.catalogue.functions import FUNCTIONS, Function
from frot.dsl.checked.evaluation import _Evaluation
from frot.dsl.checked.show import _Printing

USUAL = [f for f in FUNCTIONS.values() if not f.place]
# Inside of every domain; `acosh` alone begins at 1.
INNER, BEYOND = (0.3, 0.7), (1.3, 2.7)


def _operands(function: Function) -> list[tuple[float, ...]]:
    """Points where a function has a value: of numbers, or of components of vectors."""
    values = BEYOND if function.name == "acosh" else INNER
    count = function.least if function.most is None else function.most
    return [values[:count], tuple(-v for v in values[:count])][: 1 if values[0] > 1 else 2]


@pytest.mark.parametrize("function", USUAL, ids=lambda f: f.name)
def test_the_value_and_the_form_are_one_number(function: Function) -> None:
    assert function.rule is not None and function.number is not None and function.form is not None
    if function.rule.vectors:
        vectors = ((0.3, -0.4, 1.2), (2.0, 0.5, -0.7))[: function.most]
        points: list[tuple[object, ...]] = [vectors, tuple(v[:2] for v in vectors)]
    else:
        points = list(_operands(function))
    for point in points:
        try:
            value = function.number(*point)
        except ValueError:
            # A logarithm or root of what is negative: CasADi has no value either.
            assert math.isnan(float(function.form(ca, *map(ca.DM, point))))
            continue
        form = function.form(ca, *(ca.DM(p) for p in point))
        wanted = ca.DM(value)
        # Both round each of a few operations.
        assert float(ca.norm_inf(form - wanted)) <= 8 * 2.2e-16 * max(
            1.0, float(ca.norm_inf(wanted))
        )


def test_every_name_is_known_and_asks_for_what_it_takes() -> None:
    """Each function told with a wrong number of operands says how many it takes."""
    for name, function in FUNCTIONS.items():
        most = function.most
        count = function.least - 1 if most is None else most + 1
        operands = ", ".join(["1"] * count)
        log = Log()
        text = f"model M\n  Real x;\nequation\n  x = {name}({operands});\nend M;\n"
        compile_text(text, log)
        shown = render_log(log)
        if function.switch == "order" and count == 1:
            assert "takes an array" in shown
            continue
        assert f"'{name}' takes {function.count} operand" in shown, shown
        assert f"found {count}" in shown


def test_the_words_for_a_number_of_operands() -> None:
    def said(least: int, most: int | None) -> str:
        return Function("f", least=least, most=most).count

    assert [said(1, 1), said(2, 3), said(1, 8), said(2, None)] == [
        *("1", "2 or 3", "1 to 8", "at least 2")
    ]


@pytest.mark.parametrize("walk", [_Evaluation, _Printing, Lowering])
def test_every_walk_has_a_rule_for_each_kind_of_expression(walk: type) -> None:
    assert set(walk.rules) == set(checked.Expression.__args__)  # type: ignore[attr-defined]
