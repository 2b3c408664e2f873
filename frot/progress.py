"""Progress of long work, on a terminal only."""

from __future__ import annotations

import contextlib
import sys
import threading
import time
from collections.abc import Callable, Iterator
from types import TracebackType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from frot.runtime.program import Program

PATIENCE = 0.7


def in_notebook() -> bool:
    """Whether cells of a notebook are being run."""
    shell = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    return hasattr(shell, "kernel")


class Progress:
    """Shows how far a run is once it has taken longer than a moment."""

    def __init__(self, title: str) -> None:
        """`title` stands beside the bar."""
        self._title = title
        self._bar: Any = None
        self._task: Any = None
        self._begun = time.monotonic()

    def __enter__(self) -> Progress:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._bar is not None:
            self._bar.stop()

    def watch(self, stop: float | None) -> Callable[[float], bool]:
        """A function for `simulate(watch=...)` that shows the time reached out of `stop`."""
        visible = sys.stderr.isatty() or in_notebook()

        def watch(reached: float) -> bool:
            if visible and time.monotonic() - self._begun > PATIENCE:
                self._show(reached, stop)
            return False

        return watch

    def _show(self, reached: float, stop: float | None) -> None:
        if self._bar is None:
            from rich.console import Console
            from rich.progress import Progress as Bar

            self._bar = Bar(console=Console(stderr=not in_notebook()), transient=True)
            self._bar.start()
            self._task = self._bar.add_task(self._title, total=stop)
        self._bar.update(self._task, completed=reached)


class Busy:
    """Shows what is being done once it has taken longer than a moment, and for how long."""

    def __init__(self, title: str) -> None:
        """`title` says what is done."""
        self._title = self._words = title
        self._shown: Any = None
        self._task: Any = None
        self._over = False
        self._lock = threading.Lock()
        self._timer = threading.Timer(PATIENCE, self._show)
        self._timer.daemon = True

    def __enter__(self) -> Busy:
        if sys.stderr.isatty():
            self._timer.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._timer.cancel()
        with self._lock:
            self._over = True
            if self._shown is not None:
                self._shown.stop()

    def tell(self, part: str) -> None:
        """Say what part of it is being done."""
        with self._lock:
            self._words = f"{self._title}: {part}"
            if self._shown is not None:
                self._shown.update(self._task, description=self._words)

    def _show(self) -> None:
        from rich.console import Console
        from rich.progress import Progress as Bar
        from rich.progress import SpinnerColumn, TextColumn, TimeElapsedColumn

        columns = (SpinnerColumn(), TextColumn("{task.description}"), TimeElapsedColumn())
        shown = Bar(*columns, console=Console(stderr=True), transient=True)
        with self._lock:
            self._task = shown.add_task(self._words)
            if not self._over:
                self._shown = shown
                shown.start()


@contextlib.contextmanager
def shown_in_notebook(
    program: Program, stop: object, watch: Callable[[float], bool] | None
) -> Iterator[Callable[[float], bool] | None]:
    """What a run calls: `watch`, or in a notebook a bar where there is none."""
    if watch is not None or not in_notebook():
        yield watch
        return
    end = stop if isinstance(stop, (int, float)) else program.experiment.stop
    with Progress(f"simulating {program.name}") as progress:
        yield progress.watch(end)
