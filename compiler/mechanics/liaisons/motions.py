"""Elementary motions of which the liaisons kept by coordinates are made, as plain data.

How each moves axes stands in `moves.py`. The fields with defaults are the same for all of a kind:
`coordinates` and `speeds` are the ends of the names of q and v (`speeds` empty where v is q'),
`faces_ground` says that q places the axes relative to the ground, whatever carries them, and
`turns` that the speeds are angular velocities.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from frot.compiler.mechanics.values import Axis
from frot.dsl.checked import Expression
from frot.dsl.data.classes import dataclass

if TYPE_CHECKING:
    from frot.compiler.mechanics.geometry.figure import Figure


class Motion:
    """What b does relative to a, by coordinates."""

    __slots__ = ()

    coordinates: tuple[str, ...]
    speeds: tuple[str, ...]
    quaternion: Quaternion | None
    faces_ground: bool
    turns: bool

    @property
    def comes_round(self) -> bool:
        """Whether a turn of the bodies brings back the posture at which the coordinate began."""
        return False


@dataclass(frozen=True, slots=True)
class Quaternion:
    """Four coordinates that turn by an angular velocity.

    `own_axes`: the speeds are its components along the own y and z axes, else along the ground's.
    """

    own_axes: bool


@dataclass(frozen=True, slots=True, eq=False)
class Turn(Motion):
    """By an angle about an axis that both bodies keep.

    `mark`: the other axis of a universal joint, which shows the angle; None where any direction
    beside the axis does. `on_b`: then the axis is fixed to b, else to a.
    """

    axis: Axis
    sign: int = 1
    coordinates: tuple[str, ...] = ("angle",)
    speeds: tuple[str, ...] = ()
    quaternion: Quaternion | None = None
    faces_ground: bool = False
    turns: bool = True
    mark: Axis | None = None
    on_b: bool = False

    @property
    def comes_round(self) -> bool:
        """After a whole turn."""
        return True


@dataclass(frozen=True, slots=True, eq=False)
class Slide(Motion):
    """By a length along an axis fixed to the base, or along one of the two beside it (`side`)."""

    axis: Axis
    side: int | None = None
    sign: int = 1
    coordinates: tuple[str, ...] = ("displacement",)
    speeds: tuple[str, ...] = ()
    quaternion: Quaternion | None = None
    faces_ground: bool = False
    turns: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Screw(Motion):
    """By an angle about an axis and a length along it, `pitch` for each turn."""

    axis: Axis
    pitch: Expression
    sign: int = 1
    coordinates: tuple[str, ...] = ("angle",)
    speeds: tuple[str, ...] = ()
    quaternion: Quaternion | None = None
    faces_ground: bool = False
    turns: bool = True

    @property
    def comes_round(self) -> bool:
        """After a whole turn."""
        return True


@dataclass(frozen=True, slots=True, eq=False)
class Heading(Motion):
    """Any orientation in the plane: the angle of the axes from those of the ground."""

    coordinates: tuple[str, ...] = ("angle",)
    speeds: tuple[str, ...] = ()
    quaternion: Quaternion | None = None
    faces_ground: bool = True
    turns: bool = True


@dataclass(frozen=True, slots=True, eq=False)
class Attitude(Motion):
    """Any orientation in space: a unit quaternion, turned by the angular velocity in ground axes.

    What carries the body does not enter, and no orientation is singular.
    """

    coordinates: tuple[str, ...] = tuple(f"orientation[{k + 1}]" for k in range(4))
    speeds: tuple[str, ...] = tuple(f"angular_velocity.{k}" for k in "xyz")
    quaternion: Quaternion | None = Quaternion(own_axes=False)
    faces_ground: bool = True
    turns: bool = True


@dataclass(frozen=True, slots=True, eq=False)
class Pointing(Motion):
    """Any direction of the own x axis: a turn about it alone has no inertia and does not happen.

    P. Painlevé (1895, p. 32) counts five freedoms for a slender rod.
    """

    coordinates: tuple[str, ...] = tuple(f"orientation[{k + 1}]" for k in range(4))
    speeds: tuple[str, ...] = ("turning.y", "turning.z")
    quaternion: Quaternion | None = Quaternion(own_axes=True)
    faces_ground: bool = True
    turns: bool = True


@dataclass(frozen=True, slots=True, eq=False)
class Steady(Motion):
    """No turning: the axes of a particle are those of the ground."""

    coordinates: tuple[str, ...] = ()
    speeds: tuple[str, ...] = ()
    quaternion: Quaternion | None = None
    faces_ground: bool = True
    turns: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Follow(Motion):
    """Along a curve fixed to the base, by its parameter."""

    curve: Figure
    sign: int = 1
    coordinates: tuple[str, ...] = ("u",)
    speeds: tuple[str, ...] = ()
    quaternion: Quaternion | None = None
    faces_ground: bool = False
    turns: bool = False

    @property
    def comes_round(self) -> bool:
        """After a whole turn."""
        return True


@dataclass(frozen=True, slots=True, eq=False)
class Reach(Motion):
    """The distance of two places, of a rod that is drawn out: it is seen, and carries nothing."""

    coordinates: tuple[str, ...] = ("length",)
    speeds: tuple[str, ...] = ()
    quaternion: Quaternion | None = None
    faces_ground: bool = False
    turns: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Nearing(Motion):
    """The gap of two figures that an equation of the text keeps: it is seen, and carries nothing.

    `followed`: where they are nearest is solved for.
    """

    a: Figure
    b: Figure
    followed: bool
    coordinates: tuple[str, ...] = ("gap",)
    speeds: tuple[str, ...] = ()
    quaternion: Quaternion | None = None
    faces_ground: bool = False
    turns: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Spot(Motion):
    """The place of what rolls along a plane of the base: it has no speeds of its own (`Roll`)."""

    axis: Axis
    coordinates: tuple[str, ...] = ("x", "y")
    speeds: tuple[str, ...] = ()
    quaternion: Quaternion | None = None
    faces_ground: bool = False
    turns: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Roll(Motion):
    """Any orientation of a figure on a plane of the base, whose turning takes its place along.

    The angular velocity is all that moves it along the plane: independent speeds of a motion that
    is not holonomic (P. Appell 1899), which no orientation makes singular.
    """

    figure: Figure
    axis: Axis
    coordinates: tuple[str, ...] = tuple(f"orientation[{k + 1}]" for k in range(4))
    speeds: tuple[str, ...] = tuple(f"angular_velocity.{k}" for k in "xyz")
    quaternion: Quaternion | None = Quaternion(own_axes=False)
    faces_ground: bool = True
    turns: bool = True


@dataclass(frozen=True, slots=True, eq=False)
class Driven(Motion):
    """A motion whose coordinate is a value of time: it has none of its own."""

    motion: Turn | Slide | Screw | Follow
    value: Expression
    coordinates: tuple[str, ...] = ()
    speeds: tuple[str, ...] = ()
    quaternion: Quaternion | None = None
    faces_ground: bool = False
    turns: bool = False


def bare(motion: Motion) -> Motion:
    """The motion itself, whether it is driven or not."""
    return motion.motion if isinstance(motion, Driven) else motion


def name_of(motion: Motion) -> str:
    """The name of the coordinate of a motion that can be counted, "" of any other."""
    own = bare(motion)
    return "" if own.faces_ground or not own.coordinates else own.coordinates[0]


def count_speeds(motion: Motion) -> int:
    """The number of speeds of a motion."""
    return 0 if isinstance(motion, Spot) else len(motion.speeds or motion.coordinates)
