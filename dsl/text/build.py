"""Lark's parse to the tree of the language."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from typing import Any

from frot.dsl.messages.diagnostics import Label, Log
from frot.dsl.messages.source import Source, Span
from frot.dsl.text import tree
from frot.dsl.text.build_expressions import Dropped, Place, arguments, expression, string

_KINDS = {"joint": "liaison", "loi": "law"}


def build(root: Any, source: Source, lost: frozenset[str], log: Log) -> tree.Tree:
    """The tree of a file; wrong names after `end` are reported here."""
    at = Place(source, log)
    dropped: set[str] = set()
    elements = _elements(root.children, at, dropped)
    return tree.Tree(source, elements, lost | dropped)


def _elements(nodes: Iterable[Any], at: Place, dropped: set[str]) -> tuple[tree.Element, ...]:
    found = []
    for node in nodes:
        try:
            found.append(_ELEMENTS[node.data](node, at, dropped))
        except Dropped:
            dropped.update(re.findall(r"[^\W\d]\w*", at.span(node).text))
    return tuple(found)


def _pick(node: Any, data: str) -> Any:
    """The first child that is a node of this rule, or None."""
    return next((c for c in node.children if getattr(c, "data", None) == data), None)


def _doc(node: Any) -> str:
    """The trailing string of a statement."""
    last = node.children[-1] if node.children else None
    return string(last) if getattr(last, "type", None) == "STRING" else ""


def _subscripts(node: Any, at: Place) -> tuple[tree.Expression, ...]:
    found = _pick(node, "subscripts")
    return tuple(expression(c, at) for c in found.children) if found is not None else ()


def _default(node: Any, at: Place) -> tree.Expression | None:
    found = _pick(node, "default")
    return expression(found.children[0], at) if found is not None else None


def _is_element(node: Any) -> bool:
    return getattr(node, "data", None) in _ELEMENTS


# ------------------------------------------------------------------ definitions


def _definition(node: Any, at: Place, dropped: set[str]) -> tree.Definition:
    head = [c for c in node.children if not _is_element(c)]
    tokens = [c for c in head if getattr(c, "type", "")]
    prefixes = tuple(at.word(t) for t in tokens if t.type in ("PLANAR", "PARTIAL"))
    word = _pick(node, "liaison_word") or _pick(node, "law_word")
    kind = next((t for t in tokens if t.type not in ("PLANAR", "PARTIAL", "IDENT", "STRING")), None)
    keyword = str(word.children[0]) if word is not None else str(kind)
    name = at.word(next(t for t in tokens if t.type == "IDENT"))
    doc = next((string(t) for t in tokens if t.type == "STRING"), "")
    formals = _pick(node, "formals")
    span = at.span(node)
    _check_end(_pick(node, "end_name"), keyword, name, span, at)
    return tree.Definition(
        kind=_KINDS.get(keyword, keyword),
        keyword=keyword,
        prefixes=prefixes,
        name=name,
        formals=tuple(_formal(f, at) for f in formals.children) if formals is not None else (),
        doc=doc,
        elements=_elements((c for c in node.children if _is_element(c)), at, dropped),
        header=Span(at.source, span.start, name.span.end),
        span=span,
    )


def _check_end(end_name: Any, keyword: str, name: tree.Word, span: Span, at: Place) -> None:
    if end_name.children:
        dotted = end_name.children[0]
        written = ".".join(at.word(t).text for t in dotted.children)
        if written != name.text:
            at.log.report(
                "E0105",
                f"'end {written};' closes {keyword} {name.text!r}",
                at.span(dotted),
                labels=(Label(name.span, "opened here"),),
                help=f"write 'end {name.text};'",
            )
        return
    # An `end` that the parser put in at the end of the text is not written there; it was reported.
    tail = at.source.text[: span.end].rstrip("; \t\r\n")
    if tail.endswith("end"):
        at.log.report(
            "E0105",
            f"'end' of {keyword} {name.text!r} without its name",
            Span(at.source, len(tail) - 3, len(tail)),
            help=f"write 'end {name.text};'",
        )


def _formal(node: Any, at: Place) -> tree.Formal:
    first = expression(node.children[0], at)
    span = at.span(node)
    rest = [c for c in node.children[1:] if getattr(c, "data", "") != "default"]
    value = _default(node, at)
    if rest and getattr(rest[0], "type", "") == "IDENT":
        return tree.Formal(at.word(rest[0]), first, value, span, _subscripts(node, at))
    kind = expression(rest[0], at) if rest else None
    return tree.Formal(tree.Word(first.span.text, first.span), kind, value, span)


def _import(node: Any, at: Place, dropped: set[str]) -> tree.Import:
    path = tuple(at.word(t) for t in node.children[0].children)
    rest = node.children[1:]
    everything = any(t.type == "DOT_STAR" for t in rest)
    alias = next((at.word(t) for t in rest if t.type == "IDENT"), None)
    return tree.Import(path, everything, alias, at.span(node))


def _extends(node: Any, at: Place, dropped: set[str]) -> tree.Extends:
    return tree.Extends(expression(node.children[0], at), at.span(node))


def _alias(node: Any, at: Place, dropped: set[str]) -> tree.Alias:
    value = expression(node.children[1], at)
    return tree.Alias(at.word(node.children[0]), value, _doc(node), at.span(node))


def _section(node: Any, at: Place, dropped: set[str]) -> tree.Section:
    return tree.Section(str(node.children[0]), at.span(node))


# ------------------------------------------------------------------ declarations


def _component(node: Any, at: Place, dropped: set[str]) -> tree.Component:
    prefixes = tuple(at.word(c.children[0]) for c in node.children if c.data == "prefix")
    kind = node.children[len(prefixes)]
    declared = tuple(_declared(c, at) for c in node.children[len(prefixes) + 1 :])
    return tree.Component(prefixes, expression(kind, at), declared, at.span(node))


def _declared(node: Any, at: Place) -> tree.Declared:
    modifiers = _pick(node, "modifiers")
    return tree.Declared(
        at.word(node.children[0]),
        _subscripts(node, at),
        arguments(modifiers, at) if modifiers is not None else (),
        _default(node, at),
        _doc(node),
        at.span(node),
    )


def _named(node: Any, at: Place) -> tuple[str, tree.Word, tuple[tree.Expression, ...], Any]:
    """Keyword, name, subscripts and the rest of `word name: ...`."""
    keyword, name, *rest = node.children
    subscripts = _subscripts(node, at)
    rest = [c for c in rest if getattr(c, "data", "") != "subscripts"]
    return str(keyword.children[0]), at.word(name), subscripts, rest


def _body(node: Any, at: Place, dropped: set[str]) -> tree.Body:
    keyword, name, subscripts, rest = _named(node, at)
    shape = expression(rest[0], at)
    return tree.Body(keyword, name, subscripts, shape, _doc(node), at.span(node))


def _force(node: Any, at: Place, dropped: set[str]) -> tree.Force:
    keyword, name, subscripts, rest = _named(node, at)
    kind = expression(rest[0], at)
    return tree.Force(keyword, name, subscripts, kind, _doc(node), at.span(node))


def _liaison(node: Any, at: Place, dropped: set[str]) -> tree.Liaison:
    keyword, name, subscripts, rest = _named(node, at)
    driven = _pick(node, "driven")
    laws = _pick(node, "laws")
    return tree.Liaison(
        keyword=keyword,
        name=name,
        subscripts=subscripts,
        kind=expression(rest[0], at),
        driven=arguments(_pick(driven, "modifiers"), at) if driven is not None else None,
        driven_span=at.span(driven) if driven is not None else None,
        laws=tuple(expression(c, at) for c in laws.children) if laws is not None else (),
        doc=_doc(node),
        span=at.span(node),
    )


def _frame(node: Any, at: Place, dropped: set[str]) -> tree.Frame:
    keyword, name, _, rest = _named(node, at)
    origin = _pick(node, "at")
    rotated = _pick(node, "rotated")
    return tree.Frame(
        keyword,
        name,
        expression(rest[0], at),
        expression(origin.children[0], at) if origin is not None else None,
        arguments(rotated.children[0], at) if rotated is not None else None,
        _doc(node),
        at.span(node),
    )


def _curve(node: Any, at: Place, dropped: set[str]) -> tree.Curve:
    name, owner, kind = node.children[:3]
    return tree.Curve(
        at.word(name), expression(owner, at), expression(kind, at), _doc(node), at.span(node)
    )


def _surface(node: Any, at: Place, dropped: set[str]) -> tree.Surface:
    name, owner, kind = node.children[:3]
    return tree.Surface(
        at.word(name), expression(owner, at), expression(kind, at), _doc(node), at.span(node)
    )


# ------------------------------------------------------------------ equations


def _equation(node: Any, at: Place, dropped: set[str]) -> tree.Equation:
    sides = [expression(c, at) for c in node.children if hasattr(c, "data")]
    right = sides[1] if len(sides) > 1 else None
    return tree.Equation(sides[0], right, _doc(node), at.span(node))


def _relation(node: Any, at: Place, dropped: set[str]) -> tree.Relation:
    kind, left, right = node.children[:3]
    return tree.Relation(str(kind), expression(left, at), expression(right, at), at.span(node))


def _branches(nodes: list[Any], at: Place, dropped: set[str]) -> tuple[tree.Branch, ...]:
    """The leading condition with its elements, then the nodes of the other branches."""
    others = [n for n in nodes if getattr(n, "data", "") in ("elsewhen", "elseif", "else")]
    guarded = [n for n in nodes if n not in others]
    first = expression(guarded[0], at)
    found = [tree.Branch(first, _elements(guarded[1:], at, dropped), first.span)]
    for node in others:
        if node.data == "else":
            elements = _elements(node.children, at, dropped)
            found.append(tree.Branch(None, elements, at.span(node)))
        else:
            condition = expression(node.children[0], at)
            elements = _elements(node.children[1:], at, dropped)
            found.append(tree.Branch(condition, elements, at.span(node)))
    return tuple(found)


def _when(node: Any, at: Place, dropped: set[str]) -> tree.When:
    return tree.When(_branches(node.children[1:], at, dropped), at.span(node))


def _if(node: Any, at: Place, dropped: set[str]) -> tree.IfEquation:
    return tree.IfEquation(_branches(node.children[1:], at, dropped), at.span(node))


def _for(node: Any, at: Place, dropped: set[str]) -> tree.For:
    _, variable, over = node.children[:3]
    elements = _elements(node.children[3:], at, dropped)
    return tree.For(at.word(variable), expression(over, at), elements, at.span(node))


_ELEMENTS: dict[str, Callable[[Any, Place, set[str]], tree.Element]] = {
    "definition": _definition,
    "import": _import,
    "extends": _extends,
    "section": _section,
    "component": _component,
    "alias": _alias,
    "body": _body,
    "frame": _frame,
    "curve": _curve,
    "surface": _surface,
    "liaison": _liaison,
    "force": _force,
    "equation": _equation,
    "relation": _relation,
    "when": _when,
    "if_equation": _if,
    "for_equation": _for,
}
