"""The C compiler at work: how it is called, what is told where it fails."""

from __future__ import annotations

import contextlib
import os
import shlex
import subprocess
import time
from collections.abc import Sequence
from pathlib import Path

from frot.compiler.toolchain.chosen import Toolchain
from frot.compiler.toolchain.keeper import Keeper
from frot.dsl.data.classes import dataclass
from frot.dsl.messages.errors import fail

LINK_FLAGS = ("-shared", "-lm")
TIMEOUT = 600.0
_MOMENT = 0.02
_OTHER = "set FROT_CC to another compiler, or report this with the model"


def run_compilers(
    toolchain: Toolchain, jobs: Sequence[tuple[Sequence[str | Path], Path]], keeper: Keeper
) -> None:
    """Make the target of each job from its arguments, as many at a time as there are cores.

    FrotError (E0802) with the first lines of the output if one fails. What a compiler keeps for
    itself meanwhile lies beside its target, and goes with it.
    """
    # In one thread: an interrupt may come at any point, and in a lock of `threading` it is lost
    # until the compiler ends, or leaves the lock in a state that nothing can release.
    line, running = list(reversed(jobs)), list[_Running]()
    while line or running:
        while line and len(running) < (os.cpu_count() or 1):
            running.append(_start(toolchain, *line.pop(), keeper))
        for one, printed in _ended(running):
            running.remove(one)
            _check(toolchain, one, printed)


@dataclass(frozen=True, slots=True, eq=False)
class _Running:
    """A compiler at work, what it makes, and the instant (s) by which it must have made it."""

    process: subprocess.Popen[str]
    target: Path
    end: float


def _start(
    toolchain: Toolchain, arguments: Sequence[str | Path], target: Path, keeper: Keeper
) -> _Running:
    command = [*toolchain.command, *(str(a) for a in arguments), "-o", str(target)]
    try:
        process = keeper.start(command, {"TMPDIR": str(target.parent)})
    except FileNotFoundError:
        raise fail("E0801", f"no C compiler: {command[0]} does not exist") from None
    except OSError as error:
        raise fail("E0802", f"the C compiler could not be run: {error}", help=_OTHER) from None
    return _Running(process, target, time.monotonic() + TIMEOUT)


def _ended(running: Sequence[_Running]) -> list[tuple[_Running, str]]:
    """Those that have ended and what they printed; waits a moment for the first."""
    if any(one.end < time.monotonic() for one in running):
        raise fail("E0802", f"the C compiler took more than {TIMEOUT:.0f} s", help=_OTHER)
    done = []
    for one in running:
        # What the first prints is read while it runs: none waits for ever for room in its pipe.
        if one is running[0] or one.process.poll() is not None:
            with contextlib.suppress(subprocess.TimeoutExpired):
                out, err = one.process.communicate(timeout=_MOMENT)
                done.append((one, err or out))
    return done


def _check(toolchain: Toolchain, one: _Running, printed: str) -> None:
    status = one.process.returncode
    if status != 0:
        lines = printed.strip().splitlines()[:8]
        if any("No space left" in line for line in lines):
            raise fail(
                "E0803",
                "the disk is full: the C compiler could not write its result",
                notes=tuple(lines),
                help="free some space, or set FROT_CACHE and TMPDIR to another disk",
            )
        raise fail(
            "E0802",
            f"the C compiler failed with status {status}: {shlex.join(toolchain.command)}",
            notes=tuple(lines),
            help=_OTHER,
        )
    if not one.target.is_file():
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
    options = [*flags, *(f"-I{path}" for path in include), "-c"]
    objects = [folder / f"{source.stem}.o" for source in sources]
    jobs: list[tuple[list[str | Path], Path]] = [
        ([*options, source], made) for source, made in zip(sources, objects, strict=True)
    ]
    with Keeper() as keeper:
        run_compilers(toolchain, jobs, keeper)
    return objects


def join_objects(toolchain: Toolchain, objects: Sequence[Path], target: Path) -> None:
    """Join objects to one."""
    with Keeper() as keeper:
        run_compilers(toolchain, [(["-r", "-nostdlib", *objects], target)], keeper)


def link_library(
    toolchain: Toolchain, objects: Sequence[Path], target: Path, words: Sequence[str] = ()
) -> None:
    """Link objects to a shared library, with further words for the linker."""
    with Keeper() as keeper:
        run_compilers(toolchain, [([*objects, *words, *LINK_FLAGS], target)], keeper)
