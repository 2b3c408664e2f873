"""The variables of an FMU by value reference, as both versions of FMI describe them.

Value references count time (0), the parameters, the inputs and the variables of a program in their
order; instance.h relies on it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from frot.runtime.fmi.names import variable_names
from frot.runtime.program import ParameterInfo, Program, Unit, VariableInfo

MODE_TYPE = "FrotMode"
MODES = (
    ("open", 0, "the liaison is open"),
    ("stick", 1, "closed, without slip"),
    ("slip", 2, "closed, slipping"),
)


@dataclass(frozen=True, slots=True)
class Declared:
    """A type of enumerations: items by name, value and meaning."""

    name: str
    items: tuple[tuple[str, int, str], ...]
    doc: str = ""


MODE = Declared(MODE_TYPE, MODES, "mode of a liaison")


@dataclass(frozen=True, slots=True)
class Scalar:
    """One entry of ModelVariables; `start` is None where a value is calculated.

    `declared` names the type of an enumeration. `knowns` are the variables that an output, a rate,
    or what is calculated at the start, depends on at once: any may where it is None.
    """

    name: str
    reference: int
    type: str
    causality: str
    variability: str
    initial: str
    start: float | None
    unit: Unit | None
    doc: str
    min: float | None = None
    max: float | None = None
    declared: Declared | None = None
    knowns: tuple[str, ...] | None = None
    plain: str = ""  # the name in the text
    motion: str = ""  # of model exchange: state, rate, guard
    rate_of: int = -1  # reference of the state
    nominal: float | None = None


def _declared(info: ParameterInfo | VariableInfo) -> Declared | None:
    if info.type == "mode":
        return MODE
    if not info.literals:
        return None
    return Declared(info.enumeration, tuple((x, k, "") for k, x in enumerate(info.literals, 1)))


def _type(info: ParameterInfo | VariableInfo) -> str:
    return "enumeration" if _declared(info) else info.type


def _from_parameter(name: str, reference: int, info: ParameterInfo, causality: str) -> Scalar:
    unit = info.unit if info.type == "real" else None
    if causality == "input":
        variability = "continuous" if info.type == "real" else "discrete"
        return Scalar(
            name,
            reference,
            _type(info),
            "input",
            variability=variability,
            initial="",
            start=info.default,
            unit=unit,
            doc=info.doc,
            min=info.min,
            max=info.max,
            declared=_declared(info),
        )
    if info.dependent:
        causality = "calculatedParameter"
    initial, start = ("calculated", None) if info.dependent else ("exact", info.default)
    return Scalar(
        name,
        reference,
        _type(info),
        causality,
        variability="fixed" if info.started else "tunable",
        initial=initial,
        start=start,
        unit=unit,
        doc=info.doc,
        min=info.min,
        max=info.max,
        declared=_declared(info),
        knowns=info.needed or None,
    )


def _state(number: int) -> str:
    return f"exchange.state[{number + 1}]"


def _from_variable(name: str, reference: int, info: VariableInfo, exchanges: bool) -> Scalar:
    real = info.type == "real"
    states = map(_state, info.acting_states if exchanges else ())
    return Scalar(
        name,
        reference,
        _type(info),
        info.causality,
        variability="continuous" if real else "discrete",
        initial="calculated",
        start=None,
        unit=info.unit if real else None,
        doc=info.doc,
        min=info.min,
        max=info.max,
        declared=_declared(info),
        knowns=None if info.acting is None else (*info.acting, *states),
        nominal=info.nominal,
    )


def _motion(program: Program) -> Iterator[tuple[str, str, int, str]]:
    """Name, kind, number of the state and meaning of what model exchange adds, in order."""
    states = (*program.states, "dissipated energy", "work of forces without potential")
    for k, name in enumerate(states):
        yield _state(k), "state", k, name
    for k, name in enumerate(states):
        yield f"der({_state(k)})", "rate", k, f"rate of {name}"
    for k in range(program.guards):
        yield f"exchange.guard[{k + 1}]", "guard", -1, "positive while the mode lasts"


def _knowns_of_rate(program: Program, state: int) -> tuple[str, ...] | None:
    """The energies come last, and depend on all."""
    of = program.rates[state] if state < len(program.rates) else None
    return None if of is None else (*of.acting, *map(_state, of.states))


def _of_motion(name: str, reference: int, kind: str, doc: str, state: int) -> Scalar:
    return Scalar(
        name,
        reference,
        "real",
        "local",
        variability="continuous",
        initial="calculated",
        start=None,
        unit=None,
        doc=doc,
        motion=kind,
        rate_of=state if kind == "rate" else -1,
    )


def scalars(program: Program) -> tuple[str, tuple[Scalar, ...]]:
    """The naming convention and all variables of an FMU of `program`, by value reference."""
    infos: tuple[ParameterInfo | VariableInfo, ...] = (
        *program.parameters,
        *program.inputs,
        *program.variables,
    )
    motion = tuple(_motion(program)) if program.exchanges else ()
    plain = ("time", *(info.name for info in infos), *(name for name, *_ in motion))
    convention, names = variable_names(plain)
    second = Unit("s", (0, 0, 1, 0, 0, 0, 0, 0))
    found = [
        Scalar(
            "time",
            0,
            "real",
            "independent",
            variability="continuous",
            initial="",
            start=None,
            unit=second,
            doc="time",
            plain="time",
        )
    ]
    for info, name in zip(infos, names[1 : 1 + len(infos)], strict=True):
        reference = len(found)
        if isinstance(info, VariableInfo):
            one = _from_variable(name, reference, info, program.exchanges)
        else:
            causality = "parameter" if reference <= len(program.parameters) else "input"
            one = _from_parameter(name, reference, info, causality)
        found.append(replace(one, plain=info.name))
    first = len(found)
    nominals = {info.name: info.nominal for info in program.variables}
    for name, (_, kind, place, doc) in zip(names[first:], motion, strict=True):
        one = _of_motion(name, len(found), kind, doc, first + place)
        if kind == "state":
            one = replace(one, nominal=nominals.get(doc))
        knowns = _knowns_of_rate(program, place) if kind == "rate" else None
        found.append(replace(one, knowns=knowns, plain=plain[len(found)]))
    return convention, tuple(found)
