"""The balance of energy over a result, and the kinetic energy at some instants."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from judge.mechanics import Floats, inertia
from judge.seen import SLACK, Seen

# Part of the energies of a run to which its residual is that of the record.
BALANCED = 1e-7


def balance(seen: Seen, rng: np.random.Generator, begin: float, end: float) -> None:
    """Kinetic + potential + dissipated - work is constant, and the kinetic energy right."""
    if "energy.kinetic" not in seen.result:
        return
    now = seen.result.at(np.sort(rng.uniform(begin, end, 8)))
    parts = [now[f"energy.{x}"] for x in ("kinetic", "potential", "dissipated", "work")]
    kinetic = np.zeros(8)
    look = seen.look(begin, {})
    for b in seen.scene.bodies:
        speed = now[f"{b.name}.velocity.x"] ** 2 + now[f"{b.name}.velocity.y"] ** 2
        kinetic += b.mass.at(look) * speed / 2
        if b.turns:
            kinetic += inertia(b, look) * now[f"{b.name}.angular_velocity"] ** 2 / 2
    grid = sum(
        np.max(np.abs(seen.result[f"energy.{x}"]))
        for x in ("kinetic", "potential", "dissipated", "work")
    )
    size = float(np.max(seen.result["energy.kinetic"]))
    for x, y, t in zip(kinetic, parts[0], now_times(now), strict=True):
        seen.found.hold("kinetic energy", float(x - y), 1e-11 * size, t, "energy")
    total = parts[0] + parts[1] + parts[2] - parts[3]
    now_here = seen.mechanics(end)
    grid += 1e-6 * float(np.max(now_here.load_size.reshape(-1, 3)[:, :2])) * seen.length
    steps = max(1, len(seen.result.events))
    allowed = 1e4 * steps * seen.tol * float(grid) + 1e-10 * float(grid)
    seen.found.hold(
        "energy balance", float(np.max(total) - np.min(total)), allowed, begin, "energy"
    )
    recorded = getattr(seen.result, "balance", None)
    if recorded is not None:
        ends = seen.result.at(np.array([begin, float(seen.result.time[-1])]))
        ended = [ends[f"energy.{x}"] for x in ("kinetic", "potential", "dissipated", "work")]
        whole = ended[0] + ended[1] + ended[2] - ended[3]
        missed = recorded.residual - float(whole[1] - whole[0])
        seen.found.hold("energy residual", missed, BALANCED * float(grid), begin, "energy")
    fall = float(np.min(np.diff(parts[2]), initial=0.0))
    seen.found.hold("dissipated", fall, (SLACK * seen.tol + 1e-12) * float(grid), begin, "energy")


def now_times(now: Mapping[str, Floats]) -> Floats:
    return now["time"] if "time" in now else np.zeros(8)
