"""The archive: valid for FMPy, complete, reproducible, rebuilt from its sources; no leftovers."""

from __future__ import annotations

import dataclasses
import errno
import hashlib
import re
import subprocess
import zipfile
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import fmpy
import numpy as np
import pytest
from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu
from fmu_host import METRE, ONE, RADIAN, Host, compile_libraries, compile_library
from frot.compiler.toolchain.objects import kernel_folder, kernel_sources
from frot.runtime import fmi
from frot.runtime.fmi.names import model_identifier, structured_name, variable_names
from frot.runtime.program import ExperimentInfo, ParameterInfo, Program, Unit, VariableInfo

KERNEL = {source.name for source in kernel_sources(kernel_folder())}
VERSIONS = ("2.0", "3.0")


@pytest.mark.parametrize("version", VERSIONS)
def test_fmpy_finds_no_fault(archives: dict[str, Path], version: str) -> None:
    assert validate_fmu(str(archives[version])) == []


@pytest.mark.parametrize("version", VERSIONS)
def test_only_the_functions_of_fmi_are_exported(libraries: dict[int, Path], version: str) -> None:
    major = version[0]
    header = Path(fmpy.__file__).parent / "c-code" / f"fmi{major}Functions.h"
    declared = set(
        re.findall(rf"FMI{major}_Export\s+fmi{major}\w+TYPE\s+(\w+);", header.read_text())
    )
    declared |= set(re.findall(rf"FMI{major}_Export.*?\b(fmi{major}[A-Z]\w+);", header.read_text()))
    command = ["nm", "-D", "--defined-only", str(libraries[int(major)])]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    assert {line.split()[-1] for line in lines} == declared
    assert len(declared) == {"2": 44, "3": 75}[major]


@pytest.mark.parametrize("version", VERSIONS)
def test_library_needs_libc_and_libm_only(libraries: dict[int, Path], version: str) -> None:
    command = ["readelf", "-d", str(libraries[int(version[0])])]
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    assert set(re.findall(r"NEEDED.*\[(.*)\]", text)) <= {"libc.so.6", "libm.so.6"}


@pytest.mark.parametrize("version", VERSIONS)
def test_library_has_no_mutable_data(libraries: dict[int, Path], version: str) -> None:
    """Instances share nothing: .data and .bss hold the compiler's own word or two."""
    command = ["size", "-A", str(libraries[int(version[0])])]
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    sizes = dict(re.findall(r"^(\.\w+)\s+(\d+)", text, re.MULTILINE))
    assert int(sizes.get(".data", 0)) <= 16
    assert int(sizes.get(".bss", 0)) <= 16


@pytest.mark.parametrize("version", VERSIONS)
def test_sources_compile_as_listed(
    archives: dict[str, Path], version: str, tmp_path: Path, program: Program
) -> None:
    """And give the motion of the library in the archive, to the last bit."""
    with zipfile.ZipFile(archives[version]) as file:
        file.extractall(tmp_path)
    sources = tmp_path / "sources"
    if version == "2.0":
        root = ET.parse(tmp_path / "modelDescription.xml").getroot()
        names = [element.get("name", "") for element in root.iter("File")]
    else:
        root = ET.parse(sources / "buildDescription.xml").getroot()
        names = [element.get("name", "") for element in root.iter("SourceFile")]
    assert names[0] == "model.c"
    compile_library([sources / name for name in names], [sources], tmp_path / "rebuilt.so")
    shipped = next((tmp_path / fmi.platform_folder(version)).iterdir())
    rows = []
    for library in (tmp_path / "rebuilt.so", shipped):
        one = Host(library, int(version[0]))
        one.start()
        rows.append(one.run(0.0, 5.0, 0.25))
        one.free()
    assert rows[0] == rows[1]


