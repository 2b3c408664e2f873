"""Elements of friction as rows of one table: sliding, rolling, pins, clutches."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from frot.compiler.mechanics.constraint import Constraint, FrictionBlock
from frot.compiler.mechanics.constraint_geometry import Rows
from frot.compiler.translate.walk import is_fixed


class Bound(Enum):
    """What bounds the friction of an element; the names of the kernel's `frot_bound`."""

    NORMAL = "FROT_BY_NORMAL"
    PIN = "FROT_BY_PIN"
    VALUE = "FROT_BY_VALUE"


class JointMotion(Enum):
    """What a law of a joint opposes; the names of the kernel's `frot_joint_motion`."""

    TURNS = "FROT_JOINT_TURNS"
    GOES = "FROT_JOINT_GOES"
    BOTH = "FROT_JOINT_BOTH"


@dataclass(frozen=True, slots=True)
class Element:
    """A law on one component of a relative motion: the kernel's `frot_element`.

    `contact` is the place of its liaison, or of the text's item, among the kernel's contacts. `row`
    is that of the component, `bounded_by` those of the reactions that bound it, of a joint `norms`
    of them for each reaction. `fixed`:
    its coefficients depend on parameters only. A law on a motion of several components is as many
    elements, which follow each other: this one is the `part`th of `parts`.
    """

    contact: int
    bound: Bound
    row: int
    bounded_by: tuple[int, ...]
    rolling: bool
    fixed: bool
    part: int = 0
    parts: int = 1
    norms: tuple[int, ...] = ()
    joint: JointMotion = JointMotion.TURNS


def link_elements(contact: int, link: Constraint, rows: Rows) -> list[Element]:
    """The elements of a liaison: sliding or turning, then rolling."""
    bound = Bound.NORMAL if link.has_normal else Bound.PIN
    found: list[Element] = []
    for block, own in zip(link.frictions, rows.of_laws, strict=True):
        by_speed = block.fades is not None or block.smooth is not None
        fixed = all(is_fixed(x) for x in block.coefficients) and not by_speed
        for part, row in enumerate(own):
            found.append(
                Element(
                    contact,
                    bound,
                    row,
                    bounded_by=link.bounding(rows),
                    rolling=block.turns,
                    fixed=fixed,
                    part=part,
                    parts=len(own),
                    norms=link.norms,
                    joint=_motion_of(block),
                )
            )
    return found


def _motion_of(block: FrictionBlock) -> JointMotion:
    """Of a law of a joint."""
    arms = [block.arm or way.arm for way in block.ways] or [block.arm]
    if all(arm is None for arm in arms):
        return JointMotion.GOES
    return JointMotion.TURNS if all(arm is not None for arm in arms) else JointMotion.BOTH


def text_element(contact: int, row: int) -> Element:
    """The element of a call of `friction` in the equations."""
    return Element(contact, Bound.VALUE, row, (), False, False)
