"""Dependences at one instant: inputs on outputs, parameters on the motion after its start.

The unknowns of a block, of a group of the core, and all discrete values together are nodes: each
depends on all that its equations name. Modes change at the instant at which their group is pushed
otherwise, so that a reaction depends on every input of its group.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import casadi as ca
from frot.compiler.lowering.groups import Group, pack_spread
from frot.compiler.lowering.islands import dynamics_of
from frot.compiler.lowering.lower import Lowered
from frot.compiler.lowering.lower_parameters import parameters_needed
from frot.compiler.lowering.state import state_arguments
from frot.compiler.symbolic.columns import column

TIME = "time"
# States that a rate depends on, beyond which they are not listed: all may be among them.
MOST = 100


@dataclass(frozen=True, slots=True)
class Influence:
    """Of each listed variable the inputs, and `time`, that act on it at once.

    `states`: of each listed variable the numbers of the states that do; `rates`: of the rate of
    each state the same two, None where it depends on more than MOST. `started`: of each parameter
    whether it acts at the start alone; `needed`: the independent parameters that the value of each
    follows from.
    """

    inputs: tuple[tuple[str, ...], ...]
    states: tuple[tuple[int, ...], ...]
    rates: tuple[tuple[tuple[str, ...], tuple[int, ...]] | None, ...]
    started: tuple[bool, ...]
    needed: tuple[tuple[str, ...], ...]


def influence_of(lowered: Lowered) -> Influence:
    """Found in the structure of the equations, whatever the values are."""
    graph = _Graph(lowered)
    needed = _needed(lowered)
    names = [TIME, *(x.name for x in lowered.reduced.symbols.inputs)]
    variables, rates = graph.variables(), graph.rates()

    def inputs_in(known: int) -> tuple[str, ...]:
        return tuple(name for k, name in enumerate(names) if known >> k & 1)

    direct = {
        x.name
        for k, x in enumerate(lowered.reduced.symbols.parameters)
        if graph.in_motion() >> (len(names) + k) & 1
    }
    acting = {source for name, sources in needed.items() if name in direct for source in sources}
    started = tuple(
        acting.isdisjoint(needed[x.name]) and x.name not in direct
        for x in lowered.reduced.symbols.parameters
    )
    return Influence(
        tuple(inputs_in(known) for known in variables),
        tuple(graph.states_in(known) for known in variables),
        tuple(
            (inputs_in(known), graph.states_in(known))
            if len(graph.states_in(known)) <= MOST
            else None
            for known in rates
        ),
        started,
        tuple(needed[x.name] for x in lowered.reduced.symbols.parameters),
    )


def _needed(lowered: Lowered) -> dict[str, tuple[str, ...]]:
    """The independent parameters behind each one; an independent one stands for itself."""
    symbols = lowered.reduced.symbols
    direct = {x.name: [y.name for y in parameters_needed(x, symbols)] for x in symbols.parameters}
    found: dict[str, tuple[str, ...]] = {}

    def sources(name: str) -> tuple[str, ...]:
        if name not in found:
            behind = (source for one in direct[name] for source in sources(one))
            found[name] = tuple(dict.fromkeys(behind)) if direct[name] else (name,)
        return found[name]

    for name in direct:
        sources(name)
    return found


class _Graph:
    """Nodes and what they depend on: a set of knowns (time, inputs, parameters, states) as bits."""

    def __init__(self, lowered: Lowered) -> None:
        """Follow the equations until nothing is added."""
        self._lowered = lowered
        system, s = lowered.system, lowered.reduced.symbols
        self._state = state_arguments(system)
        self._first_state = 1 + int(s.u.numel()) + int(s.p.numel())
        self._knowns = self._first_state + int(system.q.numel()) + int(system.v.numel())
        unknowns = system.y, system.z, system.lam, self._state[5]
        self._symbols = ca.vertcat(s.t, s.u, s.p, system.q, system.v, *unknowns)
        self._groups = lowered.grouping.groups
        self._first_group = len(system.blocks)
        self._discrete = self._first_group + len(self._groups)
        self._node = self._nodes_of_symbols()
        numbered = enumerate(self._groups, self._first_group)
        self._of_contact = {k: number for number, group in numbered for k in group.contacts}
        self._reach = self._closed([*self._blocks(), *self._cores(), self._switches()])
        (values,) = self._of(lowered.whole.functions["variables"])
        self._values = self._all(values)

    def _nodes_of_symbols(self) -> list[int]:
        system = self._lowered.system
        of_y = [-1] * int(system.y.numel())
        for number, block in enumerate(system.blocks):
            for k in range(int(block.residual.numel())):
                of_y[block.first + k] = number
        of_z, of_lam = [-1] * int(system.z.numel()), [-1] * int(system.lam.numel())
        for number, group in enumerate(self._groups, self._first_group):
            for k in group.unknowns:
                of_z[k] = number
            for k in group.rows:
                of_lam[k] = number
        return [*of_y, *of_z, *of_lam, *[self._discrete] * int(self._state[5].numel())]

    def _blocks(self) -> list[ca.SX]:
        return [block.residual for block in self._lowered.system.blocks]

    def _cores(self) -> list[ca.SX]:
        return [self._core(group) for group in self._groups]

    def _core(self, group: Group) -> ca.SX:
        """All that the motion of a group follows from."""
        system = self._lowered.system
        effect, _ = pack_spread(system, [group])
        return column(ca.vec(x) for x in [*dynamics_of(system, [group]), effect])

    def _switches(self) -> ca.SX:
        """Conditions, and what events of the text do."""
        update = self._lowered.whole.functions.get("update")
        return column(
            [self._lowered.switches.conditions, *(() if update is None else self._of(update))]
        )

    def _of(self, function: ca.Function) -> list[ca.SX]:
        """The results of a function of the solution."""
        system = self._lowered.system
        given = [*self._state, system.z, system.lam]
        others = [function.sx_in(k) for k in range(len(given), function.n_in())]
        return list(function.call([*given, *others]))

    def _rows(self, value: ca.SX) -> list[tuple[int, set[int]]]:
        """Of each scalar the knowns and the nodes that it names."""
        found: list[tuple[int, set[int]]] = [(0, set()) for _ in range(int(value.numel()))]
        if not value.numel():
            return found
        pattern = ca.jacobian_sparsity(ca.vec(value), self._symbols)
        for row, at in zip(*pattern.get_triplet(), strict=True):
            known, nodes = found[row]
            if at < self._knowns:
                found[row] = (known | 1 << at, nodes)
            elif self._node[at - self._knowns] >= 0:
                nodes.add(self._node[at - self._knowns])
        return found

    def _closed(self, equations: Iterable[ca.SX]) -> list[int]:
        direct, behind = list[int](), list[set[int]]()
        for value in equations:
            rows = self._rows(value)
            direct.append(_union(known for known, _ in rows))
            behind.append({node for _, nodes in rows for node in nodes})
        # Modes that the text reads are among the discrete values.
        behind[self._discrete] |= {
            self._of_contact[k] for k, _ in self._lowered.reduced.variables.modes.of.values()
        }
        changed = True
        while changed:
            before = list(direct)
            for number, nodes in enumerate(behind):
                direct[number] |= _union(direct[node] for node in nodes)
            changed = before != direct
        return direct

    def _all(self, value: ca.SX) -> list[int]:
        return [
            known | _union(self._reach[node] for node in nodes)
            for known, nodes in self._rows(value)
        ]

    def variables(self) -> list[int]:
        """Of each listed variable, the modes first."""
        modes = [self._reach[self._of_contact[k]] for k in self._contacts_with_mode()]
        return [*modes, *self._values[len(modes) :]]

    def rates(self) -> list[int]:
        """Of the rate of each state."""
        system = self._lowered.system
        return self._all(column([ca.vec(system.rates), system.z[: system.v.numel()]]))

    def states_in(self, known: int) -> tuple[int, ...]:
        """The numbers of the states among knowns."""
        numbered = enumerate(range(self._first_state, self._knowns))
        return tuple(k for k, bit in numbered if known >> bit & 1)

    def _contacts_with_mode(self) -> list[int]:
        """The contacts, in the order of the modes."""
        joints = self._lowered.reduced.mechanism.contacts
        elements = range(len(joints), len(joints) + len(self._lowered.system.elements))
        return [*(k for k, joint in enumerate(joints) if joint.first), *elements]

    def in_motion(self) -> int:
        """The knowns that act on anything once the motion has begun."""
        system = self._lowered.system
        others = [system.rates, system.matrices.power, system.invariants.values]
        return _union([*self._reach, *self._values, *self._all(column(ca.vec(x) for x in others))])


def _union(sets: Iterable[int]) -> int:
    found = 0
    for one in sets:
        found |= one
    return found
