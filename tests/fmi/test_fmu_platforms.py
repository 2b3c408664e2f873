"""Libraries for other platforms: what their files say, and the same motion where they run."""

from __future__ import annotations

import os
import re
import struct
import subprocess
import zipfile
import zlib
from collections.abc import Iterator
from pathlib import Path

import fmpy
import numpy as np
import pytest
from all_platforms import READ, compile_quickly
from emulators import qemu, wine
from fmu_host import OK, Host
from frot.compiler.toolchain import targets
from frot.dsl.files.folders import room
from frot.runtime import fmi
from frot.runtime.program import Program
from libraries import elf, mach_o, pe

import frot

HERE = Path(__file__).parent
MODELS = HERE.parents[1] / "models"
HEADERS = Path(fmpy.__file__).parent / "c-code"
PLATFORMS = tuple(targets.TARGETS)
STEPS, STEP = 40, 0.05


class Everywhere:
    """A pendulum on a dry pin: one archive for all platforms, unpacked."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.model = frot.load(MODELS / "dry_pendulum.frot")
        self.program = self.model.program()
        self.model.export_fmu(folder / "pendulum.fmu", platforms=PLATFORMS)
        with zipfile.ZipFile(folder / "pendulum.fmu") as file:
            self.names = file.namelist()
            file.extractall(folder)
        parameters = 1 + len(self.program.parameters) + len(self.program.inputs)
        modes = len(self.program.contacts)
        self.reals = [v.name for v in self.program.variables[modes:] if v.type == "real"]
        assert [v.name for v in self.program.variables[modes:]] == self.reals
        self.first = parameters + modes

    def library(self, platform: str) -> Path:
        """Of a platform."""
        (found,) = (self.folder / fmi.platform_folder("2.0", platform)).iterdir()
        return found

    def expected(self) -> np.ndarray:
        """What this machine's library gives: a row of all reals a step."""
        one = Host(self.library("native"), 2, token=self.program.key.encode())
        one.start()
        rows = []
        for i in range(STEPS):
            assert one.step(i * STEP, STEP) == OK, one.messages
            rows.append([one.get(self.first + k) for k in range(len(self.reals))])
        one.free()
        return np.array(rows)

    def host(self, platform: str, link: tuple[str, ...]) -> Path:
        """A program for a platform that runs its library."""
        toolchain = targets.toolchain_for(targets.TARGETS[platform], self.folder / "zig")
        words = {
            "LIBRARY": f'"{self.library(platform).relative_to(self.folder)}"',
            "TOKEN": f'"{self.program.key}"',
            "FIRST": self.first,
            "COUNT": len(self.reals),
            "STEPS": STEPS,
            "STEP": STEP,
        }
        defined = [f"-D{name}={value}" for name, value in words.items()]
        made, program = self.folder / f"{platform}.o", self.folder / f"{platform}.exe"
        environment = os.environ | dict(toolchain.environment)
        compiled = ["-O1", "-c", f"-I{HEADERS}", *defined, str(HERE / "host.c"), "-o", str(made)]
        # With the start-up code of a C library it would take a minute to link.
        linked = ["-nostdlib", str(made), *link, "-o", str(program)]
        for arguments in (compiled, linked):
            subprocess.run([*toolchain.command, *arguments], check=True, env=environment)
        return program

    def run(self, words: list[str], program: Path, **changes: str) -> np.ndarray:
        """The rows that a host writes."""
        done = subprocess.run(
            [*words, str(program)],
            check=True,
            cwd=self.folder,
            env=os.environ | changes,
            capture_output=True,
            text=True,
            timeout=300,
        )
        rows = [line.split() for line in done.stdout.splitlines()]
        return np.array([[struct.unpack(">d", bytes.fromhex(x))[0] for x in row] for row in rows])


@pytest.fixture(scope="module")
def everywhere(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Everywhere]:
    with pytest.MonkeyPatch.context() as patch:
        compile_quickly(patch)
        yield Everywhere(tmp_path_factory.mktemp("everywhere"))


