"""Types of declarations: those of the language, those made by `type`, and classes."""

from __future__ import annotations

from dataclasses import dataclass

from frot.dsl.catalogue import TYPES
from frot.dsl.checked.describe import describe
from frot.dsl.messages.source import Span
from frot.dsl.names.classes import Class
from frot.dsl.names.imports import enter
from frot.dsl.names.modifiers import merge, read_modifiers
from frot.dsl.names.near import did_you_mean
from frot.dsl.names.scope import Instance, Modifier, Scope
from frot.dsl.quantities.dimensions import Enumeration, Type
from frot.dsl.quantities.spelling import corrected
from frot.dsl.quantities.turns import factor_between, rate_of_kind, rate_of_unit
from frot.dsl.quantities.units import Unit, UnknownUnit, parse_unit
from frot.dsl.text import tree

_LONGEST = 50
_FIXED = "a start value is held by a statement of `initial`: 'x = 1;'"
ROLES = ("parameter", "constant", "input", "output")
BOUNDS = ("min", "max")
ATTRIBUTES = (*BOUNDS, "nominal", "start", "unit")


@dataclass(frozen=True, slots=True)
class Kind:
    """The type of a value: `name` as in `Angle`, a unit of its own, a first value, a usual size.

    `bounds` are its `min` and `max`, as far as they are given.

    A bare number stands for a value in the unit, `factor` SI units.
    """

    type: Type
    name: str
    unit: str = ""
    factor: float | None = None
    start: Modifier | None = None
    nominal: Modifier | None = None
    bounds: tuple[tuple[str, Modifier], ...] = ()

    @property
    def rate(self) -> str:
        """The kind of rate it is: a frequency, an angular velocity, or an empty text."""
        return rate_of_kind(self.name, self.unit, self.type.dimension)


def split_call(
    node: tree.Expression,
) -> tuple[tree.Expression, tuple[tree.Argument, ...]]:
    """Callee and arguments of a call; a name alone has none."""
    return (node.callee, node.arguments) if isinstance(node, tree.Call) else (node, ())


def split_type(
    clause: tree.Component,
) -> tuple[tree.Expression, tuple[tree.Expression, ...]]:
    """The type of a clause, and the sizes written after it: `Real[3] x;`."""
    node = clause.type
    return (node.operand, node.subscripts) if isinstance(node, tree.Index) else (node, ())


def find_class(node: tree.Expression, scope: Scope) -> Class | None:
    """The class that `Name` or `Library.Name` names; None without a message."""
    if isinstance(node, tree.Name):
        return scope.space.find(node.text)
    if isinstance(node, tree.Member):
        owner = find_class(node.operand, scope)
        if owner is not None:
            enter(owner, scope.build.libraries)
            return owner.space.own(node.name.text)
    return None


def find_type(node: tree.Expression, scope: Scope, is_value: bool) -> Kind | Class | None:
    """The type a declaration names; None after a message, or where silence is due.

    `is_value`: the declaration is a parameter or the like, which no model can be, so that the name
    of a type of the language then means that type (`parameter Inertia J` beside a model `Inertia`).
    """
    found = find_class(node, scope)
    name = node.text if isinstance(node, tree.Name) else ""
    if name in TYPES and (found is None or (is_value and found.kind not in ("type", "record"))):
        return Kind(TYPES[name], name)
    if found is None:
        _tell_unknown(node, scope)
        return None
    if found.kind == "type":
        return alias(found, scope)
    return found


def _tell_unknown(node: tree.Expression, scope: Scope) -> None:
    written = node.span.text
    if not scope.knows(written.split(".")[0]):
        return
    last = written
    names = [*TYPES, *scope.space.visible()]
    if isinstance(node, tree.Member):
        owner = find_class(node.operand, scope)
        if owner is not None:
            if not owner.space.knows(node.name.text):
                return
            names, last = list(owner.space.definitions), node.name.text
    help_text = did_you_mean(last, names, scope.log)
    if last == written and "." in written:
        first = written.partition(".")[0]
        help_text = f"where {first!r} is a library, write 'import {first};' before"
    scope.log.report("E0206", f"unknown type {written!r}", node.span, help=help_text)


# ------------------------------------------------------------------ `type Name = ...;`


def alias(of: Class, scope: Scope) -> Kind | None:
    """The type made by a definition `type`; None after a message."""
    return _alias(of, scope, [])


