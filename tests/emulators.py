"""Programs that run libraries of other platforms here, where they are installed."""

from __future__ import annotations

import shutil
from pathlib import Path

_ARM_LIBRARIES = Path("/usr/aarch64-linux-gnu")


def qemu() -> list[str] | None:
    """The words before a program for Linux on aarch64, or None."""
    program = shutil.which("qemu-aarch64")
    found = program is not None and (_ARM_LIBRARIES / "lib/ld-linux-aarch64.so.1").exists()
    return [str(program), "-L", str(_ARM_LIBRARIES)] if found else None


def wine() -> list[str] | None:
    """The words before a program for Windows, or None."""
    program = shutil.which("wine")
    return None if program is None else [program]


def told() -> str:
    """What of the tests of FMUs runs here, in a line."""
    runs = (("aarch64-linux", "qemu-user", qemu()), ("x86_64-windows", "wine", wine()))
    return "; ".join(
        f"{platform}: run under {name}"
        if found
        else f"{platform}: inspected, not run, for {name} is not installed"
        for platform, name, found in runs
    )
