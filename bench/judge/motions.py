"""All admissible motions of a scene at an instant, by looking at every combination of modes.

Unknowns are the accelerations of all bodies and one number a row of reaction. In a combination
every row has one equation: a relation or a rest (no relative acceleration), or a law of motion.
Whatever these leave open (redundant liaisons) is chosen by linear programming as far from every
bound as possible: `margin` is that distance, negative where no choice satisfies the laws.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from judge.mechanics import Floats, Joint, Mechanics, Row
from judge.scene import Contact, Pin

CLEAR = 1e-6
# Part of what the quickest of joined bodies accelerates by that rounding leaves in all of them,
# by `CLEAR` of it.
SHOWS = 1e-8
MOST = 3000


@dataclass(frozen=True, slots=True)
class Choice:
    """Modes of one liaison: open, or closed with signs of reaction and slips (0: held or none)."""

    closed: bool = True
    side: int = 1
    slip: int = 0
    roll: int = 0


@dataclass(slots=True)
class Motion:
    """An admissible (margin > 0), borderline or excluded combination.

    `sign` is that of the determinant of its equations, 0 where reactions are not unique: a motion
    that jams ends where it changes, though its reactions may be small.
    """

    modes: dict[str, Choice]
    acceleration: Floats
    reactions: Floats
    margin: float
    rank_gap: float
    size: float
    sign: float


@dataclass(frozen=True, slots=True)
class Still:
    """What the state says of a liaison: does it touch; the sense of slip and roll (0: none)."""

    touching: bool
    slip: int
    roll: int


def choices(joint: Joint, still: Still) -> list[Choice]:
    """The modes to look at."""
    c = joint.liaison
    if isinstance(c, Contact) and not c.bilateral and not still.touching:
        return [Choice(closed=False)]
    slips = [0] if c.mu is None or joint.mu_s == 0 else ([still.slip] if still.slip else [0, 1, -1])
    rolls = [0]
    if isinstance(c, Contact) and c.delta is not None and joint.delta > 0:
        rolls = [still.roll] if still.roll else [0, 1, -1]
    sides = [1]
    if isinstance(c, Contact) and c.bilateral and (c.mu is not None or c.delta is not None):
        sides = [1, -1]
    found = [Choice(True, s, t, r) for s in sides for t in slips for r in rolls]
    if isinstance(c, Contact) and not c.bilateral:
        found.append(Choice(closed=False))
    return found


def count(now: Mechanics, still: Mapping[str, Still]) -> int:
    total = 1
    for name, joint in now.joints.items():
        total *= len(choices(joint, still[name]))
    return total


def motions(now: Mechanics, still: Mapping[str, Still]) -> Iterator[Motion]:
    """Every combination with its margin; those without a solution of its equations are left out."""
    names = list(now.joints)
    for modes in itertools.product(*(choices(now.joints[n], still[n]) for n in names)):
        found = motion(now, dict(zip(names, modes, strict=True)), still)
        if found is not None:
            yield found


@dataclass(slots=True)
class Inequality:
    """line z + constant >= 0, of an acceleration of a row or of `factor` times a joint's force."""

    line: Floats
    constant: float
    of: Joint | Row
    factor: float = 1.0

    def size(self, now: Mechanics, quick: Floats) -> float:
        """What its terms are beside such accelerations of all bodies."""
        if isinstance(self.of, Row):
            return float(self.of.reach @ quick + self.of.bias_size)
        return self.factor * force_size(now, self.of, quick)


