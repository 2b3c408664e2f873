"""Ctrl-C: status 130, one line, no traceback, wherever it arrives; what was computed is kept."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from front_door import HOOP, Shell, files_in
from patience import PATIENCE

import frot

LONG = ("simulate", HOOP, "--stop", "4e6", "-o", "out.csv")


def wait_for_library(pid: int) -> None:
    """Until the compiled model is loaded: the run is about to begin."""
    maps = Path(f"/proc/{pid}/maps")
    end = time.monotonic() + PATIENCE
    while "program.so" not in maps.read_text():
        if time.monotonic() > end:
            raise TimeoutError
        time.sleep(0.01)


def let_it_work(pid: int, seconds: float) -> None:
    """Until a process has had the processor for this long from now on, on a busy machine too."""

    def used() -> float:
        fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    begun, end = used(), time.monotonic() + PATIENCE
    while used() < begun + seconds:
        if time.monotonic() > end:
            raise TimeoutError
        time.sleep(0.01)


@pytest.mark.skipif(sys.platform != "linux", reason="looks into /proc")
@pytest.mark.parametrize("after", [0.1, 0.5])
def test_an_interrupted_run_keeps_what_was_computed(after: float, shell: Shell) -> None:
    shell("simulate", HOOP).succeeds()
    process = shell.start(*LONG, "--plot", "out.png")
    wait_for_library(process.pid)
    let_it_work(process.pid, after)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=PATIENCE)
    assert process.returncode == 130, err
    # a picture takes longer than one waits after Ctrl-C
    assert files_in(shell.folder) == {"out.csv"}
    rows = (shell.folder / "out.csv").read_text(encoding="utf-8").splitlines()
    reached = float(rows[-1].split(",")[0])
    assert 0 < reached < 4e6
    assert f"BackspinHoop: 0 s to {reached:.6g} s" in out and "written: out.csv" in out
    assert err == f"interrupted at t = {reached:.6g} s\n"


def test_from_python_the_result_comes_with_the_interrupt() -> None:
    model = frot.load(HOOP)

    def interrupt(reached: float) -> bool:
        if reached > 1:
            os.kill(os.getpid(), signal.SIGINT)
        return False

    with pytest.raises(KeyboardInterrupt) as stopped:
        model.simulate(stop=4e7, watch=interrupt)
    assert isinstance(stopped.value, frot.Interrupted)
    result = stopped.value.result
    assert result is not None and 0 < result.time[-1] < 4e7
    # The hoop rolls on: v = (v0 - r w0)/2, backwards.
    assert result["hoop.velocity.x"][-1] == pytest.approx((1 - 0.5 * 20) / 2, rel=1e-8)


@pytest.mark.skipif(sys.platform != "linux", reason="looks into /proc")
def test_a_start_is_interrupted(shell: Shell) -> None:
    """From the first line of `main` on; the interpreter's own start is not ours."""
    words = [str(word) for word in LONG]
    code = (
        "import signal, sys; from frot.command_line import main; "
        "signal.signal(signal.SIGINT, signal.default_int_handler); "
        f"print('begun', flush=True); sys.exit(main({words!r}))"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", code],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=shell.folder,
    )
    assert process.stdout is not None and process.stdout.readline() == "begun\n"
    time.sleep(0.005)
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=PATIENCE)
    assert process.returncode == 130, err
    assert files_in(shell.folder) == set()
    assert "Traceback" not in err
