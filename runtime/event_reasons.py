"""Why an event happens, in words with numbers: a row for each kind of event."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from types import MappingProxyType

from frot.runtime.event_values import ROUNDING, Instant, LawValues

# Motions by the kinds of laws.
MOTIONS = {
    "slide": "slip",
    "roll": "rolling",
    "pivot": "pivoting",
    "turn": "turning",
    "slip": "slip",
}
# Names of variables in a condition of the text.
_NAMES = re.compile(r"[^\W\d]\w*(?:\[\d+\])?(?:\.[^\W\d]\w*(?:\[\d+\])?)*")


def reason_of(instant: Instant) -> str:
    """Why the event of the instant happens."""
    return REASONS[instant.event.kind](instant)


def motion_of(at: Instant) -> str:
    """What the law of the event opposes."""
    found = next((x for x in at.laws if x is not None), None)
    return "slip" if found is None else MOTIONS[found.kind]


def _jumps(at: Instant, law: LawValues) -> bool:
    """Whether the motion is not zero at the instant."""
    return law.slip.size > ROUNDING * max(at.largest("slip"), law.slip.size if at.is_struck else 0)


def _cause(at: Instant) -> str:
    """What makes a speed jump: an impact of any liaison, the text, else what no event tells."""
    if at.is_struck:
        return "the impact"
    told = any(x.kind == "condition" for x in at.others)
    return "the text" if told else "a jump of the speeds"


def _noun(law: LawValues) -> str:
    """What opposes the motion."""
    return "couple" if law.friction.unit == "N.m" else "friction"


def _stops(at: Instant) -> str:
    before, after = at.laws
    motion = motion_of(at)
    if before is not None and _jumps(at, before):
        words = f"{_cause(at)} ends the {motion} of {before.slip.show()}"
    else:
        words = f"the {motion} reaches zero"
    if after is None:
        return words
    needed, limit = after.friction.show(after.limit_s.size), after.rest
    return (
        f"{words}; the {_noun(after)} needed then, {needed}, is within "
        f"{limit.words} = {limit.show()}"
    )


def _starts(at: Instant) -> str:
    before, after = at.laws
    motion = motion_of(at)
    if at.is_struck and after is not None and _jumps(at, after):
        return f"{_cause(at)} leaves a {motion} of {after.slip.show()}"
    if before is None:
        return f"rest is not admissible: the {motion} begins"
    limit = before.rest
    needed = before.friction.show(before.limit_s.size)
    if before.friction.size >= (1 - ROUNDING) * limit.size:
        words = f"the {_noun(before)} needed, {needed}, reaches {limit.words} = {limit.show()}"
        if after is not None and after.limit.size < (1 - ROUNDING) * limit.size:
            words += f"; in motion it is {after.limit.words} = {after.limit.show()}"
        return words
    cause, bound = at.beside(), before.rest if after is None else after.rest
    words = f"with the change of {cause}" if cause else "the loads change:"
    return (
        f"{words} more than {bound.words} = {bound.show()} is needed "
        f"({needed} of {limit.show()} before)"
    )


def _reverses(at: Instant) -> str:
    before, after = at.laws
    motion = motion_of(at)
    if at.is_struck and before is not None and after is not None:
        turn = f"from {before.slip.signed} to {after.slip.signed}"
        return f"the impact reverses the {motion}, {turn}"
    known = after or before
    if known is None:
        return f"the {motion} reaches zero and friction does not hold: it reverses"
    limit = known.rest
    return (
        f"the {motion} reaches zero, and to hold it more than {limit.words} = {limit.show()} "
        "is needed: it reverses"
    )


def _parts(at: Instant) -> str:
    before, after = at.contacts
    if at.is_struck and after is not None:
        return f"after the impact the gap opens at {after.speed.show()}"
    if before is None:
        return "at the start no reaction can keep it closed"
    if before.reaction.size <= ROUNDING * at.largest("reaction"):
        return "the normal reaction reaches zero"
    head, size = at.event.liaison.partition("[")[0], before.reaction.show()
    for one in at.others:
        if one.kind == "contact" and one.liaison.partition("[")[0] == head:
            return f"the contact passes to '{one.liaison}', with a normal reaction of {size}"
    cause = at.beside()
    if cause:
        words = f"with the change of {cause} the normal reaction would be negative"
        return f"{words} ({size} before)"
    return (
        f"the normal reaction, {size} before, has no place any more: the figure ends, "
        "or the loads change"
    )


def _closes(at: Instant) -> str:
    before, after = at.contacts
    bears = "" if after is None else f"; the normal reaction is {after.reaction.show()}"
    if at.ended:
        return f"its infinitely many impacts have ended{bears}"
    if any(x.liaison == at.event.liaison and x.kind.endswith("impact") for x in at.others):
        return f"the impact leaves the gap closed{bears}"
    if before is None:
        return f"the gap is closed at the start{bears}"
    return f"the gap closes without speed{bears}"


def _strikes(at: Instant) -> str:
    before, after = at.contacts
    if before is None:
        return "the gap is closed at the start, with a speed of approach"
    if at.event.before == "open" or before.speed.size > ROUNDING * at.largest("speed"):
        words = f"the gap closes at {before.speed.show()}: impact"
    else:
        cause = at.beside()
        words = "it is closed, and " + (
            f"the impact of {cause} presses it" if cause else "its speed jumps"
        )
    if after is None:
        return words
    opens = after.speed.size > ROUNDING * before.speed.size and at.event.after == "open"
    return f"{words}; {f'it opens at {after.speed.show()}' if opens else 'it stays closed'}"


def _strikes_last(at: Instant) -> str:
    until = at.event.time if at.event.until is None else at.event.until
    words = "it is the last that is followed of infinitely many, which end at t ="
    return f"{_strikes(at)}; {words} {until:.12g} s"


def _jams(at: Instant) -> str:
    before, after = at.laws
    words = "no motion with finite reactions is admissible: friction presses the contact"
    if at.on_indeterminate == "impact":
        words = "whether or not other motions are admissible, friction presses the contact"
    if before is None or after is None:
        return f"{words} by {at.event.impulse:.6g} N.s, without collision"
    turn = f"from {before.slip.show()} to {after.slip.show(before.slip.size)}"
    return f"{words}, without collision, and takes its slip {turn}"


def _changes_sides(at: Instant) -> str:
    before, after = at.contacts
    if before is None or after is None:
        return "the normal reaction passes zero"
    if before.reaction.size > ROUNDING * at.largest("reaction"):
        turn = f"from {before.reaction.signed} to {after.reaction.signed}"
        return f"the normal reaction jumps {turn}"
    return "the normal reaction passes through zero and changes sign"


def _condition(at: Instant) -> str:
    text = at.event.liaison
    # of a condition of a component its name stands before it
    head = text.partition(": ")[0] + "." if ": " in text else ""
    names = {x: next((y for y in (x, head + x) if y in at.variables), "") for x in _names(text)}
    values = [f"{x} = {at.variables[y].show_number()}" for x, y in names.items() if y]
    known = f" ({', '.join(values)})" if values else ""
    return f"the condition `{text}` becomes {at.event.after}{known}"


def _names(text: str) -> list[str]:
    return list(dict.fromkeys(_NAMES.findall(text)))


def _several(at: Instant) -> str:
    count = re.search(r"(?:at least )?\d+ motions", at.event.text)
    words = count.group() if count else "several motions"
    return (
        f"{words} satisfy all laws at this instant; "
        f"on_indeterminate = {at.on_indeterminate} takes {at.event.after}"
    )


def _said(what: str) -> Callable[[Instant], str]:
    def words(at: Instant) -> str:
        text = at.event.text.rpartition(" at t = ")[0]
        return f"{what}: {text.removeprefix('warning: ').removeprefix('terminate: ')}"

    return words


def _blow(at: Instant) -> str:
    """The impulse of the text, and the work with that of others at its instant."""
    event = at.event
    vector = ", ".join(f"{x:.6g}" for x in event.vector)
    words = f"an impulse of the text acts, '{event.liaison}' of ({vector}) N.s"
    together = [x for x in at.others if x.kind == "percussion"]
    if not event.energy_lost and together:
        return words
    their = "; all of the instant do" if together else "; it does"
    return f"{words}{their} the work {-event.energy_lost:.6g} J"


REASONS: Mapping[str, Callable[[Instant], str]] = MappingProxyType(
    {
        "stick": _stops,
        "slip": _starts,
        "reversal": _reverses,
        "separation": _parts,
        "contact": _closes,
        "roll_stop": _stops,
        "roll_start": _starts,
        "roll_reversal": _reverses,
        "reaction": _changes_sides,
        "condition": _condition,
        "several": _several,
        "warning": _said("an assertion of the text warns"),
        "terminate": _said("`terminate` of the text ends the run"),
        "impact": _strikes,
        "last_impact": _strikes_last,
        "tangential_impact": _jams,
        "percussion": _blow,
    }
)
