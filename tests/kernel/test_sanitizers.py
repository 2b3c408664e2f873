"""The kernel under the address and undefined-behaviour sanitizers, on the worked models."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest
from frot.compiler.driver import kernel_folder, kernel_sources
from frot.runtime.program import Program

STOPS = {"inclined_block": 3.0, "backspin_hoop": 3.0, "coulomb_oscillator": 12.0}
FLAGS = ("-std=c99", "-g", "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")


@pytest.mark.parametrize("name", STOPS)
def test_a_model_runs_clean_under_sanitizers(
    programs: dict[str, Program], name: str, tmp_path: Path
) -> None:
    binary = tmp_path / "drive"
    sources = [Path(__file__).parent / "drive.c", programs[name].source, *kernel_sources()]
    subprocess.run(
        ["cc", *FLAGS, f"-I{kernel_folder()}", *map(str, sources), "-o", str(binary), "-lm"],
        check=True,
    )
    done = subprocess.run(
        [binary, str(STOPS[name])],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
        env={**os.environ, "ASAN_OPTIONS": "detect_leaks=1"},
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout == "0 failures\n"
