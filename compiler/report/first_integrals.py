"""First integrals: what no motion changes, whatever the state, the inputs and the friction are.

The rate of each candidate is computed at random states that the relations allow, from the equations
of motion, with contacts open and closed and friction of any size: an identity between analytic
functions that holds at some random points holds everywhere. What is constant because the relations
say so (the height of what rolls on a plane) is none.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import casadi as ca
import numpy as np
from frot.compiler.equations.assembled import Assembled
from frot.compiler.equations.reduced import Reduced
from frot.compiler.lowering.initial_problem import InitialProblem
from frot.compiler.lowering.result_variables import FirstIntegral
from frot.compiler.report.candidates import (
    ENERGY,
    MOMENTUM,
    TURNING,
    Candidate,
    Twist,
    list_candidates,
)
from frot.compiler.report.numeric_dynamics import make_dynamics
from frot.compiler.report.relations import Floats, Posture
from frot.compiler.report.search import Looked, Search
from frot.compiler.report.start import find_start
from frot.dsl.quantities.dimensions import Dimension

# Of more speeds the equations are not written out.
MOST_SPEEDS = 24
# States at which most candidates fail; and beside one for each that does not.
_FIRST, _SAMPLES = 2, 8
# Of values of size one: what those before do not give.
_NEW = 1e-7
# Of a weight: none.
_NONE = 1e-7


def first_integrals_of(system: Assembled, problem: InitialProblem) -> tuple[FirstIntegral, ...]:
    """First integrals near the start of a system; of more than `MOST_SPEEDS` the energy at most."""
    reduced = system.reduced
    if not reduced.mechanism.model.bodies:
        return ()
    if reduced.symbols.v.numel() > MOST_SPEEDS:
        return find_first_integrals(reduced, None)
    return find_first_integrals(reduced, find_start(system, problem).posture)


def find_first_integrals(reduced: Reduced, start: Posture | None) -> tuple[FirstIntegral, ...]:
    """All that are found, in the order of the candidates, none that follows from others linearly.

    Beside the candidates with names, combinations: momenta along and about any axis of the ground,
    and the energy in a frame that turns or moves steadily (P. Painlevé 1895; C. Jacobi). Of more
    speeds than `MOST_SPEEDS` only the energy is examined, for which no start is needed, and where
    states tell of nothing, as about a start from which the mechanism continues in several ways.
    """
    if not reduced.symbols.v.numel():
        return ()
    if reduced.symbols.v.numel() > MOST_SPEEDS or start is None:
        return _energy_alone(reduced)
    dynamics = make_dynamics(reduced)
    listed = list_candidates(reduced)
    unknown = dynamics.others
    named = [c for c in listed.named if not (unknown.numel() and ca.depends_on(c.value, unknown))]
    if not named:
        return ()
    twists = [x for t in listed.twists for x in (t.momentum, t.angular)]
    search = Search(dynamics, ca.vertcat(*(c.value for c in named), *twists), start)
    looked = search.look(start.p, _FIRST)
    if looked is None:
        return _energy_alone(reduced)
    hopeful = np.flatnonzero(looked.constant()[: len(named)]).size
    # friction on the ground leaves no momentum, whatever the axis
    ideal = not dynamics.friction
    if not (hopeful or ideal):
        return _energy_alone(reduced)
    more = search.look(start.p, hopeful + _SAMPLES, seed=3)
    looked = looked if more is None else more
    holds = looked.constant()
    kept = [k for k in range(len(named)) if holds[k]]
    kinds = [c.dimension for c in named]
    kinds += [kind for _ in listed.twists for kind in [MOMENTUM] * 3 + [TURNING] * 3]
    sizes = _sizes(looked.values, kinds)
    kept = list(_new(looked.values / sizes, kept))
    combined = list(_combined(listed.twists, named, looked, kept, sizes)) if ideal else []
    if not (kept or combined):
        return _energy_alone(reduced)
    generally = search.look(search.other_parameters(), _FIRST)
    count = looked.values.shape[1]
    weights = [np.eye(count)[k] for k in kept] + [w for _, w in combined]
    always = [generally is not None and bool(generally.constant(w)) for w in weights]
    found = [named[k] for k in kept] + [c for c, _ in combined]
    return tuple(
        FirstIntegral(c.text, c.value, c.dimension, same)
        for c, same in zip(found, always, strict=True)
    )


def _energy_alone(reduced: Reduced) -> tuple[FirstIntegral, ...]:
    """The energy where nothing works: no friction, no load without potential, nothing driven."""
    mechanism = reduced.mechanism
    dry = any(rows.tangent or rows.rolling for rows in reduced.contact_rows)
    if (
        dry
        or mechanism.is_driven
        or not reduced.plain
        or not reduced.motion.matrices.power.is_zero()
    ):
        return ()
    energy = reduced.variables.without_auxiliary(reduced.motion.kinetic + reduced.motion.potential)
    return (FirstIntegral("energy", energy, ENERGY, True),)


def _new(values: Floats, order: Iterable[int]) -> Iterator[int]:
    """Integrals that are no linear combination of a constant and those before them."""
    count = values.shape[0]
    basis = np.ones((count, 1)) / np.sqrt(count)
    for k in order:
        rest = values[:, k] - basis @ (basis.T @ values[:, k])
        rest -= basis @ (basis.T @ rest)
        if np.linalg.norm(rest) <= _NEW * np.sqrt(count):
            continue
        yield k
        if basis.shape[1] < count - 1:
            basis = np.hstack([basis, (rest / np.linalg.norm(rest))[:, None]])


def _combined(
    twists: tuple[Twist, ...],
    named: list[Candidate],
    looked: Looked,
    kept: list[int],
    sizes: Floats,
) -> Iterator[tuple[Candidate, Floats]]:
    """Momenta along and about other axes; of the whole, the energy less some of them."""
    first = len(named)
    known = [np.eye(looked.values.shape[1])[k] for k in kept]
    energy = next((k for k, c in enumerate(named) if c.dimension is ENERGY), None)
    for number, twist in enumerate(twists):
        own = list(range(first + 6 * number, first + 6 * number + 6))
        jacobi = number == 0 and energy is not None and energy not in kept
        places = [*own, energy] if jacobi and energy is not None else own
        for weights in _constant_sums(looked, places, known, sizes):
            known.append(weights)
            own_size = abs(weights[energy]) if jacobi and energy is not None else 0.0
            weights = weights / (own_size or np.linalg.norm(weights[own[3:]]) or 1.0)
            along, about = weights[own[:3]], weights[own[3:]]
            value = ca.dot(ca.DM(along), twist.momentum) + ca.dot(ca.DM(about), twist.angular)
            words, kind = _words(along, about) + twist.of, TURNING
            if jacobi and energy is not None and weights[energy]:
                value = value + named[energy].value
                words, kind = f"energy in a frame that moves: energy {_less(along, about)}", ENERGY
            yield Candidate(words, value, kind), weights


def _constant_sums(
    looked: Looked, places: list[int], known: list[Floats], sizes: Floats
) -> list[Floats]:
    """Weights of sums that stay constant, and that those known before do not give.

    What the relations make a constant, as the momentum across a plane, is left out of them.
    """
    values, scale = looked.values / sizes, sizes[places]
    moving = values[:, places] - values[:, places].mean(axis=0)
    _, found, right = np.linalg.svd(moving)
    telling = right[: int(np.sum(found > _NEW * np.sqrt(len(values))))]
    fast = np.max(looked.sizes[:, places] / scale, axis=1, keepdims=True, initial=0.0)
    if not telling.size or np.min(fast) == 0:
        return []
    _, found, right = np.linalg.svd((looked.rates[:, places] / scale / fast) @ telling.T)
    constant = right[int(np.sum(found > 1e-8)) :] @ telling
    before = np.array([values @ (w * sizes) for w in known]).T.reshape(values.shape[0], -1)
    result: list[Floats] = []
    for weights in _reduced(constant):
        whole = np.zeros(values.shape[1])
        whole[places] = weights / scale
        columns = np.hstack([before, (looked.values @ whole)[:, None]])
        new = columns.shape[1] - 1 in _new(columns, range(columns.shape[1]))
        if new and bool(looked.constant(whole)):
            before = columns
            result.append(whole / np.max(np.abs(whole)))
    return result


def _sizes(values: Floats, kinds: list[Dimension]) -> Floats:
    """The largest value among all of one kind: what is rounding beside it is zero."""
    largest = np.max(np.abs(values), axis=0)
    of_kind: dict[Dimension, float] = {}
    for kind, size in zip(kinds, largest, strict=True):
        of_kind[kind] = max(of_kind.get(kind, 0.0), size)
    return np.array([of_kind[kind] or 1.0 for kind in kinds])


def _reduced(space: Floats) -> Floats:
    """The rows in echelon form from the last column on: few weights, the leading one is one."""
    space = space[:, ::-1].copy()
    row = 0
    for column in range(space.shape[1]):
        if row == space.shape[0]:
            break
        best = row + int(np.argmax(np.abs(space[row:, column])))
        if abs(space[best, column]) <= _NONE * np.max(np.abs(space)):
            continue
        space[[row, best]] = space[[best, row]]
        space[row] /= space[row, column]
        for other in range(space.shape[0]):
            if other != row:
                space[other] -= space[other, column] * space[row]
        row += 1
    space[np.abs(space) < _NONE] = 0
    return np.asarray(space[:row, ::-1])


def _words(along: Floats, about: Floats) -> str:
    """In words: a direction, or an axis with the pitch of its screw."""
    size = float(about @ about)
    if size == 0:
        return f"momentum along {_tuple(along / np.linalg.norm(along))}"
    pitch = float(along @ about) / size
    through = np.cross(about, along) / size
    words = f"angular momentum about {_tuple(about / np.sqrt(size))} through {_tuple(through)} m"
    return words if abs(pitch) < _NONE else f"{words} and {pitch:.6g} m times the momentum along it"


def _less(along: Floats, about: Floats) -> str:
    parts = [f"{w:+.6g} rad/s * angular momentum about {e}" for w, e in zip(about, "xyz") if w]  # noqa: B905
    parts += [f"{w:+.6g} m/s * momentum along {e}" for w, e in zip(along, "xyz") if w]  # noqa: B905
    return " ".join(part.replace("+", "+ ", 1).replace("-", "- ", 1) for part in parts)


def _tuple(vector: Floats) -> str:
    return "(" + ", ".join(f"{x + 0.0:.6g}" for x in vector) + ")"
