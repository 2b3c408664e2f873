"""What the benchmarks share: the machine's name card, medians, tables in Markdown, progress."""

from __future__ import annotations

import os
import platform
import statistics
import subprocess
import sys
from collections.abc import Iterable, Sequence
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

BENCH = Path(__file__).resolve().parent
RESULTS = BENCH / "results"
MODELS = BENCH.parent / "models"
OWN_MODELS = BENCH / "models"


def say(text: str) -> None:
    """Progress, on standard error."""
    print(text, file=sys.stderr, flush=True)


def name_card() -> list[str]:
    """Machine, date, load and versions, as lines of a Markdown list."""
    load = ", ".join(f"{x:.2f}" for x in os.getloadavg()) if hasattr(os, "getloadavg") else "?"
    versions = ", ".join(
        f"{name} {installed(name)}" for name in ("frot", "casadi", "numpy", "scipy")
    )
    now = datetime.now(UTC)
    return [
        f"- machine: {_processor()}, {os.cpu_count()} cores, {_memory()}; shared with other work, "
        f"load average at the start {load}",
        f"- system: {platform.platform()}, Python {platform.python_version()}, {_compiler()}",
        f"- versions: {versions}; sources {_revision()}",
        f"- date: {now:%Y-%m-%d %H:%M} UTC",
    ]


def installed(name: str) -> str:
    """Version of an installed distribution, or a dash."""
    try:
        return version(name)
    except PackageNotFoundError:
        return "-"


def _processor() -> str:
    try:
        for line in Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()


def _memory() -> str:
    try:
        pages = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError, OSError):
        return "memory unknown"
    return f"{pages / 2**30:.0f} GiB"


def _compiler() -> str:
    command = os.environ.get("FROT_CC", "cc").split()
    return _first_line([*command, "--version"]) or "no cc on the path"


def _revision() -> str:
    place = ["git", "-C", str(BENCH)]
    revision = _first_line([*place, "rev-parse", "--short", "HEAD"]) or "outside git"
    changed = _first_line([*place, "status", "--porcelain", "--untracked-files=no"])
    return f"{revision} with uncommitted changes" if changed else revision


def _first_line(command: Sequence[str]) -> str:
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError:
        return ""
    return done.stdout.partition("\n")[0].strip() if done.returncode == 0 else ""


def median(values: Iterable[float]) -> float:
    """The median."""
    return statistics.median(values)


def seconds(value: float) -> str:
    """A duration with three digits, in the unit that suits it."""
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("us", 1e-6)):
        if value >= size:
            return f"{value / size:.3g} {unit}"
    return f"{value * 1e9:.3g} ns"


def table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> list[str]:
    """A Markdown table; a bar inside a cell is escaped."""
    lines = [_row(head), "|" + "---|" * len(head)]
    lines += [_row(row) for row in rows]
    return lines


def _row(cells: Sequence[object]) -> str:
    return "| " + " | ".join(str(cell).replace("|", "\\|") for cell in cells) + " |"


def write(path: Path, lines: Iterable[str]) -> None:
    """Write a text file and say so."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    say(f"written: {path}")
