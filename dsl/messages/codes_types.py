"""What is kept of a diagnostic's code."""

from __future__ import annotations

from typing import NamedTuple


class Code(NamedTuple):
    """A code's title, what it means, what to do, and a small text that triggers it."""

    title: str
    explanation: str
    remedy: str
    example: str


def snippet(declarations: str = "", initial: str = "", tail: str = "") -> str:
    """A planar model around a few statements."""
    body = "".join(f"  {line}\n" for line in declarations.splitlines())
    section = "initial\n" + "".join(f"  {line}\n" for line in initial.splitlines())
    return f"planar model Example\n{body}{section if initial else ''}{tail}end Example;\n"