class System:
    """Equations and inequalities of one combination, with rows scaled to size one."""

    def __init__(self, now: Mechanics, modes: Mapping[str, Choice], still: Mapping[str, Still]):
        self.now = now
        self.columns: list[tuple[str, str]] = []
        for name, joint in now.joints.items():
            if modes[name].closed:
                self.columns += [(name, w) for w in acting(joint)]
        n, k = now.n, len(self.columns)
        self.index = {key: n + i for i, key in enumerate(self.columns)}
        self.matrix = np.zeros((n + k, n + k))
        self.right = np.zeros(n + k)
        self.sizes = np.concatenate([now.load_size, np.zeros(k)])
        self.bends: list[tuple[int, str, float]] = []  # rows whose law holds a norm
        self.inequalities: list[Inequality] = []
        self.matrix[:n, :n] = np.diag(now.mass)
        self.right[:n] = now.load
        for (name, word), at in self.index.items():
            self.matrix[:n, at] = -now.joints[name].rows[word].jacobian
        for name, joint in now.joints.items():
            self._liaison(joint, modes[name], still[name])

    def _rest(self, at: int, joint: Joint, word: str) -> None:
        row = joint.rows[word]
        self.matrix[at, : self.now.n] = row.jacobian
        self.right[at] = -row.bias
        self.sizes[at] = row.reach @ accelerations(self.now) + row.bias_size

    def _at_least(self, terms: Mapping[int, float], joint: Joint, factor: float = 1.0) -> None:
        """A force, or a couple of `factor` m, that is not negative."""
        line = np.zeros(len(self.right))
        for at, x in terms.items():
            line[at] += x
        self.inequalities.append(Inequality(line, 0.0, joint, factor))

    def _acceleration(self, joint: Joint, word: str, sign: int) -> None:
        """Sign * (J a + c) >= 0."""
        row, line = joint.rows[word], np.zeros(len(self.right))
        line[: self.now.n] = sign * row.jacobian
        self.inequalities.append(Inequality(line, sign * row.bias, row))

    def _liaison(self, joint: Joint, mode: Choice, still: Still) -> None:
        name, c = joint.liaison.name, joint.liaison
        if not mode.closed:
            if still.touching:  # what is apart, or parts with speed, may accelerate as it likes
                self._acceleration(joint, "n", 1)
            return
        if isinstance(c, Pin):
            for w in ("x", "y"):
                self._rest(self.index[name, w], joint, w)
            if c.mu is not None:
                self._law(joint, "c", mode.slip, still.slip, None, joint.mu, joint.mu_s)
            return
        normal = self.index[name, "n"]
        self._rest(normal, joint, "n")
        bounded = c.mu is not None or c.delta is not None
        if not c.bilateral or bounded:
            self._at_least({normal: mode.side}, joint)
        side = (normal, mode.side)
        if c.mu is not None:
            self._law(joint, "t", mode.slip, still.slip, side, joint.mu, joint.mu_s)
        if c.delta is not None:
            self._law(joint, "r", mode.roll, still.roll, side, joint.delta, joint.delta)

    def _law(
        self,
        joint: Joint,
        word: str,
        way: int,
        moving: int,
        normal: tuple[int, int] | None,
        bound: float,
        rest: float,
    ) -> None:
        name = joint.liaison.name
        at = self.index[name, word]
        if rest == 0:  # a law that bounds nothing
            self.matrix[at, at] = 1
            # what is zero is so to the rounding of the others
            self.sizes[at] = force_size(self.now, joint, accelerations(self.now))
            return
        if way == 0:
            self._rest(at, joint, word)
            if normal is not None:
                for sign in (1, -1):
                    self._at_least({normal[0]: rest * normal[1], at: sign}, joint, rest)
            return
        self.matrix[at, at] = 1
        if normal is not None:
            self.matrix[at, normal[0]] += way * bound * normal[1]
        else:
            self.bends.append((at, name, way * bound))
        if not moving:
            self._acceleration(joint, word, way)


def acting(joint: Joint) -> list[str]:
    c = joint.liaison
    if isinstance(c, Pin):
        return ["x", "y"] + (["c"] if c.mu is not None else [])
    return ["n"] + (["t"] if c.mu is not None else []) + (["r"] if c.delta is not None else [])


def accelerations(now: Mechanics) -> Floats:
    """Sizes of the accelerations that the loads and the motion can bring about."""
    if now.quick is None:
        now.quick = _accelerations(now)
    return now.quick


def _accelerations(now: Mechanics) -> Floats:
    quick = now.load_size / now.mass
    for places, joints in parts(now):
        here = quick[places]
        spread = np.max(here[:, :2], initial=0.0)
        reach = max((j.size for j in joints), default=1.0)
        spread = max(spread, float(np.max(here[:, 2], initial=0.0)) * reach * 1e-3)
        for joint in joints:
            spread = max(spread, *(r.bias_size for w, r in joint.rows.items() if w not in "cr"))
        quick[places[:, :2]] = np.maximum(here[:, :2], spread)
    return quick


def parts(now: Mechanics) -> list[tuple[NDArray[np.intp], list[Joint]]]:
    """Bodies that liaisons join, each by its three places, with these liaisons.

    What no liaison joins cannot act on each other: one part has no size for the other.
    """
    if now.parts is None:
        now.parts = _parts(now)
    return now.parts


