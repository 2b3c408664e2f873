"""Functions of the user: a call becomes the function's expression, its inputs put in.

An argument stands as one object wherever its input is named, so that nested calls share their parts
and the outcome grows with the text, not with the number of paths through it.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from frot.dsl import checked
from frot.dsl.checked.order import in_order
from frot.dsl.checked.walk import height
from frot.dsl.expressions.expression import expression, fitting, value_of
from frot.dsl.expressions.records import as_record
from frot.dsl.expressions.structure import sizes
from frot.dsl.names.classes import Class
from frot.dsl.names.declared_types import Kind, find_type, role_of, split_type
from frot.dsl.names.imports import enter
from frot.dsl.names.near import did_you_mean
from frot.dsl.names.scope import (
    BUILT_IN,
    CALL,
    Entity,
    Instance,
    Pending,
    Record,
    Refused,
    Scope,
    settled,
)
from frot.dsl.text import tree
from frot.dsl.text.build_expressions import HIGHEST
from frot.dsl.text.tree_names import names_in

NESTED = 100


@dataclass(slots=True)
class _Function:
    """The declarations of a function by role, the values its body gives, and their order."""

    inputs: dict[str, tuple[tree.Component, tree.Declared]] = field(default_factory=dict)
    others: dict[str, tuple[tree.Component, tree.Declared]] = field(default_factory=dict)
    values: dict[str, tree.Expression] = field(default_factory=dict)
    outputs: list[str] = field(default_factory=list)
    order: list[str] = field(default_factory=list)
    sound: bool = True


def expand(of: Class, node: tree.Call, scope: Scope) -> checked.Expression | Record | None:
    """The value of a call of a function; None after a message."""
    build = scope.build
    if of in build.calls:
        path = " -> ".join(c.name for c in (*build.calls, of))
        scope.log.report("E0208", f"function {of.name!r} calls itself: {path}", node.span)
        return None
    if len(build.calls) >= NESTED:
        message = f"functions call one another more than {NESTED} levels deep"
        scope.log.report("E0108", message, node.span)
        return None
    build.grow(CALL, node.span)
    read = _read(of, scope)
    made = Instance("", of, of.definition.span)
    inner = Scope(build, made, enter(of, build.libraries))
    if not read.sound or not _bind(of, read, node, inner, scope):
        return None
    build.calls.append(of)
    try:
        for name, (clause, item) in read.others.items():
            made.names[name] = _local(name, clause, item, read, inner)
        for name in read.order:
            settled(made.names[name], name, made, build)
        (output,) = read.outputs
        found = settled(made.names[output], output, made, build)
    finally:
        build.calls.pop()
    if found is None or isinstance(found, Refused):
        return None
    assert isinstance(found, checked.Expression | Record)
    return found if _low_enough(found, node, scope) else None


# ------------------------------------------------------------------ the declarations


def _read(of: Class, scope: Scope) -> _Function:
    """Sort what stands in a function; faults are reported."""
    known = scope.build.functions.get(id(of.definition))
    if known is None:
        known = _sorted(of, scope)
        scope.build.functions[id(of.definition)] = known
    assert isinstance(known, _Function)
    return known


def _sorted(of: Class, scope: Scope) -> _Function:
    read = _Function()
    log = scope.log
    for element in of.elements:
        if isinstance(element, tree.Component):
            role = role_of(element)
            for item in element.declared:
                name = item.name.text
                if name in read.inputs or name in read.others or name in BUILT_IN:
                    log.report("E0502", f"the name {name!r} is declared twice", item.name.span)
                    read.sound = False
                if role == "input":
                    read.inputs[name] = (element, item)
                    continue
                read.others[name] = (element, item)
                if role == "output":
                    read.outputs.append(name)
                if item.value is not None:
                    read.values[name] = item.value
        elif isinstance(element, tree.Equation) and element.right is not None:
            _assigned(element, read, scope)
        elif not isinstance(element, tree.Section | tree.Import | tree.Definition | tree.Alias):
            read.sound = False
            log.report(
                "E0501",
                "a function holds declarations and values 'name = ...;' only",
                element.span,
                help="write 'if' as an expression: 'y = if c then a else b;'",
            )
    if len(read.outputs) != 1:
        read.sound = False
        count = "no output" if not read.outputs else f"{len(read.outputs)} outputs"
        log.report(
            "E0514",
            f"function {of.name!r} has {count}: it gives one value",
            of.definition.name.span,
            help="write 'output Real y = ...;', or put several values into a record",
        )
    read.order, _ = in_order({n: tuple(names_in(v)) for n, v in read.values.items()})
    for name, (_, item) in read.others.items():
        if name not in read.values:
            read.sound = False
            message = f"{name!r} of function {of.name!r} has no value"
            log.report("E0504", message, item.name.span, help=f"write '{name} = ...;'")
    return read


def _assigned(element: tree.Equation, read: _Function, scope: Scope) -> None:
    assert element.right is not None
    name = element.left.text if isinstance(element.left, tree.Name) else ""
    if name not in read.others:
        read.sound = False
        what = f"{name!r} is an input: it" if name in read.inputs else "this"
        message = f"{what} cannot be given a value in a function"
        help_text = did_you_mean(name, read.others) if name else ""
        scope.log.report("E0501", message, element.left.span, help=help_text)
    elif name in read.values:
        read.sound = False
        message = f"{name!r} is given a value twice: a name of a function has one value"
        scope.log.report("E0502", message, element.left.span)
    else:
        read.values[name] = element.right


# ------------------------------------------------------------------ one call


def _bind(of: Class, read: _Function, node: tree.Call, inner: Scope, scope: Scope) -> bool:
    """Check the arguments in the scope of the call and give them to the inputs."""
    given: dict[str, tree.Expression] = {}
    order = list(read.inputs)
    for position, argument in enumerate(node.arguments):
        if argument.name is None:
            name = order[position] if position < len(order) else ""
        else:
            name = argument.name.span.text
        if name not in read.inputs:
            message = f"function {of.name!r} has no input {name!r}"
            if not name:
                message = f"too many arguments for function {of.name!r}"
            help_text = did_you_mean(name, order, scope.log)
            notes = () if help_text else (f"its inputs are: {', '.join(order) or 'none'}",)
            scope.log.report("E0204", message, argument.span, notes=notes, help=help_text)
            return False
        if name in given:
            message = f"input {name!r} of {of.name!r} is given twice"
            scope.log.report("E0204", message, argument.span)
            return False
        given[name] = argument.value
    for name, (clause, item) in read.inputs.items():
        written, there = given.get(name), scope
        if written is None:
            written, there = item.value, inner
        if written is None:
            message = f"function {of.name!r} needs its input {name!r}"
            scope.log.report("E0204", message, node.span)
            return False
        value = _value(clause, item, written, inner, there)
        if value is None:
            return False
        inner.instance.names[name] = value
    return True


def _value(
    clause: tree.Component,
    item: tree.Declared,
    node: tree.Expression,
    inner: Scope,
    there: Scope,
) -> checked.Expression | Record | None:
    """The value written in one scope for a name declared in another."""
    type_node, type_sizes = split_type(clause)
    subscripts = (*type_sizes, *item.subscripts)
    known = inner.build.clauses
    if id(clause) not in known:
        known[id(clause)] = find_type(type_node, inner, True)
    kind = known[id(clause)]
    if kind is None:
        return None
    if isinstance(kind, Class):
        if kind.kind != "record":
            message = f"{kind.kind} {kind.name!r} is not a type of values"
            inner.log.report("E0206", message, type_node.span)
            return None
        return as_record(value_of(node, there), kind, node, there)
    assert isinstance(kind, Kind)
    found = expression(node, there)
    shape = sizes(subscripts, item.name, inner)
    if found is None or shape is None:
        return None
    return fitting(found, node, _typed(kind, shape).type, there, unit=kind.unit, rate=kind.rate)


def _typed(kind: Kind, shape: tuple[int, ...]) -> Kind:
    return Kind(kind.type.of_shape(shape), kind.name, kind.unit, kind.factor)


def _local(
    name: str, clause: tree.Component, item: tree.Declared, read: _Function, inner: Scope
) -> Pending:
    node = read.values[name]

    def check() -> Entity | None:
        return _value(clause, item, node, inner, inner)

    return Pending(item.name, tuple(names_in(node)), check, is_value=True)


def _low_enough(found: checked.Expression | Record, node: tree.Call, scope: Scope) -> bool:
    """Whether no expression became too high for the passes that walk it by recursion."""
    roots = [found] if not isinstance(found, Record) else list(_leaves(found))
    if all(height(root, scope.build.heights) <= HIGHEST for root in roots):
        return True
    message = f"the functions called here give an expression of more than {HIGHEST} levels"
    scope.log.report("E0108", message, node.span, help="give names to parts of it as variables")
    return False


def _leaves(record: Record) -> list[checked.Expression]:
    found: list[checked.Expression] = []
    for value in record.members.values():
        found += _leaves(value) if isinstance(value, Record) else [value]
    return found
