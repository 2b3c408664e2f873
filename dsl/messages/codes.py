"""The registry of diagnostics: each code once, with its explanation and a text that triggers it.

E01 syntax, E02 names, E03 units and types, E04 values, E05 structure, E06 equations and initial
values, E07 not supported yet, E08 tools, E09 run time; W warnings.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from frot.dsl.messages.codes_equations import EQUATIONS
from frot.dsl.messages.codes_language import LANGUAGE
from frot.dsl.messages.codes_tools import TOOLS
from frot.dsl.messages.codes_writing import WRITING

__all__ = ["CODES", "Code"]


class Code(NamedTuple):
    """A code's title, what it means, what to do, and a small text that triggers it."""

    title: str
    explanation: str
    remedy: str
    example: str


_TABLES = (WRITING, LANGUAGE, EQUATIONS, TOOLS)
CODES: Mapping[str, Code] = {code: Code(*row) for table in _TABLES for code, row in table.items()}
