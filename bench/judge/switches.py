"""What must hold where a liaison changes between sticking and slipping, at that instant exactly.

Reactions follow from the state alone, so that an event is known to rounding however large the
tolerance of the run: before it the old modes are admissible, after it they are not.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

from judge.following import lasts, still_of
from judge.mechanics import Joint, Mechanics
from judge.motions import CLEAR, Choice, Still, choices, count, motion
from judge.readings import Loads
from judge.scene import Contact, Pin
from judge.seen import OPEN, SLIP, STICK, Seen

MODES = {"open": OPEN, "stick": STICK, "slip": SLIP}
# Part of its size by which friction may exceed its bound just before rest ends, and of the largest
# slip of the run that may be left just before rest begins.
LOCATED = 1e-7
STOPPED = 1e-8
MOST = 200


def switch(seen: Seen, t: float, clear: float) -> None:
    """Check all changes of mode at one instant after the start.

    `clear` is that instant, or one beside it where a condition switches at it.
    """
    here = [e for e in seen.result.events if e.time == t and e.after in MODES]
    if not here:
        return
    earlier = seen.just_before(t)
    if any(earlier <= e.time < t for e in seen.result.events):
        return  # two events in one instant but for rounding
    before, after = seen.row(earlier), seen.row(t)
    _recorded(seen, before, after, t)
    names = {e.liaison for e in here}
    left = [n for n in names if _mode(before, n) == STICK and _mode(after, n) == SLIP]
    held = [n for n in names if _mode(before, n) == SLIP and _mode(after, n) == STICK]
    then = seen.mechanics_of(before, earlier)
    if clear == t:
        loads = Loads(then, before)
        for name in left:
            _bound_reached(seen, then.joints[name], loads, t)
    for name in held:
        _slip_gone(seen, then.joints[name], t)
    if left and clear >= t:
        _rest_excluded(seen, before, left, clear)


def _mode(row: Mapping[str, float], name: str) -> int:
    return int(row.get(f"{name}.mode", -1))


def _recorded(
    seen: Seen, before: Mapping[str, float], after: Mapping[str, float], t: float
) -> None:
    """The modes of the record change where its events say, from and to what they say."""
    for name in {e.liaison for e in seen.result.events if e.time == t}:
        if f"{name}.mode" not in after:
            continue
        changes = [
            e
            for e in seen.result.events
            if e.time == t and e.liaison == name and e.after in MODES and e.before in MODES
        ]
        if not changes:
            continue
        told = MODES[changes[0].before], MODES[changes[-1].after]
        recorded = _mode(before, name), _mode(after, name)
        if told != recorded:
            seen.found.fault(f"event: {name} at t = {t!r} says {told}, its modes {recorded}")


def _bound_reached(seen: Seen, joint: Joint, loads: Loads, t: float) -> None:
    """Friction is within its bound until rest ends."""
    z = loads.reactions.get(joint.liaison.name)
    if z is None:
        return
    pin = isinstance(joint.liaison, Pin)
    normal = math.hypot(z["x"], z["y"]) if pin else abs(z["n"])
    excess = max(0.0, abs(z["c" if pin else "t"]) - joint.mu_s * normal)
    allowed = LOCATED * max(joint.mu_s, 1e-3) * loads.scale(joint)
    seen.found.hold("late departure", excess, allowed, t, joint.liaison.name)


def _slip_gone(seen: Seen, joint: Joint, t: float) -> None:
    """No slip is left when rest begins."""
    row = joint.rows["c" if isinstance(joint.liaison, Pin) else "t"]
    allowed = (STOPPED + seen.tol) * seen.usual(row)
    seen.found.hold("slip at rest's begin", row.rate, allowed, t, joint.liaison.name)


def _rest_excluded(seen: Seen, before: Mapping[str, float], left: list[str], t: float) -> None:
    """The modes before the event are not admissible just after it."""
    row = seen.row(t)
    now = seen.mechanics_of(row, t)
    still = still_of(seen, now, 1e-9)
    for name in left:
        still[name] = replace(still[name], touching=True, slip=0)
    if count(now, still) > 10 * MOST:
        return
    span = float(seen.result.time[-1] - seen.result.time[0])
    for modes in itertools.islice(_old(now, still, before), MOST):
        found = motion(now, modes, still)
        if found is None or found.margin <= -CLEAR:
            continue
        if found.margin > CLEAR or lasts(seen, now, found, still, t, span):
            many = "" if found.sign else ", reactions are not unique"
            seen.found.fault(
                f"rest ended early: {', '.join(left)} at t = {t!r}, "
                f"margin of rest {found.margin:.2g}{many}"
            )
            return


def _old(
    now: Mechanics, still: Mapping[str, Still], before: Mapping[str, float]
) -> Iterator[dict[str, Choice]]:
    """The combinations in which every liaison is as it was."""
    names, kept = list(now.joints), []
    for name in names:
        joint, mode = now.joints[name], _mode(before, name)
        some = choices(joint, still[name])
        if isinstance(joint.liaison, Contact) and mode != -1:
            some = [c for c in some if c.closed == (mode != OPEN)]
        if joint.liaison.mu is not None and joint.mu_s > 0 and mode in (STICK, SLIP):
            some = [c for c in some if (c.slip == 0) == (mode == STICK)]
        kept.append(some)
    for modes in itertools.product(*kept):
        yield dict(zip(names, modes, strict=True))
