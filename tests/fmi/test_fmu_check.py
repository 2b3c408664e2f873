"""`frot fmu --check`: an FMU that is right, one of another text, one whose numbers differ."""

from __future__ import annotations

import shutil
import zipfile
from pathlib import Path

import pytest
from frot.runtime.fmi import check_exchange

import frot
from frot.command_line import main

BLOCK = Path(__file__).parents[2] / "models" / "inclined_block.frot"


@pytest.fixture(scope="module", params=["2.0", "3.0"])
def archive(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("check") / "block.fmu"
    frot.load(BLOCK).export_fmu(path, request.param, "native")
    return path


def rewritten(archive: Path, target: Path, member: str, old: str, new: str) -> None:
    """A copy with another text in one of its files."""
    with zipfile.ZipFile(archive) as source, zipfile.ZipFile(target, "w") as copy:
        for name in source.namelist():
            data = source.read(name)
            if name == member:
                assert old.encode() in data
                data = data.replace(old.encode(), new.encode())
            copy.writestr(name, data)


def test_an_fmu_of_this_text_has_the_values_of_simulate(
    archive: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    checked = frot.load(BLOCK).check_fmu(archive)
    assert checked.good and checked.apart == 0.0 and checked.problems == ()
    assert checked.exchanged is not None and 0.0 < checked.exchanged < 1e-5
    assert main(["fmu", str(BLOCK), "--check", str(archive)]) == 0
    told = capsys.readouterr().out
    assert "all values are those of simulate, to the last bit" in told
    assert "in model exchange, by CVODE, the largest error is" in told


def test_an_fmu_of_another_text_is_told(
    archive: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    other = tmp_path / "block.frot"
    other.write_text(BLOCK.read_text().replace("0.5", "0.4"))
    assert main(["fmu", str(other), "--check", str(archive)]) == 1
    assert "made from another text" in capsys.readouterr().out


def test_a_fault_of_the_description_is_told(archive: Path, tmp_path: Path) -> None:
    broken = tmp_path / "broken.fmu"
    rewritten(archive, broken, "modelDescription.xml", 'causality="output"', 'causality="input"')
    checked = frot.load(BLOCK).check_fmu(broken)
    assert checked.problems and not checked.good


def test_other_values_are_told_with_the_variable(archive: Path, tmp_path: Path) -> None:
    """The description gives another start value, which an importer sets: the block is launched
    faster."""
    faster = tmp_path / "faster.fmu"
    rewritten(archive, faster, "modelDescription.xml", 'start="3.0"', 'start="3.3"')
    checked = frot.load(BLOCK).check_fmu(faster)
    assert not checked.good and checked.variable


def test_a_motion_that_model_exchange_does_not_follow_is_told(
    archive: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Where errors may be no more than 1e-17 every motion is off."""
    monkeypatch.setattr(check_exchange, "AMPLIFIED", 1e-9)
    assert main(["fmu", str(BLOCK), "--check", str(archive)]) == 1
    assert ", that of '" in capsys.readouterr().out


def test_what_is_no_fmu_is_told(tmp_path: Path) -> None:
    path = tmp_path / "no.fmu"
    path.write_bytes(b"no archive")
    with pytest.raises(frot.FrotError, match=r"E0809.*cannot be checked"):
        frot.load(BLOCK).check_fmu(path)
    shutil.rmtree(tmp_path)
    with pytest.raises(frot.FrotError, match="E0809"):
        frot.load(BLOCK).check_fmu(path)
