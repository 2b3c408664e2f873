"""Text to tokens, as the parser needs them: a word is a keyword only where one can stand.

The terminals are those of the grammar; this lexer differs from lark's contextual one in cost (one
regular expression instead of one for each state) and in never failing: what is no token is JUNK.
"""

from __future__ import annotations

import re
from collections.abc import Container
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lark import Lark

JUNK = "JUNK"
END = "$END"
# Words that may be names too: as words of the language they are followed by another word.
_NOUNS = frozenset(
    """body corps curve surface frame repère repere repe\u0300re force effort liaison joint law loi
    shape input output flow parameter constant model connector record function package type planar
    partial kinematic geometric""".split()  # noqa: SIM905
)
_RELATIONS = ("kinematic", "geometric")
_BLANK = re.compile(r"(?:\s++|//[^\n]*|/\*.*?\*/)*+", re.DOTALL)
_SPACES = frozenset(" \t\f\ufeff\u00a0\u2007\u2009\u202f")
_REGEXPS = ("WS", "COMMENT", "QUANTITY", "NUMBER", "STRING", "IDENT")


def begins_line(text: str, start: int) -> bool:
    """Whether nothing but blanks stands before a place on its line."""
    while start > 0 and text[start - 1] in _SPACES:
        start -= 1
    return start == 0 or text[start - 1] in "\r\n"


class Lexer:
    """The terminals of a grammar, ready to be matched at any offset of a text."""

    def __init__(self, grammar: Lark) -> None:
        patterns = {t.name: t.pattern for t in grammar.terminals}
        literal = {p.value: n for n, p in patterns.items() if p.type == "str"}
        self.keywords: dict[str, str] = {w: n for w, n in literal.items() if w[0].isalpha()}
        self.symbols = {w: n for w, n in literal.items() if not w[0].isalpha()}
        symbols = "|".join(re.escape(s) for s in sorted(self.symbols, key=len, reverse=True))
        groups = {name: f"(?P<{name}>{patterns[name].to_regexp()})" for name in _REGEXPS}
        groups["SYMBOL"] = f"(?P<SYMBOL>{symbols})"
        self._master = re.compile("|".join(groups.values()))
        groups["COMMENT"] = r"(?P<COMMENT>//[^\n]*)"
        self._behind = re.compile("|".join(groups.values()))
        self._unclosed: tuple[str, int] = "", 0
        self._close_unit = re.compile(patterns["CLOSE_UNIT"].to_regexp())

    def next(self, text: str, offset: int, accepted: Container[str]) -> tuple[str, int, int]:
        """Type, start and end of the token at or after `offset`; `$END` at the end.

        `accepted` are the types the parser can take: they decide between keyword and identifier,
        and whether a unit belongs to a closing parenthesis.
        """
        while True:
            # Behind a comment that does not end none does: its end is not looked for again.
            behind = self._unclosed[0] is text and offset >= self._unclosed[1]
            found = (self._behind if behind else self._master).match(text, offset)
            if found is None:
                if offset >= len(text):
                    self._unclosed = "", 0
                    return END, offset, offset
                return JUNK, offset, offset + 1
            kind = found.lastgroup
            if kind == "WS" or kind == "COMMENT":
                offset = found.end()
                continue
            start, end = found.span()
            if kind == "IDENT":
                return self._word(found[0], accepted, text, end), start, end
            if kind == "SYMBOL":
                name = self.symbols[found[0]]
                if text.startswith("/*", start):
                    # A comment that ends is matched before: this one does not.
                    if not behind:
                        self._unclosed = text, start
                    return JUNK, start, start + 2
                if name == "RPAR" and "CLOSE_UNIT" in accepted:
                    unit = self._close_unit.match(text, offset)
                    if unit is not None:
                        return "CLOSE_UNIT", start, unit.end()
                if name == "DOT" and "DOT_STAR" in accepted and text.startswith(".*", start):
                    return "DOT_STAR", start, start + 2
                return name, start, end
            assert kind is not None
            return kind, start, end

    def _word(self, word: str, accepted: Container[str], text: str, end: int) -> str:
        keyword = self.keywords.get(word)
        if keyword is None:
            return "IDENT"
        if keyword not in accepted and "IDENT" in accepted:
            # What stands at the beginning of a line ends or opens a block: a ';' is missing.
            ends = word == "end" and begins_line(text, end - len(word))
            return keyword if ends else "IDENT"
        if word in _NOUNS and "IDENT" in accepted:
            # `force = 2*k;` names a variable: a declaration continues with a word, a relation also
            # with a parenthesis or a number.
            after = _BLANK.match(text, end)
            following = text[after.end() : after.end() + 1] if after is not None else ""
            goes_on = following.isalpha() or following == "_"
            if word in _RELATIONS:
                goes_on = goes_on or following == "(" or following.isdigit()
            if following and not goes_on:
                return "IDENT"
        return keyword
