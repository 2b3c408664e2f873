"""Lowered functions and tables to one C file that defines `frot_the_model`."""

from __future__ import annotations

import itertools
import re
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

import casadi as ca
from frot.compiler.lowering.assembled import Assembled
from frot.compiler.lowering.jacobian import alike
from frot.compiler.lowering.lower import Lowered
from frot.compiler.lowering.price import price_of_implicit
from frot.compiler.lowering.symbols import column
from frot.compiler.product.c_mechanics import MECHANICAL_TABLES, mechanical_arrays, packed_sizes
from frot.compiler.product.c_tables import array as _array
from frot.compiler.product.c_tables import callable_record as _callable
from frot.compiler.product.c_tables import number as _number
from frot.compiler.product.c_tables import place as _place
from frot.compiler.product.c_tables import record as _record
from frot.compiler.product.c_tables import text as _text
from frot.compiler.product.islands import island_arrays, read_numbers, shared_functions
from frot.compiler.product.split import split_functions

_METHODS = {"auto": 0, "explicit": 1, "implicit": 2}
# The kernel gives every argument and takes every result: without the questions whether it does, a
# function is one straight line, which C compilers take in time proportional to its length.
_ABSENT = re.compile(r"(arg\[\d+\])\? (\1\[\d+\]) : 0")
_UNASKED = re.compile(r"if \(res\[\d+\]!=0\) (?=res\[)")
# Characters of C beyond which GCC looks for no more than it finds in such time.
_LONG = 100_000
_QUICK = '#if defined(__GNUC__) && !defined(__clang__)\n#pragma GCC optimize("O1")\n#endif\n'

# The tables of frot_lines and of frot_pattern, in their order.
_LINES = ("line", "column", "first", "direction", "group_start", "group_column")
_PATTERN = ("order", "start", "column", "diagonal", "entry_row", "entry_column", "place")


