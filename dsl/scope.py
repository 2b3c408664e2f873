"""The names of a model, what each stands for, and the search for a name that was meant."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from dataclasses import dataclass, field

from frot.dsl import checked
from frot.dsl.catalogue import TYPES, plain
from frot.dsl.diagnostics import Log
from frot.dsl.dimensions import REAL, Type
from frot.dsl.source import Source, Span

Entity = (
    checked.Parameter
    | checked.Input
    | checked.Output
    | checked.Body
    | checked.Frame
    | checked.Curve
    | checked.Liaison
    | checked.Force
)


class Refused:
    """What a name stands for when its declaration was refused: silence about its uses."""


REFUSED = Refused()
BUILT_IN = ("time", "pi", "ground")


@dataclass(slots=True)
class Scope:
    """What a pass over a model needs: names, the values known so far, and the log.

    `open` is set where names may come from a place that is not read (`extends`, `import`): names
    not found are then not told.
    """

    source: Source
    log: Log
    planar: bool
    ground: checked.Body
    ground_line: checked.Curve
    lost: frozenset[str]
    open: bool = False
    names: dict[str, Entity | Refused] = field(default_factory=dict)
    values: dict[checked.Parameter, object] = field(default_factory=dict)

    @property
    def size(self) -> int:
        """The number of components of a vector."""
        return 2 if self.planar else 3

    def knows(self, name: str) -> bool:
        """Whether a missing name must be told: not if its declaration could not be read."""
        return not (self.open or name in self.lost)


def near(word: str, names: Iterable[str]) -> str:
    """The name most like `word`, accents and capitals apart, or an empty text."""
    folded: dict[str, str] = {}
    for name in names:
        folded.setdefault(plain(name).lower(), name)
    close = difflib.get_close_matches(plain(word).lower(), folded, n=1, cutoff=0.6)
    return folded[close[0]] if close else ""


def did_you_mean(word: str, names: Iterable[str]) -> str:
    """The help text that proposes a name, or an empty text."""
    found = near(word, names)
    return f"did you mean {found!r}?" if found else ""


def built_in_world(source: Source) -> tuple[checked.Body, checked.Curve]:
    """`ground` and `ground.line` of a planar model."""
    ground = checked.Body("ground", None, {}, None)
    here = Span(source, 0, 0)

    def pair(x: float, y: float, kind: Type) -> checked.Vector:
        items = (checked.Literal(x, kind, here), checked.Literal(y, kind, here))
        return checked.Vector(items, Type("real", kind.dimension, (2,)), here)

    arguments = {"through": pair(0.0, 0.0, TYPES["Length"]), "direction": pair(1.0, 0.0, REAL)}
    return ground, checked.Curve("line", ground, "line", arguments, None)
