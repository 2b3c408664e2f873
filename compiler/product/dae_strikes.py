"""Impacts and percussions at an instant of the DAE, by the impact law of the kernel."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from frot.compiler.product.dae_instant import Instant, Vector
from frot.compiler.product.dae_modes import put_open
from frot.dsl.messages.errors import fail
from frot.runtime.impact_law import (
    SOLVED,
    Block,
    friction,
    held,
    normal,
    reading,
    solve_impact,
)

if TYPE_CHECKING:
    from frot.compiler.product.dae_impacts import ContactRow, LawRow

# Part of the geometric mean of two effects below which rows do not act on each other.
NO_EFFECT = 1e-13


@dataclass(slots=True, eq=False)
class Struck:
    """Impulses of the rows, energy lost, phases."""

    impulses: Vector
    lost: float = 0.0
    phases: int = 0


@dataclass(slots=True, eq=False)
class Component:
    """Contacts that act on each other, as the rows and blocks of the kernel's problem."""

    rows: list[int] = field(default_factory=list)
    blocks: list[Block] = field(default_factory=list)
    parts: list[tuple[ContactRow, int]] = field(default_factory=list)

    def take(self, row: int) -> int:
        """The place of one more row."""
        self.rows.append(row)
        return len(self.rows) - 1


class Scene:
    """The rows, laws and effects of an instant."""

    def __init__(self, at: Instant, before: Vector) -> None:
        """Evaluate them; `before` is the mode before the event."""
        self.at, self.before = at, before
        self.impacts = at.dae.impacts
        z = at.z()
        self.effect = at.of("effect", z=z)
        self.coefficients = at.of("coefficients", z=z)
        self.rate, self.size = at.rates()
        self.given_back = np.array(self.impacts.restitution(at.p)[0]).ravel()
        self.can_part = at.parting()

    def closed(self) -> dict[str, list[int]]:
        """Of each liaison that is closed its rows."""
        found: dict[str, list[int]] = {}
        mode = self.at.mode
        for one in self.impacts.normals:
            if one.mode < 0 or mode[one.mode] != 0:
                found.setdefault(one.name, []).append(one.row)
        for law in self.impacts.laws:
            if mode[law.closed] != 0 and law.bounded_by:
                name = law.name.rpartition(".")[0]
                found.setdefault(name, []).extend((*law.bounded_by, law.row))
        return found

    def components(self) -> Iterator[set[str]]:
        """The closed liaisons that act on each other."""
        rows = self.closed()
        own = np.sqrt(np.abs(np.diag(self.effect)))
        acts = np.abs(self.effect) > NO_EFFECT * np.outer(own, own)
        left = dict(rows)
        while left:
            found, new = set(), {next(iter(left))}
            while new:
                found |= new
                places = [r for name in new for r in rows[name]]
                new = {
                    name
                    for name, its in rows.items()
                    if name not in found
                    and (acts[np.ix_(places, its)].any() or acts[np.ix_(its, places)].any())
                }
            for name in found:
                left.pop(name)
            yield found

    def meets(self, one: ContactRow) -> bool:
        """Whether the contact closes with speed."""
        was = self.before[one.mode] != 0
        return (
            one.name in self.can_part
            and one.mode >= 0
            and self.at.mode[one.mode] != 0
            and self.rate[one.row] < (-self.size[one.row] if was else 0)
        )

    def component(self, names: set[str]) -> Component:
        """The problem of some liaisons."""
        found = Component()
        for k, one in enumerate(self.impacts.normals):
            if one.name in names:
                self._add_contact(found, one, self.given_back[k])
        for law in self.impacts.laws:
            if law.name.rpartition(".")[0] in names and law.bounded_by:
                self._add_law(found, law)
        return found

    def _add_contact(self, found: Component, one: ContactRow, e: float) -> None:
        at = found.take(one.row)
        if one.reads:
            found.blocks.append(reading(at))
        elif one.name not in self.can_part:
            found.blocks.append(held(at))
        else:
            meets = self.meets(one)
            rests = not meets and self.rate[one.row] <= self.size[one.row]
            given = 0.0 if meets and -self.rate[one.row] < self.at.slow else e
            found.parts.append((one, at))
            found.blocks.append(normal(at, given, one.rule, is_zero=rests))

    def _add_law(self, found: Component, law: LawRow) -> None:
        if law.bounded_by[0] not in found.rows:
            for row in law.bounded_by:
                found.blocks.append(reading(found.take(row)))
        first = found.rows.index(law.bounded_by[0])
        sticks = self.at.mode[law.mode] == 1 or abs(self.rate[law.row]) <= self.size[law.row]
        mu, mu_s = self.coefficients[law.coefficient]
        found.blocks.append(
            friction(
                found.take(law.row),
                1,
                first,
                mu,
                mu_s,
                n_bounding=len(law.bounded_by),
                norm=law.norms,
                is_zero=bool(sticks),
            )
        )

    def speeds(self, component: Component) -> Vector:
        """Of the rows, zero of those that are held or read."""
        found = np.zeros(len(component.rows))
        for block in component.blocks:
            if block.rule not in (held(0).rule, reading(0).rule):
                found[block.at] = self.rate[component.rows[block.at]]
        return found

    def act(self, component: Component, change: Vector | None, struck: Struck) -> None:
        """Solve the impact of a component and let it act; `change`: of a percussion, its rows."""
        rows = component.rows
        effect = self.effect[np.ix_(rows, rows)]
        blocks, speeds = list(component.blocks), self.speeds(component)
        if change is not None:
            effect, speeds = _with_percussion(effect, speeds, blocks, change[rows])
        found = solve_impact(self.at.dae.kernel(), effect, speeds, blocks)
        if found.status != SOLVED:
            names = ", ".join(sorted({one.name for one, _ in component.parts})) or "no contact"
            raise fail(
                "E0905",
                f"no impulses satisfy the laws of {names} at t = {self.at.t:.17g}",
                help="look at the coefficients of restitution and of friction",
            )
        impulses = np.zeros(len(self.rate))
        for block in blocks:
            places = range(block.at, min(block.at + block.n, len(rows)))
            for i in places if block.rule != reading(0).rule else ():
                impulses[rows[i]] = found.p[i]
        self.at.x = self.at.of("strike", impulses).ravel()
        for one, place in component.parts:
            if found.u[place] > 0:
                put_open(self.at, one.name)
        struck.impulses += impulses
        struck.lost += float(np.sum(found.lost[: len(component.blocks)]))
        struck.phases += found.phases


