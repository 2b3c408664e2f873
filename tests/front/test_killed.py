"""A killed run takes its compilers with it and leaves nothing half made."""

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from front_door import HOOP, Shell, hasty_compiler, script
from frot.compiler.toolchain.child_processes import Keeper
from frot.compiler.toolchain.compiler_choice import Toolchain
from frot.compiler.toolchain.compilers import compile_objects
from patience import PATIENCE

pytestmark = [
    pytest.mark.skipif(sys.platform != "linux", reason="looks into /proc"),
    pytest.mark.usefixtures("one_compiler"),
]


def alive(pid: int) -> bool:
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return False
    return state not in "ZX"


def wait_until(holds: object, seconds: float = PATIENCE) -> bool:
    """Whether a condition comes to hold in time."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if holds():  # type: ignore[operator]
            return True
        time.sleep(0.02)
    return bool(holds())  # type: ignore[operator]


class Compiling:
    """A run that waits for a compiler which starts another program, as `gcc` does, and sleeps."""

    def __init__(self, shell: Shell, folder: Path) -> None:
        self.cache = folder / "cache"
        self.notes = folder / "pids"
        self.notes.touch()
        body = f'echo $$ >> "{self.notes}"\nsleep 600 &\necho $! >> "{self.notes}"\nwait'
        compiler = script(folder / "slow-cc", body)
        changes = {"FROT_CC": compiler, "FROT_CACHE": self.cache}
        self.process = shell.start("simulate", HOOP, changes=changes)
        assert wait_until(lambda: len(self.pids()) >= 2)

    def pids(self) -> list[int]:
        return [int(word) for word in self.notes.read_text().split()]

    def halves(self) -> list[Path]:
        return list(self.cache.glob("*/.new-*"))


@pytest.fixture
def compiling(
    shell: Shell, warm_cache: Path, tmp_path_factory: pytest.TempPathFactory
) -> Compiling:
    folder = tmp_path_factory.mktemp("slow")
    if (warm_cache / "kernels").is_dir():  # those of the usual compiler
        # without what another test is making there at this moment
        unfinished = shutil.ignore_patterns(".new-*")
        shutil.copytree(warm_cache / "kernels", folder / "cache" / "kernels", ignore=unfinished)
    return Compiling(shell, folder)


@pytest.mark.parametrize("how", ["SIGTERM", "SIGKILL", "SIGHUP", "SIGINT"])
def test_the_compiler_and_the_half_made_folder_end_with_the_run(
    how: str, compiling: Compiling
) -> None:
    assert compiling.halves() and all(map(alive, compiling.pids()))
    compiling.process.send_signal(getattr(signal, how))
    compiling.process.communicate(timeout=PATIENCE)
    assert wait_until(lambda: not any(map(alive, compiling.pids())))
    assert wait_until(lambda: not compiling.halves())


def test_an_interrupt_while_compiling_is_told_at_once(compiling: Compiling) -> None:
    compiling.process.send_signal(signal.SIGINT)
    out, err = compiling.process.communicate(timeout=PATIENCE)
    assert (compiling.process.returncode, out) == (130, "")
    assert err == "interrupted while compiling 'BackspinHoop'; nothing half made is left\n"
    assert not any(map(alive, compiling.pids())) and not compiling.halves()


def test_an_interrupted_compiler_does_not_hinder_the_next_run(
    compiling: Compiling, shell: Shell
) -> None:
    compiling.process.kill()
    compiling.process.communicate(timeout=PATIENCE)
    shell("simulate", HOOP, FROT_CACHE=compiling.cache).succeeds()


def test_the_compilers_of_an_fmu_end_too(
    shell: Shell, tmp_path_factory: pytest.TempPathFactory
) -> None:
    folder = tmp_path_factory.mktemp("slow")
    notes, temporary = folder / "pids", folder / "tmp"
    temporary.mkdir()
    shell("simulate", HOOP).succeeds()
    # A compiler that sleeps where the table of an FMU's variables is among its words.
    sleeps = f'*fmu_table.c*) echo $$ >> "{notes}"; sleep 600'
    slow = f'case "$*" in {sleeps};; esac\nexec "{hasty_compiler(folder)}" "$@"'
    changes = {"FROT_CC": script(folder / "slow-cc", slow), "TMPDIR": temporary}
    process = shell.start("fmu", HOOP, "-o", "hoop.fmu", "--platforms", "native", changes=changes)
    assert wait_until(notes.exists)
    pids = [int(word) for word in notes.read_text().split()]
    process.kill()
    process.communicate(timeout=PATIENCE)
    assert wait_until(lambda: not any(map(alive, pids)))
    assert wait_until(lambda: not list(temporary.glob("frot-*")))
    assert not (shell.folder / "hoop.fmu").exists()


def test_a_run_in_another_thread_compiles_as_well(warm_cache: Path, tmp_path: Path) -> None:
    """A child that watched the thread that started it would end with that thread."""
    if (warm_cache / "kernels").is_dir():
        unfinished = shutil.ignore_patterns(".new-*")
        shutil.copytree(warm_cache / "kernels", tmp_path / "kernels", ignore=unfinished)
    code = (
        "import threading, frot, sys\n"
        f"model = frot.load({str(HOOP)!r})\n"
        "made = []\n"
        "thread = threading.Thread(target=lambda: made.append(model.simulate(stop=1.0)))\n"
        "thread.start(); thread.join()\n"
        "assert made[0].time[-1] == 1.0\n"
    )
    environment = {**os.environ, "FROT_CACHE": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr


def test_an_interrupt_while_compilers_are_being_started_ends_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It may come between the start of one compiler and that of the next."""
    notes = tmp_path / "pids"
    slow = script(tmp_path / "slow-cc", f'echo $$ >> "{notes}"\nexec sleep 600')
    start = Keeper.start

    def interrupted(keeper: Keeper, *words: object) -> object:
        if notes.exists():
            raise KeyboardInterrupt
        process = start(keeper, *words)  # type: ignore[arg-type]
        assert wait_until(lambda: notes.exists() and notes.read_text().endswith("\n"))
        return process

    monkeypatch.setattr(Keeper, "start", interrupted)
    monkeypatch.setattr(os, "cpu_count", lambda: 2)
    sources = [tmp_path / "a.c", tmp_path / "b.c"]
    with pytest.raises(KeyboardInterrupt):
        compile_objects(Toolchain((str(slow),), "slow"), sources, [], tmp_path, ())
    assert not any(alive(int(word)) for word in notes.read_text().split())


def test_a_compiler_that_prints_more_than_a_pipe_holds_ends(tmp_path: Path) -> None:
    body = 'head -c 300000 /dev/zero | tr "\\0" x >&2\nfor word; do :; done\n: > "$word"'
    loud = Toolchain((str(script(tmp_path / "loud-cc", body)),), "loud")
    sources = [tmp_path / f"{name}.c" for name in "abc"]
    objects = compile_objects(loud, sources, [], tmp_path, ())
    assert [one.name for one in objects] == ["a.o", "b.o", "c.o"]
