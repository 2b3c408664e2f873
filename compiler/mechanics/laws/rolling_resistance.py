"""A couple opposed to rolling, bounded by delta N: `rolling_resistance`."""

from __future__ import annotations

from frot.compiler.mechanics.constraint import Constraint, FrictionBlock
from frot.compiler.mechanics.laws.law import DryLaw
from frot.compiler.mechanics.points import point_body, turns
from frot.dsl import Log
from frot.dsl.checked import Law

_TANGENT_PLANE = 2


class RollingResistance(DryLaw):
    """The couple of a figure on a curve; delta is a length."""

    __slots__ = ()

    coefficients = ("delta", "delta_s")

    def fits(self, link: Constraint, law: Law, log: Log) -> bool:
        """What touches turns."""
        moving = point_body(link.ends[1])
        if moving.shape is None or moving.shape.turns or turns(point_body(link.ends[0])):
            return True
        log.report(
            "E0511",
            f"rolling resistance on '{moving.name}', which does not turn",
            law.span,
            help="a particle has no angle; use a disc or a ring",
        )
        return False

    def elements(self, link: Constraint, law: Law) -> tuple[FrictionBlock, ...]:
        """In the tangent plane, in the plane about its normal; of tangent curves as of surfaces."""
        coefficients = self.coefficients_of(law)
        components = _TANGENT_PLANE if any(link.uncounted) else link.slip_components
        return (FrictionBlock(*coefficients, rolling=True, components=components),)
