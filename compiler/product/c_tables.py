"""Tables and records of C."""

from __future__ import annotations

import casadi as ca
from frot.dsl.messages.source import Span, escaped


def callable_record(function: ca.Function | None) -> str:
    """The initializer of a `frot_callable`."""
    if function is None:
        return record("0", 0, 0, 0, 0)
    sizes = (function.sz_arg(), function.sz_res(), function.sz_iw(), function.sz_w())
    return record(function.name(), *sizes)


def record(*fields: str | int) -> str:
    """The value of a struct."""
    return f"{{{', '.join(str(field) for field in fields)}}}"


def array(kind: str, name: str, items: list[str]) -> str:
    """A table; one item where there is none, for C has no empty arrays."""
    return f"static const {kind} {name}[] = {{{', '.join(items) or '0'}}};"


def number(value: float) -> str:
    """A number as a literal of C."""
    return repr(float(value))


def text(value: str) -> str:
    """A C string literal in UTF-8, with octal escapes for all that is not plain.

    What a terminal would act on is written out: the kernel's sentences are printed.
    """
    out = []
    for byte in escaped(value).encode("utf-8"):
        plain = 32 <= byte < 127 and byte not in b'"\\?'
        out.append(chr(byte) if plain else f"\\{byte:03o}")
    return '"' + "".join(out) + '"'


def place(span: Span | None) -> str:
    """File, line and column, as messages show them."""
    return span.place if span is not None else ""
