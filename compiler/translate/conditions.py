"""Conditions on time and motion that switch something, each the sign of a value."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import TypeVar

import casadi as ca
from frot.dsl.messages.source import Span

# When a change of a condition is an event of the report (frot_told).
NEVER, RISING, ALWAYS = range(3)

T = TypeVar("T")


@dataclass(frozen=True, slots=True, eq=False)
class Conditions:
    """Conditions by columns: `value` > 0 while one is true, its flag is 0 or 1.

    `strict`: whether the condition is false where its value is zero. `texts` are as the author
    wrote them, at `spans`; `report_rules` say which changes are reported (NEVER, RISING, ALWAYS).
    `contacts`: of one that is no switch of the text, the contact a figure of which ends there.
    `at_rest`: the values with motions of liaisons that friction holds at zero, None where there
    are none. Once they are sorted, the first `located` change by the motion, the last `sensed` of
    these by what it is solved for, the `timed` after them by time alone.
    """

    flags: tuple[ca.SX, ...] = ()
    values: tuple[ca.SX, ...] = ()
    strict: tuple[bool, ...] = ()
    texts: tuple[str, ...] = ()
    spans: tuple[Span | None, ...] = ()
    report_rules: tuple[int, ...] = ()
    contacts: tuple[int, ...] = ()
    at_rest: tuple[ca.SX | None, ...] = ()
    located: int = 0
    sensed: int = 0
    timed: int = 0

    def with_values(self, values: Sequence[ca.SX]) -> Conditions:
        """The same conditions by other values."""
        return replace(self, values=tuple(values))

    def sorted(self, order: Sequence[int], located: int, sensed: int, timed: int) -> Conditions:
        """The conditions in another order, with the numbers of each kind."""

        def put(items: Sequence[T]) -> tuple[T, ...]:
            return tuple(items[k] for k in order)

        return Conditions(
            put(self.flags),
            put(self.values),
            put(self.strict),
            put(self.texts),
            put(self.spans),
            put(self.report_rules),
            put(self.contacts),
            put(self.at_rest),
            located=located,
            sensed=sensed,
            timed=timed,
        )


@dataclass(slots=True)
class ConditionTable:
    """Conditions while they are collected: see `Conditions`."""

    flags: list[ca.SX] = field(default_factory=list)
    values: list[ca.SX] = field(default_factory=list)
    strict: list[bool] = field(default_factory=list)
    texts: list[str] = field(default_factory=list)
    spans: list[Span | None] = field(default_factory=list)
    report_rules: list[int] = field(default_factory=list)
    contacts: list[int] = field(default_factory=list)
    at_rest: list[ca.SX | None] = field(default_factory=list)

    def add(
        self,
        value: ca.SX,
        strict: bool,
        text: str,
        span: Span | None,
        report_rule: int = ALWAYS,
        contact: int = -1,
        at_rest: ca.SX | None = None,
    ) -> ca.SX:
        """A flag, 0 or 1, that follows the sign of `value` by located events."""
        found = self.find(value, strict, contact)
        if found is not None:
            return found  # the same switch, written or read twice
        flag = ca.SX.sym(f"condition_{len(self.flags)}")
        self.flags.append(flag)
        self.values.append(value)
        self.strict.append(strict)
        self.texts.append(text)
        self.spans.append(span)
        self.report_rules.append(report_rule)
        self.contacts.append(contact)
        self.at_rest.append(at_rest)
        return flag

    def find(self, value: ca.SX, strict: bool, contact: int = -1) -> ca.SX | None:
        """The flag of a condition: of two contacts that pass one end each has its own."""
        own = zip(self.flags, self.values, self.strict, self.contacts, strict=True)
        for flag, known, kind, of in own:
            if kind == strict and of == contact and ca.is_equal(known, value, 20):
                return flag
        return None

    def finish(self, values: Sequence[ca.SX]) -> Conditions:
        """The conditions collected, by these values."""
        return Conditions(
            tuple(self.flags),
            tuple(values),
            tuple(self.strict),
            tuple(self.texts),
            tuple(self.spans),
            tuple(self.report_rules),
            tuple(self.contacts),
            tuple(self.at_rest),
        )
