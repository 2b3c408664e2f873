"""The statements `world`, `experiment`, and those of the section `initial`."""

from __future__ import annotations

import math
from collections.abc import Sequence

from frot.dsl import checked
from frot.dsl.catalogue import Argument
from frot.dsl.catalogue.types import ACCELERATION, TIME
from frot.dsl.checked.describe import describe, quantity
from frot.dsl.checked.evaluation import constant
from frot.dsl.declarations.argument_values import word
from frot.dsl.declarations.arguments import bind
from frot.dsl.expressions.known import known
from frot.dsl.messages.diagnostics import Label
from frot.dsl.messages.source import Span
from frot.dsl.names.near import did_you_mean
from frot.dsl.names.scope import Scope
from frot.dsl.names.sections import called_name
from frot.dsl.quantities.dimensions import REAL
from frot.dsl.statements.equations import both_sides
from frot.dsl.text import tree

_GRAVITY = Argument("gravity", ACCELERATION, required=False, sign="nonnegative")
_DOWN = Argument("down", REAL, "vector", required=False)
_EXPERIMENT = (
    Argument("stop", TIME, required=False),
    Argument("start", TIME, required=False),
    Argument("tolerance", REAL, required=False, sign="positive"),
    Argument("interval", TIME, required=False, sign="positive"),
    Argument("max_step", TIME, required=False, sign="positive"),
)
_WORDS = {
    "method": ("auto", "explicit", "implicit", "timestepping"),
    "on_impasse": ("impact", "stop"),
    "on_indeterminate": ("rest", "continue", "stop", "impact"),
}
TOLERANCES = (1e-14, 1e-1)
_STANDARD = 9.81  # m/s^2


def _split(
    arguments: Sequence[tree.Argument], names: Sequence[str]
) -> tuple[list[tree.Argument], dict[str, tree.Argument]]:
    """The arguments bound as values, and those whose value is a word."""
    words = {
        a.name.text: a for a in arguments if isinstance(a.name, tree.Name) and a.name.text in names
    }
    return [a for a in arguments if a not in words.values()], words


# ------------------------------------------------------------------ world


def default_world(planar: bool) -> checked.World:
    """Gravity as it is where the text is silent."""
    return checked.World(None, "-y" if planar else "-z", None)


def world(call: tree.Call, scope: Scope) -> checked.World:
    """The world of `world(gravity = ..., down = -y)`; `down` may be a vector of parameters."""
    rest, words = _split(call.arguments, ("down",))
    axis = None
    if "down" in words and _is_axis(words["down"].value):
        axis = _direction(words["down"].value, scope)
    else:
        rest = list(call.arguments)
    found = bind(rest, (_GRAVITY, _DOWN), "world", call.span, scope, constants=True)
    down = axis or found.values.get("down") or default_world(scope.planar).down
    gravity = found.values.get("gravity")
    return checked.World(gravity, down, call.span)  # type: ignore[arg-type]


def _falls(world: checked.World, scope: Scope) -> tuple[object, ...]:
    """Size and unit vector of gravity as far as they are known, to be compared."""
    size = _STANDARD if world.gravity is None else known(world.gravity, scope)
    if isinstance(world.down, str):
        sign = -1.0 if world.down[0] == "-" else 1.0
        return size, tuple(sign * (axis == world.down[1]) for axis in "xyz"[: scope.size])
    items = known(world.down, scope)
    if not isinstance(items, tuple) or not (length := math.hypot(*items)):
        return size, world.down.span.text
    return size, tuple(item / length for item in items)


def same_world(found: checked.World, holds: checked.World, component: str, scope: Scope) -> None:
    """Tell a component, or another base, whose world is not that of the model: there is one."""
    if _falls(found, scope) == _falls(holds, scope):
        return
    assert found.span is not None
    whose = f"component {component!r}" if component else "this base"
    other = "that of the model" if component else "that of another base"
    scope.log.report(
        "E0521",
        f"the world of {whose} is not {other}",
        found.span,
        labels=(Label(holds.span, other),) if holds.span is not None else (),
        help="write the 'world(...)' that is meant in the model itself, or take this one away",
    )


def _is_axis(node: tree.Expression) -> bool:
    inner = node.operand if isinstance(node, tree.Prefix) else node
    return isinstance(inner, tree.Name) and inner.text in ("x", "y", "z")


def _direction(node: tree.Expression, scope: Scope) -> str | None:
    sign, axis = "+", node
    if isinstance(node, tree.Prefix) and node.op in "+-":
        sign, axis = node.op, node.operand
    axes = ("x", "y") if scope.planar else ("x", "y", "z")
    if isinstance(axis, tree.Name) and axis.text in axes:
        return sign + axis.text
    shown = ", ".join(f"{s}{a}" for a in axes for s in "+-")
    message = f"'down' is one of {shown}, or a vector, found {node.span.text!r}"
    scope.log.report("E0404", message, node.span)
    return None


# ------------------------------------------------------------------ experiment


def same_experiment(call: tree.Call, first: tree.Call, scope: Scope) -> None:
    """Tell a base whose experiment is not, word for word, that of another base."""
    if call.span.text != first.span.text:
        scope.log.report(
            "E0503",
            "the experiment of this base is not that of another base",
            call.span,
            labels=(Label(first.span, "that of another base"),),
            help="write the 'experiment(...)' that is meant in the model itself",
        )


