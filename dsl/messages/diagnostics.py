"""Diagnostics: messages to the author of a text, and the log that collects it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from frot.dsl.messages.source import Span

LIMIT = 20


@dataclass(frozen=True, slots=True)
class Label:
    """A second place a diagnostic points to, with its own few words."""

    span: Span
    text: str


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One message: a registered code, its place, its cause and its remedy."""

    code: str
    message: str
    span: Span | None
    caret: str = ""
    labels: tuple[Label, ...] = ()
    notes: tuple[str, ...] = ()
    help: str = ""

    @property
    def is_error(self) -> bool:
        """Errors have codes that begin with E; warnings with W."""
        return self.code.startswith("E")


@dataclass(slots=True)
class Log:
    """Collects diagnostics; a pass reports to it and continues."""

    diagnostics: list[Diagnostic] = field(default_factory=list)
    repeated: int = 0
    told: set[tuple[str, Span | None]] = field(default_factory=set, repr=False)

    def report(
        self,
        code: str,
        message: str,
        span: Span | None,
        *,
        caret: str = "",
        labels: tuple[Label, ...] = (),
        notes: tuple[str, ...] = (),
        help: str = "",
    ) -> None:
        """Record one diagnostic; the same code at the same place is recorded once."""
        from frot.dsl.messages.codes import CODES

        if code not in CODES:
            raise KeyError(f"the diagnostic code {code} is not registered in messages/codes.py")
        if (code, span) not in self.told:
            self.told.add((code, span))
            self.diagnostics.append(Diagnostic(code, message, span, caret, labels, notes, help))
        else:
            self.repeated += 1

    @property
    def failed(self) -> bool:
        """Whether an error was reported."""
        return any(d.is_error for d in self.diagnostics)

    def __iter__(self) -> Iterator[Diagnostic]:
        return iter(self.diagnostics)
