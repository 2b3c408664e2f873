"""The compiler room: a checked model to equations, CasADi functions, C and a compiled program."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from frot.compiler.driver import build, make_dae, make_report, print_stage
    from frot.compiler.product.dae import Dae
    from frot.compiler.report.report import Report
    from frot.compiler.toolchain.cache import find_program, own_identity, program_key
    from frot.compiler.toolchain.compiler_choice import Toolchain, find_toolchain
    from frot.compiler.toolchain.targets import compile_libraries, possible_platforms

_HOMES = {
    "Dae": "product.dae",
    "Report": "report.report",
    "Toolchain": "toolchain.compiler_choice",
    "build": "driver",
    "compile_libraries": "toolchain.targets",
    "find_program": "toolchain.cache",
    "find_toolchain": "toolchain.compiler_choice",
    "make_dae": "driver",
    "make_report": "driver",
    "own_identity": "toolchain.cache",
    "possible_platforms": "toolchain.targets",
    "print_stage": "driver",
    "program_key": "toolchain.cache",
}
__all__ = [
    "Dae",
    "Report",
    "Toolchain",
    "build",
    "compile_libraries",
    "find_program",
    "find_toolchain",
    "make_dae",
    "make_report",
    "own_identity",
    "possible_platforms",
    "print_stage",
    "program_key",
]


def __getattr__(name: str) -> object:
    """Load a part when it is first used, so that nothing heavy is loaded in vain."""
    import importlib

    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f"{__name__}.{_HOMES[name]}"), name)
