"""Presentation of a result: chosen variables, pictures, pages."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from frot.dsl.messages.errors import fail
from frot.runtime.run_values import RunValues

if TYPE_CHECKING:
    from frot.runtime.number_arrays import Floats
    from frot.runtime.run_report import Event

    from frot.explained_events import ExplainedEvent


class Showing(RunValues):
    """Presentation of a `Result`."""

    def take(self, names: Sequence[str], times: Floats) -> dict[str, Floats]:
        """Values of variables at times of the run; FrotError (E0805) for a name that none has."""
        listed = self.at(times)
        others = [name for name in names if name not in self]
        asked = self.ask(others, times) if others else {}
        return {
            name: times if name == "time" else asked[name] if name in asked else listed[name]
            for name in names
        }

    def ask(self, names: Sequence[str], times: Floats | None = None) -> dict[str, Floats]:
        """Values of any variables of the language, at `times` or on the output grid.

        Those that the run did not list are evaluated by a second program over its steps, as
        `stick.tip.velocity`; a reaction that it did not compute by a second run. A vector has a
        column for each component.

        Raises:
            FrotError: E0805: there is no such variable; E0822: the second run went another way.
        """
        from frot.ask import ask

        at = self.time if times is None else times
        others = [name for name in names if name not in self]
        found = ask(self, others, at) if others else {}
        if len(others) == len(names):
            return found
        listed = self.at(at)
        own = {x: at if x == "time" else listed[x] for x in names if x not in others}
        return {name: found[name] if name in found else own[name] for name in names}

    def explain(self, events: Sequence[Event] | None = None) -> tuple[ExplainedEvent, ...]:
        """The events, or some of them, each with `direction` of its slip and `reason` in words.

        The numbers are those just before and just after each instant, by a second program over
        the recorded steps.

        Raises:
            FrotError: E0805: the model of the result is not known.
        """
        from frot.explained_events import explain_events

        return explain_events(self, self.events if events is None else events)

    def numbers(self, names: Sequence[str]) -> list[str]:
        """The variables, each vector as its components."""
        from frot.ask import components_of

        checked = None if self.model is None else self.model.checked
        return [
            one
            for name in names
            for one in ([name] if name in self or not checked else components_of(checked(), name))
        ]

    def unit(self, name: str) -> str:
        """The SI unit of a variable, `1` for a number."""
        found = {v.name: v.unit.name for v in self.program.variables}
        if name == "time" or name in found:
            return "s" if name == "time" else found[name]
        from frot.ask import find, unit_of_asked

        one = None if self.model is None else find(self.model.checked(), name)
        if one is None:
            raise fail("E0805", f"the model '{self.program.name}' has no variable '{name}'")
        return unit_of_asked(one)

    def __repr__(self) -> str:
        ended = f", ended: {self.fault}" if self.fault else ""
        return (
            f"<Result of {self.program.name}: {self.time[0]:g} s to {self.time[-1]:g} s, "
            f"{len(self.events)} events, {len(self) - 1} variables{ended}>"
        )

    def _repr_html_(self) -> str:
        """In a notebook: the page that plays the run, or its summary where there is none."""
        from html import escape

        from frot.dsl.messages.errors import FrotError

        try:
            from frot.view.show import framed, page

            return framed(page(self, fault=self.fault))
        except FrotError:
            return f"<pre>{escape(self.summary())}</pre>"

    def _ipython_key_completions_(self) -> list[str]:
        """The names that a notebook offers after `result[`."""
        from frot.ask import names_of

        own = list(self)
        more = [] if self.model is None else names_of(self.model.checked())
        return list(dict.fromkeys((*own, *more)))

    def to_frame(self) -> Any:
        """The listed variables on the output grid as a pandas DataFrame, its index the time in s.

        `frame.attrs["units"]` has the SI units. FrotError (E0820) where pandas is not installed.
        """
        try:
            import pandas
        except ImportError:
            raise fail(
                "E0820", "a frame needs pandas, which is not installed", help="pip install pandas"
            ) from None
        columns = {name: self[name] for name in self if name != "time"}
        frame = pandas.DataFrame(columns, index=pandas.Index(self.time, name="time"))
        frame.attrs["units"] = {"time": "s", **{name: self.unit(name) for name in columns}}
        return frame

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
            plot(self, path)
        else:
            plot_curves(self, path, xy or curves or (), xy=bool(xy))

    def view(
        self,
        path: str | Path | None = None,
        *,
        curves: Sequence[str] | None = None,
        at: float | None = None,
        speed: float = 1.0,
    ) -> Any:
        """Write a page `.html` that plays the run, a picture, or a film; see `write_view`.

        Without a path the page is shown: below the cell of a notebook, else it is `MODEL.html` in
        this folder, which a browser opens.
        """
        from frot.view.show import page, show_page, write_view

        if path is None:
            html = page(self, curves=curves, fault=self.fault)
            return show_page(html, self.program.name)
        return write_view(self, path, curves=curves, at=at, speed=speed, fault=self.fault)
