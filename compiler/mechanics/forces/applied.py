"""A force at a point of a body, in ground axes: `on`."""

from __future__ import annotations

from frot.compiler.mechanics.forces.force import ForceModel, Given, Load
from frot.compiler.mechanics.spatial import whole


class Applied(ForceModel):
    """The force `value` at the point `frame`."""

    __slots__ = ()

    def load(self, given: Given) -> Load:
        """One force; it has no potential."""
        end = given.end("frame")
        return Load((end.under(whole(given.value("value"))),), None)
