"""Tree to checked model: the order in which names, values, equations and connections are made."""

from __future__ import annotations

import sys

from frot.dsl import checked
from frot.dsl.catalogue import TYPES
from frot.dsl.data.collection import without_collection
from frot.dsl.declarations.instantiate import declare_values, instantiate
from frot.dsl.declarations.mechanism import complete_liaison
from frot.dsl.declarations.settle import entities, settle_all
from frot.dsl.expressions.rules import RULES
from frot.dsl.messages.diagnostics import Log
from frot.dsl.messages.source import Source, Span
from frot.dsl.names.choose import choose
from frot.dsl.names.classes import Class, Namespace
from frot.dsl.names.connections import Connections
from frot.dsl.names.imports import Libraries, tell_clashes
from frot.dsl.names.scope import Array, Build, Checks, Entity, Instance, TooLarge
from frot.dsl.quantities.dimensions import REAL, Type
from frot.dsl.statements.equations import Sink, statement
from frot.dsl.statements.open_flows import open_flows
from frot.dsl.statements.settings import (
    default_experiment,
    default_world,
    experiment,
    initial_statement,
    same_experiment,
    same_world,
    world,
)
from frot.dsl.statements.unfold import Leaf, unfold
from frot.dsl.statements.when import Setters, mark_discrete, when
from frot.dsl.text import tree
from frot.dsl.warn import warn, warn_angles, warn_impulses

# Frames of Python: nested expressions in declarations that wait for one another.
_DEEPEST = 10_000


def check(file: tree.Tree, log: Log, model: str | None = None) -> checked.Model | None:
    """The checked model of a file, or None if an error was reported."""
    _outside(file, log)
    libraries = Libraries(log)
    space = libraries.main(file)
    definition = choose(file, model, log)
    if definition is None:
        return None
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(max(limit, _DEEPEST))
    try:
        with without_collection():
            found = _model(definition, space, libraries, log)
    except TooLarge:
        return None
    finally:
        sys.setrecursionlimit(limit)
    return None if log.failed else found


def _outside(file: tree.Tree, log: Log) -> None:
    for element in file.elements:
        if not isinstance(element, tree.Definition | tree.Alias | tree.Import):
            log.report("E0501", "this statement stands outside of a model", element.span)
            return


def _model(
    definition: tree.Definition, space: Namespace, libraries: Libraries, log: Log
) -> checked.Model:
    of = space.own(definition.name.text)
    assert of is not None
    planar = definition.has("planar")
    build = _build(of, planar, libraries, log)
    root = instantiate(of, "", {}, "", definition.span, build)
    made = settle_all(build)
    for instance in made:
        _complete_liaisons(instance)
    statements = root.statements
    the_world = [world(call, scope) for call, scope in statements.worlds[:1]]
    holds = the_world[0] if the_world else default_world(planar)
    for instance in made:
        for call, scope in instance.statements.worlds[0 if instance.name else 1 :]:
            same_world(world(call, scope), holds, instance.name, scope)
    equations = _equations(made, build)
    experiments = [experiment(call, scope) for call, scope in statements.experiments[:1]]
    for call, scope in statements.experiments[1:]:
        same_experiment(call, statements.experiments[0][0], scope)
    found = [*_constants(build), *entities(root)]

    def of_kind(kind: type) -> tuple[Entity, ...]:
        return tuple(e for e in found if isinstance(e, kind))

    flanges = tuple(build.flanges)
    result = checked.Model(
        name=definition.name.text,
        planar=planar,
        parameters=of_kind(checked.Parameter),  # type: ignore[arg-type]
        inputs=of_kind(checked.Input),  # type: ignore[arg-type]
        outputs=of_kind(checked.Output),  # type: ignore[arg-type]
        world=holds,
        ground=build.ground,
        bodies=of_kind(checked.Body),  # type: ignore[arg-type]
        frames=of_kind(checked.Frame),  # type: ignore[arg-type]
        curves=of_kind(checked.Curve),  # type: ignore[arg-type]
        surfaces=of_kind(checked.Surface),  # type: ignore[arg-type]
        liaisons=of_kind(checked.Liaison),  # type: ignore[arg-type]
        forces=of_kind(checked.Force),  # type: ignore[arg-type]
        initial=tuple(build.initial),
        experiment=experiments[0] if experiments else default_experiment(),
        files=tuple(libraries.sources),
        span=definition.span,
        doc=definition.doc,
        variables=(*of_kind(checked.Variable), *(f.effort for f in flanges)),  # type: ignore[arg-type]
        equations=tuple(equations),
        flanges=flanges,
        whens=tuple(build.whens),
        assertions=tuple(build.assertions),
    )
    tell_clashes(libraries)
    if not log.failed:
        warn(made, build)
        warn_angles(result, log)
        warn_impulses(result, build.values, log)
    return result


