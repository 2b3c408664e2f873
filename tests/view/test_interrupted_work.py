"""Ctrl-C ends sweeps and films at once, with status 130 and one line; rows of a sweep stay."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from view_scenes import MODELS

HOOP = str(MODELS / "backspin_hoop.frot")
AT_ONCE = 2.0  # s on a machine with other work; 0.02 to 0.3 s were measured
SWEEP = ("sweep", HOOP, "--read", "hoop.position.x", "-o", "s.csv", "--set")


# Ctrl-C acts even where the tests run in the background, which leaves it ignored.
COMMAND = """
import runpy, signal
signal.signal(signal.SIGINT, signal.default_int_handler)
runpy.run_module("frot.command_line", run_name="__main__", alter_sys=True)
"""


def begun(folder: Path, *words: str) -> subprocess.Popen[str]:
    command = [sys.executable, "-c", COMMAND, *words]
    return subprocess.Popen(
        command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )


def interrupted(process: subprocess.Popen[str]) -> str:
    """What it says after Ctrl-C."""
    sent = time.monotonic()
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=60)
    assert time.monotonic() < sent + AT_ONCE
    assert process.returncode == 130, err
    return err


def wait(until: object) -> None:
    end = time.monotonic() + 60
    while not until():  # type: ignore[operator]
        assert time.monotonic() < end
        time.sleep(0.05)


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_a_sweep_keeps_its_rows_and_goes_on(tmp_path: Path) -> None:
    path = tmp_path / "s.csv"
    process = begun(tmp_path, *SWEEP, "mu=0.05:0.5:0.000001")
    wait(lambda: path.is_file() and path.stat().st_size > 100_000)
    assert interrupted(process) == "interrupted\n"
    lines = path.read_text().splitlines()
    # the rows of a short sweep with the same values begin with them
    mus = [float(line.split(",")[0]) for line in lines[1:]]
    assert mus == [0.05 + k * 1e-6 for k in range(len(mus))]
    last = 0.05 + (len(mus) + 3) * 1e-6
    # a machine that stops leaves part of a row
    with path.open("a") as file:
        file.write("0.05")
    process = begun(tmp_path, *SWEEP, f"mu=0.05:{last!r}:0.000001", "--resume")
    out, err = process.communicate(timeout=120)
    assert process.returncode == 0, err
    assert f"{len(mus) + 4} runs, 0 ended in an error" in out
    again = path.read_text().splitlines()
    assert again[: len(lines)] == lines
    assert len(again) == len(lines) + 4


@pytest.mark.skipif(sys.platform != "linux", reason="looks into /proc")
@pytest.mark.parametrize("suffix", ["gif", "mp4"])
def test_a_film_ends_without_a_file(tmp_path: Path, suffix: str) -> None:
    process = begun(tmp_path, "view", HOOP, "--speed", "0.02", "-o", f"film.{suffix}")
    maps = Path(f"/proc/{process.pid}/maps")
    wait(lambda: "backend_agg" in maps.read_text())
    time.sleep(0.5)
    assert interrupted(process) == "interrupted\n"
    assert not list(tmp_path.iterdir())
