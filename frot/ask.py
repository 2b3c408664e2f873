"""Variables of the language that a run did not list: found by name, evaluated over its steps."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from frot.dsl import checked
from frot.dsl.catalogue import body_members, point_members
from frot.dsl.checked.liaison_variables import liaison_variables
from frot.dsl.messages.errors import FrotError, fail
from frot.dsl.quantities.dimensions import Type

if TYPE_CHECKING:
    from frot.compiled_model import CompiledModel
    from frot.compiler.equations.assembled import Assembled
    from frot.compiler.lowering.result_variables import Listed
    from frot.runtime.number_arrays import Floats
    from frot.runtime.program import Program
    from frot.runtime.run_values import RunValues

# What is not there to be evaluated at an instant: a mode is listed wherever there is one.
_LISTED_ALONE = "mode"
_SLIPS = ("slip", "tangential_force")
_STILL = ("encastrement", "fil", "libre", "rotoide", "tige")
ALIKE = 1e-4  # part of its size to which a second run may differ from the first
ASKED = "asked:"


@dataclass(frozen=True, slots=True, eq=False)
class Asked:
    """The variable `name` of an owner, or its component number `item`, -1 for the whole."""

    name: str
    node: checked.Quantity
    item: int


class _NotComputed(Exception):
    """A reaction that the run did not compute."""


def members_of(model: checked.Model) -> Iterator[tuple[str, Any, Mapping[str, Type]]]:
    """The owners of variables by name, with their members."""
    planar = model.planar
    for body in model.bodies:
        turns = body.shape is not None and body.shape.turns
        yield body.name, body, body_members(planar, turns)
        for point in body.shape.frames if body.shape else ():
            place = checked.BodyPoint(body, point, model.span)
            yield f"{body.name}.{point}", place, point_members(planar, turns)
    for frame in model.frames:
        yield frame.name, frame, point_members(planar)
    for liaison in model.liaisons:
        yield liaison.name, liaison, liaison_variables(liaison, planar)


def names_of(model: checked.Model) -> list[str]:
    """All variables that can be read, as scalars."""
    found = []
    for owner, thing, members in members_of(model):
        for name, kind in members.items():
            if name != _LISTED_ALONE and not (name in _SLIPS and _has_no_slip(model, thing)):
                found += [f"{owner}.{name}{tail}" for tail in _tails(kind)]
    return found


def _has_no_slip(model: checked.Model, thing: Any) -> bool:
    """Whether it is a joint of the plane without friction, at whose place nothing slips."""
    joint = model.planar and isinstance(thing, checked.Liaison)
    return joint and not thing.laws and thing.kind.name in _STILL


def _tails(kind: Type) -> list[str]:
    """Suffixes of components: `.x`, `.y`, `.z`, or `[1]` and so on."""
    if kind.is_scalar:
        return [""]
    count = kind.count
    return [f".{a}" for a in "xyz"[:count]] if count <= 3 else [f"[{k + 1}]" for k in range(count)]


def find(model: checked.Model, name: str) -> Asked | None:
    """The variable of a name, whole or one component; None where there is none."""
    from frot.runtime.run_values import listed_name

    plain = name.replace(" ", "")
    item = listed_name(plain)
    for owner, thing, members in members_of(model):
        if not plain.startswith(f"{owner}."):
            continue
        for member, kind in members.items():
            head = f"{owner}.{member}"
            if member == _LISTED_ALONE or not plain.startswith(head):
                continue
            node = checked.Quantity(thing, member, kind, model.span)
            if plain == head:
                return Asked(plain, node, -1 if kind.shape else 0)
            tails = _tails(kind)
            if kind.shape and item[len(head) :] in tails:
                return Asked(plain, node, tails.index(item[len(head) :]))
    return None


def components_of(model: checked.Model, name: str) -> list[str]:
    """The components of a vector; the name itself of anything else."""
    found = find(model, name)
    if found is None or found.item >= 0:
        return [name]
    return [f"{found.name}{tail}" for tail in _tails(found.node.type)]


def unit_of_asked(asked: Asked) -> str:
    """The SI unit of the variable."""
    kind = asked.node.type
    return "1" if kind.dimension.is_one else kind.dimension.unit


def ask(result: RunValues, names: list[str], times: Floats) -> dict[str, Floats]:
    """Values of variables that a run did not list, at times in any order, all at once.

    A reaction that the run did not compute changes its equations: the model is then run once more
    with it, and the two runs are compared.

    Raises:
        FrotError: E0805: there is no such variable; E0822: the runs are not alike.
    """
    model = result.model
    if model is None:
        raise fail(
            "E0805",
            f"the run of '{result.program.name}' lists no variable '{names[0]}'",
            help="ask results of `model.simulate(...)`, which know their model",
        )
    asked = _found(model, names, list(result))
    order = np.argsort(times, kind="stable")
    taken = _sampled(result, asked, np.asarray(times)[order])
    back = np.empty_like(order)
    back[order] = np.arange(len(order))
    return {one.name: values[back] for one, values in zip(asked, taken, strict=True)}


def _found(model: CompiledModel, names: Sequence[str], listed: Sequence[str]) -> list[Asked]:
    """The variables of these names; FrotError (E0805) for one that there is not."""
    text = model.checked()
    found = []
    for name in names:
        one = find(text, name)
        if one is None:
            from frot.runtime.run_values import nearest

            raise fail(
                "E0805",
                f"the model '{model.name}' has no variable '{name}'",
                help=nearest(name, [*listed, *names_of(text)]),
            )
        found.append(one)
    return found


def reading_program(model: CompiledModel, names: Sequence[str]) -> tuple[Program, list[str]]:
    """A program that lists all of these variables, and what they are called in it.

    It is the model's own where that lists them. FrotError (E0805) for a name that there is not, and
    for a vector.
    """
    program = model.program()
    listed = [v.name for v in program.variables]
    others = [name for name in names if name not in listed and name != "time"]
    if not others:
        return program, list(names)
    asked = _found(model, others, listed)
    for one in asked:
        if one.item < 0:
            tail = _tails(one.node.type)[0]
            words = f"'{one.name}' is a vector, and one number is read"
            raise fail("E0805", words, help=f"name a component, as '{one.name}{tail}'")
    program, outputs = _with_outputs(model, asked, frozenset())
    called = {
        name: outputs[_key(one)] + _tails(one.node.type)[one.item]
        for name, one in zip(others, asked, strict=True)
    }
    return program, [called.get(name, name) for name in names]


def _with_outputs(
    model: CompiledModel, asked: Sequence[Asked], moving: frozenset[str]
) -> tuple[Program, dict[str, str]]:
    """The program of the model with these variables as outputs, and their names by `_key`."""
    from frot.second import second_program

    nodes = {_key(one): one.node for one in asked}
    names = {key: f"asked_{k}" for k, key in enumerate(nodes)}

    def more(text: checked.Model) -> checked.Model:
        outputs = [
            checked.Output(names[key], node.type, _in(text, node), text.span)
            for key, node in nodes.items()
        ]
        return replace(text, outputs=(*text.outputs, *outputs))

    return second_program(model, "outputs: " + ", ".join(nodes), None, moving, change=more), names


def _sampled(result: RunValues, asked: list[Asked], times: Floats) -> list[Floats]:
    try:
        return _over_steps(result, asked, times)
    except (_NotComputed, ValueError):
        return _of_second_run(result, asked, times)


def _over_steps(result: RunValues, asked: list[Asked], times: Floats) -> list[Floats]:
    """By a second program over the recorded steps; _NotComputed where it has other states."""
    from frot.second import Second, second_program

    assert result.model is not None
    nodes = {_key(one): one.node.type.count for one in asked}

    def extra(system: Assembled) -> tuple[Listed, ...]:
        return tuple(x for one in asked for x in _listed(system, one))

    tag = "asked: " + ", ".join(nodes)
    program = second_program(result.model, tag, extra, result.moving)
    values = Second(result, program).at(times)
    columns = {v.name: k for k, v in enumerate(program.variables)}
    return [_columns(values, columns, one, ASKED) for one in asked]


def _key(one: Asked) -> str:
    """The name of the whole variable."""
    return _owner_name(one) + "." + one.node.name


def _owner_name(one: Asked) -> str:
    owner = one.node.owner
    return f"{owner.body.name}.{owner.name}" if isinstance(owner, checked.BodyPoint) else owner.name


def _listed(system: Assembled, one: Asked) -> Iterator[Listed]:
    import casadi as ca

    from frot.compiler.lowering.result_variables import Listed

    owner = one.node.owner
    variables = system.reduced.variables
    if isinstance(owner, checked.Liaison):
        # the same liaison of the model that was prepared
        own = {x.name: x for x in system.reduced.mechanism.model.liaisons}
        owner = own.get(owner.name, owner)
    else:
        owner = _same(system.reduced.mechanism.model, owner)
    try:
        value = variables.quantity(replace(one.node, owner=owner))
    except KeyError:
        raise _NotComputed from None
    for k, part in enumerate(ca.vertsplit(ca.densify(value))):
        yield Listed(f"{ASKED}{_key(one)}[{k}]", part, one.node.type.dimension, "")


def _same(model: checked.Model, owner: Any) -> Any:
    """The body, frame or point of this model with the name of another's."""
    if isinstance(owner, checked.BodyPoint):
        return replace(owner, body=_same(model, owner.body))
    every: tuple[Any, ...] = (*model.bodies, *model.frames)
    return next((x for x in every if x.name == owner.name), owner)


