"""Compiled models: made once, found again, repaired; compilers that are missing or fail."""

import re
import shutil
import sys
from importlib.resources import files
from pathlib import Path

import pytest
from front_door import HOOP, Answer, Door, Shell, hasty_compiler, script
from patience import PATIENCE

pytestmark = pytest.mark.usefixtures("one_compiler")

EVENT = "floor: slip -> stick at t = 1.868841318382"


@pytest.fixture
def cache(folder: Path) -> Path:
    """A cache of its own, outside of the folder where commands are run."""
    made = folder.parent / f"{folder.name}-cache"
    made.mkdir()
    return made


@pytest.fixture(scope="module")
def hasty(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return hasty_compiler(tmp_path_factory.mktemp("hasty"))


@pytest.fixture
def shell(folder: Path, hasty: Path) -> Shell:
    return Shell(folder, {"FROT_CC": hasty})


@pytest.fixture(scope="module")
def filled(hasty: Path, one_compiler: None, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A cache that holds the hoop alone; to be copied."""
    made = tmp_path_factory.mktemp("filled")
    ran(Shell(made, {"FROT_CC": hasty})("simulate", HOOP, FROT_CACHE=made))
    return made


@pytest.fixture
def copy(filled: Path, cache: Path) -> Path:
    return shutil.copytree(filled, cache, dirs_exist_ok=True)


def ran(answer: Answer) -> Answer:
    assert EVENT in answer.succeeds().out
    return answer


def counting(folder: Path, hasty: Path) -> tuple[Path, Path]:
    """A compiler that notes each call, and the file of its notes."""
    notes = folder / "calls"
    notes.touch()
    return script(folder / "counting-cc", f'echo "$@" >> "{notes}"\nexec "{hasty}" "$@"'), notes


def test_a_second_run_and_other_parameters_start_no_compiler(
    shell: Shell, cache: Path, hasty: Path
) -> None:
    compiler, notes = counting(cache, hasty)
    first = ran(shell("simulate", HOOP, FROT_CC=compiler, FROT_CACHE=cache))
    calls = notes.read_text()
    assert calls.count("\n") > 2
    second = ran(shell("simulate", HOOP, FROT_CC=compiler, FROT_CACHE=cache))
    assert second.out.splitlines()[1] == first.out.splitlines()[1]
    other = ("--set", "mu=0.2", "--set", "r=60 cm", "--tolerance", "1e-6", "--stop", "5")
    shell("simulate", HOOP, *other, FROT_CC=compiler, FROT_CACHE=cache).succeeds()
    assert notes.read_text() == calls


def test_another_model_compiles_its_own_file_only(shell: Shell, cache: Path, hasty: Path) -> None:
    compiler, notes = counting(cache, hasty)
    ran(shell("simulate", HOOP, FROT_CC=compiler, FROT_CACHE=cache))
    notes.write_text("")
    changed = HOOP.read_text(encoding="utf-8").replace("ring(", "disc(")
    (shell.folder / "disc.frot").write_text(changed, encoding="utf-8")
    shell("simulate", "disc.frot", FROT_CC=compiler, FROT_CACHE=cache).succeeds()
    assert notes.read_text().count("-c ") == 1 and notes.read_text().count("\n") == 2


# A model of equations alone: ranks of relations between bodies take CasADi.
RECTIFIER = HOOP.with_name("half_wave_rectifier.frot")


@pytest.mark.parametrize("command", ["simulate", "--help", "check", "--version"])
def test_what_is_not_needed_is_not_imported(command: str, filled: Path, shell: Shell) -> None:
    words = [sys.executable, "-X", "importtime", "-m", "frot.command_line", command]
    if command in ("simulate", "check"):
        words.append(str(HOOP if command == "simulate" else RECTIFIER))
    answer = shell.run(words, FROT_CACHE=filled)
    assert answer.status == 0
    loaded = set(re.findall(r"(?m)\| +([\w.]+)$", answer.err))
    assert "argparse" in loaded
    heavy = {"casadi", "matplotlib", "fmpy", "rich"}
    heavy |= {
        "simulate": {
            *("lark", "numpy", "scipy", "frot.dsl.catalogue", "frot.dsl.messages.codes"),
            *("subprocess", "tempfile", "frot.compiler.product.generate"),
        },
        "check": {"frot.compiler.equations.reduce"},
        "--help": {"lark", "numpy", "scipy", "frot.dsl", "frot.model"},
        "--version": {"lark", "numpy", "scipy", "frot.dsl", "frot.model"},
    }[command]
    assert not {name for name in loaded if name in heavy}


def test_two_first_runs_at_once_both_succeed(shell: Shell, cache: Path) -> None:
    both = [shell.start("simulate", HOOP, changes={"FROT_CACHE": cache}) for _ in range(2)]
    for process in both:
        out, err = process.communicate(timeout=PATIENCE)
        assert process.returncode == 0 and EVENT in out, err
    assert len(list((cache / "programs").iterdir())) == 1
    assert not list(cache.rglob(".new-*"))


def one(cache: Path, pattern: str) -> Path:
    (found,) = cache.glob(pattern)
    return found


def shorten(path: Path, part: float) -> None:
    content = path.read_bytes()
    path.write_bytes(content[: int(len(content) * part)])


DAMAGES = {
    "a manifest cut short": lambda c: shorten(one(c, "programs/*/manifest.json"), 0.5),
    "an empty manifest": lambda c: shorten(one(c, "programs/*/manifest.json"), 0),
    "a manifest of another kind": lambda c: one(c, "programs/*/manifest.json").write_text("[]"),
    "a missing manifest": lambda c: one(c, "programs/*/manifest.json").unlink(),
    "an empty library": lambda c: shorten(one(c, "programs/*/program.so"), 0),
    "a library cut short": lambda c: shorten(one(c, "programs/*/program.so"), 0.3),
    "a library that is none": lambda c: one(c, "programs/*/program.so").write_text("no library"),
    "a missing library": lambda c: one(c, "programs/*/program.so").unlink(),
    "a missing source": lambda c: one(c, "programs/*/model.c").unlink(),
}


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_damaged_cache_is_repaired(damage: str, copy: Path, shell: Shell) -> None:
    DAMAGES[damage](copy)
    ran(shell("simulate", HOOP, FROT_CACHE=copy))
    ran(shell("simulate", HOOP, FROT_CACHE=copy))


@pytest.mark.parametrize("damage", ["none left", "one missing", "all empty"])
def test_a_damaged_kernel_is_compiled_again(damage: str, copy: Path, shell: Shell) -> None:
    shutil.rmtree(copy / "programs")
    for number, path in enumerate(sorted(copy.glob("kernels/*/*.o"))):
        if damage == "all empty":
            path.write_bytes(b"")
        elif damage == "none left" or number == 0:
            path.unlink()
    ran(shell("simulate", HOOP, FROT_CACHE=copy))


def test_a_program_whose_kernel_is_gone_or_cut_short_is_made_anew(
    shell: Shell, cache: Path
) -> None:
    """Programs of a cache share one library of the kernel, and need it by its path."""
    ran(shell("simulate", HOOP, FROT_CACHE=cache))
    kernel = one(cache, "kernels/*/kernel.so")
    assert one(cache, "programs/*/program.so").stat().st_size < kernel.stat().st_size / 4
    kernel.unlink()
    ran(shell("simulate", HOOP, FROT_CACHE=cache))
    shorten(one(cache, "kernels/*/kernel.so"), 0.5)
    ran(shell("simulate", HOOP, FROT_CACHE=cache))
    assert one(cache, "programs/*/program.so").is_file()


def test_an_fmu_is_not_made_from_a_damaged_source(copy: Path, shell: Shell) -> None:
    shorten(one(copy, "programs/*/model.c"), 0)
    answer = shell("fmu", HOOP, "-o", "hoop.fmu", "--platforms", "native", FROT_CACHE=copy)
    if answer.status == 0:
        code = "import sys, fmpy; fmpy.simulate_fmu(sys.argv[1], stop_time=1)"
        assert shell.run([sys.executable, "-c", code, "hoop.fmu"]).status == 0
    else:
        answer.refuses("E0807")


@pytest.mark.parametrize("place", ["/dev/null/cache", "/proc/cache", str(HOOP)])
def test_a_cache_that_cannot_be_made_is_replaced_by_a_temporary_one(
    place: str, shell: Shell, cache: Path
) -> None:
    ran(shell("simulate", HOOP, FROT_CACHE=place, TMPDIR=cache))
    assert list(cache.glob("frot-*/programs/*/program.so"))


def test_a_cache_folder_that_takes_no_files_does_no_harm_or_is_told(
    shell: Shell, cache: Path
) -> None:
    answer = shell("simulate", HOOP, FROT_CACHE="/proc", TMPDIR=cache)
    if answer.status:
        answer.refuses("E0803", "set FROT_CACHE")


def left_clean(cache: Path) -> bool:
    return not [p for p in cache.rglob("*") if p.parent.name in ("programs", "kernels")]


def test_without_a_compiler_the_remedies_are_named(
    door: Door, cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", "")
    monkeypatch.delenv("FROT_CC", raising=False)
    monkeypatch.setenv("FROT_CACHE", str(cache))
    monkeypatch.setitem(sys.modules, "ziglang", None)
    for command in ("simulate", "fmu"):
        answer = door(command, HOOP)
        answer.refuses("E0801", "no C compiler was found", "pip install ziglang", "FROT_CC")
    door("check", HOOP).succeeds()
    assert left_clean(cache)


@pytest.mark.parametrize("command", ["/none/cc", "none-cc -O2", "/tmp"])
def test_a_compiler_that_does_not_exist_is_told(
    command: str, door: Door, cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("FROT_CC", command)
    monkeypatch.setenv("FROT_CACHE", str(cache))
    door("simulate", HOOP).refuses("E0801", command, "set FROT_CC")
    assert left_clean(cache)


@pytest.mark.parametrize(
    "body",
    [
        "echo 'model.c:1: error: no such thing' >&2; exit 1",
        "exit 1",
        "kill -SEGV $$",
        "printf '\\377\\376 bytes' >&2; exit 3",
        "exit 0",
    ],
)
def test_a_compiler_that_fails_is_told_and_nothing_is_kept(
    body: str, door: Door, cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    compiler = script(cache / "bad-cc", body)
    monkeypatch.setenv("FROT_CC", str(compiler))
    monkeypatch.setenv("FROT_CACHE", str(cache))
    door("simulate", HOOP).refuses("E0802", str(compiler), "FROT_CC")
    assert left_clean(cache)


def test_the_first_lines_of_a_failing_compiler_are_shown(
    door: Door, cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    lines = "for i in 1 2 3 4 5 6 7 8 9 10 11 12; do echo line-$i >&2; done; exit 1"
    monkeypatch.setenv("FROT_CC", str(script(cache / "bad-cc", lines)))
    monkeypatch.setenv("FROT_CACHE", str(cache))
    answer = door("simulate", HOOP)
    assert "note: line-1\n" in answer.err and "line-12" not in answer.err


def test_a_compiler_command_with_an_open_quote_is_told(
    door: Door, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("FROT_CC", "cc '")
    door("simulate", HOOP).refuses("E0801", "FROT_CC")


def test_a_compiler_that_cannot_be_run_has_a_remedy(
    door: Door, cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    bad = cache / "not-a-program"
    bad.write_text("no shebang")
    bad.chmod(0o755)
    monkeypatch.setenv("FROT_CC", str(bad))
    monkeypatch.setenv("FROT_CACHE", str(cache))
    door("simulate", HOOP).refuses("E0802", "could not be run")


def test_every_source_of_the_rooms_counts() -> None:
    """A source in a folder of a folder makes another version too."""
    from frot.compiler.toolchain import cache

    counted = [Path(e) for room in cache._ROOMS for e in cache._sources(str(files(room)))]
    rooms = [Path(str(files(room))) for room in cache._ROOMS]
    wanted = {p for r in rooms for s in (".py", ".c", ".h", ".lark") for p in r.rglob(f"*{s}")}
    assert set(counted) == wanted and len(counted) == len(wanted) > 150
