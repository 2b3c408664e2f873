"""The compiler room: a checked model to equations, CasADi functions, C and a compiled program."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from frot.compiler.cache import find_program, program_key
    from frot.compiler.dae import Dae, make_dae
    from frot.compiler.driver import build
    from frot.compiler.objects import compile_library
    from frot.compiler.printing import print_stage
    from frot.compiler.report import Report, make_report
    from frot.compiler.toolchain import Toolchain, find_toolchain

_HOMES = {
    "Dae": "dae",
    "Report": "report",
    "Toolchain": "toolchain",
    "build": "driver",
    "compile_library": "objects",
    "find_program": "cache",
    "find_toolchain": "toolchain",
    "make_dae": "dae",
    "make_report": "report",
    "print_stage": "printing",
    "program_key": "cache",
}
__all__ = [
    "Dae",
    "Report",
    "Toolchain",
    "build",
    "compile_library",
    "find_program",
    "find_toolchain",
    "make_dae",
    "make_report",
    "print_stage",
    "program_key",
]


def __getattr__(name: str) -> object:
    """Load a part when it is asked for, so that nothing heavy is loaded in vain."""
    import importlib

    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f"{__name__}.{_HOMES[name]}"), name)
