"""The words of the messages about syntax."""

from __future__ import annotations

import difflib
import re
import unicodedata
from collections.abc import Sequence

from frot.dsl.messages.diagnostics import Label, Log
from frot.dsl.messages.source import Source, Span
from frot.dsl.text.foreign import (
    FOREIGN,
    IN_UNIT,
    MEANT,
    MODELICA,
    RAISED,
    Lexeme,
    as_text,
    declared_by_equals,
    in_parentheses,
    of_modelica,
)
from frot.dsl.text.lex import JUNK

_OPENING = (
    "initial",
    "equation",
    "parameter",
    "constant",
    "liaison",
    "body",
    "frame",
    "curve",
    "surface",
    "force",
    "output",
    "input",
    "planar",
    "partial",
    "model",
    "connector",
)
_SAY = {
    "SEMICOLON": "';'",
    "RPAR": "')'",
    "LPAR": "'('",
    "COLON": "':'",
    "EQUAL": "'='",
    "COMMA": "','",
    "IDENT": "a name",
    "END": "'end'",
    "ON": "'on'",
    "THEN": "'then'",
    "ELSE": "'else'",
    "LOOP": "'loop'",
    "IN": "'in'",
    "RSQB": "']'",
}
_COMMA = re.compile(r"(\d+),(\d+)")
_LIAISON = ("LIAISON", "JOINT")
_SINGLE = ("FRAME", "CURVE", "SURFACE")
_ROLES = ("PARAMETER", "CONSTANT", "INPUT", "OUTPUT")


def _shown(text: str) -> str:
    return "".join(c if c.isprintable() else f"U+{ord(c):04X}" for c in text)


def _span(source: Source, token: Lexeme) -> Span:
    return Span(source, token.start, token.end)


def missing_semicolon(log: Log, source: Source, previous: Lexeme) -> None:
    """`;` is missing after `previous`."""
    span = Span(source, previous.end - 1, previous.end)
    log.report("E0102", "missing ';' at the end of the statement", span, caret="';' after this")


def missing_word(log: Log, source: Source, previous: Lexeme, word: str) -> None:
    """The word of a block is missing after `previous`."""
    span = Span(source, previous.end - 1, previous.end)
    log.report("E0101", f"missing '{word}'", span, caret=f"'{word}' after this")


def unclosed(log: Log, source: Source, opened: Sequence[Lexeme], token: Lexeme) -> None:
    """The parentheses `opened` are not closed before `token`."""
    word = _shown(source.text[token.start : token.end])
    found = f"')' was expected before {word!r}" if word else "')' was expected here"
    log.report(
        "E0103",
        "unclosed parenthesis",
        _span(source, opened[0]),
        caret="opened here",
        labels=(Label(Span(source, token.start, max(token.end, token.start)), found),),
    )


def semicolon_between(log: Log, source: Source, token: Lexeme) -> None:
    """`;` stands between the items of a parenthesis."""
    help_text = "write ','; ';' ends a statement"
    log.report("E0101", "';' inside of parentheses", _span(source, token), help=help_text)


def too_deep(log: Log, span: Span, limit: int) -> None:
    """An expression is nested too deeply."""
    log.report(
        "E0108",
        f"the expression is nested more than {limit} levels deep",
        span,
        help="name parts of it as outputs or parameters",
    )


def blocks_too_deep(log: Log, span: Span, limit: int) -> None:
    """Definitions, loops and branches are nested too deeply."""
    log.report(
        "E0108",
        f"blocks are nested more than {limit} levels deep",
        span,
        help="put inner ones into models or functions beside this one",
    )


def missing_end(log: Log, source: Source, name: str, token: Lexeme) -> None:
    """The text ends inside a block."""
    end = len(source.text.rstrip())
    closing = f"end {name};" if name else "end;"
    log.report(
        "E0104",
        f"missing '{closing}' at the end of the text",
        Span(source, max(end - 1, 0), end),
        help=f"write '{closing}' after the last statement",
    )


def missing_block_end(log: Log, source: Source, previous: Lexeme, word: str) -> None:
    """`end` closes a block of statements without its word."""
    remedy = f"write 'end {word};' where the {word!r} ends"
    log.report("E0101", f"'end' of {word!r} without its word", _span(source, previous), help=remedy)


