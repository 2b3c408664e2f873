"""The sources of an FMU, built by other compilers as docs/fmu.md says, and run."""

from __future__ import annotations

import os
import shutil
import struct
import subprocess
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from emulators import wine
from fmu_host import OK, Host

import frot

HERE = Path(__file__).parent
MODEL = HERE.parents[1] / "models" / "coulomb_oscillator.frot"
HEADERS = Path(fmpy.__file__).parent / "c-code"
MINGW = "x86_64-w64-mingw32-gcc"
WORDS = ("-std=c99", "-O1", "-ffp-contract=off")
# Compiler and version of FMI: words for an object. tcc has no optimization, and ignores its words.
BUILDS = {
    ("gcc", "3.0"): ("-std=c99", "-O0", "-ffp-contract=off", "-fPIC"),
    ("clang", "2.0"): (*WORDS, "-fPIC"),
    ("tcc", "2.0"): ("-std=c99", "-fPIC"),
    ("tcc", "3.0"): ("-std=c99", "-fPIC"),
    (MINGW, "2.0"): ("-std=c99", "-O0", "-ffp-contract=off"),
}
HERE_TOO = [one for one in BUILDS if one[0] != MINGW]
# Rounding of the functions of mathematics of another system, and what the motion makes of it.
ALIKE = 1e-9
STEPS, STEP = 20, 0.1


@pytest.fixture(scope="module")
def model() -> frot.Model:
    return frot.load(MODEL)


def unpack(model: frot.Model, version: str, folder: Path) -> Path:
    """The folder of an FMU with the library of this machine."""
    model.export_fmu(folder / "a.fmu", version, "native")
    with zipfile.ZipFile(folder / "a.fmu") as archive:
        archive.extractall(folder)
    return folder


def build(compiler: str, version: str, folder: Path, library: str, *linked: str) -> Path:
    """The library of all sources in the folder, objects two at a time."""
    words, objects = BUILDS[compiler, version], folder / "objects"
    objects.mkdir()
    lines = "\n".join(str(path) for path in (folder / "sources").glob("*.c"))
    done = subprocess.run(
        ["xargs", "-P2", "-n10", compiler, *words, "-w", f"-I{folder / 'sources'}", "-c"],
        input=lines,
        cwd=objects,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    made = folder / library
    files = sorted(map(str, objects.glob("*.o")))
    subprocess.run([compiler, "-shared", "-o", str(made), *files, *linked, "-lm"], check=True)
    return made


def reals(model: frot.Model) -> tuple[int, int]:
    """The value reference of the first variable, and how many follow that are real numbers."""
    program = model.program()
    kinds = [v.type for v in program.variables]
    first = next(k for k, kind in enumerate(kinds) if kind == "real")
    count = next((k for k, kind in enumerate(kinds[first:]) if kind != "real"), len(kinds) - first)
    return 1 + len(program.parameters) + len(program.inputs) + first, count


def rows(library: Path, version: str, model: frot.Model) -> np.ndarray:
    """Real variables after each step, of an instance in this process."""
    one = Host(library, int(version[0]), token=model.program().key.encode())
    first, count = reals(model)
    one.start()
    found = []
    for k in range(STEPS):
        assert one.step(k * STEP, STEP) == OK, one.messages
        found.append([one.get(first + i) for i in range(count)])
    one.free()
    return np.array(found)


def same_motion(got: np.ndarray, expected: np.ndarray) -> None:
    assert got.shape == expected.shape and expected.shape[1] > 5
    size = np.maximum(np.abs(expected).max(axis=0), 1e-9 * np.abs(expected).max())
    assert (np.abs(got - expected) / size).max() < ALIKE


@pytest.mark.parametrize(("compiler", "version"), HERE_TOO)
def test_a_compiler_of_this_system_builds_what_moves_alike(
    model: frot.Model, compiler: str, version: str, tmp_path: Path
) -> None:
    """With gcc and clang to the last bit."""
    if shutil.which(compiler) is None:
        pytest.skip(f"{compiler} is not installed")
    folder = unpack(model, version, tmp_path)
    (own,) = folder.glob("binaries/*/*.so")
    expected = rows(own, version, model)
    got = rows(build(compiler, version, folder, "built.so"), version, model)
    same_motion(got, expected)
    if compiler != "tcc":
        assert np.array_equal(got, expected)


def test_mingw_builds_what_moves_alike_on_windows(model: frot.Model, tmp_path: Path) -> None:
    """With -static-libgcc it needs the libraries of Windows alone."""
    if shutil.which(MINGW) is None:
        pytest.skip(f"{MINGW} is not installed")
    folder = unpack(model, "2.0", tmp_path)
    built = build(MINGW, "2.0", folder, "built.dll", "-static-libgcc")
    read = subprocess.run(
        [MINGW.replace("gcc", "objdump"), "-p", str(built)],
        capture_output=True,
        text=True,
        check=True,
    )
    lines = [line.split() for line in read.stdout.splitlines() if "DLL Name" in line]
    needed = {words[-1].lower() for words in lines}
    assert "kernel32.dll" in needed
    assert all(
        name in ("kernel32.dll", "msvcrt.dll", "ucrtbase.dll") or name.startswith("api-ms-win-crt")
        for name in needed
    )
    if wine() is None:
        pytest.skip("wine is not installed: the library was built, and not run")
    first, count = reals(model)
    words = {
        "LIBRARY": '"built.dll"',
        "TOKEN": f'"{model.program().key}"',
        "FIRST": first,
        "COUNT": count,
        "STEPS": STEPS,
        "STEP": STEP,
    }
    defined = [f"-D{name}={value}" for name, value in words.items()]
    linked = ("-nostdlib", "-lkernel32", "-Wl,--entry=mainCRTStartup")
    host = folder / "host.exe"
    source = str(HERE / "host.c")
    command = [MINGW, "-O1", f"-I{HEADERS}", *defined, source, "-o", str(host), *linked]
    subprocess.run(command, check=True)
    changes = {"WINEPREFIX": str(folder / "wine"), "WINEDEBUG": "-all", "DISPLAY": ""}
    environment = os.environ | changes
    done = subprocess.run(
        [*(wine() or []), str(host)],
        check=True,
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        timeout=300,
    )
    subprocess.run(["wineserver", "-k"], check=False, env=environment, capture_output=True)
    got = [
        [struct.unpack(">d", bytes.fromhex(x))[0] for x in line.split()]
        for line in done.stdout.splitlines()
    ]
    (own,) = folder.glob("binaries/*/*.so")
    same_motion(np.array(got), rows(own, "2.0", model))
