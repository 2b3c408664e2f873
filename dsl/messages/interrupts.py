"""Ctrl-C while a model is prepared: noted at once, raised between two passes of the compiler.

A C library that calls Python code may swallow an exception raised there. CasADi does so when it
probes its operands. So the handler only notes the first Ctrl-C, and the compiler raises it where
nothing can swallow it. A second Ctrl-C is raised at once.
"""

from __future__ import annotations

import signal
import threading

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import FrameType, TracebackType

_noted = threading.Event()


def raise_noted_interrupt() -> None:
    """Raise KeyboardInterrupt if Ctrl-C came since the interrupts were deferred."""
    if _noted.is_set():
        _noted.clear()
        raise KeyboardInterrupt


class DeferredInterrupts:
    """A context in which the first Ctrl-C waits for `raise_noted_interrupt`, or for the exit.

    Contexts may be nested. Outside the main thread, and where SIGINT has another handler than
    Python's own, nothing changes.
    """

    def __init__(self) -> None:
        """Install nothing yet."""
        self._installed = False

    def __enter__(self) -> DeferredInterrupts:
        ours = threading.current_thread() is threading.main_thread()
        if ours and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            _noted.clear()
            signal.signal(signal.SIGINT, _note)
            self._installed = True
        return self

    def __exit__(
        self, kind: type[BaseException] | None, _: object, trace: TracebackType | None
    ) -> None:
        if not self._installed:
            return
        signal.signal(signal.SIGINT, signal.default_int_handler)
        self._installed = False
        if kind is None or not issubclass(kind, KeyboardInterrupt):
            raise_noted_interrupt()
        _noted.clear()


def _note(number: int, frame: FrameType | None) -> None:
    if _noted.is_set():
        signal.default_int_handler(number, frame)
    _noted.set()
