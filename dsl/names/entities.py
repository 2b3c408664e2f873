"""Entities behind names: values, components, arrays, records, and pending declarations."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from frot.dsl import checked
from frot.dsl.messages.source import Span
from frot.dsl.text import tree

if TYPE_CHECKING:
    from frot.dsl.names.classes import Class
    from frot.dsl.names.modifiers import Modifier
    from frot.dsl.names.scope import Scope


class Refused:
    """The entity of a name whose declaration was refused: its uses give no message."""


REFUSED = Refused()


@dataclass(slots=True, eq=False, repr=False)
class Statements:
    """Statements checked once every name has its meaning, each with its scope."""

    worlds: list[tuple[tree.Call, Scope]] = field(default_factory=list)
    experiments: list[tuple[tree.Call, Scope]] = field(default_factory=list)
    initial: list[tuple[tree.Element, Scope]] = field(default_factory=list)
    equations: list[tuple[tree.Element, Scope]] = field(default_factory=list)
    liaisons: list[tuple[tree.Liaison, Scope]] = field(default_factory=list)


@dataclass(slots=True, eq=False, repr=False)
class Instance:
    """A component, or the model itself (`name` empty), or a package with its constants.

    `name` is dotted. `of` is its class, `around` the classes of what it is in and its own, `parts`
    the identities of the definitions it is made of, with what modifies them. `flows` names the flow
    variables of a connector. `open`: names may come from a base that was not found, so that missing
    ones are not reported. `written`: where each name is declared.
    """

    name: str
    of: Class
    span: Span
    names: dict[str, Entity | Pending | Refused] = field(default_factory=dict)
    flows: set[str] = field(default_factory=set)
    open: bool = False
    written: dict[str, Span] = field(default_factory=dict)
    around: tuple[Class, ...] = ()
    parts: dict[int, Mapping[str, Modifier]] = field(default_factory=dict)
    statements: Statements = field(default_factory=Statements)

    @property
    def is_connector(self) -> bool:
        """Whether it can be connected."""
        return self.of.kind == "connector"


@dataclass(slots=True, eq=False)
class Array:
    """Components, bodies, liaisons or forces of one declaration, in their order."""

    name: str
    items: tuple[Entity, ...]


@dataclass(slots=True, eq=False)
class Record:
    """The value of a whole record: the values of its members by name."""

    of: Class
    members: dict[str, checked.Expression | Record]
    span: Span


Entity = (
    checked.Parameter
    | checked.Input
    | checked.Output
    | checked.Variable
    | checked.Body
    | checked.Frame
    | checked.Curve
    | checked.Surface
    | checked.Liaison
    | checked.Force
    | Instance
    | Array
    | Record
    | checked.Expression
)


@dataclass(slots=True, eq=False)
class Pending:
    """A declaration that waits to be checked, and the names its expressions begin with."""

    name: tree.Word
    needs: tuple[str, ...]
    check: Callable[[], Entity | None]
    is_value: bool = False
    busy: bool = False
