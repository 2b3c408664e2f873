"""A liaison with more laws of friction than the kernel solves for is refused, none is left out."""

import re
from pathlib import Path

import pytest
from frot.compiler.mechanics.laws import law_models

import frot

ROLLING = """
planar model Rolling
  body d: disc(mass = 1 kg, radius = 1 m);
  liaison floor: contact_ponctuel(ground.line, d.rim) with coulomb(0.1), rolling_resistance(1 mm);
initial
  d.position = (0, 1) m;
  d.velocity = (1, 0) m/s;
end Rolling;
"""
KERNEL = Path(__file__).parents[2] / "runtime" / "kernel"


def test_the_compiler_knows_how_many_the_kernel_takes() -> None:
    found = re.search(
        r"#define FROT_LAWS_OF_CONTACT (\d+)", (KERNEL / "modes" / "mode_options.h").read_text()
    )
    assert found is not None and int(found[1]) == law_models.MOST_LAWS


def test_one_law_more_is_refused_with_the_names_of_all(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two laws are taken; where the kernel takes one, the second is too many."""
    assert frot.compile(ROLLING).simulate().events
    monkeypatch.setattr(law_models, "MOST_LAWS", 1)
    with pytest.raises(frot.FrotError) as refused:
        frot.compile(ROLLING).report()
    (message,) = refused.value.diagnostics
    assert message.code == "E0701" and message.span is not None
    assert message.span.text == "rolling_resistance(1 mm)"
    for name in ("'floor'", "'coulomb'", "'rolling_resistance'"):
        assert name in message.message
