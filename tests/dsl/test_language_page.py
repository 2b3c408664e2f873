"""The page on the language: its models of equations are sound and balanced."""

import re
from pathlib import Path

import pytest
from frot.dsl import Log, compile_text, format_text, render_log
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