def _alias(of: Class, scope: Scope, around: list[Class]) -> Kind | None:
    node = of.definition
    assert isinstance(node, tree.Alias)
    if of in around:
        path = " -> ".join(c.name for c in (*around[around.index(of) :], of))
        scope.log.report("E0208", f"types are made of each other: {path}", node.name.span)
        return None
    if len(around) > _LONGEST:
        message = f"more than {_LONGEST} types are made of each other"
        scope.log.report("E0108", message, node.name.span)
        return None
    literals = _literals(node, scope)
    if literals is not None:
        kind = Type("integer", enumeration=Enumeration(of.name, literals))
        return Kind(kind, of.name)
    value, arguments = split_call(node.value)
    here = Scope(scope.build, Instance("", of, node.span), of.outer)
    name = value.text if isinstance(value, tree.Name) else ""
    base: Kind | Class | None
    found = find_class(value, here)
    if name in TYPES and (found is None or found is of):
        base = Kind(TYPES[name], name)
    elif found is not None and found.kind == "type":
        base = _alias(found, scope, [*around, of])
    else:
        if found is not None:
            scope.log.report(
                "E0206", f"{found.kind} {found.name!r} is not a type of values", value.span
            )
        else:
            _tell_unknown(value, here)
        base = None
    return None if base is None else modified(base, read_modifiers(arguments, here), here)


def _literals(node: tree.Alias, scope: Scope) -> tuple[str, ...] | None:
    value = node.value
    if not (isinstance(value, tree.Call) and isinstance(value.callee, tree.Name)):
        return None
    if value.callee.text != "enumeration":
        return None
    found: list[str] = []
    for argument in value.arguments:
        if argument.name is not None or not isinstance(argument.value, tree.Name):
            message = "the literals of an enumeration are names"
            scope.log.report("E0204", message, argument.span)
        elif argument.value.text in found:
            message = f"the name {argument.value.text!r} is given twice"
            scope.log.report("E0502", message, argument.span)
        else:
            found.append(argument.value.text)
    return tuple(found)


def enumeration_of(of: Class, scope: Scope) -> Type | None:
    """The type of an enumeration; None if the class is none."""
    if of.kind != "type":
        return None
    kind = alias(of, scope)
    return kind.type if kind is not None and kind.type.enumeration is not None else None


def modified(kind: Kind, modifiers: dict[str, Modifier], scope: Scope) -> Kind | None:
    """The kind with the attributes given to it; None after a message."""
    known = attributes_of(kind.type)
    for name, modifier in modifiers.items():
        if name not in known:
            modifier.scope.log.report(
                "E0204",
                f"a {kind.name} has no attribute {name!r}",
                modifier.span,
                notes=(f"its attributes are: {', '.join(known)}",),
                help=did_you_mean(name, known) or (_FIXED if name == "fixed" else "leave it out"),
            )
            return None
    type_, unit, factor = kind.type, kind.unit, kind.factor
    if "unit" in modifiers:
        given = modifiers["unit"]
        if not isinstance(given.value, tree.Text):
            message = "a unit is given as a text: 'unit = \"N.m\"'"
            scope.log.report("E0302", message, given.span)
            return None
        found = unit_of(given.value.value, given.value.span, given.scope)
        if found is None:
            return None
        if found.offset:
            message = "degrees Celsius cannot be the unit of a type"
            scope.log.report("E0302", message, given.value.span)
            return None
        if kind.name != "Real" and found.dimension != type_.dimension:
            wrong = describe(Type(dimension=found.dimension), given.value.value)
            scope.log.report(
                "E0301", f"the unit of {describe(type_)} is not that of {wrong}", given.value.span
            )
            return None
        meant = rate_of_kind(kind.name, "", found.dimension)
        turn = factor_between(rate_of_unit(given.value.value, found.dimension), meant)
        type_ = Type("real", found.dimension, type_.shape)
        unit, factor = given.value.value, found.factor * turn
    start = merge(modifiers.get("start"), kind.start, scope)
    nominal = merge(modifiers.get("nominal"), kind.nominal, scope)
    before = dict(kind.bounds)
    merged = ((name, merge(modifiers.get(name), before.get(name), scope)) for name in BOUNDS)
    bounds = tuple((name, given) for name, given in merged if given is not None)
    return Kind(type_, kind.name, unit, factor, start, nominal, bounds)


def attributes_of(kind: Type) -> tuple[str, ...]:
    """The attributes that a variable of a type may have: numbers have bounds."""
    is_number = kind.base in ("real", "integer") and kind.enumeration is None
    return ATTRIBUTES if is_number else tuple(x for x in ATTRIBUTES if x not in BOUNDS)


def unit_of(text: str, span: Span, scope: Scope) -> Unit | None:
    """The unit written at a place; an unknown one is reported."""
    try:
        return parse_unit(text)
    except UnknownUnit as error:
        near = corrected(text) or error.near
        help_text = f"did you mean {near!r}?" if near else ""
        if "/" in text and not help_text and str(error).startswith("unknown"):
            help_text = "to divide by a variable leave spaces: 'a / b'"
        scope.log.report("E0302", str(error), span, help=help_text)
        return None


def role_of(clause: tree.Component) -> str:
    """`parameter`, `constant`, `input` or `output`; empty for a plain variable."""
    return next((w.text for w in clause.prefixes if w.text in ROLES), "")
