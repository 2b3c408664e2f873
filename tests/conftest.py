"""What the processes of a session share: a cache of compiled models, and objects of C sources."""

from __future__ import annotations

import gc
import os
import shutil
import tempfile
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import pytest
from made_once import FOLDER, made_once

import frot

NOTHING = "model Nothing\n  Real x = 1;\n  experiment(stop = 1 s);\nend Nothing;\n"
TESTS = Path(__file__).parent
# What `-m quick` runs: the language, rules of the sources, and a file of each part behind them.
QUICK = (
    *("dsl", "architecture", "report/test_first_integrals.py"),
    *("equations/test_initial_values.py", "equations/test_high_index.py"),
    *("mechanics/test_pin.py", "mechanics/test_breakaway.py"),
    *("mechanics/friction/test_exact_sticking.py", "liaisons/test_planar_table.py"),
    *("space/test_free_bodies.py", "kernel/test_roots.py", "fmi/test_fmu_types.py"),
)
# Few tests that take long: begun last, one process would wait for the other at the end.
SLOW = (
    *("docs/test_documents.py", "fmi/test_fmu_compilers.py", "judge/test_random_scenes.py"),
    *("fmi/test_fmu_sanitizers.py", "kernel/test_sanitizers.py", "fmi/test_fmu_platforms.py"),
    *("contacts_in_space/test_boxes_over_edges.py", "impacts/test_rough_corners_at_once.py"),
)
NOT_QUICK = ("dsl/test_fuzz.py", "dsl/test_long_texts.py", "dsl/test_formatting.py")


def pytest_configure(config: pytest.Config) -> None:
    """Make the folder of the session; worker processes inherit its name.

    `FROT_CACHE` is kept where it is set. A test that looks at the cache sets another.
    """
    # Each of the processes that tests start would compile the modules anew.
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    # Most models of tests run for less time than their C is optimised; all bits are the same.
    os.environ.setdefault("FROT_OPTIMIZE", "0")
    # tests/front/test_optimization.py compares its bits with those of `cc`.
    if shutil.which("tcc") is not None:
        os.environ.setdefault("FROT_MODEL_CC", "tcc")
    if FOLDER not in os.environ:
        folder = tempfile.mkdtemp(prefix="frot-tests-")
        os.environ[FOLDER] = folder
        os.environ.setdefault("FROT_CACHE", str(Path(folder) / "cache"))
        config.add_cleanup(lambda: shutil.rmtree(folder, ignore_errors=True))


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark the tests of `QUICK`; put the files of `SLOW` first, then those of most tests."""
    counts = Counter(item.path for item in items)
    paths = {path: path.relative_to(TESTS) for path in counts}
    quick = {
        path
        for path, own in paths.items()
        if any(own.is_relative_to(name) for name in QUICK) and own.as_posix() not in NOT_QUICK
    }
    first = {TESTS / name: k for k, name in enumerate(SLOW)}
    for item in items:
        if item.path in quick:
            item.add_marker("quick")
    items.sort(key=lambda item: (first.get(item.path, len(SLOW)), -counts[item.path]))


def pytest_collection_finish() -> None:
    """Leave what was collected, ten thousand tests, out of later collections of garbage."""
    gc.collect()
    gc.freeze()


@pytest.fixture
def finding() -> Callable[..., frot.Model]:
    """The model of `tests/scenes/name.frot`; `changes` replaces phrases of its text.

    Values of parameters need no change of the text: `simulate(parameters=...)` sets them.
    """

    def load(name: str, changes: dict[str, str] | None = None) -> frot.Model:
        path = TESTS / "scenes" / f"{name}.frot"
        if not changes:
            return frot.load(path)
        text = path.read_text(encoding="utf-8")
        for old, new in changes.items():
            assert text.count(old) == 1, f"{name}: {old}"
            text = text.replace(old, new)
        return frot.compile(text)

    return load


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
