"""Scenes with many impacts: error against time for Frot and its peers, and what an impact costs.

    python bench/impacts.py --peers-python /tmp/peers/bin/python --peers-python /usr/bin/python3

Scenes and exact values: `peers/impact_scenes.py`, `impact_references.py`. Writes
`results/impacts.md`.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
from pathlib import Path

import impact_references
from common import RESULTS, name_card, seconds, table, write
from impact_cost import measured
from peers import impacts_frot
from peers.impact_scenes import BALL, BILLIARD, BLOCK, CHAIN, SCENES
from work_precision import CODES, Entry, collect, notes

import frot

TITLES = {
    "ball": f"Elastic ball, {BALL.bounces} bounces",
    "block": f"Rocking block, {BLOCK.blows} blows",
    "billiard": f"Nine elastic balls, {BILLIARD.impacts} impacts",
    "chain": f"Chain of {CHAIN.rods} rods that falls on a table",
}
ERRORS = {
    "ball": "height after the last bounce, exactly the first one",
    "block": "tilt after the last blow, against swings integrated one by one (Housner's ratio)",
    "billiard": f"places after {BILLIARD.compared} impacts, against 300 digits",
    "chain": f"places at {CHAIN.compared} s, after three impacts, against Frot at 1e-13",
}


def references() -> dict[str, dict[str, list[float]]]:
    """Places to compare, and the instants of comparison and of the end, by scenes."""
    turned, tilt = impact_references.block()
    early, late, places = impact_references.billiard()
    model = frot.compile(impacts_frot.chain())
    times = {
        "ball": (BALL.stop, BALL.stop),
        "block": (turned, turned),
        "billiard": (early, late),
        "chain": (CHAIN.compared, CHAIN.stop),
    }
    fine = impacts_frot.run(model, "chain", 1e-13, times)
    found = {"ball": impact_references.ball(), "block": tilt, "billiard": places}
    whole = {**found, "chain": fine.positions}
    return {
        "places": {k: list(whole[k]) for k in SCENES},
        "times": {k: list(times[k]) for k in SCENES},
    }


def rows(scene: str, found: dict[str, list[Entry]]) -> list[str]:
    """A line for each run, in the order of the codes."""
    lines = []
    for name, entries in found.items():
        for e in entries:
            if e.get("scene") != scene or e["kind"] not in ("run", "failed"):
                continue
            first = (CODES[name][0], e["method"], e["label"])
            if e["kind"] == "failed":
                lines.append((*first, "FAILED", "", "", "", e["reason"]))
                continue
            kernel = seconds(e["kernel"]) if e["kernel"] is not None else ""
            work = f"{e['work']} {e['unit']}"
            error = f"{e['error']:.1e}"
            lines.append((*first, error, f"{e['speed']:.3g}", seconds(e["wall"]), kernel, work))
    head = ("code", "method", "setting", "error", "energy at the end (J)", "wall", "kernel", "work")
    return table(head, lines)


def ratios(scene: str, found: dict[str, list[Entry]]) -> str:
    """How much longer each peer takes in its best run, and with which error."""
    runs = {
        n: [e for e in es if e["kind"] == "run" and e["scene"] == scene] for n, es in found.items()
    }
    if not runs.get("frot"):
        return ""
    best = min(runs["frot"], key=lambda e: e["wall"])
    said = []
    for name, entries in runs.items():
        if name == "frot" or not entries:
            continue
        fine = min(entries, key=lambda e: e["error"])
        quick = min(entries, key=lambda e: e["wall"])
        said.append(
            f"{CODES[name][0]} {fine['wall'] / best['wall']:.3g} times as long at its least error "
            f"{fine['error']:.1e}, {quick['wall'] / best['wall']:.3g} times at its quickest, with "
            f"error {quick['error']:.1e}"
        )
    beside = f"Beside Frot's {seconds(best['wall'])} with error {best['error']:.1e}: "
    return beside + "; ".join(said) + "." if said else ""


def cost() -> list[str]:
    """What an impact costs, in evaluations and in time."""
    head = ("scene", "impacts", "evaluations", "time", "an evaluation", "time in evaluations")
    lines, found = [], measured()
    for name, m in found.items():
        spent = (seconds(m.time), seconds(m.evaluation), f"{m.time / m.evaluation:.0f}")
        lines.append((name, m.impacts, f"{m.evaluations:.0f}", *spent))
    met = "met" if all(m.evaluations < 10 for m in found.values()) else "missed"
    return [
        "## What an impact costs Frot",
        "",
        "What a run takes for an instant of impacts beside its steps (`impact_cost.py`). The aim",
        f"is less than ten evaluations: it is **{met}**.",
        "",
        *table(head, lines),
        "",
    ]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--peers-python", action="append", default=[], help="a Python that has peers"
    )
    parser.add_argument("--quick", action="store_true", help="one run of each setting, no file")
    parser.add_argument("--only", nargs="*", default=list(CODES), choices=list(CODES))
    parser.add_argument("--scenes", nargs="*", default=list(SCENES), choices=list(SCENES))
    parser.add_argument("--file", default="impacts.md", help="in results")
    given = parser.parse_args()
    card = name_card()
    exact = references()
    exact["places"] = {k: exact["places"][k] for k in given.scenes}
    found: dict[str, list[Entry]] = {}
    with tempfile.TemporaryDirectory(prefix="frot-bench-") as made:
        path = Path(made) / "exact.json"
        path.write_text(json.dumps(exact))
        for name in given.only:
            pythons = [sys.executable] if name == "frot" else given.peers_python or [sys.executable]
            found[name] = collect(name, pythons, given.quick, "--exact", str(path))
    lines = [
        "# Scenes with many impacts",
        "",
        f"`python bench/impacts.py` with {', '.join(CODES[k][0] for k in given.only)}, in one run:",
        "",
    ]
    lines += [*card, ""]
    for scene in given.scenes:
        lines += [
            f"## {TITLES[scene]}",
            "",
            f"Error: {ERRORS[scene]}.",
            "",
            *rows(scene, found),
            "",
        ]
        lines += [x for x in (ratios(scene, found),) if x]
        lines += ["", *notes(scene, found), ""]
    if "frot" in given.only and given.scenes == list(SCENES):
        lines += cost()
    print("\n".join(lines))
    if not given.quick:
        write(RESULTS / given.file, lines)
    return int(any(e["kind"] == "failed" for es in found.values() for e in es))


if __name__ == "__main__":
    sys.exit(main())
