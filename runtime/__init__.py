"""The runtime room: a compiled program to motion, results and FMUs."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from frot.runtime.plotting import plot
    from frot.runtime.program import Program
    from frot.runtime.result import Result
    from frot.runtime.run import Interrupted, SimulationError, simulate
    from frot.runtime.run_report import Event

_HOMES = {
    "Event": "run_report",
    "Interrupted": "run",
    "Program": "program",
    "Result": "result",
    "SimulationError": "run",
    "plot": "plotting",
    "simulate": "run",
}
__all__ = [
    "Event",
    "Interrupted",
    "Program",
    "Result",
    "SimulationError",
    "plot",
    "simulate",
]


def __getattr__(name: str) -> object:
    """Load a part when it is first used, so that nothing heavy is loaded in vain."""
    import importlib

    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f"{__name__}.{_HOMES[name]}"), name)
