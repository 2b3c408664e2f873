"""Parts of a scene as plain arrays, independent of how they are drawn.

Lengths in m, forces in N, ground axes, unless a name says otherwise.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from frot.view.outline import Array, Outline

if TYPE_CHECKING:
    from frot.runtime.run_report import Event


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """Something drawn in the axes of `owner`, empty for the ground.

    `kind` is body, curve, surface, frame or liaison. `shapes` has one outline, or one for each
    moment where time changes it. `modes` names the liaison that colours it.
    """

    name: str
    kind: str
    owner: str
    shapes: tuple[Outline, ...]
    number: int = 0
    modes: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Joining:
    """Something drawn from one point to another: `ends` (moments x 2 x 3)."""

    name: str
    kind: str
    shape: Outline
    ends: Array


@dataclass(frozen=True, slots=True, eq=False)
class Touching:
    """A liaison with its reaction, moment by moment.

    `places` (n x 3) where it acts; `normal` and `along` (n x 3), the parts of the force on the body
    that moves along the normal and beside it, `modes` (n) of MODES or None, `cone` the angle of
    friction, `direction` (n x 3) the normal or None.
    """

    name: str
    kind: str
    places: Array
    normal: Array
    along: Array
    modes: Array | None
    direction: Array | None
    cone: float


@dataclass(frozen=True, slots=True, eq=False)
class Scene:
    """A scene to draw: `poses` (n x 7) by owner at each of `times`.

    `small` is the size of symbols, `size` that of the mechanism; `centre`, `half` (3) and `reach`
    of all that moves; `follow`: it goes far for its size. `up` is the axis against gravity.
    """

    name: str
    doc: str
    planar: bool
    times: Array
    poses: dict[str, Array]
    parts: tuple[Part, ...]
    joinings: tuple[Joining, ...]
    touching: tuple[Touching, ...]
    events: tuple[Event, ...]
    small: float
    size: float
    centre: Array
    middles: Array
    reach: float
    half: Array
    follow: bool
    up: Array
