"""A compiled program: what the runtime knows of a model once the compiler is done with it."""

from __future__ import annotations

import json
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

MANIFEST = "manifest.json"
LIBRARY = "program.so"
MODEL_SOURCE = "model.c"
# Of a run whose text is silent about them; the kernel has the same tolerance.
DEFAULT_TOLERANCE = 1e-8
DEFAULT_POINTS = 500
DEFAULT_SPAN = 1.0


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit of values: name and exponents of m, kg, s, A, K, mol, cd, rad; all values are in SI.

    `display` is the author's unit (`mm`), of `display_factor` SI units; empty if it is the same.
    A number of it is `display_factor` times that and `display_offset` in SI (degC: 273.15).
    `quantity` is the type that the text names (`Length`).
    """

    name: str
    exponents: tuple[int, ...] = (0,) * 8
    display: str = ""
    display_factor: float = 1.0
    display_offset: float = 0.0
    quantity: str = ""


@dataclass(frozen=True, slots=True)
class ParameterInfo:
    """A parameter or an input. `type` is `real`, `integer` or `boolean`; `default` is in SI.

    So are `min` and `max`, at the default parameters.

    `dependent`: the value follows from other parameters unless it is set; `needed` are the
    independent ones among these. `literals` are those of the type `enumeration`, which count from
    1. `started`: it acts at the start of a run alone.
    """

    name: str
    type: str
    unit: Unit
    default: float
    doc: str
    dependent: bool = False
    min: float | None = None
    max: float | None = None
    literals: tuple[str, ...] = ()
    enumeration: str = ""
    needed: tuple[str, ...] = ()
    started: bool = False


@dataclass(frozen=True, slots=True)
class VariableInfo:
    """A variable a run gives. `type` is `real`, `integer`, `boolean` or `mode`.

    `causality` is `output` or `local`. `acting` are the inputs, and `time`, that act on an output
    at once, not by way of states: any may where it is None. `acting_states` are the numbers of the
    states that do. `nominal` is its usual size. `literals` are those of the type
    `enumeration`, which count from 1. `declared`: the text declares it, in the model or in a
    component; else it is one of a body, a liaison or an energy. `changes`: false for the mode of a
    liaison that has one mode only.
    """

    name: str
    type: str
    unit: Unit
    causality: str
    doc: str
    min: float | None = None
    max: float | None = None
    acting: tuple[str, ...] | None = None
    acting_states: tuple[int, ...] = ()
    nominal: float | None = None
    literals: tuple[str, ...] = ()
    enumeration: str = ""
    declared: bool = False
    changes: bool = True


@dataclass(frozen=True, slots=True)
class RateInfo:
    """What the rate of a state depends on: inputs and `time`, and the numbers of states."""

    acting: tuple[str, ...]
    states: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class ExperimentInfo:
    """Defaults of a run at the default parameters; None where the text is silent."""

    start: float | None
    stop: float | None
    tolerance: float | None
    interval: float | None
    on_indeterminate: str
    on_impasse: str = "impact"

    def times(self) -> tuple[float, float]:
        """Start and stop, in s."""
        begin = 0.0 if self.start is None else self.start
        return begin, begin + DEFAULT_SPAN if self.stop is None else self.stop


@dataclass(frozen=True, slots=True)
class IntegralInfo:
    """A first integral of the motion: the sum of `variables`.

    `always`: whatever the parameters are, else at their defaults.
    """

    text: str
    variables: tuple[str, ...]
    unit: Unit
    always: bool


@dataclass(frozen=True, slots=True)
class Program:
    """A compiled model in a folder: `model.c`, the shared library and this description.

    `parameters`, `inputs`, `variables` are in the order of the kernel's arrays; variables begin
    with the modes of `contacts`. `conditions` are those of the text, as written. `key` identifies
    the text, the compiler and its flags.
    `balanced`: all energies are known: there are bodies, and no friction in the equations.
    `fixed` are parameters that decide the structure, each with what it decides.
    `kernel` is the library of the kernel that the program's own needs, empty where it has its own.
    `file` is the name the text had when it was compiled, which places in the library begin with;
    `shown` is the one its user gives it now. `holders` are the liaisons that always hold, none
    where drives, time or the text move what they hold. `states` are the coordinates and speeds,
    `rates` what their rates depend on, None for one that depends on most of them. `guards` is the
    number of the functions that say when modes end, negative where that is not known.
    """

    name: str
    doc: str
    key: str
    version: str
    planar: bool
    parameters: tuple[ParameterInfo, ...]
    inputs: tuple[ParameterInfo, ...]
    variables: tuple[VariableInfo, ...]
    contacts: tuple[str, ...]
    experiment: ExperimentInfo
    compiler: tuple[str, ...]
    flags: tuple[str, ...]
    folder: Path
    balanced: bool = True
    conditions: tuple[str, ...] = ()
    fixed: tuple[tuple[str, str], ...] = ()
    file: str = ""
    first_integrals: tuple[IntegralInfo, ...] = ()
    shown: str = ""
    holders: tuple[str, ...] = ()
    states: tuple[str, ...] = ()
    rates: tuple[RateInfo | None, ...] = ()
    guards: int = -1
    kernel: str = ""

    @property
    def exchanges(self) -> bool:
        """Whether another integrator can step the motion."""
        return self.guards >= 0

    @property
    def library(self) -> Path:
        """The shared library of the model; it has the kernel or needs the one of `kernel`."""
        return self.folder / LIBRARY

    @property
    def source(self) -> Path:
        """The generated C of the model; exports `const frot_model frot_the_model`."""
        return self.folder / MODEL_SOURCE

    def without_lock(self) -> Program:
        """The program alone, for another process."""
        return self

    def place(self, compiled: str) -> str:
        """A place of the library, `file:line:column`, in the words of the user."""
        head = f"{self.file}:"
        return f"{self.shown}:{compiled[len(head) :]}" if compiled.startswith(head) else compiled

    def to_json(self) -> str:
        """The manifest: valid wherever the program lies and whatever its file is called."""
        data = _fields(self)
        for name in ("folder", "shown"):
            del data[name]
        # Large texts have ten thousand variables: what indents, or copies first, takes seconds.
        return json.dumps(data, default=_fields, ensure_ascii=False)


@dataclass(frozen=True, slots=True)
class LoadedProgram(Program):
    """A program with the lock that keeps its folder while this object lives."""

    hold: object = field(default=None, compare=False, repr=False)

    def without_lock(self) -> Program:
        """The program alone, for another process."""
        return Program(**{one.name: getattr(self, one.name) for one in fields(Program)})


def load_program(program: Program, hold: object) -> LoadedProgram:
    """The program with the lock of its folder."""
    return LoadedProgram(**_fields(program), hold=hold)


def _fields(of: Any) -> dict[str, Any]:
    return {one.name: getattr(of, one.name) for one in fields(of)}


def read_program(folder: Path) -> Program:
    """Read the manifest in `folder`; OSError or ValueError if it is not there or not one."""
    data: dict[str, Any] = json.loads((folder / MANIFEST).read_text(encoding="utf-8"))
    return Program(
        **{
            **data,
            "parameters": tuple(_parameter(entry) for entry in data["parameters"]),
            "inputs": tuple(_parameter(entry) for entry in data["inputs"]),
            "variables": tuple(VariableInfo(**_entry(entry)) for entry in data["variables"]),
            "contacts": tuple(data["contacts"]),
            "conditions": tuple(data.get("conditions", ())),
            "experiment": ExperimentInfo(**data["experiment"]),
            "compiler": tuple(data["compiler"]),
            "flags": tuple(data["flags"]),
            "first_integrals": tuple(
                IntegralInfo(
                    **{
                        **entry,
                        "unit": _unit(entry["unit"]),
                        "variables": tuple(entry["variables"]),
                    }
                )
                for entry in data.get("first_integrals", ())
            ),
            "states": tuple(data.get("states", ())),
            "rates": tuple(
                one and RateInfo(tuple(one["acting"]), tuple(one["states"]))
                for one in data.get("rates", ())
            ),
            "fixed": tuple((name, why) for name, why in data.get("fixed", ())),
            "folder": folder,
        }
    )


def _unit(entry: dict[str, Any]) -> Unit:
    return Unit(**{**entry, "exponents": tuple(entry["exponents"])})


def _parameter(entry: dict[str, Any]) -> ParameterInfo:
    return ParameterInfo(**_entry(entry))


def _entry(entry: dict[str, Any]) -> dict[str, Any]:
    """Lists, of names, are tuples."""
    whole = {key: tuple(x) if isinstance(x, list) else x for key, x in entry.items()}
    return {**whole, "unit": _unit(entry["unit"])}
