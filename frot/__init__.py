"""Frot: models of rigid bodies with liaisons and dry friction, run exactly and exported as FMUs.

```python
import frot
model = frot.load("hoop.frot")
result = model.simulate(stop=3.0, parameters={"mu": 0.2})
result["hoop.position.x"], result.events, result.at(1.5)["hoop.velocity.x"]
```
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from frot.dsl.messages.errors import FrotError
    from frot.model import Model, compile, load
    from frot.runtime.result import Result
    from frot.runtime.run import Interrupted, SimulationError
    from frot.runtime.run_files import load_result
    from frot.runtime.run_report import Event

_HOMES = {
    "Event": "frot.runtime.run_report",
    "FrotError": "frot.dsl.messages.errors",
    "Interrupted": "frot.runtime.run",
    "Model": "frot.model",
    "Result": "frot.runtime.result",
    "SimulationError": "frot.runtime.run",
    "compile": "frot.model",
    "load": "frot.model",
    "load_result": "frot.runtime.run_files",
}
__all__ = [
    "Event",
    "FrotError",
    "Interrupted",
    "Model",
    "Result",
    "SimulationError",
    "compile",
    "load",
    "load_result",
]


def __dir__() -> list[str]:
    """Names of the package for users, loaded or not."""
    return sorted({*(name for name in globals() if name[:2] == "__"), *__all__, "__version__"})


def __getattr__(name: str) -> object:
    """Load a name when it is first used, so that `frot --help` loads nothing heavy."""
    import importlib

    if name == "__version__":
        from importlib.metadata import version

        return version("frot")
    if name not in _HOMES:
        raise AttributeError(f"module 'frot' has no attribute '{name}'")
    return getattr(importlib.import_module(_HOMES[name]), name)
