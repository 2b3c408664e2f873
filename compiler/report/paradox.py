"""From which coefficient of friction a liaison may have no motion, or several (P. Painlevé 1895).

A reaction N bounds the friction f that acts with it, and friction changes the reaction:
N = N0 + c f with everything else held. With f = mu |N| against the slip this has one solution,
whatever N0 is, as long as mu |c| < 1. Of a contact c = (n M^-1 t)/(n M^-1 n), so that Painlevé's
coefficient n M^-1 (n - mu t) is zero at the coefficient named here; in space t is the direction of
the slip for which |c| is largest. Of a pin, whose couple is mu r |R|, c is |dR/df| and r counts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import casadi as ca
import numpy as np
from frot.compiler.equations.reduced import Reduced
from frot.compiler.mechanics.constraint import Constraint
from frot.compiler.mechanics.geometry.bounded_figures import ends
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.compiler.report.friction_coupling import NO_COUPLING, SlidingLaw
from frot.compiler.report.numeric_dynamics import Dynamics, State, make_dynamics
from frot.compiler.report.posture_search import Postures
from frot.compiler.report.relations import Posture
from frot.dsl.checked import Liaison

_MOST_SPEEDS, _MOST_LAWS = 12, 8
# Laws of what cannot part that slip with their coefficients beside one; pairs of contacts.
_MOST_OTHERS = 3
# Of a gap that is open at the start.
_OPEN = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class Paradox:
    """A liaison whose friction may leave no motion, or several, from a coefficient on.

    `start`: from which one at the posture of the start, `least` in the worst posture that was found
    (None where there was no search, or where it reached no maximum), `where` its coordinates that
    matter, `beside` contacts that slip there too; `mu` is the coefficient that the text has at the
    start. Infinite: at none.
    """

    liaison: Liaison
    mu: float
    start: float
    least: float | None
    where: tuple[tuple[str, float], ...] = ()
    beside: tuple[Liaison, ...] = ()


def find_paradoxes(reduced: Reduced, start: Posture) -> tuple[Paradox, ...]:
    """Laws of sliding friction in which a paradox is possible, whatever the loads are.

    Each with the coefficients that the others have: those of what cannot part and, of the plane,
    those of one more contact that can part and touches. Else such contacts are open.
    """
    if not reduced.symbols.v.numel():
        return ()
    dynamics = make_dynamics(reduced)
    nothing = np.zeros(dynamics.others.numel())
    v = np.zeros(reduced.symbols.v.numel())
    state = State(start.t, start.q, v, start.u, start.p, start.sides, nothing)
    laws = _sliding_laws(dynamics, state)
    wide = v.size <= _MOST_SPEEDS and len(laws) <= _MOST_LAWS
    found = (_examine(dynamics, law, laws, state, wide) for law in laws)
    return tuple(x for x in found if x is not None)


def _sliding_laws(dynamics: Dynamics, state: State) -> list[SlidingLaw]:
    """All laws against a slip, and against the turning in a pin."""
    reduced, found, place = dynamics.reduced, [], 0
    lower = reduced.variables.kinematics.fixed.lower
    links = reduced.mechanism.contacts
    held = np.array([not (x.reduced or is_unilateral(x.liaison)) for x in links], dtype=bool)
    for k, link in enumerate(links):
        examined = reduced.mechanism.model.planar or not _is_at_edge(link)
        for j, block in enumerate(link.frictions):
            value = reduced.motion.matrices.coefficients[2 * place]
            numbers = ca.Function("coefficient", dynamics.arguments, [value])
            place += block.components
            radius = 1.0
            if block.arm is not None:
                arm = ca.Function("radius", dynamics.arguments, [lower(block.arm)])
                radius = float(arm(*dynamics.numbers(state)))
            used = held.copy()
            used[k] = not link.reduced
            if examined and not block.turns:
                found.append(SlidingLaw(dynamics, k, j, numbers, radius, used))
    return found


def _is_at_edge(link: Constraint) -> bool:
    """Whether it is a contact in space at an edge, whose gap means nothing beyond its ends."""
    return any(ends(x) and x.plane is None for pair in link.pairs for x in pair)


def _examine(
    dynamics: Dynamics, law: SlidingLaw, laws: list[SlidingLaw], state: State, wide: bool
) -> Paradox | None:
    """The least coefficients of a law, alone and beside each contact that may touch too."""
    links, mu = dynamics.reduced.mechanism.contacts, law.coefficient(state)
    found: list[tuple[float, float | None, State | None, SlidingLaw]] = []
    for one in _beside_others(law, laws):
        closed = tuple(k for k in (one.index, *one.beside) if is_unilateral(links[k].liaison))
        here = None
        touching = _touch(dynamics, state, closed)
        if touching and (not one.beside or _is_independent(one, state)):
            here = one.coupling(state)
        postures = Postures(dynamics, _value_of(one), one.used, closed)
        worst = postures.worst(state) if wide else None
        at_start = np.inf if here is None else _inverse(here)
        least = None if worst is None else _inverse(worst[0])
        found.append((at_start, least, None if worst is None else worst[1], one))
    at_start = min(x[0] for x in found)
    searched = [(x[1], x[2], x[3]) for x in found if x[1] is not None and x[2] is not None]
    least, there, own = min(searched, key=lambda x: x[0], default=(None, None, law))
    if found[0][1] is None and (least is None or least == np.inf):
        least = None  # alone it has no maximum: others tell nothing of the worst
    if at_start == np.inf and (least == np.inf if wide else True):
        return None
    where: tuple[tuple[str, float], ...] = ()
    if there is not None and least is not None and least < np.inf:
        closed = tuple(k for k in (own.index, *own.beside) if is_unilateral(links[k].liaison))
        where = tuple(Postures(dynamics, _value_of(own), own.used, closed).names(there))
    beside = tuple(links[k].liaison for k in own.beside) if least is not None else ()
    return Paradox(law.link.liaison, mu, at_start, least, where, beside)


def _beside_others(law: SlidingLaw, laws: list[SlidingLaw]) -> Iterator[SlidingLaw]:
    """The law beside what cannot part, then beside each contact that can part, too."""
    held = [
        x
        for x in laws
        if x.can_be_other and not x.is_unilateral and (x.index, x.block) != (law.index, law.block)
    ]
    own = tuple(held) if law.can_be_other and len(held) <= _MOST_OTHERS else ()
    yield replace(law, others=own)
    if not law.can_be_other:
        return
    near = _connected(law)
    parting = [
        x
        for x in laws
        if x.can_be_other and x.is_unilateral and x.index != law.index and x.index in near
    ]
    for other in parting[:_MOST_OTHERS]:
        used = law.used.copy()
        used[other.index] = True
        # the others read reactions of the same held rows
        also = tuple(replace(x, used=used) for x in (*own, other))
        yield replace(law, used=used, others=also, beside=(other.index,))


def _connected(law: SlidingLaw) -> set[int]:
    """The links of the bodies that links connect with those of the law, but for the ground."""
    links = law.dynamics.reduced.mechanism.contacts
    own = [{b for b in link.bodies if b.shape is not None} for link in links]
    bodies = set(own[law.index])
    while more := {b for x in own if x & bodies for b in x} - bodies:
        bodies |= more
    return {k for k, x in enumerate(own) if x & bodies}


def _value_of(law: SlidingLaw) -> Callable[[State], float | None]:
    def value(state: State) -> float | None:
        if law.beside and not _is_independent(law, state):
            return None
        return law.coupling(state)

    return value


def _is_independent(law: SlidingLaw, state: State) -> bool:
    """Whether the row of a contact beside does not depend on the others."""
    dynamics = law.dynamics
    (_, rows), nv = dynamics.masses(state), state.v.size
    held = dynamics.held(law.used)
    own = [r for k in (law.index, *law.beside) for r in dynamics.reduced.contact_rows[k].reaction]
    before = [r for r in held if r not in own]
    ranks = [np.linalg.matrix_rank(rows[x, :nv], tol=1e-6) if x else 0 for x in (before, held)]
    return int(ranks[1] - ranks[0]) == len([r for r in own if r in held])


def _touch(dynamics: Dynamics, state: State, closed: tuple[int, ...]) -> bool:
    """Whether contacts that can part touch in a posture."""
    gaps = dynamics.relations(*dynamics.numbers(state))[2].ravel()
    return bool(np.all(np.abs(gaps[list(closed)]) <= _OPEN)) if closed else True


def _inverse(coupling: float) -> float:
    return 1 / coupling if coupling > NO_COUPLING else float("inf")
