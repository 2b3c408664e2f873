"""Packing a program as an FMU."""

from __future__ import annotations

import platform
import secrets
import tempfile
import zipfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from fmpy.validation import validate_fmu
from frot.runtime.fmi.description import model_description
from frot.runtime.fmi.documentation import documentation
from frot.runtime.fmi.names import model_identifier
from frot.runtime.fmi.sources import build_description, source_files, to_compile
from frot.runtime.program import Program

Compile = Callable[[Sequence[Path], Sequence[Path], Path], None]

VERSIONS = ("2.0", "3.0")

_MACHINES = {
    "x86_64": "x86_64",
    "amd64": "x86_64",
    "aarch64": "aarch64",
    "arm64": "aarch64",
    "i386": "x86",
    "i686": "x86",
    "x86": "x86",
}
_SYSTEMS = {
    "linux": ("linux", ".so"),
    "darwin": ("darwin", ".dylib"),
    "windows": ("windows", ".dll"),
}
# FMI 2.0 names these four; elsewhere FMI 3.0's name is the custom.
_FMI2_FOLDERS = {
    "x86_64-linux": "linux64",
    "x86-linux": "linux32",
    "x86_64-windows": "win64",
    "x86-windows": "win32",
    "x86_64-darwin": "darwin64",
}
# The archive is the same, to the last byte, whenever it is made.
_EPOCH = (1980, 1, 1, 0, 0, 0)


class InvalidFmuError(Exception):
    """The archive made does not satisfy the standard; `problems` are FMPy's."""

    def __init__(self, problems: Sequence[str]) -> None:
        super().__init__("the FMU is not valid: " + "; ".join(problems))
        self.problems = tuple(problems)


def _platform() -> tuple[str, str]:
    machine, system = platform.machine().lower(), platform.system().lower()
    if machine not in _MACHINES or system not in _SYSTEMS:
        raise RuntimeError(f"FMI has no name for the platform {machine} {system}")
    name, suffix = _SYSTEMS[system]
    return f"{_MACHINES[machine]}-{name}", suffix


def platform_folder(fmi: str) -> str:
    """The folder of this platform's library in an archive of version `fmi`, `binaries/linux64`.

    ValueError for a version there is not; RuntimeError for a platform that FMI does not name.
    """
    _check_version(fmi)
    name, _ = _platform()
    return "binaries/" + (_FMI2_FOLDERS.get(name, name) if fmi == "2.0" else name)


def export(program: Program, path: Path, fmi: str, compile_library: Compile) -> None:
    """Write `program` as an FMU for co-simulation of version `fmi` ("2.0" or "3.0") to `path`.

    `compile_library(sources, include_folders, target)` makes a shared library like the program's
    own and raises if it cannot. The file at `path` is replaced once the new one is complete and
    FMPy finds no fault in it; on failure nothing is left behind. ValueError for another version,
    another suffix than `.fmu` or a program that FMI cannot describe; OSError if the file cannot be
    written; InvalidFmuError if FMPy finds problems.
    """
    _check_version(fmi)
    if path.suffix != ".fmu":
        raise ValueError(f"an FMU is a file with the suffix .fmu, not '{path.name}'")
    with tempfile.TemporaryDirectory() as folder:
        members = _members(program, fmi, compile_library, Path(folder))
    temporary = path.with_name(f".{path.stem}.{secrets.token_hex(4)}.fmu")
    try:
        _write(members, temporary)
        problems = validate_fmu(str(temporary))
        if problems:
            raise InvalidFmuError(problems)
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


def _check_version(fmi: str) -> None:
    if fmi not in VERSIONS:
        raise ValueError(f"there is no FMI {fmi} here, only {' and '.join(VERSIONS)}")


def _members(
    program: Program, fmi: str, compile_library: Compile, folder: Path
) -> dict[str, bytes]:
    """The files of the archive by name, in order; the library is built from the sources in it."""
    _, suffix = _platform()
    identifier = model_identifier(program.name)
    sources = source_files(program, fmi)
    compiled = to_compile(sources)
    source_folder = folder / "sources"
    source_folder.mkdir()
    for name, content in sources.items():
        (source_folder / name).write_bytes(content)
    library = folder / f"{identifier}{suffix}"
    compile_library([source_folder / name for name in compiled], [source_folder], library)
    members = {
        "modelDescription.xml": model_description(program, fmi, compiled),
        "documentation/index.html": documentation(program),
        f"{platform_folder(fmi)}/{library.name}": library.read_bytes(),
    }
    if fmi == "3.0":
        members["sources/buildDescription.xml"] = build_description(program, compiled)
    return members | {f"sources/{name}": content for name, content in sources.items()}


def _write(members: Mapping[str, bytes], path: Path) -> None:
    with (
        path.open("xb") as file,
        zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED, allowZip64=False) as archive,
    ):
        for name, content in members.items():
            info = zipfile.ZipInfo(name, _EPOCH)
            info.compress_type = zipfile.ZIP_DEFLATED
            info.create_system = 3
            info.external_attr = (0o755 if name.startswith("binaries/") else 0o644) << 16
            archive.writestr(info, content)
