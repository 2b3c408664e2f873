"""Ctrl-C: status 130, one line, no traceback, wherever it arrives."""

import signal
import sys
import time
from pathlib import Path

import pytest
from front_door import HOOP, Shell, files_in

LONG = ("simulate", HOOP, "--stop", "4e6", "-o", "out.csv")


def wait_for_library(pid: int) -> None:
    """Until the compiled model is loaded: the run is about to begin."""
    maps = Path(f"/proc/{pid}/maps")
    for _ in range(400):
        if "program.so" in maps.read_text():
            return
        time.sleep(0.01)
    raise TimeoutError


@pytest.mark.skipif(sys.platform != "linux", reason="looks into /proc")
@pytest.mark.parametrize("after", [0.05, 0.5])
def test_a_long_run_is_interrupted(after: float, shell: Shell) -> None:
    shell("simulate", HOOP).succeeds()
    process = shell.start(*LONG)
    wait_for_library(process.pid)
    time.sleep(after)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=30)
    assert (process.returncode, out, err) == (130, "", "interrupted\n")
    assert files_in(shell.folder) == set()


@pytest.mark.skipif(sys.platform != "linux", reason="looks into /proc")
def test_a_start_is_interrupted(shell: Shell) -> None:
    process = shell.start(*LONG)
    time.sleep(0.08)
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=30)
    assert process.returncode in (130, -signal.SIGINT)
    assert files_in(shell.folder) == set()
    if process.returncode == 130:
        assert "Traceback" not in err
