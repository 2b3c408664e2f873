"""The command `frot`, from its first instant to its last: Ctrl-C is told in one line."""

from __future__ import annotations

import sys

from frot.interrupts import Interrupts

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

    interrupts = Interrupts()
    try:
        interrupts.__enter__()
        from frot.commands import run

        return run(arguments)
    except KeyboardInterrupt as stop:
        print(str(stop) or "interrupted", file=sys.stderr)
        return EXIT_INTERRUPTED
    finally:
        last = signal.SIG_IGN if arguments is None else signal.default_int_handler
        interrupts.leave(last)


if __name__ == "__main__":
    sys.exit(main())