def functions() -> set[str]:
    """The 44 that a library of FMI 2.0 has to export."""
    text = (HEADERS / "fmi2Functions.h").read_text()
    found = set(re.findall(r"FMI2_Export\s+fmi2\w+TYPE\s+(\w+);", text))
    assert len(found) == 44
    return found


def test_archives_hold_all_platforms(everywhere: Everywhere) -> None:
    libraries = {name for name in everywhere.names if name.startswith("binaries/")}
    assert libraries == {
        "binaries/linux64/DryPendulum.so",
        "binaries/aarch64-linux/DryPendulum.so",
        "binaries/win64/DryPendulum.dll",
        "binaries/darwin64/DryPendulum.dylib",
        "binaries/aarch64-darwin/DryPendulum.dylib",
    }


@pytest.mark.parametrize("platform", [name for name in PLATFORMS if name not in READ])
def test_a_library_takes_less_than_400_kb_of_an_archive(
    everywhere: Everywhere, platform: str
) -> None:
    content = everywhere.library(platform).read_bytes()
    assert len(content) < 750e3
    assert len(zlib.compress(content)) < 400e3


@pytest.mark.parametrize(
    ("platform", "machine"),
    [("x86_64-linux", "Advanced Micro Devices X86-64"), ("aarch64-linux", "AArch64")],
)
def test_a_library_for_linux_wants_glibc_of_2012_and_nothing_else(
    everywhere: Everywhere, platform: str, machine: str
) -> None:
    said = elf(everywhere.library(platform))
    assert said.machine == machine
    assert said.exported == functions()
    assert said.needed == {"libc.so.6", "libm.so.6"}
    assert said.oldest <= (2, 17)


def test_a_library_for_windows_wants_what_windows_has(everywhere: Everywhere) -> None:
    said = pe(everywhere.library("x86_64-windows"))
    assert said.machine == "pei-x86-64"
    assert said.exported == functions()
    assert said.needed
    assert all(re.fullmatch(r"api-ms-win-crt-\w+-l1-1-0\.dll", name) for name in said.needed)


@pytest.mark.parametrize(
    ("platform", "machine"), [("x86_64-darwin", "x86_64"), ("aarch64-darwin", "arm64")]
)
def test_a_library_for_macos_wants_its_own_alone(
    everywhere: Everywhere, platform: str, machine: str
) -> None:
    """Those for arm64 are not loaded unless they are signed, if only with their own digest."""
    said = mach_o(everywhere.library(platform))
    assert said.machine == machine
    assert {name for name in said.exported if name.startswith(("fmi", "frot"))} == functions()
    assert said.needed == {"/usr/lib/libSystem.B.dylib"}
    assert said.oldest == (11, 0)
    assert said.signed == (machine == "arm64")


def test_here_it_gives_the_bits_of_simulate(everywhere: Everywhere) -> None:
    """Though another linker bound it to an older C library."""
    result, rows = everywhere.model.simulate(stop=STEPS * STEP), everywhere.expected()
    for i in range(STEPS):
        at = result.at(i * STEP + STEP)
        assert [at[name] for name in everywhere.reals] == list(rows[i])


def same_motion(rows: np.ndarray, expected: np.ndarray) -> None:
    """But for rounding: the functions of mathematics are those of the system it runs on.

    Measured on six models: no difference on aarch64-linux but 2.5e-13 on one, on Windows 5e-11 of
    an acceleration. A motion that does not amplify rounding stays below its tolerance of 1e-8.
    """
    assert rows.shape == expected.shape
    size = np.maximum(np.abs(expected).max(axis=0), 1e-9 * np.abs(expected).max())
    assert (np.abs(rows - expected) / size).max() < 1e-9


