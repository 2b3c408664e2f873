"""What presentations and files need of a run: its values at any time, its events, its units."""

from __future__ import annotations

from abc import abstractmethod
from array import array
from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from frot.runtime.engine import Engine
    from frot.runtime.number_arrays import Floats
    from frot.runtime.program import Program
    from frot.runtime.run_report import Event, Figures

    from frot.compiled_model import CompiledModel


def nearest(name: str, names: Sequence[str]) -> str:
    """The remedy for a name that is not known: the nearest that is, if one is near."""
    from difflib import get_close_matches

    near = get_close_matches(name, names, 1)
    return f"did you mean '{near[0]}'?" if near else ""


def listed_name(name: str) -> str:
    """The name under which a run lists a variable: `b.orientation[1]` of `b.orientation.w`."""
    owner, _, item = name.rpartition(".")
    if not owner.endswith(".orientation") or item not in _QUATERNION:
        return name
    return f"{owner}[{_QUATERNION.index(item) + 1}]"


_QUATERNION = ("w", "x", "y", "z")


class Values(Mapping[str, "Floats"]):
    """Values of all variables at given times, by name."""

    def __init__(self, program: Program, values: Floats) -> None:
        """`values`: times x variables, or variables for a single time."""
        self._columns = {v.name: k for k, v in enumerate(program.variables)}
        self._values = values

    def __getitem__(self, name: str) -> Floats:
        """Values of the variable: an array, or a number for a single time."""
        column = self._columns.get(listed_name(name))
        if column is None:
            hint = nearest(name, list(self._columns))
            raise KeyError(f"no variable '{name}'{'; ' if hint else ''}{hint}")
        return self._values[..., column]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)


class RunValues(Mapping[str, "Floats"]):
    """A run as its readers see it; `Result` is one.

    `model` is what was run with which `options`, `fault` what ended the run, if it did; `moving`
    are the inputs that were polynomials of time.
    """

    model: CompiledModel | None = None
    fault = ""
    moving: frozenset[str] = frozenset()
    options: Mapping[str, Any] = MappingProxyType({})
    program: Program
    events: tuple[Event, ...]
    figures: Figures
    parameters: dict[str, float]

    @property
    @abstractmethod
    def engine(self) -> Engine:
        """The instance of the kernel as the run left it."""

    @property
    @abstractmethod
    def grid(self) -> array[float]:
        """The output times."""

    @property
    @abstractmethod
    def record(self) -> array[float]:
        """The recorded steps, one after the other."""

    @property
    @abstractmethod
    def time(self) -> Floats:
        """The output grid, in s."""

    @abstractmethod
    def at(self, t: float | Floats) -> Values:
        """Values at time t, or at each of an array of times."""

    @abstractmethod
    def take(self, names: Sequence[str], times: Floats) -> dict[str, Floats]:
        """Values of variables at times of the run."""

    @abstractmethod
    def unit(self, name: str) -> str:
        """The SI unit of a variable, `1` for a number."""

    @abstractmethod
    def numbers(self, names: Sequence[str]) -> list[str]:
        """The variables, each vector as its components."""

    @abstractmethod
    def summary(self, *, events: bool = True) -> str:
        """Events, steps, evaluations, wall time and energy balance, in a few lines."""
