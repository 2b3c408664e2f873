"""The command `frot`, from its first instant to its last: Ctrl-C ends in one line."""

from __future__ import annotations

import contextlib
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

EXIT_INTERRUPTED = 130


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command; the exit status is 0, 1 after an error message, 2 after wrong usage.

    130 after Ctrl-C. Without `arguments` it is what the process is for, and Ctrl-C does nothing
    more once it is done.
    """
    import signal

    _open_closed_streams()
    try:
        from frot.commands import run

        return run(arguments)
    except KeyboardInterrupt as stop:
        print(str(stop) or "interrupted", file=sys.stderr)
        if arguments is None:
            _leave(EXIT_INTERRUPTED)
        return EXIT_INTERRUPTED
    finally:
        if arguments is None and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            signal.signal(signal.SIGINT, signal.SIG_IGN)


def _leave(status: int) -> None:
    """End the process at once: libraries that were being loaded may not be unloaded in order."""
    import os

    for stream in (sys.stdout, sys.stderr):
        with contextlib.suppress(OSError, ValueError):
            stream.flush()
    os._exit(status)


def _open_closed_streams() -> None:
    """Give what the caller has closed (`frot ... >&-`) to the null device.

    Else Python has no such stream, and the next file that is opened takes its number.
    """
    import os

    if None not in (sys.stdin, sys.stdout, sys.stderr):
        return
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            # the lowest number that is free
            os.set_inheritable(os.open(os.devnull, os.O_RDWR), True)
    sys.stdin = sys.stdin or os.fdopen(0, encoding="utf-8", closefd=False)
    sys.stdout = sys.stdout or os.fdopen(1, "w", encoding="utf-8", closefd=False)
    sys.stderr = sys.stderr or os.fdopen(2, "w", encoding="utf-8", closefd=False)


if __name__ == "__main__":
    sys.exit(main())
