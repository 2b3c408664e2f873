"""The meaning of a code: its entry of the registry as text."""

from __future__ import annotations

import textwrap

from frot.dsl.messages.codes import CODES
from frot.dsl.messages.errors import fail

_WIDTH = 80


def explain(code: str) -> str:
    """Title, explanation, remedy and example of a code; FrotError (E0806) if there is none."""
    entry = CODES.get(code.upper())
    if entry is None:
        near = _near(code.upper())
        raise fail(
            "E0806",
            f"there is no code '{code}'",
            help=f"did you mean '{near}'?" if near else "'frot explain' lists all codes",
        )
    parts = [f"{code.upper()}: {entry.title}"]
    parts.append(textwrap.fill(entry.explanation, _WIDTH))
    parts.append(textwrap.fill(f"Remedy: {entry.remedy}", _WIDTH))
    if entry.example:
        parts.append(f"Example:\n\n{entry.example.rstrip()}")
    return "\n\n".join(parts)


def _near(code: str) -> str:
    """The first code that begins like this one, zeros apart, or an empty text."""
    padded = code[:1] + code[1:].zfill(4)
    for length in range(5, 2, -1):
        for known in sorted(CODES):
            if known[:length] in (code[:length], padded[:length]):
                return known
    return ""


def list_codes() -> str:
    """All codes with their titles, one on each line."""
    return "\n".join(f"{code}  {entry.title}" for code, entry in sorted(CODES.items()))
