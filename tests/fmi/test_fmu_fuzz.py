"""Calls in any order with any arguments: the process lives, and every call ends."""

from __future__ import annotations

import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from fmu_host import X0, Host
from patience import PATIENCE


@pytest.mark.parametrize(("seed", "threads"), [(1, 1), (2, 1), (3, 4)])
def test_random_calls_do_not_crash(
    hasty: dict[int, Path], version: int, seed: int, threads: int
) -> None:
    script = Path(__file__).with_name("fmu_fuzz.py")
    words = (hasty[version], version, seed, 150, threads)
    command = [sys.executable, str(script), *map(str, words)]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run(
        command, capture_output=True, text=True, timeout=PATIENCE, check=False, env=environment
    )
    assert done.returncode == 0, done.stderr[-2000:]


def test_instances_in_threads_do_not_disturb_each_other(
    libraries: dict[int, Path], version: int
) -> None:
    """Calls by ctypes leave Python's lock: eight instances run at once, each with its own start."""
    starts = [0.25 * (k + 1) for k in range(8)]

    def run(x0: float) -> list[tuple[float, ...]]:
        one = Host(libraries[version], version)
        one.set(X0, x0)
        one.start()
        rows = one.run(0.0, 10.0, 0.01)
        one.free()
        return rows

    with ThreadPoolExecutor(len(starts)) as pool:
        together = list(pool.map(run, starts))
    assert together == [run(x0) for x0 in starts]
