"""Strings of a text as they are shown: a terminal acts on none of their characters."""

from __future__ import annotations


def escaped(text: str) -> str:
    r"""The text on one line; what cannot be printed is written as `\n`, `\x1b` or `\u202e`."""
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() else _escape(c) for c in text)


def _escape(character: str) -> str:
    return character.encode("unicode_escape").decode("ascii")