def closes_nothing(log: Log, source: Source, token: Lexeme) -> None:
    """`end when` without a `when`."""
    word = source.text[token.start : token.end]
    remedy = "take it away"
    log.report(
        "E0105", f"'end {word}' where no {word!r} is open", _span(source, token), help=remedy
    )


def unexpected(
    log: Log,
    source: Source,
    previous: Lexeme | None,
    token: Lexeme,
    expected: set[str],
    statement: Sequence[Lexeme],
    in_block: bool,
) -> None:
    """`token` does not fit; the likely cause is looked for, else what was expected is named."""
    text = source.text
    word = text[token.start : token.end]
    span = _span(source, token)
    foreign = of_modelica(text, previous, token, statement)
    declared = declared_by_equals(text, statement) if token.type == "EQUAL" else None
    if declared is not None:
        log.report("E0101", f"'=' in the declaration of a {declared[0]}", span, help=declared[1])
    elif foreign is not None:
        found = text[foreign.start : foreign.end].rpartition(" ")[2]
        place = Span(source, foreign.end - len(found), foreign.end)
        log.report("E0101", f"{found!r} is no word of this language", place, help=MODELICA[found])
    elif token.type == JUNK:
        _junk(log, source, token)
    elif (
        previous is not None
        and previous.type == "NUMBER"
        and token.type == "IDENT"
        and previous.end == token.start
    ):
        number = text[previous.start : previous.end]
        remedy = f"for a unit leave a space: '{number} {word}'; for a product: '{number}*{word}'"
        if (power := word.translate(RAISED)).isdigit():
            remedy = f"a power is written '{number}^{power}'"
        log.report(
            "E0106",
            f"a number and the word {word!r} are glued together",
            Span(source, previous.start, token.end),
            help=remedy,
        )
    elif token.type == "COLON" and text.startswith(":=", token.start):
        log.report(
            "E0101",
            "':=' is no sign of this language",
            Span(source, token.start, token.start + 2),
            help="values and equations are written with '='",
        )
    elif (comma := _decimal_comma(text, previous, token)) is not None:
        log.report(
            "E0101",
            "a comma in a number",
            Span(source, comma.start(), comma.end()),
            help=f"the decimal sign is a point: '{comma[1]}.{comma[2]}'",
        )
    elif word == "*" and previous is not None and text[previous.start : token.end] == "**":
        both = Span(source, previous.start, token.end)
        log.report("E0101", "'**' is no sign of this language", both, help="a power is 'x^2'")
    elif token.type == "EQUAL" and previous is not None and _is_update(text, previous, token):
        both = Span(source, previous.start, token.end)
        sign = text[previous.start]
        remedy = f"write 'x = pre(x) {sign} ...' in a 'when', else an equation"
        log.report("E0101", f"'{sign}=' is no sign of this language", both, help=remedy)
    elif previous is not None and text[previous.start : previous.end].endswith(" %"):
        remedy = "the remainder of a division is 'mod(a, b)'; after a number '%' is a hundredth"
        log.report("E0101", f"unexpected {_shown(word)!r} after '%'", span, help=remedy)
    elif word == "*" and text.startswith("*/", token.start):
        both = Span(source, token.start, token.start + 2)
        log.report("E0101", "'*/' without a comment to end", both, help="'/*' opens a comment")
    elif word == ")" and _none_open(statement):
        remedy = "take it away, or put '(' where it begins"
        log.report("E0101", "this ')' closes nothing", span, help=remedy)
    elif word == ":" and previous is not None and text[previous.start] in "[,":
        remedy = "write the range in full: 'A[2, 1:3]'"
        log.report("E0101", "a range without its ends", span, help=remedy)
    elif word == "[" and statement and statement[0].type in _SINGLE:
        what = text[statement[0].start : statement[0].end]
        remedy = f"put the {what} into a model beside its body, and declare an array of that model"
        log.report("E0101", f"a {what} cannot be declared as an array", span, help=remedy)
    elif word == "[" and "LPAR" in expected:
        log.report("E0101", "unexpected '['", span, help=in_parentheses(text, token.start))
    elif token.type == "STRING" and (help_text := as_text(text, token, statement)):
        log.report("E0101", f"unexpected {_shown(word)!r}", span, help=help_text)
    elif token.type == "COMMA" and statement and statement[0].type in _LIAISON:
        help_text = "the laws of a liaison follow the word 'with': '... with coulomb(0.3);'"
        log.report("E0101", "unexpected ','", span, help=help_text)
    elif token.type == "EQUAL" and len(statement) == 2 and statement[0].type in _ROLES:
        name = text[statement[1].start : statement[1].end]
        log.report(
            "E0101",
            f"{name!r} is declared without a type",
            _span(source, statement[1]),
            help=f"write the type before the name: 'Real {name} = ...'",
        )
    elif "IDENT" in expected and word.isidentifier() and token.type not in ("IDENT", JUNK):
        log.report(
            "E0101",
            f"{word!r} is a word of the language: it cannot be a name",
            span,
            help=f"choose another name, as '{word}_' or '{word}1'",
        )
    elif token.type == "END" and not in_block and not statement:
        log.report("E0105", "'end' without a model to end", span)
    else:
        _misplaced(log, source, previous, token, expected, statement)


