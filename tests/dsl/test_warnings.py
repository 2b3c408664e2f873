"""Warnings: what is told of a sound model, and that sound examples are silent."""

from pathlib import Path

import pytest
from frot.dsl import Log, compile_text, load, render_log

HERE = Path(__file__).parent
EXAMPLES = [*sorted((HERE / "examples").glob("*.frot")), *sorted((HERE / "sound").glob("*.frot"))]
# Packages begin with a capital; they hold no model of their own.
MODELS = sorted((Path(__file__).parents[2] / "models").glob("[a-z]*.frot"))


def warnings(text: str) -> list[tuple[str, str]]:
    log = Log()
    assert compile_text(text, log) is not None, render_log(log)
    return [(d.code, d.message) for d in log]


@pytest.mark.parametrize("path", [*EXAMPLES, *MODELS], ids=lambda p: p.stem)
def test_sound_files_are_silent(path: Path) -> None:
    log = Log()
    load(path, log)
    assert {d.code for d in log} <= {"E0701"}, render_log(log)


def test_a_parameter_used_in_one_of_several_components_is_used() -> None:
    part = "model Part\n parameter Real a = 1;\n parameter Real b = 2;\n Real x = b;\nend Part;\n"
    whole = "model M\n Part p, q;\n Real y = q.a;\nend M;\n"
    assert warnings(part + whole) == []
    assert warnings(part + whole.replace("q.a", "q.b")) == [
        ("W0102", "parameter 'a' is used nowhere")
    ]


def test_an_unused_import_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "Lib.frot").write_text("model A\nend A;\nmodel B\nend B;\n")
    model = "model M\n A a;\nend M;\n"
    assert warnings(f"import Lib.A;\nimport Lib.B;\n{model}") == [
        ("W0101", "nothing of this import is used")
    ]
    assert warnings(f"import Lib.A;\nimport Lib.B;\n{model}model N\n B b;\n M m;\nend N;\n") == []


@pytest.mark.parametrize(
    ("declaration", "statement", "told"),
    [
        ("parameter Angle a = 30;", "bar.angle = a;", "30"),
        ("parameter Angle a = -45.5;", "bar.angle = a;", "-45.5"),
        ("", "bar.angle = 90;", "90"),
        ("", "guess(bar.angle = 90);", "90"),
        ("frame f on bar at (0, 0) m rotated(angle = 90);", "f.position = (0, 0) m;", "90"),
        ("Angle a = 90;", "bar.angle = a;", "90"),
        ("Angle a[2] = (90, 0.5);", "bar.angle = a[1];", "90"),
        ("output Angle a = if time > 1 s then 90 else 1;", "bar.angle = 1;", "90"),
        ("liaison p: rotoide(ground, bar) driven(angle = 90);", "", "90"),
        ("", "bar.angle = 0.7;", ""),
        ("", "bar.angle = 30 deg;", ""),
        ("", "bar.angle = 30 rad;", ""),
        ("parameter Angle a = 2*pi*3;", "bar.angle = a;", ""),
        ("parameter Real n = 30;", "bar.angle = n*(1 deg);", ""),
    ],
)
def test_an_angle_that_was_meant_in_degrees_is_told(
    declaration: str, statement: str, told: str
) -> None:
    text = (
        f"planar model M\n body bar: rod(mass = 1 kg, length = 1 m);\n {declaration}\n"
        f"initial\n {statement}\nend M;\n"
    )
    found = warnings(text)
    assert [code for code, _ in found] == (["W0105"] if told else [])
    assert all(f"is {told} rad" in message for _, message in found)


@pytest.mark.parametrize(
    ("at", "experiment", "told"),
    [
        (", at = t0", "stop = 2 s", "after the run ends at 2 s"),
        ("", "start = 1 s, stop = 2 s", "before the run begins at 1 s"),
        (", at = -1 s", "stop = 2 s", "before the run begins at 0 s"),
        (", at = 2 s", "stop = 2 s", ""),
        ("", "stop = 2 s", ""),
        (", at = t0", "start = 1 s", ""),
    ],
)
def test_an_impulse_outside_of_the_run_is_told(at: str, experiment: str, told: str) -> None:
    """By the defaults of parameters, and the experiment of the text."""
    found = warnings(
        "model M\n parameter Time t0 = 3 s;\n body b: particle(mass = 1 kg);\n"
        f" force i: impulse(b, value = (1, 0, 0) N.s{at});\n experiment({experiment});\n"
        f" output Time t = t0;\nend M;\n"
    )
    assert [code for code, _ in found] == (["W0106"] if told else [])
    assert all(told in message for _, message in found)
