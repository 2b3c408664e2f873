"""The words of the messages about units that other notations write."""

from __future__ import annotations

import re

from frot.dsl.messages.diagnostics import Log
from frot.dsl.messages.source import Source, Span
from frot.dsl.quantities.spelling import corrected
from frot.dsl.quantities.units import is_unit
from frot.dsl.text import tree
from frot.dsl.text.foreign import Lexeme

_WITH_UNIT = re.compile(r"[\d.)](?:[eE][+-]?\d+)?[^\S\n]+(\S+)")
_FACTOR = re.compile(r"[\w%°]+(?:\^?-?\d+)?")
_RAISED = re.compile(r"[⁻⁺][⁰¹²³⁴⁵⁶⁷⁸⁹]+")
_BRACKETS = re.compile(r"\[\s*([^\]\s\d][^\]\s]*)\s*\]")
_POWER = re.compile(r"\^(?:\([ \t]*[+-]?\d+[ \t]*\)|[ \t]*[+-]?\d+)")


def broken_unit(log: Log, source: Source, previous: Lexeme | None, token: Lexeme) -> bool:
    """Whether a token that does not fit is part of a unit; then it is reported."""
    if previous is None:
        return False
    text, start = source.text, token.start
    if text.startswith("[", start) and previous.type == "NUMBER":
        found = _BRACKETS.match(text, start)
        meant = "" if found is None else corrected(found[1]) or found[1]
        return found is not None and _tell(log, source, start, found.end(), "brackets", meant)
    before = _WITH_UNIT.search(text, previous.start, previous.end)
    if before is None or before.end() != previous.end:
        return False
    if token.type == "IDENT" and text[previous.end : start].strip(" \t\u00a0") == "":
        found = _FACTOR.match(text, start)
        joined = "" if found is None else f"{before[1]}.{found[0]}"
        meant = corrected(joined) or joined
        return found is not None and _tell(log, source, start, found.end(), "blanks", meant)
    found = _RAISED.match(text, start)
    if found is None or previous.end != start:
        return False
    return _tell(log, source, start, found.end(), "raised signs", corrected(before[1] + found[0]))


def _tell(log: Log, source: Source, start: int, end: int, what: str, meant: str) -> bool:
    if not is_unit(meant):
        return False
    log.report("E0101", f"a unit has no {what}", Span(source, start, end), help=f"write '{meant}'")
    return True


def refuse_power(log: Log, base: tree.Expression, operator: Span) -> bool:
    """Whether a power is refused: right after a unit, `3 m^(2)`, it may be the unit's or not."""
    if not isinstance(base, tree.Number | tree.Tuple) or not base.unit or base.unit_span is None:
        return False
    text, end = operator.source.text, base.unit_span.end
    if operator.start != end:
        return False
    found = _POWER.match(text, end)
    meant = corrected(base.unit + re.sub(r"\s", "", found[0])) if found is not None else ""
    value = text[base.span.start : base.unit_span.start]
    power = "^..." if found is None else re.sub(r"[\s()+]", "", found[0])
    help_text = f"write '({value}{base.unit}){power}' for the power of the value"
    if meant:
        help_text = f"write '{value}{meant}' for the unit, or {help_text.removeprefix('write ')}"
    place = Span(operator.source, base.unit_span.start, operator.end)
    message = "in a unit a power is a whole number without '+' or parentheses"
    log.report("E0101", message, place, help=help_text)
    return True