def generate(lowered: Lowered, key: str, defaults: list[float], inputs: list[float]) -> str:
    """The C text. `key` identifies it; `defaults` and `inputs` are start values in SI."""
    reduced = lowered.reduced
    symbols, model = reduced.symbols, reduced.mechanism.model
    system, contacts = lowered.system, reduced.mechanism.contacts
    tables = [
        _array("double", "p_default", [_number(x) for x in defaults]),
        _array("double", "u_default", [_number(x) for x in inputs]),
        *mechanical_arrays(lowered),
        *island_arrays(lowered),
        _array(
            "frot_check",
            "checks",
            [_record(c.rule, _text(c.subject), _text(_place(c.span))) for c in lowered.checks],
        ),
        _array(
            "frot_carried",
            "carried",
            [_record(_text(c.body), _text(c.by), _text(_place(c.span))) for c in lowered.carried],
        ),
        _array(
            "frot_statement",
            "statements",
            [
                _record(_text(s.text), _text(_place(s.span)), _text(s.unit))
                for s in lowered.statements
            ],
        ),
        _array(
            "frot_load",
            "loads",
            [_record(_text(f.name), _text(_place(f.span))) for f in reduced.mechanism.forces],
        ),
        _array(
            "frot_load",
            "equations",
            [_record(_text(o.text), _text(_place(o.span))) for o in lowered.watched],
        ),
        _array(
            "frot_vanishing",
            "vanishings",
            [
                _record(_text(x.text), _text(_where(x.names)), _text(_place(x.liaison.span)))
                for x in lowered.vanishing
            ],
        ),
        _array(
            "frot_held",
            "held",
            [_record(_text(h.name), _text(_place(h.span))) for h in reduced.text.held],
        ),
        _array("frot_load", "states", [_record(*x) for x in _states(system)]),
        _array("int", "position_statement", [str(i) for i in lowered.position_statement]),
        _array("int", "velocity_statement", [str(i) for i in lowered.velocity_statement]),
        _array("int", "p_dependent", [str(int(x)) for x in lowered.dependent]),
        _array("int", "p_type", [str(_type(p.type.base)) for p in symbols.parameters]),
        _array(
            "unsigned char",
            "row_depends",
            [str(int(x)) for row in lowered.row_depends for x in row],
        ),
        _array(
            "frot_condition",
            "conditions",
            [
                _record(_text(text), told, _text(_place(span)))
                for text, told, span in zip(
                    reduced.conditions.texts,
                    reduced.conditions.told,
                    reduced.conditions.spans,
                    strict=True,
                )
            ],
        ),
        _array(
            "unsigned char", "condition_strict", [str(int(x)) for x in reduced.conditions.strict]
        ),
        _array("int", "q_speed", [str(k) for k in system.q_speed]),
        _array("int", "q_alike", [str(k) for k in alike(system)]),
        *_pattern_arrays(lowered),
        _array(
            "frot_block",
            "blocks",
            [
                _record(
                    _callable(f),
                    *(b.first, b.residual.numel(), int(b.linear), int(b.late)),
                    _text(b.name),
                    _text(_place(b.span)),
                )
                for b, f in zip(system.blocks, lowered.blocks, strict=True)
            ],
        ),
        _array("int", "when_condition", [str(k) for k in reduced.events.conditions]),
        _array("int", "mode_contact", [str(k) for k, _ in reduced.variables.modes.values()]),
        _array("unsigned char", "when_at_start", [str(int(x)) for x in reduced.events.at_start]),
        _array(
            "frot_outcome",
            "outcomes",
            [
                _record(o.kind, _text(o.text), _text(_place(o.span)))
                for o in reduced.events.outcomes
            ],
        ),
    ]
    callables = "\n".join(f"  .{n} = {_callable(f)}," for n, f in lowered.functions.items())
    fields = {
        "nq": system.q.numel(),
        "nv": system.nv,
        "na": system.na,
        "nc": system.nc,
        "nu": symbols.u.numel(),
        "np": symbols.p.numel(),
        "ny": system.y.numel(),
        "n_rows": system.lam.numel(),
        "n_contacts": len(contacts) + len(system.elements),
        "n_elements": len(lowered.grouping.elements),
        "n_turns": len(symbols.turns),
        "n_groups": len(lowered.grouping.groups),
        "n_islands": len(lowered.islands),
        **packed_sizes(lowered),
        "n_discrete": system.discrete.numel(),
        "n_watched": len(lowered.watched),
        "n_vanishing": len(lowered.vanishing),
        "n_held": len(reduced.text.held),
        "n_modes": len(reduced.variables.modes),
        "n_located": reduced.conditions.located,
        "n_sensed": reduced.conditions.sensed,
        "n_timed": reduced.conditions.timed,
        "n_blocks": len(system.blocks),
        "n_invariants": len(system.invariants.origins),
        "n_whens": len(reduced.events.fired),
        "n_outcomes": len(reduced.events.outcomes),
        "method": _METHODS[reduced.mechanism.model.experiment.method],
        "has_jacobian": int(lowered.jacobian is not None),
        "implicit_price": price_of_implicit(lowered),
        "pattern": _pattern(lowered),
        "lines": _lines(lowered),
        "general": int(not lowered.grouping.is_mass_matrix),
        "late_rates": int(system.late),
        "n_conditions": len(reduced.conditions.flags),
        "time_dependent": int(_depends_on_time(lowered)),
        "n_carried": len(lowered.carried),
        "n_paced": _n_paced(lowered),
        "n_checks": len(lowered.checks),
        "n_position": len(lowered.position_statement),
        "n_velocity": len(lowered.velocity_statement),
        "n_guessed": lowered.n_guessed,
        "n_statements": len(lowered.statements),
        "n_variables": len(lowered.variables),
        "n_loads": len(reduced.mechanism.forces),
    }
    numbers = "\n".join(f"  .{name} = {value}," for name, value in fields.items())
    pointers = "\n".join(
        f"  .{name} = {name},"
        for name in [
            "p_default",
            "u_default",
            *MECHANICAL_TABLES,
            "checks",
            "carried",
            "statements",
            "loads",
            "states",
            "held",
            "vanishings",
            "equations",
            "position_statement",
            "velocity_statement",
            "p_dependent",
            "p_type",
            "row_depends",
            "conditions",
            "condition_strict",
            "q_speed",
            "q_alike",
            "blocks",
            "when_condition",
            "mode_contact",
            "when_at_start",
            "outcomes",
        ]
    )
    return (
        f"/* Generated by Frot from {model.name}. Do not edit. */\n"
        '#include "frot.h"\n'
        "/* Only the model's table is seen from outside. */\n"
        "#define CASADI_SYMBOL_EXPORT static\n"
        f"{_functions(lowered)}\n" + "\n".join(tables) + "\nconst frot_model frot_the_model = {\n"
        f"  .name = {_text(model.name)},\n  .key = {_text(key)},\n"
        f"{numbers}\n{callables}\n{pointers}\n}};\n"
    )


