"""What a result does for those who look at it: chosen variables, pictures, pages."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, cast

from frot.dsl.messages.errors import fail

if TYPE_CHECKING:
    from frot.runtime.engine import Floats
    from frot.runtime.program import Program
    from frot.runtime.result import Result, Values

    from frot.model import Model


def nearest(name: str, names: Sequence[str]) -> str:
    """The remedy for a name that is not known: the nearest that is, if one is near."""
    from difflib import get_close_matches

    near = get_close_matches(name, names, 1)
    return f"did you mean '{near[0]}'?" if near else ""


class Showing(Mapping[str, "Floats"]):
    """A part of `Result`.

    `model` is what was run, `fault` what ended the run, if it did, `moving` are the inputs that
    were polynomials of time.
    """

    model: Model | None = None
    fault = ""
    moving: frozenset[str] = frozenset()
    program: Program

    @abstractmethod
    def at(self, t: float | Floats) -> Values:
        """Values at time t, or at each of an array of times."""

    @property
    def _whole(self) -> Result:
        return cast("Result", self)

    def take(self, names: Sequence[str], times: Floats) -> dict[str, Floats]:
        """Values of variables at times of the run; FrotError (E0805) for a name that none has."""
        known = self.at(times)
        return {name: times if name == "time" else known[self.known(name)] for name in names}

    def known(self, name: str) -> str:
        """The name, if a variable has it; FrotError (E0805) with the nearest else."""
        if name not in self:
            raise fail(
                "E0805",
                f"the model '{self.program.name}' has no variable '{name}'",
                help=nearest(name, list(self)),
            )
        return name

    def unit(self, name: str) -> str:
        """The SI unit of a variable, `1` for a number."""
        found = {v.name: v.unit.name for v in self.program.variables}
        return "s" if name == "time" else found[self.known(name)]

    def plot(
        self,
        path: str | Path,
        *,
        curves: Sequence[str] | None = None,
        xy: Sequence[str] | None = None,
    ) -> None:
        """Draw the run to a `.png`, `.svg` or `.pdf`: chosen curves, or a choice of them.

        `xy` are pairs of variables, the first of each the abscissa.
        """
        from frot.runtime.curves import plot_curves
        from frot.runtime.plotting import plot

        if curves is None and xy is None:
            plot(self._whole, path)
        else:
            plot_curves(self._whole, path, xy or curves or (), xy=bool(xy))

    def view(
        self,
        path: str | Path,
        *,
        curves: Sequence[str] | None = None,
        at: float | None = None,
        speed: float = 1.0,
    ) -> None:
        """Write a page `.html` that plays the run, a picture, or a film; see `write_view`."""
        from frot.view.show import write_view

        write_view(self._whole, path, curves=curves, at=at, speed=speed, fault=self.fault)
