"""Platforms as FMI names them: what their libraries are called and where these lie."""

from __future__ import annotations

import platform
from collections.abc import Mapping, Sequence

VERSIONS = ("2.0", "3.0")
# Of those that `platforms` names, the library of this machine, made by its own compiler and linker.
NATIVE = "native"
# What exports are made for, by FMI 3.0's names, with the suffixes of libraries.
SUFFIXES: Mapping[str, str] = {
    "x86_64-linux": ".so",
    "aarch64-linux": ".so",
    "x86_64-windows": ".dll",
    "x86_64-darwin": ".dylib",
    "aarch64-darwin": ".dylib",
}
_MACHINES = {
    "x86_64": "x86_64",
    "amd64": "x86_64",
    "aarch64": "aarch64",
    "arm64": "aarch64",
    "i386": "x86",
    "i686": "x86",
    "x86": "x86",
}
_SYSTEMS = {"linux": ".so", "darwin": ".dylib", "windows": ".dll"}
# FMI 2.0 names these; elsewhere FMI 3.0's name is the custom.
_FMI2_FOLDERS = {
    "x86_64-linux": "linux64",
    "x86-linux": "linux32",
    "x86_64-windows": "win64",
    "x86-windows": "win32",
    "x86_64-darwin": "darwin64",
}


def check_version(fmi: str) -> None:
    """ValueError for a version of FMI there is not."""
    if fmi not in VERSIONS:
        raise ValueError(f"there is no FMI {fmi} here, only {' and '.join(VERSIONS)}")


def own_platform() -> str:
    """The platform of this machine; RuntimeError for one that FMI does not name."""
    machine, system = platform.machine().lower(), platform.system().lower()
    if machine not in _MACHINES or system not in _SYSTEMS:
        raise RuntimeError(f"FMI has no name for the platform {machine} {system}")
    return f"{_MACHINES[machine]}-{system}"


def platform_folder(fmi: str, name: str = NATIVE) -> str:
    """The folder of a platform's library in an archive of version `fmi`, `binaries/linux64`.

    ValueError for a version there is not; RuntimeError for a machine that FMI does not name.
    """
    check_version(fmi)
    name = own_platform() if name == NATIVE else name
    return "binaries/" + (_FMI2_FOLDERS.get(name, name) if fmi == "2.0" else name)


def suffix(name: str) -> str:
    """The suffix of a platform's library, `.so`."""
    return _SYSTEMS[(own_platform() if name == NATIVE else name).partition("-")[2]]


def check_platforms(names: Sequence[str]) -> None:
    """ValueError if there is none, or one that no library is made for."""
    unknown = [name for name in names if name not in SUFFIXES and name != NATIVE]
    if unknown or not names:
        raise ValueError(
            f"no library is made for {', '.join(unknown) or 'no platform'}; there are "
            f"{', '.join(SUFFIXES)} and {NATIVE}"
        )


def without_repetition(names: Sequence[str]) -> tuple[str, ...]:
    """Each platform once, in order; `native` alone where this machine's is named besides."""
    check_platforms(names)
    own = own_platform() if NATIVE in names else ""
    return tuple(dict.fromkeys(name for name in names if name != own))
