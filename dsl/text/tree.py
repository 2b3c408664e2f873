"""The tree: a text as it was written, with the place of every part.

Words are NFC-normalised. Where a noun has two spellings the class of the node is its meaning and
`keyword` the author's spelling. Nothing is resolved here: `Name("hoop")` is only a word.
"""

from __future__ import annotations

from dataclasses import dataclass

from frot.dsl.messages.source import Source, Span
from frot.dsl.text.tree_expressions import (
    Argument,
    Call,
    Conditional,
    Expression,
    Index,
    Infix,
    Member,
    Name,
    Number,
    Prefix,
    Range,
    Text,
    Truth,
    Tuple,
    Word,
)

__all__ = [
    "Alias",
    "Argument",
    "Body",
    "Branch",
    "Call",
    "Component",
    "Conditional",
    "Curve",
    "Declared",
    "Definition",
    "Element",
    "Equation",
    "Expression",
    "Extends",
    "For",
    "Force",
    "Formal",
    "Frame",
    "IfEquation",
    "Import",
    "Index",
    "Infix",
    "Liaison",
    "Member",
    "Name",
    "Number",
    "Prefix",
    "Range",
    "Relation",
    "Section",
    "Surface",
    "Text",
    "Tree",
    "Truth",
    "Tuple",
    "When",
    "Word",
]


@dataclass(frozen=True, slots=True, eq=False)
class Section:
    """The word `initial` or `equation` that opens a section."""

    name: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Import:
    """`import path;`, `import path.*;` or `import path as alias;`."""

    path: tuple[Word, ...]
    all: bool
    alias: Word | None
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Extends:
    """`extends Base(modifiers);`."""

    base: Expression
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Alias:
    """`type Name = value;`."""

    name: Word
    value: Expression
    doc: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Declared:
    """One name of a component clause."""

    name: Word
    subscripts: tuple[Expression, ...]
    modifiers: tuple[Argument, ...]
    value: Expression | None
    doc: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Component:
    """`parameter Length r = 1 m, l = 2 m;`: `prefixes` are words as `parameter`, `input`."""

    prefixes: tuple[Word, ...]
    type: Expression
    declared: tuple[Declared, ...]
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Body:
    """`body name: shape(arguments);`."""

    keyword: str
    name: Word
    subscripts: tuple[Expression, ...]
    shape: Expression
    doc: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Frame:
    """`frame name on owner at origin rotated(...);`."""

    keyword: str
    name: Word
    owner: Expression
    origin: Expression | None
    rotation: tuple[Argument, ...] | None
    doc: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Curve:
    """`curve name on owner: kind(arguments);`."""

    name: Word
    owner: Expression
    kind: Expression
    doc: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Surface:
    """`surface name on owner: kind(arguments);`."""

    name: Word
    owner: Expression
    kind: Expression
    doc: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Liaison:
    """`liaison name: kind(a, b) driven(...) with law(...), law(...);`."""

    keyword: str
    name: Word
    subscripts: tuple[Expression, ...]
    kind: Expression
    driven: tuple[Argument, ...] | None
    driven_span: Span | None
    laws: tuple[Expression, ...]
    doc: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Force:
    """`force name: kind(arguments);`."""

    keyword: str
    name: Word
    subscripts: tuple[Expression, ...]
    kind: Expression
    doc: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Equation:
    """`left = right;`, or a call alone (`right` None): `world experiment guess connect ...`."""

    left: Expression
    right: Expression | None
    doc: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Relation:
    """`kinematic left = right;` or `geometric ...` of a user-defined liaison."""

    kind: str
    left: Expression
    right: Expression
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Branch:
    """A condition (None for `else`) and what it guards."""

    condition: Expression | None
    elements: tuple[Element, ...]
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class When:
    """`when condition then ... end when;`."""

    branches: tuple[Branch, ...]
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class IfEquation:
    """`if condition then ... end if;`."""

    branches: tuple[Branch, ...]
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class For:
    """`for variable in range loop ... end for;`."""

    variable: Word
    range: Expression
    elements: tuple[Element, ...]
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Formal:
    """A formal argument of a user-defined liaison, law or shape; `sizes` where it is an array."""

    name: Word
    type: Expression | None
    value: Expression | None
    span: Span
    sizes: tuple[Expression, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Definition:
    """`planar model Name "doc" ... end Name;`; `kind` is canonical, `keyword` as written."""

    kind: str
    keyword: str
    prefixes: tuple[Word, ...]
    name: Word
    formals: tuple[Formal, ...]
    doc: str
    elements: tuple[Element, ...]
    header: Span
    span: Span

    def has(self, prefix: str) -> bool:
        """Whether `planar` or `partial` stands before it."""
        return any(w.text == prefix for w in self.prefixes)


Element = (
    Section
    | Import
    | Extends
    | Alias
    | Component
    | Body
    | Frame
    | Curve
    | Surface
    | Liaison
    | Force
    | Equation
    | Relation
    | When
    | IfEquation
    | For
    | Definition
)


@dataclass(frozen=True, slots=True, eq=False)
class Tree:
    """A file.

    `lost` are the words of statements that could not be read: a later pass is silent about names
    that are missing because of them.
    """

    source: Source
    elements: tuple[Element, ...]
    lost: frozenset[str]

    @property
    def span(self) -> Span:
        """The whole text."""
        return Span(self.source, 0, len(self.source.text))
