"""The cache has a stated size: what was used least recently goes first, what is in use stays."""

import os
import shutil
import time
from pathlib import Path

import pytest
from front_door import HOOP, Door, Shell
from frot.compiler.toolchain.cache import find_program
from frot.compiler.toolchain.cache_size import bytes_of, entries, shown, shrink, sweep, write_limit
from frot.compiler.toolchain.cache_store import store
from frot.compiler.toolchain.folder_lock import hold

import frot

pytestmark = pytest.mark.usefixtures("one_compiler")


@pytest.fixture
def cache(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty cache."""
    made = tmp_path_factory.mktemp("sized")
    monkeypatch.setenv("FROT_CACHE", str(made))
    return made


@pytest.fixture
def with_kernel(cache: Path, warm_cache: Path) -> Path:
    """A cache that holds the kernel's objects alone, so that less is compiled."""
    if (warm_cache / "kernels").is_dir():
        unfinished = shutil.ignore_patterns(".new-*")
        shutil.copytree(warm_cache / "kernels", cache / "kernels", ignore=unfinished)
    return cache


def put(key: str, size: int, age: float) -> Path:
    """An entry of some size, last used `age` seconds ago; nobody uses it."""
    folder = store("programs", key, lambda f, _: (f / "x").write_bytes(b"x" * size) and None).folder
    os.utime(folder, (time.time() - age,) * 2)
    return folder


def names(cache: Path) -> list[str]:
    return [entry.path.name for entry in entries(cache)]


def test_the_limit_holds_whatever_is_added(cache: Path) -> None:
    """Not every entry makes a process look at all that is kept."""
    write_limit(cache, 200_000)
    for k in range(60):
        put(f"{k:02}", 6_000, 1000.0 - k)
        assert sum(entry.size for entry in entries(cache)) <= 200_000
    assert names(cache)[-1] == "59" and len(names(cache)) > 25


def test_what_was_used_least_recently_goes_first(cache: Path) -> None:
    for key, age in (("a", 300.0), ("b", 100.0), ("c", 200.0)):
        put(key, 10_000, age)
    assert names(cache) == ["a", "c", "b"]
    assert [entry.path.name for entry in shrink(cache, 15_000)] == ["a", "c"]
    assert names(cache) == ["b"]


def test_a_program_in_use_is_never_removed(cache: Path) -> None:
    old = put("old", 10_000, 300.0)
    put("new", 10_000, 100.0)
    user = hold(old)
    assert user is not None
    shrink(cache, 0)
    assert names(cache) == ["old"]
    del user
    shrink(cache, 0)
    assert names(cache) == []


def test_storing_keeps_the_limit(cache: Path) -> None:
    write_limit(cache, 50_000)
    for number in range(20):
        put(f"{number:02}", 10_000, 1000.0 - number)
    kept = names(cache)
    assert kept == [f"{number:02}" for number in range(16, 20)]
    assert sum(entry.size for entry in entries(cache)) <= 50_000


def test_a_model_that_runs_outlives_every_limit(with_kernel: Path) -> None:
    model = frot.load(HOOP)
    first = model.simulate(stop=1.0)
    shrink(with_kernel, 0)
    assert model.program().folder.is_dir()
    again = model.simulate(stop=1.0)
    assert (again["hoop.position.x"] == first["hoop.position.x"]).all()
    model.export_fmu(with_kernel / "hoop.fmu", platforms="native")
    key = model.program().key
    del model, first, again
    shrink(with_kernel, 0)
    assert find_program(key) is None


def test_using_a_program_makes_it_recent(with_kernel: Path) -> None:
    frot.load(HOOP).program()
    (folder,) = (with_kernel / "programs").iterdir()
    os.utime(folder, (1.0, 1.0))
    frot.load(HOOP)
    assert time.time() - folder.stat().st_mtime < 100.0


def test_what_nobody_finishes_is_swept_and_what_is_being_made_is_not(cache: Path) -> None:
    stale, young, held = (cache / "programs" / f".new-{name}" for name in ("old", "young", "held"))
    for folder in (stale, young, held):
        folder.mkdir(parents=True)
        (folder / "model.c").write_text("half")
    for folder in (stale, held):
        os.utime(folder, (1.0, 1.0))
    maker = hold(held)
    assert maker is not None
    sweep(cache)
    assert not stale.exists() and young.exists() and held.exists()


@pytest.mark.parametrize(
    ("text", "size"),
    [("0", 0), ("200MB", 200_000_000), ("1.5 gb", 1_500_000_000), ("64 MiB", 64 * 2**20)],
)
def test_sizes_are_written_as_people_do(text: str, size: int) -> None:
    assert bytes_of(text) == size


def test_sizes_are_shown_as_people_do() -> None:
    assert [shown(n) for n in (7, 5_200, 512_000_000, 2 * 10**9)] == [
        "7 bytes",
        "5.2 kB",
        "512 MB",
        "2 GB",
    ]


class TestCommand:
    def test_it_tells_where_and_how_large(self, cache: Path, door: Door) -> None:
        out = door("cache").succeeds().out
        assert out == f"folder: {cache}\nsize: 0 bytes of at most 512 MB, 0 compiled models\n"
        put("a", 10_000, 0.0)
        assert "size: 10.1 kB of at most 512 MB, 1 compiled model\n" in door("cache").out

    def test_a_limit_holds_from_now_on(self, cache: Path, door: Door) -> None:
        put("a", 10_000, 200.0)
        put("b", 10_000, 100.0)
        out = door("cache", "--limit", "15kB").succeeds().out
        assert "of at most 15 kB, 1 compiled model\nremoved: 10.1 kB, 1 compiled model\n" in out
        assert "of at most 15 kB" in door("cache").out and names(cache) == ["b"]

    def test_all_is_cleared_but_what_is_used(self, cache: Path, door: Door) -> None:
        put("a", 10_000, 0.0)
        used = hold(put("b", 10_000, 0.0))
        assert "what is in use was kept" in door("cache", "--clear").succeeds().out
        assert used is not None and names(cache) == ["b"]

    def test_a_size_that_is_none_is_told(self, cache: Path, door: Door) -> None:
        for text in ("much", "-1", "3 parsec", ""):
            door("cache", "--limit", text).refuses("E0806", "is not a size", "200MB")

    def test_a_folder_that_is_not_there_is_no_fault(
        self, cache: Path, door: Door, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.setenv("FROT_CACHE", str(cache / "none"))
        assert "0 bytes" in door("cache").succeeds().out
        assert "0 bytes" in door("cache", "--clear").succeeds().out
        assert not (cache / "none").exists()

    def test_nothing_heavy_is_loaded(self, cache: Path, shell: Shell) -> None:
        import sys

        code = (
            "import sys; from frot.command_line import main\n"
            "assert main(['cache']) == 0; print(*sys.modules)"
        )
        out = shell.run([sys.executable, "-c", code], FROT_CACHE=cache).succeeds().out
        assert not {"casadi", "numpy", "lark", "frot.dsl.checking"} & set(out.split())


@pytest.mark.usefixtures("with_kernel")
class TestOneFileThreeNames:
    TEXT = (
        "planar model Named\n"
        "  parameter Mass m = 1 kg;\n"
        "  body b: particle(mass = m);\n"
        "  experiment(stop = 1 s);\n"
        "end Named;\n"
    )

    def test_it_is_compiled_once_and_told_as_its_user_names_it(
        self, cache: Path, door: Door
    ) -> None:
        door.write(self.TEXT)
        (door.folder / "inner").mkdir()
        whole = str(door.folder / "model.frot")
        for name in ("model.frot", "./model.frot", whole, "inner/../model.frot"):
            door("simulate", name).succeeds()
            assert len(list((cache / "programs").iterdir())) == 1
            answer = door("simulate", name, "--set", "m=-1")
            answer.refuses("E0401", "mass of body 'b'", place=f"{name}:3:27")

    def test_the_same_text_in_another_place_is_the_same_program(
        self, cache: Path, door: Door
    ) -> None:
        door("simulate", door.write(self.TEXT, "a.frot")).succeeds()
        door("simulate", door.write(self.TEXT, "b.frot")).succeeds()
        assert len(list((cache / "programs").iterdir())) == 1

    def test_what_it_imports_from_beside_it_is_not(self, cache: Path, door: Door) -> None:
        text = (
            "import Parts.load;\n"
            "planar model M\n"
            "  body b: particle(mass = load);\n"
            "  experiment(stop = 1 s);\n"
            "end M;\n"
        )
        for folder, mass in (("one", 1), ("two", 2)):
            (door.folder / folder).mkdir()
            part = f"package Parts\n  constant Mass load = {mass} kg;\nend Parts;\n"
            door.write(part, f"{folder}/Parts.frot")
            door("simulate", door.write(text, f"{folder}/m.frot")).succeeds()
        assert len(list((cache / "programs").iterdir())) == 2


@pytest.mark.usefixtures("with_kernel")
def test_a_cache_that_may_be_read_only_is_used_and_another_is_filled(
    cache: Path, door: Door, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """What lies on a read-only disk is found, what is new goes to the temporary folder."""
    import errno
    import tempfile

    door("simulate", HOOP).succeeds()
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    made = tempfile.mkdtemp

    def mkdtemp(suffix: str | None = None, prefix: str | None = None, dir: object = None) -> str:
        if dir is not None and Path(str(dir)).is_relative_to(cache):
            raise OSError(errno.EROFS, os.strerror(errno.EROFS))
        return made(suffix, prefix, dir)  # type: ignore[call-overload, no-any-return]

    monkeypatch.setattr(tempfile, "mkdtemp", mkdtemp)
    door("simulate", HOOP).succeeds()
    assert not list(temporary.rglob("program.so"))
    text = HOOP.read_text(encoding="utf-8").replace("ring(", "disc(")
    door("simulate", door.write(text)).succeeds()
    assert len(list(temporary.glob("frot-*/programs/*/program.so"))) == 1
    (program,) = temporary.glob("frot-*/programs/*")
    os.utime(program, (1.0, 1.0))
    door("simulate", "model.frot").succeeds()
    assert program.stat().st_mtime > 1.0 and not list((cache / "programs").glob(".new-*"))


def test_a_temporary_folder_of_someone_else_is_not_trusted(
    cache: Path, door: Door, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Programs are run: whoever can write the folder could run theirs."""
    import tempfile

    temporary = tmp_path / "temporary"
    (temporary / f"frot-{os.getuid()}").mkdir(parents=True)
    os.chmod(temporary / f"frot-{os.getuid()}", 0o777)
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    monkeypatch.setenv("FROT_CACHE", "/dev/null/none")
    door("simulate", HOOP).refuses("E0803", "belongs to someone else", "set FROT_CACHE")


@pytest.mark.usefixtures("with_kernel")
def test_a_cache_that_can_be_written_does_not_read_the_temporary_folder(
    cache: Path, door: Door, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """What an earlier run has left in the temporary folder is not of the cache of `FROT_CACHE`."""
    import tempfile

    door("simulate", HOOP).succeeds()
    (program,) = (cache / "programs").iterdir()
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    left = temporary / f"frot-{os.getuid()}"
    left.mkdir(mode=0o700)
    shutil.move(cache / "programs", left / "programs")
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    door("simulate", HOOP).succeeds()
    assert [path.name for path in (cache / "programs").iterdir()] == [program.name]
