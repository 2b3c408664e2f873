"""What must hold at an instant of a result: relations, outputs, laws, Newton-Euler, no jumps."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from judge.mechanics import Joint, Mechanics, Row
from judge.readings import Loads
from judge.rests import rest
from judge.scene import Contact, Pin
from judge.seen import EXACT, OPEN, SLACK, SLIP, STICK, Seen

ARMS = 1e-14


def instant(seen: Seen, t: float) -> None:
    """Everything that must hold at one instant."""
    row = seen.row(t)
    if not all(math.isfinite(x) for x in row.values()):
        seen.found.fault(f"not finite: a variable at t = {t!r}")
        return
    now = seen.mechanics_of(row, t)
    loads = Loads(now, row)
    for joint in now.joints.values():
        relation(seen, now, joint, row, loads, t)
        outputs(seen, now, joint, row, t)
        law(seen, now, joint, row, loads, t)
    residual(seen, loads, t)
    rest(seen, now, row, t)


def relation(
    seen: Seen, now: Mechanics, joint: Joint, row: Mapping[str, float], loads: Loads, t: float
) -> None:
    """Positions, velocities and accelerations of what is closed."""
    name, allowed = joint.liaison.name, SLACK * seen.tol + 1e-11
    pin = isinstance(joint.liaison, Pin)
    closed = pin or row.get(f"{name}.mode", SLIP if seen.kept(joint) else OPEN) != OPEN
    size = max(seen.length, joint.size)
    if not closed:
        seen.found.hold("inside", min(joint.gap, 0.0), allowed * size, t, name)
        return
    seen.found.hold("relation", joint.gap, allowed * size, t, name)
    for word in ("x", "y") if pin else ("n",):
        r = joint.rows[word]
        # a rate is known to the rounding of its position too: size * largest angular velocity
        seen.found.hold("relation rate", r.rate, allowed * seen.usual(r), t, name)
        held_acceleration(seen, "relation acceleration", loads, r, t, name)


def held_acceleration(seen: Seen, what: str, loads: Loads, row: Row, t: float, name: str) -> None:
    """A relative acceleration that must be zero."""
    value = row.jacobian @ loads.acceleration + row.bias
    size = row.reach @ loads.acceleration_size + row.bias_size
    seen.found.hold(what, float(value), EXACT * float(size), t, name)


def outputs(seen: Seen, now: Mechanics, joint: Joint, row: Mapping[str, float], t: float) -> None:
    """Variables of a liaison against what the bodies say."""
    c = joint.liaison
    if isinstance(c, Pin):
        if f"{c.name}.speed" in row:
            r = joint.rows["c"]
            seen.found.hold(
                "output", row[f"{c.name}.speed"] - r.rate, 1e-12 * seen.spins(), t, c.name
            )
        return
    if f"{c.name}.normal_force" in row and f"{c.name}.force.x" in row:
        n, t_ = row[f"{c.name}.normal_force"], row[f"{c.name}.tangential_force"]
        sign = 1.0 if c.swapped else -1.0
        for axis, x in zip("xy", sign * (n * joint.normal + t_ * joint.direction), strict=True):
            room = 1e-11 * (abs(n) + abs(t_))
            seen.found.hold("force", row[f"{c.name}.force.{axis}"] - x, room, t, c.name)
    size = max(seen.length, joint.size)
    allowed = 1e-11 * size + (SLACK * seen.tol * size if seen.kept(joint) else 0.0)
    if f"{c.name}.gap" in row:
        seen.found.hold("output", row[f"{c.name}.gap"] - joint.gap, allowed, t, f"{c.name}.gap")
    if f"{c.name}.slip" in row:
        r = joint.rows["t"]
        given = row[f"{c.name}.slip"]
        wide = max(seen.usual(r), r.rate_size)
        # the judge's touching point follows a gap that is zero to the tolerance
        room = (1e-11 + SLACK * seen.tol) * wide
        seen.found.hold("output", given - r.rate, room, t, f"{c.name}.slip")


def law(
    seen: Seen, now: Mechanics, joint: Joint, row: Mapping[str, float], loads: Loads, t: float
) -> None:
    """Laws of one liaison."""
    name, c = joint.liaison.name, joint.liaison
    if f"{name}.mode" not in row:
        return
    mode = int(row[f"{name}.mode"])
    z = loads.reactions.get(name)
    if z is None:
        return
    unilateral = isinstance(c, Contact) and not c.bilateral
    load = loads.scale(joint)
    if mode == OPEN:
        for word, x in z.items():
            seen.found.hold("open reaction", x, 0.0, t, f"{name} {word}")
        return
    if unilateral:
        allowed = (SLACK * seen.tol + 1e-9) * load
        seen.found.hold("pull", min(z["n"], 0.0), allowed, t, name)
    normal = math.hypot(z["x"], z["y"]) if isinstance(c, Pin) else abs(z["n"])
    word = "c" if isinstance(c, Pin) else "t"
    if c.mu is not None:
        arm = 1.0 if isinstance(c, Contact) else (c.radius.at(now.look) if c.radius else 1.0)
        friction(
            seen, joint, row, loads, t, word, normal=normal, mode=mode, load=load, least=1e-3 * arm
        )
    elif word in z:
        seen.found.hold("no friction", z[word], 0.0, t, name)
    if isinstance(c, Contact) and c.delta is not None:
        rolling(seen, joint, loads, t, normal, load)


def friction(
    seen: Seen,
    joint: Joint,
    row: Mapping[str, float],
    loads: Loads,
    t: float,
    word: str,
    *,
    normal: float,
    mode: int,
    load: float,
    least: float,
) -> None:
    """Coulomb: rest within the bound, exactly the bound in motion, against the slip.

    A pin's coefficient has its radius in it; where it is below `least` rounding is that of
    `least`.
    """
    name, r = joint.liaison.name, joint.rows[word]
    force = loads.reactions[name][word]
    largest = max(joint.mu_s, joint.mu)
    small = (SLACK * seen.tol + 1e-9) * largest * load + 1e-11 * max(largest, least) * load
    if "x" in joint.rows:  # a couple of a pin is known as forces with their arms are
        small += ARMS * float(np.max(joint.rows["x"].reach[2::3])) * load
    slip = row.get(f"{name}.slip", r.rate)
    if mode == STICK:
        seen.found.hold("held slip", slip, 0.0, t, name)
        seen.found.hold("cone", max(0.0, abs(force) - joint.mu_s * normal), small, t, name)
        held_acceleration(seen, "held acceleration", loads, r, t, name)
        return
    rounding = EXACT * (joint.mu * normal + abs(force)) + 1e-11 * max(joint.mu, least) * load
    seen.found.hold("law", abs(force) - joint.mu * normal, rounding, t, name)
    way = slip
    if slip == 0:  # leaves rest now
        way = float(r.jacobian @ loads.acceleration + r.bias)
        size = r.reach @ loads.acceleration_size + r.bias_size
        if abs(way) <= 1e-7 * size:
            return
    wide = seen.usual(r)
    if way * force > 0 and abs(force) > small and not 0 < abs(slip) <= SLACK * seen.tol * wide:
        seen.found.fault(
            f"drives: friction of {name} at t = {t!r} pushes along the slip {slip:.3g}"
        )


def rolling(seen: Seen, joint: Joint, loads: Loads, t: float, normal: float, load: float) -> None:
    """Resistance to rolling: at most delta N, and exactly that in motion."""
    name, r = joint.liaison.name, joint.rows["r"]
    couple, bound = loads.reactions[name]["r"], joint.delta * normal
    small = (SLACK * seen.tol + 1e-9) * joint.delta * load
    seen.found.hold("rolling bound", max(0.0, abs(couple) - bound), small, t, name)
    if r.rate == 0:
        return
    if abs(r.rate) > 10 * SLACK * seen.tol * seen.spins():
        seen.found.hold(
            "rolling law",
            abs(couple) - bound,
            EXACT * bound + 1e-11 * joint.delta * load,
            t,
            name,
        )
        if r.rate * couple > 0 and abs(couple) > small:
            seen.found.fault(f"drives: rolling resistance of {name} at t = {t!r}")


def residual(seen: Seen, loads: Loads, t: float) -> None:
    """Newton-Euler of every body; reactions that are not told are chosen as they fit best."""
    rest, size, now = loads.rest, loads.size, loads.now
    scaled = rest / np.where(size > 0, size, 1)
    if loads.untold:
        columns = np.array(loads.untold).T / np.where(size > 0, size, 1)[:, None]
        lengths = np.linalg.norm(columns, axis=0)
        columns = columns / np.where(lengths > 0, lengths, 1)
        scaled = scaled - columns @ np.linalg.lstsq(columns, scaled, rcond=1e-13)[0]
    for b in seen.scene.bodies:
        k = now.at[b.name]
        for i, word in enumerate("xyz" if b.turns else "xy"):
            seen.found.hold("Newton-Euler", float(scaled[k + i]), EXACT, t, f"{b.name} {word}")


def jump(seen: Seen, t: float) -> None:
    """Positions and velocities are continuous: there are no impacts."""
    before, after = seen.row(seen.just_before(t)), seen.row(t)
    for b in seen.scene.bodies:
        for axis in "xy":
            for what, size in (("position", seen.length), ("velocity", seen.speed[b.name])):
                name = f"{b.name}.{what}.{axis}"
                allowed = (10 * seen.tol + 1e-12) * size
                seen.found.hold(f"jump of {what}", after[name] - before[name], allowed, t, name)
        if b.turns:
            name = f"{b.name}.angular_velocity"
            allowed = (10 * seen.tol + 1e-12) * seen.speed[f"{b.name}.w"]
            seen.found.hold("jump of velocity", after[name] - before[name], allowed, t, name)
