"""A percussion, a force without end in a time without length: `impulse`."""

from __future__ import annotations

from frot.compiler.mechanics.forces.force import ForceModel, Given, Load, value_of
from frot.compiler.mechanics.spatial import whole
from frot.compiler.mechanics.unsupported import refuse
from frot.compiler.translate.walk import is_fixed
from frot.dsl import Log
from frot.dsl.checked import Force


class Impulse(ForceModel):
    """The impulse `value` at the point `frame`, at the time `at`.

    As a force it acts with the factor `strike`, which is zero in the motion. The kernel puts it to
    one while it asks what the percussion does (impacts/percussions.h).
    """

    __slots__ = ()

    def check(self, force: Force, log: Log) -> None:
        """It happens once, at a time that parameters give."""
        at = value_of(force.arguments["at"])
        if not is_fixed(at):
            refuse(
                log,
                f"a time of the percussion '{force.name}' that changes in the run",
                at.span,
                "it may depend on parameters; what repeats is an `impulse` each",
            )

    def load(self, given: Given) -> Load:
        """One force; it has no potential."""
        assert given.strike is not None
        end = given.end("frame")
        return Load((end.under(given.strike * whole(given.value("value"))),), None)
