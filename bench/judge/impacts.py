"""Impacts: what changes speeds at an instant is impulses of contacts within their cones."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.optimize import nnls

from judge.mechanics import Mechanics
from judge.scene import Contact
from judge.seen import Floats, Seen

# Part of the momenta by which impulses may miss them, and of an energy by which it may grow.
MISSED = 1e-6
# Impacts that are examined.
LOOKS = 6


def impact_times(events: Sequence[object]) -> list[float]:
    """When bodies meet, in order."""
    return sorted({e.time for e in events if str(e.kind).endswith("impact")})  # type: ignore[attr-defined]


def judge_impacts(seen: Seen, begin: float) -> None:
    """The first impacts of a run, but for those at its start, whose speeds before are not told."""
    for t in [t for t in impact_times(seen.result.events) if t > begin][:LOOKS]:
        _judge(seen, t)


def _judge(seen: Seen, t: float) -> None:
    before = seen.mechanics_of(seen.row(seen.just_before(t)), t)
    after = seen.mechanics_of(seen.row(t), t)
    change = before.mass * (after.speed - before.speed)
    columns = _impulses(seen, before)
    weight = 1 / np.sqrt(before.mass)
    scaled = columns * weight[:, None]
    lengths = np.linalg.norm(scaled, axis=0)
    wanted = change * weight
    size = float(np.linalg.norm(before.speed / weight) + np.linalg.norm(after.speed / weight))
    _, missed = nnls(scaled / np.where(lengths > 0, lengths, 1), wanted)
    seen.found.hold("impulses", missed, MISSED * size, t, "")
    energy = [float(m.speed @ (m.mass * m.speed)) / 2 for m in (before, after)]
    seen.found.hold("energy", max(energy[1] - energy[0], 0), MISSED * energy[0], t, "")
    for name, joint in after.joints.items():
        c = joint.liaison
        if isinstance(c, Contact) and not c.bilateral and abs(joint.gap) < 1e-9 * seen.length:
            rate = joint.rows["n"].rate
            allowed = MISSED * max(
                seen.usual(joint.rows["n"]), abs(before.joints[name].rows["n"].rate)
            )
            seen.found.hold("approach after", min(rate, 0.0), allowed, t, name)


def _impulses(seen: Seen, now: Mechanics) -> Floats:
    """Columns of momenta that the impulses of contacts, pins and bearings can bring."""
    found: list[Floats] = []
    for joint in now.joints.values():
        c = joint.liaison
        if not isinstance(c, Contact):
            found += [sign * r.jacobian for r in joint.rows.values() for sign in (1, -1)]
            continue
        if not c.bilateral and abs(joint.gap) > 1e-7 * max(seen.length, joint.size):
            continue
        mu = max(joint.mu, joint.mu_s)
        none = 0 * joint.rows["n"].jacobian
        along, about = (joint.rows[k].jacobian if k in joint.rows else none for k in "tr")
        for side in (1, -1) if c.bilateral else (1,):
            normal = side * joint.rows["n"].jacobian
            found += [
                normal + way * mu * along + turn * joint.delta * about
                for way in (1, -1)
                for turn in (1, -1)
            ]
    return np.array(found).T if found else np.zeros((len(now.speed), 1))