if qemu() is not None:

    def test_under_qemu_it_moves_alike_on_aarch64(everywhere: Everywhere) -> None:
        program = everywhere.host("aarch64-linux", ("-lc", "-ldl", "-Wl,--entry=main"))
        same_motion(everywhere.run(qemu() or [], program), everywhere.expected())


if wine() is not None:

    @pytest.fixture
    def prefix(tmp_path: Path) -> Iterator[dict[str, str]]:
        """A Windows of its own, which ends with the test."""
        changes = {"WINEPREFIX": str(tmp_path / "wine"), "WINEDEBUG": "-all", "DISPLAY": ""}
        yield changes
        end = ["wineserver", "-k"]
        subprocess.run(end, check=False, env=os.environ | changes, capture_output=True)

    def test_under_wine_it_moves_alike_on_windows(
        everywhere: Everywhere, prefix: dict[str, str]
    ) -> None:
        link = ("-lkernel32", "-Wl,--entry=mainCRTStartup", "-Wl,--subsystem,console")
        program = everywhere.host("x86_64-windows", link)
        same_motion(everywhere.run(wine() or [], program, **prefix), everywhere.expected())


def test_wide_numbers_are_rounded_like_the_compilers_own(tmp_path: Path) -> None:
    """Of arithmetic in 128 bits that libraries carry along, two million results."""
    program = tmp_path / "drive"
    include = f"-I{room('frot.compiler.toolchain')}"
    source = str(HERE / "drive_binary128.c")
    subprocess.run(["cc", "-std=gnu99", "-O1", include, source, "-o", str(program)], check=True)
    done = subprocess.run([str(program), "20121225", "120000"], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")


def test_chosen_platforms_alone(everywhere: Everywhere, tmp_path: Path) -> None:
    """By FMI 3.0's names in both versions; this machine's once, though named twice."""
    own = fmi.platform_folder("3.0").removeprefix("binaries/")
    path = tmp_path / "chosen.fmu"
    everywhere.model.export_fmu(path, "3.0", [own, "native", "aarch64-darwin"])
    with zipfile.ZipFile(path) as file:
        names = [name for name in file.namelist() if name.startswith("binaries/")]
    folders = {f"binaries/{own}", "binaries/aarch64-darwin"}
    assert len(names) == 2 and {str(Path(name).parent) for name in names} == folders


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_folders_are_those_of_the_standard(program: Program, version: str, tmp_path: Path) -> None:
    def pretend(_: object, __: object, libraries: dict[str, Path]) -> None:
        for platform, path in libraries.items():
            path.write_text(platform)

    fmi.export(program, tmp_path / "a.fmu", version, pretend, PLATFORMS)
    with zipfile.ZipFile(tmp_path / "a.fmu") as file:
        found = {
            name: file.read(name).decode()
            for name in file.namelist()
            if name.startswith("binaries/")
        }
    folders = {platform: platform for platform in PLATFORMS}
    if version == "2.0":
        folders |= {
            "x86_64-linux": "linux64",
            "x86_64-windows": "win64",
            "x86_64-darwin": "darwin64",
        }
    suffixes = {"linux": ".so", "windows": ".dll", "darwin": ".dylib"}
    assert found == {
        f"binaries/{folder}/Hand{suffixes[platform.partition('-')[2]]}": platform
        for platform, folder in folders.items()
    }


def test_without_ziglang_there_is_this_machines_library_alone(
    everywhere: Everywhere, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(targets, "_zig", lambda: None)
    everywhere.model.export_fmu(tmp_path / "native.fmu")
    with zipfile.ZipFile(tmp_path / "native.fmu") as file:
        names = [name for name in file.namelist() if name.startswith("binaries/")]
    assert [str(Path(name).parent) for name in names] == [fmi.platform_folder("2.0")]
    with pytest.raises(frot.FrotError, match="pip install ziglang"):
        everywhere.model.export_fmu(tmp_path / "a.fmu", platforms="x86_64-windows")
    assert not (tmp_path / "a.fmu").exists()
