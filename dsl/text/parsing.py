"""Text to tree. A mistake gives one message; reading continues at the next statement.

The LALR automaton is driven here, token by token. Before the first token of each statement the
stacks are kept; at an error the missing `;` or `)` is put in if what follows then fits, and else
the stacks are restored and the text is skipped to the next statement.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from frot.dsl.data.collection import without_collection
from frot.dsl.messages.diagnostics import LIMIT, Log
from frot.dsl.messages.source import Source, Span
from frot.dsl.text import syntax_messages as messages
from frot.dsl.text.build_expressions import NESTED
from frot.dsl.text.lex import END, JUNK, begins_line
from frot.dsl.text.tree import Tree
from frot.dsl.text.unit_messages import broken_unit

if TYPE_CHECKING:
    from lark.parsers.lalr_parser_state import ParserState

# Words that begin a statement or end a block: skipping stops before them.
STARTS = frozenset(
    """parameter constant input output flow body corps frame repère repere curve surface liaison
    joint force effort initial equation extends import end when""".split()  # noqa: SIM905
)
# Terminals that open something closed by `end`, and how `end` names it.
_BLOCKS = {"WHEN": "WHEN", "IF": "IF", "FOR": "FOR"}
# Levels of definitions, loops and branches in one another; states of the automaton for each.
BLOCKS, _STATES = 100, 6
_HEADERS = frozenset(["MODEL", "CONNECTOR", "RECORD", "FUNCTION", "PACKAGE", "SHAPE"])


def parse(source: Source, log: Log, tokens: list[Lexeme] | None = None) -> Tree:
    """The tree of a text; every fault of the text is reported to `log`, none is raised.

    `tokens`, if given, is filled with the tokens read: all of them if nothing was reported.
    """
    from frot.dsl.text.build import build

    reader = _Reader(source, log, tokens)
    with without_collection():
        root = reader.read()
        if root is None:
            return Tree(source, (), frozenset(reader.lost))
        return build(root, source, frozenset(reader.lost), log)


@dataclass(slots=True)
class Lexeme:
    """A token: its terminal and its place."""

    type: str
    start: int
    end: int


@dataclass(slots=True)
class _Reader:
    source: Source
    log: Log
    tokens: list[Lexeme] | None = None
    lost: set[str] = field(default_factory=set)
    state: ParserState[int] = field(init=False)
    states: dict[int, dict[str, Any]] = field(init=False)
    previous: Lexeme | None = None
    statement: list[Lexeme] = field(default_factory=list)
    kept: tuple[list[int], list[Any]] | None = None
    reported: int = 0
    depth: int = 0

    def read(self) -> Any:
        """The root of lark's tree, or None where nothing can be made of the text."""
        from frot.dsl.text.grammar import grammar, lexer

        lark = grammar()
        self.state = lark.parse_interactive("").parser_state
        self.states = self.state.parse_conf.states
        next_token = lexer().next
        text = self.source.text
        offset = 0
        while True:
            token = Lexeme(*next_token(text, offset, self.states[self.state.state_stack[-1]]))
            if token.type == END:
                return self._finish(token)
            if self.depth >= NESTED and token.type in ("LPAR", "LSQB"):
                messages.too_deep(log=self.log, span=self._span(token), limit=NESTED)
                self.reported += 1
                offset = self._resume(token)
                continue
            if len(self.state.state_stack) > _STATES * BLOCKS and self._at_start():
                messages.blocks_too_deep(self.log, self._span(token), BLOCKS)
                return None
            if self._ends_nothing(token):
                if not self.reported:  # else its beginning was lost with a fault that was reported
                    messages.closes_nothing(self.log, self.source, token)
                    self.reported += 1
                offset = self._resume(token)
                continue
            if self._shift(token):
                offset = token.end
                continue
            if token.type == "CLOSE_UNIT":
                token = Lexeme("RPAR", token.start, token.start + 1)
                if self._shift(token):
                    offset = token.end
                    continue
            if token.type == "SEMICOLON" and self._separates(token):
                text = self.source.text
                if not any(t.type == "COMMA" and text[t.start] == ";" for t in self.statement):
                    messages.semicolon_between(self.log, self.source, token)
                    self.reported += 1
                self._shift(Lexeme("COMMA", token.start, token.end))
                offset = token.end
                continue
            if self._repair(token):
                offset = token.start
                continue
            self._complain(token)
            header = self.kept is None and bool(self.statement) and self._in_header()
            offset = self._resume(token)
            if header or self.reported >= LIMIT or not self._fits("END"):
                # What follows a broken header, or stands outside of models, would all be faults.
                return None

    def _span(self, token: Lexeme) -> Span:
        return Span(self.source, token.start, token.end)

    # -------------------------------------------------------------- the automaton

    def _at_start(self) -> bool:
        """Whether a statement may begin here."""
        return "EQUATION" in self.states[self.state.state_stack[-1]]

    def _shift(self, token: Lexeme) -> bool:
        """Feed a token; False, with the pending reductions made, where it does not fit."""
        from lark import Token
        from lark.exceptions import UnexpectedToken

        state = self.state
        if token.type == JUNK:
            return False
        at_start = self._at_start()
        text = self.source.text[token.start : token.end]
        try:
            state.feed_token(Token(token.type, text, token.start, 0, 0, 0, 0, token.end))
        except UnexpectedToken:
            return False
        if at_start:
            self.kept = (state.state_stack[:-1], state.value_stack[:-1])
            self.statement.clear()
            self.depth = 0
            if token.type in _HEADERS or token.type in ("PLANAR", "PARTIAL"):
                self.kept = None
        self.statement.append(token)
        if self.tokens is not None:
            self.tokens.append(token)
        self.previous = token
        if token.type in ("LPAR", "LSQB"):
            self.depth += 1
        elif token.type in ("RPAR", "CLOSE_UNIT", "RSQB"):
            self.depth -= 1
        return True

    def _fits(self, *types: str) -> bool:
        """Whether these tokens could be read next."""
        stack = list(self.state.state_stack)
        for kind in types:
            while True:
                entry = self.states[stack[-1]].get(kind)
                if entry is None:
                    return False
                action, target = entry
                if action.name == "Shift":
                    stack.append(target)
                    break
                size = len(target.expansion)
                if size:
                    del stack[-size:]
                stack.append(self.states[stack[-1]][target.origin.name][1])
                if kind == END and stack[-1] == self.state.parse_conf.end_state:
                    break
        return True

    def _put(self, kind: str, place: int) -> None:
        self._shift(Lexeme(kind, place, place))

    # -------------------------------------------------------------- repairs

    def _repair(self, token: Lexeme) -> bool:
        """Put in a missing `)` or `;` where `token` then fits; True if it was done and reported."""
        if not self.statement or self.previous is None or not self._in_block():
            return False
        place = self.previous.end
        for word in _BLOCKS:
            # `end;`, or the `end` of what the block stands in.
            if self.previous.type == "END" and self._fits(word):
                messages.missing_block_end(self.log, self.source, self.previous, word.lower())
                self.reported += 1
                self._put(word, place)
                if token.type != "SEMICOLON":
                    self._put("SEMICOLON", place)
                    self._put("END", place)
                return self.reported < LIMIT
        for word in ("THEN", "LOOP"):
            # The word is missing where a line ended, or where what follows is a statement.
            if self._ends_line(token) and self._fits(word, token.type):
                messages.missing_word(self.log, self.source, self.previous, word.lower())
                self.reported += 1
                self._put(word, place)
                return self.reported < LIMIT
        opened = self._open_parentheses()
        for missing in range(min(len(opened), 8) + 1):
            closing = ["RPAR"] * missing
            if missing and self._fits(*closing, token.type):
                messages.unclosed(self.log, self.source, opened[-missing:], token)
            elif self._ends_line(token) and self._fits(*closing, "SEMICOLON", token.type):
                closing.append("SEMICOLON")
                if missing:
                    messages.unclosed(self.log, self.source, opened[-missing:], token)
                else:
                    messages.missing_semicolon(self.log, self.source, self.previous)
            else:
                continue
            self.reported += 1
            for kind in closing:
                self._put(kind, place)
            return self.reported < LIMIT
        return False

    def _ends_nothing(self, token: Lexeme) -> bool:
        """Whether `end when` stands where no `when` is open."""
        if token.type != "IDENT" or self.previous is None or self.previous.type != "END":
            return False
        return self.source.text[token.start : token.end].upper() in _BLOCKS

    def _separates(self, token: Lexeme) -> bool:
        """Whether `;` stands where `,` is meant: the parenthesis is closed on the same line."""
        if not self._open_parentheses() or not self._fits("COMMA"):
            return False
        depth = 0
        for character in self.source.text[token.end :].partition("\n")[0]:
            depth += {"(": 1, ")": -1}.get(character, 0)
            if depth < 0:
                return self.reported < LIMIT - 1
        return False

    def _ends_line(self, token: Lexeme) -> bool:
        """Whether a statement may have been meant to end before this token."""
        assert self.previous is not None
        between = self.source.text[self.previous.end : token.start]
        return "\n" in between or token.type not in ("IDENT", "NUMBER", "QUANTITY", "STRING")

    def _open_parentheses(self) -> list[Lexeme]:
        opened: list[Lexeme] = []
        for token in self.statement:
            if token.type == "LPAR":
                opened.append(token)
            elif token.type in ("RPAR", "CLOSE_UNIT") and opened:
                opened.pop()
        return opened

    # -------------------------------------------------------------- errors

    def _complain(self, token: Lexeme) -> None:
        expected = {
            kind
            for kind in self.states[self.state.state_stack[-1]]
            if kind.isupper() and self._fits(kind)
        }
        log, source, previous = self.log, self.source, self.previous
        if not broken_unit(log, source, previous, token):
            messages.unexpected(
                log, source, previous, token, expected, self.statement, bool(self.kept)
            )
        self.reported += 1

    def _in_header(self) -> bool:
        return self.statement[0].type in (*_HEADERS, "PLANAR", "PARTIAL")

    def _in_block(self) -> bool:
        """Whether the statement stands inside of a definition."""
        if self.kept is None:
            return not self._in_header()
        now = self.state.state_stack
        self.state.state_stack = self.kept[0]
        inside = self._fits("END")
        self.state.state_stack = now
        return inside

    def _resume(self, token: Lexeme) -> int:
        """Forget the statement and give the offset at which reading continues."""
        text = self.source.text
        for lost in self.statement:
            if lost.type == "IDENT":
                self.lost.add(text[lost.start : lost.end])
        first = not self.statement or "EQUATION" in self.states[self.state.state_stack[-1]]
        if self.kept is not None and not first:
            self.state.state_stack[:] = self.kept[0]
            self.state.value_stack[:] = self.kept[1]
        self.statement.clear()
        self.depth = 0
        offset = token.end if first or token.type == JUNK else token.start
        return self._skip(offset, token)

    def _skip(self, offset: int, token: Lexeme) -> int:
        from frot.dsl.text.grammar import lexer

        text = self.source.text
        if token.type == "SEMICOLON":
            return token.end
        # a matrix of another language has its ';' between brackets
        open_at = token.start if text[token.start : token.end] == "[" else -1
        while True:
            kind, start, end = lexer().next(text, offset, ("IDENT",))
            if kind == END:
                return start
            if text[start:end] in ("[", "]"):
                open_at = start if text[start:end] == "[" else -1
            if kind == "SEMICOLON" and (open_at < 0 or "\n" in text[open_at:end]):
                return end
            if kind == "IDENT":
                word = text[start:end]
                if word in STARTS and begins_line(text, start):
                    return start
                self.lost.add(word)
            offset = end

    # -------------------------------------------------------------- the end

    def _finish(self, token: Lexeme) -> Any:
        """Close what is open at the end of the text and give the root."""
        from lark import Token

        if not self._fits(END):
            self._complain_at_end(token)
        for _ in range(NESTED):
            if self._fits(END):
                break
            for word in ("WHEN", "IF", "FOR", None):
                types = ("END", "SEMICOLON") if word is None else ("END", word, "SEMICOLON")
                if self._fits(*types):
                    for kind in types:
                        self._put(kind, len(self.source.text))
                    break
            else:
                return None
        if not self._fits(END):
            return None
        self.state.feed_token(Token(END, ""), is_end=True)
        return self.state.value_stack[-1]

    def _complain_at_end(self, token: Lexeme) -> None:
        if self.statement and self.kept is None and self._in_header() and not self._fits("END"):
            messages.unexpected(self.log, self.source, self.previous, token, set(), [], True)
            return
        if self.statement and "EQUATION" not in self.states[self.state.state_stack[-1]]:
            closing = Lexeme("END", token.start, token.start)
            if not (self._repair(token) or self._repair(closing)):
                self._complain(token)
                self._resume(token)
                if self._in_end(token):
                    return
            if self._fits(END):
                return
        if not (self.reported and self._in_end(token)):
            messages.missing_end(self.log, self.source, self._open_block(), token)

    def _in_end(self, token: Lexeme) -> bool:
        """Whether the last line begins with `end`, so that it is not missing."""
        last = self.source.text[: token.start].rstrip().rpartition("\n")[2]
        return re.match(r"\s*end\b", last) is not None

    def _open_block(self) -> str:
        """The word after the `end` of the innermost open block."""
        from lark import Token

        stack = self.state.value_stack
        for index in range(len(stack) - 1, -1, -1):
            item = stack[index]
            if isinstance(item, Token) and item.type in _BLOCKS:
                return str(item)
            if (
                isinstance(item, Token)
                and item.type == "IDENT"
                and index
                and getattr(stack[index - 1], "data", "") in ("_kind", "liaison_word", "law_word")
            ):
                return str(item)
        return ""
