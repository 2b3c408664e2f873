"""Parts: what is put together at the start without regard to the rest, with functions of its own.

Places and speeds have each their parts: two bodies whose speeds are stated together need not be
placed together. A part's functions read nothing that another part is to find, so that what a start
costs grows with the number of parts, and what stands beside a part does nothing to it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import casadi as ca
from frot.compiler.equations.assembled import Assembled
from frot.compiler.lowering.groups import Grouping, Sets, pack_matrix, pack_rows, pack_spread
from frot.compiler.lowering.initial_values import Initial
from frot.compiler.lowering.islands import Island
from frot.compiler.symbolic.columns import scalars_of


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """The lists of frot_part, and the functions by their names there.

    The unknowns are the first `n_unknowns` of `q` or `v`; the first `n_own` of `y` follow from
    them.
    """

    n_unknowns: int
    n_own: int
    turns: tuple[int, ...]
    groups: tuple[int, ...]
    islands: tuple[int, ...]
    contacts: tuple[int, ...]
    stated: tuple[int, ...]
    guessed: tuple[int, ...]
    vectors: tuple[int, ...]
    blocks: tuple[int, ...]
    q: tuple[int, ...]
    v: tuple[int, ...]
    u: tuple[int, ...]
    p: tuple[int, ...]
    d: tuple[int, ...]
    y: tuple[int, ...]
    arguments: list[ca.SX]
    results: dict[str, list[ca.SX]]


@dataclass(frozen=True, slots=True, eq=False)
class _Kind:
    """What is to be found: `unknown`, with the results of `Initial` that speak of it.

    `through`: the unknowns of which each unknown of the early blocks is made.
    """

    prefix: str
    unknown: ca.SX
    stated: list[ca.SX]
    guessed: list[ca.SX]
    through: list[set[int]]

    @property
    def places(self) -> bool:
        return self.prefix == "place"


class Scene:
    """What is divided into parts. `sides`: the witnesses and reaches of the contacts."""

    def __init__(
        self,
        system: Assembled,
        grouping: Grouping,
        islands: Sequence[Island],
        initial: Initial,
        sides: tuple[ca.SX, ca.SX],
        state: Sequence[ca.SX],
    ) -> None:
        """`state`: t, q, v, u, p, d, y. The groups are in the order of their islands."""
        self._system, self._grouping, self._initial, self._sides = system, grouping, initial, sides
        self._state = state
        self._islands = {g: k for k, island in enumerate(islands) for g in island.groups}
        self._symbols = {
            x.element_hash(): (kind, k)
            for kind, own in enumerate(state[1:])
            for k, x in enumerate(scalars_of(own))
        }
        early = [(k, b) for k, b in enumerate(system.blocks) if not b.late]
        self._block_of = {
            y: k for k, b in early for y in range(b.first, b.first + int(b.residual.numel()))
        }

    def places(self) -> tuple[Part, ...]:
        """Join the coordinates whose speeds act on each other, or that something binds together."""
        system, initial = self._system, self._initial
        nq = int(system.q.numel())
        kind = _Kind("place", system.q, initial.position, initial.guessed, self._through(system.q))
        joined = [[k] for k in range(nq)]
        of_speed: dict[int, set[int]] = {}
        for k, speed in enumerate(system.q_speed):
            if speed >= 0:
                of_speed.setdefault(speed, set()).add(k)
        for turn in system.reduced.symbols.turns:
            four = range(turn.coordinate, turn.coordinate + 4)
            joined.append(list(four))
            for speed in turn.speeds:
                if speed >= 0:
                    of_speed.setdefault(speed, set()).update(four)
        of_groups = [
            {k for z in g.unknowns for k in of_speed.get(z, ())} for g in self._grouping.groups
        ]
        of_contacts = self._of_contacts(of_groups)
        gaps = (
            ca.jacobian(system.matrices.gap, system.q).T,
            ca.jacobian(system.matrices.gap, system.y).T,
        )
        for own, read in zip(of_contacts, _rows_read(*gaps, kind.through), strict=False):
            own |= read
        return self._divide(kind, [*joined, *of_groups, *of_contacts], of_groups, of_contacts)

    def speeds(self) -> tuple[Part, ...]:
        """Join the speeds of a group, or that a statement or a guess binds together."""
        system, initial = self._system, self._initial
        kind = _Kind(
            "speed", system.v, initial.velocity, initial.guessed_speeds, self._through(system.v)
        )
        of_groups = [set(g.unknowns[: g.n_speeds]) for g in self._grouping.groups]
        return self._divide(kind, of_groups, of_groups, self._of_contacts(of_groups))

    def _of_contacts(self, of_groups: Sequence[set[int]]) -> list[set[int]]:
        count = len(self._system.reduced.contact_rows) + len(self._system.elements)
        found: list[set[int]] = [set() for _ in range(count)]
        for group, own in zip(self._grouping.groups, of_groups, strict=True):
            for contact in group.contacts:
                found[contact] |= own
        return found

    def _through(self, unknown: ca.SX) -> list[set[int]]:
        """The unknowns on which each unknown of the early blocks depends."""
        system = self._system
        found: list[set[int]] = [set() for _ in range(system.y.numel())]
        for block in system.blocks:
            if block.late:
                continue
            own: set[int] = set().union(*_places_of(ca.jacobian(block.residual, unknown).T))
            for by in _places_of(ca.jacobian(block.residual, system.y).T):
                own = own.union(*(found[k] for k in by))
            for k in range(block.first, block.first + int(block.residual.numel())):
                found[k] = own
        return found

    def _divide(
        self,
        kind: _Kind,
        joined: Sequence[Iterable[int]],
        of_groups: Sequence[set[int]],
        of_contacts: Sequence[set[int]],
    ) -> tuple[Part, ...]:
        """The parts that are left when the items of each of `joined`, statement and guess are."""
        count = int(kind.unknown.numel())
        # the slopes of a counter speak of itself alone
        slopes = ca.jacobian(kind.stated[0], kind.unknown).T
        by_y = ca.jacobian(kind.stated[0], self._system.y).T
        stated = _rows_read(slopes, by_y, kind.through)
        guessed = self._guessed(kind)
        sets = Sets(count)
        for bound in (*joined, *stated, *guessed):
            items = list(bound)
            for k in items[1:]:
                sets.join(items[0], k)
        names = {k: i for i, k in enumerate(dict.fromkeys(sets.find(k) for k in range(count)))}
        members: list[dict[str, list[int]]] = [
            {name: [] for name in ("own", "groups", "contacts", "stated", "guessed")}
            for _ in range(max(len(names), 1))
        ]
        for name, lists in (
            *(("own", [[k] for k in range(count)]), ("groups", of_groups)),
            *(("contacts", of_contacts), ("stated", stated), ("guessed", guessed)),
        ):
            for item, bound in enumerate(lists):
                first = next(iter(bound), -1)
                members[names[sets.find(first)] if first >= 0 else 0][name].append(item)
        return tuple(self._make(kind, own) for own in members)

    def _guessed(self, kind: _Kind) -> list[set[int]]:
        """The unknowns that each guess binds: those of its vector."""
        if not kind.guessed:
            return []
        if not kind.places:
            slopes, items = (_places_of(x) for x in kind.guessed[2:4])
            return [own.union(*items[3 * i : 3 * i + 3]) for i, own in enumerate(slopes)]
        found = _places_of(kind.guessed[1])
        for own, first in zip(found, self._initial.vectors, strict=True):
            found[first] |= own
        return [found[first] for first in self._initial.vectors]

    def _make(self, kind: _Kind, own: dict[str, list[int]]) -> Part:
        system, initial = self._system, self._initial
        mine, guessed = set(own["own"]), own["guessed"]
        own_y = [k for k, x in enumerate(kind.through) if x and x <= mine]
        results = self._results(kind, own, own_y)
        seen = [x for result in results.values() for x in result]
        groups = [self._grouping.groups[g] for g in own["groups"]]
        if system.early:
            seen += [pack_rows(system, groups), system.matrices.gap[own["contacts"]]]
            seen += [pack_matrix(system, groups), *pack_spread(system, groups)]
        read = self._read(seen)
        y = self._needed([*own_y, *read[5]])
        y = [*own_y, *sorted(set(y) - set(own_y))]
        q, v = sorted(read[0]), sorted(read[1])
        if kind.places:
            q = [*own["own"], *sorted(set(q) - mine)]
        else:
            v = [*own["own"], *sorted(set(v) - mine)]
        places = [q, v, *(sorted(x) for x in read[2:5]), y]
        turns = enumerate(system.reduced.symbols.turns) if kind.places else ()
        vectors = [initial.vectors[k] for k in guessed] if kind.places else guessed
        return Part(
            n_unknowns=len(mine),
            n_own=len(own_y),
            turns=tuple(k for k, turn in turns if turn.coordinate in mine),
            groups=tuple(own["groups"]),
            islands=tuple(sorted({self._islands[g] for g in own["groups"] if g in self._islands})),
            contacts=tuple(own["contacts"]),
            stated=tuple(own["stated"]),
            guessed=tuple(guessed),
            vectors=tuple(guessed.index(k) for k in vectors),
            blocks=tuple(sorted({self._block_of[k] for k in y if k in self._block_of})),
            **{name: tuple(x) for name, x in zip("qvupdy", places, strict=True)},
            arguments=[
                self._state[0],
                *(x[own] for x, own in zip(self._state[1:], places, strict=True)),
            ],
            results=results,
        )

    def _results(
        self, kind: _Kind, own: dict[str, list[int]], own_y: list[int]
    ) -> dict[str, list[ca.SX]]:
        """By the names of the functions in the C text."""
        mine, stated, guessed, contacts = (own[x] for x in ("own", "stated", "guessed", "contacts"))
        found: dict[str, list[ca.SX]] = {}
        if stated:
            value, slopes, size, by_y = kind.stated
            found["stating"] = [
                *(value[stated], slopes[mine, stated], size[stated]),
                by_y[own_y, stated],
            ]
        if stated and own_y:
            blocks = [self._system.blocks[k] for k in sorted({self._block_of[y] for y in own_y})]
            residual = ca.vertcat(*(b.residual for b in blocks))
            by = kind.unknown[mine], self._system.y[own_y]
            found["slopes"] = [ca.jacobian(residual, x).T for x in by]
        if guessed and kind.places:
            missed, slopes, size = kind.guessed
            found["guessing"] = [missed[guessed], slopes[mine, guessed], size[guessed]]
        elif guessed:
            missed, squares, slopes, items, moves = kind.guessed
            of = [3 * k + i for k in guessed for i in range(3)]
            found["guessing"] = [
                *(missed[guessed], self._measured(squares, guessed)),
                *(slopes[mine, guessed], items[mine, of], moves[mine]),
            ]
        if contacts and kind.places:
            witness, reach = self._sides
            of = [3 * k + i for k in contacts for i in range(3)]
            found["sides"] = [witness[of], reach[contacts]]
        return {f"{kind.prefix}_{name}": results for name, results in found.items()}

    def _measured(self, squares: ca.SX, guessed: Sequence[int]) -> ca.SX:
        """The size of all guesses of the same dimension, of numbers 1."""
        kinds = [self._initial.guessed_dimensions[k] for k in guessed]
        sizes: list[ca.SX] = []
        for own in kinds:
            alike = [squares[k] for k, other in zip(guessed, kinds, strict=True) if other == own]
            sizes.append(ca.SX(1) if own.is_one else ca.sqrt(sum(alike, ca.SX(0))))
        return ca.vertcat(*sizes)

    def _read(self, values: Sequence[ca.SX]) -> list[set[int]]:
        """The places in q, v, u, p, d and y of what these are made of."""
        found: list[set[int]] = [set() for _ in self._state[1:]]
        for x in ca.symvar(ca.veccat(*values)) if values else ():
            kind, place = self._symbols.get(x.element_hash(), (-1, 0))
            if kind >= 0:
                found[kind].add(place)
        return found

    def _needed(self, y: Iterable[int]) -> list[int]:
        """Unknowns of early blocks, with those that their blocks read."""
        system = self._system
        waiting, found = [k for k in y if k in self._block_of], set[int]()
        while waiting:
            block = system.blocks[self._block_of[waiting.pop()]]
            own = range(block.first, block.first + int(block.residual.numel()))
            if block.first in found:
                continue
            found.update(own)
            waiting += [k for k in self._read([block.residual])[5] if k in self._block_of]
        return sorted(found)


def _places_of(slopes: ca.SX) -> list[set[int]]:
    """Of each column the rows that are not zero in every posture."""
    found: list[set[int]] = [set() for _ in range(slopes.shape[1])]
    for row, column in zip(*(list(x) for x in slopes.sparsity().get_triplet()), strict=True):
        found[column].add(row)
    return found


def _rows_read(slopes: ca.SX, by_blocks: ca.SX, through: list[set[int]]) -> list[set[int]]:
    """The unknowns that each equation reads, given its slopes, transposed."""
    found = _places_of(slopes)
    for own, read in zip(found, _places_of(by_blocks), strict=False):
        for k in read:
            own |= through[k]
    return found
