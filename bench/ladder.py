"""The RC ladder: time from text to C and to a program, and run time beside CVODE.

A ladder of n cells R, C at rest is fed with a step of one volt: n states, rates from 4/(R C) down
to 2.5/(R C n^2). CVODE runs with the same right-hand side in C and the exact banded Jacobian.
"""

from __future__ import annotations

import argparse
import ctypes as ct
import os
import subprocess
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

import common
import numpy as np
from frot.runtime.engine import OK, Engine
from frot.runtime.program import Program

import frot

SIZES = (250, 500, 1000, 2000, 4000)
# In fastest time constants, R C / 4.
SPANS = (1e3, 1e6)
TOLERANCE = 1e-8
ALLOWED = 3.0
SOURCE = Path(__file__).parent / "peers" / "cvode_ladder.c"
LIBRARIES = ("core", "nvecserial", "sunmatrixband", "sunlinsolband", "cvode")
DOUBLES = ct.POINTER(ct.c_double)

TEXT = """planar model Ladder "RC ladder, fed with a step"
  constant Integer n = {n};
  parameter AngularVelocity k = 1 s^-1 "one over R C";
  Real u[n] "voltages, in those of the source";
equation
  der(u[1]) = k*(1 - 2*u[1] + u[2]);
  for i in 2:n - 1 loop
    der(u[i]) = k*(u[i - 1] - 2*u[i] + u[i + 1]);
  end for;
  der(u[n]) = k*(u[n - 1] - u[n]);
  experiment(stop = {stop} s, tolerance = {tolerance});
end Ladder;
"""


@dataclass(frozen=True, slots=True)
class Timing:
    """Processor times of the repeats, largest error of any voltage, steps and evaluations."""

    times: tuple[float, ...]
    error: float
    steps: int
    evaluations: int

    @property
    def typical(self) -> float:
        """The median."""
        return common.median(self.times)


@dataclass(frozen=True, slots=True)
class Building:
    """Seconds from text to C, seconds of the C compiler, characters of C."""

    translation: float
    compilation: float
    size: int


def moments(stop: float) -> np.ndarray:
    """Where voltages are looked at."""
    return np.array([stop / 100, stop / 7, stop / 3, stop])


def exact(n: int, times: np.ndarray) -> np.ndarray:
    """Voltages (times x n), by the eigenvectors of the ladder, which are sines."""
    angle = np.pi * (2 * np.arange(1, n + 1) - 1) / (2 * n + 1)
    vectors = np.sin(np.outer(np.arange(1, n + 1), angle)) * np.sqrt(4 / (2 * n + 1))
    rates = -4 * np.sin(angle / 2) ** 2
    start = -vectors.sum(0)
    return np.array([1 + vectors @ (np.exp(rates * t) * start) for t in times])


def built(n: int, stop: float) -> tuple[Program, Building]:
    """The program, made anew, and what that took."""
    text = TEXT.format(n=n, stop=stop, tolerance=TOLERANCE)
    spent: list[float] = []
    with _watched_compiler(spent):
        before = time.perf_counter()
        program = frot.compile(text).program()
        whole = time.perf_counter() - before
    size = len(program.source.read_text(encoding="utf-8"))
    return program, Building(whole - sum(spent), sum(spent), size)


class _watched_compiler:
    """Notes how long each call of the C compiler's process takes."""

    def __init__(self, spent: list[float]) -> None:
        self.spent = spent

    def __enter__(self) -> None:
        self.run = subprocess.run

        def watched(*arguments: object, **options: object) -> object:
            before = time.perf_counter()
            try:
                return self.run(*arguments, **options)  # type: ignore[call-overload]
            finally:
                self.spent.append(time.perf_counter() - before)

        subprocess.run = watched  # type: ignore[assignment]

    def __exit__(self, *_: object) -> None:
        subprocess.run = self.run


class Frot:
    """The kernel alone, from the initial values to the last value; no recording, as with CVODE."""

    def __init__(self, program: Program, n: int, stop: float) -> None:
        """An instance of the ladder's program."""
        self.engine, self.n, self.times = Engine(program), n, moments(stop)
        self.found = np.empty((len(self.times), len(program.variables)))
        self.engine._library.frot_values.argtypes = [ct.c_void_p] * 4
        self.spent: list[float] = []

    def run(self) -> None:
        """One run more."""
        engine = self.engine
        kernel, block = engine._library, (engine._model, engine._s, engine._w)
        before = time.thread_time()
        status = engine.start(0.0, TOLERANCE, "rest")
        for k, t in enumerate(self.times):
            status = status or kernel.frot_advance(*block, float(t), None, None, None)
            kernel.frot_values(*block, self.found[k].ctypes.data)
        self.spent.append(time.thread_time() - before)
        assert status == OK, engine.fault_text

    @property
    def timing(self) -> Timing:
        """What the runs took and gave."""
        error = np.abs(self.found[:, : self.n] - exact(self.n, self.times)).max()
        counts = self.engine.statistics
        return Timing(tuple(self.spent), float(error), counts.steps, counts.evaluations)


