"""Tree to checked model: the pass that binds names, checks dimensions and gathers the parts."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from frot.dsl import checked, tree
from frot.dsl.check_components import component, refused
from frot.dsl.check_geometry import body, curve, frame
from frot.dsl.check_mechanism import force, give_laws, liaison
from frot.dsl.check_sections import (
    default_experiment,
    default_world,
    experiment,
    initial,
    world,
)
from frot.dsl.choose import choose
from frot.dsl.diagnostics import Label, Log
from frot.dsl.order import in_order, names_in
from frot.dsl.scope import BUILT_IN, REFUSED, Entity, Refused, Scope, built_in_world
from frot.dsl.source import Span

_STATEMENTS = ("world", "experiment", "guess")
_LATER = ("connect", "assert", "terminate", "reinit", "annotation")
_UNSUPPORTED = {
    tree.Import: "imports",
    tree.Extends: "'extends'",
    tree.Alias: "type definitions",
    tree.Surface: "surfaces",
    tree.Relation: "relations",
    tree.When: "'when'",
    tree.IfEquation: "'if' equations",
    tree.For: "'for' loops",
    tree.Definition: "nested definitions",
}


@dataclass(slots=True)
class Declaration:
    """A named declaration waiting to be checked, and the names it holds."""

    name: tree.Word
    needs: tuple[str, ...]
    check: Callable[[], Entity | None]
    is_value: bool


@dataclass(slots=True)
class Sections:
    """The elements of a definition, sorted."""

    declarations: dict[str, Declaration] = field(default_factory=dict)
    worlds: list[tree.Call] = field(default_factory=list)
    experiments: list[tree.Call] = field(default_factory=list)
    initial: list[tree.Equation] = field(default_factory=list)


def check(file: tree.Tree, log: Log, model: str | None = None) -> checked.Model | None:
    """The checked model of a file, or None if an error was reported."""
    _outside(file, log)
    definition = choose(file, model, log)
    if definition is None:
        return None
    if not definition.has("planar"):
        log.report(
            "E0701",
            f"space models are not supported yet ({definition.name.text!r})",
            definition.header,
            help="a model of the x-y plane begins with 'planar model'",
        )
        return None
    found = _model(file, definition, log)
    return None if log.failed else found


def _outside(file: tree.Tree, log: Log) -> None:
    for element in file.elements:
        if isinstance(element, tree.Import):
            log.report("E0701", "imports are not supported yet", element.span)
        elif not isinstance(element, tree.Definition):
            log.report("E0501", "this statement stands outside of a model", element.span)
            return


def _model(file: tree.Tree, definition: tree.Definition, log: Log) -> checked.Model:
    ground, ground_line = built_in_world(file.source)
    scope = Scope(file.source, log, definition.has("planar"), ground, ground_line, file.lost)
    scope.open = any(isinstance(e, tree.Extends) for e in definition.elements)
    scope.open = scope.open or any(isinstance(e, tree.Import) for e in file.elements)
    defined = frozenset(
        e.name.text
        for e in (*file.elements, *definition.elements)
        if isinstance(e, tree.Definition | tree.Alias)
    )
    sections = _sort(definition, scope, defined)
    entities = _declare(sections.declarations, scope)
    for element in definition.elements:
        if isinstance(element, tree.Liaison):
            declared = scope.names.get(element.name.text)
            known = declared if isinstance(declared, checked.Liaison) else None
            give_laws(element, known, scope, defined)

    def of(kind: type) -> tuple[Entity, ...]:
        return tuple(e for e in entities if isinstance(e, kind))

    the_world = [world(w, scope) for w in sections.worlds]
    equations = [e for s in sections.initial for e in _initial(s, scope)]
    experiments = [experiment(e, scope) for e in sections.experiments]
    return checked.Model(
        definition.name.text,
        scope.planar,
        of(checked.Parameter),  # type: ignore[arg-type]
        of(checked.Input),  # type: ignore[arg-type]
        of(checked.Output),  # type: ignore[arg-type]
        the_world[0] if the_world else default_world(scope.planar),
        ground,
        of(checked.Body),  # type: ignore[arg-type]
        of(checked.Frame),  # type: ignore[arg-type]
        of(checked.Curve),  # type: ignore[arg-type]
        of(checked.Liaison),  # type: ignore[arg-type]
        of(checked.Force),  # type: ignore[arg-type]
        tuple(equations),
        experiments[0] if experiments else default_experiment(),
        (file.source,),
        definition.span,
        definition.doc,
    )


# ------------------------------------------------------------------ sorting


def _sort(definition: tree.Definition, scope: Scope, defined: frozenset[str]) -> Sections:
    """Sort the elements by section; tell what stands in a wrong place or is not supported."""
    result = Sections()
    section = ""
    seen: dict[str, Span] = {}
    for element in definition.elements:
        if isinstance(element, tree.Section):
            section = element.name
            if section in seen:
                first = Label(seen[section], "first here")
                scope.log.report(
                    "E0503", f"a second section {section!r}", element.span, labels=(first,)
                )
            seen.setdefault(section, element.span)
            if section == "equation":
                message = "the section 'equation' is not supported yet"
                before = definition.elements[max(0, definition.elements.index(element) - 1)]
                twice = isinstance(before, tree.Section) and before is not element
                help_text = "the first values are in the section 'initial', alone" if twice else ""
                scope.log.report("E0701", message, element.span, help=help_text)
        elif isinstance(element, tree.Equation):
            _sort_equation(element, section, result, scope)
        elif type(element) in _UNSUPPORTED:
            if section != "equation":
                message = f"{_UNSUPPORTED[type(element)]} are not supported yet"
                message = message.replace("' are", "' is")
                scope.log.report("E0701", message, element.span)
            if isinstance(element, tree.Surface | tree.Alias | tree.Definition):
                scope.names[element.name.text] = REFUSED
        else:
            if section:
                scope.log.report(
                    "E0501",
                    f"a declaration in the section {section!r}",
                    element.span,
                    help=f"put it before the word {section!r}",
                )
            _declaration(element, result, scope, defined)
    return result


def _sort_equation(element: tree.Equation, section: str, result: Sections, scope: Scope) -> None:
    call = element.left if isinstance(element.left, tree.Call) else None
    name = ""
    if element.right is None and call is not None and isinstance(call.callee, tree.Name):
        name = call.callee.text
    if name == "world":
        _once(call, result.worlds, "world", scope)
    elif name == "experiment":
        _once(call, result.experiments, "experiment", scope)
    elif section == "equation":
        return
    elif name in _LATER:
        scope.log.report("E0701", f"{name!r} is not supported yet here", element.span)
    elif element.right is None and name != "guess":
        what = f"{name!r} is not a statement" if name else "this is not a statement"
        scope.log.report("E0501", what, element.span, help="an equation is written 'left = right;'")
    elif section == "initial":
        result.initial.append(element)
    else:
        scope.log.report(
            "E0501",
            "an equation among the declarations",
            element.span,
            help="values at the start go after the word 'initial'",
        )


def _once(call: tree.Call | None, found: list[tree.Call], name: str, scope: Scope) -> None:
    assert call is not None
    if found:
        first = Label(found[0].span, "first here")
        scope.log.report("E0503", f"a second {name!r}", call.span, labels=(first,))
        return
    found.append(call)


# ------------------------------------------------------------------ declarations


def _declaration(
    element: tree.Element, result: Sections, scope: Scope, defined: frozenset[str]
) -> None:
    match element:
        case tree.Component():
            skip = refused(element, scope, defined)
            for item in element.declared:
                if skip:
                    scope.names[item.name.text] = REFUSED
                    continue
                starts = [m.value for m in item.modifiers]
                _add(
                    item.name,
                    [item.value, *starts],
                    lambda c=element, i=item: component(c, i, scope),  # type: ignore[misc]
                    result,
                    scope,
                    is_value=True,
                )
        case tree.Body():
            _add(
                element.name, [element.shape], lambda: body(element, scope, defined), result, scope
            )
        case tree.Frame():
            used = [element.owner, element.origin, *(a.value for a in element.rotation or ())]
            _add(element.name, used, lambda: frame(element, scope), result, scope)
        case tree.Curve():
            used = [element.owner, element.kind]
            _add(element.name, used, lambda: curve(element, scope), result, scope)
        case tree.Liaison():
            used = [element.kind]
            _add(element.name, used, lambda: liaison(element, scope, defined), result, scope)
        case tree.Force():
            _add(element.name, [element.kind], lambda: force(element, scope), result, scope)


def _add(
    name: tree.Word,
    used: Sequence[tree.Expression | None],
    check_it: Callable[[], Entity | None],
    result: Sections,
    scope: Scope,
    *,
    is_value: bool = False,
) -> None:
    if name.text in BUILT_IN:
        message = f"{name.text!r} is a name of the language; choose another"
        scope.log.report("E0502", message, name.span)
        return
    if name.text in result.declarations:
        first = Label(result.declarations[name.text].name.span, "first here")
        message = f"the name {name.text!r} is declared twice"
        scope.log.report("E0502", message, name.span, labels=(first,))
        return
    needs = tuple(n for e in used for n in names_in(e))
    result.declarations[name.text] = Declaration(name, needs, check_it, is_value)


def _declare(declarations: dict[str, Declaration], scope: Scope) -> list[Entity]:
    """Check the declarations, each after those it names; give them in the order written."""
    order, circles = in_order({n: d.needs for n, d in declarations.items()})
    for circle in circles:
        _tell_circle(circle, declarations, scope)
    found: dict[str, Entity | Refused] = scope.names
    for name in order:
        if name not in found:
            entity = declarations[name].check()
            found[name] = REFUSED if entity is None else entity
    return [e for n in declarations if not isinstance(e := found[n], Refused)]


def _tell_circle(circle: list[str], declarations: dict[str, Declaration], scope: Scope) -> None:
    first = declarations[circle[0]]
    path = " -> ".join((*circle, circle[0]))
    if len(circle) == 1:
        message = f"{circle[0]!r} depends on itself"
    else:
        what = "parameters" if all(declarations[n].is_value for n in circle) else "declarations"
        message = f"{what} depend on each other in a circle: {path}"
    labels = tuple(Label(declarations[n].name.span, "part of it") for n in circle[1:])
    if all(scope.names.get(n) is not REFUSED for n in circle):
        scope.log.report("E0208", message, first.name.span, labels=labels)
    for name in circle:
        scope.names[name] = REFUSED


def _initial(statement: tree.Equation, scope: Scope) -> list[checked.InitialEquation]:
    if statement.right is not None:
        found = initial(statement.left, statement.right, statement.span, False, scope)
        return [] if found is None else [found]
    assert isinstance(statement.left, tree.Call)
    result = []
    for argument in statement.left.arguments:
        if argument.name is None:
            scope.log.report("E0204", "a guess is written 'guess(x = ...)'", argument.span)
            continue
        found = initial(argument.name, argument.value, argument.span, True, scope)
        if found is not None:
            result.append(found)
    return result
