"""What a result tells at an instant, in the judge's own terms: state, sides, loads, reactions."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from judge.mechanics import Floats, Joint, Mechanics
from judge.motions import parts
from judge.scene import Contact, Pin, Scene

FORMED = 1e-4
PLACED = 1e-6  # an arm is the difference of places, and known to 1e-14 of them: see `check.EXACT`
# An acceleration is a sum along what joins bodies, and of what their turning brings to it: it is
# known to 1e-15 of the largest there.
CARRIED = 1e-7
NOTHING = 1e-30  # part of the largest force of a scene below which one is none


class Loads:
    """Accelerations and reactions a result tells at an instant, and what they leave over."""

    def __init__(self, now: Mechanics, row: Mapping[str, float]) -> None:
        self.now = now
        acceleration = []
        for b in now.scene.bodies:
            turn = row[f"{b.name}.angular_acceleration"] if b.turns else 0.0
            acceleration += [row[f"{b.name}.acceleration.{axis}"] for axis in "xy"] + [turn]
        self.acceleration = np.array(acceleration)
        self.reactions: dict[str, dict[str, float]] = {}
        self.untold: list[Floats] = []
        rest = now.load - now.mass * self.acceleration
        size = now.load_size + now.mass * np.abs(self.acceleration)
        for name, joint in now.joints.items():
            told = told_reactions(joint, row)
            if told is None:
                closed = not isinstance(joint.liaison, Contact) or joint.liaison.bilateral
                closed = closed or abs(joint.gap) <= 1e-6 * joint.size
                words = ("x", "y") if isinstance(joint.liaison, Pin) else ("n",)
                if closed:
                    self.untold += [joint.rows[w].jacobian for w in words]
                continue
            self.reactions[name] = told
            for word, z in told.items():
                push = joint.rows[word].jacobian * z
                rest += push
                size += joint.rows[word].reach * abs(z)
        # forces of a body are known as its largest one is, moments as that with the longest arm
        arms = np.zeros(now.n)
        for joint in now.joints.values():
            for r in joint.rows.values():
                arms[2::3] = np.maximum(arms[2::3], r.reach[2::3] * (r.reach[::3] > 0))
        for b in now.scene.bodies:
            k = now.at[b.name]
            arms[k + 2] = max(arms[k + 2], PLACED * float(np.linalg.norm(now.origin(b))))
            size[k : k + 2] = np.max(size[k : k + 2])
            size[k + 2] = max(size[k + 2], size[k] * arms[k + 2])
        for places, joints in parts(now):
            rows = (r for j in joints for word, r in j.rows.items() if word != "r")
            turning = max((r.bias_size for r in rows), default=0.0)
            for joined, carried in ((places[:, :2], turning), (places[:, 2], 0.0)):
                quickest = np.max(np.abs(self.acceleration[joined]), initial=carried)
                size[joined] = np.maximum(size[joined], CARRIED * now.mass[joined] * quickest)
            longest = np.max(arms[places[:, 2]], initial=0.0)  # couples act on others as forces
            if longest > 0:
                couple = np.max(size[places[:, 2]], initial=0.0)
                size[places[:, :2]] = np.maximum(size[places[:, :2]], CARRIED * couple / longest)
        size = np.maximum(size, NOTHING * np.max(size, initial=0.0))
        self.rest, self.size = rest, size + self._formed(size)
        self.acceleration_size = self._acceleration_size()

    def _formed(self, size: Floats) -> Floats:
        """A reaction that happens to be small is the difference of what forms it.

        That is the effective mass of its row times the accelerations; `FORMED` of it counts.
        """
        now, quick, more = self.now, size / self.now.mass, np.zeros(self.now.n)
        for name, told in self.reactions.items():
            for word in told:
                r = now.joints[name].rows[word]
                response = float(np.sum(r.jacobian**2 / now.mass))
                if response > 0:
                    more += r.reach * FORMED * (r.reach @ quick + r.bias_size) / response
        return more

    def _acceleration_size(self) -> Floats:
        """Accelerations of a body are as exact as the terms they come from."""
        return np.maximum(np.abs(self.acceleration), self.size / self.now.mass)

    def scale(self, joint: Joint) -> float:
        """The largest force at the bodies of a joint."""
        touched = np.abs(joint.rows["n" if "n" in joint.rows else "x"].jacobian) > 0
        if "y" in joint.rows:
            touched |= np.abs(joint.rows["y"].jacobian) > 0
        touched[2::3] = False
        return float(np.max(self.size[touched], initial=0.0))


def told_reactions(joint: Joint, row: Mapping[str, float]) -> dict[str, float] | None:
    """Reactions by row, as forces on the body of a contact and on b of a pin."""
    c = joint.liaison
    if f"{c.name}.force.x" not in row or f"{c.name}.normal_force" not in row:
        return None
    if isinstance(c, Pin):
        x, y = row[f"{c.name}.force.x"], row[f"{c.name}.force.y"]
        return {"x": x, "y": y, "c": row.get(f"{c.name}.torque", 0.0)}
    z = {"n": row[f"{c.name}.normal_force"], "t": row[f"{c.name}.tangential_force"]}
    if c.delta is not None:
        z["r"] = (1.0 if c.swapped else -1.0) * row.get(f"{c.name}.torque", 0.0)
    return z


def state_of(scene: Scene, row: Mapping[str, float]) -> dict[str, tuple[float, ...]]:
    state = {}
    for b in scene.bodies:
        x, y = (row[f"{b.name}.position.{a}"] for a in "xy")
        vx, vy = (row[f"{b.name}.velocity.{a}"] for a in "xy")
        turn = (
            (row[f"{b.name}.angle"], row[f"{b.name}.angular_velocity"]) if b.turns else (0.0, 0.0)
        )
        state[b.name] = (x, y, turn[0], vx, vy, turn[1])
    return state
