"""Packing a program as an FMU."""

from __future__ import annotations

import secrets
import tempfile
import zipfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from frot.runtime.fmi.about import About
from frot.runtime.fmi.arrays import grouped
from frot.runtime.fmi.description import model_description
from frot.runtime.fmi.documentation import documentation
from frot.runtime.fmi.faults import faults_of
from frot.runtime.fmi.names import model_identifier
from frot.runtime.fmi.platforms import (
    NATIVE,
    check_version,
    platform_folder,
    suffix,
    without_repetition,
)
from frot.runtime.fmi.scalars import scalars
from frot.runtime.fmi.sources import build_description, source_files, to_compile
from frot.runtime.fmi.terminals import terminals_and_icon
from frot.runtime.program import Program

Compile = Callable[[Sequence[Path], Sequence[Path], Mapping[str, Path]], None]

# The archive is the same, to the last byte, whenever it is made.
_EPOCH = (1980, 1, 1, 0, 0, 0)
NOTHING = About()


class InvalidFmuError(Exception):
    """The archive made does not satisfy the standard; `problems` are FMPy's."""

    def __init__(self, problems: Sequence[str]) -> None:
        super().__init__("the FMU is not valid: " + "; ".join(problems))
        self.problems = tuple(problems)


def export(
    program: Program,
    path: Path,
    fmi: str,
    compile_libraries: Compile,
    platforms: Sequence[str] = (NATIVE,),
    about: About = NOTHING,
    icon: bytes | None = None,
    arrays: bool = False,
) -> None:
    """Write `program` as an FMU of version `fmi` ("2.0" or "3.0") to `path`.

    `compile_libraries(sources, include_folders, targets)` makes shared libraries like the
    program's own, at the paths `targets` by platform, and raises if it cannot. `icon` is a `.png`.
    With `arrays`, which FMI 2.0 has not, vectors and matrices of the text are single variables.
    The file at `path` is replaced once the new one is complete and FMPy finds no fault in it; on
    failure nothing is left behind. ValueError for another version or platform, arrays in FMI 2.0,
    another suffix than `.fmu`, a date that is none or a program that FMI cannot describe; OSError
    if the file cannot be written; InvalidFmuError if FMPy finds problems.
    """
    check_version(fmi)
    if arrays and fmi == "2.0":
        raise ValueError("FMI 2.0 has no arrays, FMI 3.0 has")
    if path.suffix != ".fmu":
        raise ValueError(f"an FMU is a file with the suffix .fmu, not '{path.name}'")
    with tempfile.TemporaryDirectory() as folder:
        chosen = without_repetition(platforms)
        members = _members(program, fmi, compile_libraries, chosen, Path(folder), about, arrays)
    members |= _shown(program, fmi, icon, arrays)
    temporary = path.with_name(f".{path.stem}.{secrets.token_hex(4)}.fmu")
    try:
        _write(members, temporary)
        problems = faults_of(str(temporary))
        if problems:
            raise InvalidFmuError(problems)
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


def _members(
    program: Program,
    fmi: str,
    compile_libraries: Compile,
    platforms: Sequence[str],
    folder: Path,
    about: About,
    arrays: bool,
) -> dict[str, bytes]:
    """The files of the archive by name, in order; libraries are built from the sources in it."""
    identifier = model_identifier(program.name)
    sources = source_files(program, fmi, arrays)
    compiled = to_compile(sources)
    source_folder = folder / "sources"
    source_folder.mkdir()
    for name, content in sources.items():
        (source_folder / name).write_bytes(content)
    made = folder / "made"
    made.mkdir()
    libraries = {name: made / name / f"{identifier}{suffix(name)}" for name in platforms}
    for library in libraries.values():
        library.parent.mkdir()
    compile_libraries([source_folder / name for name in compiled], [source_folder], libraries)
    members = {
        "modelDescription.xml": model_description(program, fmi, compiled, about, arrays),
        "documentation/index.html": documentation(program),
    }
    for name, library in libraries.items():
        members[f"{platform_folder(fmi, name)}/{library.name}"] = library.read_bytes()
    if fmi == "3.0":
        members["sources/buildDescription.xml"] = build_description(program, compiled)
    return members | {f"sources/{name}": content for name, content in sources.items()}


def _shown(program: Program, fmi: str, icon: bytes | None, arrays: bool) -> dict[str, bytes]:
    """Where the versions look for terminals and for a picture of the FMU."""
    if fmi == "3.0":
        return terminals_and_icon(grouped(scalars(program)[1], arrays), icon)
    return {} if icon is None else {"model.png": icon}


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
