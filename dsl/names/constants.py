"""Members of packages: constants visible from a class, and members named from outside."""

from __future__ import annotations

from collections.abc import Iterator

from frot.dsl import checked
from frot.dsl.names.classes import Class, Imported, Namespace, first_seen
from frot.dsl.names.declared_types import enumeration_of
from frot.dsl.names.imports import enter
from frot.dsl.names.near import did_you_mean
from frot.dsl.names.scope import Entity, Instance, Refused, Scope, settled
from frot.dsl.names.things import Thing, as_thing, kind_of
from frot.dsl.text import tree

_Constant = Entity | Refused


def constant_around(node: tree.Name, scope: Scope) -> Thing | None:
    """A constant that is imported, or of a package that surrounds the class."""
    space: Namespace | None = scope.space
    while space is not None:
        places = [space.constants[node.text]] if node.text in space.constants else []
        if space.owner is not None and space.owner.kind == "package":
            places.append((space.owner, node.text))
        for package, name in places:
            found = constant(package, name, scope)
            if found is not None:
                return None if isinstance(found, Refused) else as_thing(found, node, scope)
        found = _by_stars(node.text, space, scope)
        if found is not None:
            return None if isinstance(found, Refused) else as_thing(found, node, scope)
        space = space.outer
    return None


def _by_stars(name: str, space: Namespace, scope: Scope) -> Entity | Refused | None:
    """A constant of a package of which all is imported; that another has one too is noted."""
    packages = ((star, star.target) for star in space.stars)
    seen: Iterator[tuple[Imported, _Constant | None]] = (
        (star, constant(package, name, scope))
        for star, package in packages
        if package is not None and package.kind == "package"
    )
    return first_seen(name, seen)


def constant(package: Class, name: str, scope: Scope) -> Entity | Refused | None:
    """A constant of a package; None if it has none of that name."""
    made = _constants(package, scope)
    return settled(made.names.get(name), name, made, scope.build)


def _constants(package: Class, scope: Scope) -> Instance:
    build = scope.build
    made = build.packages.get(id(package.definition))
    if made is None:
        made = Instance(package.full_name, package, package.definition.span)
        build.packages[id(package.definition)] = made
        inner = Scope(build, made, enter(package, build.libraries))
        for element in package.elements:
            if isinstance(element, tree.Component):
                build.checks.declare(element, inner)
    return made


def of_class(owner: Class, node: tree.Member, scope: Scope) -> Thing | None:
    """`Library.Resistor`, `Library.constant` or `Colour.red`; None after a message."""
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
