"""Speeds at the start into contacts that are closed: guessed ones are corrected, stated refused.

Of all speeds that enter no closed contact, a start takes those that differ from the guesses by the
least kinetic energy; speeds that enter none are taken as they are.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from judge.impacts import impact_times
from judge.mechanics import Floats
from judge.scene import Contact, Scene
from judge.seen import Seen
from judge.verdict import REFUTED, Start, Verdict

INTO = 1e-9
NEAREST, ROUNDING = 1e-9, 1e-5


class Speeds:
    """Guesses or statements of all speeds at the places that a setting states."""

    def __init__(self, scene: Scene, values: Mapping[str, float], span: float) -> None:
        self.seen = Seen(scene, values, Start(scene, values, span), 1e-9)
        self.now = self.seen.mechanics(0.0)
        kept, parting, self.sizes = [], [], []
        for joint in self.now.joints.values():
            c = joint.liaison
            free = isinstance(c, Contact) and not c.bilateral
            for word in ("n",) if isinstance(c, Contact) else ("x", "y"):
                row = joint.rows[word]
                (parting if free else kept).append(row.jacobian)
                if free:
                    self.sizes.append(self.seen.usual(row))
        n = self.now.n
        self.kept, self.parting = np.array(kept).reshape(-1, n), np.array(parting).reshape(-1, n)

    def enters(self) -> float:
        """The largest speed into a contact, in parts of the speeds there."""
        rates = self.parting @ self.now.speed / np.array(self.sizes)
        return float(max(0.0, -np.min(rates, initial=0.0)))

    def corrected(self) -> Floats:
        """The nearest speeds that keep what is kept and enter nothing."""
        from scipy.optimize import nnls

        root = np.sqrt(self.now.mass)
        wanted = self.now.speed * root
        kept = self.kept / root
        basis = (
            np.linalg.svd(kept)[2][int(np.linalg.matrix_rank(kept)) :]
            if len(kept)
            else np.eye(len(root))
        )
        inside = basis @ wanted
        rows = (self.parting / root) @ basis.T
        lengths = np.maximum(np.linalg.norm(rows, axis=1), 1e-300)
        pushes, _ = nnls((rows / lengths[:, None]).T, -inside)
        return (inside + (rows / lengths[:, None]).T @ pushes) @ basis / root


def judge_speeds(
    scene: Scene, setting_values: Mapping[str, float], span: float, how: str, seen: Seen | None
) -> list[str]:
    """Faults of a start whose speeds are `how`: guessed or stated; `seen` is the run."""
    speeds = Speeds(scene, setting_values, span)
    entering = speeds.enters()
    if seen is None:
        return []
    begin = float(seen.result.time[0])
    if how == "stated" and entering > INTO:
        if impact_times(seen.result.events)[:1] == [begin]:
            return []
        return [f"entered: a stated speed into a closed contact by {entering:.2g} made no impact"]
    start = seen.mechanics(float(seen.result.time[0]))
    faults = []
    for name, joint in start.joints.items():
        c = joint.liaison
        if isinstance(c, Contact) and not c.bilateral:
            rate = joint.rows["n"].rate
            if rate < -1e-11 * seen.usual(joint.rows["n"]):
                faults.append(f"start speed: into {name} by {rate:.3g}")
    if entering > INTO and len(speeds.kept):
        return faults  # which way guesses are missed is measured by more than the masses
    wanted = speeds.corrected()
    size = np.abs(wanted) + np.abs(speeds.now.speed)
    for column in (size[2::3], size.reshape(-1, 3)[:, :2]):
        column += ROUNDING * np.max(column, initial=0.0)  # what a body takes from those beside it
    for b in scene.bodies:
        k = start.at[b.name]
        largest = float(np.max(size[k : k + 2]))
        for i, word in enumerate(("velocity.x", "velocity.y", "angular_velocity")):
            if i == 2 and not b.turns:
                continue
            wide = b.size.at(start.look) if b.size is not None else np.inf
            room = NEAREST * (largest if i < 2 else size[k + 2] + largest / wide)
            if abs(start.speed[k + i] - wanted[k + i]) > room:
                faults.append(
                    f"start speed: {b.name}.{word} is {start.speed[k + i]:.12g}, nearest to the "
                    f"guesses {wanted[k + i]:.12g}"
                )
    return faults[:4]


def judge_refusal(
    scene: Scene, setting_values: Mapping[str, float], span: float, how: str, text: str
) -> Verdict | None:
    """A start that is refused: wrongly where a stated speed enters a contact, an impact."""
    if how != "stated":
        return None
    if Speeds(scene, setting_values, span).enters() > INTO:
        return Verdict(REFUTED, [f"a stated speed enters a contact: {text}"])
    return None
