"""The records of which the catalogue is made, and how a name is looked up in a table."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Protocol, TypeVar

from frot.dsl.quantities.dimensions import REAL, Type


@dataclass(frozen=True, slots=True)
class Argument:
    """One argument of a shape, liaison, law or force; arguments stand in positional order.

    `kind` says what may be written:

    * `expression`: a scalar of `type` (or of one of `others`, where a liaison decides);
    * `number`: a scalar whose dimension another argument decides;
    * `vector`: a vector of `type`, two components in planar models and three in space;
    * `couple`: a scalar in planar models and of a liaison, in space a vector for a body;
    * `inertia`: a scalar in planar models; in space three principal moments, or a 3 x 3 array;
    * `boolean`: a condition on parameters;
    * `word`: one of `words`;
    * `place`: a point, curve or surface, see `places`;
    * `point`: a place that is a point, or its ground coordinates as a vector;
    * `holder`: a liaison or a body;
    * `vertices`: a tuple of points;
    * `axis`: `x`, `y`, `z` or a vector (space only; absent from planar models).

    `default` is an SI value or a word, `default_of` the argument whose expression is repeated.
    `sign` is `positive`, `nonnegative` or empty; `at_most` an upper bound of the value; `not_below`
    names the argument that it must not be below.
    """

    name: str
    type: Type = REAL
    kind: str = "expression"
    required: bool = True
    default: float | bool | str | None = None
    default_of: str = ""
    sign: str = ""
    at_most: float | None = None
    not_below: str = ""
    others: tuple[Type, ...] = ()
    words: tuple[str, ...] = ()
    places: tuple[str, ...] = ()
    space_only: bool = False
    doc: str = ""


@dataclass(frozen=True, slots=True)
class Shape:
    """A shape of body: what it needs, and the frames and geometry it gives.

    `geometry` maps a name to `curve`, `surface`, `points`, `curves` or `surfaces`. `freedoms_*` is
    the number of velocities of a free body of this shape; `turns` is False for a particle.
    `home` is the frame a bare body name stands for.
    """

    name: str
    arguments: tuple[Argument, ...]
    freedoms_space: int
    freedoms_planar: int = 3
    planar: bool = True
    space: bool = True
    frames: tuple[str, ...] = ("G",)
    geometry: Mapping[str, str] = field(default_factory=dict)
    turns: bool = True
    home: str = "G"
    aliases: tuple[str, ...] = ()
    doc: str = ""


@dataclass(frozen=True, slots=True)
class Softer:
    """A kind that locks less; `axes`: of its arguments, those of the other kind, and defaults."""

    kind: str
    axes: tuple[tuple[str, str, str], ...] = ()


@dataclass(frozen=True, slots=True)
class LiaisonKind:
    """A type of liaison between the places `a` and `b`.

    `arguments` begins with `a` and `b`; the others are options, `unilateral` the last of them.
    `relations_planar` is None where the liaison has no meaning in the plane. `coordinates` maps the
    readable and drivable coordinates to their types in planar models. `of_points`: it holds points,
    and leaves every orientation of what they are on.

    `title` is the name with its accents, `joins` says which places it takes. `in_plane`: in planar
    models it is a `contact`, which may part or have friction, a pairing of `figures`, or neither.
    `laws` are those of friction that it takes in the plane, `laws_in_space` in space; `own_laws`
    says where it takes a law of the user, "plane" and "space". `slips` are the coordinates that
    friction opposes in a joint, those of each slip together, () any turn; a `pin` slips at its
    radius, a `guide` has a length. `softer` are
    kinds that lock less, in space and in the plane, those first that lock most.
    """

    name: str
    arguments: tuple[Argument, ...]
    relations_space: int
    relations_planar: int | None
    coordinates: Mapping[str, Type] = field(default_factory=dict)
    unilateral: bool = False
    aliases: tuple[str, ...] = ()
    doc: str = ""
    of_points: bool = False
    title: str = ""
    joins: str = ""
    in_plane: str = ""
    laws: tuple[str, ...] = ()
    laws_in_space: tuple[str, ...] = ()
    slips: tuple[tuple[str, ...], ...] = ()
    pin: bool = False
    guide: bool = False
    own_laws: tuple[str, ...] = ()
    softer: tuple[Softer, ...] = ()
    softer_in_plane: tuple[Softer, ...] = ()

    @property
    def along_curve(self) -> bool:
        """Whether a point goes along a curve, by its parameter."""
        return "u" in self.coordinates


@dataclass(frozen=True, slots=True)
class LawKind:
    """A law of a liaison, its arguments in positional order.

    `repeats`: one liaison may have several. `space_only`: the plane has no motion for it.
    """

    name: str
    arguments: tuple[Argument, ...]
    aliases: tuple[str, ...] = ()
    doc: str = ""
    repeats: bool = False
    space_only: bool = False


@dataclass(frozen=True, slots=True)
class ForceKind:
    """An applied force with its arguments in positional order."""

    name: str
    arguments: tuple[Argument, ...]
    aliases: tuple[str, ...] = ()
    doc: str = ""


class Named(Protocol):
    """An entry of a table of the catalogue."""

    @property
    def name(self) -> str:
        """The canonical name."""

    @property
    def aliases(self) -> tuple[str, ...]:
        """Other spellings."""


Entry = TypeVar("Entry", bound=Named)


def plain(name: str) -> str:
    """The name without accents, as it is compared with built-in names."""
    split = unicodedata.normalize("NFD", name)
    return "".join(c for c in split if not unicodedata.combining(c))


def table(entries: Iterable[Entry]) -> Mapping[str, Entry]:
    """The entries by canonical name, in the order given."""
    return {entry.name: entry for entry in entries}


def find(entries: Mapping[str, Entry], spelling: str) -> Entry | None:
    """The entry with this name or alias, accents left out, or None."""
    name = plain(spelling)
    entry = entries.get(name)
    if entry is not None:
        return entry
    return next((e for e in entries.values() if name in e.aliases), None)


def spellings(entries: Mapping[str, Entry]) -> tuple[str, ...]:
    """Every name under which an entry can be written."""
    return tuple(s for e in entries.values() for s in (e.name, *e.aliases))
