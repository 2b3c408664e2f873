"""The C compiler at work: how it is called, what is reported where it fails."""

from __future__ import annotations

import contextlib
import os
import shlex
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from frot.compiler.toolchain.child_processes import Keeper
from frot.compiler.toolchain.compiler_choice import Toolchain, model_flags, part_words
from frot.dsl.messages.errors import fail
from frot.dsl.messages.interrupts import raise_noted_interrupt

LIBRARIES = ("-lm",)
# Objects of `tcc` do not say that they need no executable stack.
_PLAIN_STACK = "-Wl,-z,noexecstack"
_MERGING = (
    "SECTIONS {"
    + "".join(
        f" {name} 0 : {{ *({name} {name}.*) }}"
        for name in (".text", ".data.rel.ro", ".data", ".rodata", ".bss")
    )
    + " }\n"
)
TIMEOUT = 600.0
_MOMENT = 0.02
_OTHER = "set FROT_CC to another compiler, or report this with the model"


@dataclass(frozen=True, slots=True)
class Job:
    """A compiler, its arguments and the file that it makes of them."""

    toolchain: Toolchain
    arguments: Sequence[str | Path]
    target: Path


def run_compilers(jobs: Sequence[Job], keeper: Keeper) -> None:
    """Make the target of each job from its arguments, as many at a time as there are cores.

    FrotError (E0802) with the first lines of the output if one fails. What a compiler keeps for
    itself meanwhile lies beside its target, and goes with it.
    """
    # In one thread, so that an interrupt is raised here and stops all compilers.
    line, running = list(reversed(jobs)), list[_Running]()
    while line or running:
        while line and len(running) < (os.cpu_count() or 1):
            running.append(_start(line.pop(), keeper))
        ended = _ended(running)
        raise_noted_interrupt()
        for one, printed in ended:
            running.remove(one)
            _check(one, printed)


@dataclass(frozen=True, slots=True, eq=False)
class _Running:
    """A compiler at work, and the instant (s) by which it must have made its target."""

    process: subprocess.Popen[str]
    job: Job
    end: float


def _start(job: Job, keeper: Keeper) -> _Running:
    command = [*job.toolchain.command, *(str(a) for a in job.arguments), "-o", str(job.target)]
    environment = {"TMPDIR": str(job.target.parent), **dict(job.toolchain.environment)}
    try:
        process = keeper.start(command, environment)
    except FileNotFoundError:
        raise fail("E0801", f"no C compiler: {command[0]} does not exist") from None
    except OSError as error:
        raise fail("E0802", f"the C compiler could not be run: {error}", help=_OTHER) from None
    return _Running(process, job, time.monotonic() + TIMEOUT)


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


def _check(one: _Running, printed: str) -> None:
    status, command = one.process.returncode, shlex.join(one.job.toolchain.command)
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
            f"the C compiler failed with status {status}: {command}",
            notes=tuple(lines),
            help=_OTHER,
        )
    if not one.job.target.is_file():
        raise fail(
            "E0802",
            f"the C compiler wrote nothing: {command}",
            help=_OTHER,
        )


def compile_jobs(
    toolchain: Toolchain,
    sources: Sequence[Path],
    include: Sequence[Path],
    folder: Path,
    flags: Sequence[str],
) -> list[Job]:
    """What makes an object in `folder` of each source."""
    options = [*flags, *(f"-I{path}" for path in include), "-c"]
    return [Job(toolchain, [*options, one], folder / f"{one.stem}.o") for one in sources]


def model_jobs(
    models: Toolchain,
    kernel: Toolchain,
    sources: Sequence[Path],
    include: Sequence[Path],
    folder: Path,
) -> list[Job]:
    """What makes the objects in `folder` of a model's sources: the compiler of `models`.

    Where it is not that of the `kernel`, this one compiles the part in numbers of twice the digits.
    """
    jobs = list[Job]()
    for source in sources:
        words = part_words(source.read_text(encoding="utf-8")) if models != kernel else ()
        flags = (*model_flags(), *words[:1])
        jobs += compile_jobs(models, [source], include, folder, flags)
        if words:
            (wide,) = compile_jobs(kernel, [source], include, folder, (*model_flags(), *words[1:]))
            jobs.append(replace(wide, target=folder / f"{source.stem}.wide.o"))
    return jobs


def compile_objects(
    toolchain: Toolchain,
    sources: Sequence[Path],
    include: Sequence[Path],
    folder: Path,
    flags: Sequence[str],
    keeper: Keeper | None = None,
) -> list[Path]:
    """Compile each source to an object in `folder`, as many at a time as there are cores."""
    jobs = compile_jobs(toolchain, sources, include, folder, flags)
    _run_kept(jobs, keeper)
    return [job.target for job in jobs]


def _run_kept(jobs: Sequence[Job], keeper: Keeper | None) -> None:
    """Run compilers in the group of a keeper, which is made for them where there is none."""
    if keeper is not None:
        run_compilers(jobs, keeper)
        return
    with Keeper() as own:
        run_compilers(jobs, own)


def join_objects(
    toolchain: Toolchain, objects: Sequence[Path], target: Path, keeper: Keeper
) -> None:
    """Join objects to one, in which functions of one name are still apart."""
    words = ["-r", "-nostdlib", "-Wl,--unique"]
    run_compilers([Job(toolchain, [*words, *objects], target)], keeper)


def merge_sections(toolchain: Toolchain, joined: Path, target: Path, keeper: Keeper) -> None:
    """Make one section of each kind of the many in an object, so that a linker has less to do.

    What nothing calls can then not be left out. Names that are not seen from outside go.
    """
    script = target.with_suffix(".ld")
    script.write_text(_MERGING, encoding="ascii")
    words = ["-r", "-nostdlib", "-Wl,-x", f"-Wl,-T,{script}"]
    try:
        run_compilers([Job(toolchain, [*words, joined], target)], keeper)
    finally:
        script.unlink()


def words_for(compiler: Toolchain, linker: Toolchain) -> tuple[str, ...]:
    """Words for the linker of a library with an object of another compiler."""
    mixed = compiler != linker and sys.platform.startswith("linux")
    return (*LIBRARIES, _PLAIN_STACK) if mixed else LIBRARIES


def link_library(
    toolchain: Toolchain,
    objects: Sequence[str | Path],
    target: Path,
    words: Sequence[str] = LIBRARIES,
    keeper: Keeper | None = None,
) -> None:
    """Link objects to a shared library, with further words for the linker."""
    _run_kept([Job(toolchain, ["-shared", *objects, *words], target)], keeper)
