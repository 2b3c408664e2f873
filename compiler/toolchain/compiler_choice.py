"""Which C compiler is used, and the flags it is given."""

from __future__ import annotations

import importlib.util
import os
import shlex
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path

from frot.dsl.messages.errors import fail

# Nobody asks errno of a root, nor puts another function in the place of one: no bit changes.
_QUICKER = ("-fno-math-errno", "-fno-semantic-interposition")
# Each function by itself, so that a linker can leave out those that nothing calls.
_APART = ("-ffunction-sections", "-fdata-sections")
_FLAGS = ("-std=c99", "-fPIC", "-ffp-contract=off", *_QUICKER, *_APART)
# The header of numbers of twice the digits.
_WIDE = "extended_precision.h"
KERNEL_FLAGS = (*_FLAGS, "-O2")
# Levels of optimisation of a model, the first by default: straight lines of arithmetic run as fast
# as with 2, to the same bits, and compile in two thirds of the time.
LEVELS = ("1", "0", "2")
# Of clang in `ziglang`: loops of the kernel are short, so that plain ones run faster, to the same
# bits, and take a quarter less room. Without optimisation it would check undefined behaviour.
ZIG_FLAGS = (
    "-fno-vectorize",
    "-fno-slp-vectorize",
    "-fno-unroll-loops",
    "-fno-sanitize=undefined",
)


@dataclass(frozen=True, slots=True)
class Toolchain:
    """A C compiler as the words of a command, and what identifies it: words, size and date.

    `environment` are variables it is run with, besides those of this process; `joins`: it may be
    able to make one object of several.
    """

    command: tuple[str, ...]
    identity: str
    environment: tuple[tuple[str, str], ...] = ()
    joins: bool = True


def model_flags() -> tuple[str, ...]:
    """The flags of a model's C: those of the kernel, with the level of `$FROT_OPTIMIZE`.

    Raises FrotError (E0801) when that is no level.
    """
    level = os.environ.get("FROT_OPTIMIZE", "").strip() or LEVELS[0]
    if level not in LEVELS:
        raise fail(
            "E0801",
            f"FROT_OPTIMIZE is no level of optimisation: {level}",
            help="set FROT_OPTIMIZE to 0, 1 or 2, or unset it",
        )
    return (*_FLAGS, f"-O{level}")


def find_toolchain() -> Toolchain:
    """`$FROT_CC`, else `cc`, `gcc` or `clang` on the path, else the `ziglang` package.

    Raises FrotError (E0801) when there is none.
    """
    wanted = _named_by("FROT_CC")
    if wanted is not None:
        return wanted
    for name in ("cc", "gcc", "clang"):
        if shutil.which(name) is not None:
            return toolchain_of((name,))
    if importlib.util.find_spec("ziglang") is not None:
        return toolchain_of((sys.executable, "-m", "ziglang", "cc", *ZIG_FLAGS))
    raise fail(
        "E0801",
        "no C compiler was found",
        help="install one (Debian: `apt install gcc`), `pip install ziglang`, or set FROT_CC",
    )


def model_compiler(toolchain: Toolchain) -> Toolchain:
    """`$FROT_MODEL_CC`, which compiles the C of models alone, else `toolchain`.

    `tcc` takes a tenth of the time; the bits are the same, and the run takes longer. Raises
    FrotError (E0801) when it does not exist.
    """
    return _named_by("FROT_MODEL_CC") or toolchain


def part_words(text: str) -> tuple[str, ...]:
    """Words for the compiler of a model and for that of the kernel, where they differ.

    Numbers of twice the digits have another form in another compiler: the functions of the C
    `text` that have some are compiled as the kernel is. Without such functions there is no part
    for the latter.
    """
    return ("-DFROT_ONLY_PLAIN", "-DFROT_ONLY_WIDE") if _WIDE in text else ()


def _named_by(variable: str) -> Toolchain | None:
    """The compiler that a variable of the environment names; FrotError (E0801) for a wrong one."""
    wanted = os.environ.get(variable, "").strip()
    if not wanted:
        return None
    remedy = f"set {variable} to a C compiler's command, or unset it"
    try:
        words = shlex.split(wanted)
    except ValueError as error:
        sentence = f"{variable} is not a command: {wanted} ({error})"
        raise fail("E0801", sentence, help=remedy) from None
    if shutil.which(words[0]) is None:
        sentence = f"the C compiler of {variable} does not exist: {wanted}"
        raise fail("E0801", sentence, help=remedy)
    return toolchain_of(tuple(words))


def toolchain_of(command: tuple[str, ...]) -> Toolchain:
    """A compiler by its command."""
    binary = Path(shutil.which(command[0]) or command[0]).resolve()
    try:
        stat = binary.stat()
        seal = f"{binary} {stat.st_size} {stat.st_mtime_ns}"
    except OSError:
        seal = str(binary)
    return Toolchain(command, " ".join((*command, seal)))
