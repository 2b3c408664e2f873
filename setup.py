"""Makes, while Frot is installed, what is the same for every model: the first run is a fast one.

These are the kernel's objects and the parser's tables. Without a C compiler, or with another one
later, the first run compiles the kernel instead.
"""

import sys
import tomllib
import types
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py

HERE = Path(__file__).parent
LATER = "left to the first run"


def see_packages() -> None:
    """Make modules of Frot importable from where they lie, without what its packages import."""
    settings = tomllib.loads((HERE / "pyproject.toml").read_text(encoding="utf-8"))
    for name, folder in settings["tool"]["setuptools"]["package-dir"].items():
        package = types.ModuleType(name)
        package.__path__ = [str(HERE / folder)]
        sys.modules[name] = package


class BuildWithWhatIsMadeOnce(build_py):
    """Puts the kernel's objects and the parser's tables beside the modules that use them."""

    def run(self) -> None:
        """Build the packages, then these."""
        super().run()
        see_packages()
        self._kernel()
        self._tables()

    def _folder(self, room: str) -> Path:
        return HERE / room if self.editable_mode else Path(self.build_lib, "frot", room)

    def _tables(self) -> None:
        from frot.dsl.text.grammar import MADE, make_tables

        try:
            make_tables(self._folder("dsl/text") / MADE.name)
        except (ImportError, OSError) as error:
            self.warn(f"the parser's tables are {LATER}: {error}")

    def _kernel(self) -> None:
        from frot.compiler.toolchain.cache import INSTALLED
        from frot.compiler.toolchain.objects import install_kernel
        from frot.dsl.messages.errors import FrotError

        own = HERE / "runtime"
        try:
            install_kernel(own / "kernel", [own / INSTALLED], self._folder("runtime") / INSTALLED)
        except (OSError, FrotError) as error:
            self.warn(f"the kernel is {LATER}: {error}")


setup(cmdclass={"build_py": BuildWithWhatIsMadeOnce})
