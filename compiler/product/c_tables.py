"""Tables and records of C."""

from __future__ import annotations

import casadi as ca


def callable_record(function: ca.Function | None) -> str:
    """A frot_callable."""
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
    """A literal."""
    return repr(float(value))
