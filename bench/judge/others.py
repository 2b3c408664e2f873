"""A run against others that must agree with it: a group alone, other units, another frame or order.

Starts agree to rounding. What a motion may differ by is found from the scene itself, by runs whose
parameters differ a little: see `compare`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

import frot
from judge.compare import nearby
from judge.family import Setting
from judge.mechanics import Floats
from judge.scene import Body, Scene
from judge.seen import Findings, Seen
from judge.write import END, write

Read = Callable[[Mapping[str, Floats], str], Floats]
STARTS = 1e-10
ACCELERATIONS = 1e-7
# Times the spread of runs whose parameters differ by the tolerance, or by rounding.
FACTOR = 100.0
ROUNDING = 1e-13
# Runs that stop do so at the same instant, to this part of it and to the spread of the motions.
ENDS = 1e-5


def as_it_is(now: Mapping[str, Floats], name: str) -> Floats:
    return now[name]


@dataclass(slots=True)
class Other:
    """A scene that moves as (a part of) another does; `read` gives its values as the other's.

    `exact`: its steps are the same too, so that runs agree to rounding. `literal`: its values are
    written into the text in mm, g and ms.
    """

    what: str
    scene: Scene
    read: Read = as_it_is
    exact: bool = False
    literal: bool = False
    part: bool = False
    bodies: list[Body] = field(default_factory=list)
    model: frot.Model | None = None


@dataclass(slots=True)
class Ran:
    """What became of a run: its result (None: it did not start), its code ("": none), its end."""

    result: frot.Result | None
    code: str
    end: float


Watch = Callable[[float], bool]


def run_other(
    other: Other, setting: Setting, values: Mapping[str, float], tolerance: float, watch: Watch
) -> Ran:
    """Run the other scene with these values of the first one's parameters."""
    model = other.model
    if other.literal:
        end = f"stop = {setting.stop * 1e3!r} ms"
        model = frot.compile(write(other.scene, dict(values), end, small=True))
        given = {}
    else:
        if model is None:
            model = other.model = frot.compile(write(other.scene))
        given = {k: x for k, x in values.items() if k in other.scene.parameters}
        given[END] = setting.stop
    try:
        result = model.simulate(tolerance=tolerance, parameters=given, watch=watch)
    except frot.SimulationError as stop:
        end = stop.result.time[-1] if stop.result is not None else 0.0
        return Ran(stop.result, stop.diagnostics[0].code, float(end))
    except frot.FrotError as refused:
        return Ran(None, refused.diagnostics[0].code, 0.0)
    return Ran(result, "", float(result.time[-1]))


def agree(
    seen: Seen | None, ran: Ran, others: list[Other], setting: Setting, watch: Watch, seed: int
) -> list[str]:
    """Faults: what differs between the run and the others."""
    faults, all_ran = [], []
    for other in others:
        theirs = run_other(other, setting, setting.values, setting.tolerance, watch)
        all_ran.append(theirs)
        if seen is None or ran.result is None or theirs.result is None:
            if not other.part and (ran.result is None) != (theirs.result is None):
                faults.append(f"{other.what}: {ran.code or 'runs'} against {theirs.code or 'runs'}")
            continue
        found = Findings()
        _starts(seen, other, ran.result, theirs.result, found)
        faults += found.faults
        if not found.faults:
            faults += _moves(seen, other, ran, theirs, setting, watch, seed)
    return faults + _ends(ran, others, all_ran)


def _ends(ran: Ran, others: list[Other], theirs: list[Ran]) -> list[str]:
    """A whole ends where the first of its parts does; other scenes where the first does."""
    parts = [t for o, t in zip(others, theirs, strict=True) if o.part]
    faults = []
    for o, t in zip(others, theirs, strict=True):
        if not o.part and t.result is not None and ran.result is not None and t.code != ran.code:
            faults.append(f"{o.what}: ends by {ran.code or 'time'} against {t.code or 'time'}")
    if parts:
        unstarted = sorted({t.code for t in parts if t.result is None})
        if (ran.result is None) != bool(unstarted):
            faults.append(f"alone: start {ran.code or 'found'} against {unstarted or 'found'}")
        elif ran.result is not None:
            first = min(parts, key=lambda t: t.end)
            if ran.code != first.code or abs(ran.end - first.end) > ENDS * abs(first.end):
                ends = f"{ran.code} {ran.end!r} against {first.code} {first.end!r}"
                faults.append(f"alone: end {ends}")
    return faults


def _columns(body: Body) -> list[tuple[str, str]]:
    """Names of a body's variables with the kind of their size."""
    found = [(f"{body.name}.{w}.{a}", w) for w in ("position", "velocity") for a in "xy"]
    if body.turns:
        found += [(f"{body.name}.angle", "angle"), (f"{body.name}.angular_velocity", "spin")]
    return found


def _size(seen: Seen, body: Body, kind: str) -> float:
    sizes = {"position": seen.length, "angle": 1.0, "velocity": seen.speed[body.name]}
    return sizes[kind] if kind in sizes else max(seen.speed[f"{body.name}.w"], 1e-300)


def _bodies(seen: Seen, other: Other) -> list[Body]:
    return other.bodies or seen.scene.bodies


def _starts(
    seen: Seen, other: Other, ours: frot.Result, theirs: frot.Result, found: Findings
) -> None:
    t = float(ours.time[0])
    mine, yours = ours.at(np.array([t])), theirs.at(np.array([float(theirs.time[0])]))
    for body in _bodies(seen, other):
        for name, kind in _columns(body):
            value = float(mine[name][0] - other.read(yours, name)[0])
            allowed = STARTS * _size(seen, body, kind)
            found.hold(f"{other.what}: start", value, allowed, t, name)


def _moves(
    seen: Seen,
    other: Other,
    ran: Ran,
    theirs: Ran,
    setting: Setting,
    watch: Watch,
    seed: int,
) -> list[str]:
    """The motion, held against the spread of the other's runs with parameters that differ."""
    assert ran.result is not None and theirs.result is not None
    begin = float(ran.result.time[0])
    end = begin + 0.999 * (min(ran.end, theirs.end) - begin)
    if not end > begin:
        return []
    rng = np.random.default_rng(seed)
    step = ROUNDING if other.exact else setting.tolerance
    spread: dict[str, Floats] = {}
    times = np.linspace(begin, end, 30)
    first = theirs.result.at(times)
    varied = []
    for k in range(3):
        changed = nearby(setting.values, step, rng)
        exact = setting.tolerance if other.exact or k else setting.tolerance * 1e-2
        near = run_other(other, setting, changed, max(exact, 1e-13), watch)
        if near.result is None or near.end < end:
            return []
        varied.append(near.result.at(times))
    mine, faults = ran.result.at(times), []
    for body in _bodies(seen, other):
        for name, kind in _columns(body):
            base = other.read(first, name)
            spread[name] = np.max([np.abs(other.read(v, name) - base) for v in varied], axis=0)
            reached = np.maximum.accumulate(spread[name])
            size = _size(seen, body, kind)
            # a step that one of two runs rejects, by rounding, makes a small part of the tolerance
            allowed = FACTOR * (reached + step * size) + (1e-10 + 1e-3 * setting.tolerance) * size
            error = np.abs(mine[name] - base)
            if np.any(error > allowed):
                k = int(np.argmax(error / allowed))
                faults.append(
                    f"{other.what}: motion: {name} by {error[k]:.3g} at t = {float(times[k])!r}, "
                    f"allowed {allowed[k]:.3g} (tolerance {setting.tolerance:.0e})"
                )
    return faults[:3]