def _parts(now: Mechanics) -> list[tuple[NDArray[np.intp], list[Joint]]]:
    of = np.arange(now.n // 3)
    moved = {}
    for name, joint in now.joints.items():
        reaches = np.sum([r.reach for r in joint.rows.values()], axis=0).reshape(-1, 3)
        moved[name] = np.flatnonzero(np.any(reaches > 0, axis=1))
        if len(moved[name]):
            of[np.isin(of, of[moved[name]])] = of[moved[name][0]]
    return [
        (
            3 * np.flatnonzero(of == k)[:, None] + np.arange(3),
            [j for n, j in now.joints.items() if len(moved[n]) and of[moved[n][0]] == k],
        )
        for k in np.unique(of)
    ]


def felt(system: System, z: Floats) -> Floats:
    """Sizes of the accelerations by the loads and reactions that act on each body in a solution.

    What loads could bring about anywhere among joined bodies says nothing of a heavy one beside a
    light one, but that it brings rounding.
    """
    now = system.now
    push = now.load_size.copy()
    for (name, word), at in system.index.items():
        push += np.abs(now.joints[name].rows[word].jacobian * z[at])
    quick = accelerations(now)
    return np.minimum(quick, np.maximum(push / now.mass, SHOWS * quick))


def force_size(now: Mechanics, joint: Joint, quick: Floats) -> float:
    """Size of the forces at the bodies of a joint, with such accelerations."""
    word = "n" if "n" in joint.rows else "x"
    touched = np.abs(joint.rows[word].jacobian) > 0
    if "y" in joint.rows:
        touched |= np.abs(joint.rows["y"].jacobian) > 0
    touched[2::3] = False
    return float(np.max((now.mass * quick)[touched], initial=0.0))


def even(matrix: Floats, mass: Floats) -> tuple[Floats, Floats]:
    """Sizes of rows and columns: accelerations in the metric of the mass, all else at most one."""
    n, tiny = len(mass), 1e-300
    rows, columns = np.ones(len(matrix)), np.ones(len(matrix))
    rows[:n] = columns[:n] = np.sqrt(mass)
    now = np.abs(matrix) / rows[:, None] / columns
    columns[n:] = np.maximum(np.max(now[:n, n:], axis=0, initial=tiny), tiny)
    now = np.abs(matrix) / columns
    rows[n:] = np.maximum(np.max(now[n:], axis=1, initial=tiny), tiny)
    return rows, columns


def motion(
    now: Mechanics, modes: Mapping[str, Choice], still: Mapping[str, Still]
) -> Motion | None:
    """Solve one combination; None where its equations contradict each other."""
    system = System(now, modes, still)
    rows, columns = even(system.matrix, now.mass)
    matrix = system.matrix / rows[:, None] / columns
    right = system.right / rows
    u, s, vt = np.linalg.svd(matrix)
    rank = int(np.sum(s > 1e-11 * s[0]))
    gap = float(s[rank - 1] / s[0])

    def solve(r: Floats, begin: Floats | float = 0.0) -> Floats:
        # the singular vectors mix parts that do not act on each other: what a large one leaves of
        # its rounding in a small one goes by refinement
        z = np.zeros(len(r)) + begin
        for _ in range(3):
            z = z + vt[:rank].T @ ((u.T @ (r - matrix @ z))[:rank] / s[:rank])
        return z

    z = solve(right)
    sign = float(np.linalg.slogdet(matrix)[0]) if rank == len(s) else 0.0
    if system.bends:
        bent = _bend(system, z, solve, rows, columns)
        if bent is None:
            return None
        z, sign, couples = bent[0], sign * bent[1], bent[2]
        for (at, _, _), couple in zip(system.bends, couples, strict=True):
            right[at] += couple / rows[at]

    def holds(z: Floats) -> bool:
        size = np.abs(matrix) @ np.abs(z) + np.abs(right) + system.sizes / rows
        size += 1e-13 * np.max(size)  # what has no load has only what the others leave by rounding
        return bool(np.all(np.abs(matrix @ z - right) <= 1e-7 * size))

    if rank < len(s) and not holds(z):
        return None
    free = _held(system, vt[rank:].T)
    margin, best = _margin(system, z / columns, free / columns[:, None], modes)
    best = solve(right, best * columns) / columns
    if rank < len(s) and not holds(best * columns):  # what seemed free is only nearly so
        margin, best = _margin(system, z / columns, free[:, :0], modes)
    z = best
    n = now.n
    size = float(np.max(np.abs(z[n:]), initial=0.0))
    return Motion(dict(modes), z[:n], z[n:], margin, gap, size, sign)


def _held(system: System, free: Floats) -> Floats:
    """What is left of the open directions where the reactions of pins in motion stay as they are.

    Their friction follows the size of these, which is no linear law.
    """
    turned = [system.index[name, w] for _, name, _ in system.bends for w in "xy"]
    if not turned or free.shape[1] == 0:
        return free
    _, s, vt = np.linalg.svd(free[turned])
    return free @ vt[int(np.sum(s > 1e-11)) :].T


def _bend(
    system: System,
    z: Floats,
    solve,  # type: ignore[no-untyped-def]
    rows: Floats,
    columns: Floats,
) -> tuple[Floats, float, Floats] | None:
    """Pins in motion: c + way * mu * radius * norm(R) = 0, by Newton's method.

    With the sign of its last determinant, and the couples c.
    """
    base = z
    units = []
    for at, _, _ in system.bends:
        e = np.zeros(len(z))
        e[at] = 1 / rows[at]
        units.append(solve(e))
    units_matrix = np.array(units).T
    c = np.zeros(len(system.bends))
    for _ in range(60):
        now = (base + units_matrix @ c) / columns
        f, jacobian = np.zeros(len(c)), np.eye(len(c))
        for k, (_, name, bound) in enumerate(system.bends):
            at = [system.index[name, w] for w in "xy"]
            r = now[at]
            size = float(np.hypot(*r))
            f[k] = c[k] + bound * size
            if size > 0:
                jacobian[k] += bound * (r @ (units_matrix[at] / columns[at][:, None])) / size
        step = np.linalg.lstsq(jacobian, f, rcond=None)[0]
        c = c - step
        if np.max(np.abs(step)) <= 1e-14 * max(np.max(np.abs(c)), 1e-300):
            break
    else:
        if not np.max(np.abs(step)) <= 1e-9 * np.max(np.abs(c)):
            return None
    return base + units_matrix @ c, float(np.linalg.slogdet(jacobian)[0]), c


def _margin(
    system: System, z: Floats, free: Floats, modes: Mapping[str, Choice]
) -> tuple[float, Floats]:
    """The smallest of all inequalities over their sizes, at best.

    One of which loads say no size (a turn about pins that forces alone bring about) has that of
    its own terms.
    """
    lines, quick = [], felt(system, z)
    for given in system.inequalities:
        size = given.size(system.now, quick)
        if not size > 0:
            size = float(np.abs(given.line) @ np.abs(z)) + abs(given.constant)
        if size > 0:
            lines.append((given.line / size, given.constant / size))
    curved = [
        (name, joint)
        for name, joint in system.now.joints.items()
        if isinstance(joint.liaison, Pin) and joint.liaison.mu is not None and modes[name].slip == 0
    ]

    def bound_of_pins(z: Floats) -> list[float]:
        found = []
        for name, joint in curved:
            x, y, c = (z[system.index[name, w]] for w in "xyc")
            size = max(force_size(system.now, joint, quick), abs(np.hypot(x, y)))
            if joint.mu_s * size > 0:
                found.append(float((joint.mu_s * np.hypot(x, y) - abs(c)) / (joint.mu_s * size)))
        return found

    if free.shape[1] == 0 or not lines:
        values = [float(line @ z + constant) for line, constant in lines] + bound_of_pins(z)
        return min(values, default=1.0), z
    from scipy.optimize import linprog

    # maximise e: line (z + free y) + constant >= e, e <= 1; where any y would do, one in which the
    # equations keep their digits
    scale = np.maximum(np.max(np.abs(np.array([line @ free for line, _ in lines])), axis=0), 1e-300)
    free = free / scale
    a = np.array([np.append(-(line @ free), 1.0) for line, _ in lines])
    b = np.array([line @ z + constant for line, constant in lines])
    k = free.shape[1]
    found = linprog(
        np.append(np.zeros(k), -1.0), a, b, bounds=[(-1e6, 1e6)] * k + [(None, 1.0)], method="highs"
    )
    if found.status != 0:
        return -np.inf, z
    z = z + free @ found.x[:k]
    return min([float(found.x[k]), *bound_of_pins(z)]), z


def distinct(found: list[Motion], now: Mechanics) -> list[Motion]:
    """One of each: motions are the same where their accelerations are."""
    kept: list[Motion] = []
    quick = accelerations(now)
    for one in found:
        size = np.maximum(quick, np.abs(one.acceleration))
        if not any(
            np.all(np.abs(one.acceleration - k.acceleration) <= 1e-6 * size + 1e-300) for k in kept
        ):
            kept.append(one)
    return kept
