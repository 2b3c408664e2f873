"""Levels of optimisation of a model's C: the same bits from each, and a clear refusal of others."""

from __future__ import annotations

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


def test_another_level_is_refused_by_name(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FROT_OPTIMIZE", "fast")
    with pytest.raises(frot.FrotError) as caught:
        frot.load(MODELS / "wheel_channel.frot").simulate()
    assert caught.value.diagnostics[0].code == "E0801"
    assert "FROT_OPTIMIZE" in caught.value.diagnostics[0].message
