"""Reports of what the mechanics does not support, and of places that no liaison joins."""

from __future__ import annotations

from collections.abc import Iterable

from frot.dsl import Log
from frot.dsl.checked import Liaison
from frot.dsl.messages.source import Span


def refuse_places(liaison: Liaison, log: Log) -> None:
    """Report that a liaison of this kind has no meaning between its two places."""
    kind = liaison.kind
    message = f"liaison '{liaison.name}': {kind.title} does not join these two places"
    help_text = kind.joins or "name a body, a point of one or a frame"
    log.report("E0205", message, liaison.span, help=help_text)


def refuse(log: Log, what: str, span: Span | None, help: str = "") -> None:
    """Report what is not supported yet, with a remedy."""
    log.report("E0701", f"{what} is not supported yet", span, help=help)


def one_of(what: str, names: Iterable[str]) -> str:
    """The names that are supported, as a remedy."""
    return f"supported {what}: {', '.join(names)}"
