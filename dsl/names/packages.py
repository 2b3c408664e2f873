"""What can be named inside of a class from outside: constants, definitions, literals."""

from __future__ import annotations

from typing import TYPE_CHECKING

from frot.dsl import checked
from frot.dsl.names.classes import Class, enter
from frot.dsl.names.scope import Entity, Instance, Refused, Scope, did_you_mean, settled
from frot.dsl.text import tree

if TYPE_CHECKING:
    from frot.dsl.names.names import Thing


def constant(package: Class, name: str, scope: Scope) -> Entity | Refused | None:
    """A constant of a package; None if it has none of that name."""
    made = _constants(package, scope)
    return settled(made.names.get(name), name, made, scope.build)


def _constants(package: Class, scope: Scope) -> Instance:
    from frot.dsl.declarations.instantiate import declare_values

    build = scope.build
    made = build.packages.get(id(package.definition))
    if made is None:
        made = Instance(package.full_name, package, package.definition.span)
        build.packages[id(package.definition)] = made
        inner = Scope(build, made, enter(package, build.libraries))
        for element in package.elements:
            if isinstance(element, tree.Component):
                declare_values(element, inner)
    return made


def of_class(owner: Class, node: tree.Member, scope: Scope) -> Thing | None:
    """`Library.Resistor`, `Library.constant` or `Colour.red`; None after a message."""
    from frot.dsl.names.names import as_thing, kind_of
    from frot.dsl.names.types import enumeration_of

    name = node.name.text
    if owner.kind == "package":
        inner = owner.space.own(name)
        if inner is not None:
            return inner
        found = constant(owner, name, scope)
        if isinstance(found, Refused):
            return None
        if found is not None:
            return as_thing(found, node, scope)
        names = (*owner.space.definitions, *_constants(owner, scope).names)
    else:
        kind = enumeration_of(owner, scope)
        if kind is None:
            message = f"{kind_of(owner)} is a definition, not a component: it has no {name!r}"
            help_text = f"declare one: '{owner.name} name;'" if owner.kind != "type" else ""
            scope.log.report("E0203", message, node.name.span, help=help_text)
            return None
        assert kind.enumeration is not None
        names = kind.enumeration.literals
        if name in names:
            return checked.Literal(float(names.index(name) + 1), kind, node.span)
    if owner.space.knows(name):
        help_text = did_you_mean(name, names, scope.log)
        notes = () if help_text else (f"there are: {', '.join(names) or 'none'}",)
        scope.log.report(
            "E0203", f"no {name!r} in {kind_of(owner)}", node.name.span, notes=notes, help=help_text
        )
    return None
