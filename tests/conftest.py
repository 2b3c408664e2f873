"""What the processes of a session share: a cache of compiled models, and objects of C sources."""

from __future__ import annotations

import os
import shutil
import tempfile
from pathlib import Path

import pytest
from made_once import FOLDER, made_once

import frot

NOTHING = "model Nothing\n  Real x = 1;\n  experiment(stop = 1 s);\nend Nothing;\n"


def pytest_configure(config: pytest.Config) -> None:
    """Make the folder of the session; worker processes inherit its name.

    `FROT_CACHE` is kept where it is set. A test that looks at the cache sets another.
    """
    # Each of the processes that tests start would compile the modules anew.
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    if FOLDER not in os.environ:
        folder = tempfile.mkdtemp(prefix="frot-tests-")
        os.environ[FOLDER] = folder
        os.environ.setdefault("FROT_CACHE", str(Path(folder) / "cache"))
        config.add_cleanup(lambda: shutil.rmtree(folder, ignore_errors=True))


@pytest.fixture(scope="session", autouse=True)
def warm_cache(request: pytest.FixtureRequest) -> Path:
    """The cache of the session.

    Workers that begin at once would each compile the kernel: one does, the others wait.
    """
    compiled = any(item.path.parent.name != "dsl" for item in request.session.items)
    if "PYTEST_XDIST_WORKER" in os.environ and compiled:
        made_once("kernel", lambda _: frot.compile(NOTHING).simulate())
    return Path(os.environ["FROT_CACHE"])


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Say which tests of FMUs had no emulator to run under."""
    from emulators import told

    terminalreporter.write_line(f"FMUs of {told()}")
