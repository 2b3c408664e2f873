"""An indented print of a tree or a checked model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass

from frot.dsl.catalogue import ForceKind, LawKind, LiaisonKind, Shape
from frot.dsl.checked.describe import describe
from frot.dsl.messages.source import Source, Span
from frot.dsl.quantities.dimensions import Type

# Fields that say where, not what.
_HIDDEN = {"span", "unit_span", "op_span", "driven_span", "header", "files", "source"}
_WIDTH = 100


def dump(value: object) -> str:
    """The value and all it holds; a named object met again is shown by its name only."""
    lines: list[str] = []
    _write(value, 0, "", lines, set())
    return "\n".join(lines) + "\n"


def _write(value: object, depth: int, label: str, lines: list[str], seen: set[int]) -> None:
    pad = "  " * depth + label
    short = _short(value)
    if short is not None:
        lines.append(pad + short)
        return
    if isinstance(value, tuple | list | frozenset):
        lines.append(f"{pad}[{len(value)}]")
        for item in value:
            _write(item, depth + 1, "", lines, seen)
    elif isinstance(value, Mapping):
        lines.append(f"{pad}{{{len(value)}}}")
        for key, item in value.items():
            _write(item, depth + 1, f"{key} = ", lines, seen)
    elif is_dataclass(value):
        name = getattr(value, "name", None)
        title = type(value).__name__
        if id(value) in seen and isinstance(name, str):
            lines.append(f"{pad}{title} {name} (above)")
            return
        seen.add(id(value))
        lines.append(pad + title)
        for part in fields(value):
            content = getattr(value, part.name)
            if part.name not in _HIDDEN and content not in ("", (), None):
                _write(content, depth + 1, f"{part.name}: ", lines, seen)
    else:
        lines.append(pad + repr(value))


def _short(value: object) -> str | None:
    """One line for a value that has one."""
    if isinstance(value, Type):
        return describe(value)
    if isinstance(value, Shape | LiaisonKind | LawKind | ForceKind):
        return f"{type(value).__name__} {value.name}"
    if isinstance(value, Span):
        return value.place
    if isinstance(value, Source):
        return value.name
    if value is None or isinstance(value, str | int | float | bool):
        return repr(value)
    if isinstance(value, tuple | list) and not value:
        return "[]"
    return None
