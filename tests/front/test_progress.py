"""Long work shows what is being done, on a terminal and nowhere else."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from front_door import HOOP, script
from patience import PATIENCE

pty = pytest.importorskip("pty")
pytestmark = pytest.mark.usefixtures("one_compiler")


def told(compiler: Path, cache: Path, on_terminal: bool) -> str:
    """What a run whose compiler works for two seconds, and then fails, writes as messages."""
    ours, theirs = pty.openpty() if on_terminal else os.pipe()
    environment = {**os.environ, "FROT_CC": str(compiler), "FROT_CACHE": str(cache)}
    process = subprocess.Popen(
        [sys.executable, "-m", "frot.command_line", "simulate", str(HOOP)],
        env={**environment, "TERM": "xterm"},
        stdout=subprocess.DEVNULL,
        stderr=theirs,
    )
    os.close(theirs)
    seen = b""
    while True:
        try:
            piece = os.read(ours, 4096)
        except OSError:  # a terminal whose other side has gone
            piece = b""
        if not piece:
            break
        seen += piece
    os.close(ours)
    assert process.wait(timeout=PATIENCE) == 1
    return seen.decode("utf-8", "replace")


@pytest.mark.parametrize("on_terminal", [True, False])
def test_a_long_compilation_is_shown_on_a_terminal_only(on_terminal: bool, tmp_path: Path) -> None:
    compiler = script(tmp_path / "slow-cc", "sleep 2; exit 1")
    text = told(compiler, tmp_path / "cache", on_terminal)
    assert ("compiling BackspinHoop: the C compiler" in text) is on_terminal
    assert "E0802" in text
