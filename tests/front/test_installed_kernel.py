"""The kernel is compiled when Frot is installed, and taken from there for as long as it fits."""

from pathlib import Path

import pytest
from front_door import HOOP, Door, hasty_compiler, script
from frot.compiler.toolchain import cache
from frot.compiler.toolchain.objects import install_kernel, kernel_folder, kernel_sources
from frot.dsl.messages.errors import FrotError

pytestmark = pytest.mark.usefixtures("one_compiler")


@pytest.fixture(scope="module")
def hasty(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return hasty_compiler(tmp_path_factory.mktemp("hasty"))


@pytest.fixture(scope="module")
def made(hasty: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("installed") / "made"
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("FROT_CC", str(hasty))
        install_kernel(kernel_folder(), [], folder)
    return folder


@pytest.fixture
def installed(made: Path, hasty: Path, folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The first run of an installation: its kernel is there, and the cache is empty."""
    monkeypatch.setenv("FROT_CC", str(hasty))
    monkeypatch.setenv("FROT_CACHE", str(folder.parent / f"{folder.name}-cache"))
    monkeypatch.setattr(cache, "installed_folder", lambda: made)
    return folder.parent / f"{folder.name}-cache"


def test_a_first_run_compiles_the_model_alone(installed: Path, door: Door) -> None:
    door("simulate", HOOP).succeeds()
    assert list(installed.glob("programs/*")) and not (installed / "kernels").exists()


def test_another_compiler_compiles_the_kernel_into_the_cache(
    installed: Path, hasty: Path, door: Door, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("FROT_CC", str(script(hasty.parent / "other-cc", f'exec "{hasty}" "$@"')))
    door("simulate", HOOP).succeeds()
    assert list(installed.glob("kernels/*/*.o"))


def test_it_is_copied_where_it_is_whole_and_made_anew_where_not(
    made: Path, hasty: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    notes = tmp_path / "calls"
    notes.touch()
    body = f'echo "$@" >> "{notes}"\nexec "{hasty}" "$@"'
    monkeypatch.setenv("FROT_CC", str(script(tmp_path / "counting-cc", body)))
    first, second, third = (tmp_path / name for name in ("first", "second", "third"))
    install_kernel(kernel_folder(), [made], first)  # `made` is another compiler's
    calls = notes.read_text().count("\n")
    assert calls == len(kernel_sources(kernel_folder())) + 3  # they are joined in three ways
    install_kernel(kernel_folder(), [made, first], second)
    install_kernel(kernel_folder(), [made, first], first)
    assert notes.read_text().count("\n") == calls
    assert sorted(p.name for p in second.rglob("*")) == sorted(p.name for p in first.rglob("*"))
    next(second.rglob("*.o")).write_bytes(b"")
    install_kernel(kernel_folder(), [second], third)
    assert notes.read_text().count("\n") == 2 * calls


def test_without_a_compiler_nothing_is_left(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for body in ("exit 1", "echo > /dev/null"):
        monkeypatch.setenv("FROT_CC", str(script(tmp_path / "cc", body)))
        with pytest.raises(FrotError):
            install_kernel(kernel_folder(), [], tmp_path / "made")
        assert not any(cache.is_whole(one) for one in tmp_path.glob("made/kernels/*"))
