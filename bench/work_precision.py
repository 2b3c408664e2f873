"""Error against wall time for Frot and the peers that can do the scene, in one run on one machine.

Scenes: a block that stops on an incline, the Coulomb oscillator, a hoop that slides, rolls and
rests; all exact. Writes `results/work_precision.md` and `results/work_precision.png`.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from closed_forms import exact
from common import BENCH, RESULTS, name_card, say, seconds, table, write
from peers.interface import SCENES

CODES = {
    "frot": ("Frot", "#0b5fa5"),
    "siconos": ("Siconos", "#c8553d"),
    "exudyn": ("Exudyn", "#3a8f5c"),
    "mujoco": ("MuJoCo", "#8a63a6"),
    "drake": ("Drake", "#c79a2b"),
}
TITLES = {
    "block": "Block stopping on an incline",
    "oscillator": "Coulomb oscillator, nine half swings, rest",
    "hoop": "Hoop: slides, rolls with resistance, rests",
}
# Rounding makes some errors exactly zero; a logarithm cannot show them.
FLOOR = 1e-17
LONGEST = 1800.0
# Systems of three unknowns: threads of a BLAS only wait for one another.
ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}

Entry = dict[str, Any]


def collect(name: str, pythons: list[str], quick: bool, *options: str) -> list[Entry]:
    """What the runner wrote for one code, from the first Python that has it.

    `options` go to the runner.
    """
    entries: list[Entry] = []
    for python in pythons:
        entries = _run(name, python, quick, options)
        if not any(entry["kind"] == "absent" for entry in entries):
            break
    return entries


def _run(name: str, python: str, quick: bool, options: tuple[str, ...]) -> list[Entry]:
    say(f"-- {CODES[name][0]} with {python}")
    with tempfile.TemporaryDirectory(prefix="frot-bench-") as made:
        target = Path(made) / "entries"
        command = [python, "-m", "peers.runner", name, str(target), *["--quick"] * quick, *options]
        ending = ""
        try:
            # Codes print to standard output what they like.
            done = subprocess.run(
                command,
                cwd=BENCH,
                env={**os.environ, **ONE_THREAD},
                stdout=subprocess.DEVNULL,
                check=False,
                timeout=LONGEST,
            )
            if done.returncode != 0:
                ending = f"the process ended with status {done.returncode}"
        except subprocess.TimeoutExpired:
            ending = f"stopped after {LONGEST:g} s"
        except OSError as error:
            ending = str(error)
        text = target.read_text(encoding="utf-8") if target.exists() else ""
    entries = [json.loads(line) for line in text.splitlines()]
    if ending:
        last = entries[-1] if entries and entries[-1]["kind"] == "begun" else None
        lost = {**last, "kind": "failed"} if last else {"kind": "crashed"}
        entries.append({**lost, "reason": ending})
        say(f"{CODES[name][0]}: {ending}")
    return entries


def scene_table(scene: str, found: dict[str, list[Entry]]) -> list[str]:
    """A line for each run, in the order of the codes."""
    rows = []
    for name, entries in found.items():
        for entry in entries:
            if entry.get("scene") != scene or entry["kind"] not in ("run", "failed"):
                continue
            first = (CODES[name][0], entry["method"], entry["label"])
            if entry["kind"] == "failed":
                rows.append((*first, "FAILED", "", "", "", "", "", entry["reason"]))
                continue
            kernel = seconds(entry["kernel"]) if entry["kernel"] is not None else ""
            speed = "0" if entry["speed"] == 0 else f"{entry['speed']:.1e}"
            rows.append(
                (*first, f"{entry['error']:.1e}", speed, seconds(entry["wall"]),
                 seconds(entry["fastest"]), kernel,
                 f"{entry['work']} {entry['unit']}", entry["repeats"])
            )  # fmt: skip
    times = ("wall", "fastest", "kernel")
    head = ("code", "method", "setting", "error (m)", "end speed", *times, "work", "runs")
    return table(head, rows)


def notes(scene: str, found: dict[str, list[Entry]]) -> list[str]:
    """How each code was given the scene, and which codes are not there."""
    lines = []
    for name, entries in found.items():
        title = CODES[name][0]
        missing = [e for e in entries if e["kind"] in ("absent", "crashed")]
        said = [e["note"] for e in entries if e["kind"] == "note" and e["scene"] == scene]
        if missing:
            lines.append(f"- {title}: **not measured**: {missing[0]['reason']}")
        lines += [f"- {title}: {note}" for note in said]
    return lines


def draw(found: dict[str, list[Entry]], path: Path) -> None:
    """One panel a scene, one colour a code, one line style a method."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.lines import Line2D

    styles = [("-", "o"), ("--", "s"), (":", "^"), ("-.", "D")]
    plt.rcParams.update({"font.size": 9.5, "axes.titlesize": 10.5})
    figure, panels = plt.subplots(
        1, 3, figsize=(14.5, 6.2), sharex=True, sharey=True, layout="constrained"
    )
    for panel, scene in zip(panels, SCENES, strict=True):
        legend = []
        for name, entries in found.items():
            title, colour = CODES[name]
            runs = [e for e in entries if e["kind"] == "run" and e["scene"] == scene]
            methods = list(dict.fromkeys(e["method"] for e in runs))
            for method, (dash, marker) in zip(methods, styles, strict=False):
                points = [e for e in runs if e["method"] == method]
                panel.loglog(
                    [e["wall"] for e in points],
                    [max(e["error"], FLOOR) for e in points],
                    dash, marker=marker, color=colour, markersize=4.5, linewidth=1.4,
                    markeredgecolor="white", markeredgewidth=0.5,
                    zorder=3 if name == "frot" else 2,
                )  # fmt: skip
                legend.append(
                    Line2D([], [], color=colour, linestyle=dash, marker=marker, markersize=4.5,
                           label=f"{title}: {method}")
                )  # fmt: skip
            if not methods:
                legend.append(
                    Line2D([], [], linestyle="", label=f"{title}: not measured, see table")
                )
        panel.set_title(TITLES[scene])
        panel.set_xlabel("wall time of the solution (s)")
        panel.grid(True, which="major", color="#dddddd", linewidth=0.6)
        panel.set_axisbelow(True)
        panel.spines[["top", "right"]].set_visible(False)
        panel.legend(
            handles=legend, fontsize=7.8, frameon=False, loc="upper center",
            bbox_to_anchor=(0.5, -0.12), handlelength=3.2,
        )  # fmt: skip
    panels[0].set_ylabel("error of the end position against the exact value (m)")
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=130, metadata={"Software": None})
    plt.close(figure)
    say(f"written: {path}")


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument(
        "--peers-python",
        action="append",
        metavar="PATH",
        help="a Python that has peers (repeatable; each peer is taken from the first that has it)",
    )
    parser.add_argument("--only", nargs="+", choices=list(CODES), help="only these codes")
    parser.add_argument("--quick", action="store_true", help="one repetition of each")
    parser.add_argument(
        "-o", "--output", type=Path, default=RESULTS / "work_precision.md",
        help="the table; the plot goes beside it",
    )  # fmt: skip
    options = parser.parse_args()
    pythons = options.peers_python or [sys.executable]
    card = name_card()
    found = {
        name: collect(name, [sys.executable] if name == "frot" else pythons, options.quick)
        for name in options.only or CODES
    }
    versions = []
    for name, entries in found.items():
        known = [e["version"] for e in entries if e["kind"] == "code"]
        versions.append(f"{CODES[name][0]} {known[0] if known else 'not installed'}")
    lines = ["# Work and precision", "", *card, f"- codes: {', '.join(versions)}", ""]
    lines += [
        "Error of the end position against the exact value (hoop: the larger of x and radius times "
        "angle), largest speed left at the end (0 is exact rest), median and smallest wall "
        "time of solving the ready-built model (one thread), and the work it took. Frot's wall "
        "time is that of the whole Python call `simulate`; `kernel` is the part in C.",
        "",
        f"![error against wall time]({options.output.with_suffix('.png').name})",
    ]
    for scene in SCENES:
        values = ", ".join(f"{x:.16g}" for x in exact(scene))
        lines += ["", f"## {TITLES[scene]}", "", f"Exact: {values} m.", ""]
        lines += [*scene_table(scene, found), "", *notes(scene, found)]
    load = os.getloadavg()[0]
    if load > (os.cpu_count() or 1):
        lines += ["", f"The machine was busy (load {load:.1f} at the end): medians are too long."]
    write(options.output, lines)
    draw(found, options.output.with_suffix(".png"))
    failed = [
        f"{CODES[name][0]}: {e['reason']}"
        for name, entries in found.items()
        for e in entries
        if e["kind"] in ("failed", "crashed")
    ]
    for line in failed:
        print(f"failed: {line}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
