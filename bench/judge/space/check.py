"""What must hold of a run of a mechanism in space: relations, Newton-Euler, ideal reactions."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

import frot
from judge.family import Random, Setting
from judge.integrals import NODES, WEIGHTS, gauss_places
from judge.seen import EXACT, SLACK, Findings
from judge.space.families import rank, start_of
from judge.space.rows import Floats, Mechanism, State, axes
from judge.space.scene import SpaceScene

STARTS = 1e-9
SINGULAR = 2e-3
LEAST = 1e-6  # a speed beside lengths and masses of about one
AXES = "xyz"


def vector(row: Mapping[str, float], name: str) -> Floats:
    """The components of a vector of a record."""
    return np.array([row[f"{name}.{a}"] for a in AXES])


class SpaceJudge:
    """A mechanism with values of its parameters and a result of it."""

    def __init__(self, scene: SpaceScene, setting: Setting, result: frot.Result) -> None:
        self.scene, self.values, self.result = scene, setting.values, result
        self.tol, self.found = setting.tolerance, Findings()
        positions = [np.abs(result[f"{b.name}.position.{a}"]) for b in scene.bodies for a in AXES]
        sizes = [abs(x) for w, x in self.values.items() if scene.parameters.get(w) == "Length"]
        self.length = max(float(np.max(positions)), *sizes)
        self.speed = max(
            float(np.max(np.abs(result[f"{b.name}.{w}.{a}"])))
            * (1.0 if w == "velocity" else self.length)
            for b in scene.bodies
            for w in ("velocity", "angular_velocity")
            for a in AXES
        )
        first = self.mechanism(float(result.time[0]))
        quick = float(np.max(first.size[0::6] / np.diag(first.mass)[0::6], initial=0.0))
        self.speed = max(self.speed, 1e-3 * np.sqrt(quick * self.length), LEAST)

    def row(self, t: float) -> dict[str, float]:
        """All variables at a time."""
        now = self.result.at(np.array([t]))
        return {name: float(now[name][0]) for name in now}

    def mechanism(self, t: float, row: Mapping[str, float] | None = None) -> Mechanism:
        """The scene in the recorded state."""
        row = row or self.row(t)
        state = {}
        for b in self.scene.bodies:
            q = np.array([row[f"{b.name}.orientation[{k}]"] for k in range(1, 5)])
            state[b.name] = State(
                vector(row, f"{b.name}.position"),
                axes(q / np.linalg.norm(q)),
                vector(row, f"{b.name}.velocity"),
                vector(row, f"{b.name}.angular_velocity"),
            )
        return Mechanism(self.scene, self.values, state, t)

    def examine(self, rng: Random, count: int = 8) -> Findings:
        """Check the start, random instants, random intervals and the energy."""
        begin, end = float(self.result.time[0]), float(self.result.time[-1])
        self.start(begin)
        for t in [begin, *rng.uniform(begin, end, count), begin + (1 - 1e-9) * (end - begin)]:
            self.instant(float(t))
        for _ in range(3):
            span = min((end - begin) * 10 ** float(rng.uniform(-2, 0)), 0.5 * self.pace())
            a = float(rng.uniform(begin, end - span))
            if span > 0:
                self.interval(a, a + span)
        self.energy()
        return self.found

    def pace(self) -> float:
        """A time in which nothing turns by more than a radian."""
        spins = [
            float(np.max(np.abs(self.result[f"{b.name}.angular_velocity.{a}"])))
            for b in self.scene.bodies
            for a in AXES
        ]
        return 1.0 / max(*spins, 1e-9)

    def start(self, t: float) -> None:
        """The guesses of places and speeds, which hold together, are met."""
        row, given = self.row(t), start_of(self.scene, dict(self.values))
        for b in self.scene.bodies:
            s = given[b.name]
            room = STARTS * self.length
            error = np.max(np.abs(vector(row, f"{b.name}.position") - s.position))
            self.found.hold("start", float(error), room, t, f"{b.name}.position")
            now = self.mechanism(t, row).state[b.name]
            self.found.hold("start", float(np.max(np.abs(now.axes - s.axes))), STARTS, t, b.name)
            for name, v, unit in (
                ("velocity", s.velocity, 1.0),
                ("angular_velocity", s.spin, self.length),
            ):
                error = np.max(np.abs(vector(row, f"{b.name}.{name}") - v)) * unit
                self.found.hold("start", float(error), STARTS * self.speed, t, f"{b.name}.{name}")

    def instant(self, t: float) -> None:
        """Relations, their rates, Newton-Euler, and reactions that do no work."""
        row = self.row(t)
        if not all(np.isfinite(x) for x in row.values()):
            self.found.fault(f"not finite: a variable at t = {t!r}")
            return
        now = self.mechanism(t, row)
        quick = np.concatenate(
            [
                np.append(
                    vector(row, f"{b.name}.acceleration"),
                    vector(row, f"{b.name}.angular_acceleration"),
                )
                for b in self.scene.bodies
            ]
        )
        largest = float(np.max(np.abs(quick), initial=0.0)) + self.speed**2 / self.length
        room = SLACK * self.tol + 1e-11
        for c in self.scene.links:
            for r in now.rows[c.name]:
                unit = self.length if r.length else 1.0
                self.found.hold("relation", r.value, room * unit, t, c.name)
                rate = float(r.jacobian @ now.speed) - r.rate
                size = self.speed if r.length else self.speed / self.length
                self.found.hold("relation rate", rate, room * size, t, c.name)
                a = float(r.jacobian @ quick + r.bias)
                scale = np.max(np.abs(r.jacobian)) * largest + self.speed**2 / self.length
                self.found.hold("relation acceleration", a, EXACT * float(scale), t, c.name)
        self.momenta(now, row, quick, t)

    def momenta(self, now: Mechanism, row: Mapping[str, float], quick: Floats, t: float) -> None:
        """Newton-Euler of every body with the recorded reactions, each of which is ideal."""
        rest, size = now.load - now.mass @ quick, now.size + np.abs(now.mass @ quick)
        for c in self.scene.links:
            force, couple = vector(row, f"{c.name}.force"), vector(row, f"{c.name}.torque")
            at, push = now.touching(c), np.zeros(now.n)
            on_b = -1.0 if c.kind == "point_surface" else 1.0  # its text names the point first
            for body, sign in ((c.b.body, on_b), (c.a.body, -on_b)):
                if body is None:
                    continue
                k, arm = now.at[body.name], at - now.state[body.name].position
                push[k : k + 3] += sign * force
                push[k + 3 : k + 6] += sign * (couple + np.cross(arm, force))
                size[k : k + 3] += np.linalg.norm(force)
                size[k + 3 : k + 6] += np.linalg.norm(couple)
                size[k + 3 : k + 6] += np.linalg.norm(arm) * np.linalg.norm(force)
            rest += push
            rows = np.array([r.jacobian for r in now.rows[c.name]])
            z = np.linalg.lstsq(rows.T, push, rcond=1e-12)[0]
            left = float(np.max(np.abs(push - rows.T @ z), initial=0.0))
            whole = float(np.linalg.norm(force) * max(self.length, 1.0) + np.linalg.norm(couple))
            room = EXACT * whole + SLACK * self.tol * whole
            self.found.hold("ideal reaction", left, room + 1e-13 * float(np.max(size)), t, c.name)
        forces = float(np.max(size.reshape(-1, 6)[:, :3]))
        couples = max(float(np.max(size.reshape(-1, 6)[:, 3:])), forces * self.length)
        for b in self.scene.bodies:
            k = now.at[b.name]
            for name, part, room in (
                ("force", rest[k : k + 3], forces),
                ("couple", rest[k + 3 : k + 6], couples),
            ):
                error = float(np.max(np.abs(part)))
                self.found.hold("Newton-Euler", error, 0.1 * EXACT * room, t, f"{b.name} {name}")

    def interval(self, a: float, b: float) -> None:
        """Changes of places, orientations and speeds against integrals."""
        found = []
        for panels in (2, 8, 64):
            found = self._missed(a, b, panels)
            if all(e <= room for *_, e, room in found):
                break
        for name, error, room in found:
            self.found.hold("integral", error, room, a, f"{name} to {b!r}")

    def _missed(self, a: float, b: float, panels: int) -> list[tuple[str, float, float]]:
        places, ends = gauss_places(a, b, panels), np.array([a, b])
        now, edge = self.result.at(places), self.result.at(ends)
        weights = (b - a) / (2 * panels) * np.tile(WEIGHTS, panels)
        assert len(weights) == len(NODES) * panels
        room, found = SLACK * self.tol + 1e-12, []
        for body in self.scene.bodies:
            n = body.name
            quick = max(
                float(np.max(np.abs(now[f"{n}.{w}.{x}"]))) * u
                for w, u in (("acceleration", 1.0), ("angular_acceleration", self.length))
                for x in AXES
            )
            speeds = room * (self.speed + (b - a) * quick)
            for x in AXES:
                for of, rate, allowed in (
                    ("position", "velocity", room * self.length),
                    ("velocity", "acceleration", speeds),
                    ("angular_velocity", "angular_acceleration", speeds / self.length),
                ):
                    change = edge[f"{n}.{of}.{x}"][1] - edge[f"{n}.{of}.{x}"][0]
                    error = abs(float(change - weights @ now[f"{n}.{rate}.{x}"]))
                    found.append((f"{n}.{of}.{x}", error, allowed))
            q = np.array([now[f"{n}.orientation[{k}]"] for k in range(1, 5)])
            w = np.array([now[f"{n}.angular_velocity.{x}"] for x in AXES])
            rates = 0.5 * np.vstack(
                [-np.sum(w * q[1:], axis=0), w * q[0] + np.cross(w.T, q[1:].T).T]
            )
            for k in range(4):
                at = edge[f"{n}.orientation[{k + 1}]"]
                error = abs(float(at[1] - at[0] - weights @ rates[k]))
                if abs(at[1] - at[0]) < 0.5:  # a quaternion may change its sign
                    found.append((f"{n}.orientation[{k + 1}]", error, room))
        return found

    def energy(self) -> None:
        """The kinetic energy, and the balance where there is one."""
        t = float(self.result.time[-1]) * 0.7
        row = self.row(t)
        now = self.mechanism(t, row)
        if "energy.kinetic" not in row:
            return
        kinetic = float(now.speed @ now.mass @ now.speed) / 2
        largest = float(np.max(self.result["energy.kinetic"]))
        self.found.hold(
            "kinetic energy", kinetic - row["energy.kinetic"], 1e-10 * largest, t, "all"
        )
        if any(c.drive for c in self.scene.links):
            return  # the work of drives is not counted
        words = ("kinetic", "potential", "dissipated", "work")
        parts = [self.result[f"energy.{x}"] for x in words]
        total = parts[0] + parts[1] + parts[2] - parts[3]
        scale = sum(float(np.max(np.abs(p))) for p in parts)
        scale += float(np.max(np.diag(now.mass))) * LEAST**2
        room = (1e4 * self.tol + 1e-10) * scale
        self.found.hold("energy balance", float(np.ptp(total)), room, t, "all")

    def singular(self, t: float) -> bool:
        """Whether some relation nearly follows from others in a posture."""
        now = self.mechanism(t)
        first = self.mechanism(float(self.result.time[0]))
        return rank(now.matrix())[1] < SINGULAR or rank(now.matrix())[0] != rank(first.matrix())[0]