def _build(of: Class, planar: bool, libraries: Libraries, log: Log) -> Build:
    """The state that scopes share, with the ground of a planar or a space model."""
    ground = checked.Body("ground", None, {}, None)
    source = of.outer.source
    places: dict[str, checked.Curve | checked.Surface] = {}
    if planar:
        arguments = {
            "through": _vector((0.0, 0.0), TYPES["Length"], source),
            "direction": _vector((1.0, 0.0), REAL, source),
        }
        places["line"] = checked.Curve("line", ground, "line", arguments, None)
    else:
        arguments = {
            "through": _vector((0.0, 0.0, 0.0), TYPES["Length"], source),
            "normal": _vector((0.0, 0.0, 1.0), REAL, source),
        }
        places["plane"] = checked.Surface("plane", ground, "plane", arguments, None)
    return Build(
        log, planar, ground, places, libraries, Connections(), Checks(RULES, declare_values)
    )


def _vector(values: tuple[float, ...], kind: Type, source: Source) -> checked.Vector:
    here = Span(source, 0, 0)
    items = tuple(checked.Literal(v, kind, here) for v in values)
    return checked.Vector(items, kind.of_shape((len(items),)), here)


def _complete_liaisons(instance: Instance) -> None:
    """Drives and laws are read once every name has its meaning: they may name any coordinate."""
    for node, scope in instance.statements.liaisons:
        declared = scope.find(node.name.text)
        if isinstance(declared, Array):
            of_items = scope.items(len(declared.items))
            for one, own in zip(declared.items, of_items, strict=True):
                if isinstance(one, checked.Liaison):
                    complete_liaison(node, one, own)
        else:
            alone = declared if isinstance(declared, checked.Liaison) else None
            complete_liaison(node, alone, scope)


def _equations(made: list[Instance], build: Build) -> list[checked.Equation | checked.IfEquations]:
    """Check all statements: what is set at events first, since `pre` asks for it."""
    leaves: list[Leaf] = []
    for instance in made:
        for element, scope in instance.statements.equations:
            leaves.extend(unfold(element, scope))
    for element, scope in leaves:
        if isinstance(element, tree.When):
            mark_discrete(element, scope)
    for bind in build.bindings:
        bind()
    sink = Sink(build.equations)
    setters: Setters = {}
    for leaf in leaves:
        if isinstance(leaf[0], tree.When):
            when(leaf[0], leaf[1], setters)
        else:
            statement(leaf, sink)
    for instance in made:
        for element, scope in instance.statements.initial:
            for inner, at in unfold(element, scope):
                initial_statement(inner, at)
        if instance.is_connector:
            for name in instance.flows:
                entity = instance.names[name]
                if isinstance(entity, checked.Variable):
                    build.connections.flow(entity, instance.span, instance)
    _check_before(build)
    held_open = open_flows(made, sink.made, build)
    return [*sink.made, *build.connections.finish(held_open, build.grow)]


def _check_before(build: Build) -> None:
    """`pre` and `change` are of what jumps."""
    for call, variable, _ in build.before:
        if not variable.discrete and variable.type.base == "real":
            build.log.report(
                "E0519",
                f"{call.function!r} of {variable.name!r}, which no 'when' sets: it does not jump",
                call.span,
                help="write the variable itself",
            )


def _constants(build: Build) -> list[Entity]:
    """The constants of packages that a text uses."""
    return [
        entity
        for package in build.packages.values()
        for entity in package.names.values()
        if isinstance(entity, checked.Parameter)
    ]
