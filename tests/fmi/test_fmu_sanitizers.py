"""Wrapper and kernel under the address, leak and undefined behaviour sanitizers."""

from __future__ import annotations

import subprocess
from pathlib import Path

from c_objects import SANITIZED, c_objects
from frot.runtime.fmi.sources import source_files, to_compile
from frot.runtime.program import Program
from soak import soak

WARNINGS = ("-Wall", "-Wextra", "-Wconversion", "-pedantic", "-Werror")
OURS = (
    *("instance.c", "lifecycle.c", "stepping.c", "access.c", "snapshot.c", "inputs.c"),
    *("derivatives.c", "exchange.c", "events.c", "limits.c", "fmi", "fmu_table.c"),
)


def test_lives_of_instances_are_clean(version: int, program: Program, tmp_path: Path) -> None:
    sources = source_files(program, f"{version}.0")
    for name, content in sources.items():
        (tmp_path / name).write_bytes(content)
    drive = Path(__file__).with_name("drive.c")
    files = [tmp_path / name for name in to_compile(sources)]
    objects = c_objects(files, [tmp_path], SANITIZED)
    objects += c_objects([drive], [tmp_path], (*SANITIZED, f"-DDRIVE={version}"))
    command = ["cc", *SANITIZED, *map(str, objects), "-lm", "-o", str(tmp_path / "drive")]
    subprocess.run(command, check=True)
    done = subprocess.run([tmp_path / "drive"], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")


def test_random_calls_are_clean() -> None:
    """Ten thousand; `soak.py` makes a million."""
    assert soak(10_000, "address", 5) == 0


def test_two_instances_in_threads_share_nothing() -> None:
    """The sanitizer of threads finds no data race; `soak.py` has more calls and instances."""
    assert soak(2_000, "thread", 7, versions=(3,), instances=2) == 0


def test_our_c_compiles_without_warnings(version: int, program: Program, tmp_path: Path) -> None:
    sources = source_files(program, f"{version}.0")
    for name, content in sources.items():
        (tmp_path / name).write_bytes(content)
    ours = [str(tmp_path / name) for name in to_compile(sources) if name.startswith(OURS)]
    assert len(ours) >= 12
    command = ["cc", "-std=c99", "-O2", *WARNINGS, "-fsyntax-only", f"-I{tmp_path}", *ours]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
