"""Tables of the mechanics in C: contacts, elements, groups, and where rows and speeds stand."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import casadi as ca
from frot.compiler.equations.text_slips import slip_names
from frot.compiler.lowering.groups import Group, Grouping
from frot.compiler.lowering.lower import Lowered
from frot.compiler.mechanics.laws.elements import Bound, Element
from frot.compiler.mechanics.laws.restitution import restitution_of
from frot.compiler.product.c_tables import array as _array
from frot.compiler.product.c_tables import place as _place
from frot.compiler.product.c_tables import record as _record
from frot.compiler.product.c_tables import text as _text
from frot.dsl.messages.source import Span

_NEVER_SLIPS = -2  # FROT_NEVER_SLIPS
_NONE = (-1,) * 5  # FROT_BOUNDING rows
# The lists of a group and its packed arrays, in the order of frot_group; tables of the mechanics.
_LISTS = ("unknowns", "rows", "contacts", "elements", "given")
_PACKED = ("vector", "matrix", "metric", "entries", "square")
MECHANICAL_TABLES = (
    *(
        "contacts",
        "elements",
        "groups",
        "islands",
        "parts",
        "speed_parts",
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
    places = {v.name: k for k, v in enumerate(lowered.variables)}
    lists, groups = _groups(lowered.grouping)
    turns = lowered.reduced.symbols.turns
    turned = [_record(t.coordinate, _record(*t.speeds), int(t.own_axes)) for t in turns]
    return [
        _array("frot_contact", "contacts", list(_contacts(lowered, places))),
        _array("frot_element", "elements", list(_elements(lowered, places))),
        *lists,
        _array("frot_turn", "turns", turned),
        _array("frot_group", "groups", groups),
        *(_array("int", name, [str(i) for i in x]) for name, x in _whereabouts(lowered).items()),
    ]


def _contacts(lowered: Lowered, places: Mapping[str, int]) -> Iterator[str]:
    """Contacts of the mechanism, then the items of the text in which something rubs."""
    reduced = lowered.reduced
    sliding = {
        e.contact: k
        for k, e in reversed(tuple(enumerate(lowered.grouping.elements)))
        if not (e.rolling or e.part)
    }

    def one(name: str, span: Span | None, power: int, *fields: int) -> str:
        row, kept, slides, mode, kinematic, *rest = fields
        told = power, places[f"{name}.mode"] if mode else -1
        what = row, kept, slides, *told, kinematic, *rest
        return _record(_text(name), _text(_place(span)), *what)

    links = reduced.mechanism.contacts
    blocks = {x: k for k, x in enumerate(reduced.variables.kinematics.tracks)}
    for k, (link, rows) in enumerate(zip(links, reduced.contact_rows, strict=True)):
        never = link.rolls and not link.reduced
        slides = _NEVER_SLIPS if never else sliding.get(k, -1)
        row = rows.reaction[0] if link.has_normal else -1
        follows = blocks.get(link.liaison, -1)
        modes = row, int(link.reduced), slides, int(link.first)
        told: tuple[int, ...] = (*modes, int(link.kinematic), follows, int(link.turns))
        told = *told, restitution_of(link.liaison)[1]
        power = places.get(f"{link.liaison.name}.power", -1)
        yield one(link.liaison.name, link.liaison.span, power, *told)
    for k, element in enumerate(lowered.system.elements, len(links)):
        told = (-1, 1, sliding.get(k, -1), 1, 0, -1, 0, 0)
        yield one(element.name, element.span, -1, *told)


def _elements(lowered: Lowered, places: Mapping[str, int]) -> Iterator[str]:
    links = lowered.reduced.mechanism.contacts
    slips = slip_names(lowered.reduced.text)
    motions = [
        *((f"{x.liaison.name}.slip", f"{x.liaison.name}.speed") for x in links),
        *((slips.get(x.name, ""), "") for x in lowered.system.elements),
    ]

    def shown(e: Element) -> tuple[str, str]:
        slip = motions[e.contact][0]
        if e.parts == 1:
            return motions[e.contact]
        return (f"{slip}.x", f"{slip}.y") if e.part == 0 else (f"{slip}.z", "")

    for e in lowered.grouping.elements:
        motion = e.contact, e.bound.value, e.row
        bounding = _record(*(*e.bounded_by, *_NONE)[: len(_NONE)])
        norms = _record(*(*e.norms, 0, 0, 0)[:3])
        kept = int(e.rolling), int(e.fixed), int(e.row in lowered.grouping.prescribed)
        outputs = _record(*(-1 if e.rolling else places.get(x, -1) for x in shown(e)))
        fields = (*motion, bounding, norms, *kept, outputs, e.part, e.parts, e.joint.value)
        yield _record(*fields)


def _groups(grouping: Grouping) -> tuple[list[str], list[str]]:
    """The lists of what each group has, and the records that point at them."""
    arrays: list[str] = []
    records: list[str] = []
    at = [0] * len(_PACKED)
    for k, g in enumerate(grouping.groups):
        lists = (g.unknowns, g.rows, g.contacts, g.elements, g.entries)
        names = [f"group_{k}_{name}" for name in _LISTS]
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
    return arrays, records


def _whereabouts(lowered: Lowered) -> dict[str, Sequence[int]]:
    """Where rows, contacts and speeds stand in their groups."""
    grouping, system, groups = lowered.grouping, lowered.system, lowered.grouping.groups
    beside = {
        e.row: e.bounded_by[0]
        for e in grouping.elements
        if e.bound is Bound.NORMAL and not e.rolling
    }
    motions = [m for h in lowered.reduced.mechanism.coordinates for m in h.motions]
    whether = [m.turns for m in motions for _ in range(m.speed_count)]
    own = zip(_symbols(lowered.reduced.symbols.v), whether, strict=True)
    turning = {speed for speed, turns in own if turns}
    return {
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


def _symbols(values: ca.SX) -> list[int]:
    return [x.element_hash() for x in ca.vertsplit(values)] if values.numel() else []


def _places(values: dict[int, int]) -> list[int]:
    return [values[k] for k in range(len(values))]


def _group_sizes(g: Group) -> tuple[int, ...]:
    """Items of a group in the arrays of `_PACKED`."""
    n, rows = len(g.unknowns), len(g.rows)
    if g.tree is not None:
        return n, int(g.tree.data.numel()), g.tree.factor, rows * n, rows**2
    matrix = n * n if g.general else n * g.n_speeds + n - g.n_speeds
    return n, matrix, g.n_speeds**2, rows * n, rows**2


def packed_sizes(lowered: Lowered) -> dict[str, int]:
    """Items of the packed arrays of all groups together."""
    sizes = [_group_sizes(g) for g in lowered.grouping.groups]
    return {
        f"n_{name}": sum(s[k] for s in sizes) for k, name in enumerate(_PACKED) if name != "vector"
    }
