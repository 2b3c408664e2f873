"""The mode of the DAE after an event: the first combination that is admissible."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from frot.compiler.product.dae_instant import Instant, Vector
from frot.compiler.product.dae_switching import BACKWARD, CLOSED, FORWARD, GUARDS, PARTS, STICK
from frot.dsl.messages.errors import fail

# Combinations of modes that are tried.
MOST_TRIED = 20_000
# Part of the terms of a reaction or an acceleration below which it is zero.
ADMISSIBLE = 1e-9

# Values of some places of the mode.
Choice = Mapping[int, float]


def put_open(at: Instant, name: str) -> None:
    """Open a contact: its laws bound nothing."""
    first = at.dae.names.mode.index(f"{name}.{PARTS[CLOSED]}")
    at.mode[first] = 0.0
    at.mode[first + 2 : first + len(PARTS)] = 0.0


def choose_mode(at: Instant, fired: set[str]) -> None:
    """Put the mode, and speeds on its relations; `fired` are the guards that are zero.

    What slips continues to slip, and what parts is open. Of the rest rest comes first, but for what
    has just reached its bound. Among several admissible modes the first is taken.
    """
    choices = [*_of_contacts(at, fired), *_of_laws(at, fired)]
    if math.prod(len(one) for one in choices) > MOST_TRIED:
        raise fail(
            "E0902",
            f"too many contacts and laws change at once at t = {at.t:.17g}",
            help="run the model by `simulate`",
        )
    _hold(at, choices)
    trial, settled = Trial(at, choices), at.mode
    for chosen in _in_order(choices):
        at.mode = _with(settled, chosen, at)
        if trial.admits(at):
            _reset(at)
            return
    raise trial.failure(at.t)


def _of_contacts(at: Instant, fired: set[str]) -> Iterator[list[Choice]]:
    """Open or closed, or on which side it presses."""
    rate, size = at.rates()
    parting = at.parting()
    for one in at.dae.impacts.normals:
        if one.mode < 0 or at.mode[one.mode] == 0:
            continue
        if one.name in parting:
            if rate[one.row] > size[one.row]:
                put_open(at, one.name)
                continue
            options: list[Choice] = [{one.mode: 1.0}, {one.mode: 0.0}]
            yield options[::-1] if f"{one.name}.normal" in fired and _was(at, one.name) else options
        elif one.signed:
            sign = at.mode[one.mode + 1] or 1.0
            if f"{one.name}.normal" in fired:
                sign = -sign
            yield [{one.mode + 1: sign}, {one.mode + 1: -sign}]


def _was(at: Instant, name: str) -> bool:
    """Whether a contact was closed before the event."""
    return name not in at.touched


def _of_laws(at: Instant, fired: set[str]) -> Iterator[list[Choice]]:
    """How each law of what is closed moves."""
    rate, size = at.rates()
    for law in at.dae.impacts.laws:
        if at.mode[law.closed] == 0:
            continue
        now, speed = at.mode[law.mode], rate[law.row]
        reached = [f"{law.name}_{k}" in fired for k in (1, 2)]
        if not (now == STICK or any(reached) or abs(speed) <= size[law.row]):
            at.mode[law.mode] = float(FORWARD if speed > 0 else BACKWARD)
            continue
        order = [STICK, FORWARD, BACKWARD]
        if now == STICK and any(reached):  # the force is at its bound: it opposes the slip
            order = [BACKWARD, FORWARD, STICK] if reached[0] else [FORWARD, BACKWARD, STICK]
        yield [{law.mode: float(kind)} for kind in order]


def _in_order(choices: Sequence[Sequence[Choice]]) -> Iterator[tuple[Choice, ...]]:
    """The combinations, those with most of the first choices first."""
    ranks = itertools.product(*(range(len(one)) for one in choices))
    for found in sorted(ranks, key=lambda rank: (sum(rank), rank)):
        yield tuple(one[k] for one, k in zip(choices, found, strict=True))


def _with(mode: Vector, chosen: Sequence[Choice], at: Instant) -> Vector:
    """The mode with these choices."""
    new = mode.copy()
    for one in chosen:
        for place, value in one.items():
            new[place] = value
    for law in at.dae.impacts.laws:
        if new[law.closed] == 0:
            new[law.mode] = 0.0
    return new


def _hold(at: Instant, choices: Sequence[Sequence[Choice]]) -> None:
    """Take from the speeds the rounding of what is zero."""
    mode, at.mode = at.mode, at.mode.copy()
    for options in choices:
        for place, value in max(options, key=lambda one: STICK in one.values()).items():
            at.mode[place] = value
    _reset(at)
    at.mode = mode


def _reset(at: Instant) -> None:
    """Speeds onto the relations of the mode; where these depend on each other they stay."""
    x = np.array(at.dae.reset(at.t, at.x, at.z(), at.u, at.p, at.mode)).ravel()
    if np.all(np.isfinite(x)):
        at.x = x


class Trial:
    """What makes a mode admissible among the `choices`."""

    def __init__(self, at: Instant, choices: Sequence[Sequence[Choice]]) -> None:
        """Evaluate what all modes have in common."""
        impacts = at.dae.impacts
        self.free = {place for options in choices for one in options for place in one}
        self.effect = np.abs(at.of("effect"))
        self.labels = [at.dae.names.z.index(label) for label in impacts.rows]
        self.unsolved = 0

    def admits(self, at: Instant) -> bool:
        """Whether the mode of the instant is admissible."""
        impacts, z = at.dae.impacts, at.z()
        acceleration = at.of("acceleration", z=z).ravel()
        if not (np.all(np.isfinite(z)) and np.all(np.isfinite(acceleration))):
            self.unsolved += 1
            return False
        forces = np.abs(z[self.labels])
        least = -ADMISSIBLE * (self.effect @ forces + np.abs(acceleration))
        for one in impacts.normals:
            opens = one.mode in self.free and at.mode[one.mode] == 0
            if opens and acceleration[one.row] < least[one.row]:
                return False
        for law in impacts.laws:
            if law.mode in self.free and at.mode[law.mode] in (FORWARD, BACKWARD):
                sign = 1 if at.mode[law.mode] == FORWARD else -1
                if sign * acceleration[law.row] < least[law.row]:
                    return False
        return self._within_bounds(at, z, ADMISSIBLE * float(forces.max(initial=0.0)))

    def _within_bounds(self, at: Instant, z: Vector, small: float) -> bool:
        """Whether reactions press, and the friction of what sticks is within its bound."""
        names, guards = at.dae.names.guards, at.guards(z)
        places = {name: k for k, name in enumerate(at.dae.names.mode)}
        for name, value in zip(names, guards, strict=True):
            owner, _, part = name.rpartition(".")
            if part not in GUARDS or at.mode[places[f"{owner}.{PARTS[CLOSED]}"]] == 0:
                continue
            law = part.rpartition("_")[0]
            forces = part == GUARDS[0] or at.mode[places[f"{owner}.{law}"]] == STICK
            if forces and value < -small:
                return False
        return True

    def failure(self, t: float) -> Exception:
        """Why no mode was found."""
        if self.unsolved:
            return fail(
                "E0701",
                f"the equations of the DAE are singular at t = {t:.17g}",
                help="look for a posture without a motion of its own, or run it by `simulate`",
            )
        return fail(
            "E0902",
            f"no mode of the DAE is admissible at t = {t:.17g}",
            help="run the model by `simulate`, which takes tangential impacts into account",
        )
