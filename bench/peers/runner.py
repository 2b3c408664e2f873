"""Runs the scenes with one code and writes a line of JSON for each setting.

Started by `work_precision.py` in the Python that has the code: `python -m peers.runner NAME FILE`.
`impacts.py` adds `--exact JSON`: `places` by scenes, and `times` of comparison and of the end;
adapters are then `impacts_NAME`.
Each line reaches the file as it is made, so that a crash of the code loses nothing before it.
"""

from __future__ import annotations

import json
import statistics
import sys
import time
import warnings
from importlib import import_module
from pathlib import Path

from closed_forms import exact

from peers.interface import SCENES, Outcome, Setting

Places = tuple[float, ...]

# Short runs are repeated more often, at least three times.
LEAST, MOST, ENOUGH = 3, 15, 1.0


def main() -> int:
    name, target, quick = sys.argv[1], Path(sys.argv[2]), "--quick" in sys.argv
    wanted: dict[str, Places] = {scene: exact(scene) for scene in SCENES}
    kind, times = "with", ()
    if "--exact" in sys.argv:
        given = json.loads(Path(sys.argv[sys.argv.index("--exact") + 1]).read_text())
        wanted, kind = given["places"], "impacts"
        times = (given["times"],)
    warnings.simplefilter("ignore")
    with target.open("w", encoding="utf-8") as file:

        def put(**entry: object) -> None:
            file.write(json.dumps(entry) + "\n")
            file.flush()

        try:
            adapter = import_module(f"peers.{kind}_{name}")
        except ImportError as error:
            put(kind="absent", reason=str(error))
            return 0
        put(kind="code", version=adapter.version())
        for scene in wanted:
            put(kind="note", scene=scene, note=adapter.NOTES[scene])
            for setting in adapter.settings(scene, *times):
                print(f"{adapter.NAME} {scene} {setting.method} {setting.label}", file=sys.stderr)
                put(kind="begun", scene=scene, method=setting.method, label=setting.label)
                least, most = (1, 1) if quick else (LEAST, MOST)
                put(**_measure(scene, setting, wanted[scene], least, most))
    return 0


def _measure(
    scene: str, setting: Setting, wanted: Places, least: int, most: int
) -> dict[str, object]:
    begun = time.perf_counter()
    walls: list[float] = []
    kernels: list[float] = []
    entry: dict[str, object] = {
        "kind": "run",
        "scene": scene,
        "method": setting.method,
        "label": setting.label,
        "unit": setting.unit,
    }
    outcome: Outcome | None = None
    try:
        while len(walls) < least or (len(walls) < most and time.perf_counter() - begun < ENOUGH):
            outcome = setting.run()
            walls.append(outcome.wall)
            if outcome.kernel is not None:
                kernels.append(outcome.kernel)
    except Exception as error:
        # Codes raise what they like; a failure is a line of the table.
        return {**entry, "kind": "failed", "reason": f"{type(error).__name__}: {error}"[:200]}
    assert outcome is not None
    pairs = zip(outcome.positions, wanted, strict=True)
    return {
        **entry,
        "error": max(abs(x - y) for x, y in pairs),
        "speed": outcome.speed,
        "wall": statistics.median(walls),
        "fastest": min(walls),
        "kernel": statistics.median(kernels) if kernels else None,
        "work": outcome.work,
        "repeats": len(walls),
    }


if __name__ == "__main__":
    sys.exit(main())
