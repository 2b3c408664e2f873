"""Where unknowns and equations come from, for messages."""

from __future__ import annotations

from dataclasses import dataclass

from frot.dsl.messages.source import Span


@dataclass(frozen=True, slots=True)
class Origin:
    """A scalar equation: its place, its text, the component it is in, whether it is a drive.

    `discrete`: both its sides are conditions, whole numbers or items of an enumeration.
    """

    span: Span
    text: str
    owner: str
    drives: bool = False
    discrete: bool = False


@dataclass(frozen=True, slots=True)
class Unknown:
    """A scalar unknown; `span` is None for a coordinate of the mechanism."""

    name: str
    span: Span | None
