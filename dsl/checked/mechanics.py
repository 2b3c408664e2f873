"""Bodies, what is fixed to them, liaisons with their laws, and forces."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from frot.dsl.checked.expressions import Owner

if TYPE_CHECKING:
    from collections.abc import Mapping

    from frot.dsl.catalogue import ForceKind, LawKind, LiaisonKind, Shape
    from frot.dsl.checked.expressions import Expression, Variable
    from frot.dsl.messages.source import Span


@dataclass(frozen=True, slots=True, eq=False)
class World:
    """Gravity: its magnitude and its direction, one of `+x -x +y -y +z -z` or a vector."""

    gravity: Expression | None
    down: str | Expression
    span: Span | None


@dataclass(frozen=True, slots=True, eq=False)
class Body(Owner):
    """A body: `arguments` holds every argument of its shape, defaults filled where there is one.

    `ground` is the one `Body` whose `shape` is None.
    """

    name: str
    shape: Shape | None
    arguments: Mapping[str, Expression]
    span: Span | None
    doc: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Frame(Owner):
    """A frame fixed to a body: origin in the owner's axes and a rotation about an axis of these.

    `axis` is a vector, or the literal `x`, `y` or `z`, that of planar models.
    """

    name: str
    owner: Body | Frame
    origin: Expression | None
    angle: Expression | None
    axis: Expression | str
    span: Span
    doc: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Curve:
    """A curve on a body or frame; `kind` is `line` (`through`, `direction`) and, later, others.

    `ground.line` is a `Curve` too, with `span` None.
    """

    name: str
    owner: Body | Frame
    kind: str
    arguments: Mapping[str, Expression]
    span: Span | None
    doc: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Surface:
    """A surface on a body or frame; `ground.plane` has `span` None."""

    name: str
    owner: Body | Frame
    kind: str
    arguments: Mapping[str, Expression]
    span: Span | None
    doc: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class BodyPoint(Owner):
    """A named frame of a body's shape: `rod.start`; a bare body name means its `G`."""

    body: Body
    name: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class BodyGeometry:
    """A named geometry of a body's shape: `hoop.rim`, or an item of one, `plate.sides[2]`."""

    body: Body
    name: str
    span: Span

    @property
    def centre(self) -> BodyPoint | None:
        """The frame of the same name, where there is one: the centre of a face."""
        shape = self.body.shape
        named = shape is not None and self.name in shape.frames
        return BodyPoint(self.body, self.name, self.span) if named else None


@dataclass(frozen=True, slots=True, eq=False)
class CurvePlace:
    """A curve, as an argument: `ground.line`, `tube`."""

    curve: Curve
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class SurfacePlace:
    """A surface, as an argument: `ground.plane`, `ramp`."""

    surface: Surface
    span: Span

    @property
    def name(self) -> str:
        """The name of the surface."""
        return self.surface.name


Place = BodyPoint | BodyGeometry | CurvePlace | Frame


@dataclass(frozen=True, slots=True, eq=False)
class Law:
    """A law of a liaison with its arguments, defaults filled (`mu_s` is `mu` unless given).

    One of the user has a kind of its own and gives `tangential`, the friction on the body.
    """

    kind: LawKind
    arguments: Mapping[str, Expression]
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class StatedRelation:
    """`left` = `right`, of a liaison of the user: between velocities, or between places."""

    left: Expression
    right: Expression
    kinematic: bool


@dataclass(frozen=True, slots=True, eq=False)
class Liaison(Owner):
    """A liaison between the places `a` and `b`; its reaction is that of `a` on `b`.

    `driven` are the coordinates that are prescribed, by name; `relations` those of one that the
    user defines.
    """

    name: str
    kind: LiaisonKind
    a: Place
    b: Place
    options: Mapping[str, Expression]
    laws: tuple[Law, ...]
    span: Span
    doc: str = ""
    driven: Mapping[str, Expression] = field(default_factory=dict)
    relations: tuple[StatedRelation, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Force:
    """An applied force; `arguments` are expressions or places by the names of its kind.

    A point argument given as a tuple, `(0, 0) m`, is an expression in ground axes. The `holder` of
    a couple is a liaison, or the `G` of a body.
    """

    name: str
    kind: ForceKind
    arguments: Mapping[str, Expression | Place | Liaison]
    span: Span
    doc: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Flange:
    """The flange of a liaison of one coordinate, where something is connected to it.

    `effort` is its flow variable, the force or couple that flows into the liaison: it drives the
    coordinate `Quantity(liaison, coordinate)` upwards. `drives`: it is what keeps a prescribed
    coordinate, and a part of the liaison's reaction.
    """

    liaison: Liaison
    coordinate: str
    effort: Variable
    drives: bool = False