@pytest.mark.parametrize("dialect", ["c99", "gnu17"])
def test_sources_compile_in_strict_and_extended_c(
    archives: dict[str, Path], dialect: str, tmp_path: Path
) -> None:
    """Importers build with the compiler's extensions on, as CMake does."""
    compiled: dict[tuple[str, bytes], Path] = {}
    for version in VERSIONS:
        with zipfile.ZipFile(archives[version]) as file:
            names = [name for name in file.namelist() if name.startswith("sources/")]
            file.extractall(tmp_path / version, names)
        headers = b"".join((tmp_path / version / n).read_bytes() for n in names if n.endswith(".h"))
        for path in (tmp_path / version / n for n in names if n.endswith(".c")):
            # Both versions carry the same kernel: once is enough.
            seen = path.read_bytes() if path.name in KERNEL else headers + path.read_bytes()
            compiled.setdefault((path.name, seen), path)
    command = ["cc", f"-std={dialect}", "-fsyntax-only", "-Wall", "-Wextra", *compiled.values()]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("version", VERSIONS)
def test_same_program_same_archive(
    archives: dict[str, Path], version: str, tmp_path: Path, program: Program
) -> None:
    again = tmp_path / "again.fmu"
    fmi.export(program, again, version, compile_libraries)
    digests = {hashlib.sha256(p.read_bytes()).hexdigest() for p in (again, archives[version])}
    assert len(digests) == 1


@pytest.mark.parametrize("version", VERSIONS)
def test_archive_is_plain(archives: dict[str, Path], version: str) -> None:
    with zipfile.ZipFile(archives[version]) as file:
        names = file.namelist()
        for info in file.infolist():
            assert info.compress_type == zipfile.ZIP_DEFLATED
            assert info.extract_version <= 20
            assert "\\" not in info.filename
    assert names[0] == "modelDescription.xml"
    assert "documentation/index.html" in names
    assert {"sources/model.c", "sources/frot.h", "sources/model.h", "sources/fmu_table.c"} <= set(
        names
    )
    assert f"sources/fmi{version[0]}Functions.h" in names


@pytest.mark.parametrize("version", VERSIONS)
def test_fmpy_runs_it(archives: dict[str, Path], version: str) -> None:
    result = simulate_fmu(
        str(archives[version]),
        stop_time=12.0,
        output_interval=0.5,
        start_values={"x0": (1500.0, "mm"), "count": 4, "pulled": True},
        output=["x", "guide.mode", "clock"],
    )
    assert result["x"][0] == 1.5
    assert result["clock"][-1] == 16.0
    assert result["guide.mode"][-1] == 1


@pytest.mark.parametrize("version", VERSIONS)
def test_input_signal(archives: dict[str, Path], version: str) -> None:
    """A push below the bound of friction moves nothing, one above moves the block."""
    push = np.array([(0.0, 0.5), (1.0, 0.5), (1.0, 3.0), (2.0, 3.0)],
                    dtype=[("time", float), ("push", float)])  # fmt: skip
    result = simulate_fmu(
        str(archives[version]),
        stop_time=2.0,
        output_interval=0.25,
        start_values={"x0": 0.0},
        input=push,
        output=["x"],
    )
    x, t = result["x"], result["time"]
    assert np.all(x[t <= 1.0] == 0.0)
    assert x[-1] > 0.0


@pytest.mark.parametrize("version", VERSIONS)
def test_description_says_units_causality_and_start(
    archives: dict[str, Path], version: str
) -> None:
    description = read_model_description(str(archives[version]))
    by_name = {variable.name: variable for variable in description.modelVariables}
    assert description.coSimulation.canGetAndSetFMUstate
    x0 = by_name["x0"]
    assert (x0.causality, x0.variability, x0.unit, x0.displayUnit) == (
        "parameter",
        "tunable",
        "m",
        "mm",
    )
    assert float(x0.start) == 2.0
    (metre,) = (unit for unit in description.unitDefinitions if unit.name == "m")
    assert metre.displayUnits[0].factor == pytest.approx(1000.0)
    weight = by_name["weight"]
    assert (weight.causality, weight.start) == ("calculatedParameter", None)
    mode = by_name["guide.mode"]
    assert (mode.causality, mode.variability) == ("output", "discrete")
    items = [(item.name, int(item.value)) for item in mode.declaredType.items]
    assert items == [("open", 0), ("stick", 1), ("slip", 2)]
    experiment = description.defaultExperiment
    assert [float(x) for x in (experiment.startTime, experiment.stopTime)] == [0.0, 12.0]
    assert float(experiment.tolerance) == 1e-10
    # Where the text is silent importers are told what `frot simulate` takes: a 500th of the run.
    assert float(experiment.stepSize) == 12.0 / 500
    assert description.variableNamingConvention == "structured"


