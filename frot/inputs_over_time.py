"""Models whose inputs are functions of time: an input becomes a polynomial with given coefficients.

The reference to an input F stands for F@0 + s (F@1 + s (F@2 + s F@3)) with s = time - F@from, so
that rates of what it drives are those of the polynomial. The five are inputs of the program, which
the run changes at the knots of a table; the program does not depend on the numbers of the table.
"""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from frot.dsl.catalogue import TYPES
from frot.dsl.messages.errors import fail
from frot.dsl.quantities.dimensions import Type
from frot.runtime.tables import moving_of

if TYPE_CHECKING:
    from frot.compiled_model import CompiledModel
    from frot.runtime.program import ParameterInfo, Program
    from frot.runtime.tables import Table

FILE = re.compile(r"(?P<file>.+\.(?:csv|tsv|txt))(?::(?P<column>[^:]*))?(?::(?P<way>\w+))?")
HEAD = re.compile(r"\s*(?P<name>.*?)\s*(?:[(\[](?P<unit>[^)\]]*)[)\]])?\s*")


def driven_program(
    model: CompiledModel,
    inputs: Mapping[str, object] | None,
    start: float | str | None,
    stop: float | str | None,
) -> tuple[Program, Mapping[str, object] | None, tuple[Table, ...]]:
    """The program for these inputs, those that are constant, and those over time.

    Raises:
        FrotError: E0804, E0821: values over time that cannot be read, or are no function of time.
    """
    from frot.runtime.tables import is_table, make_table

    if not isinstance(inputs, Mapping) or not any(
        is_table(x) or (isinstance(x, str) and FILE.fullmatch(x.strip())) for x in inputs.values()
    ):
        return model.program(), inputs, ()
    program = model.program()
    infos = {one.name: one for one in program.inputs}
    constants, tables = {}, []
    for name, value in inputs.items():
        info = infos.get(str(name).replace(" ", ""))
        if info is None or "[" in info.name:
            constants[name] = value
            continue
        given = read_file(value, info) if isinstance(value, str) else value
        if given is None or not is_table(given):
            constants[name] = value
        else:
            tables.append(make_table(info, given, _span(program, start, stop)))
    moving = moving_of(tables)
    if moving:
        from frot.second import second_program

        program = second_program(model, "", moving=moving)
    return program, constants, tuple(tables)


def _span(
    program: Program, start: float | str | None, stop: float | str | None
) -> tuple[float, float]:
    """Begin and end of a run, as far as they are known before it."""
    from frot.runtime.settings import read_option

    begin, end = program.experiment.times()
    first, last = read_option("start", start, "s"), read_option("stop", stop, "s")
    return (begin if first is None else first), (end if last is None else last)


def read_file(text: str, info: ParameterInfo) -> tuple[list[float], list[float], str | None] | None:
    """Times, values and way of `FILE.csv:COLUMN` or `FILE.csv:COLUMN:WAY`; None of another text.

    The first line names the columns, each with its unit in brackets or in SI. The times are those
    of the column `time` or `t`, or of the first. FrotError (E0804, E0821) for what cannot be read.
    """
    asked = FILE.fullmatch(text.strip())
    if asked is None:
        return None
    path = Path(asked["file"])
    try:
        content = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        why = getattr(error, "strerror", None) or str(error)
        raise fail("E0804", f"'{path}' cannot be read: {why}", help="check the path") from None
    separator = "\t" if path.suffix == ".tsv" else ","
    rows = [row for row in csv.reader(content.splitlines(), delimiter=separator) if any(row)]
    if not rows:
        raise fail("E0821", f"'{path}' is empty", help="write names of columns, then their values")
    heads = [HEAD.fullmatch(x) for x in rows[0]]
    names = ["" if head is None else head["name"] for head in heads]
    units = ["" if head is None else head["unit"] or "" for head in heads]
    column = _column(path, names, (asked["column"] or "").strip())
    clock = next((k for k, name in enumerate(names) if name.lower() in ("time", "t")), 0)
    seconds = _factor(path, units[clock], TYPES["Time"], "s")
    factor = _factor(path, units[column], _type_of(info), info.unit.name)
    times = [_number(path, k, row, clock) * seconds for k, row in enumerate(rows[1:], 2)]
    values = [_number(path, k, row, column) * factor for k, row in enumerate(rows[1:], 2)]
    return times, values, asked["way"]


def _column(path: Path, names: list[str], name: str) -> int:
    if name in names:
        return names.index(name)
    from frot.runtime.run_values import nearest

    listed = ", ".join(repr(x) for x in names)
    raise fail(
        "E0821",
        f"'{path}' has no column '{name}'" if name else f"no column of '{path}' is named",
        notes=(f"columns: {listed}",),
        help=nearest(name, names) or f"name one of them, as {path}:{names[-1]}",
    )


def _type_of(info: ParameterInfo) -> Type:
    from fractions import Fraction

    from frot.dsl.quantities.dimensions import Dimension

    of = Dimension(tuple(Fraction(e) for e in info.unit.exponents[:7]))
    return Type(info.type, of)


def _factor(path: Path, unit: str, kind: Type, si: str) -> float:
    """The SI value of one unit of a column; FrotError (E0821) where it is of another dimension."""
    from frot.dsl import parse_value

    if unit in ("", "1", "-"):
        return 1.0
    try:
        return float(parse_value(f"1 {unit}", kind, si=si))  # type: ignore[arg-type]
    except ValueError as error:
        words = f"the unit '{unit}' of a column of '{path}' does not fit: {error}"
        raise fail("E0821", words, help=f"give it in {si}, or in a unit of that kind") from None


def _number(path: Path, line: int, row: list[str], column: int) -> float:
    """The number in a cell; FrotError (E0821) where there is none."""
    text = row[column].strip() if column < len(row) else ""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        what = f"'{text}', which is no number" if text else "nothing"
        words = f"{path}:{line}: column {column + 1} has {what}"
        raise fail("E0821", words, help="write a number there, or leave the line out")
    return value
