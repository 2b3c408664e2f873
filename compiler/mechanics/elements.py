"""Laws of friction as rows of one table: what slides, rolls, turns in a pin, slips in a clutch."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from frot.compiler.lowering.symbols import Rows
from frot.compiler.lowering.walk import is_fixed
from frot.compiler.mechanics.mechanism import Joint, Pin
from frot.dsl.checked import Expression


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


def joint_elements(contact: int, joint: Joint, rows: Rows) -> list[Element]:
    """The elements of a liaison: sliding or turning, then rolling."""
    pin = isinstance(joint, Pin)
    bound = Bound.PIN if pin else Bound.NORMAL
    by = (rows.normal, rows.second) if pin else (rows.normal,)
    found: list[Element] = []
    if rows.tangent >= 0:
        fixed = _is_fixed(joint.mu) and _is_fixed(joint.mu_s)
        found.append(Element(contact, bound, rows.tangent, by, False, fixed))
    if rows.rolling >= 0:
        found.append(Element(contact, bound, rows.rolling, by, True, _is_fixed(joint.delta)))
    return found


def text_element(contact: int, row: int) -> Element:
    """The element of a call of `friction` in the equations."""
    return Element(contact, Bound.VALUE, row, (), False, False)


def _is_fixed(expression: Expression | None) -> bool:
    return expression is None or is_fixed(expression)