def test_structured_names() -> None:
    assert structured_name("hoop.position.x") == "hoop.position.x"
    assert structured_name("chain[3].link[1, 2].theta") == "chain[3].link[1,2].theta"
    assert structured_name("odd name.x") == "'odd name'.x"
    assert structured_name("it's.x") == r"'it\'s'.x"
    assert structured_name("der(a.b)") == "der(a.b)"
    assert structured_name("der(tank[1].odd level)") == "der(tank[1].'odd level')"
    assert structured_name("der(der(a.b))") == "der(a.b,2)"
    assert structured_name("a.der(b)") == "a.'der(b)'"
    assert structured_name("réservoir.x") is None
    assert structured_name("der(réservoir.x)") is None
    assert variable_names(["a.b", "réservoir.x"]) == ("flat", ("a.b", "réservoir.x"))
    assert model_identifier("Échelle 2") == "_chelle_2"
    with pytest.raises(ValueError, match=r"share a name: a\.b"):
        variable_names(["a.b", "c", "a.b"])


@pytest.mark.parametrize("version", VERSIONS)
def test_an_experiment_without_words_is_that_of_simulate(
    program: Program, version: str, tmp_path: Path
) -> None:
    silent = dataclasses.replace(program, experiment=ExperimentInfo(None, None, None, None, "rest"))
    path = tmp_path / "silent.fmu"
    fmi.export(silent, path, version, compile_libraries)
    told = read_model_description(str(path)).defaultExperiment
    values = (told.startTime, told.stopTime, told.tolerance, told.stepSize)
    assert [float(x) for x in values] == [0.0, 1.0, 1e-8, 1.0 / 500]


def test_no_memory_of_the_environment_is_asked_for(archives: dict[str, Path]) -> None:
    description = read_model_description(str(archives["2.0"]))
    assert description.coSimulation.canNotUseMemoryManagementFunctions


@pytest.mark.parametrize("version", VERSIONS)
def test_names_beyond_ascii_and_quotes(program: Program, version: str, tmp_path: Path) -> None:
    first, second, *others = program.variables
    accented = dataclasses.replace(
        program,
        name="Échelle",
        doc='quotes "\u201c\u201d" \\ and ??/ trigraphs',
        variables=(dataclasses.replace(first, name="appui.état"), second, *others),
        parameters=(
            dataclasses.replace(program.parameters[0], name="frottement_é"),
            *program.parameters[1:],
        ),
    )
    path = tmp_path / "échelle.fmu"
    fmi.export(accented, path, version, compile_libraries)
    result = simulate_fmu(str(path), stop_time=1.0, output=["x", "appui.état"])
    assert "appui.état" in (result.dtype.names or ())


def test_angles_and_plain_numbers(program: Program, tmp_path: Path) -> None:
    shown = dataclasses.replace(
        program,
        parameters=(
            ParameterInfo("mu", "real", Unit(""), 0.1, ""),
            ParameterInfo("k", "real", RADIAN, 9.0, ""),
            *program.parameters[2:],
        ),
    )
    for version in VERSIONS:
        path = tmp_path / f"angles{version[0]}.fmu"
        fmi.export(shown, path, version, compile_libraries)
        description = read_model_description(str(path))
        (rad,) = (unit for unit in description.unitDefinitions if unit.name == "rad")
        assert rad.baseUnit.rad == 1
        assert rad.displayUnits[0].factor == pytest.approx(57.29577951308232)


