"""Lowered functions and tables to one C file that defines `frot_the_model`."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Iterator
from pathlib import Path

import casadi as ca
from frot.compiler.lowering.assembled import Assembled
from frot.compiler.lowering.groups import Group
from frot.compiler.lowering.jacobian import alike
from frot.compiler.lowering.lower import Lowered
from frot.compiler.lowering.symbols import column
from frot.compiler.mechanics.elements import Bound, Element
from frot.compiler.mechanics.mechanism import Joint, Relation
from frot.compiler.mechanics.motions import count_speeds
from frot.compiler.product.c_tables import array as _array
from frot.compiler.product.c_tables import callable_record as _callable
from frot.compiler.product.c_tables import number as _number
from frot.compiler.product.c_tables import record as _record
from frot.compiler.product.islands import island_arrays, read_numbers, shared_functions
from frot.compiler.product.split import split_functions
from frot.dsl.messages.source import Span

_METHODS = {"auto": 0, "explicit": 1, "implicit": 2}
# The kernel gives every argument and takes every result: without the questions whether it does, a
# function is one straight line, which C compilers take in time proportional to its length.
_ABSENT = re.compile(r"(arg\[\d+\])\? (\1\[\d+\]) : 0")
_UNASKED = re.compile(r"if \(res\[\d+\]!=0\) (?=res\[)")
# Characters of C beyond which GCC looks for no more than it finds in such time.
_LONG = 100_000
_QUICK = '#if defined(__GNUC__) && !defined(__clang__)\n#pragma GCC optimize("O1")\n#endif\n'

# The packed arrays of groups in the order of frot_group, and the tables of the mechanics.
_PACKED = ("vector", "matrix", "metric", "entries", "square")
_MECHANICAL = (
    *(
        "contacts",
        "elements",
        "groups",
        "islands",
        "row_reads",
        "row_beside",
        "row_group",
        "row_local",
        "contact_group",
    ),
    *("speed_group", "speed_local", "speed_coordinate", "turns", "speed_turns"),
)

# The tables of frot_pattern, in its order.
_PATTERN = ("order", "start", "column", "diagonal", "entry_row", "entry_column", "place")


def generate(lowered: Lowered, key: str, defaults: list[float], inputs: list[float]) -> str:
    """The C text. `key` identifies it; `defaults` and `inputs` are start values in SI."""
    reduced = lowered.reduced
    symbols, model = reduced.symbols, reduced.mechanism.model
    system, contacts = lowered.system, reduced.mechanism.contacts
    tables = [
        _array("double", "p_default", [_number(x) for x in defaults]),
        _array("double", "u_default", [_number(x) for x in inputs]),
        *_mechanical_arrays(lowered),
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
        **_packed_sizes(lowered),
        "n_discrete": system.discrete.numel(),
        "n_watched": len(lowered.watched),
        "n_held": len(reduced.text.held),
        "n_located": reduced.conditions.located,
        "n_timed": reduced.conditions.timed,
        "n_blocks": len(system.blocks),
        "n_invariants": len(system.invariants.origins),
        "n_whens": len(reduced.events.fired),
        "n_outcomes": len(reduced.events.outcomes),
        "method": _METHODS[reduced.mechanism.model.experiment.method],
        "has_jacobian": int(lowered.jacobian is not None),
        "pattern": _pattern(lowered),
        "general": int(not lowered.grouping.is_mass_matrix),
        "late_rates": int(system.late),
        "n_conditions": len(reduced.conditions.flags),
        "time_dependent": int(_depends_on_time(lowered)),
        "n_carried": len(lowered.carried),
        "n_paced": _n_paced(lowered),
        "n_checks": len(lowered.checks),
        "n_position": len(lowered.position_statement),
        "n_velocity": len(lowered.velocity_statement),
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
            *_MECHANICAL,
            "checks",
            "carried",
            "statements",
            "loads",
            "states",
            "held",
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


def _mechanical_arrays(lowered: Lowered) -> list[str]:
    """Contacts, elements and groups, and where rows, contacts and speeds stand in their groups."""
    reduced, grouping, system = lowered.reduced, lowered.grouping, lowered.system
    sliding = {e.contact: k for k, e in enumerate(grouping.elements) if not e.rolling}
    joints = zip(reduced.mechanism.contacts, reduced.contact_rows, strict=True)
    contacts = [
        (x.liaison.name, x.liaison.span, -1 if isinstance(x, Joint) else r.reaction[0], x.reduced)
        for x, r in joints
    ]
    contacts += [(e.name, e.span, -1, True) for e in system.elements]
    first = [not isinstance(x, Relation) or x.first for x in reduced.mechanism.contacts]
    first += [True] * len(system.elements)
    kinematic = [isinstance(x, Relation) and x.lock.kinematic for x in reduced.mechanism.contacts]
    kinematic += [False] * len(system.elements)
    places = {v.name: k for k, v in enumerate(lowered.variables)}
    arrays = [
        _array(
            "frot_contact",
            "contacts",
            [
                _record(
                    _text(name),
                    _text(_place(span)),
                    *(row, int(kept), sliding.get(i, -1), places.get(f"{name}.power", -1)),
                    places[f"{name}.mode"] if first[i] else -1,
                    int(kinematic[i]),
                )
                for i, (name, span, row, kept) in enumerate(contacts)
            ],
        ),
        _array(
            "frot_element",
            "elements",
            [
                _record(
                    *(e.contact, e.bound.value, e.row),
                    _record(*(*e.bounded_by, -1, -1)[:2]),
                    *(int(e.rolling), int(e.fixed), int(e.row in grouping.prescribed)),
                    _record(*_shown(e, contacts[e.contact][0], places)),
                )
                for e in grouping.elements
            ],
        ),
    ]
    records: list[str] = []
    at = [0] * len(_PACKED)
    for k, g in enumerate(grouping.groups):
        lists = (g.unknowns, g.rows, g.contacts, g.elements)
        names = [f"group_{k}_{name}" for name in ("unknowns", "rows", "contacts", "elements")]
        for name, items in zip(names, lists, strict=True):
            arrays.append(_array("int", name, [str(i) for i in items]))
        counts = (int(g.general), len(g.unknowns), g.n_speeds, g.n_auxiliary, *map(len, lists[1:]))
        steps = f"group_{k}_steps"
        if g.tree is not None:
            links = [
                _record(
                    *(x.above, x.first, x.count, int(x.auxiliary), int(x.faces_ground)),
                    *(x.data, x.factor),
                )
                for x in g.tree.steps
            ]
            arrays.append(_array("frot_link", steps, links))
        along = (g.tree.width, len(g.tree.steps), steps) if g.tree else (0, 0, "0")
        records.append(_record(*counts, *names, *at, *along))
        at = [a + size for a, size in zip(at, _group_sizes(g), strict=True)]
    groups = grouping.groups
    beside = {
        e.row: e.bounded_by[0]
        for e in grouping.elements
        if e.bound is Bound.NORMAL and not e.rolling
    }
    motions = [m for h in reduced.mechanism.coordinates for m in h.motions]
    whether = [m.turns for m in motions for _ in range(count_speeds(m))]
    own = zip(_symbols(reduced.symbols.v), whether, strict=True)
    turning = {speed for speed, turns in own if turns}
    tables = {
        "row_reads": grouping.row_reads,
        "row_beside": [beside.get(r, -1) for r in range(len(grouping.row_reads))],
        "row_group": _places({r: k for k, g in enumerate(groups) for r in g.rows}),
        "row_local": _places({r: i for g in groups for i, r in enumerate(g.rows)}),
        "contact_group": _places({c: k for k, g in enumerate(groups) for c in g.contacts}),
        "speed_group": _places(
            {z: k for k, g in enumerate(groups) for z in g.unknowns[: g.n_speeds]}
        ),
        "speed_local": _places(
            {z: i for g in groups for i, z in enumerate(g.unknowns[: g.n_speeds])}
        ),
        "speed_coordinate": [
            system.q_speed.index(k) if k in system.q_speed else -1 for k in range(system.nv)
        ],
        "speed_turns": [int(x in turning) for x in _symbols(system.v)],
    }
    turns = reduced.symbols.turns
    arrays.append(
        _array(
            "frot_turn",
            "turns",
            [_record(t.coordinate, _record(*t.speeds), int(t.own_axes)) for t in turns],
        )
    )
    arrays.append(_array("frot_group", "groups", records))
    arrays += [_array("int", name, [str(i) for i in table]) for name, table in tables.items()]
    return arrays


def _symbols(values: ca.SX) -> list[int]:
    return [x.element_hash() for x in ca.vertsplit(values)] if values.numel() else []


def _shown(element: Element, name: str, places: dict[str, int]) -> tuple[int, int]:
    """The variables that are the motion of an element of the liaison `name`."""
    if element.rolling or element.bound is Bound.VALUE:
        return -1, -1
    return places.get(f"{name}.slip", -1), places.get(f"{name}.speed", -1)


def _places(values: dict[int, int]) -> list[int]:
    return [values[k] for k in range(len(values))]


def _group_sizes(g: Group) -> tuple[int, ...]:
    """Items of a group in the arrays of `_PACKED`."""
    n, rows = len(g.unknowns), len(g.rows)
    if g.tree is not None:
        return n, int(g.tree.data.numel()), g.tree.factor, rows * n, rows**2
    return n, n * n, g.n_speeds**2, rows * n, rows**2


def _packed_sizes(lowered: Lowered) -> dict[str, int]:
    sizes = [_group_sizes(g) for g in lowered.grouping.groups]
    return {
        f"n_{name}": sum(s[k] for s in sizes) for k, name in enumerate(_PACKED) if name != "vector"
    }


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
    names = [f"pattern_{name}" for name in _PATTERN]
    return _record(len(jacobian.factors.order), len(jacobian.rows), *names)


def _pattern_arrays(lowered: Lowered) -> list[str]:
    jacobian = lowered.jacobian
    if jacobian is None or jacobian.factors is None:
        return []
    f = jacobian.factors
    tables = (f.order, f.starts, f.columns, f.diagonal, jacobian.rows, jacobian.columns, f.places)
    return [
        _array("int", f"pattern_{name}", [str(k) for k in table])
        for name, table in zip(_PATTERN, tables, strict=True)
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


def _text(value: str) -> str:
    """A C string literal in UTF-8, with octal escapes for all that is not plain."""
    out = []
    for byte in value.encode("utf-8"):
        plain = 32 <= byte < 127 and byte not in b'"\\?'
        out.append(chr(byte) if plain else f"\\{byte:03o}")
    return '"' + "".join(out) + '"'


def _place(span: Span | None) -> str:
    return span.place if span is not None else ""


def _type(base: str) -> int:
    return {"real": 0, "integer": 1, "boolean": 2}[base]
