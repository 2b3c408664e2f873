"""An event of the DAE: `when`s, percussions and impacts, then the modes after it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from frot.compiler.product.dae_instant import Instant, Vector
from frot.compiler.product.dae_modes import choose_mode, put_open
from frot.compiler.product.dae_strikes import meet, strike
from frot.dsl.messages.errors import fail

# Rounds of `when`s at one instant after which they will not settle.
MOST_ROUNDS = 100


@dataclass(frozen=True, slots=True, eq=False)
class After:
    """The state after an event.

    Attributes:
        x: Coordinates and other states, then speeds, in SI.
        mode: The mode after it.
        impulses: Of each row of `Impacts.rows`, N.s or N.m.s.
        lost: Energy that contacts have taken, J.
        phases: How often slip, stick or compression changed within the impacts.
        outcomes: Which of `names.outcomes` have happened.
    """

    x: Vector
    mode: Vector
    impulses: Vector
    lost: float
    phases: int
    outcomes: tuple[str, ...]


def happen(at: Instant, fired: Iterable[str]) -> After:
    """The state after the event at which the guards `fired` are zero: see `Dae.event`."""
    dae = at.dae
    names = set(fired)
    unknown = names - set(dae.names.guards)
    if unknown:
        raise fail(
            "E0806",
            f"the DAE has no guard '{min(unknown)}'",
            help=f"the guards are {', '.join(dae.names.guards) or 'none'}",
        )
    before = at.mode.copy()
    _close(at, names)
    outcomes = _whens(at, names)
    parts = [act(at, before) for act in (strike, meet)]
    choose_mode(at, names)
    return After(
        x=at.x,
        mode=at.mode,
        impulses=parts[0].impulses + parts[1].impulses,
        lost=sum(part.lost for part in parts),
        phases=sum(part.phases for part in parts),
        outcomes=outcomes,
    )


def first_mode(at: Instant, values: Vector, closed: Iterable[str]) -> Vector:
    """The mode of a motion that begins at x: see `Dae.first_mode`.

    `values`: what only events change, at the start.
    """
    dae = at.dae
    names = set(closed)
    at.mode[len(at.mode) - len(values) :] = values
    owners = {name.rpartition(".")[0] for name in dae.names.mode if name.endswith(".closed")}
    if names - owners:
        raise fail(
            "E0806",
            f"the DAE has no contact '{min(names - owners)}'",
            help=f"its contacts and laws are {', '.join(sorted(owners)) or 'none'}",
        )
    parting = at.parting()
    for k, name in enumerate(dae.names.mode):
        owner, _, part = name.rpartition(".")
        if part == "closed":
            at.mode[k] = float(owner in names or owner not in parting)
        elif part in ("reaction_sign", "side") and owner in owners:
            at.mode[k] = 1.0
    _choose_sides(at)
    for place in at.flags():
        at.mode[place] = float(at.guard(dae.names.mode[place]) < 0)
    for one in dae.impacts.normals:
        if one.mode >= 0 and at.mode[one.mode] == 0:
            put_open(at, one.name)
    choose_mode(at, set())
    return at.mode


def _choose_sides(at: Instant) -> None:
    """The side of each contact: where it is, or where it touches; the outer one of both."""
    impacts, names = at.dae.impacts, at.dae.names.mode
    places = [names.index(f"{name}.side") for name in impacts.contacts]
    outer = at.of("gap").ravel()
    at.mode[places] = -1.0
    inner = at.of("gap").ravel()
    for name, place, a, b in zip(impacts.contacts, places, outer, inner, strict=True):
        closed = at.mode[names.index(f"{name}.closed")] != 0
        if abs(a) <= abs(b) if closed else a >= 0:
            at.mode[place] = 1.0


def _close(at: Instant, fired: set[str]) -> None:
    """Open contacts whose gap is zero touch."""
    for one in at.dae.impacts.normals:
        if one.opens >= 0 and f"{one.name}.normal" in fired and at.mode[one.mode] == 0:
            at.mode[one.mode], at.mode[one.mode + 1] = 1.0, 1.0
            at.touched.add(one.name)


def _whens(at: Instant, fired: set[str]) -> tuple[str, ...]:
    """Conditions change, and what the `when`s do whose conditions come to hold."""
    dae, changed = at.dae, [k for k in at.flags() if at.dae.names.mode[k] in fired]
    outcomes: list[str] = []
    for _ in range(MOST_ROUNDS):
        if not changed:
            return tuple(outcomes)
        for place in changed:
            at.mode[place] = 1 - at.mode[place]
        held = [dae.names.mode[k] for k in changed if at.mode[k] == 1]
        if dae.update is not None and set(held) & set(dae.names.fired):
            asked = np.array([float(name in held) for name in dae.names.fired])
            after, values, happened = (
                np.array(part).ravel()
                for part in dae.update(at.t, at.x, at.z(), at.u, at.p, at.mode, asked)
            )
            at.x = after
            at.mode[len(at.mode) - len(values) :] = values
            outcomes += [
                text for text, one in zip(dae.names.outcomes, happened, strict=True) if one
            ]
        # a condition that has just changed is at zero, and stays
        changed = [k for k in at.flags() if k not in changed and at.guard(dae.names.mode[k]) < 0]
    raise fail(
        "E0903",
        f"the conditions of the DAE change without end at t = {at.t:.17g}",
        help="look for a `when` that brings about its own condition",
    )
