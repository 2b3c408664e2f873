"""A run in a file is the run: its values, its events, its picture, and what can be asked of it."""

from __future__ import annotations

import json
import zipfile
from pathlib import Path

import numpy as np
import pytest
from in_process import command
from view_scenes import MODELS, result_of

import frot

SLED = """
planar model Sled
  input Force F(start = 0 N);
  body sled: particle(mass = 2 kg);
  liaison floor: contact_ponctuel(sled, ground.line) with coulomb(0.3);
  force push: on(sled, value = (F, 0 N));
initial
  sled.position = (0, 0) m;
  experiment(stop = 3 s);
end Sled;
"""
FALLS = """
planar model Falls
  body ball: disc(mass = 1 kg, radius = 0.1 m);
  liaison floor: contact_ponctuel(ball.rim, ground.line);
initial
  ball.position = (0, 1) m;
equation
  assert(ball.position.y > 0.2 m, "the floor is near");
  experiment(stop = 2 s);
end Falls;
"""


def kept(result: frot.Result, folder: Path) -> frot.Result:
    result.save(folder / "run.frotrun")
    return frot.load_result(folder / "run.frotrun")


@pytest.mark.parametrize(
    "push",
    [
        ([0, 1, 2, 3], [0, 10, -10, 15]),
        ([0, 1], [8, 0], "held"),
        np.float64(8.0),
    ],
    ids=["over time", "held", "constant"],
)
def test_a_saved_run_is_the_run(tmp_path: Path, push: object) -> None:
    """Values between the output times, and a reaction: the floor carries 2*9.81 N downwards."""
    result = frot.compile(SLED).simulate(inputs={"F": push})
    again = kept(result, tmp_path)
    times = np.array([0.31, 1.7, 2.9])
    for name in ("sled.position.x", "sled.velocity.x", "floor.mode"):
        assert np.array_equal(again[name], result[name])
        assert np.array_equal(again.at(times)[name], result.at(times)[name])
    assert again.events == result.events
    assert (again.balance, again.figures) == (result.balance, result.figures)
    assert again["floor.force.y"] == pytest.approx(-2 * 9.81)
    assert np.array_equal(again["floor.force"], result["floor.force"])


def test_parameters_of_the_run_are_kept(tmp_path: Path) -> None:
    result = result_of("backspin_hoop", parameters={"mu": 0.1, "r": "60 cm"})
    again = kept(result, tmp_path)
    assert again.parameters == result.parameters
    assert again["hoop.position.y"][0] == pytest.approx(0.6)


def test_a_run_that_ended_in_an_error_keeps_its_sentence(tmp_path: Path) -> None:
    with pytest.raises(frot.SimulationError) as told:
        frot.compile(FALLS).simulate()
    assert told.value.result is not None
    again = kept(told.value.result, tmp_path)
    assert "floor" in again.fault and again.fault == told.value.result.fault
    assert again.time[-1] == pytest.approx(np.sqrt(1.6 / 9.81), abs=1e-6)


def test_the_shell_shows_and_draws_a_saved_run(tmp_path: Path) -> None:
    hoop = str(MODELS / "backspin_hoop.frot")
    saved = command(tmp_path, "simulate", hoop, "--stop", "1", "-o", "hoop.frotrun", "--quiet")
    assert saved.returncode == 0, saved.stderr
    for words in (
        ("view", "hoop.frotrun", "--no-open"),
        ("plot", "hoop.frotrun", "--curves", "hoop.momentum.x", "-o", "m.png"),
    ):
        done = command(tmp_path, *words)
        assert done.returncode == 0, done.stderr
    assert (tmp_path / "BackspinHoop.html").stat().st_size > 100_000
    refused = command(tmp_path, "view", "hoop.frotrun", "--set", "mu=1")
    assert refused.returncode == 1 and "--set cannot change it" in refused.stderr


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "is no saved run"),
        (b"PK\x03\x04 and no more", "is no saved run"),
        (None, "cannot be read: No such file"),
    ],
)
def test_what_is_no_saved_run_is_refused(tmp_path: Path, content: bytes | None, words: str) -> None:
    path = tmp_path / "bad.frotrun"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(frot.FrotError, match=words):
        frot.load_result(path)


def test_a_run_of_another_version_is_refused(tmp_path: Path) -> None:
    """States of another program have other places: nothing is read from them."""
    path = tmp_path / "run.frotrun"
    result_of("backspin_hoop", stop=0.1).save(path)
    with zipfile.ZipFile(path) as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    description = json.loads(parts["run.json"])
    description["layout"] = "0" * 64
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in parts.items():
            archive.writestr(name, json.dumps(description) if name == "run.json" else content)
    with pytest.raises(frot.FrotError, match="another version"):
        frot.load_result(path)


def test_values_without_a_model_are_no_run(tmp_path: Path) -> None:
    (tmp_path / "hoop.csv").write_text("time\n0\n")
    done = command(tmp_path, "view", "hoop.csv")
    assert done.returncode == 1 and "has values alone" in done.stderr


def test_a_model_shows_its_start_as_a_page_and_a_picture(tmp_path: Path) -> None:
    """Before any run, also of a model whose run would fail; with other parameters."""
    model = frot.compile(FALLS)
    model.view(tmp_path / "start.html")
    html = (tmp_path / "start.html").read_text(encoding="utf-8")
    assert '"times": [0.0]' in html and '"name": "ball"' in html
    model.view(tmp_path / "start.png")
    assert (tmp_path / "start.png").stat().st_size > 1000
    with pytest.raises(frot.FrotError, match="no film"):
        model.view(tmp_path / "start.gif")


def test_without_a_path_a_page_is_written_here(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    result = result_of("backspin_hoop", stop=0.1)
    assert result.view() == Path("BackspinHoop.html")
    assert (tmp_path / "BackspinHoop.html").is_file()


def test_in_a_notebook_a_page_is_shown_below_its_cell(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No file is written; the cell gets the page as HTML."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("frot.progress.in_notebook", lambda: True)
    shown = result_of("backspin_hoop", stop=0.1).view()
    assert shown._repr_html_().startswith('<iframe srcdoc="')
    assert not list(tmp_path.iterdir())
