"""The `when`s of a text: what fires them, and what they change."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from graphlib import CycleError, TopologicalSorter

import casadi as ca
from frot.compiler.symbolic.columns import column
from frot.compiler.translate.conditions import NEVER, RISING, ConditionTable
from frot.compiler.translate.expressions import Lowering
from frot.compiler.translate.previous_values import Before
from frot.compiler.translate.symbols import shaped
from frot.compiler.translate.text_symbols import TextTable, scalars
from frot.dsl import Log
from frot.dsl.checked import (
    Assertion,
    Assign,
    Call,
    Expression,
    Force,
    Model,
    Reinit,
    Terminate,
    Variable,
    When,
)
from frot.dsl.checked.arrays import component_names
from frot.dsl.checked.walk import conjuncts, is_instant
from frot.dsl.checked.wording import words
from frot.dsl.messages.source import Span

TERMINATE, FAIL, WARN, FAULT, STRIKE, MEET = range(6)


@dataclass(frozen=True, slots=True)
class Outcome:
    """What a `when` may ask of the run: to end, to fail or to warn, with a text.

    A percussion, STRIKE, is an event when it acts. MEET: figures meet without a common normal.
    """

    kind: int
    text: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Jump:
    """`reinit(target, value)`: the scalar `target` has this value after the event."""

    target: ca.SX
    value: ca.SX
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Broken:
    """A fault of this kind, FAIL or MEET, once `value` is positive.

    Where one of the `signs` changes, a step ends. `only`: a value that comes to be positive in the
    run is a fault where this is positive too, one at the start is none.
    """

    kind: int
    value: ca.SX
    text: str
    span: Span
    signs: tuple[ca.SX, ...] = ()
    only: ca.SX | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Percussion:
    """A percussion: `due` is 1 once its time has come, `strike` while the kernel asks of it.

    `outcome`: its number among those of the events.
    """

    force: Force
    due: ca.SX
    strike: ca.SX
    outcome: int


@dataclass(frozen=True, slots=True, eq=False)
class Events:
    """Conditions that fire (indices into the located conditions), and what follows.

    `fired` are symbols, one for each entry of `conditions`, `before` those of the discrete values
    before the event; `values` are the ones after it, in the order of the text's memory;
    `required[k]` is 1 where outcome k is.
    """

    fired: tuple[ca.SX, ...]
    before: tuple[ca.SX, ...]
    conditions: tuple[int, ...]
    at_start: tuple[bool, ...]
    values: tuple[ca.SX, ...]
    jumps: tuple[tuple[ca.SX, Jump], ...]
    outcomes: tuple[Outcome, ...]
    required: tuple[ca.SX, ...]
    percussions: tuple[Percussion, ...]


class _Gatherer:
    """Lowers the `when`s: `motion` locates the conditions, `display` reads values at an event."""

    def __init__(
        self, text: TextTable, conditions: ConditionTable, motion: Lowering, display: Lowering
    ) -> None:
        self.text, self.conditions = text, conditions
        self.motion, self.display = motion, display
        self.fired: list[ca.SX] = []
        self.firing: list[int] = []  # the condition of each
        self.at_start: list[bool] = []
        self.jumps: list[tuple[ca.SX, Jump]] = []
        self.outcomes: list[Outcome] = []
        self.required: list[ca.SX] = []
        self.percussions: list[Percussion] = []
        self.before: dict[int, ca.SX] = {}  # discrete symbol -> symbol of its value before
        self.after: dict[int, ca.SX] = {}  # discrete symbol -> symbol of its value after
        self.new: dict[int, ca.SX] = {}  # discrete symbol -> its value after, in those symbols

    def fire(self, condition: ca.SX, at_start: bool, text: str, span: Span) -> ca.SX:
        """A symbol that is 1 at the event at which `condition`, 0 or 1, comes to hold."""
        symbol = ca.SX.sym(f"fired_{len(self.fired)}")
        index = next(
            (i for i, f in enumerate(self.conditions.flags) if ca.is_equal(f, condition)), -1
        )
        if index < 0:
            flag = self.conditions.add(condition - 0.5, True, self._told(text), span, NEVER)
            index = next(i for i, f in enumerate(self.conditions.flags) if ca.is_equal(f, flag))
        self.fired.append(symbol)
        self.firing.append(index)
        self.at_start.append(at_start)
        return symbol

    def _told(self, text: str) -> str:
        return f"{self.motion.owner}: {text}" if self.motion.owner else text

    def condition(self, expression: Expression) -> ca.SX:
        """What fires for one condition of a `when`."""
        joined = conjuncts(expression)
        if len(joined) > 1 and any(is_instant(c) for c in joined):
            # the others need only hold at that instant
            return _product(
                [self.condition(c) if is_instant(c) else self.display.lower(c) for c in joined]
            )
        if isinstance(expression, Call) and expression.function == "edge":
            expression = expression.arguments[0]
        if isinstance(expression, Call) and expression.function == "sample":
            return self._sample(expression)
        if isinstance(expression, Call) and expression.function == "initial":
            return self._once(expression)
        return self.fire(self.motion.lower(expression), False, words(expression), expression.span)

    def _sample(self, call: Call) -> ca.SX:
        first, interval = (self.motion.lower(a) for a in call.arguments)
        time = self.motion.symbols.t
        count = ca.SX.sym(f"samples_{len(self.text.discrete)}")
        # the first sample at or after the start of the run
        start = ca.fmax(ca.ceil((time - first) / interval - 1e-9), 0)
        was = self._counted(count, start)
        text = self._told(words(call))
        due = self.conditions.add(time - (first + count * interval), False, text, call.span, RISING)
        fired = self.fire(due, True, text, call.span)
        self.set(count, fired, was + 1)
        lost = first + (was + 1) * interval <= first + was * interval
        told = f"the ticks of `{words(call)}` lie closer than time can tell apart"
        self._ask(Outcome(FAULT, told, call.span), fired * lost)
        return fired

    def _once(self, call: Call) -> ca.SX:
        begun = ca.SX.sym(f"begun_{len(self.text.discrete)}")
        self._counted(begun, ca.SX(0))
        fired = self.fire(1 - begun, True, words(call), call.span)
        self.set(begun, fired, ca.SX(1))
        return fired

    def _counted(self, symbol: ca.SX, start: ca.SX) -> ca.SX:
        """Add a discrete value; its value before the event."""
        self.text.add_discrete(symbol.name(), symbol, start)
        was = ca.SX.sym(f"{symbol.name()} before")
        self.before[symbol.element_hash()] = was
        return was

    def set(self, symbol: ca.SX, active: ca.SX, value: ca.SX) -> None:
        """Where `active`, the discrete value is `value` after the event."""
        key = symbol.element_hash()
        self.new[key] = ca.if_else(active, value, self.new.get(key, self.before[key]))

    def when(self, when: When) -> None:
        """One `when` with its branches; the first that fires excludes the others."""
        free = ca.SX(1)
        for conditions, actions in when.branches:
            self.motion.owner = when.owner
            fired = [self.condition(c) for c in conditions]
            some = 1 - _product([1 - f for f in fired])
            active = some * free
            free = free * (1 - some)
            for action in actions:
                self._act(action, active)

    def _act(self, action: Assign | Reinit | Terminate | Assertion, active: ca.SX) -> None:
        match action:
            case Assign():
                value = self.display.lower(action.value)
                whole = self.text.values[action.variable]
                rows = whole[action.item[0], :].T if action.item else whole
                targets = scalars(rows[action.item[1]] if len(action.item) > 1 else rows)
                values = scalars(value)
                if len(values) == 1:
                    values = values * len(targets)
                for symbol, item in zip(targets, values, strict=True):
                    self.set(symbol, active, item)
            case Reinit():
                targets = scalars(self.display.lower(action.target))
                for target, value in zip(
                    targets, scalars(self.display.lower(action.value)), strict=True
                ):
                    self.jumps.append((active, Jump(target, value, action.span)))
            case Terminate():
                self._ask(Outcome(TERMINATE, action.message, action.span), active)
            case Assertion():
                holds = self.display.lower(action.condition)
                kind = WARN if action.level == "warning" else FAIL
                self._ask(Outcome(kind, action.message, action.span), active * (1 - holds))

    def _ask(self, outcome: Outcome, active: ca.SX) -> None:
        self.outcomes.append(outcome)
        self.required.append(active)

    def assertion(self, assertion: Assertion) -> None:
        """A condition that must always hold: it is watched."""
        self.motion.owner = assertion.owner
        broken = 1 - self.motion.lower(assertion.condition)
        kind = WARN if assertion.level == "warning" else FAIL
        fired = self.fire(broken, True, words(assertion.condition), assertion.span)
        self._ask(Outcome(kind, assertion.message, assertion.span), fired)

    def percussion(self, force: Force, strike: ca.SX) -> None:
        """Strike once its time comes; one before the start of the run is past."""
        expression = force.arguments["at"]
        assert isinstance(expression, Expression)
        at, time = self.motion.lower(expression), self.motion.symbols.t
        self._counted(strike, ca.SX(0))
        due, past = (ca.SX.sym(f"{force.name}.{name}") for name in ("due", "past"))
        was_past = self._counted(past, time > at)
        self._counted(due, ca.SX(0))
        text = f"percussion '{force.name}'"
        now = self.conditions.add(time - at, False, text, force.span, NEVER)
        fired = self.fire(now, True, text, force.span)
        self.set(due, fired * (1 - was_past), ca.SX(1))
        self.percussions.append(Percussion(force, due, strike, len(self.outcomes)))
        self._ask(Outcome(STRIKE, text, force.span), ca.SX(0))

    def fault(self, fault: Broken) -> None:
        """A value that must not become positive."""
        text, span = fault.text, fault.span
        for value in (*fault.signs, fault.value):
            broken = self.conditions.add(value, True, text, span, NEVER)
        fired = self.fire(broken, fault.only is None, text, span)
        counts = ca.SX(1) if fault.only is None else fault.only > 0
        self._ask(Outcome(fault.kind, text, span), fired * counts)


def gather_events(
    model: Model,
    text: TextTable,
    modes: Iterable[ca.SX],
    conditions: ConditionTable,
    faults: Iterable[Broken],
    strikes: Mapping[Force, ca.SX],
    *,
    motion: Lowering,
    display: Lowering,
    log: Log,
) -> Events | None:
    """Lower every `when` and `assert`. Actions read discrete values after the event.

    `modes` are discrete values that no `when` sets. `strikes` are the factors of percussions.
    """
    after: dict[Variable, ca.SX] = {}
    before: dict[Variable, ca.SX] = {}
    assert motion.before is not None
    at_event = replace(
        display,
        variable=lambda v: after[v] if v.discrete else text.values[v],
        before=Before(text, motion.before.first, before.__getitem__),
        known=conditions,
    )
    gatherer = _Gatherer(text, conditions, motion, at_event)
    for variable in model.variables:
        if not variable.discrete:
            continue
        shape = variable.type.shape
        names = component_names(variable.name, shape)
        news, olds = ([ca.SX.sym(f"{n} {w}") for n in names] for w in ("after", "before"))
        after[variable], before[variable] = shaped(news, shape), shaped(olds, shape)
        for symbol, new, old in zip(scalars(text.values[variable]), news, olds, strict=True):
            gatherer.after[symbol.element_hash()] = new
            gatherer.before[symbol.element_hash()] = old
    for mode in modes:
        gatherer.before[mode.element_hash()] = ca.SX.sym(f"{mode.name()} before")
    for when in model.whens:
        gatherer.when(when)
    for assertion in model.assertions:
        gatherer.assertion(assertion)
    for fault in faults:
        gatherer.fault(fault)
    for force, strike in strikes.items():
        gatherer.percussion(force, strike)
    return _settle(gatherer, log, model)


def _settle(gatherer: _Gatherer, log: Log, model: Model) -> Events | None:
    """Put the new discrete values into each other, in the order in which they need each other."""
    text = gatherer.text
    symbols = [d.symbol for d in text.discrete]
    keys = [s.element_hash() for s in symbols]
    own = {gatherer.after[k].element_hash(): k for k in keys if k in gatherer.after}
    value = {k: gatherer.new.get(k, gatherer.before[k]) for k in keys}
    needs = {
        k: {own[s.element_hash()] for s in ca.symvar(v) if s.element_hash() in own}
        for k, v in value.items()
    }
    try:
        order = list(TopologicalSorter(needs).static_order())
    except CycleError as error:
        names = {k: s.name() for k, s in zip(keys, symbols, strict=True)}
        circle = " -> ".join(names[k] for k in error.args[1])
        log.report(
            "E0609",
            f"the values of a 'when' need each other in a circle: {circle}",
            model.whens[0].span,
            help="use 'pre(...)' for the value before the event",
        )
        return None
    settled: dict[int, ca.SX] = {}
    for k in order:
        settled[k] = _put(value[k], gatherer.after, settled)

    def put(value: ca.SX) -> ca.SX:
        return _put(value, gatherer.after, settled)

    jumps = ((active, replace(jump, value=put(jump.value))) for active, jump in gatherer.jumps)
    held = [ca.SX.sym(f"{h.name} before") for h in text.held]
    return Events(
        fired=tuple(gatherer.fired),
        before=(*(gatherer.before[k] for k in keys), *held),
        conditions=tuple(gatherer.firing),
        at_start=tuple(gatherer.at_start),
        values=(*(settled[k] for k in keys), *(h.value for h in text.held)),
        jumps=tuple(jumps),
        outcomes=tuple(gatherer.outcomes),
        required=tuple(put(a) for a in gatherer.required),
        percussions=tuple(gatherer.percussions),
    )


def _put(value: ca.SX, after: dict[int, ca.SX], settled: dict[int, ca.SX]) -> ca.SX:
    known = [(after[k], v) for k, v in settled.items() if k in after]
    if not known:
        return value
    return ca.substitute(value, column(s for s, _ in known), column(v for _, v in known))


def _product(items: list[ca.SX]) -> ca.SX:
    result = ca.SX(1)
    for item in items:
        result = result * item
    return result