def default_experiment() -> checked.Experiment:
    """The options of a run where the text is silent."""
    return checked.Experiment(
        stop=None,
        start=None,
        tolerance=None,
        interval=None,
        max_step=None,
        method="auto",
        on_impasse="impact",
        on_indeterminate="rest",
        span=None,
    )


def experiment(call: tree.Call, scope: Scope) -> checked.Experiment:
    """The options of `experiment(stop = 3 s, ...)`."""
    rest, words = _split(call.arguments, tuple(_WORDS))
    all_names = (*_EXPERIMENT, *(Argument(n, kind="word", words=w) for n, w in _WORDS.items()))
    for argument in rest:
        if isinstance(argument.name, tree.Name) and argument.name.text not in [
            a.name for a in _EXPERIMENT
        ]:
            name = argument.name.text
            help_text = did_you_mean(name, [a.name for a in all_names])
            message = f"'experiment' has no option {name!r}"
            scope.log.report("E0204", message, argument.name.span, help=help_text)
            rest = [a for a in rest if a is not argument]
    found = bind(rest, _EXPERIMENT, "experiment", call.span, scope, constants=True)
    chosen = {"method": "auto", "on_impasse": "impact", "on_indeterminate": "rest"}
    for name, argument in words.items():
        chosen[name] = word(argument.value, _WORDS[name], name, scope) or chosen[name]
    values: dict[str, checked.Expression | None] = {
        a.name: found.values.get(a.name)  # type: ignore[misc]
        for a in _EXPERIMENT
    }
    _check_times(values, scope)
    return checked.Experiment(
        stop=values["stop"],
        start=values["start"],
        tolerance=values["tolerance"],
        interval=values["interval"],
        max_step=values["max_step"],
        method=chosen["method"],
        on_impasse=chosen["on_impasse"],
        on_indeterminate=chosen["on_indeterminate"],
        span=call.span,
    )


def _check_times(values: dict[str, checked.Expression | None], scope: Scope) -> None:
    stop, start, tolerance = values["stop"], values["start"], values["tolerance"]
    if stop is not None:
        last = known(stop, scope)
        first = known(start, scope) if start is not None else 0.0
        if isinstance(last, float) and isinstance(first, float) and last <= first:
            message = f"stop = {quantity(last, TIME)} is not after start = {quantity(first, TIME)}"
            scope.log.report("E0402", message, stop.span)
    if tolerance is not None:
        value = known(tolerance, scope)
        low, high = TOLERANCES
        if isinstance(value, float) and value > 0 and not low <= value <= high:
            message = f"tolerance must be between {low:g} and {high:g}; it is {value:g}"
            scope.log.report("E0402", message, tolerance.span)


# ------------------------------------------------------------------ initial


def initial_statement(element: tree.Element, scope: Scope) -> None:
    """Check a statement of the section `initial` and keep what it says."""
    if isinstance(element, tree.IfEquation):
        scope.log.report(
            "E0501",
            "an 'if' of the section 'initial' whose condition can change",
            element.span,
            help="use a Boolean or Integer parameter, or an expression 'if c then a else b'",
        )
        return
    if isinstance(element, tree.When):
        message = "a 'when' in the section 'initial'"
        help_text = "put it after the word 'equation'; 'when initial() then' acts at the start"
        scope.log.report("E0501", message, element.span, help=help_text)
        return
    assert isinstance(element, tree.Equation)
    if element.right is not None:
        _initial(element.left, element.right, element.span, False, scope)
        return
    name = called_name(element)
    if name != "guess":
        message = f"{name!r} in the section 'initial'" if name else "this is not a statement"
        scope.log.report("E0501", message, element.span, help="put it after the word 'equation'")
        return
    assert isinstance(element.left, tree.Call)
    for argument in element.left.arguments:
        if argument.name is None:
            scope.log.report("E0204", "a guess is written 'guess(x = ...)'", argument.span)
        else:
            _initial(argument.name, argument.value, argument.span, True, scope)


def _initial(
    left: tree.Expression, right: tree.Expression, span: Span, guess: bool, scope: Scope
) -> None:
    sides = both_sides(left, right, scope)
    for first, second in sides or ():
        set_by_when = (
            isinstance(first, checked.Reference)
            and isinstance(first.target, checked.Variable)
            and first.target.discrete
        )
        if first.type.base not in ("real", "integer") and not set_by_when:
            scope.log.report(
                "E0301",
                f"an initial equation is between numbers, not {describe(first.type)}",
                left.span,
                help="the first value of a condition is written where it is declared: "
                "'Boolean b(start = true);'",
            )
            return
        if constant(first) is None and constant(second) is None:
            scope.log.report(
                "E0508",
                "this statement holds only parameters: it determines nothing",
                span,
                help="name a variable of a body, a frame or a liaison on one side",
            )
            return
        made = checked.InitialEquation(first, second, span, guess, _place(scope))
        scope.build.initial.append(made)


def _place(scope: Scope) -> str:
    """The round of the loop that a statement stands in, and its component, in words."""
    rounds = [
        f"{name} = {x.value:g}"
        for name, x in scope.local.items()
        if isinstance(x, checked.Literal) and isinstance(x.value, float)
    ]
    words = [f"for {', '.join(rounds)}"] if rounds else []
    return " ".join([*words, f"in {scope.instance.name}"] if scope.instance.name else words)