def test_contradictory_descriptions_are_refused(program: Program, tmp_path: Path) -> None:
    path = tmp_path / "bad.fmu"
    twice = (*program.variables[:-1], VariableInfo("mu", "real", ONE, "local", ""))
    other = (
        *program.variables[:-1],
        VariableInfo("y", "real", Unit("m", (2,) + (0,) * 7), "local", ""),
    )
    for variables, message in ((twice, "share a name"), (other, "unit 'm' has two meanings")):
        with pytest.raises(ValueError, match=message):
            fmi.export(
                dataclasses.replace(program, variables=variables), path, "2.0", compile_libraries
            )
    assert list(tmp_path.iterdir()) == []
    assert METRE.display == "mm"


def _full_disk(*_: object, **__: object) -> None:
    raise OSError(errno.ENOSPC, "No space left on device")


def _no_compiler(*_: object) -> None:
    raise RuntimeError("no C compiler")


@pytest.mark.parametrize(
    ("broken", "compile_it", "error"),
    [
        ("disk", compile_libraries, OSError),
        ("compiler", _no_compiler, RuntimeError),
        ("archive", compile_libraries, fmi.InvalidFmuError),
    ],
)
def test_nothing_is_left_behind_and_the_old_file_stays(
    program: Program,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    broken: str,
    compile_it: Callable[..., None],
    error: type[Exception],
) -> None:
    path = tmp_path / "old.fmu"
    path.write_bytes(b"old")
    if broken == "archive":
        module = import_module("frot.runtime.fmi.export")
        monkeypatch.setattr(module, "faults_of", lambda _: ["a problem", "another"])
    elif broken == "disk":
        monkeypatch.setattr(zipfile.ZipFile, "writestr", _full_disk)
    with pytest.raises(error):
        fmi.export(program, path, "3.0", compile_it)
    assert [p.name for p in tmp_path.iterdir()] == ["old.fmu"]
    assert path.read_bytes() == b"old"


def test_wrong_requests(program: Program, tmp_path: Path) -> None:
    with pytest.raises(OSError, match="No such file"):
        fmi.export(program, tmp_path / "nowhere" / "a.fmu", "2.0", compile_libraries)
    with pytest.raises(ValueError, match=r"no FMI 1\.0 here"):
        fmi.export(program, tmp_path / "a.fmu", "1.0", compile_libraries)
    with pytest.raises(ValueError, match=r"suffix \.fmu"):
        fmi.export(program, tmp_path / "a.zip", "2.0", compile_libraries)
    with pytest.raises(ValueError, match=r"no FMI 4 here"):
        fmi.platform_folder("4")


@pytest.mark.parametrize(
    ("machine", "system", "two", "three"),
    [
        ("x86_64", "Linux", "linux64", "x86_64-linux"),
        ("aarch64", "Linux", "aarch64-linux", "aarch64-linux"),
        ("AMD64", "Windows", "win64", "x86_64-windows"),
        ("arm64", "Darwin", "aarch64-darwin", "aarch64-darwin"),
        ("x86_64", "Darwin", "darwin64", "x86_64-darwin"),
    ],
)
def test_platform_folders(
    monkeypatch: pytest.MonkeyPatch, machine: str, system: str, two: str, three: str
) -> None:
    monkeypatch.setattr("platform.machine", lambda: machine)
    monkeypatch.setattr("platform.system", lambda: system)
    assert fmi.platform_folder("2.0") == f"binaries/{two}"
    assert fmi.platform_folder("3.0") == f"binaries/{three}"


def test_platform_without_name(monkeypatch: pytest.MonkeyPatch, program: Any) -> None:
    monkeypatch.setattr("platform.machine", lambda: "s390x")
    with pytest.raises(RuntimeError, match="s390x"):
        fmi.platform_folder("2.0")
