"""Chains of pinned rods: speed at equal error beside peers, and what many links cost.

`python bench/chains.py --peers PYTHON`, where PYTHON is an interpreter with `pin`, `mujoco`,
`exudyn` and `scipy` (in an environment of its own: `pip install pin mujoco exudyn scipy`). Rods of
1 kg and 1 m leave the horizontal at rest; asked is the place of the last tip after one second. The
reference is Lagrange's equations in angles to the ground by DOP853 at its least tolerance. All run
one after the other in one go; a time is the least of several, of the integration alone. Writes
`results/chains.md`.
"""

from __future__ import annotations

import argparse
import itertools
import json
import resource
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np
from common import BENCH, RESULTS, name_card, say, table, write
from frot.runtime.engine import Engine
from scipy.integrate import solve_ivp

import frot

CHAIN = """
planar model Chain
  parameter Integer n = {n};
  body b[n]: rod(mass = 1 kg, length = 1 m);
  liaison o: rotoide(ground, b[1].start);
  liaison j[n - 1]: rotoide(b[1:n - 1].tip, b[2:n].start);
  output Length x = b[n].tip.position.x;
  output Length y = b[n].tip.position.y;
initial
  o.angle = 0 rad;
  o.speed = 0 rad/s;
  for i in 1:n - 1 loop
    j[i].angle = 0 rad;
    j[i].speed = 0 rad/s;
  end for;
  experiment(stop = 1 s, tolerance = 1e-9);
end Chain;
"""
ERRORS = [10.0**-k for k in range(4, 12)]
REPEAT = 5
Curve = list[tuple[float, float]]


def reference(n: int) -> np.ndarray:
    """Place of the tip after a second."""
    beyond = n - np.arange(n) - 0.5
    coupling = np.minimum.outer(beyond, beyond)
    whole = beyond - 0.5 + 1 / 3

    def slope(_: float, z: np.ndarray) -> np.ndarray:
        angle, rate = z[:n], z[n:]
        turned = np.subtract.outer(angle, angle)
        mass = coupling * np.cos(turned)
        mass[np.diag_indices(n)] = whole
        force = -(coupling * np.sin(turned)) @ rate**2 - 9.81 * np.cos(angle) * beyond
        return np.concatenate((rate, np.linalg.solve(mass, force)))

    end = solve_ivp(slope, (0, 1), np.zeros(2 * n), "DOP853", rtol=2.3e-14, atol=1e-15).y[:n, -1]
    return np.array([np.cos(end).sum(), np.sin(end).sum()])


def own(n: int, exact: np.ndarray) -> tuple[Curve, float]:
    """Error and time of Frot at each tolerance; microseconds of an evaluation."""
    model = frot.compile(CHAIN.format(n=n))
    program, curve, least = model.program(), [], 1e30
    for k in range(3, 12):
        tolerance, best = 10.0**-k, 1e30
        for _ in range(REPEAT):
            engine = Engine(program)
            engine.settle_parameters()
            engine.start(0.0, tolerance, "rest")
            begun = time.perf_counter()
            engine.advance(1.0)
            best = min(best, time.perf_counter() - begun)
            if best > 2:
                break
        least = min(least, best / engine.statistics.evaluations)
        try:
            at = model.simulate(tolerance=tolerance).at(1.0)
        except frot.SimulationError as error:
            say(f"{n} links at tolerance {tolerance:g}: {str(error).splitlines()[0]}")
            break
        error = float(np.hypot(at["x"] - exact[0], at["y"] - exact[1]))
        curve.append((error, best))
        if best > 4:
            break
    return curve, least * 1e6


def peers(n: int, python: str, exact: np.ndarray) -> dict[str, Curve]:
    """The same of each peer."""
    command = [python, str(BENCH / "peers" / "chains.py"), str(n)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=1800, check=False)
    for line in done.stderr.splitlines():
        if "Error" in line:
            say(line)
    curves: dict[str, Curve] = {}
    for line in done.stdout.splitlines():
        if line.startswith("{"):
            found = json.loads(line)
            error = float(np.hypot(*(np.array(found["tip"]) - exact)))
            curves.setdefault(found["peer"], []).append((error, found["seconds"]))
    return curves


def seconds_for(curve: Curve, error: float) -> float | None:
    """The least time in which an error is reached, between the settings that were tried."""
    best: list[float] = [t for e, t in curve if e <= error]
    for (e1, t1), (e2, t2) in itertools.pairwise(curve):
        if e1 > error > e2 > 0 and t1 > 0:
            part = np.log(e1 / error) / np.log(e1 / e2)
            best.append(float(t1 * (t2 / t1) ** part))
    return min(best, default=None)


def many(n: int) -> tuple[str, ...]:
    """What many links cost: cells from a text to its program, an empty cache of programs, on."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "chain.frot"
        path.write_text(CHAIN.format(n=n) + f"// {time.time()}\n")
        begun = time.perf_counter()
        program = frot.load(path).program()
        compiled = time.perf_counter() - begun
        engine = Engine(program)
        engine.settle_parameters()
        engine.start(0.0, 1e-9, "rest")
        begun = time.process_time()
        engine.advance(1.0)
        run = time.process_time() - begun
    counts = engine.statistics
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    each = 1e6 * run / counts.evaluations
    return str(n), f"{compiled:.2f}", str(counts.steps), f"{run:.3f}", f"{each:.1f}", f"{peak:.0f}"


def main() -> None:
    """Measure and write the table."""
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--peers", default="", help="interpreter that has the peers")
    options.add_argument("--links", type=int, nargs="*", default=[2, 5, 10, 20, 50, 100])
    chosen = options.parse_args()
    lines = ["# Chains of pinned rods", "", *name_card(), ""]
    lines += [*(__doc__ or "").split("\n\n", 1)[1].strip().splitlines(), ""]
    ahead, evaluations = [], []
    for n in chosen.links:
        say(f"{n} links")
        exact = reference(n)
        curve, least = own(n, exact)
        evaluations.append((str(n), f"{least:.2f}"))
        others = peers(n, chosen.peers, exact) if chosen.peers else {}
        rows = []
        for error in ERRORS:
            mine = seconds_for(curve, error)
            cells = [f"{error:.0e}", "-" if mine is None else f"{1e3 * mine:.3g} ms"]
            for name, other in others.items():
                theirs = seconds_for(other, error)
                shown = "-" if theirs is None else f"{1e3 * theirs:.3g} ms"
                if theirs is not None and mine is not None:
                    shown += f" ({theirs / mine:.1f} x)"
                    ahead.append((theirs / mine, n, error, name))
                cells.append(shown)
            rows.append(tuple(cells))
        lines += [f"## {n} links", "", *table(("error", "Frot", *others), rows), ""]
    lines += ["## An evaluation in a run", "", *table(("links", "us"), evaluations), ""]
    costs = []
    for n in (10, 40, 200, 1000):
        say(f"compiling {n} links")
        costs.append(many(n))
    heads = (
        "links",
        "text to program, s",
        "steps",
        "run, s of CPU",
        "an evaluation, us",
        "peak, MB",
    )
    lines += ["## Many links: a second at 1e-9", "", *table(heads, costs), ""]
    if ahead:
        worst = min(ahead)
        lines += [
            f"Behind a peer in {sum(a[0] < 1 for a in ahead)} of {len(ahead)} comparisons; the "
            f"nearest: {worst[3]}, {worst[0]:.2f} times Frot's time at {worst[1]} links and "
            f"{worst[2]:.0e}.",
            "",
        ]
    write(RESULTS / "chains.md", lines)


if __name__ == "__main__":
    main()
