"""Levels of optimisation of a model's C: the same bits from each, and a clear refusal of others."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

import frot

MODELS = Path(__file__).parents[2] / "models"


@pytest.mark.parametrize("name", ["wheel_channel", "rough_sphere", "half_wave_rectifier"])
def test_levels_give_the_same_bits(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    records = []
    for level in ("0", "1", "2"):
        monkeypatch.setenv("FROT_OPTIMIZE", level)
        records.append(frot.load(MODELS / f"{name}.frot").simulate().record.tobytes())
    assert records[0] == records[1] == records[2]


@pytest.mark.parametrize("name", ["wheel_channel", "rough_sphere", "half_wave_rectifier"])
def test_another_compiler_of_models_gives_the_same_bits(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """`tcc`, which most tests use where it is installed; else another, or `cc` by its name."""
    other = next(x for x in ("tcc", "clang", "gcc", "cc") if shutil.which(x) is not None)
    path = MODELS / f"{name}.frot"
    plain = frot.load(path).simulate()
    monkeypatch.setenv("FROT_MODEL_CC", other)
    result = frot.load(path).simulate()
    assert result.program.compiler == (other,) and result.program.key != plain.program.key
    assert result.record.tobytes() == plain.record.tobytes()


def test_a_compiler_of_models_that_does_not_exist_is_refused(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("FROT_MODEL_CC", "no-such-compiler")
    with pytest.raises(frot.FrotError) as caught:
        frot.load(MODELS / "wheel_channel.frot").simulate()
    assert caught.value.diagnostics[0].code == "E0801"
    assert "FROT_MODEL_CC" in caught.value.diagnostics[0].message


def test_another_level_is_refused_by_name(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FROT_OPTIMIZE", "fast")
    with pytest.raises(frot.FrotError) as caught:
        frot.load(MODELS / "wheel_channel.frot").simulate()
    assert caught.value.diagnostics[0].code == "E0801"
    assert "FROT_OPTIMIZE" in caught.value.diagnostics[0].message