def _columns(values: Floats, columns: Mapping[str, int], one: Asked, prefix: str) -> Floats:
    first = columns[f"{prefix}{_key(one)}[0]"]
    whole = values[:, first : first + one.node.type.count]
    return whole if one.item < 0 else whole[:, one.item]


def _of_second_run(result: RunValues, asked: list[Asked], times: Floats) -> list[Floats]:
    """By a run of the model with the variables as outputs."""
    from frot.runtime import SimulationError

    model = result.model
    assert model is not None
    program, names = _with_outputs(model, asked, result.moving)
    try:
        again = model.run(program, **result.options)
    except SimulationError as error:
        if error.result is None:
            raise
        again = error.result
    _compare(result, again)
    clipped = np.clip(times, again.time[0], again.time[-1])
    values = again.at(clipped)
    found = []
    for one in asked:
        name, kind = names[_key(one)], one.node.type
        parts = [np.asarray(values[f"{name}{tail}"]) for tail in _tails(kind)]
        found.append(np.column_stack(parts) if one.item < 0 else parts[one.item])
    return found


def _in(model: checked.Model, node: checked.Quantity) -> checked.Quantity:
    owner: Any = node.owner
    if isinstance(owner, checked.Liaison):
        owner = next(x for x in model.liaisons if x.name == owner.name)
    else:
        owner = _same(model, owner)
    return replace(node, owner=owner)


def _compare(one: RunValues, other: RunValues) -> None:
    """FrotError (E0822) where two runs of the same motion went different ways."""
    last = min(one.time[-1], other.time[-1])
    here, there = one.at(float(last)), other.at(float(last))
    for v in one.program.variables:
        if v.name.endswith((".position.x", ".position.y", ".position.z", ".angle")):
            size = float(np.max(np.abs(one[v.name]), initial=1e-300))
            if v.name in there and abs(here[v.name] - there[v.name]) > ALIKE * max(size, 1e-12):
                raise FrotError(_not_alike(one, v.name))


def _not_alike(result: RunValues, name: str) -> Any:
    from frot.dsl.messages.diagnostics import Log

    log = Log()
    log.report(
        "E0822",
        f"the run of '{result.program.name}' with a reaction that it did not compute ends "
        f"elsewhere ('{name}'): small differences grow in this motion",
        None,
        help="declare the reaction as an output of the model, and run that",
    )
    return log
