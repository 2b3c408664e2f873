"""What the documents say is what happens: their models run, their outputs are those printed."""

from __future__ import annotations

import re
import shutil
from dataclasses import dataclass
from pathlib import Path

import pytest
from all_platforms import compile_quickly

import frot

ROOT = Path(__file__).parents[2]
README = ROOT / "README.md"
TEXTS = sorted((ROOT / "models").glob("*.frot"))
# Packages are no models: tests/library runs every part of them.
PACKAGES = [p for p in TEXTS if re.search(r"^package ", p.read_text("utf-8"), re.MULTILINE)]
MODELS = [p for p in TEXTS if p not in PACKAGES]
# The models of the language's definition, copied.
EXAMPLES = ROOT / "tests" / "dsl" / "examples"
GIVEN = [p for p in MODELS if (EXAMPLES / p.name).is_file()]
FENCE = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
EVENT = re.compile(r"^  (?P<what>.+) at t = (?P<time>\S+)$", re.MULTILINE)


@dataclass(frozen=True)
class Block:
    """A fenced block; `model` is the last `frot` block before it, for a printed output."""

    language: str
    text: str
    place: str
    model: str = ""


def blocks() -> list[Block]:
    found: list[Block] = []
    for path in (README, *sorted((ROOT / "docs").rglob("*.md"))):
        document = path.read_text(encoding="utf-8")
        model = ""
        for fence in FENCE.finditer(document):
            line = document[: fence.start()].count("\n") + 1
            language, text = fence[1], fence[2]
            model = text if language == "frot" else model
            found.append(Block(language, text, f"{path.name}:{line}", model))
    return found


def in_language(language: str) -> list[object]:
    return [pytest.param(b, id=b.place) for b in blocks() if b.language == language]


def printed_runs() -> list[object]:
    return [
        pytest.param(b, id=b.place)
        for b in blocks()
        if b.language == "text" and b.model and EVENT.search(b.text)
    ]


def last_digit(number: str) -> float:
    """The value of a unit in the last digit written."""
    mantissa, _, exponent = number.partition("e")
    return 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


@pytest.mark.parametrize("block", in_language("frot"))
def test_every_model_of_a_document_checks_and_runs(block: Block) -> None:
    model = frot.compile(block.text)
    assert model.name in str(model.report())
    result = model.simulate()
    assert not result.program.balanced or result.balance.relative < 1e-6


@pytest.mark.parametrize("block", printed_runs())
def test_the_events_a_document_prints_are_those_of_the_run(block: Block) -> None:
    result = frot.compile(block.model).simulate()
    printed = [(m["what"], m["time"]) for m in EVENT.finditer(block.text)]
    happened = [event.text.rpartition(" at t = ")[0] for event in result.events]
    assert happened == [what for what, _ in printed]
    for event, (_, time) in zip(result.events, printed, strict=True):
        assert abs(event.time - float(time)) <= max(last_digit(time), 1e-12 * event.time)
    head = block.text.splitlines()[0]
    if not head.startswith(" "):
        assert head == result.summary().splitlines()[0]


@pytest.mark.parametrize("block", in_language("python"))
def test_every_python_block_of_a_document_runs(
    block: Block, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copytree(ROOT / "models", tmp_path / "models")
    monkeypatch.chdir(tmp_path)
    compile_quickly(monkeypatch)
    exec(compile(block.text, block.place, "exec"), {"__name__": "__main__"})
    for name in re.findall(r'(?:save|export_fmu)\("([^"]+)"', block.text):
        assert (tmp_path / name).stat().st_size > 0


@pytest.mark.parametrize("path", PACKAGES, ids=lambda p: p.stem)
def test_every_package_opens_with_what_it_holds(path: Path) -> None:
    assert path.read_text(encoding="utf-8").startswith("// ")
    assert (ROOT / "tests" / "library" / f"{path.stem.lower()}_bench.py").is_file()


@pytest.mark.parametrize("path", MODELS, ids=lambda p: p.stem)
def test_every_worked_model_runs_as_it_is_and_opens_with_its_physics(path: Path) -> None:
    assert path.read_text(encoding="utf-8").startswith("// ")
    result = frot.load(path).simulate()
    assert not result.program.balanced or result.balance.relative < 1e-6
    assert result.time[-1] == result.program.experiment.stop


@pytest.mark.parametrize("path", GIVEN, ids=lambda p: p.stem)
def test_a_worked_model_is_the_given_one_of_that_name(path: Path) -> None:
    assert path.read_bytes() == (EXAMPLES / path.name).read_bytes()


def test_the_model_of_the_readme_is_the_one_its_command_runs() -> None:
    (block,) = (b for b in blocks() if b.language == "frot" and b.place.startswith("README"))
    assert block.text == (ROOT / "models" / "backspin_hoop.frot").read_text(encoding="utf-8")


def test_the_files_the_documents_link_to_exist() -> None:
    for path in (README, *sorted((ROOT / "docs").rglob("*.md"))):
        prose = re.sub(r"`[^`]*`", "", path.read_text(encoding="utf-8"))
        for target in re.findall(r"\]\(([^)#:]+)\)", prose):
            assert (path.parent / target).exists(), f"{path.name}: {target}"
