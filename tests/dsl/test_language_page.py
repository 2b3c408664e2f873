"""The page on the language: its models of equations are sound and balanced."""

import re
from pathlib import Path

import pytest
from frot.dsl import Log, compile_text, format_text, render_log
from frot.dsl.catalogue import FORCES, FUNCTIONS, LAWS, LIAISONS, SHAPES, manual
from frot.dsl.catalogue.figures import CURVES, SURFACES
from frot.dsl.statements.equations import count

PAGE = (Path(__file__).parents[2] / "docs" / "language.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(?:equations|frot)\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("text", BLOCKS, ids=lambda t: t.splitlines()[0][3:40])
def test_every_model_of_the_page_is_sound(text: str) -> None:
    log = Log()
    model = compile_text(text, log)
    assert model is not None, render_log(log)
    assert not log.diagnostics, render_log(log)
    unknowns = sum(v.type.count for v in model.variables if not v.discrete)
    assert sum(count(e) for e in model.equations) == unknowns
    assert format_text(format_text(text)) == format_text(text)


def test_the_tables_of_the_page_are_those_of_the_catalogue() -> None:
    """`python -m frot.dsl.catalogue.manual` writes them anew."""
    assert manual.written(PAGE) == PAGE


@pytest.mark.parametrize("name", manual.TABLES)
def test_a_table_changed_by_hand_is_written_anew(name: str) -> None:
    mark = f"<!-- table: {name} -->\n"
    assert manual.written(PAGE.replace(mark, mark + "| by hand |\n")) == PAGE
    with pytest.raises(ValueError, match=name):
        manual.written(PAGE.replace(mark, ""))


def test_every_kind_of_the_catalogue_is_in_a_table() -> None:
    tables = "\n".join(make() for make in manual.TABLES.values())
    kinds = (*SHAPES, *CURVES, *SURFACES, *LIAISONS, *LAWS, *FORCES, *FUNCTIONS)
    assert [name for name in kinds if f"| `{name}`" not in tables] == []
