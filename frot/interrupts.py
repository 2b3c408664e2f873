"""Ctrl-C raises KeyboardInterrupt where nothing can lose it.

Python runs the handler of a signal wherever its own code runs, also where a library in C has called
that code to find out what it was given, and takes an exception for an answer: CasADi asks operands
for their shape, and an interrupt there only makes it look for another kind of operand. Others stay
half loaded, or keep a lock. So the interrupt is raised once such a library has returned: where its
caller goes on, or in the next function that is called.
"""

from __future__ import annotations

import signal
import sys
import time

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import FrameType
    from typing import Any

# All in Python. FMPy's check takes seconds; where it catches everything an interrupt waits.
_SAFE = {"__main__", "frot", "lark", "fmpy"}
_CATCHING = {"_validate_model_structure"}
# What locks, and what calls back when objects go.
_UNSAFE = {"threading", "tempfile", "weakref", "_weakrefset", "frot.interrupts"}
_IMPORTING = ("importlib", "_frozen_importlib", "_frozen_importlib_external")
# Seconds after an interrupt in which another is taken for the same: what ends is let end.
_CALM = 1.0


class Interrupts:
    """While it is entered, Ctrl-C is not lost in libraries that are called.

    Nothing changes outside the main thread, and where Ctrl-C does something else already.
    """

    def __init__(self) -> None:
        """Nothing is changed yet."""
        self._outermost: FrameType | None = None
        self._raised: float | None = None
        self._entered = False

    def __enter__(self) -> Interrupts:
        if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            self._outermost = sys._getframe(1)
            try:
                signal.signal(signal.SIGINT, self._handle)
                self._entered = True
            except ValueError:  # another thread
                pass
        return self

    def __exit__(self, *_: object) -> None:
        self.leave(signal.default_int_handler)

    def leave(self, handler: Any) -> None:
        """Put another handler in the place of this one."""
        if self._entered:
            signal.signal(signal.SIGINT, handler)
            self._outermost, self._entered = None, False

    def _handle(self, _: int, frame: FrameType | None) -> None:
        if self._raised is not None and time.monotonic() < self._raised + _CALM:
            return
        if frame is None or (safe := self._safe(frame)) is frame:
            self._raise()
        safe.f_trace = self._raise_where_safe
        safe.f_trace_opcodes = True
        sys.settrace(self._raise_where_safe)

    def _raise_where_safe(self, frame: FrameType, *_: object) -> None:
        """Called for each function that is entered, and where the safe one goes on."""
        # of others there are many, in what is being loaded, and looking around each would take long
        if (frame.f_trace is not None or _root(frame) == "frot") and self._safe(frame) is frame:
            sys.settrace(None)
            frame.f_trace = None
            self._raise()

    def _raise(self) -> None:
        self._raised = time.monotonic()
        raise KeyboardInterrupt

    def _safe(self, frame: FrameType) -> FrameType:
        """The innermost frame at or around this one in which an exception goes its way."""
        safe, here = frame, frame
        while here is not self._outermost and here.f_back is not None:
            if _loses(here):
                safe = here.f_back
            here = here.f_back
        while _root(safe) in _IMPORTING and safe.f_back is not None:
            safe = safe.f_back
        return safe


def _loses(frame: FrameType) -> bool:
    """Whether an exception may be lost in a frame, or on its way out of it."""
    root, function = _root(frame), frame.f_code.co_name
    if root in _SAFE:
        return function == "__del__" or function in _CATCHING or _name(frame) in _UNSAFE
    if root in sys.stdlib_module_names:
        return function == "__del__" or root in _UNSAFE
    return True


def _name(frame: FrameType) -> str:
    return str(frame.f_globals.get("__name__", "__main__"))


def _root(frame: FrameType) -> str:
    return _name(frame).partition(".")[0]
