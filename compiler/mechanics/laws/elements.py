"""Laws of friction as rows of one table: what slides, rolls, turns in a pin, slips in a clutch."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from frot.compiler.mechanics.constraint import Constraint
from frot.compiler.mechanics.constraint_geometry import Rows
from frot.compiler.translate.walk import is_fixed


class Bound(Enum):
    """What bounds the friction of an element; the names of the kernel's `frot_bound`."""

    NORMAL = "FROT_BY_NORMAL"
    PIN = "FROT_BY_PIN"
    VALUE = "FROT_BY_VALUE"


@dataclass(frozen=True, slots=True)
class Element:
    """A law on one relative motion: the kernel's `frot_element`.

    `contact` is the place of its liaison, or of the text's item, among the kernel's contacts; `row`
    that of the motion, `bounded_by` those of the reaction that bounds it. `fixed`: its coefficients
    depend on parameters only.
    """

    contact: int
    bound: Bound
    row: int
    bounded_by: tuple[int, ...]
    rolling: bool
    fixed: bool


def link_elements(contact: int, link: Constraint, rows: Rows) -> list[Element]:
    """The elements of a liaison: sliding or turning, then rolling."""
    bound = Bound.NORMAL if link.has_normal else Bound.PIN
    found: list[Element] = []
    for friction in link.frictions:
        row = rows.rolling if friction.rolling else rows.tangent
        fixed = all(is_fixed(x) for x in friction.coefficients)
        found.append(Element(contact, bound, row, rows.reaction, friction.rolling, fixed))
    return found


def text_element(contact: int, row: int) -> Element:
    """The element of a call of `friction` in the equations."""
    return Element(contact, Bound.VALUE, row, (), False, False)
