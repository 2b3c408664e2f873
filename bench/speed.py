"""Speed and size of Frot as a user's shell sees it, against the targets.

Every figure is that of a fresh process started from outside; each is the median of several.
Writes `results/speed.md`; exit status 1 when a target is missed or a measurement failed.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from common import BENCH, MODELS, RESULTS, median, name_card, say, table, write

SCENES = {
    "inclined_block": "mu=0.45",
    "backspin_hoop": "mu=0.25",
    "coulomb_oscillator": "mu=0.11",
}
FIRST, NEXT, KERNEL, HELP, MEMORY = 4.0, 0.6, 5e-3, 0.15, 300.0
HEAVY = ("casadi", "scipy", "matplotlib", "numpy", "lark")


class Failure(Exception):
    """A command of a measurement failed."""


@dataclass(frozen=True, slots=True)
class Run:
    """A finished process: standard output and error, wall time (s), peak memory (MB)."""

    output: str
    errors: str
    wall: float
    memory: float


@dataclass(slots=True)
class Row:
    """A line of the table; `target` None: for information. Lower is better.

    Times and sizes are judged by their median; counts, which have no noise, by their largest.
    """

    what: str
    unit: str
    target: float | None
    values: list[float] = field(default_factory=list)
    failure: str = ""

    @property
    def passed(self) -> bool:
        """No failure, and the judged value within the target."""
        if self.failure or not self.values:
            return False
        judged = median(self.values) if self.unit else max(self.values)
        return self.target is None or judged <= self.target

    def cells(self) -> tuple[str, ...]:
        """The cells of the table."""
        if self.failure or not self.values:
            return self.what, "-", "-", self._target(), "0", f"FAILED: {self.failure or 'no value'}"
        verdict = ("pass" if self.passed else "MISSED") if self.target is not None else ""
        spread = f"{self._show(min(self.values))} .. {self._show(max(self.values))}"
        middle = f"{self._show(median(self.values))} {self.unit}".rstrip()
        return self.what, middle, spread, self._target(), str(len(self.values)), verdict

    def _target(self) -> str:
        return f"<= {self.target:g} {self.unit}".rstrip() if self.target is not None else ""

    @staticmethod
    def _show(value: float) -> str:
        return f"{value:.0f}" if value == round(value) else f"{value:.3g}"


class Bench:
    """The measurements; `rows` grows in the order they are asked for."""

    def __init__(self, command: list[str], repeat: int, folder: Path) -> None:
        """`command` is how `frot` is started; scratch files go to `folder`."""
        self.rows: list[Row] = []
        self._command, self._repeat, self._folder = command, repeat, folder
        self._fresh = 0

    def run(self, arguments: Sequence[str | Path], **environment: str | Path) -> Run:
        """Run `frot` with these arguments; Failure if its exit status is not 0."""
        return self.start([*self._command, *map(str, arguments)], environment)

    def start(self, command: Sequence[str], environment: Mapping[str, str | Path]) -> Run:
        """Run a command; wait4 gives the peak memory of it and of what it waited for."""
        variables = {**os.environ, **{k: str(v) for k, v in environment.items()}}
        with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
            begun = time.perf_counter()
            process = subprocess.Popen(
                command, env=variables, stdin=subprocess.DEVNULL, stdout=out, stderr=err,
                cwd=self._folder,
            )  # fmt: skip
            _, status, usage = os.wait4(process.pid, 0)
            wall = time.perf_counter() - begun
            process.returncode = os.waitstatus_to_exitcode(status)
            texts = []
            for file in (out, err):
                file.seek(0)
                texts.append(file.read().decode("utf-8", "replace"))
        if process.returncode != 0:
            last = texts[1].strip().splitlines()[-1:] or ["no message"]
            raise Failure(f"exit status {process.returncode} of {command[-1]}: {last[0]}")
        # Linux counts kilobytes, macOS bytes.
        size = usage.ru_maxrss / (1024 if sys.platform != "darwin" else 1024**2)
        return Run(texts[0], texts[1], wall, size)

    def cache(self) -> Path:
        """A new empty cache folder."""
        self._fresh += 1
        folder = self._folder / f"cache-{self._fresh}"
        folder.mkdir()
        return folder

    def warmed(self, arguments: Sequence[str | Path]) -> Path:
        """A new cache folder, filled by one run of a command outside the count."""
        folder = self.cache()
        try:
            self.run(arguments, FROT_CACHE=folder)
        except Failure as error:
            # The counted runs fail the same way, and say so in the table.
            say(f"warming the cache failed: {error}")
        return folder

    def measure(self, rows: Sequence[Row], once: Callable[[], Sequence[float]]) -> None:
        """Fill the rows with what `once` gives, several times; a failure is kept in them."""
        self.rows += rows
        for _ in range(self._repeat):
            try:
                values = once()
            except (Failure, OSError, ValueError) as error:
                for row in rows:
                    row.failure = str(error)
                break
            for row, value in zip(rows, values, strict=True):
                row.values.append(value)
        for row in rows:
            say("  ".join(cell for cell in row.cells() if cell))


def fingerprint() -> str:
    """Digest of the sources beside this folder: a change of them makes cached programs stale."""
    digest = hashlib.sha256()
    for room in ("dsl", "compiler", "runtime", "frot"):
        for path in sorted((BENCH.parent / room).rglob("*")):
            if path.suffix in (".py", ".c", ".h", ".lark"):
                digest.update(str(path).encode() + path.read_bytes())
    return digest.hexdigest()


def kernel_time(output: str) -> float:
    """Seconds in the kernel, from the summary that `frot simulate` prints."""
    found = re.search(r"([0-9.e+-]+) ms in the kernel", output)
    if found is None:
        raise Failure("the summary does not say the time in the kernel")
    return float(found[1]) * 1e-3


def runs(bench: Bench) -> None:
    """First and next runs of each model: time, memory, time in the kernel."""
    for name in SCENES:
        simulate = ["simulate", MODELS / f"{name}.frot", "--tolerance", "1e-9"]
        warm = bench.warmed(simulate)

        def first(simulate: list[str | Path] = simulate) -> Sequence[float]:
            folder = bench.cache()
            done = bench.run(simulate, FROT_CACHE=folder)
            shutil.rmtree(folder)
            return done.wall, done.memory

        def following(simulate: list[str | Path] = simulate, warm: Path = warm) -> Sequence[float]:
            done = bench.run(simulate, FROT_CACHE=warm)
            return done.wall, done.memory, 1e3 * kernel_time(done.output)

        bench.measure(
            [
                Row(f"{name}: first run, empty cache", "s", FIRST),
                Row(f"{name}: first run, peak memory", "MB", MEMORY),
            ],
            first,
        )
        bench.measure(
            [
                Row(f"{name}: next runs", "s", NEXT),
                Row(f"{name}: next runs, peak memory", "MB", MEMORY),
                Row(f"{name}: in the kernel, tolerance 1e-9", "ms", 1e3 * KERNEL),
            ],
            following,
        )


def front_door(bench: Bench) -> None:
    """`frot --help` and `frot check`."""
    bench.measure([Row("frot --help", "s", HELP)], lambda: [bench.run(["--help"]).wall])
    for name in SCENES:
        check = ["check", MODELS / f"{name}.frot"]
        warm = bench.warmed(check)
        bench.measure(
            [Row(f"frot check {name}: first, empty cache", "s", None)],
            lambda check=check: [bench.run(check, FROT_CACHE=bench.cache()).wall],
        )
        bench.measure(
            [Row(f"frot check {name}: next", "s", None)],
            lambda check=check, warm=warm: [bench.run(check, FROT_CACHE=warm).wall],
        )


def imports(bench: Bench, python: str) -> list[str]:
    """Which heavy packages each command loads, by `-X importtime`; rows for CasADi."""
    model = str(MODELS / "backspin_hoop.frot")
    warm = bench.cache()
    commands = {
        "frot --help": (["--help"], warm),
        "frot check FILE": (["check", model], bench.cache()),
        "frot simulate FILE, first": (["simulate", model], warm),
        "frot simulate FILE, next": (["simulate", model], warm),
    }
    listed = []
    for title, (arguments, cache) in commands.items():
        line = [python, "-X", "importtime", "-m", "frot.command_line", *arguments]
        row = Row(f"{title}: modules of CasADi loaded", "", 0.0)
        if title.endswith("first"):
            row.target = None
        try:
            done = bench.start(line, {"FROT_CACHE": cache})
            loaded = [text.rpartition("|")[2].strip() for text in done.errors.splitlines()]
            roots = {name.partition(".")[0] for name in loaded}
            row.values.append(float(sum(n.partition(".")[0] == "casadi" for n in loaded)))
            heavy = ", ".join(name for name in HEAVY if name in roots) or "none"
            listed.append(f"- `{title}` loads {len(loaded)} modules; of the heavy ones: {heavy}")
        except Failure as error:
            row.failure = str(error)
        bench.rows.append(row)
        say("  ".join(cell for cell in row.cells() if cell))
    return listed


def compilations(bench: Bench, folder: Path) -> None:
    """Compiler calls of a first run, of a next run, and of runs with other parameters."""
    real = os.environ.get("FROT_CC", "").strip() or shutil.which("cc") or shutil.which("gcc")
    if real is None:
        bench.rows.append(Row("compiler calls", "", 0.0, failure="no cc or gcc on the path"))
        return
    calls, wrapper = folder / "calls", folder / "counting-cc"
    wrapper.write_text(f'#!/bin/sh\necho call >> {shlex.quote(str(calls))}\nexec {real} "$@"\n')
    wrapper.chmod(0o755)

    def count(arguments: Sequence[str | Path], cache: Path) -> float:
        calls.write_text("")
        bench.run(arguments, FROT_CACHE=cache, FROT_CC=wrapper)
        return float(len(calls.read_text().splitlines()))

    for name, other in SCENES.items():
        simulate = ["simulate", MODELS / f"{name}.frot"]

        def once(
            simulate: list[str | Path] = simulate, name: str = name, other: str = other
        ) -> Sequence[float]:
            cache = bench.cache()
            first = count(simulate, cache)
            if first == 0:
                raise Failure("the counting compiler was never called in a first run")
            again = count(simulate, cache)
            changed = count([*simulate, "--set", other], cache)
            return first, again, changed

        bench.measure(
            [
                Row(f"{name}: compiler calls, first run", "", None),
                Row(f"{name}: compiler calls, next run", "", 0.0),
                Row(f"{name}: compiler calls, --set {other}", "", 0.0),
            ],
            once,
        )


def fmus(bench: Bench, folder: Path) -> None:
    """Time of export and size of each FMU."""
    for name in SCENES:
        for fmi in ("2.0", "3.0"):
            target = folder / f"{name}.fmu"
            cache = bench.warmed(["simulate", MODELS / f"{name}.frot", "--quiet"])

            def once(
                name: str = name, fmi: str = fmi, target: Path = target, cache: Path = cache
            ) -> Sequence[float]:
                export = [
                    "fmu",
                    MODELS / f"{name}.frot",
                    "--fmi",
                    fmi,
                    "-o",
                    target,
                    "--platforms",
                    "native",
                ]
                done = bench.run(export, FROT_CACHE=cache)
                size = target.stat().st_size / 1e3
                target.unlink()
                return done.wall, done.memory, size

            bench.measure(
                [
                    Row(f"{name}: export, FMI {fmi}, program in the cache", "s", None),
                    Row(f"{name}: export, FMI {fmi}, peak memory", "MB", MEMORY),
                    Row(f"{name}: size of the FMU, FMI {fmi}", "kB", None),
                ],
                once,
            )


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--quick", action="store_true", help="one repetition of each")
    parser.add_argument("--repeat", type=int, default=7, metavar="N", help="repetitions (7)")
    parser.add_argument(
        "--python", default=sys.executable, help="the Python that has Frot (this one)"
    )
    parser.add_argument("-o", "--output", type=Path, default=RESULTS / "speed.md", help="the table")
    options = parser.parse_args()
    repeat = 1 if options.quick else max(1, options.repeat)
    script = Path(options.python).parent / "frot"
    if not script.exists():
        parser.error(f"no frot beside {options.python}; is it installed there?")
    card = name_card()
    with tempfile.TemporaryDirectory(prefix="frot-bench-") as made:
        folder = Path(made)
        bench = Bench([str(script)], repeat, folder)
        # One run outside the count: files in the page cache, bytecode written.
        bench.warmed(["simulate", MODELS / "inclined_block.frot"])
        sources = fingerprint()
        front_door(bench)
        loaded = imports(bench, options.python)
        runs(bench)
        compilations(bench, folder)
        fmus(bench, folder)
    if fingerprint() != sources:
        bench.rows.append(
            Row(
                "Frot itself unchanged while it was measured",
                "",
                0.0,
                failure="its sources changed, so that programs in the cache went stale",
            )
        )
    missed = [row for row in bench.rows if not row.passed]
    head = ("what", "median", "smallest .. largest", "target", "runs", "verdict")
    lines = ["# Speed and size", "", *card, ""]
    lines += [
        f"Fresh processes, shell to shell; medians of {repeat}; counts must hold in every run. "
        + (f"**{len(missed)} missed or failed.**" if missed else "All targets met."),
        "",
        *table(head, [row.cells() for row in bench.rows]),
        "",
        "What is loaded:",
        "",
        *loaded,
        "",
        "Peak memory is the largest resident set of the process and of those it waited for (the C "
        "compiler among them). Python's bytecode is there already, as after any first use.",
    ]
    write(options.output, lines)
    for row in missed:
        print(f"missed: {row.what}: {row.cells()[1]} ({row.cells()[-1]})")
    if not missed:
        print(f"all {sum(row.target is not None for row in bench.rows)} targets met")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
