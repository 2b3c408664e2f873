"""Names of variables and identifiers as FMI writes them."""

from __future__ import annotations

import re
from collections.abc import Iterable

_PLAIN = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_PART = re.compile(r"(?P<identifier>[^\[\]]+)(?P<indices>(?:\[[^\[\]]*\])?)")
_INDICES = re.compile(r"\[[0-9]+(,[0-9]+)*\]")
_QUOTABLE = re.compile(r"[ -~]+")


def structured_name(name: str) -> str | None:
    """A dotted name by FMI's structured grammar, odd identifiers quoted; None if it cannot be.

    `der(a.b)` is the derivative of a name, `der(der(a.b))` is written `der(a.b,2)`. The grammar
    (FMI 2.0, 2.2.9) is ASCII throughout, also between quotes: a name with a letter beyond ASCII has
    no structured form.
    """
    order = 0
    while name.startswith("der(") and name.endswith(")"):
        name, order = name[len("der(") : -1], order + 1
    identifier = _identifier(name)
    if identifier is None or order == 0:
        return identifier
    return f"der({identifier})" if order == 1 else f"der({identifier},{order})"


def _identifier(name: str) -> str | None:
    """A dotted name without derivatives."""
    parts = []
    for part in name.split("."):
        match = _PART.fullmatch(part)
        if match is None:
            return None
        identifier = match["identifier"]
        indices = match["indices"].replace(" ", "")
        if indices and not _INDICES.fullmatch(indices):
            return None
        if not _PLAIN.fullmatch(identifier):
            if not _QUOTABLE.fullmatch(identifier):
                return None
            identifier = "'" + re.sub(r"(['\"\\])", r"\\\1", identifier) + "'"
        parts.append(identifier + indices)
    return ".".join(parts)


def variable_names(names: Iterable[str]) -> tuple[str, tuple[str, ...]]:
    """FMI's naming convention for all `names` together, and the names under it.

    `structured` where every name has a structured form, else `flat` with the names as they are.
    ValueError if two are the same.
    """
    plain = tuple(names)
    if len(set(plain)) < len(plain):
        twice = sorted({name for name in plain if plain.count(name) > 1})
        raise ValueError(f"variables share a name: {', '.join(twice)}")
    structured = [name for name in map(structured_name, plain) if name is not None]
    if len(structured) == len(plain):
        return "structured", tuple(structured)
    return "flat", plain


def model_identifier(name: str) -> str:
    """A model's name as an identifier of C, which names the library and the folder of its files."""
    identifier = re.sub(r"[^A-Za-z0-9_]", "_", name)
    return identifier if _PLAIN.fullmatch(identifier) else f"_{identifier}"
