"""Every admissible motion of a state: which contacts part, which slips begin, and how."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from frot.dsl.messages.errors import fail
from frot.runtime.engine import OK, Engine
from frot.runtime.library import MotionsFound, RawMotion
from frot.runtime.listed_motions import KINDS, LawMode, Motion, Motions, Part
from frot.runtime.program import Program
from frot.runtime.run import begin, fault_of
from frot.runtime.run_report import KINDS as EVENTS
from frot.runtime.run_report import STRIKES
from frot.runtime.settings import read_option

# Statuses of a start or a run at whose state motions are listed: none, several, jammed.
IMPASSE, SEVERAL, CHATTER, DIVERGE, TOO_LARGE = 14, 15, 16, 18, 20
STOPS = (IMPASSE, SEVERAL, CHATTER, DIVERGE, TOO_LARGE)
# Nodes of the search of one part.
NODES = 20_000
_STICK, _FORWARD = 1, 2
_OF_SPRINGS = 2  # frot_motion.family
# Times of one instant differ by less, relative.
_ONE_INSTANT = 1e-12
_FORCES = ("N", "N.m")


def list_motions(
    program: Program,
    at: float | str | None = None,
    parameters: Mapping[str, object] | None = None,
    inputs: Mapping[str, object] | None = None,
    nodes: int = NODES,
) -> Motions:
    """The motions of the start, or of the state of a run at the time `at`.

    `program` is one that knows the derivatives along the motion (`orders` of `build`). `nodes`
    bounds the search of each part.

    Raises:
        FrotError: As `simulate`; also where the run ends before `at`.
    """
    time = read_option("at", at, "s")

    def started(chosen: Program) -> Engine:
        return begin(chosen, parameters=parameters, inputs=inputs, tolerated=STOPS)

    if time is not None:
        engine = started(program)
        if time != engine.time:
            before = _impacts(engine, time)
            return replace(_list(program, engine, nodes), before=tuple(before))
    smooth = _chosen(program, "stop", "rest")
    engine = started(smooth)
    found = _list(smooth, engine, nodes)
    before = _impacts(engine, engine.time)
    engine = started(_chosen(program, "impact", "impact"))
    beside = [x for x in _impacts(engine, engine.time) if x not in before]
    return replace(found, before=tuple(before), beside=tuple(beside))


def _chosen(program: Program, on_impasse: str, on_indeterminate: str) -> Program:
    """The program with other choices of what follows an impasse, or several motions."""
    experiment = replace(
        program.experiment, on_impasse=on_impasse, on_indeterminate=on_indeterminate
    )
    return replace(program, experiment=experiment)


def _list(program: Program, engine: Engine, nodes: int) -> Motions:
    """The motions of the state that an instance has reached."""
    status, found, memory = engine.motions(nodes)
    if status != OK:
        raise fault_of(engine, None)
    told = _read(program, engine, found)
    del memory
    return told


def _impacts(engine: Engine, time: float) -> list[str]:
    """Run to the time; the impacts and percussions at that instant, in words.

    Raises:
        FrotError: Where the run ends before.
    """
    if time < engine.time:
        raise fail(
            "E0806",
            f"there is no state at {time:g} s: the run begins at {engine.time:g} s",
            help="choose a later time",
        )
    near = _ONE_INSTANT * max(abs(time), 1e-300)
    if engine.fault.status in STOPS:
        if time - engine.fault.t > near:
            raise fault_of(engine, None)
        return []
    run = engine.advance(time)
    if run.status != OK and not (run.status in STOPS and time - engine.fault.t <= near):
        raise fault_of(engine, None)
    return [
        engine.event_text(event)
        for event in run.events
        if EVENTS[event.kind] in STRIKES and time - event.t <= near
    ]


def _read(program: Program, engine: Engine, found: MotionsFound) -> Motions:
    laws = engine.laws()
    parts = []
    n = len(program.contacts)
    part_of = [found.part_of_contact[i] for i in range(n)]
    for part in range(found.n_parts):
        liaisons = [program.contacts[i] for i in range(n) if part_of[i] == part]
        raw = [found.motions[k] for k in range(found.count) if found.motions[k].part == part]
        if not liaisons or (found.n_parts > 1 and not _has_choice(found, part_of, part)):
            continue
        place = {k: j for j, k in enumerate(_indices(found, part))}
        first = [one for one in raw if one.same < 0]
        motions = []
        for one in first:
            at = raw.index(one)
            same = [x for x in raw if x.same >= 0 and place[x.same] == at]
            motions.append(_motion(program, laws, one, same))
        parts.append(Part(tuple(dict.fromkeys(liaisons)), tuple(motions)))
    if not parts:
        raw = [found.motions[k] for k in range(found.count)][:1]
        only = tuple(_motion(program, laws, one, []) for one in raw)
        parts.append(Part(tuple(program.contacts), only))
    return Motions(
        model=program.name,
        time=engine.time,
        parts=tuple(parts),
        complete=bool(found.complete),
        proved=bool(found.proved),
        highest=found.highest,
        nodes=found.nodes,
    )


def _indices(found: MotionsFound, part: int) -> list[int]:
    return [k for k in range(found.count) if found.motions[k].part == part]


def _has_choice(found: MotionsFound, part_of: Sequence[int], part: int) -> bool:
    return any(found.contacts[i] and part_of[i] == part for i in range(len(part_of)))


def _motion(
    program: Program,
    laws: Sequence[tuple[str, int, int, int]],
    raw: RawMotion,
    same: Sequence[RawMotion],
) -> Motion:
    values = _values(program, raw)
    told = tuple(_laws(laws, raw, len(program.contacts), values))
    modes: dict[str, str] = {}
    for i, name in enumerate(program.contacts):
        if raw.contact[i] < 0:
            continue
        own = [law for law in told if law.liaison == name]
        slides = [law for law in own if law.kind in ("slide", "turn", "slip")] or own
        closed = "closed" if not slides else "slip" if any(x.moving for x in slides) else "stick"
        modes[name] = "open" if raw.contact[i] == 0 else closed
    units = {v.name: v.unit.name for v in program.variables if not v.declared}
    return Motion(
        modes=modes,
        laws=told,
        values=values,
        others=tuple(_values(program, one) for one in same),
        decided=bool(raw.decided),
        family=bool(raw.family),
        springs=raw.family == _OF_SPRINGS,
        hardly=bool(raw.hardly),
        accelerations={n: values[n] for n in units if "acceleration" in n},
        reactions={n: values[n] for n, unit in units.items() if unit in _FORCES},
    )


def _values(program: Program, raw: RawMotion) -> dict[str, float]:
    return {v.name: raw.values[k] + 0.0 for k, v in enumerate(program.variables)}


def _laws(
    laws: Sequence[tuple[str, int, int, int]],
    raw: RawMotion,
    contacts: int,
    values: Mapping[str, float],
) -> Iterator[LawMode]:
    for e, (liaison, kind, part, parts) in enumerate(laws):
        if part or raw.element[e] < _STICK:
            continue
        moving = raw.element[e] >= _FORWARD
        own = range(e, e + parts)
        direction = tuple(raw.direction[k] for k in own) if moving else ()
        acceleration = tuple(raw.acceleration[k] for k in own)
        if moving and parts > 1:
            along = sum(a * d for a, d in zip(acceleration, direction, strict=True))
            direction = _against_friction(values, liaison, KINDS[kind])
        else:
            along = acceleration[0] if parts == 1 else math.hypot(*acceleration)
        painleve = raw.painleve[e]
        yield LawMode(
            liaison=liaison,
            kind=KINDS[kind],
            moving=moving,
            direction=direction,
            acceleration=along,
            since=int(raw.since[contacts + e]),
            painleve=None if math.isnan(painleve) else painleve,
        )


def _against_friction(values: Mapping[str, float], liaison: str, kind: str) -> tuple[float, ...]:
    """The unit vector of a slip in space, against its friction; () where that is zero or mixed."""
    names = [f"{liaison}.tangential_force.{axis}" for axis in "xyz"]
    if kind != "slide" or not all(name in values for name in names):
        return ()
    force = [values[name] for name in names]
    size = math.hypot(*force)
    return tuple(-x / size + 0.0 for x in force) if size > 0 else ()
