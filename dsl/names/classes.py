"""Definitions and where they are looked up: files, packages, and what a class can see."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cache
from typing import TypeVar

from frot.dsl.messages.diagnostics import Log
from frot.dsl.messages.source import Source, Span
from frot.dsl.text import tree
from frot.dsl.text.parsing import parse

_Seen = TypeVar("_Seen")

# What has no library in the text: the connectors of one-coordinate liaisons.
_BUILT_IN = """
connector RotationalFlange "of a part that turns"
  Angle angle "absolute angle";
  flow Torque torque "couple that flows into the part";
end RotationalFlange;
connector TranslationalFlange "of a part that moves along a line"
  Length displacement "absolute place";
  flow Force force "force that flows into the part";
end TranslationalFlange;
"""


@dataclass(slots=True, eq=False, repr=False)
class Namespace:
    """The definitions seen from a place of a text; `outer` surrounds it.

    `imports` are the names made by `import`, and `stars` the packages whose members are all seen.
    `constants` are imported ones, each with its package and name there. `lost` are words of
    statements that could not be read.
    """

    source: Source
    outer: Namespace | None = None
    definitions: dict[str, tree.Definition | tree.Alias] = field(default_factory=dict)
    imports: dict[str, Imported] = field(default_factory=dict)
    stars: list[Imported] = field(default_factory=list)
    constants: dict[str, tuple[Class, str]] = field(default_factory=dict)
    bases: list[Namespace] = field(default_factory=list)
    classes: dict[str, Class] = field(default_factory=dict)
    lost: frozenset[str] = frozenset()
    open: bool = False
    owner: Class | None = None

    def knows(self, name: str) -> bool:
        """Whether a name that is not found must be reported."""
        space: Namespace | None = self
        while space is not None:
            if space.open or name in space.lost:
                return False
            space = space.outer
        return True

    def own(self, name: str) -> Class | None:
        """The class defined here by that name, or in a base."""
        for space in self._with_bases():
            found = space.classes.get(name)
            if found is None and name in space.definitions:
                found = space.classes[name] = Class(space.definitions[name], space)
            if found is not None:
                return found
        return None

    def _with_bases(self) -> Iterator[Namespace]:
        """This namespace and those of its bases, each once: bases may extend each other."""
        waiting, seen = [self], set[int]()
        while waiting:
            space = waiting.pop()
            if id(space) not in seen:
                seen.add(id(space))
                yield space
                waiting += reversed(space.bases)

    def find(self, name: str) -> Class | None:
        """The class seen by that name from here: the innermost one."""
        space: Namespace | None = self
        while space is not None:
            found = space.own(name) or space._imported(name)
            if found is not None:
                return found
            space = space.outer
        return built_in(name)

    def _imported(self, name: str) -> Class | None:
        imported = self.imports.get(name)
        if imported is not None:
            imported.used = True
            return imported.target
        packages = ((star, star.target) for star in self.stars if star.target is not None)
        return first_seen(name, ((star, package.space.own(name)) for star, package in packages))

    def visible(self) -> Iterator[str]:
        """Every name of a class that is seen from here."""
        space: Namespace | None = self
        while space is not None:
            for one in space._with_bases():
                yield from one.definitions
            yield from space.imports
            for star in space.stars:
                if star.target is not None:
                    yield from star.target.space.definitions
            space = space.outer
        yield from ("RotationalFlange", "TranslationalFlange")


@dataclass(slots=True, eq=False, repr=False)
class Imported:
    """An import: what it names, None where it was not found (that was reported).

    `clashes` are names in use that an earlier `import P.*;` gives too.
    """

    target: Class | None
    statement: tree.Import
    used: bool = False
    clashes: dict[str, Imported] = field(default_factory=dict)


def first_seen(name: str, seen: Iterable[tuple[Imported, _Seen]]) -> _Seen | None:
    """The first of what packages imported by `.*` have by a name; that others have one is noted."""
    first: Imported | None = None
    result: _Seen | None = None
    for star, found in seen:
        if found is None:
            continue
        star.used = True
        if first is None:
            first, result = star, found
        elif found is not result:
            star.clashes.setdefault(name, first)
    return result


@dataclass(slots=True, eq=False, repr=False)
class Class:
    """A definition where it stands; a type made by `type` is one too, and so is a library."""

    definition: tree.Definition | tree.Alias
    outer: Namespace
    _space: Namespace | None = None

    @property
    def name(self) -> str:
        """Name of the class, as it is defined."""
        return self.definition.name.text

    @property
    def kind(self) -> str:
        """`model connector record function package liaison law shape`, or `type`."""
        return self.definition.kind if isinstance(self.definition, tree.Definition) else "type"

    @property
    def elements(self) -> tuple[tree.Element, ...]:
        """Elements of the class."""
        return self.definition.elements if isinstance(self.definition, tree.Definition) else ()

    @property
    def space(self) -> Namespace:
        """The namespace inside of the class."""
        if self._space is None:
            self._space = namespace(self.elements, self.outer.source, self.outer)
            self._space.owner = self
        return self._space

    @property
    def full_name(self) -> str:
        """Name of the class with those of the packages around it."""
        around = self.outer.owner
        return f"{around.full_name}.{self.name}" if around is not None else self.name


def namespace(
    elements: Iterable[tree.Element],
    source: Source,
    outer: Namespace | None = None,
    lost: frozenset[str] = frozenset(),
) -> Namespace:
    """The namespace of these elements; imports are filled in by `imports.py`."""
    found = Namespace(source, outer, lost=lost)
    for element in elements:
        if isinstance(element, tree.Definition | tree.Alias):
            found.definitions.setdefault(element.name.text, element)
    return found


def library(name: str, space: Namespace) -> Class:
    """A file or folder as a package: its members are those of a namespace."""
    here = Span(space.source, 0, 0)
    word = tree.Word(name, here)
    definition = tree.Definition(
        kind="package",
        keyword="package",
        prefixes=(),
        name=word,
        formals=(),
        doc="",
        elements=(),
        header=here,
        span=here,
    )
    found = Class(definition, Namespace(space.source))
    found._space = space
    space.owner = found
    return found


@cache
def _built_in_space() -> Namespace:
    source = Source("<frot>", _BUILT_IN)
    return namespace(parse(source, Log()).elements, source)


def built_in(name: str) -> Class | None:
    """A connector of the language."""
    if name not in ("RotationalFlange", "TranslationalFlange"):
        return None
    return _built_in_space().own(name)
