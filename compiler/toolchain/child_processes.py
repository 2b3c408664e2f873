"""Processes that end with the one that started them, however it ends."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import TracebackType

_SHELL = "/bin/sh"
# The keeper leads a process group and waits for its standard input, whose other end is ours alone.
# A line there says that all is done; the end of it without a line, that we are dead.
_WAIT = """trap '' HUP INT TERM
read -r _ && exit 0
kill -TERM 0
sleep 0.3 || sleep 1
[ -z "$1" ] || rm -rf -- "$1"
kill -KILL 0
"""


class Keeper:
    """Runs commands in a process group that a waiting shell ends when this process is gone.

    PR_SET_PDEATHSIG would not do: it watches the thread that started a child, and reaches a
    compiler's driver but not what that has started. A folder named `doomed` is removed as well.
    Where there is no such shell, commands run without it.
    """

    def __init__(self, doomed: Path | None = None) -> None:
        """Start the shell."""
        self._shell: subprocess.Popen[bytes] | None = None
        self._started: list[subprocess.Popen[str]] = []
        if os.name != "posix":
            return
        words = [_SHELL, "-c", _WAIT, "frot", "" if doomed is None else str(doomed)]
        with contextlib.suppress(OSError):
            self._shell = subprocess.Popen(
                words,
                stdin=subprocess.PIPE,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                process_group=0,
            )

    def start(
        self, command: Sequence[str], environment: Mapping[str, str]
    ) -> subprocess.Popen[str]:
        """Start a command with pipes for what it prints; OSError if that cannot be done."""
        process = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            errors="replace",
            env={**os.environ, **environment},
            process_group=None if self._shell is None else self._shell.pid,
        )
        self._started.append(process)
        return process

    def stop(self) -> None:
        """End every command that still runs."""
        if self._shell is not None and self._shell.poll() is None:
            with contextlib.suppress(OSError):
                os.killpg(self._shell.pid, signal.SIGKILL)
        for process in self._started:
            if process.poll() is None:
                process.kill()
                process.wait()
            for pipe in (process.stdout, process.stderr):
                if pipe is not None:
                    pipe.close()

    def __enter__(self) -> Keeper:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._shell is None or self._shell.stdin is None:
            return
        if kind is not None:
            self.stop()
        with contextlib.suppress(OSError):
            self._shell.stdin.write(b"done\n")
            self._shell.stdin.flush()
        with contextlib.suppress(OSError):
            self._shell.stdin.close()
        self._shell.wait()
