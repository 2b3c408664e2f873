"""`frot new`, `frot watch`, and parameters from a file."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest
from in_process import command
from view_scenes import MODELS

import frot

HOOP = str(MODELS / "backspin_hoop.frot")


@pytest.mark.parametrize("name", ["dry_pendulum", "2 arms", "étude.frot"])
def test_a_new_model_runs_and_is_in_its_usual_form(tmp_path: Path, name: str) -> None:
    done = command(tmp_path, "new", name)
    assert done.returncode == 0, done.stderr
    (path,) = tmp_path.glob("*.frot")
    assert command(tmp_path, "fmt", "--check", path.name).returncode == 0
    assert frot.load(path).simulate(stop=0.1).balance.relative < 1e-6
    again = command(tmp_path, "new", name)
    assert again.returncode == 1 and "exists already" in again.stderr


def test_parameters_come_from_a_file_and_later_ones_win(tmp_path: Path) -> None:
    """mu = 0.1: the slip 11 m/s ends after 3 s, mu = 0.3: at 1.87 s."""
    (tmp_path / "run.toml").write_text('mu = 0.3\nr = "50 cm"\n', encoding="utf-8")
    one = command(tmp_path, "simulate", HOOP, "--set", "@run.toml")
    assert "slip -> stick at t = 1.868" in one.stdout
    other = command(tmp_path, "simulate", HOOP, "--set", "@run.toml", "--set", "mu=0.1")
    assert "no events" in other.stdout


@pytest.mark.parametrize(
    ("content", "words"),
    [("mu = ", "is no TOML"), ("nu = 1", "no parameter 'nu'"), ('mu = "1 m"', "bad value")],
)
def test_what_is_wrong_in_such_a_file_is_told(tmp_path: Path, content: str, words: str) -> None:
    (tmp_path / "run.toml").write_text(content, encoding="utf-8")
    done = command(tmp_path, "simulate", HOOP, "--set", "@run.toml")
    assert done.returncode != 0
    assert words in done.stderr
    assert "Traceback" not in done.stderr


def test_a_model_is_run_at_each_save(tmp_path: Path) -> None:
    """A text with a fault is told, and the next save is run."""
    path = tmp_path / "hoop.frot"
    good = Path(HOOP).read_text(encoding="utf-8")
    path.write_text(good, encoding="utf-8")
    words = [sys.executable, "-m", "frot.command_line", "watch", "hoop.frot", "--times", "3"]
    with subprocess.Popen(
        words, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        try:
            assert process.stdout is not None
            for change in (good.replace("body hoop", "body hop"), good.replace("0.3", "0.2", 1)):
                line = ""
                while not line.startswith("--"):
                    line = process.stdout.readline()
                time.sleep(0.5)
                path.write_text(change, encoding="utf-8")
                os.utime(path, None)
            out, err = process.communicate(timeout=60)
        finally:
            process.kill()
    assert "E0201" in err or "error[" in err
    assert out.count("BackspinHoop: 0 s to 3 s") >= 1


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


@pytest.mark.parametrize(
    ("words", "status"),
    [
        (("plot", "falls.frot", "-o", "falls.png"), 1),
        (("watch", "falls.frot", "--times", "1", "--plot", "falls.png"), 0),
        (("view", "falls.frot", "-o", "falls.png", "--at", "0.4"), 1),
    ],
    ids=lambda x: x[0] if isinstance(x, tuple) else "",
)
def test_a_run_that_ends_in_an_error_is_drawn_up_to_there(
    tmp_path: Path, words: tuple[str, ...], status: int
) -> None:
    """The assertion fails after sqrt(2*0.8/9.81) = 0.4038 s; the sentence is printed, too."""
    (tmp_path / "falls.frot").write_text(FALLS, encoding="utf-8")
    done = command(tmp_path, *words)
    assert done.returncode == status
    assert "the floor is near (assertion failed at t = 0.403" in done.stderr
    assert (tmp_path / "falls.png").stat().st_size > 1000