def _none_open(statement: Sequence[Lexeme]) -> bool:
    closing = sum(t.type in ("RPAR", "CLOSE_UNIT") for t in statement)
    return sum(t.type == "LPAR" for t in statement) <= closing


def _is_update(text: str, previous: Lexeme, token: Lexeme) -> bool:
    return previous.end == token.start and text[previous.start : previous.end] in "+-*/"


def _decimal_comma(text: str, previous: Lexeme | None, token: Lexeme) -> re.Match[str] | None:
    """The number `0,3` whose comma, or what follows it, is the token."""
    for comma in (token, previous):
        if comma is None or comma.type != "COMMA":
            continue
        first = comma.start
        while first > 0 and text[first - 1].isdigit():
            first -= 1
        found = _COMMA.match(text, first)
        if found is not None and found.end(1) == comma.start:
            return found
    return None


def _junk(log: Log, source: Source, token: Lexeme) -> None:
    character = source.text[token.start]
    span = _span(source, token)
    if character == '"':
        log.report(
            "E0107", "this string is not closed", span, help="close it with '\"' on the same line"
        )
    elif source.text.startswith("/*", token.start):
        log.report("E0107", "this comment is not closed", span, help="close it with '*/'")
    elif character == "'":
        help_text = "the derivative of x is written 'der(x)', a text in double quotes"
        log.report("E0101", 'unexpected "\'"', span, help=help_text)
    elif character in MEANT:
        log.report(
            "E0101",
            f"the character {character!r} ({unicodedata.name(character).lower()}) is not "
            f"{MEANT[character]!r}, though it looks so",
            span,
            help=f"write {MEANT[character]!r}" + IN_UNIT.get(character, ""),
        )
    elif character in "{}":
        log.report(
            "E0101",
            f"unexpected {character!r}",
            span,
            help="vectors are written '(x, y, z)', matrices '((a, b), (c, d))'",
        )
    else:
        help_text = FOREIGN.get(character, "")
        log.report("E0101", f"unexpected character {_shown(character)!r}", span, help=help_text)


def _misplaced(
    log: Log,
    source: Source,
    previous: Lexeme | None,
    token: Lexeme,
    expected: set[str],
    statement: Sequence[Lexeme],
) -> None:
    text = source.text
    word = text[token.start : token.end]
    span = _span(source, token)
    hint = ""
    if statement and statement[0].type == "IDENT":
        first = text[statement[0].start : statement[0].end]
        near = difflib.get_close_matches(first.lower(), _OPENING, n=1, cutoff=0.75)
        if near and len(statement) <= 2:
            word, span = first, _span(source, statement[0])
            hint = f"did you mean {near[0]!r}?"
    elif token.type == "IDENT" and statement and statement[0].type in ("PLANAR", "PARTIAL"):
        near = difflib.get_close_matches(word.lower(), _OPENING, n=1, cutoff=0.75)
        hint = f"did you mean {near[0]!r}?" if near else ""
    said = [_SAY[k] for k in _SAY if k in expected]
    if "IDENT" in expected and ("NUMBER" in expected or "LPAR" in expected):
        said = ["an expression", *(s for s in said if s not in ("a name", "'('"))]
    what = f"unexpected {_shown(word)!r}" if word else "unexpected end of the text"
    if not word:
        end = len(text.rstrip())
        span = Span(source, max(end - 1, 0), end)
    caret = ""
    if said and not hint and len(said) <= 4:
        caret = "expected " + " or ".join(said)
    log.report("E0101", what, span, caret=caret, help=hint)