class Cvode:
    """CVODE: BDF, Newton, banded direct solver, at its relative tolerance and an absolute one."""

    def __init__(self, library: ct.CDLL, n: int, stop: float, absolute: float) -> None:
        """The ladder with this absolute tolerance."""
        self.library, self.n, self.times, self.absolute = library, n, moments(stop), absolute
        self.found, self.counts = np.empty((len(self.times), n)), (ct.c_long * 2)()
        self.spent: list[float] = []

    def run(self) -> None:
        """One run more."""
        took = self.library.run(
            self.n,
            self.times.ctypes.data_as(DOUBLES),
            len(self.times),
            ct.c_double(TOLERANCE),
            ct.c_double(self.absolute),
            self.found.ctypes.data_as(DOUBLES),
            self.counts,
        )
        assert took >= 0, f"CVODE failed with status {took}"
        self.spent.append(took)

    @property
    def timing(self) -> Timing:
        """What the runs took and gave."""
        error = np.abs(self.found - exact(self.n, self.times)).max()
        return Timing(tuple(self.spent), float(error), *self.counts)


def cvode() -> ct.CDLL | None:
    """The peer, compiled against the libraries of scikit-sundae; None without that."""
    found = find_spec("sksundae")
    if found is None or found.origin is None:
        return None
    folder = Path(found.origin).parents[1] / "scikit_sundae.libs"
    for name in LIBRARIES:
        ct.CDLL(str(next(folder.glob(f"libsundials_{name}-*"))), mode=ct.RTLD_GLOBAL)
    target = Path(tempfile.mkdtemp()) / "cvode_ladder.so"
    subprocess.run(
        ["cc", "-std=gnu99", "-O2", "-shared", "-fPIC", str(SOURCE), "-o", str(target)], check=True
    )
    library = ct.CDLL(str(target))
    library.run.restype = ct.c_double
    return library


def rows(sizes: tuple[int, ...], repeats: int, good: list[bool]) -> Iterator[list[str]]:
    """One row a size and span; the codes take turns, so that both meet the same disturbances."""
    library = cvode()
    for n in sizes:
        for span in SPANS:
            stop = span / 4
            program, _ = built(n, stop)
            own = Frot(program, n, stop)
            absolutes = (TOLERANCE, 1e-2 * TOLERANCE) if library is not None else ()
            others = [Cvode(library, n, stop, a) for a in absolutes]
            for _ in range(repeats):
                for code in (own, *others):
                    code.run()
            timing = own.timing
            row = [str(n), f"{span:g}", *cells(timing)]
            for other in others:
                ratio = timing.typical / other.timing.typical
                good.append(ratio <= ALLOWED)
                row += [*cells(other.timing), f"**{ratio:.2f}**"]
            row += ["not installed", *"---"] * (2 - len(others))
            common.say(" ".join(row))
            yield row


def cells(timing: Timing) -> list[str]:
    """Time, error and counts for the table."""
    counts = f"{timing.steps} / {timing.evaluations}"
    return [common.seconds(timing.typical), f"{timing.error:.1e}", counts]


def main() -> int:
    """Measure, write results/ladder.md; status 1 when a ratio is above the allowed one."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sizes", type=int, nargs="+", default=list(SIZES))
    parser.add_argument("--repeats", type=int, default=7)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as cache:
        os.environ["FROT_CACHE"] = cache
        built(3, 1.0)  # compiles the kernel
        return measure(tuple(options.sizes), options.repeats)


def measure(sizes: tuple[int, ...], repeats: int) -> int:
    """All measurements and the table."""
    card = common.name_card()
    buildings = []
    for n in sizes:
        _, building = built(n, 1.0)
        per_state = [f"{1e3 * x / n:.2f} ms" for x in (building.translation, building.compilation)]
        buildings.append(
            [
                n,
                common.seconds(building.translation),
                per_state[0],
                f"{building.size / 1e6:.2f} MB",
                common.seconds(building.compilation),
                per_state[1],
            ]
        )
        common.say(" ".join(map(str, buildings[-1])))
    good: list[bool] = []
    runs = list(rows(sizes, repeats, good))
    head = ["n", "span", "Frot", "error", "steps / rhs"]
    head += ["CVODE, atol = 1e-8", "error", "steps / rhs", "ratio"]
    head += ["CVODE, atol = 1e-10", "error", "steps / rhs", "ratio"]
    lines = [
        "# RC ladder",
        "",
        *card,
        f"- CVODE of scikit-sundae {common.installed('scikit-sundae')}: BDF, right-hand side and "
        "banded Jacobian in C (`peers/cvode_ladder.c`), SUNLinSol_Band, rtol = 1e-8",
        f"- times: processor time of the thread, medians of {repeats} runs, from the "
        "initial values to the last of four values asked for, the codes taking turns; "
        "Frot: `method = auto`, tolerance 1e-8",
        "- span: in fastest time constants R C / 4; error: largest of any voltage at the four "
        "times, against the sum over eigenvectors; the source has one volt",
        "",
        "## From text to program",
        "",
        *common.table(["n", "text to C", "a state", "C", "C compiler", "a state"], buildings),
        "",
        "## Run time",
        "",
        "A ratio above 1 means that Frot takes longer. The second tolerance of CVODE follows small "
        "voltages about as closely as Frot does.",
        "",
        *common.table(head, runs),
    ]
    common.write(common.RESULTS / "ladder.md", lines)
    return 0 if all(good) else 1


if __name__ == "__main__":
    raise SystemExit(main())
