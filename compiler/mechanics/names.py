"""Names of the scalars of variables with a shape."""

from __future__ import annotations


def component_names(name: str, shape: tuple[int, ...]) -> list[str]:
    """`x`, or `x[1]`, `x[2]`, or `x[1,1]`, `x[1,2]`: by rows."""
    names = [""]
    for size in shape:
        names = [f"{n},{k + 1}" if n else f"{k + 1}" for n in names for k in range(size)]
    return [f"{name}[{n}]" if n else name for n in names]
