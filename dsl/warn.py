"""Warnings: what is surely not meant, reported once a model is without faults."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterator, Mapping

from frot.dsl import checked
from frot.dsl.checked.evaluation import NotConstant, evaluate
from frot.dsl.messages.diagnostics import Log
from frot.dsl.messages.source import Source, Span
from frot.dsl.names.classes import Class, Imported
from frot.dsl.names.scope import Array, Build, Entity, Instance, Pending, Refused
from frot.dsl.text import tree


def warn(made: list[Instance], build: Build) -> None:
    """Report what a sound model says in vain, in the file that is checked and not in libraries."""
    main = build.libraries.sources[0]
    words = Counter(re.findall(r"\w+", main.text))
    for imported in build.libraries.imports:
        _unused_import(imported, words, main, build)
    _unused_parameters(made, words, main, build)
    for instance in made:
        for name, entity in instance.names.items():
            _loose(name, entity, main, build)
    connectors = {id(i.of.definition): i for i in made if i.is_connector}
    for connector in connectors.values():
        _unbalanced(connector, main, build)


def _unused_import(imported: Imported, words: Counter[str], main: Source, build: Build) -> None:
    statement = imported.statement
    if statement.span.source is not main or imported.used or imported.target is None:
        return
    if statement.all:
        # Other models of the text may need it.
        if len(re.findall(r"^\s*end\s+\w+\s*;", main.text, re.MULTILINE)) > 1:
            return
    else:
        word = (statement.alias or statement.path[-1]).text
        if words[word] > 1:
            return
    build.log.report("W0101", "nothing of this import is used", statement.span)


def _unused_parameters(
    made: list[Instance], words: Counter[str], main: Source, build: Build
) -> None:
    """A parameter that nothing names, in any of the components of its class."""
    unused: dict[Span, checked.Parameter] = {}
    used: set[Span] = set()
    for instance in made:
        if instance.of.kind != "model":
            continue
        for entity in instance.names.values():
            if isinstance(entity, checked.Parameter) and entity.span.source is main:
                if id(entity) in build.used:
                    used.add(entity.span)
                else:
                    unused.setdefault(entity.span, entity)
    for span, parameter in unused.items():
        name = parameter.name.rpartition(".")[2]
        # A branch of `if` that is not taken, or another model of the text, may name it.
        if span not in used and words[name] == 1:
            word = "constant" if parameter.constant else "parameter"
            build.log.report("W0102", f"{word} {name!r} is used nowhere", span)


def _loose(name: str, entity: Entity | Pending | Refused, main: Source, build: Build) -> None:
    """A component with connectors that nothing connects or names."""
    one = entity
    while isinstance(one, Array):
        one = one.items[0]
    if not isinstance(one, Instance) or one.of.kind != "model" or one.span.source is not main:
        return
    if id(entity) in build.used or not any(
        isinstance(e, Instance) and e.is_connector for e in one.names.values()
    ):
        return
    if isinstance(entity, Array) and any(id(i) in build.used for i in entity.items):
        return
    build.log.report("W0103", f"component {name!r} is connected to nothing", one.span)


def _unbalanced(connector: Instance, main: Source, build: Build) -> None:
    """A connector whose flows are not as many as its potentials."""
    if connector.of.definition.span.source is not main:
        return
    flows, potentials = _counts(connector.of, connector)
    if flows == potentials:
        return
    definition = connector.of.definition
    build.log.report(
        "W0104",
        f"connector {connector.of.name!r} has {flows} flows and {potentials} potentials",
        definition.name.span,
    )


def _counts(of: Class, connector: Instance) -> tuple[int, int]:
    """The scalars of a connector: flows, and what is neither flow nor signal."""
    signals = {
        item.name.text
        for element in of.elements
        if isinstance(element, tree.Component)
        and any(w.text in ("input", "output") for w in element.prefixes)
        for item in element.declared
    }
    flows = potentials = 0
    for name, entity in connector.names.items():
        if isinstance(entity, checked.Variable) and name not in signals:
            if name in connector.flows:
                flows += entity.type.count
            else:
                potentials += entity.type.count
    return flows, potentials


def warn_impulses(
    model: checked.Model, values: Mapping[checked.Parameter, object], log: Log
) -> None:
    """Report impulses at instants that the experiment does not reach, where these are known."""
    begin = _known(model.experiment.start, values)
    end = _known(model.experiment.stop, values)
    for force in model.forces:
        given = force.arguments.get("at")
        at = _known(given, values) if isinstance(given, checked.Expression) else None
        if force.kind.name != "impulse" or at is None:
            continue
        if at < (begin or 0.0):
            when = f"before the run begins at {begin or 0.0:g} s"
        elif end is not None and at > end:
            when = f"after the run ends at {end:g} s"
        else:
            continue
        log.report(
            "W0106", f"impulse {force.name!r} never acts: it is due at {at:g} s, {when}", force.span
        )


def _known(
    node: checked.Expression | None, values: Mapping[checked.Parameter, object]
) -> float | None:
    """The value with the parameters' defaults; None where it varies or is not given."""
    if node is None:
        return None
    try:
        found = evaluate(node, values)
    except (NotConstant, KeyError, ValueError):
        return None
    return float(found) if isinstance(found, float) else None


