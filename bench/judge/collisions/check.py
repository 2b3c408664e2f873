"""What must hold of a run with impacts.

Nothing penetrates; impulses lie in their cones and are the jump of the momenta; energy does not
grow; an impact of one contact is the one of `keller`; between impacts reactions obey Newton-Euler.
"""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Mapping

import numpy as np

import frot
from judge.collisions.cones import TOUCH, left_over, unit_of
from judge.collisions.keller import Jams, impact
from judge.collisions.rows import Bodies, Floats, Meeting
from judge.collisions.scene import ImpactScene
from judge.family import Random, Setting
from judge.seen import OPEN, Findings

DEEP = 1e-12  # penetration, in parts of the size of the scene
LOW = 1e-8  # height of a flight that is contact, in parts of the size
MISSED = 1e-7  # part of the momenta that may be left over, and of energies and speeds
NOTHING = 1e-4  # part of the usual accelerations that is none
BEFORE = 1e-13
LOOKS, SAMPLES, INSTANTS = 16, 150, 6
Rows = list[dict[str, float]]


class ImpactJudge:
    """A scene with values of its parameters and a result of it."""

    def __init__(self, scene: ImpactScene, setting: Setting, result: frot.Result) -> None:
        self.scene, self.values, self.result = scene, setting.values, result
        self.tol, self.found, self.counts = setting.tolerance, Findings(), Counter[str]()
        lengths = [abs(x) for w, x in self.values.items() if scene.parameters.get(w) == "Length"]
        places = [
            float(np.max(np.abs(result[f"{b.name}.position.{k}"])))
            for b in scene.bodies
            for k in scene.axes
        ]
        self.length = max(*lengths, *places)
        self.speed = max(
            float(np.max(np.abs(result[f"{b.name}.velocity.{k}"])))
            for b in scene.bodies
            for k in scene.axes
        )
        self.hits: dict[float, list[frot.Event]] = {}
        for e in result.events:
            if e.kind.endswith("impact") or e.kind == "percussion":
                self.hits.setdefault(e.time, []).append(e)

    def rows(self, times: Floats) -> Rows:
        """All variables at times."""
        now = self.result.at(times)
        return [{name: float(x[k]) for name, x in now.items()} for k in range(len(times))]

    def bodies(self, t: float, row: Mapping[str, float] | None = None) -> Bodies:
        """The scene in the recorded state."""
        return Bodies(self.scene, self.values, row or self.rows(np.array([t]))[0], t)

    def examine(self, rng: Random) -> Findings:
        """Check events, samples of the whole run, impacts and instants between them."""
        begin, end = float(self.result.time[0]), float(self.result.time[-1])
        times = [e.time for e in self.result.events]
        for one, other in itertools.pairwise(times):
            if other < one:
                self.found.fault(f"order of events: {other!r} after {one!r}")
        self.samples(rng, begin, end)
        chosen = sorted(self.hits)
        if len(chosen) > LOOKS:
            later = rng.permutation(len(chosen) - 4)[: LOOKS - 4] + 4
            chosen = [*chosen[:4], *(chosen[int(k)] for k in later)]
        for t in chosen:
            self.hit(t, begin)
        marks = np.array(sorted({begin, end, *times}))
        for t in rng.uniform(begin, end, INSTANTS):
            if np.min(np.abs(marks - t)) > 1e-9 * (end - begin):
                self.between(float(t))
        return self.found

    def samples(self, rng: Random, begin: float, end: float) -> None:
        """Nothing is not finite, nothing penetrates, energy does not grow."""
        marks = [e.time for e in self.result.events if begin <= e.time <= end][:SAMPLES]
        times = np.array(sorted({begin, end, *rng.uniform(begin, end, SAMPLES), *marks}))
        energies = []
        for t, row in zip(times, self.rows(times), strict=True):
            if not all(np.isfinite(x) for x in row.values()):
                self.found.fault(f"not finite: a variable at t = {t!r}")
                return
            now = self.bodies(float(t), row)
            for name, m in now.meetings.items():
                deep = DEEP * unit_of(m, self.length)
                self.found.hold("penetration", min(m.gap, 0.0), deep, float(t), name)
            energies.append(now.energy())
        if self.free_to_grow:
            return
        total = np.array([sum(e) for e in energies])
        size = max(e[0] for e in energies) + float(np.ptp([e[1] for e in energies]))
        for t, rise in zip(times[1:], np.diff(total), strict=True):
            room = 1e3 * self.tol + 1e-11
            self.found.hold("energy grows", max(rise, 0.0), room * size, float(t), "all")

    @property
    def free_to_grow(self) -> bool:
        """Whether something gives energy: a moving wall, a percussion, Newton's rule."""
        moved = any(w.moves for w in self.scene.walls) or self.scene.percussions
        return bool(moved) or any(c.rule == "newton" for c in self.scene.touches)

    def before(self, t: float, begin: float) -> tuple[float, dict[str, float]]:
        """A time before an impact, and the state there: at the start the one that is stated."""
        earlier = [x for x in self.hits if x < t]
        if t <= begin:
            return t, {**self.rows(np.array([t]))[0], **start_row(self.scene, self.values)}
        at = max(t - BEFORE * abs(t), (max(earlier, default=begin) + t) / 2)
        return at, self.rows(np.array([at]))[0]

    def hit(self, t: float, begin: float) -> None:
        """One instant of impacts."""
        events = [e for e in self.hits[t] if e.kind != "percussion"]
        struck = [e.text.split("'")[1] for e in self.hits[t] if e.kind == "percussion"]
        at, row = self.before(t, begin)
        row_after = self.rows(np.array([t]))[0]
        a, b = self.bodies(t, row), self.bodies(t, row_after)
        self.counts["examined"] += 1
        known = np.zeros(a.n)
        for name in struck:
            p = next(p for p in self.scene.percussions if p.name == name)
            push = np.array([self.values.get(f"p{k}_{name}", 0.0) for k in "xyz"])
            for k, way in enumerate(np.eye(3)):
                known += push[k] * a.direction(way, a.place(p.at), p.at.body)
        impulses: dict[str, float] = {}
        for e in events:
            impulses[e.liaison] = impulses.get(e.liaison, 0.0) + e.impulse
            met = e.contacts >= (0 if struck else 1)
            if not (e.impulse >= 0 and met and e.phases >= 1):
                self.found.fault(f"event: impulse, contacts or phases of '{e.text}'")
            if e.until is not None and e.until < t:
                self.found.fault(f"limit before its impact: '{e.text}'")
        change = b.speed - a.speed
        wanted = a.mass @ change - known
        size = a.mass @ (np.abs(a.speed) + np.abs(b.speed))
        shook = (t - at) * self.quickness(row)
        left, whole = left_over(a, self.length, wanted, np.abs(size) + np.abs(known), impulses)
        self.found.hold("impulses", left, MISSED * whole, t, "all")
        kinetic = (a.energy()[0], b.energy()[0])
        moved = any(w.moves for w in self.scene.walls)
        if not struck and not moved:
            lost, total = sum(e.energy_lost for e in events), kinetic[0] - kinetic[1]
            room = MISSED * kinetic[0] * (1 + 100 * shook / self.slowest(a))
            if not any(c.rule == "newton" for c in self.scene.touches):
                self.found.hold("energy grows in an impact", min(total, 0), room, t, "all")
            if not self.dry:
                self.found.hold("energy lost", total - lost, room, t, "all")
            else:
                self.found.hold("energy lost", min(total - lost, 0), room, t, "all")
        for name, m in b.meetings.items():
            if row_after.get(f"{name}.mode", 0) != OPEN:
                u = speeds(m, a)[0]
                room = MISSED * (np.abs(m.rows[0]) @ np.abs(a.speed) + abs(u)) + 10 * shook
                self.found.hold("approach after", min(speeds(m, b)[0], 0), room, t, name)
        if len(events) == 1 and not struck and not self.dry:
            self._rule(events[0], a, b, shook)

    @property
    def dry(self) -> bool:
        """Whether a bearing has friction."""
        return any(j.dry and self.values[f"mu_{j.name}"] > 0 for j in self.scene.joints)

    def slowest(self, now: Bodies) -> float:
        """A size of the speeds."""
        return max(float(np.max(np.abs(now.speed))), 1e-300)

    def quickness(self, row: Mapping[str, float]) -> float:
        """The largest acceleration of a place."""
        found = 0.0
        for b in self.scene.bodies:
            a = max(abs(row[f"{b.name}.acceleration.{k}"]) for k in self.scene.axes)
            if b.shape != "particle":
                words = [""] if self.scene.plane else [".x", ".y", ".z"]
                turns = [row[f"{b.name}.angular_acceleration{w}"] for w in words]
                spins = [row[f"{b.name}.angular_velocity{w}"] for w in words]
                a += self.length * max(
                    max(abs(x), y * y) for x, y in zip(turns, spins, strict=True)
                )
            found = max(found, a)
        return found

    def between(self, t: float) -> None:
        """Newton-Euler at an instant: what loads leave over is reactions within their cones."""
        row = self.rows(np.array([t]))[0]
        now = self.bodies(t, row)
        quick = np.zeros(now.n)
        for b in self.scene.bodies:
            k = now.at[b.name]
            for i, axis in enumerate(self.scene.axes):
                quick[k + i] = row[f"{b.name}.acceleration.{axis}"]
            if b.shape == "particle":
                continue
            if self.scene.plane:
                quick[k + 5] = row[f"{b.name}.angular_acceleration"]
            else:
                turns = [row[f"{b.name}.angular_acceleration.{x}"] for x in "xyz"]
                quick[k + 3 : k + 6] = turns
        usual = np.tile([1.0] * 3 + [1 / self.length] * 3, len(self.scene.bodies))
        usual *= NOTHING * (self.speed**2 / self.length + self.length / self.result.time[-1] ** 2)
        size = now.mass @ (np.abs(quick) + usual) + np.abs(now.load)
        left, whole = left_over(now, self.length, now.mass @ quick - now.load, size, None)
        self.found.hold("Newton-Euler", left, MISSED * whole, t, "all")

    def _rule(self, e: frot.Event, a: Bodies, b: Bodies, shook: float) -> None:
        """An impact of one contact that no other one shares, by itself."""
        m = a.meetings[e.liaison]
        inverse = a.mobility()
        w = m.rows @ inverse @ m.rows.T
        for name, other in a.meetings.items():
            near = abs(other.gap) < TOUCH * unit_of(other, self.length)
            bound = np.sqrt(w[0, 0] * float(other.rows[0] @ inverse @ other.rows[0]))
            joined = np.max(np.abs(m.rows @ inverse @ other.rows[0])) > 1e-9 * bound
            if name != e.liaison and near and joined:
                return
        used = m.rows if max(m.mu, m.mu_s) > 0 else m.rows[:1]
        w = used @ inverse @ used.T
        u = used @ a.speed + m.drift[: len(used)]
        size = float(np.max(np.abs(used) @ np.abs(a.speed)))
        # a slip that is rounding beside its terms is none
        if len(u) > 1 and np.linalg.norm(u[1:]) < 1e-13 * size:
            u[1:] = 0.0
        # flights after the last of infinitely many impacts are too low to differ from contact
        last = e.until is not None
        if last and m.e < 1:
            low = (e.until - e.time) * (1 - m.e) * m.e * abs(u[0]) / 4
            self.found.hold("last flight", low, LOW * unit_of(m, self.length), e.time, e.liaison)
        try:
            after, impulses, lost = impact(w, u, (m.mu, m.mu_s), 0 if last else m.e, m.touch.rule)
        except (Jams, ZeroDivisionError):
            self.counts["jammed by friction"] += 1
            return
        self.counts["computed anew"] += 1
        now = used @ b.speed + m.drift[: len(used)]
        room = MISSED * float(np.max(np.abs(u))) + 10 * shook + 1e-13 * size
        t = e.time
        self.found.hold("speeds after", float(np.max(np.abs(now - after))), room, t, e.liaison)
        self.found.hold("impulse", e.impulse - impulses[0], 2 * room / w[0, 0], t, e.liaison)
        share = room * float(np.max(np.abs(u))) / w[0, 0]
        self.found.hold("loss", e.energy_lost - lost, 4 * share, t, e.liaison)


def speeds(m: Meeting, now: Bodies) -> Floats:
    """Speeds of the rows of a contact in a state near the one it was made in."""
    return np.asarray(m.rows @ now.speed + m.drift)


def start_row(scene: ImpactScene, values: Mapping[str, float]) -> dict[str, float]:
    """The stated start as a row of a result."""
    row: dict[str, float] = {}
    for b in scene.bodies:
        n = b.name
        for k, v in zip(scene.axes, "uvw", strict=False):
            row[f"{n}.position.{k}"] = values[f"{k}0_{n}"]
            row[f"{n}.velocity.{k}"] = values[f"{v}0_{n}"]
        if b.shape == "particle":
            continue
        if scene.plane:
            row[f"{n}.angle"] = values[f"a0_{n}"]
            row[f"{n}.angular_velocity"] = values[f"o0_{n}"]
            continue
        for k in range(1, 5):
            row[f"{n}.orientation[{k}]"] = values[f"q{k}_{n}"]
        for k, x in enumerate("xyz"):
            row[f"{n}.angular_velocity.{x}"] = values[f"o{k + 1}_{n}"]
    return row
