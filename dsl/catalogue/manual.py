"""The tables of docs/language.md, written from the catalogue.

`python -m frot.dsl.catalogue.manual` writes them anew between their markers; a test compares them.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

from frot.dsl.catalogue.figures import CURVES, SURFACES, FigureKind
from frot.dsl.catalogue.forces import FORCES
from frot.dsl.catalogue.functions import FUNCTIONS, Function
from frot.dsl.catalogue.kinds import Argument, LiaisonKind
from frot.dsl.catalogue.laws import LAWS
from frot.dsl.catalogue.liaisons import LIAISONS
from frot.dsl.catalogue.members import coordinates_of
from frot.dsl.catalogue.shapes import SHAPES

PAGE = Path(__file__).parents[2] / "docs" / "language.md"


def _code(names: Iterable[str]) -> str:
    return ", ".join(f"`{name}`" for name in names)


def _name(name: str, aliases: tuple[str, ...]) -> str:
    return f"`{name}` ({_code(aliases)})" if aliases else f"`{name}`"


def _default(argument: Argument) -> str:
    if argument.required:
        return ""
    if argument.default_of:
        return f" = {argument.default_of}"
    value = argument.default
    if value is None:
        return " = ..."
    if isinstance(value, bool):
        return f" = {'true' if value else 'false'}"
    return f" = {value:g}" if isinstance(value, float) else f" = {value}"


def _arguments(arguments: Iterable[Argument]) -> str:
    """The arguments in order with their defaults; `...` may be left out."""
    return _code(f"{a.name}{_default(a)}" for a in arguments)


def _unit(argument: Argument) -> str:
    if argument.kind in ("boolean", "word"):
        return " or ".join(argument.words) or "true or false"
    units = [t.dimension.unit for t in (argument.type, *argument.others)]
    known = [unit or "1" for unit in units]
    return "" if argument.kind in ("place", "holder", "axis", "number") else " or ".join(known)


def _explained(arguments: Iterable[Argument]) -> str:
    """Each argument with its meaning and unit."""
    said = []
    for argument in arguments:
        unit = _unit(argument)
        more = f" ({unit})" if unit else ""
        said.append(f"`{argument.name}{_default(argument)}` {argument.doc}{more}")
    return "; ".join(said)


def _table(head: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> str:
    lines = [head, tuple("---" for _ in head), *rows]
    return "\n".join(f"| {' | '.join(line)} |".replace("|  |", "| |") for line in lines)


def _shapes() -> str:
    rows = []
    for kind in SHAPES.values():
        models = (
            "plane, space" if kind.planar and kind.space else "plane" if kind.planar else "space"
        )
        kinds = dict.fromkeys(kind.geometry.values())
        geometry = "; ".join(
            f"{of}: {_code(n for n, its in kind.geometry.items() if its == of)}" for of in kinds
        )
        name = _name(kind.name, kind.aliases)
        rows.append(
            (name, _arguments(kind.arguments), models, _code(kind.frames), geometry, kind.doc)
        )
    return _table(("shape", "arguments", "models", "named points", "geometry", "meaning"), rows)


def _figures(head: str, kinds: Mapping[str, FigureKind]) -> str:
    rows = [
        (
            _name(kind.name, kind.aliases),
            f"`{kind.form}`" if kind.form else _explained(kind.arguments),
            kind.doc,
        )
        for kind in kinds.values()
    ]
    return _table((head, "arguments", "meaning"), rows)


def _places(kind: LiaisonKind) -> str:
    a, b = (" or ".join(argument.places) for argument in kind.arguments[:2])
    return f"{a}; {b}"


def _relations(kind: LiaisonKind, number: int) -> str:
    """The number of relations; a liaison of faces has one at each corner."""
    return "one a corner" if kind.unilateral and not number else str(number)


def _liaisons(planar: bool) -> str:
    rows = []
    for kind in LIAISONS.values():
        relations = kind.relations_planar if planar else kind.relations_space
        if relations is None:
            continue
        options = [a for a in kind.arguments[2:] if not (planar and a.space_only)]
        rows.append(
            (
                _name(kind.name, kind.aliases),
                _places(kind),
                _arguments(options),
                _relations(kind, relations),
                _code(coordinates_of(kind, planar)),
                kind.doc,
            )
        )
    return _table(("liaison", "a; b", "options", "relations", "coordinates", "meaning"), rows)


def _laws() -> str:
    rows = [(_name(k.name, k.aliases), _explained(k.arguments), k.doc) for k in LAWS.values()]
    return _table(("law", "arguments", "meaning"), rows)


def _laws_of_liaisons() -> str:
    takers = [k for k in LIAISONS.values() if k.laws or k.laws_in_space]
    rows = [(f"`{k.name}`", _code(k.laws), _code(k.laws_in_space)) for k in takers]
    return _table(("liaison", "in the plane", "in space"), rows)


def _forces() -> str:
    rows = [(_name(k.name, k.aliases), _explained(k.arguments), k.doc) for k in FORCES.values()]
    return _table(("force", "arguments", "meaning"), rows)


def _count(function: Function) -> str:
    return function.count if function.least else "none"


def _operands(function: Function) -> str:
    if function.rule is None:
        return {"array": "arrays", "event": "equations", "rate": "a variable"}[function.place]
    if function.rule.vectors:
        return "vectors"
    if function.rule.plain:
        return "numbers"
    return "one dimension" if function.rule.alike else "any dimension"


def _functions() -> str:
    rows = [(f"`{f.name}`", _count(f), _operands(f), f.doc) for f in FUNCTIONS.values()]
    return _table(("function", "how many", "operands", "meaning"), rows)


TABLES: Mapping[str, Callable[[], str]] = {
    "shapes": _shapes,
    "curves": lambda: _figures("curve", CURVES),
    "surfaces": lambda: _figures("surface", SURFACES),
    "liaisons of the plane": lambda: _liaisons(True),
    "liaisons of space": lambda: _liaisons(False),
    "laws": _laws,
    "laws of liaisons": _laws_of_liaisons,
    "forces": _forces,
    "functions": _functions,
}


def written(page: str) -> str:
    """The page with every table between its markers as the catalogue has it."""
    for name, make in TABLES.items():
        marks = f"<!-- table: {name} -->", "<!-- end of table -->"
        pattern = re.compile(f"{marks[0]}\n.*?{marks[1]}", re.DOTALL)
        text = f"{marks[0]}\n{make()}\n{marks[1]}"
        before, *after = pattern.split(page)
        if len(after) != 1:
            raise ValueError(f"the marker of the table '{name}' stands {len(after)} times")
        page = before + text + after[0]
    return page


if __name__ == "__main__":
    PAGE.write_text(written(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
    print(f"written: {PAGE}")