def warn_angles(model: checked.Model, log: Log) -> None:
    """Report bare numbers beyond one turn where an angle is given; a bare number is in radians."""
    for value in (leaf for angle in _angles(model) for leaf in _leaves(angle)):
        literal = value.operand if isinstance(value, checked.Unary) else value
        if not isinstance(literal, checked.Literal) or literal.unit:
            continue
        number = float(literal.value)
        if number <= 2 * math.pi or value.span.source is not model.files[0]:
            continue
        log.report(
            "W0105",
            f"this angle is {value.span.text} rad, {number / (2 * math.pi):.3g} turns",
            value.span,
            help=f"write '{value.span.text} deg', or '{value.span.text} rad' if that is meant",
        )


def _angles(model: checked.Model) -> Iterator[checked.Expression]:
    for parameter in model.parameters:
        if parameter.quantity == "Angle":
            yield parameter.value
    for given in model.inputs:
        if given.quantity == "Angle":
            yield given.start
    for variable in model.variables:
        if variable.quantity == "Angle" and variable.start is not None:
            yield variable.start
    for frame in model.frames:
        if frame.angle is not None:
            yield frame.angle
    for output in model.outputs:
        if output.quantity == "Angle":
            yield output.value
    for liaison in model.liaisons:
        yield from (value for name, value in liaison.driven.items() if name.startswith("angle"))
    for left, right in _set_equal(model):
        if _is_angle(left):
            yield right
        elif _is_angle(right):
            yield left
    for when in model.whens:
        for action in (action for _, actions in when.branches for action in actions):
            if (isinstance(action, checked.Reinit) and _is_angle(action.target)) or (
                isinstance(action, checked.Assign) and action.variable.quantity == "Angle"
            ):
                yield action.value


def _set_equal(model: checked.Model) -> Iterator[tuple[checked.Expression, checked.Expression]]:
    """The sides of all equations, those of every branch too."""
    left = [*model.equations, *model.initial][::-1]
    while left:
        equation = left.pop()
        if isinstance(equation, checked.IfEquations):
            left.extend(one for _, branch in equation.branches[::-1] for one in branch[::-1])
        else:
            yield equation.left, equation.right


def _leaves(node: checked.Expression) -> Iterator[checked.Expression]:
    """Expressions in the items of a tuple and the branches of an `if`."""
    if isinstance(node, checked.Vector):
        for item in node.items:
            yield from _leaves(item)
    elif isinstance(node, checked.If):
        yield from (*_leaves(node.yes), *_leaves(node.no))
    else:
        yield node


def _is_angle(node: checked.Expression) -> bool:
    while isinstance(node, checked.Element):
        node = node.operand
    match node:
        case checked.Quantity(name="angle"):
            return True
        case checked.Reference(target=target):
            return target.quantity == "Angle"
    return False
