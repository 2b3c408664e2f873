"""The hand-written model as FMUs of both versions."""

from __future__ import annotations

import re
import sys
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from fmu_host import (
    MOST_WORK,
    Host,
    compile_libraries,
    compile_library,
    hand_program,
    unpack_library,
)
from frot.runtime import fmi
from frot.runtime.program import Program


@pytest.fixture(scope="session")
def program(tmp_path_factory: pytest.TempPathFactory) -> Program:
    return hand_program(tmp_path_factory.mktemp("hand"))


@pytest.fixture(scope="session")
def archives(program: Program, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("fmu")
    paths = {}
    for version in ("2.0", "3.0"):
        paths[version] = folder / f"Hand{version[0]}.fmu"
        fmi.export(program, paths[version], version, compile_libraries)
    return paths


@pytest.fixture(scope="session")
def libraries(
    archives: dict[str, Path], tmp_path_factory: pytest.TempPathFactory
) -> dict[int, Path]:
    return {
        int(version[0]): unpack_library(path, version, tmp_path_factory.mktemp(f"fmi{version[0]}"))
        for version, path in archives.items()
    }


@pytest.fixture(scope="session")
def hasty(archives: dict[str, Path], tmp_path_factory: pytest.TempPathFactory) -> dict[int, Path]:
    """Libraries that give a step up after MOST_WORK evaluations, so that nobody waits for it."""
    found = {}
    for version, path in archives.items():
        folder = tmp_path_factory.mktemp("hasty")
        with zipfile.ZipFile(path) as file:
            names = [name for name in file.namelist() if name.startswith("sources/")]
            file.extractall(folder, names)
        sources = [folder / name for name in names if name.endswith(".c")]
        found[int(version[0])] = folder / "hasty.so"
        table = folder / "sources" / "fmu_table.c"
        text, count = re.subn(r"most_work = \d+", f"most_work = {MOST_WORK}", table.read_text())
        assert count == 1
        table.write_text(text)
        compile_library(sources, [folder / "sources"], folder / "hasty.so")
    return found


@pytest.fixture(params=[2, 3], ids=["fmi2", "fmi3"])
def version(request: pytest.FixtureRequest) -> int:
    return int(request.param)


@pytest.fixture
def host(libraries: dict[int, Path], version: int) -> Iterator[Callable[..., Host]]:
    """Makes instances, frees them at the end."""
    made: list[Host] = []

    def make(**options: Any) -> Host:
        made.append(Host(libraries[version], version, **options))
        return made[-1]

    yield make
    for one in made:
        if one.instance is not None:
            one.free()
