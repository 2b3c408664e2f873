"""Random scenes, run and judged by Newton-Euler alone: see `judge/`.

    python bench/random_scenes.py --seed 1 --count 3000

Each text is compiled once and run with many settings, in a process of its own that is ended when it
hangs. A table goes to results/random_scenes.md; every failure is printed with its text.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import time
from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from threading import Timer

sys.path.insert(0, str(Path(__file__).parent))

from common import RESULTS, name_card, say
from judge.trial import FAMILIES, Record, setting_of, structure_of
from judge.verdict import SLOW, VERDICTS
from judge.write import write

BROKEN = "broken"
START_UP = 300.0


def jobs(seed: int, count: int, only: list[str]) -> Iterator[tuple[str, int, list[int]]]:
    """Family, number of its text, settings: `count` runs in all, by the weights of the families."""
    chosen = {n: f for n, f in FAMILIES.items() if not only or n in only}
    total = sum(f.weight for f in chosen.values())
    for name, family in chosen.items():
        runs = max(1, round(count * family.weight / total))
        number = 0
        while runs > 0:
            here = min(runs, family.settings)
            yield name, number, list(range(here))
            runs, number = runs - here, number + 1


def run_job(seed: int, family: str, number: int, settings: list[int], limit: float) -> list[Record]:
    """Every setting of one text; a worker that hangs is ended and the rest given to another."""
    records: list[Record] = []
    rest = list(settings)
    while rest:
        job = {"seed": seed, "family": family, "number": number, "settings": rest, "limit": limit}
        worker = subprocess.Popen(
            [sys.executable, "-m", "judge.trial"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            cwd=Path(__file__).parent,
        )
        assert worker.stdin is not None and worker.stdout is not None and worker.stderr is not None
        worker.stdin.write(json.dumps(job))
        worker.stdin.close()
        at = rest[0]
        timer = Timer(START_UP, worker.kill)
        timer.start()
        refused = ""
        for line in worker.stdout:
            said = json.loads(line)
            timer.cancel()
            # judging takes its time too, and the machine is shared
            timer = Timer(20 * limit + 120, worker.kill)
            timer.start()
            if said["kind"] == "text":
                refused = said["why"]
            elif said["kind"] == "begin":
                at = said["setting"]
            elif said["kind"] == "record":
                record = said["record"]
                records.append(Record(**{**record, "key": tuple(record["key"])}))
                rest.remove(at)
        timer.cancel()
        status, words = worker.wait(), worker.stderr.read()
        worker.stdout.close()
        worker.stderr.close()
        if refused:
            records.append(Record((seed, family, number, -1), BROKEN, ["text refused: " + refused]))
            return records
        if rest:
            why = f"hangs, or ends its process (status {status}): {words[-500:]}"
            kind = SLOW if status == -9 else BROKEN
            records.append(Record((seed, family, number, at), kind, [why]))
            rest.remove(at)
    return records


def reproduction(record: Record) -> str:
    """A whole text that shows the fault."""
    seed, family, number, k = record.key
    structure = structure_of(seed, family, number)
    if k < 0:
        return write(structure.scene)
    s = setting_of(structure, seed, family, number, k)
    return write(structure.scene, s.values, f"stop = {s.stop!r} s, tolerance = {s.tolerance!r}")


def class_of(why: str) -> str:
    """The kind of a fault, for counting."""
    return why.split(":")[0].split(" at t")[0].strip()[:60]


def table(records: list[Record], seed: int) -> str:
    kinds = [*VERDICTS, BROKEN]
    by_family: dict[str, Counter[str]] = defaultdict(Counter)
    for r in records:
        by_family[r.key[1]][r.verdict] += 1
    lines = ["| scene | runs | " + " | ".join(kinds) + " |", "|---|" + "---:|" * (len(kinds) + 1)]
    total: Counter[str] = Counter()
    for name, counts in by_family.items():
        total += counts
        cells = [str(counts[k]) for k in kinds]
        lines.append(
            f"| {name}: {FAMILIES[name].what} | {sum(counts.values())} | "
            + " | ".join(cells)
            + " |"
        )
    lines.append(
        f"| all | {sum(total.values())} | " + " | ".join(str(total[k]) for k in kinds) + " |"
    )
    examined: Counter[str] = Counter()
    for r in records:
        examined.update(r.counts)
    if examined:
        lines += ["", "Impacts: " + ", ".join(f"{n} {what}" for what, n in examined.items()) + "."]
    classes: dict[str, list[Record]] = defaultdict(list)
    for r in records:
        if r.verdict not in VERDICTS[:2]:
            for c in {class_of(w) for w in r.why[:20]}:
                classes[f"{r.verdict}: {c}"].append(r)
    if classes:
        lines += [
            "",
            "| what is wrong | runs | for example (family, text, setting) |",
            "|---|---:|---|",
        ]
    for c, found in sorted(classes.items(), key=lambda x: -len(x[1])):
        shown = ", ".join(f"{r.key[1]} {r.key[2]} {r.key[3]}" for r in found[:3])
        lines.append(f"| {c.replace('|', '/')} | {len(found)} | {shown} |")
    return "\n".join(lines)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=3000, help="runs in all")
    parser.add_argument("--only", nargs="*", default=[], choices=list(FAMILIES), help="families")
    parser.add_argument("--limit", type=float, default=3.0, help="processor time of a run, in s")
    parser.add_argument("--failures", type=Path, help="a folder for the texts of all failures")
    parser.add_argument("--records", type=Path, help="a file of all verdicts, a line of JSON each")
    parser.add_argument("--show", metavar="FAMILY/TEXT/SETTING", help="print that one and judge it")
    parser.add_argument("--quiet", action="store_true", help="no texts of failures, no file")
    given = parser.parse_args()
    if given.show:
        family, number, k = given.show.split("/")
        records = run_job(given.seed, family, int(number), [int(k)], given.limit)
        print(reproduction(records[0]), records[0].verdict, *records[0].why, sep="\n")
        return 0
    begun = time.perf_counter()
    records = []
    for family, number, settings in jobs(given.seed, given.count, given.only):
        found = run_job(given.seed, family, number, settings, given.limit)
        records += found
        if given.records:
            with given.records.open("a") as file:
                file.writelines(json.dumps(asdict(r)) + "\n" for r in found)
        counts = Counter(r.verdict for r in found)
        say(f"{family} {number}: " + ", ".join(f"{n} {k}" for k, n in counts.items()))
        for r in found:
            if r.verdict in VERDICTS[:2]:
                continue
            seed, name, text, k = r.key
            if given.failures:
                given.failures.mkdir(parents=True, exist_ok=True)
                path = given.failures / f"{seed}_{name}_{text}_{k}.frot"
                told = "\n".join(f"// {r.verdict}: {w}".replace("\n", " ") for w in r.why)
                path.write_text(f"{told}\n{reproduction(r)}")
            elif not given.quiet:
                print(f"--- seed {seed}, {name} {text} {k}: {r.verdict}", *r.why[:5], sep="\n    ")
                print(reproduction(r))
    words = table(records, given.seed)
    print(words)
    if not given.quiet and not given.only:
        page = [
            "# Random scenes",
            "",
            f"`python bench/random_scenes.py --seed {given.seed} --count {given.count}`:",
        ]
        page += [
            f"{len(records)} runs in {time.perf_counter() - begun:.0f} s, each at most "
            f"{given.limit:g} s of processor time.",
            "",
            *name_card(),
            "",
            words,
            "",
        ]
        (RESULTS / "random_scenes.md").write_text("\n".join(page))
    return int(any(r.verdict not in VERDICTS[:2] for r in records))


if __name__ == "__main__":
    sys.exit(main())
