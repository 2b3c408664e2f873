"""Compiles the kernel while Frot is installed, so that the first run need not wait for it.

Without a C compiler, or with another one later, the first run compiles it instead.
"""

import sys
import tomllib
import types
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py

HERE = Path(__file__).parent
WITHOUT_KERNEL = "Frot is installed without its kernel, which the first run compiles"


def see_packages() -> None:
    """Make modules of Frot importable from where they lie, without what its packages import."""
    settings = tomllib.loads((HERE / "pyproject.toml").read_text(encoding="utf-8"))
    for name, folder in settings["tool"]["setuptools"]["package-dir"].items():
        package = types.ModuleType(name)
        package.__path__ = [str(HERE / folder)]
        sys.modules[name] = package


class BuildWithKernel(build_py):
    """Puts the kernel's objects beside the modules of the runtime."""

    def run(self) -> None:
        """Build the packages, then the kernel."""
        super().run()
        see_packages()
        from frot.compiler.toolchain.cache import INSTALLED
        from frot.compiler.toolchain.objects import install_kernel
        from frot.dsl.messages.errors import FrotError

        own = HERE / "runtime"
        runtime = own if self.editable_mode else Path(self.build_lib, "frot", "runtime")
        try:
            install_kernel(own / "kernel", [own / INSTALLED], runtime / INSTALLED)
        except (OSError, FrotError) as error:
            self.warn(f"{WITHOUT_KERNEL}: {error}")


setup(cmdclass={"build_py": BuildWithKernel})