def _where(names: tuple[str, ...]) -> str:
    """The words for the numbers of a place, with their form."""
    told = ", ".join(f"{name} = %.6g" for name in names)
    return f" at {told}" if told else ""


def _states(system: Assembled) -> Iterator[tuple[str, str]]:
    """Names and places of the coordinates and speeds."""
    chains = system.reduced.text.chains
    for x in (system.q, system.v):
        for symbol in ca.vertsplit(x) if x.numel() else ():
            chain, _ = chains.place.get(symbol.element_hash(), (-1, 0))
            span = chains.items[chain].span if chain >= 0 else None
            yield _text(symbol.name()), _text(_place(span) if span is not None else "")


def _pattern(lowered: Lowered) -> str:
    jacobian = lowered.jacobian
    if jacobian is None or jacobian.factors is None:
        return "{0}"
    order = len(jacobian.factors.order)
    return _record(order, len(jacobian.rows), *(f"pattern_{name}" for name in _PATTERN))


def _pattern_arrays(lowered: Lowered) -> list[str]:
    jacobian = lowered.jacobian
    if jacobian is None:
        return []
    arrays = []
    if jacobian.factors:
        f = jacobian.factors
        places = (jacobian.rows, jacobian.columns, f.places)
        tables = [f.order, f.starts, f.columns, f.diagonal, *places]
        arrays = _integers("pattern", _PATTERN, tables)
    if jacobian.lines:
        x = jacobian.lines
        starts = itertools.accumulate((len(c) for c in x.of_groups), initial=0)
        columns = itertools.chain(*x.of_groups)
        tables = [x.rows, x.columns, x.first, x.directions, tuple(starts), tuple(columns)]
        arrays += _integers("lines", _LINES, tables)
    return arrays


def _lines(lowered: Lowered) -> str:
    lines = lowered.jacobian.lines if lowered.jacobian else None
    if lines is None:
        return "{0}"
    return _record(lines.n_directions, *(f"lines_{name}" for name in _LINES))


def _integers(prefix: str, names: Sequence[str], tables: Sequence[tuple[int, ...]]) -> list[str]:
    return [
        _array("int", f"{prefix}_{name}", [str(k) for k in table])
        for name, table in zip(names, tables, strict=True)
    ]


def _depends_on_time(lowered: Lowered) -> bool:
    """Whether anything moves or switches by time alone."""
    reduced, system = lowered.reduced, lowered.system
    time = reduced.symbols.t
    located = reduced.conditions.values[: reduced.conditions.located]
    moved = (
        *(
            system.force,
            system.matrix,
            lowered.grouping.matrix,
            system.rows,
            system.bias,
            system.coefficients,
            system.gap,
        ),
        *(system.rates, system.resolve(column(located))),
        *(b.residual for b in system.blocks),
    )
    return any(x.numel() and ca.depends_on(x, time) for x in moved)


def _n_paced(lowered: Lowered) -> int:
    pace = lowered.functions.get("pace")
    return 0 if pace is None else int(pace.numel_out(0))


def _functions(lowered: Lowered) -> str:
    generator = ca.CodeGenerator("frot_functions.c", {"casadi_int": "long long int"})
    for function in (*lowered.functions.values(), *lowered.blocks, *shared_functions(lowered)):
        generator.add(function)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(generator.generate(folder + "/"))
        text = path.read_text(encoding="utf-8")
    if "#error" in text:
        raise RuntimeError("CasADi could not generate C for a function of the model")
    text = _UNASKED.sub("", _ABSENT.sub(r"\2", text))
    text = split_functions(read_numbers(text, lowered))
    return (_QUICK + text) if len(text) > _LONG else text


def _type(base: str) -> int:
    return {"real": 0, "integer": 1, "boolean": 2}[base]
