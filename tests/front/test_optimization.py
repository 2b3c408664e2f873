"""Levels of optimisation of a model's C: the same bits from each, and a clear refusal of others."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from fmpy import simulate_fmu

import frot

pytestmark = pytest.mark.usefixtures("one_compiler")

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


LIGHT = """
planar model Light "A light rod between heavy ones, in numbers of twice the digits"
  body a: rod(mass = 1e9 kg, length = 1 m);
  body b: rod(mass = 1 kg, length = 1 m);
  body c: rod(mass = 1e9 kg, length = 1 m);
  liaison o: rotoide(ground, a.start);
  liaison p: rotoide(a.tip, b.start);
  liaison q: rotoide(b.tip, c.start);
initial
  o.angle = 0.3;
  p.angle = 0.5;
  q.angle = -0.4;
  experiment(stop = 1 s);
end Light;
"""


def test_functions_in_numbers_of_twice_the_digits_are_compiled_as_the_kernel_is(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """They have another form in `tcc`: the mass matrix would be read as a singular one."""
    plain = frot.compile(LIGHT).simulate()
    other = next(x for x in ("tcc", "clang", "gcc", "cc") if shutil.which(x) is not None)
    monkeypatch.setenv("FROT_MODEL_CC", other)
    model = frot.compile(LIGHT)
    result = model.simulate()
    assert result.program.compiler == (other,)
    assert "FROT_ONLY_WIDE" in result.program.source.read_text(encoding="utf-8")
    assert result.record.tobytes() == plain.record.tobytes()
    model.export_fmu(tmp_path / "light.fmu", "2.0", "native")
    got = simulate_fmu(str(tmp_path / "light.fmu"), output=["o.angle"], output_interval=0.1)
    expected = [result.at(t)["o.angle"] for t in got["time"]]
    assert list(got["o.angle"]) == expected


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
