"""Tells which unknowns nothing determines and which equations are too many."""

from __future__ import annotations

from collections.abc import Sequence

from frot.compiler.equations.index import Unbalanced
from frot.compiler.equations.origins import Origin, Unknown
from frot.dsl import Label, Log

MOST_NAMED = 8


def report_unbalanced(
    found: Unbalanced,
    unknowns: Sequence[Unknown],
    origins: Sequence[Origin],
    log: Log,
) -> None:
    """Report E0603 for the unknowns and E0604 for the equations, each with its places."""
    if found.unknowns and all(unknowns[j].span is None for j in found.unknowns):
        moved = _listed([unknowns[j].name for j in found.unknowns])
        log.report(
            "E0603",
            f"too few equations: nothing determines the acceleration of {moved}, for forces that "
            "follow accelerations take its inertia away",
            origins[found.equations[0]].span if found.equations else None,
            help="let such a force act through a state, or give the body another mass",
        )
        return
    if found.unknowns:
        names = [unknowns[j].name for j in found.unknowns]
        spans = {unknowns[j].span: unknowns[j].name for j in found.unknowns}
        first, *others = [(s, n) for s, n in spans.items() if s is not None]
        one = len(names) == 1
        log.report(
            "E0603",
            f"too few equations: nothing determines {_listed(names)}"
            if one
            else f"too few equations for the unknowns {_listed(names)}",
            first[0],
            labels=tuple(Label(s, f"{n!r}") for s, n in others[:MOST_NAMED]),
            help="write an equation for it, connect it or give it a value"
            if one
            else "write equations for them, connect them or give them values",
        )
    if found.equations:
        texts = [_named(origins[i]) for i in found.equations]
        places = list(dict.fromkeys(origins[i].span for i in found.equations))
        log.report(
            "E0604",
            "too many equations: "
            + (
                f"{texts[0]} determines nothing that is left open"
                if len(texts) == 1
                else f"one of these {len(texts)} has no unknown of its own: {_listed(texts, '')}"
            ),
            places[0],
            labels=tuple(Label(s, "one of them") for s in places[1:MOST_NAMED]),
            help="leave one out, or declare what it should determine as a variable",
        )


def _named(origin: Origin) -> str:
    return f"`{origin.text}`" + (f" of {origin.owner}" if origin.owner else "")


def _listed(names: Sequence[str], quote: str = "'") -> str:
    shown = [f"{quote}{n}{quote}" for n in names[:MOST_NAMED]]
    more = len(names) - len(shown)
    return ", ".join(shown) + (f" and {more} more" if more else "")
