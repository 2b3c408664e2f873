"""The command as a user calls it, and what a good message is."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from frot.compiler.toolchain.compiler_choice import find_toolchain
from frot.compiler.toolchain.objects import kept_kernel, kernel_folder
from patience import PATIENCE

from frot.command_line import main

_AS_A_TERMINAL = """
import signal, sys
for one in (signal.SIGHUP, signal.SIGTERM):
    signal.signal(one, signal.SIG_DFL)
signal.signal(signal.SIGINT, signal.default_int_handler)
from frot.command_line import main
sys.exit(main())
"""
ROOT = Path(__file__).parents[2]
MODELS = ROOT / "models"
HOOP, BLOCK, OSCILLATOR = (
    MODELS / f"{name}.frot" for name in ("backspin_hoop", "inclined_block", "coulomb_oscillator")
)
# A remedy is a line of help, a list of what there is, or a sentence that says what is wanted.
REMEDY = re.compile(r"= help: \S|= note: [a-z ]+: \S|must be |must not be |expected a")


@dataclass(frozen=True)
class Answer:
    """Exit status, what was printed, and the files that are there now and were not before."""

    status: int
    out: str
    err: str
    new: tuple[str, ...] = ()

    def refuses(self, code: str, *causes: str, place: str | None = None) -> None:
        """An error message with its code, cause, place and a remedy; no traceback, no file."""
        assert self.status == 1, self
        assert "Traceback" not in self.out + self.err, self.err
        assert self.err.startswith(f"error[{code}]: "), self.err
        assert self.err.count("error[") == 1, self.err
        for cause in causes:
            assert cause in self.err, self.err
        if place is not None:
            assert re.search(rf"(?m)^ *(-->|= note: at) {re.escape(place)}$", self.err), self.err
        assert REMEDY.search(self.err), f"no remedy in: {self.err}"
        assert self.new == (), f"left behind: {self.new}"

    def is_misused(self, cause: str) -> None:
        """Wrong usage: status 2, the usage and the cause; no file."""
        assert self.status == 2, self
        assert self.err.startswith("usage: frot") and cause in self.err, self.err
        assert "Traceback" not in self.err and self.new == ()

    def succeeds(self) -> Answer:
        assert self.status == 0 and "Traceback" not in self.err, self.err
        return self


def files_in(folder: Path) -> set[str]:
    return {str(path.relative_to(folder)) for path in folder.rglob("*")}


@dataclass(frozen=True)
class Door:
    """Runs commands in this process, in an empty folder."""

    folder: Path
    capture: pytest.CaptureFixture[str]

    def __call__(self, *words: object) -> Answer:
        before = files_in(self.folder)
        try:
            status = main([str(w) for w in words])
        except SystemExit as stop:
            status = int(stop.code or 0)
        seen = self.capture.readouterr()
        new = tuple(sorted(files_in(self.folder) - before))
        return Answer(status, seen.out, seen.err, new)

    def write(self, text: str, name: str = "model.frot") -> str:
        (self.folder / name).write_text(text, encoding="utf-8")
        return name

    def hoop_with(self, old: str, new: str) -> str:
        """The hoop with one place of its text changed, as model.frot."""
        text = HOOP.read_text(encoding="utf-8")
        assert text.count(old) == 1, old
        return self.write(text.replace(old, new))


@dataclass(frozen=True)
class Shell:
    """Runs commands in processes of their own, with their own environment."""

    folder: Path
    always: Mapping[str, str | Path] = field(default_factory=dict)

    def environment(self, **changes: str | Path) -> dict[str, str]:
        return {**os.environ, **{k: str(v) for k, v in {**self.always, **changes}.items()}}

    def __call__(self, *words: object, **changes: str | Path) -> Answer:
        return self.run([sys.executable, "-m", "frot.command_line", *words], **changes)

    def run(self, words: Sequence[object], **changes: str | Path) -> Answer:
        before = files_in(self.folder)
        done = subprocess.run(
            [str(w) for w in words],
            cwd=self.folder,
            env=self.environment(**changes),
            capture_output=True,
            text=True,
            encoding="utf-8",
            timeout=PATIENCE,
            check=False,
        )
        new = tuple(sorted(files_in(self.folder) - before))
        return Answer(done.returncode, done.stdout, done.stderr, new)

    def start(
        self, *words: object, changes: Mapping[str, str | Path] | None = None
    ) -> subprocess.Popen[str]:
        """The command as a terminal starts it: what starts the tests may ignore interrupts."""
        return subprocess.Popen(
            [sys.executable, "-c", _AS_A_TERMINAL, *(str(w) for w in words)],
            cwd=self.folder,
            env=self.environment(**(changes or {})),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )


def script(path: Path, text: str) -> Path:
    """An executable shell script."""
    path.write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
    path.chmod(0o755)
    return path


_HASTY = """
case " $* " in *" -c "*) ;; *) exec cc "$@" -O0 ;; esac
last=
for word; do
  case "$last" in -c) source=$word ;; -o) target=$word ;; esac
  last=$word
done
name=${{source##*/}}
kept={kernel}/${{name%.c}}.o
case "$source" in {sources}/*) [ -s "$kept" ] && exec cp "$kept" "$target" ;; esac
exec cc "$@" -O0
"""


def hasty_compiler(folder: Path) -> Path:
    """A compiler that does not optimise, and copies the objects of the kernel that the session has.

    For tests that look at when compilers are called. No other folder's compiler is the same to
    Frot.
    """
    kernel = kept_kernel(find_toolchain()).folder
    body = _HASTY.format(kernel=shlex.quote(str(kernel)), sources=shlex.quote(str(kernel_folder())))
    return script(folder / "hasty-cc", body)
