"""The runs of a sweep: a range of them at a time, in this process, in others, or on a cluster."""

from __future__ import annotations

import math
import os
import time
from collections.abc import Generator, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from frot.dsl.messages.errors import fail

if TYPE_CHECKING:
    from frot.runtime.program import Program

ALONE = 0.3  # s of work that are done sooner here than other processes begin
PORTION = 0.1  # s of work that a process is given at once
MOST = 2000  # runs of a portion
Part = list[tuple[list[float], str]]


class Work:
    """All runs of a sweep, by their number; the last parameter changes fastest.

    It goes to other processes whole, once for each.
    """

    def __init__(
        self,
        program: Program,
        given: Mapping[str, Sequence[object]],
        read: tuple[str, ...],
        options: Mapping[str, Any],
    ) -> None:
        """FrotError (E0805, E0806) for unknown parameters, and for bad values."""
        from frot.runtime.settings import read_each

        # the lock that keeps the program's folder stays in this process
        self.program, self.read, self.options = program.without_lock(), read, dict(options)
        self.settings = [
            read_each(name, values, program.parameters, "parameter", program)
            for name, values in given.items()
        ]
        # an item of an array goes before the whole
        names = list(given)
        self.order = sorted(range(len(names)), key=lambda k: "[" in names[k])

    def rows(self, first: int, last: int) -> Part:
        """What was read at the end of the runs `first` to `last` - 1, and what ended each."""
        from frot.runtime.ends import Ends
        from frot.runtime.run import SimulationError

        found: Part = []
        none = [math.nan] * len(self.read)
        with Ends(self.program, self.read, **self.options) as ends:
            for number in range(first, last):
                try:
                    values, error = ends.of(self._set_by(number)), ""
                except SimulationError as told:
                    values, error = none, told.diagnostics[0].message
                found.append((values, error))
        return found

    def _set_by(self, number: int) -> list[tuple[int, float]]:
        """Index and SI value of all that the run of this number sets."""
        chosen = []
        for values in reversed(self.settings):
            number, k = divmod(number, len(values))
            chosen.append(values[k])
        chosen.reverse()
        return [x for k in self.order for x in chosen[k]]


def here(work: Work, first: int, last: int, processes: int | None) -> Iterator[Part]:
    """On the cores of this machine; short work needs no other process."""
    each = yield from _probed(work, first, last)
    parts = _parts(first + 2, last, each)
    workers = min(processes or os.cpu_count() or 1, len(parts))
    if workers <= 1 or (processes is None and each * (last - first) < ALONE):
        for a, b in parts:
            yield work.rows(a, b)
        return
    yield from _by_processes(work, parts, workers)


def _probed(work: Work, first: int, last: int) -> Generator[Part, None, float]:
    """The first two runs, of which the first loads the program; how long the second takes, in s."""
    each = 1.0
    for k in range(first, min(first + 2, last)):
        began = time.perf_counter()
        yield work.rows(k, k + 1)
        each = time.perf_counter() - began
    return each


def _by_processes(work: Work, parts: list[tuple[int, int]], workers: int) -> Iterator[Part]:
    import multiprocessing
    from concurrent.futures import ProcessPoolExecutor

    before = set(multiprocessing.active_children())
    pool = ProcessPoolExecutor(workers, initializer=_begin, initargs=(work,))
    try:
        yield from pool.map(_rows, parts)
        pool.shutdown()
    except BaseException:
        # Ctrl-C, or a fault: nobody waits for runs that are under way
        pool.shutdown(wait=False, cancel_futures=True)
        for one in set(multiprocessing.active_children()) - before:
            one.terminate()
        raise


_own: list[Work] = []


def _begin(work: Work) -> None:
    """In a process of a pool: Ctrl-C is for the process that began it."""
    import signal

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    _own[:] = [work]


def _rows(part: tuple[int, int]) -> Part:
    return _own[0].rows(*part)


def by_dask(address: str, work: Work, first: int, last: int) -> Iterator[Part]:
    """On the workers of a cluster, which see the same files."""
    try:
        from distributed import Client
    except ImportError:
        raise fail(
            "E0820", "Dask is not installed", help="pip install 'dask[distributed]'"
        ) from None
    each = yield from _probed(work, first, last)
    with Client(address) as client:
        sent = client.scatter(work, broadcast=True)
        for one in [
            client.submit(Work.rows, sent, a, b, pure=False)
            for a, b in _parts(first + 2, last, each)
        ]:
            yield one.result()


def _parts(first: int, last: int, each: float) -> list[tuple[int, int]]:
    """Ranges of about PORTION s, if a run takes `each` s."""
    size = min(max(int(PORTION / each), 1), MOST)
    return [(a, min(a + size, last)) for a in range(first, last, size)]


__all__ = ["Work", "by_dask", "here"]
