"""Large texts of equations: processor seconds from text to C and of the C compiler."""

from __future__ import annotations

import argparse
import os
import resource
import tempfile
import time

import common
import scale_texts

import frot

CASES = (
    *(("circuit", n) for n in (250, 500, 1000, 2000, 4000)),
    ("spelled", 1000),
    *(("resistive", n) for n in (25, 50, 100)),
    ("grid", 10),
    ("sphere", 20),
    ("brusselator", 500),
)


def spent(who: int) -> float:
    """Processor time of this process, or of those it waited for."""
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


def row(name: str, n: int) -> list[object]:
    """One text, built anew."""
    text = getattr(scale_texts, name)(n)
    own, others = spent(resource.RUSAGE_SELF), spent(resource.RUSAGE_CHILDREN)
    begun = time.perf_counter()
    program = frot.compile(text).program()
    whole = time.perf_counter() - begun
    size = program.source.stat().st_size / 1e6
    times = (
        spent(resource.RUSAGE_SELF) - own,
        spent(resource.RUSAGE_CHILDREN) - others,
    )
    found = [name, n, *map(common.seconds, times), f"{size:.2f} MB", common.seconds(whole)]
    common.say(" ".join(map(str, found)))
    return found


def main() -> int:
    """Measure and write results/scale.md."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="the smallest of each text only")
    options = parser.parse_args()
    first = dict(reversed(CASES))
    card = common.name_card()
    with tempfile.TemporaryDirectory() as cache:
        os.environ["FROT_CACHE"] = cache
        frot.compile(scale_texts.circuit(2)).program()  # compiles the kernel
        rows = [row(*case) for case in (first.items() if options.quick else CASES)]
    head = ["text", "n", "text to C", "C compiler", "C", "wall"]
    table = common.table(head, rows)
    target = common.RESULTS / ("scale_quick.md" if options.quick else "scale.md")
    common.write(target, ["# Large texts of equations", "", *card, "", *table])
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
