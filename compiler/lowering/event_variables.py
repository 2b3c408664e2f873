"""What decides events, as variables of a second program: `Result.explain` reads them.

Of each contact with a normal the speed of its gap and its reaction; of each law of friction the
slip, the friction and its limits, and in space their directions in ground axes. The names below
begin with `PREFIX`, so that they are none of the language.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import casadi as ca
from frot.compiler.equations.assembled import Assembled
from frot.compiler.lowering.groups import elements_of
from frot.compiler.lowering.result_variables import (
    AXES,
    ENERGY,
    FORCE,
    LENGTH,
    NUMBER,
    RATE,
    VELOCITY,
    Listed,
)
from frot.compiler.mechanics.constraint import Constraint, FrictionBlock
from frot.compiler.mechanics.laws.elements import Bound, Element, JointMotion
from frot.dsl.quantities.dimensions import Dimension

PREFIX = "explain:"
_QUANTITIES = {RATE: "AngularVelocity", ENERGY: "Torque", NUMBER: "Angle"}


def event_variables(system: Assembled) -> tuple[Listed, ...]:
    """`contact:K:speed|reaction|gap`, `law:E:slip|friction|limit|limit_s`, with `.x .y .z`.

    K and E count as the kernel's contacts and elements. A law of several components has those of
    its vectors in ground axes, and in the plane one signed component. The documentation of
    `limit` and `limit_s` is their formula in words.
    """
    return (*_of_contacts(system), *_of_laws(system))


def _of_contacts(system: Assembled) -> Iterator[Listed]:
    reduced, matrices = system.reduced, system.matrices
    pairs = zip(reduced.mechanism.contacts, reduced.contact_rows, strict=True)
    for k, (link, rows) in enumerate(pairs):
        if not link.has_normal:
            continue
        row, head = rows.reaction[0], f"{PREFIX}contact:{k}:"
        units = (RATE, ENERGY, NUMBER) if link.turns else (VELOCITY, FORCE, LENGTH)
        yield _listed(f"{head}speed", matrices.rate[row], units[0])
        yield _listed(f"{head}reaction", system.lam[row], units[1])
        yield _listed(f"{head}gap", matrices.gap[k], units[2])


def _listed(name: str, value: ca.SX, of: Dimension, doc: str = "") -> Listed:
    return Listed(name, value, of, doc, _QUANTITIES.get(of, ""))


def _of_laws(system: Assembled) -> Iterator[Listed]:
    reduced = system.reduced
    links, geometry = reduced.mechanism.contacts, reduced.variables.geometry
    elements = elements_of(system)
    blocks = [(link, block, j) for link in links for j, block in enumerate(link.frictions)]
    place = 0
    for link, block, j in blocks:
        own = range(place, place + block.components)
        place += block.components
        ways: tuple[ca.SX, ...] = ()
        if not reduced.mechanism.model.planar and link.first:
            ways = geometry[link.liaison].ways_of_law(j)
        yield from _of_law(system, elements, own, _units(elements[own[0]]), ways)
        yield from _limits(system, elements[own[0]], own[0], _words(link, block))
    for k, element in enumerate(system.elements, place):
        slip, force = element.dimensions
        yield from _of_law(system, elements, [k], (slip, force), ())
        yield from _limits(system, elements[k], k, ("the bound", "the bound at rest"), force)


def _of_law(
    system: Assembled,
    elements: Sequence[Element],
    own: Sequence[int],
    units: tuple[Dimension, Dimension],
    ways: tuple[ca.SX, ...],
) -> Iterator[Listed]:
    """Slip and friction: along the ways in ground axes, else component after component."""
    rows = [elements[k].row for k in own]
    for name, values, unit in (
        ("slip", system.matrices.rate, units[0]),
        ("friction", system.lam, units[1]),
    ):
        parts = [values[row] for row in rows]
        head = f"{PREFIX}law:{own[0]}:{name}"
        if not ways:
            for k, part in enumerate(parts):
                yield _listed(f"{head}[{k}]", part, unit)
            continue
        pairs = zip(parts, ways, strict=True)
        vector = ca.densify(sum((x * way for x, way in pairs), ca.SX.zeros(3)))
        for axis, part in zip(AXES, ca.vertsplit(vector), strict=True):
            yield _listed(f"{head}.{axis}", part, unit)


def _limits(
    system: Assembled,
    element: Element,
    index: int,
    words: tuple[str, str],
    unit: Dimension | None = None,
) -> Iterator[Listed]:
    """The largest friction while it slips, and at rest."""
    size = _bounding(system.lam, element)
    for k, (name, doc) in enumerate(zip(("limit", "limit_s"), words, strict=True)):
        value = system.matrices.coefficients[2 * index + k] * size
        of = _units(element)[1] if unit is None else unit
        yield _listed(f"{PREFIX}law:{index}:{name}", value, of, doc)


def _bounding(lam: ca.SX, element: Element) -> ca.SX:
    """The reaction that bounds the friction: a size, or a sum of lengths."""
    if element.bound is Bound.VALUE:
        return ca.SX(1)
    if element.bound is Bound.NORMAL:
        return ca.fabs(lam[element.bounded_by[0]])
    total, at = ca.SX(0), 0
    for count in element.norms or (len(element.bounded_by),):
        total += ca.norm_2(lam[list(element.bounded_by[at : at + count])])
        at += count
    return total


def _units(element: Element) -> tuple[Dimension, Dimension]:
    turns = element.rolling or (element.bound is Bound.PIN and element.joint is JointMotion.TURNS)
    return (RATE, ENERGY) if turns else (VELOCITY, FORCE)


def _words(link: Constraint, block: FrictionBlock) -> tuple[str, str]:
    """The formulas of the limits of motion and of rest."""
    size = "N" if link.has_normal else " + ".join("|R|" for _ in link.norms or (1,))
    size = size if size in ("N", "|R|") else f"({size})"
    if block.turns:
        return f"delta {size}", f"delta_s {size}"
    if block.arm is not None:
        size = f"r {size}"
    return f"mu {size}", f"mu_s {size}"
