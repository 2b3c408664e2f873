"""Makes, while Frot is installed, what is the same for every model: the first run is a fast one.

These are the kernel's objects and the parser's tables. Without a C compiler, or with another one
later, the first run compiles the kernel instead.
"""

import sys
import tomllib
import types
from pathlib import Path

from setuptools import find_packages, setup
from setuptools.command.build_py import build_py

HERE = Path(__file__).parent
LATER = "left to the first run"


def list_packages() -> dict[str, str]:
    """The folder of each package, those of pyproject.toml and all below them."""
    settings = tomllib.loads((HERE / "pyproject.toml").read_text(encoding="utf-8"))
    found = dict(settings["tool"]["setuptools"]["package-dir"])
    for parent, folder in list(found.items()):
        for name in find_packages(str(HERE / folder)):
            found[f"{parent}.{name}"] = f"{folder}/{name.replace('.', '/')}"
    return found


def see_packages() -> None:
    """Make modules of Frot importable from where they lie, without what its packages import."""
    for name, folder in list_packages().items():
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


setup(packages=sorted(list_packages()), cmdclass={"build_py": BuildWithWhatIsMadeOnce})
