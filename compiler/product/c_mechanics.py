"""Tables of the mechanics in C: contacts, elements, groups, and where rows and speeds stand."""

from __future__ import annotations

import casadi as ca
from frot.compiler.lowering.groups import Group
from frot.compiler.lowering.lower import Lowered
from frot.compiler.mechanics.elements import Bound, Element
from frot.compiler.product.c_tables import array as _array
from frot.compiler.product.c_tables import place as _place
from frot.compiler.product.c_tables import record as _record
from frot.compiler.product.c_tables import text as _text

_NEVER_SLIPS = -2  # FROT_NEVER_SLIPS
# The packed arrays of groups in the order of frot_group, and the tables of the mechanics.
_PACKED = ("vector", "matrix", "metric", "entries", "square")
MECHANICAL_TABLES = (
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


def mechanical_arrays(lowered: Lowered) -> list[str]:
    """Contacts, elements and groups, and where rows, contacts and speeds stand in their groups."""
    reduced, grouping, system = lowered.reduced, lowered.grouping, lowered.system
    sliding = {e.contact: k for k, e in enumerate(grouping.elements) if not e.rolling}
    for k, link in enumerate(reduced.mechanism.contacts):
        if link.rolls and not link.reduced:
            sliding[k] = _NEVER_SLIPS
    joints = zip(reduced.mechanism.contacts, reduced.contact_rows, strict=True)
    contacts = [
        (x.liaison.name, x.liaison.span, r.reaction[0] if x.has_normal else -1, x.reduced)
        for x, r in joints
    ]
    contacts += [(e.name, e.span, -1, True) for e in system.elements]
    first = [x.first for x in reduced.mechanism.contacts]
    first += [True] * len(system.elements)
    kinematic = [x.kinematic for x in reduced.mechanism.contacts]
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
    whether = [m.turns for m in motions for _ in range(m.speed_count)]
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


def packed_sizes(lowered: Lowered) -> dict[str, int]:
    """Items of the packed arrays of all groups together."""
    sizes = [_group_sizes(g) for g in lowered.grouping.groups]
    return {
        f"n_{name}": sum(s[k] for s in sizes) for k, name in enumerate(_PACKED) if name != "vector"
    }
