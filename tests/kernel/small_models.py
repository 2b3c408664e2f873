"""Models made of CasADi expressions alone: the kernel's tables, filled without the compiler."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import casadi as ca
from c_objects import c_objects
from frot.compiler.product.generate import write_c
from frot.compiler.product.split import split_functions
from frot.compiler.toolchain.compiler_choice import KERNEL_FLAGS, find_toolchain, model_flags
from frot.compiler.toolchain.compilers import link_library
from frot.compiler.toolchain.objects import kernel_folder, kernel_sources
from frot.runtime.program import ExperimentInfo, ParameterInfo, Program, Unit, VariableInfo

NONE = ca.SX(0, 1)


def column(*values: object) -> ca.SX:
    """Values below one another."""
    return ca.vertcat(*values) if values else NONE


@dataclass(frozen=True)
class Element:
    """A friction element; its rows. What bounds it is read off auxiliary unknowns."""

    bound: str
    normal: int = -1
    second: int = -1
    tangent: int = -1
    reduced: bool = True


@dataclass(frozen=True)
class Block:
    """Unknowns y[first .. first + count) of the equations `residual` (symbols -> expressions)."""

    first: int
    residual: Callable[[Symbols], Sequence[object]]
    count: int = 1
    linear: bool = False
    late: bool = False
    name: str = "y"


@dataclass(frozen=True)
class Symbols:
    """The arguments of the functions."""

    t: ca.SX
    q: ca.SX
    v: ca.SX
    u: ca.SX
    p: ca.SX
    conditions: ca.SX
    sides: ca.SX
    discrete: ca.SX
    y: ca.SX
    z: ca.SX
    lam: ca.SX
    energy: ca.SX
    fired: ca.SX

    @property
    def d(self) -> ca.SX:
        return ca.vertcat(self.conditions, self.sides, self.discrete)

    @property
    def state(self) -> list[ca.SX]:
        return [self.t, self.q, self.v, self.u, self.p, self.d, self.y]


Of = Callable[[Symbols], object]


@dataclass(frozen=True, kw_only=True)
class Small:
    """A model. Expressions are functions of the symbols; what is not given is empty or zero.

    `variables` by name; `mass` and `force` are A and h of the core; `rates` are q' of the states,
    the speeds themselves if not given; `start` is q, v, y, discrete as numbers; `position` and
    `velocity` are residuals of initial statements; `metric` and `effect` make the core general.
    """

    name: str
    nq: int
    nv: int = 0
    na: int = 0
    nc: int = 0
    parameters: Mapping[str, float] = field(default_factory=dict)
    inputs: Mapping[str, float] = field(default_factory=dict)
    start: tuple[Sequence[float], ...] = ()
    rates: Of | None = None
    late_rates: Of | None = None
    mass: Of | None = None
    force: Of | None = None
    effect: Of | None = None
    metric: Of | None = None
    elements: Sequence[Element] = ()
    rows: Of | None = None
    bias: Of | None = None
    row_rates: Of | None = None
    gaps: Of | None = None
    coefficients: Of | None = None
    unilateral: Sequence[float] = ()
    power: Of | None = None
    conditions: Of | None = None
    strict: Sequence[bool] = ()
    blocks: Sequence[Block] = ()
    invariants: Of | None = None
    position: Of | None = None
    velocity: Of | None = None
    energy: Of | None = None
    n_discrete: int = 0
    whens: Sequence[tuple[int, bool]] = ()
    outcomes: Sequence[tuple[str, str]] = ()
    update: Callable[[Symbols], tuple[object, object, object, object]] | None = None
    variables: Mapping[str, Of] = field(default_factory=dict)
    q_speed: Sequence[int] | None = None
    time_dependent: bool = False
    stop: float = 1.0

    @property
    def general(self) -> bool:
        return self.metric is not None

    @property
    def n_rows(self) -> int:
        return sum((e.normal >= 0) + (e.second >= 0) + (e.tangent >= 0) for e in self.elements)

    @property
    def n_conditions(self) -> int:
        return len(self.strict)

    @property
    def ny(self) -> int:
        return sum(b.count for b in self.blocks)

    @property
    def speeds(self) -> list[int]:
        return list(self.q_speed) if self.q_speed is not None else list(range(self.nq))


def symbols(m: Small) -> Symbols:
    """Symbols of the sizes of the model."""
    s = ca.SX.sym
    nw = m.nv + m.na + m.nc
    return Symbols(
        s("t"), s("q", m.nq), s("v", m.nv), s("u", len(m.inputs)), s("p", len(m.parameters)),
        s("c", m.n_conditions), s("s", len(m.elements)), s("d", m.n_discrete), s("y", m.ny),
        s("z", nw), s("lam", m.n_rows), s("e", 2), s("f", len(m.whens)),
    )  # fmt: skip


def _size(residual: ca.SX, *of: ca.SX) -> ca.SX:
    """Size of the terms of each residual: of its linear part, and of itself."""
    x = ca.vertcat(*of)
    return ca.fabs(residual) + ca.fabs(ca.jacobian(residual, x)) @ ca.fabs(x) + 1e-30


def _packed(matrix: ca.SX, m: Small) -> ca.SX:
    """Of a mass matrix the columns of speeds and the diagonal of the rest."""
    if m.general:
        return matrix
    rest = (matrix[k, k] for k in range(m.nv, matrix.shape[0]))
    return ca.vertcat(ca.vec(matrix[:, : m.nv]), *rest)


def _matrix_size(m: Small) -> int:
    nw = m.nv + m.na + m.nc
    return nw * nw if m.general else nw * m.nv + nw - m.nv


def functions(m: Small, s: Symbols) -> dict[str, ca.Function]:
    """The generated functions by the names of the contract."""

    def of(what: Of | None, *shape: int) -> ca.SX:
        return ca.SX(what(s)) if what is not None else ca.SX.zeros(*shape)

    nw, nr, ne = m.nv + m.na + m.nc, m.n_rows, len(m.elements)
    rows, conditions = of(m.rows, nr, nw), of(m.conditions, m.n_conditions)
    row_rates = of(m.row_rates, nr) if m.row_rates else rows[:, : m.nv] @ s.v
    gaps, start = of(m.gaps, ne), [*m.start, [], [], [], []][:4]
    numbers = [ca.DM(list(x)) if not isinstance(x, ca.SX) else x for x in start]
    rates = of(m.rates) if m.rates else s.v
    invariants, position, velocity = of(m.invariants, 0), of(m.position, 0), of(m.velocity, 0)
    states = ca.vertcat(s.q, s.v)
    own_y = s.y[: _early(m)]
    out: dict[str, tuple[list[ca.SX], list[object]]] = {
        "parameters": (
            [s.p, ca.SX.sym("set", s.p.numel()), s.u],
            [s.p, NONE, ca.DM(list(m.unilateral)), ca.DM([0.0, m.stop, 1e-10, float("nan")])],
        ),
        "start": ([s.t, s.u, s.p], [numbers[0], numbers[3]]),
        "beginning": (s.state, [*numbers[1:3], conditions]),
        "place_stating": (
            s.state,
            [
                position,
                ca.jacobian(position, s.q).T,
                _size(position, s.q),
                ca.jacobian(position, own_y).T,
            ],
        ),
        "speed_stating": (
            s.state,
            [
                velocity,
                ca.jacobian(velocity, s.v).T,
                _size(velocity, s.v),
                ca.jacobian(velocity, own_y).T,
            ],
        ),
        "kinematics": (s.state, [gaps, rows.T, row_rates, conditions]),
        "sides": (s.state, [ca.vec(ca.repmat(gaps.T, 3, 1)), 0 * gaps]),
        "dynamics": (
            s.state,
            [
                rates,
                _packed(of(m.mass, nw, nw), m),
                of(m.force, nw),
                rows.T,
                of(m.bias, nr),
                row_rates,
                gaps,
                conditions,
                of(m.coefficients, 2 * ne),
                of(m.power, 1),
            ],
        ),
        "sizes": (s.state, [ca.fabs(of(m.force, nw)), NONE]),
        "energy": (s.state, ca.vertsplit(of(m.energy, 2))),
        "variables": (
            [*s.state, s.z, s.lam, s.energy],
            [ca.vertcat(ca.SX.zeros(ne), *(f(s) for f in m.variables.values()))],
        ),
    }
    if m.general:
        nm = m.nv + m.na
        effect = of(m.effect) if m.effect else ca.vertcat(rows[:, :nm].T, ca.SX.zeros(m.nc, nr))
        speeds = of(m.metric)[: m.nv, : m.nv]
        out["spread"] = (s.state, [effect, speeds])
    if m.late_rates:
        out["rates"] = ([*s.state, s.z, s.lam], [of(m.late_rates), of(m.power, 1)])
    if m.invariants:
        size = _size(invariants, s.q, s.v)
        out["invariants"] = (s.state, [invariants, ca.jacobian(invariants, states).T, size])
    early = [b for b in m.blocks if not b.late]
    if early:
        r = column(*(ca.vertcat(*b.residual(s)) for b in early))
        out["place_slopes"] = (s.state, [ca.jacobian(r, x).T for x in (s.q, own_y)])
        out["speed_slopes"] = (s.state, [ca.jacobian(r, x).T for x in (s.v, own_y)])
    if m.update:
        values = [ca.vertcat(x) if isinstance(x, list) else x for x in m.update(s)]
        # what an update reads of the discrete values is what they were before
        guessed = ca.vertcat(s.conditions, s.sides, ca.SX.sym("guess", m.n_discrete))
        arguments = [*s.state[:5], guessed, s.y, s.z, s.lam, s.fired, s.discrete]
        out["update"] = (arguments, [column(x) for x in values])
    for i, b in enumerate(m.blocks):
        r = ca.vertcat(*b.residual(s))
        own = s.y[b.first : b.first + b.count]
        more = [s.z, s.lam] if b.late else []
        size = _size(r, own)
        out[f"block_{i}"] = ([*s.state, *more], [r, ca.jacobian(r, own), size])
    return {
        name: ca.Function(f"small_{name}", args, [ca.densify(ca.SX(x)) for x in results])
        for name, (args, results) in out.items()
    }


def _table(kind: str, name: str, items: Sequence[object]) -> str:
    return f"static const {kind} {name}[] = {{{', '.join(map(str, items)) or '0'}}};"


def _call(f: ca.Function) -> str:
    return f"{{{f.name()}, {f.sz_arg()}, {f.sz_res()}, {f.sz_iw()}, {f.sz_w()}}}"


def source(m: Small) -> str:
    """The C file that defines `frot_the_model`."""
    made = functions(m, symbols(m))
    text = split_functions(write_c(list(made.values())))
    bound = {"normal": "FROT_BY_NORMAL", "pin": "FROT_BY_PIN", "value": "FROT_BY_VALUE"}
    nw = m.nv + m.na + m.nc
    laws = {i: k for k, i in enumerate(i for i, e in enumerate(m.elements) if e.tangent >= 0)}
    readings = [r for e in m.elements if e.reduced for r in (e.normal, e.second) if r >= 0]
    reads = [m.nv + readings.index(r) if r in readings else -1 for r in range(m.n_rows)]
    kinds = {"terminate": 0, "fail": 1, "warn": 2}
    n_position, n_velocity = (made[f"{x}_stating"].numel_out(0) for x in ("place", "speed"))
    tables = {
        ("double", "p_default"): list(m.parameters.values()),
        ("double", "u_default"): list(m.inputs.values()),
        ("frot_contact", "contacts"): [
            f'{{"element {i + 1}", "small:{i + 1}:1", '
            f"{e.normal if e.bound == 'normal' else -1}, {int(e.reduced)}, {laws.get(i, -1)}, "
            f"-1, {i}, 0, -1, 0}}"
            for i, e in enumerate(m.elements)
        ],
        ("frot_element", "elements"): [
            f"{{{i}, {bound[m.elements[i].bound]}, {m.elements[i].tangent}, "
            f"{{{m.elements[i].normal}, {m.elements[i].second}, -1, -1, -1}}, "
            f"{{{2 if m.elements[i].second >= 0 else 0}, 0, 0}}, 0, 0, {int(still)}, "
            "{-1, -1}, 0, 1}"
            for i, still in zip(laws, _prescribed(m, laws), strict=True)
        ],
        ("int", "all_unknowns"): range(nw),
        ("int", "all_rows"): range(m.n_rows),
        ("int", "all_contacts"): range(len(m.elements)),
        ("int", "all_elements"): range(len(laws)),
        ("int", "all_entries"): range(m.n_rows * nw),
        ("frot_group", "groups"): [
            f"{{{int(m.general)}, {nw}, {m.nv}, {m.na}, {m.n_rows}, {len(m.elements)}, "
            f"{len(laws)}, {m.n_rows * nw}, all_unknowns, all_rows, all_contacts, all_elements, "
            "all_entries, 0, 0, 0, 0, 0}"
        ],
        ("int", "row_reads"): reads,
        ("int", "row_beside"): [-1] * m.n_rows,
        ("int", "row_group"): [0] * m.n_rows,
        ("int", "row_local"): range(m.n_rows),
        ("int", "contact_group"): [0] * len(m.elements),
        ("int", "speed_group"): [0] * m.nv,
        ("int", "speed_local"): range(m.nv),
        ("int", "speed_coordinate"): [
            m.speeds.index(k) if k in m.speeds else -1 for k in range(m.nv)
        ],
        ("int", "speed_turns"): [0] * m.nv,
        ("frot_statement", "statements"): [
            f'{{"statement {i + 1}", "small:{i + 1}:1", "1"}}' for i in range(_statements(m))
        ],
        ("int", "all_whole"): range(max(m.nq, m.nv, len(m.inputs), len(m.parameters), m.ny, 99)),
        ("frot_part", "parts"): [_part(m, made, "place", n_position)],
        ("frot_part", "speed_parts"): [_part(m, made, "speed", n_velocity)],
        ("unsigned char", "position_direct"): [0] * n_position,
        ("unsigned char", "position_kind"): [0] * n_position,
        ("int", "position_statement"): range(n_position),
        ("int", "velocity_statement"): [n_position + i for i in range(n_velocity)],
        ("int", "p_dependent"): [0] * len(m.parameters),
        ("int", "p_type"): [0] * len(m.parameters),
        ("unsigned char", "row_depends"): _row_depends(m),
        ("frot_condition", "conditions"): [
            f'{{"condition {k + 1}", 2, "", -1}}' for k in range(m.n_conditions)
        ],
        ("unsigned char", "condition_strict"): [int(x) for x in m.strict],
        ("int", "q_speed"): m.speeds,
        ("int", "q_alike"): list(range(m.nq)),
        ("frot_block", "blocks"): [
            f"{{{_call(made[f'block_{i}'])}, {{0}}, {b.first}, {b.count}, {int(b.linear)}, "
            f'{int(b.late)}, 0, "{b.name}", "small:{i + 1}:1"}}'
            for i, b in enumerate(m.blocks)
        ],
        ("int", "when_condition"): [c for c, _ in m.whens],
        ("int", "when_rank"): [0] * len(m.whens),
        ("unsigned char", "when_at_start"): [int(x) for _, x in m.whens],
        ("frot_outcome", "outcomes"): [
            f'{{{kinds[k]}, "{text}", "small:{i + 1}:1"}}' for i, (k, text) in enumerate(m.outcomes)
        ],
    }
    sizes = {
        "nq": m.nq, "nv": m.nv, "na": m.na, "nc": m.nc, "nu": len(m.inputs),
        "np": len(m.parameters), "ny": m.ny, "n_rows": m.n_rows, "n_contacts": len(m.elements),
        "n_elements": len(laws), "n_groups": 1, "n_matrix": _matrix_size(m),
        "n_metric": m.nv * m.nv, "n_entries": m.n_rows * nw, "n_square": m.n_rows**2,
        "n_conditions": m.n_conditions, "n_located": m.n_conditions,
        "n_discrete": m.n_discrete, "n_blocks": len(m.blocks),
        "n_invariants": made["invariants"].numel_out(0) if m.invariants else 0,
        "n_whens": len(m.whens), "n_ranks": 1,
        "n_outcomes": len(m.outcomes), "general": int(m.general),
        "late_rates": int(m.late_rates is not None), "time_dependent": int(m.time_dependent),
        "n_position": n_position, "n_velocity": n_velocity, "n_statements": _statements(m),
        "n_parts": 1, "n_speed_parts": 1,
        "n_variables": len(m.elements) + len(m.variables),
    }  # fmt: skip
    of_parts = ("block_", "place_", "speed_", "sides")
    calls = {name: _call(f) for name, f in made.items() if not name.startswith(of_parts)}
    fields = {"name": f'"{m.name}"', "key": f'"small-{m.name}"', **sizes, **calls}
    fields |= {name: name for _, name in tables if not name.startswith("all_")}
    return (
        '#include "frot.h"\n#define CASADI_SYMBOL_EXPORT static\n'
        + text
        + "\n".join(_table(kind, name, list(items)) for (kind, name), items in tables.items())
        + "\nextern const frot_model frot_the_model;\nconst frot_model frot_the_model = {\n"
        + "".join(f"  .{name} = {value},\n" for name, value in fields.items())
        + "};\n"
    )


def _early(m: Small) -> int:
    """The number of unknowns of the blocks that are not late."""
    return sum(b.count for b in m.blocks if not b.late)


def _part(m: Small, made: Mapping[str, ca.Function], of: str, stated: int) -> str:
    """All places, or all speeds, of a model."""
    early = sum(not b.late for b in m.blocks)
    counts = {
        "unknowns": m.nq if of == "place" else m.nv, "turns": 0, "groups": 1, "islands": 0,
        "contacts": len(m.elements), "stated": stated, "guessed": 0, "blocks": early,
        "own": _early(m), "y": m.ny,
    }  # fmt: skip
    d = m.n_conditions + len(m.elements) + m.n_discrete
    reads = (m.nq, m.nv, len(m.inputs), len(m.parameters), d, *["all_whole"] * 5, 0)
    names = (f"{of}_stating", "none", "sides" if of == "place" else "none", f"{of}_slopes")
    calls = (_call(made[x]) if x in made else "{0}" for x in names)
    inside = f"{{{', '.join(map(str, reads))}}}"
    lists = ["all_whole"] * 9
    return f"{{{', '.join(map(str, (*counts.values(), *lists, inside, *calls)))}}}"


def _prescribed(m: Small, laws: dict[int, int]) -> list[bool]:
    """Whether the motion of each element depends on no unknown of the core."""
    rows = ca.SX(m.rows(symbols(m))) if m.rows else ca.SX.zeros(m.n_rows, 0)
    return [ca.sparsify(rows[m.elements[i].tangent, :]).nnz() == 0 for i in laws]


def _row_depends(m: Small) -> list[int]:
    """For each row: does it depend on each coordinate, and on anything else that can change?"""
    s = symbols(m)
    if m.rows is None:
        return []
    rows, rates = ca.SX(m.rows(s)), m.row_rates
    other = [s.t, s.u, s.discrete, s.y]
    table: list[int] = []
    for r in range(m.n_rows):
        what = ca.horzcat(rows[r, :], ca.SX(rates(s))[r]) if rates else rows[r, :]
        table += [int(ca.depends_on(rows[r, :], s.q[k])) for k in range(m.nq)]
        table.append(int(any(x.numel() and ca.depends_on(what, x) for x in other)))
    return table


def _statements(m: Small) -> int:
    s = symbols(m)
    return sum(ca.SX(f(s)).numel() for f in (m.position, m.velocity) if f is not None)


def build(m: Small, folder: Path) -> Program:
    """Compile the model together with the kernel."""
    folder.mkdir(parents=True, exist_ok=True)
    toolchain = find_toolchain()
    (folder / "model.c").write_text(source(m))
    objects = c_objects([folder / "model.c"], [kernel_folder()], model_flags())
    objects += c_objects(kernel_sources(kernel_folder()), [kernel_folder()], KERNEL_FLAGS)
    link_library(toolchain, objects, folder / "program.so")
    one = Unit("1")
    modes = [f"element {i + 1}" for i in range(len(m.elements))]
    return Program(
        name=m.name, doc="", key=f"small-{m.name}", version="0", planar=True,
        parameters=tuple(ParameterInfo(n, "real", one, x, "") for n, x in m.parameters.items()),
        inputs=tuple(ParameterInfo(n, "real", one, x, "") for n, x in m.inputs.items()),
        variables=(
            *(VariableInfo(f"{n}.mode", "mode", one, "local", "") for n in modes),
            *(VariableInfo(n, "real", one, "local", "") for n in m.variables),
        ),
        contacts=tuple(modes),
        experiment=ExperimentInfo(0.0, m.stop, 1e-10, None, "rest"),
        compiler=toolchain.command, flags=model_flags(), folder=folder,
        conditions=tuple(f"condition {k + 1}" for k in range(m.n_conditions)),
    )  # fmt: skip
