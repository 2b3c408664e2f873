"""A run against the same at a tolerance of 1e-12.

What the tolerance allows follows from the scene itself: the same motion with each parameter
changed by the tolerance, run at 1e-12, says how far an error of that size may grow.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

import frot
from judge.family import Random, Setting
from judge.scene import Scene

FINEST = 1e-12
FACTOR = 100.0
Run = Callable[[Mapping[str, float], float], frot.Result | None]


def nearby(values: Mapping[str, float], part: float, rng: Random) -> dict[str, float]:
    """Values that differ by about `part` of them.

    The factors `more` by which coefficients are larger at rest stay: they are not below one.
    """
    return {
        k: x if "more" in k else x * (1 + part * float(rng.normal())) for k, x in values.items()
    }


def compare(scene: Scene, setting: Setting, result: frot.Result, run: Run, seed: int) -> list[str]:
    """Faults: quantities that are further from the reference than their tolerance explains.

    `run(values, tolerance)` gives None where it cannot reach the end.
    """
    rng = np.random.default_rng(seed)
    fine = run(setting.values, FINEST)
    if fine is None:
        return []
    spread: dict[str, float] = {}
    times = np.linspace(result.time[0], result.time[-1], 40)
    names = [
        f"{b.name}.{what}"
        for b in scene.bodies
        for what in ("position.x", "position.y", *(("angle",) if b.turns else ()))
    ]
    exact = fine.at(times)
    for _ in range(2):
        other = run(nearby(setting.values, setting.tolerance, rng), FINEST)
        if other is None:
            return []
        now = other.at(times)
        for name in names:
            error = float(np.max(np.abs(now[name] - exact[name])))
            spread[name] = max(spread.get(name, 0.0), error)
    given, faults = result.at(times), []
    length = max(float(np.max(np.abs(exact[n]))) for n in names if "position" in n)
    for name in names:
        size = length if "position" in name else 1.0 + float(np.max(np.abs(exact[name])))
        allowed = FACTOR * (spread[name] + setting.tolerance * size) + 1e-11 * size
        error = float(np.max(np.abs(given[name] - exact[name])))
        if error > allowed:
            faults.append(
                f"far from the run at {FINEST:g}: {name} by {error:.3g}, allowed {allowed:.3g} "
                f"(tolerance {setting.tolerance:.0e})"
            )
    return faults[:3]
