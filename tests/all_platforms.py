"""Exports of FMUs for all platforms: libraries that are only read are compiled quickly."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest
from frot.compiler.toolchain import objects, targets
from frot.compiler.toolchain.compiler_choice import Toolchain

# No emulator runs them; what is read of them is the same without optimization.
READ = ("x86_64-darwin", "aarch64-darwin")


def compile_quickly(patch: pytest.MonkeyPatch) -> None:
    """While the patch lasts, exports do not optimize the libraries of `READ`.

    All tests that export for these platforms share one kernel of each.
    """
    compile_all = targets.compile_libraries

    def compile_libraries(
        toolchain: Toolchain,
        sources: Sequence[Path],
        include: Sequence[Path],
        libraries: Mapping[str, Path],
    ) -> None:
        run = {name: path for name, path in libraries.items() if name not in READ}
        compile_all(toolchain, sources, include, run)
        plain = [flag for flag in objects.KERNEL_FLAGS if flag != "-O2"]
        with pytest.MonkeyPatch.context() as quicker:
            for module in (objects, targets):
                flags = (*plain, "-O0", "-fno-sanitize=all")
                quicker.setattr(module, "KERNEL_FLAGS", flags)
            read = {name: path for name, path in libraries.items() if name in READ}
            compile_all(toolchain, sources, include, read)

    patch.setattr(targets, "compile_libraries", compile_libraries)
