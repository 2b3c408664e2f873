"""Classes to components: names made, modifiers handed down, bases and arrays unfolded."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import prod

from frot.dsl.declarations.components import declare
from frot.dsl.declarations.geometry import body, curve, frame, surface
from frot.dsl.declarations.given import Declared
from frot.dsl.declarations.mechanism import force, liaison
from frot.dsl.expressions.records import binding
from frot.dsl.expressions.structure import sizes
from frot.dsl.messages.diagnostics import Label
from frot.dsl.messages.source import Span
from frot.dsl.names.classes import Class
from frot.dsl.names.declared_types import (
    Kind,
    find_class,
    find_type,
    role_of,
    split_call,
    split_type,
)
from frot.dsl.names.imports import enter
from frot.dsl.names.modifiers import (
    merge,
    merged,
    picked,
    read_modifiers,
    tell_conflict,
    tell_unknown,
)
from frot.dsl.names.near import did_you_mean
from frot.dsl.names.scope import (
    BUILT_IN,
    COMPONENT,
    REFUSED,
    RESERVED,
    Array,
    Build,
    Entity,
    Instance,
    Modifier,
    Pending,
    Scope,
)
from frot.dsl.names.sections import sort
from frot.dsl.text import tree
from frot.dsl.text.tree_names import names_in

_NESTED = 50


def instantiate(
    of: Class,
    name: str,
    modifiers: Mapping[str, Modifier],
    role: str,
    span: Span,
    build: Build,
    around: tuple[Class, ...] = (),
) -> Instance:
    """The component `name` of a class: its names wait to be checked, its statements are kept."""
    build.grow(COMPONENT, span)
    made = Instance(name, of, span, around=(*around, of))
    build.fresh.append(made)
    if not name:
        build.root = made
    _part(of, made, modifiers, role, build, ())
    scope = Scope(build, made, of.space)
    tell_unknown(modifiers, made, scope)
    return made


def _part(
    of: Class,
    made: Instance,
    modifiers: Mapping[str, Modifier],
    role: str,
    build: Build,
    derived: tuple[Class, ...],
) -> None:
    """Declare what a class, or a base of one, says; each base once."""
    scope = Scope(build, made, enter(of, build.libraries))
    made.parts[id(of.definition)] = modifiers

    def extends(element: tree.Extends) -> None:
        base = _base(element, (*derived, of), scope)
        if base is None:
            made.open = True
            return
        _, arguments = split_call(element.base)
        said = read_modifiers(arguments, scope)
        if id(base.definition) in made.parts:
            first = made.parts[id(base.definition)]
            tell_conflict(base, first, merged(modifiers, said, scope), element.span, scope)
        else:
            if not any(b is base.space for b in of.space.bases):
                of.space.bases.append(base.space)
            _part(base, made, merged(modifiers, said, scope), role, build, (*derived, of))
            tell_unknown(said, made, scope)

    def declaration(element: tree.Element) -> None:
        _declaration(element, made, modifiers, role, scope)

    told = (made.statements.worlds, made.statements.experiments)
    before = [len(calls) for calls in told]
    sort(of, scope, made.statements, extends, declaration)
    for calls, count in zip(told, before, strict=True):
        # What the class itself says counts; that of its bases gives way.
        own = [call for call in calls[count:] if call[1] is scope]
        calls[count:] = own or calls[count:]


def _base(element: tree.Extends, derived: tuple[Class, ...], scope: Scope) -> Class | None:
    node, _ = split_call(element.base)
    around = Scope(scope.build, scope.instance, derived[-1].outer)
    found = find_class(node, scope) or find_class(node, around)
    if found is None:
        if scope.knows(node.span.text.split(".")[0]):
            scope.log.report(
                "E0206",
                f"unknown base {node.span.text!r}",
                node.span,
                help=did_you_mean(node.span.text, scope.space.visible(), scope.log),
            )
        return None
    if found in derived:
        circle = derived[derived.index(found) :]
        if (members := frozenset(map(id, circle))) not in scope.build.circles:
            scope.build.circles.add(members)
            path = " -> ".join(c.name for c in (*circle, found))
            scope.log.report("E0208", f"{found.name!r} extends itself: {path}", node.span)
        return None
    if len(derived) > _NESTED:
        message = f"bases are nested more than {_NESTED} levels deep"
        scope.log.report("E0108", message, node.span)
        return None
    if found.kind != derived[0].kind and not (found.kind == "record" and not scope.planar):
        kind = derived[0].kind
        message = f"{found.kind} {found.name!r} cannot be the base of a {kind}"
        scope.log.report("E0206", message, node.span)
        return None
    return found


# ------------------------------------------------------------------ declarations


def _declaration(
    element: tree.Element,
    made: Instance,
    modifiers: Mapping[str, Modifier],
    role: str,
    scope: Scope,
) -> None:
    match element:
        case tree.Component():
            declare_values(element, scope, modifiers, role)
        case tree.Body():
            _mechanical(element, [element.shape], element.subscripts, body, scope)
        case tree.Frame():
            used = [element.owner, element.origin, *(a.value for a in element.rotation or ())]
            _mechanical(element, used, (), frame, scope)
        case tree.Curve():
            _mechanical(element, [element.owner, element.kind], (), curve, scope)
        case tree.Surface():
            _mechanical(element, [element.owner, element.kind], (), surface, scope)
        case tree.Liaison():
            _mechanical(element, [element.kind], element.subscripts, liaison, scope)
            made.statements.liaisons.append((element, scope))
        case tree.Force():
            _mechanical(element, [element.kind], element.subscripts, force, scope)


@dataclass(slots=True)
class _Clause:
    """The content of a component clause, the same in every component of its class with one role."""

    type: Kind | Class | None
    sizes: tuple[tree.Expression, ...]
    role: str
    flow: bool
    final: bool
    needs: tuple[tuple[str, ...], ...]


def _clause(clause: tree.Component, outer_role: str, scope: Scope) -> _Clause:
    known = scope.build.clauses.get((id(clause), outer_role))
    if isinstance(known, _Clause):
        return known
    node, type_sizes = split_type(clause)
    words = {w.text for w in clause.prefixes}
    role, flow = outer_role or role_of(clause), "flow" in words
    found = find_type(node, scope, bool(role) or flow)
    if flow and scope.instance.of.kind != "connector":
        word = next(w for w in clause.prefixes if w.text == "flow")
        scope.log.report("E0501", "'flow' stands in connectors only", word.span)
    needs = []
    for item in clause.declared:
        used = [*type_sizes, *item.subscripts]
        if isinstance(found, Kind):
            used += [e for e in (item.value, *(a.value for a in item.modifiers)) if e is not None]
        needs.append(_needs(used))
    made = _Clause(found, type_sizes, role, flow, "final" in words, tuple(needs))
    scope.build.clauses[id(clause), outer_role] = made
    return made


def declare_values(
    clause: tree.Component,
    scope: Scope,
    modifiers: Mapping[str, Modifier] | None = None,
    outer_role: str = "",
) -> None:
    """Declare the names of a component clause: values, or components of a class."""
    said = _clause(clause, outer_role, scope)
    found = said.type
    if isinstance(found, Class) and not _can_be_component(found, clause, said.role, scope):
        found = None
    for item, needs in zip(clause.declared, said.needs, strict=True):
        modifier = _modifier(item, said.final, modifiers, scope)
        if found is None:
            _add(item.name, Pending(item.name, (), lambda: None), scope)
            scope.instance.names[item.name.text] = REFUSED
        elif isinstance(found, Kind):
            what = Declared(item, found, said.role, modifier, said.sizes)
            pending = Pending(item.name, needs, _value(what, scope), is_value=True)
            if _add(item.name, pending, scope) and said.flow:
                scope.instance.flows.add(item.name.text)
        else:
            subscripts = (*said.sizes, *item.subscripts)
            check = _components(found, item, subscripts, modifier, said.role, scope)
            _add(item.name, Pending(item.name, needs, check), scope)


def _modifier(
    item: tree.Declared,
    final: bool,
    modifiers: Mapping[str, Modifier] | None,
    scope: Scope,
) -> Modifier | None:
    """Modifiers of a name from outside and at its declaration, the outer first."""
    outer = modifiers.get(item.name.text) if modifiers else None
    if not (item.modifiers or final):
        return outer
    own = read_modifiers(item.modifiers, scope)
    value = item.value if final else None
    return merge(outer, Modifier(item.span, scope, value, parts=own, final=final), scope)


def _value(what: Declared, scope: Scope) -> Callable[[], Entity | None]:
    return lambda: declare(what, scope)


def _needs(used: Sequence[tree.Expression | None]) -> tuple[str, ...]:
    return tuple(n for e in used for n in names_in(e))


def _can_be_component(of: Class, clause: tree.Component, role: str, scope: Scope) -> bool:
    log, span = scope.log, clause.type.span
    if of.kind not in ("model", "connector", "record"):
        log.report("E0206", f"{of.kind} {of.name!r} is not a type of components", span)
        return False
    definition = of.definition
    assert isinstance(definition, tree.Definition)
    if definition.has("partial"):
        log.report(
            "E0513",
            f"{of.kind} {of.name!r} is partial: it is only a base of others",
            span,
            labels=(Label(definition.header, "partial here"),),
            help="declare a component of a model that extends it",
        )
        return False
    if definition.has("planar") and not scope.planar:
        log.report("E0506", f"{of.name!r} is a planar model; this model is in space", span)
        return False
    if role in ("parameter", "constant") and of.kind != "record":
        message = f"a {role} cannot be of the {of.kind} {of.name!r}"
        log.report("E0206", message, span)
        return False
    around = scope.instance.around
    if of in around:
        path = " -> ".join(c.name for c in (*around[around.index(of) :], of))
        log.report("E0208", f"{of.kind} {of.name!r} holds itself: {path}", span)
        return False
    if len(around) > _NESTED:
        message = f"components are nested more than {_NESTED} levels deep"
        log.report("E0108", message, span)
        return False
    return True


def _components(
    of: Class,
    item: tree.Declared,
    subscripts: tuple[tree.Expression, ...],
    modifier: Modifier | None,
    role: str,
    scope: Scope,
) -> Callable[[], Entity | None]:
    def make() -> Entity | None:
        counts = sizes(subscripts, item.name, scope)
        if counts is None:
            return None
        # Asked before anything is made of it; what is made is counted then.
        scope.build.room(COMPONENT * prod(counts), item.span)
        parts = {} if modifier is None else modifier.parts
        if of.kind == "record":
            given = binding(of, item, modifier, scope)
            if given is None:
                return None
            covered = {n: p for n, p in parts.items() if modifier and n in modifier.covered}
            over = {n: p for n, p in parts.items() if n not in covered}
            parts = merged(over, merged(given, covered, scope), scope)
        elif item.value is not None or (modifier is not None and modifier.has_value):
            span = item.value.span if item.value is not None else item.span
            message = f"{of.kind} {of.name!r} has no value of its own"
            help_text = f"modify what is in it: '{item.name.text}(name = ...)'"
            scope.log.report("E0205", message, span, help=help_text)
        return _array(of, scope.dotted(item.name.text), counts, parts, role, item.span, scope)

    return make


def _array(
    of: Class,
    name: str,
    counts: tuple[int, ...],
    parts: Mapping[str, Modifier],
    role: str,
    span: Span,
    scope: Scope,
) -> Entity:
    if not counts:
        return instantiate(of, name, parts, role, span, scope.build, scope.instance.around)
    items = tuple(
        _array(of, f"{name}[{k + 1}]", counts[1:], picked(parts, k, counts[0]), role, span, scope)
        for k in range(counts[0])
    )
    return Array(name, items)


def _mechanical(
    element: tree.Body | tree.Frame | tree.Curve | tree.Surface | tree.Liaison | tree.Force,
    used: Sequence[tree.Expression | None],
    subscripts: tuple[tree.Expression, ...],
    check: Callable[..., Entity | None],
    scope: Scope,
) -> None:
    word = element.name

    def make() -> Entity | None:
        name = scope.dotted(word.text)
        if not subscripts:
            scope.build.grow(1, element.span)
            return check(element, name, scope)
        counts = sizes(subscripts, word, scope)
        if counts is None:
            return None
        if len(counts) > 1:
            scope.log.report("E0304", "an array of these has one size", subscripts[1].span)
            return None
        scope.build.grow(counts[0], element.span)
        items = [
            check(element, f"{name}[{k + 1}]", one) for k, one in enumerate(scope.items(counts[0]))
        ]
        return None if None in items else Array(name, tuple(items))  # type: ignore[arg-type]

    _add(word, Pending(word, _needs([*used, *subscripts]), make), scope)


def _add(name: tree.Word, pending: Pending, scope: Scope) -> bool:
    """Give a name its declaration; a name of the language or one used twice is reported."""
    instance = scope.instance
    if name.text in BUILT_IN or name.text in RESERVED:
        message = f"{name.text!r} is a word of the language; choose another name"
        scope.log.report("E0502", message, name.span)
        return False
    first = instance.written.get(name.text)
    if first is not None:
        message = f"the name {name.text!r} is declared twice"
        scope.log.report("E0502", message, name.span, labels=(Label(first, "first here"),))
        return False
    instance.written[name.text] = name.span
    instance.names[name.text] = pending
    return True
