"""The C compiler: which one, and how it is called."""

from __future__ import annotations

import importlib.util
import os
import shlex
import shutil
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from frot.compiler.toolchain.keeper import Keeper
from frot.dsl.messages.errors import fail

_FLAGS = ("-std=c99", "-fPIC", "-ffp-contract=off")
KERNEL_FLAGS = (*_FLAGS, "-O2")
# Straight lines of arithmetic run as fast, to the same bits, and compile in two thirds of the time.
MODEL_FLAGS = (*_FLAGS, "-O1")
LINK_FLAGS = ("-shared", "-lm")
TIMEOUT = 600.0
_OTHER = "set FROT_CC to another compiler, or report this with the model"


@dataclass(frozen=True, slots=True)
class Toolchain:
    """A C compiler as the words of a command, and what identifies it: words, size and date."""

    command: tuple[str, ...]
    identity: str


def find_toolchain() -> Toolchain:
    """`$FROT_CC`, else `cc`, `gcc` or `clang` on the path, else the `ziglang` package.

    Raises FrotError (E0801) when there is none.
    """
    wanted = os.environ.get("FROT_CC", "").strip()
    if wanted:
        try:
            words = shlex.split(wanted)
        except ValueError as error:
            raise fail(
                "E0801",
                f"FROT_CC is not a command: {wanted} ({error})",
                help="set FROT_CC to a C compiler's command, or unset it",
            ) from None
        if shutil.which(words[0]) is None:
            raise fail(
                "E0801",
                f"the C compiler of FROT_CC does not exist: {wanted}",
                help="set FROT_CC to a C compiler's command, or unset it",
            )
        return _toolchain(tuple(words))
    for name in ("cc", "gcc", "clang"):
        if shutil.which(name) is not None:
            return _toolchain((name,))
    if importlib.util.find_spec("ziglang") is not None:
        return _toolchain((sys.executable, "-m", "ziglang", "cc"))
    raise fail(
        "E0801",
        "no C compiler was found",
        help="install one (Debian: `apt install gcc`), `pip install ziglang`, or set FROT_CC",
    )


def _toolchain(command: tuple[str, ...]) -> Toolchain:
    binary = Path(shutil.which(command[0]) or command[0]).resolve()
    try:
        stat = binary.stat()
        seal = f"{binary} {stat.st_size} {stat.st_mtime_ns}"
    except OSError:
        seal = str(binary)
    return Toolchain(command, " ".join((*command, seal)))


def run_compiler(
    toolchain: Toolchain, arguments: Sequence[str | Path], target: Path, keeper: Keeper
) -> None:
    """Make `target`; FrotError (E0802) with the first lines of the output if it fails.

    What the compiler keeps for itself meanwhile lies beside the target, and goes with it.
    """
    command = [*toolchain.command, *(str(a) for a in arguments), "-o", str(target)]
    try:
        done = keeper.run(command, TIMEOUT, {"TMPDIR": str(target.parent)})
    except FileNotFoundError:
        raise fail("E0801", f"no C compiler: {command[0]} does not exist") from None
    except subprocess.TimeoutExpired:
        raise fail("E0802", f"the C compiler took more than {TIMEOUT:.0f} s", help=_OTHER) from None
    except OSError as error:
        raise fail("E0802", f"the C compiler could not be run: {error}", help=_OTHER) from None
    if done.returncode != 0:
        lines = (done.stderr or done.stdout).strip().splitlines()[:8]
        if any("No space left" in line for line in lines):
            raise fail(
                "E0803",
                "the disk is full: the C compiler could not write its result",
                notes=tuple(lines),
                help="free some space, or set FROT_CACHE and TMPDIR to another disk",
            )
        raise fail(
            "E0802",
            f"the C compiler failed with status {done.returncode}: {shlex.join(toolchain.command)}",
            notes=tuple(lines),
            help=_OTHER,
        )
    if not target.is_file():
        raise fail(
            "E0802",
            f"the C compiler wrote nothing: {shlex.join(toolchain.command)}",
            help=_OTHER,
        )


def compile_objects(
    toolchain: Toolchain,
    sources: Sequence[Path],
    include: Sequence[Path],
    folder: Path,
    flags: Sequence[str],
) -> list[Path]:
    """Compile each source to an object in `folder`, as many at a time as there are cores."""
    from concurrent.futures import ThreadPoolExecutor

    options = [*flags, *(f"-I{path}" for path in include), "-c"]
    objects = [folder / f"{source.stem}.o" for source in sources]
    with Keeper() as keeper, ThreadPoolExecutor(max_workers=os.cpu_count() or 1) as pool:
        try:
            calls = [
                pool.submit(run_compiler, toolchain, [*options, source], target, keeper)
                for source, target in zip(sources, objects, strict=True)
            ]
            for call in calls:
                call.result()
        except BaseException:
            # Ctrl-C too, at any point: the pool would wait for those that run and those in line.
            pool.shutdown(wait=False, cancel_futures=True)
            keeper.stop()
            raise
    return objects


def link_library(
    toolchain: Toolchain, objects: Sequence[Path], target: Path, words: Sequence[str] = ()
) -> None:
    """Link objects to a shared library, with further words for the linker."""
    with Keeper() as keeper:
        run_compiler(toolchain, [*objects, *words, *LINK_FLAGS], target, keeper)
