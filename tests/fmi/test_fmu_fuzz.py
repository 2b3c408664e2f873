"""Calls in any order with any arguments: the process lives."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest


@pytest.mark.parametrize("seed", [1, 2])
def test_random_calls_do_not_crash(libraries: dict[int, Path], version: int, seed: int) -> None:
    script = Path(__file__).with_name("fmu_fuzz.py")
    command = [sys.executable, str(script), str(libraries[version]), str(version), str(seed), "150"]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run(
        command, capture_output=True, text=True, timeout=300, check=False, env=environment
    )
    assert done.returncode == 0, done.stderr[-2000:]
