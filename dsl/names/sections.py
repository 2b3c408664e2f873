"""The elements of a class sorted by what they are, and what stands in a wrong place reported."""

from __future__ import annotations

from collections.abc import Callable

from frot.dsl.catalogue import TYPES
from frot.dsl.messages.diagnostics import Label
from frot.dsl.messages.source import Span
from frot.dsl.names.classes import Class
from frot.dsl.names.near import did_you_mean, near
from frot.dsl.names.scope import Scope, Statements
from frot.dsl.text import tree

# Calls that are statements of the section `equation`.
CALLS = ("connect", "assert")
_IN_WHEN = ("reinit", "terminate")
# What may be declared as an array, and how one is written.
_IN_ARRAYS = (tree.Body, tree.Liaison, tree.Force, tree.Component)
ITEMWISE = "'liaison feet[4]: contact_ponctuel(floor, b.corners);' is four, item by item"
_SECTIONS = ("initial", "equation")
_VALUES_ONLY = ("connector", "record")
_DEFINED_APART = tree.Import | tree.Alias | tree.Definition
_IN_VALUES = tree.Component | tree.Extends | tree.Import | tree.Alias | tree.Definition


def sort(
    of: Class,
    scope: Scope,
    result: Statements,
    extends: Callable[[tree.Extends], None],
    declaration: Callable[[tree.Element], None],
) -> None:
    """Hand over the declarations and bases of a class, keep its statements."""
    section = ""
    seen: dict[str, Span] = {}
    for element in of.elements:
        if of.kind in _VALUES_ONLY and not isinstance(element, _IN_VALUES):
            scope.log.report("E0501", f"a {of.kind} holds only variables", element.span)
        elif isinstance(element, tree.Section):
            section = _begin_section(element, section, seen, scope)
        elif isinstance(element, tree.Extends):
            _outside_of_sections(element, section, scope)
            extends(element)
        elif isinstance(element, _DEFINED_APART):
            _outside_of_sections(element, section, scope)
        elif isinstance(element, tree.Equation):
            _equation(element, section, result, scope)
        elif isinstance(element, tree.When | tree.For | tree.IfEquation):
            _block(element, section, result, scope)
        elif isinstance(element, tree.Relation):
            message = f"'{element.kind}' stands in liaisons only"
            scope.log.report("E0501", message, element.span)
        elif meant := _section_meant(element, scope):
            section = meant
        else:
            _outside_of_sections(element, section, scope)
            declaration(element)


def _begin_section(element: tree.Section, section: str, seen: dict[str, Span], scope: Scope) -> str:
    """The section that begins; Modelica's `initial equation` is one section."""
    own, before = element.span, seen.get("initial") if section == "initial" else None
    between = own.source.text[before.end : own.start] if before is not None else "\n"
    if between.isspace() and "\n" not in between:
        message = "'initial equation' is written 'initial' here"
        scope.log.report("E0501", message, own, help="leave out the word 'equation'")
        return section
    if element.name in seen:
        labels = (Label(seen[element.name], "first here"),)
        message = f"a second section {element.name!r}"
        scope.log.report("E0503", message, element.span, labels=labels)
    seen.setdefault(element.name, element.span)
    return element.name


def _section_meant(element: tree.Element, scope: Scope) -> str:
    """The section that a misspelt word begins, as in `equations x = 1;`; empty where it is none.

    The word reads as the type of a variable. What follows stands in the section that is meant.
    """
    if not (isinstance(element, tree.Component) and isinstance(element.type, tree.Name)):
        return ""
    word = element.type.text
    if element.prefixes or word in TYPES or not scope.knows(word):
        return ""
    meant = near(word, _SECTIONS)
    if not meant or near(word, (*TYPES, *_SECTIONS, *scope.space.visible())) != meant:
        return ""
    if scope.space.find(word) is not None:
        return ""
    scope.log.report(
        "E0206", f"unknown type {word!r}", element.type.span, help=f"did you mean {meant!r}?"
    )
    return meant


def _outside_of_sections(element: tree.Element, section: str, scope: Scope) -> None:
    if section:
        scope.log.report(
            "E0501",
            f"a declaration in the section {section!r}",
            element.span,
            help=f"put it before the word {section!r}",
        )


def called_name(element: tree.Element) -> str:
    """The name of a statement that is a call alone; empty for others."""
    if isinstance(element, tree.Equation) and element.right is None:
        left = element.left
        if isinstance(left, tree.Call) and isinstance(left.callee, tree.Name):
            return left.callee.text
    return ""


def _equation(element: tree.Equation, section: str, result: Statements, scope: Scope) -> None:
    name = called_name(element)
    call = element.left
    if name == "world" or name == "experiment":
        assert isinstance(call, tree.Call)
        _once(call, result.worlds if name == "world" else result.experiments, name, scope)
    elif name in _IN_WHEN:
        message = f"{name!r} stands in 'when' only"
        scope.log.report("E0501", message, element.span)
    elif name in CALLS:
        _in_equations(element, f"{name!r}", section, result, scope)
    elif element.right is None and name != "guess":
        what = f"{name!r} is not a statement" if name else "this is not a statement"
        known = ("world", "experiment", *CALLS, *_IN_WHEN, "guess")
        help_text = did_you_mean(name, known) or "an equation is written 'left = right;'"
        scope.log.report("E0501", what, element.span, help=help_text)
    elif section == "initial":
        result.initial.append((element, scope))
    elif section == "equation" and name != "guess":
        result.equations.append((element, scope))
    elif name == "guess":
        message = "a guess outside of the section 'initial'"
        scope.log.report("E0501", message, element.span)
    else:
        scope.log.report(
            "E0501",
            "an equation among the declarations",
            element.span,
            help="values at the start go after the word 'initial', equations after 'equation'",
        )


def _block(
    element: tree.When | tree.For | tree.IfEquation,
    section: str,
    result: Statements,
    scope: Scope,
) -> None:
    if section == "initial" and not isinstance(element, tree.When):
        result.initial.append((element, scope))
        return
    words = {tree.When: "'when'", tree.For: "'for'", tree.IfEquation: "'if'"}
    inner = element.elements if isinstance(element, tree.For) else ()
    declared = next((x for x in inner if isinstance(x, _IN_ARRAYS)), None)
    if declared is not None and not section:
        scope.log.report(
            "E0501", "a declaration in 'for'", declared.span, help="declare an array: " + ITEMWISE
        )
        return
    _in_equations(element, words[type(element)], section, result, scope)


def _in_equations(
    element: tree.Element, what: str, section: str, result: Statements, scope: Scope
) -> None:
    if section == "equation":
        result.equations.append((element, scope))
        return
    where = f"in the section {section!r}" if section else "among the declarations"
    scope.log.report(
        "E0501",
        f"{what} {where}",
        element.span,
        help="put it after the word 'equation'",
    )


def _once(call: tree.Call, found: list[tuple[tree.Call, Scope]], name: str, scope: Scope) -> None:
    # A model may have its own world and experiment beside those of its bases.
    own = [known for known, where in found if where is scope]
    if own:
        first = Label(own[0].span, "first here")
        scope.log.report("E0503", f"a second {name!r}", call.span, labels=(first,))
        return
    found.append((call, scope))
