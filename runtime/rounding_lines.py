"""Lines of the summary of a run on rounding."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from frot.runtime.run_report import Figures

MASKED = 1e-10  # least part of an acceleration or a step for which there is a warning


def rounding_lines(figures: Figures) -> list[str]:
    """A line for each loss of digits."""
    lines = []
    if figures.crossings and figures.blurred:
        lines.append(f"  rounding made errors of {figures.blurred:.1e} there")
    elif figures.blurred > MASKED:
        lines.append(
            f"  warning: rounding may make {figures.blurred:.0e} of what moves in a step, "
            "whatever the tolerance"
        )
    if figures.masked > MASKED:
        lines.append(
            f"  warning: rounding may make {figures.masked:.0e} of an acceleration, whatever "
            "the tolerance: a body is held between ones so much heavier"
        )
    if figures.lost > 0:
        of = f"'{figures.lost_state}'" if figures.lost_state else "a state"
        lines.append(
            f"  warning: digits of {of} are lost: rounding of the rates makes "
            f"{figures.lost:.0e} of it, whatever the tolerance. Where its rates keep a sum, write "
            "that sum as an equation in the place of one rate"
        )
    return lines
