"""Scopes: where a part of a text is checked, and what its names are looked up in."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from frot.dsl import checked
from frot.dsl.messages.diagnostics import Log
from frot.dsl.names.check_state import Build, settled
from frot.dsl.names.entities import Array, Entity, Instance, Pending, Refused

if TYPE_CHECKING:
    from frot.dsl.names.classes import Namespace

BUILT_IN = ("time", "pi", "ground")
# Words that cannot begin an equation or stand in an expression, so that no variable has them.
RESERVED = frozenset(
    """and or not if then else elseif elsewhen end equation initial true false for loop when
    extends import final""".split()  # noqa: SIM905
)


@dataclass(slots=True, repr=False)
class Scope:
    """Where a part of a text is checked: the names of its component and what surrounds its class.

    `local` holds names of a loop or a function, looked up first. `element` is the index (from 0)
    and the size of the array declaration that is being expanded: arrays of that size then stand for
    one item each. `arrays` are those that its arguments name, looked up once for all items: by the
    place in the text.
    """

    build: Build
    instance: Instance
    space: Namespace
    local: dict[str, Entity] = field(default_factory=dict)
    element: tuple[int, int] | None = None
    in_when: bool = False
    arrays: dict[int, Array] = field(default_factory=dict)

    @property
    def log(self) -> Log:
        """The log of faults."""
        return self.build.log

    @property
    def planar(self) -> bool:
        """Whether the model is planar."""
        return self.build.planar

    @property
    def size(self) -> int:
        """The number of components of a vector."""
        return 2 if self.build.planar else 3

    @property
    def values(self) -> dict[checked.Parameter, object]:
        """The values of parameters, with their defaults."""
        return self.build.values

    def knows(self, name: str) -> bool:
        """Whether a missing name must be reported: not if its declaration could not be read."""
        return not self.instance.open and self.space.knows(name)

    def dotted(self, name: str) -> str:
        """The name with that of its component before it."""
        return f"{self.instance.name}.{name}" if self.instance.name else name

    def find(self, name: str) -> Entity | Refused | None:
        """The entity of a name in the component; its declaration is checked if need be."""
        found: Entity | Pending | Refused | None = self.local.get(name)
        if found is None:
            found = self.instance.names.get(name)
        return settled(found, name, self.instance, self.build)

    def visible(self) -> tuple[str, ...]:
        """The names of the component and of the language."""
        return (*self.local, *self.instance.names, *BUILT_IN)

    def inside(self, **local: Entity) -> Scope:
        """The same scope with names of a loop or a law added."""
        return Scope(
            self.build,
            self.instance,
            self.space,
            {**self.local, **local},
            self.element,
            self.in_when,
        )

    def items(self, size: int) -> list[Scope]:
        """The same scope for each item of an array declaration."""
        shared: dict[int, Array] = {}
        return [
            Scope(self.build, self.instance, self.space, self.local, (k, size), arrays=shared)
            for k in range(size)
        ]
