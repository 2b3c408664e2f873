"""Modifiers: `J(m = 2, r(start = 0))`, each with the scope of whoever wrote it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from frot.dsl.messages.diagnostics import Label
from frot.dsl.messages.source import Span
from frot.dsl.names.classes import Class
from frot.dsl.names.near import did_you_mean
from frot.dsl.names.scope import Instance, Modifier, Scope
from frot.dsl.text import tree


def read_modifiers(arguments: Iterable[tree.Argument], scope: Scope) -> dict[str, Modifier]:
    """The modifiers of a list; what is none is reported."""
    found: dict[str, Modifier] = {}
    for argument in arguments:
        one = _read(argument, scope)
        if one is None:
            continue
        name, modifier = one
        other = found.get(name)
        if other is None:
            found[name] = modifier
        elif other.has_value and modifier.has_value:
            scope.log.report(
                "E0204",
                f"{name!r} is modified twice",
                argument.span,
                labels=(Label(other.span, "first here"),),
            )
        else:
            found[name] = _both(modifier, other)
    return found


def _read(argument: tree.Argument, scope: Scope) -> tuple[str, Modifier] | None:
    target: tree.Expression
    value: tree.Expression | None
    if argument.name is not None:
        target, value = argument.name, argument.value
    else:
        target, value = argument.value, None
    parts: dict[str, Modifier] = {}
    calls = isinstance(target, tree.Call)
    if isinstance(target, tree.Call):
        parts = read_modifiers(target.arguments, scope)
        target = target.callee
    made = Modifier(argument.span, scope, value, parts=parts, final=argument.final)
    while isinstance(target, tree.Member):
        made = Modifier(argument.span, scope, parts={target.name.text: made})
        target = target.operand
    if not isinstance(target, tree.Name) or not (argument.name or parts or calls):
        scope.log.report(
            "E0204",
            f"{argument.span.text!r} is not a modifier",
            argument.span,
            help="a modifier is written 'name = value'",
        )
        return None
    return target.text, made


def merge(outer: Modifier | None, inner: Modifier | None, scope: Scope) -> Modifier | None:
    """Both modifiers of one name, the outer one first; a final one cannot be overridden."""
    if outer is None or inner is None:
        return outer or inner
    if inner.final and outer.has_value:
        scope.log.report(
            "E0512",
            f"{inner.span.text!r} is final: it cannot be modified",
            outer.span,
            labels=(Label(inner.span, "final here"),),
        )
        return inner
    return _both(outer, inner)


def _both(first: Modifier, second: Modifier) -> Modifier:
    """Both modifiers as one, the parts of the first before those of the second."""
    giver = first if first.has_value else second
    covered = frozenset(second.parts) - frozenset(first.parts) if giver is first else frozenset()
    parts = dict(first.parts)
    for name, part in second.parts.items():
        parts[name] = _both(parts[name], part) if name in parts else part
    return replace(
        giver,
        parts=parts,
        final=first.final or second.final,
        covered=covered | giver.covered - frozenset(first.parts),
    )


def merged(
    outer: Mapping[str, Modifier], inner: Mapping[str, Modifier], scope: Scope
) -> dict[str, Modifier]:
    """Two sets of modifiers as one."""
    found = dict(outer)
    for name, modifier in inner.items():
        both = merge(found.get(name), modifier, scope)
        assert both is not None
        found[name] = both
    return found


def picked(modifiers: Mapping[str, Modifier], index: int, size: int) -> dict[str, Modifier]:
    """The modifiers as they are for one item of an array of components."""
    return {
        name: replace(m, parts=picked(m.parts, index, size), picks=(*m.picks, (index, size)))
        for name, m in modifiers.items()
    }


def tell_unknown(modifiers: Mapping[str, Modifier], instance: Instance, scope: Scope) -> None:
    """Report modifiers of names that the component does not have."""
    if instance.open:
        return
    for name, modifier in modifiers.items():
        if name not in instance.names and instance.of.space.knows(name):
            help_text = did_you_mean(name, instance.names, scope.log)
            listed = ", ".join(list(instance.names)[:12]) or "none"
            scope.log.report(
                "E0203",
                f"{instance.of.kind} {instance.of.name!r} has no {name!r} to modify",
                modifier.span,
                notes=() if help_text else (f"there are: {listed}",),
                help=help_text,
            )


def tell_conflict(
    base: Class,
    first: Mapping[str, Modifier],
    second: Mapping[str, Modifier],
    span: Span,
    scope: Scope,
) -> None:
    """Report what two ways to one base say differently of it: it stands in the component once."""
    for path, one, other in _differences(first, second, ""):
        said = [_said(one), _said(other)]
        said.sort(key=lambda text: not text)
        scope.log.report(
            "E0520",
            f"the base {base.name!r} is there once, but its {path!r} is given {said[0]} and "
            + (f"{said[1]}" if said[1] else "left as it is"),
            other.span if other is not None else span,
            labels=(Label(one.span, "the other way"),) if one is not None and other else (),
            help=f"say the same of {path!r} in both, or set it where both are used",
        )
        return


def _differences(
    first: Mapping[str, Modifier], second: Mapping[str, Modifier], around: str
) -> Iterator[tuple[str, Modifier | None, Modifier | None]]:
    for name in {**first, **second}:
        one, other = first.get(name), second.get(name)
        path = f"{around}.{name}" if around else name
        if _said(one) != _said(other):
            yield path, one, other
        parts = [{} if m is None else m.parts for m in (one, other)]
        yield from _differences(parts[0], parts[1], path)


def _said(modifier: Modifier | None) -> str:
    """The value a modifier gives, as it is written."""
    if modifier is None or modifier.value is None:
        return ""
    return " ".join(modifier.value.span.text.split())
