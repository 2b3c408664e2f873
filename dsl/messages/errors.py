"""The exception for requests that cannot be carried out."""

from __future__ import annotations

from frot.dsl.messages.diagnostics import Log


class FrotError(Exception):
    """A request that cannot be carried out; its text is the rendered errors.

    `diagnostics` holds them as data. Warnings wait until the errors are mended.
    """

    def __init__(self, log: Log) -> None:
        from frot.dsl.messages.rendering import render_log

        errors = Log([d for d in log if d.is_error] or list(log))
        super().__init__(render_log(errors))
        self.diagnostics = tuple(errors)


def fail(code: str, message: str, *, help: str = "", notes: tuple[str, ...] = ()) -> FrotError:
    """A FrotError of one diagnostic without a place in a text."""
    log = Log()
    log.report(code, message, None, help=help, notes=notes)
    return FrotError(log)
