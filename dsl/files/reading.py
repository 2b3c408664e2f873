"""Reading a file of the language."""

from __future__ import annotations

from pathlib import Path

from frot.dsl.messages.diagnostics import Log


def read_text(path: str | Path, log: Log) -> str | None:
    """The text of a UTF-8 file, line ends as they are; None if an error was reported (E0804)."""
    name = str(path)
    try:
        content = Path(path).read_bytes()
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        log.report("E0804", f"cannot read {name!r}: {reason}", None, help="check the path")
        return None
    return decode(content, name, log)


def decode(content: bytes, name: str, log: Log) -> str | None:
    """The text of the bytes of a file; None if an error was reported (E0804)."""
    try:
        # A leading byte order mark is legal in UTF-8.
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = error.object[: error.start].count(b"\n") + 1
        message = f"cannot read {name!r}: it is not UTF-8 (line {line})"
        log.report("E0804", message, None, help="save the file with the encoding UTF-8")
        return None