def _with_percussion(
    effect: Vector, speeds: Vector, blocks: list[Block], change: Vector
) -> tuple[Vector, Vector]:
    """The problem with a row that carries the percussion: a mass stopped by the whole of it.

    See `frot_add_percussion` (kernel/impacts/impact_rows.c).
    """
    own = np.diag(effect)
    most = max(float(own.max()), 0.0)
    sizes = np.where(own > 0, np.abs(change) / np.sqrt(np.where(own > 0, own, 1)), 0)
    sizes = np.where(own > 0, sizes, np.abs(change) * np.sqrt(most))
    whole = float(sizes.max()) / np.sqrt(most)
    n = len(speeds)
    wide = np.zeros((n + 1, n + 1))
    wide[:n, :n], wide[:n, n], wide[n, n] = effect, change / whole, most
    for block in blocks:
        if block.is_zero:
            block.restitution = 0.0
    blocks.append(normal(n))
    return wide, np.append(speeds, -most * whole)


def meet(at: Instant, before: Vector) -> Struck:
    """The impacts of contacts that close with speed."""
    scene = Scene(at, before)
    struck = Struck(np.zeros(len(scene.rate)))
    meeting = {one.name for one in scene.impacts.normals if scene.meets(one)}
    for names in scene.components() if meeting else ():
        if names & meeting:
            scene.act(scene.component(names), None, struck)
    return struck


def strike(at: Instant, before: Vector) -> Struck:
    """The percussions that are due, and what contacts do to them."""
    impacts = at.dae.impacts
    due = [at.mode[k] for k in impacts.due]
    struck = Struck(np.zeros(len(impacts.rows)))
    if impacts.percussion is None or not any(due):
        return struck
    scene = Scene(at, before)
    x, change = (
        np.array(part).ravel()
        for part in impacts.percussion(at.t, at.x, at.z(), at.u, at.p, at.mode, due)
    )
    free = x - at.x
    for names in scene.components():
        component = scene.component(names)
        if np.any(change[component.rows] != 0):
            scene.act(component, change, struck)
    at.x = at.x + free
    for k in impacts.due:
        at.mode[k] = 0.0
    return struck
