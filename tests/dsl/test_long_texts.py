"""Texts of any length: time and memory in proportion to it, or a limit that is named."""

import resource
import subprocess
import sys
import time
from pathlib import Path

import pytest
from frot.dsl import Log, compile_text, parse, render_log
from frot.dsl.messages.source import Source

END = "\nmodel M\n  Real x = 1;\nend M;\n"


def codes(text: str) -> list[str]:
    log = Log()
    compile_text(text, log)
    assert len(render_log(log)) < 100_000
    return [d.code for d in log]


def seconds(text: str) -> float:
    begun = time.process_time()
    parse(Source("long.frot", text), Log())
    return time.process_time() - begun


LONG = {
    "comment": lambda n: "/* " + "x" * n + " */" + END,
    "stars": lambda n: "/*" + "*" * n + "*/" + END,
    "lines": lambda n: "/* " + "x\n" * (n // 2) + "*/" + END,
    "documentation": lambda n: 'model M "' + "x" * n + '"\n  Real x = 1;\nend M;\n',
    "blanks after a word": lambda n: "model M\n  body" + " " * n + "b: particle(1 kg);\nend M;\n",
}


@pytest.mark.parametrize("what", LONG)
def test_a_long_piece_takes_memory_in_proportion(what: str, tmp_path: Path) -> None:
    """50 MB are read in 1 GiB: a matcher that keeps a way back for each character takes 5."""
    file = tmp_path / "long.frot"
    file.write_text(LONG[what](50_000_000), encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-m", "frot.command_line", "check", str(file)],
        capture_output=True,
        text=True,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (2**30, 2**30)),
        env={"OPENBLAS_NUM_THREADS": "1", "PATH": "/usr/bin:/bin", "HOME": str(tmp_path)},
        check=False,
    )
    assert done.returncode == 0, done.stderr[-2000:]


@pytest.mark.parametrize(
    "part",
    ["/* ", "end /* x ", '" ', "body x ", "= "],
    ids=["comments", "ends", "quotes", "words", "signs"],
)
def test_faults_on_a_long_line_take_time_in_proportion(part: str) -> None:
    def text(count: int) -> str:
        return "model M\n  Real x = 1; " + part * count + "\nend M;\n"

    short, long = (min(seconds(text(count)) for _ in range(2)) for count in (20_000, 80_000))
    # four times as much; sixteen times where the line is read anew for each part
    assert long < 9 * short + 0.1


@pytest.mark.parametrize(
    "text",
    [
        "  Real x = " + " + ".join(["1"] * 60_000) + ";",
        "  Real x = " + "*".join(["1.0"] * 60_000) + ";",
        "  Real x = " + "(" * 60_000 + "1;",
        "  Real x = " + "-" * 60_000 + "1;",
        "  Real x = " + "sin(" * 5_000 + "1" + ")" * 5_000 + ";",
        "  Real x = " + "if time > 1 s then 1 else " * 5_000 + "1;",
        "  Real x;\nequation\n" + "if time > 1 s then " * 3_000 + "x = 1;" + "end if;" * 3_000,
        "  Real x;\nequation\n" + "for k in 1:1 loop " * 3_000 + "x = 1;" + "end for;" * 3_000,
        "".join(f"model M{k}\n" for k in range(3_000))
        + "".join(f"end M{k};\n" for k in reversed(range(3_000))),
    ],
    ids=["sum", "product", "brackets", "signs", "calls", "choices", "ifs", "loops", "models"],
)
def test_what_is_too_deep_is_one_message(text: str) -> None:
    assert codes(f"model M\n{text}\nend M;\n") == ["E0108"]


def test_a_number_of_a_million_digits_is_not_repeated() -> None:
    assert codes("model M\n  Real x = " + "1" * 1_000_000 + ";\nend M;\n") == ["E0403"]


def test_as_many_parameters_as_there_may_be() -> None:
    """Each counts for one of the largest model."""
    text = "".join(f"  parameter Real p{k} = {k};\n" for k in range(20_000))
    assert set(codes(f"model M\n{text}  Real x = 1;\nend M;\n")) <= {"W0102"}


@pytest.mark.parametrize("levels", [20, 80])
def test_blocks_may_stand_in_one_another(levels: int) -> None:
    text = "".join(f"if time > {k + 1} s then x = {k}; else " for k in range(levels))
    text = f"model M\n  Real x;\nequation\n{text}x = 1;{'end if;' * levels}\nend M;\n"
    assert codes(text) == []
