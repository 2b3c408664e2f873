"""What the messages propose for usual slips: how the same is said in this language."""

import pytest
from frot.dsl import Log, compile_text


def told(text: str) -> list[tuple[str, str, str, str]]:
    log = Log()
    compile_text(text, log)
    return [(d.code, d.span.text if d.span else "", d.help, " ".join(d.notes)) for d in log]


def in_model(*statements: str, planar: bool = True) -> str:
    head = "planar model M" if planar else "model M"
    return "\n".join((head, "  body b: disc(mass = 1 kg, radius = 1 m);", *statements, "end M;\n"))


@pytest.mark.parametrize(
    ("statement", "help_text"),
    [
        ("body block = box(mass = 1 kg, size = (1, 1) m);", "'body block: ...'"),
        ("corps c = box(mass = 1 kg, size = (1, 1) m);", "'corps c: ...'"),
        ("liaison l = rotoide(ground, b);", "'liaison l: ...'"),
        ("joint j = revolute(ground, b);", "'joint j: ...'"),
        ("force push = on(b, value = (1, 0) N);", "'force push: ...'"),
        ("frame f = b;", "'frame f on ground at ...'"),
        ("curve c = line(through = (0, 0) m, direction = (1, 0));", "'curve c on ground: ...'"),
    ],
)
def test_a_thing_that_is_declared_by_an_equals_sign(statement: str, help_text: str) -> None:
    ((code, place, remedy, _),) = told(in_model(statement))
    assert (code, place) == ("E0101", "=") and help_text in remedy


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("[1, 0.5]", "(1, 0.5)"),
        ("[1 m, 0.5 m]", "(1 m, 0.5 m)"),
        ("[[1, 2], [3, 4]]", "((1, 2), (3, 4))"),
    ],
)
def test_brackets_where_a_tuple_is_meant(written: str, meant: str) -> None:
    ((code, _, remedy, _),) = told(in_model(f"initial\n  b.position = {written};"))
    assert code == "E0101" and remedy.endswith(f"'{meant}'")


@pytest.mark.parametrize("rest", ["[1, 2;", "[", "[]", "[" + "1, " * 100 + "1]"])
def test_brackets_that_show_nothing_have_an_example(rest: str) -> None:
    text = in_model(f"initial\n  b.position = {rest};")
    assert told(text)[0][2].startswith("an array is written")


PAIRS = "this model is in space: write 'planar model' where positions are pairs"


@pytest.mark.parametrize(
    ("statement", "remedy"),
    [
        ("initial\n  b.position = (1, 2) m;", PAIRS),
        ("initial\n  guess(b.velocity = (1, 2) m/s);", PAIRS),
        ("frame f on b at (1, 2) m;", PAIRS),
        ("force f: on(b, value = (1, 0) N);", PAIRS),
        ("body c: box(mass = 1 kg, size = (1, 2) m);", PAIRS),
        ("curve c on ground: line(through = (0, 0, 0) m, direction = (1, 0));", PAIRS),
        ("liaison l: contact_ponctuel(ground.line, b.rim);", "write 'planar model'"),
        ("initial\n  b.angle = 1 rad;", "write 'planar model'"),
    ],
)
def test_a_planar_model_that_does_not_say_so(statement: str, remedy: str) -> None:
    ((code, _, help_text, _),) = told(in_model(statement, planar=False))
    assert code in ("E0301", "E0203") and remedy in help_text


@pytest.mark.parametrize(
    "statement",
    [
        "initial\n  b.position = (1, 2, 0) m;",
        "initial\n  b.orientation = (1, 0, 0, 0);",
        "liaison l: contact_ponctuel(ground.plane, b.rim);",
    ],
)
def test_a_model_in_space_that_says_it_is_planar(statement: str) -> None:
    ((code, _, help_text, _),) = told(in_model(statement))
    assert code in ("E0301", "E0203") and "planar" in help_text


@pytest.mark.parametrize(
    ("condition", "remedy"),
    [
        ('l.mode == "stick"', "'mode == stick'"),
        ('l.mode <> "open"', "'mode <> open'"),
        ('l.mode == "sliding"', "a mode is one of open, stick, slip"),
        ('colour == "red"', "Colour.red"),
    ],
)
def test_a_mode_that_is_compared_with_a_text(condition: str, remedy: str) -> None:
    text = in_model(
        "liaison l: contact_ponctuel(ground.line, b.rim);", f"output Boolean x = {condition};"
    )
    ((code, _, help_text, _),) = told(text)
    assert code == "E0101" and remedy in help_text


@pytest.mark.parametrize("package", ["Rotational", "Translational"])
def test_an_import_of_a_word_of_the_language(package: str) -> None:
    flange = f"{package}Flange"
    text = f"import {package}.{flange};\nmodel M\n  {flange} f;\nend M;\n"
    first = told(text)[0]
    assert first[:3] == (
        "E0210",
        flange,
        f"'{flange}' is a word of the language: leave the import out",
    )


@pytest.mark.parametrize(
    ("statement", "planar", "listed"),
    [
        ("body c: boulder(mass = 1 kg);", True, "particle, rod, disc, ring, ellipse, box"),
        ("body c: boulder(mass = 1 kg);", False, "sphere, shell, ellipsoid, cylinder"),
        ("liaison l: glue(ground, b);", True, "encastrement, rotoide, prismatique, tige"),
        ("joint l: glue(ground, b);", False, "weld, revolute, prismatic, cylindrical, screw"),
        ("force f: kick(b);", True, "on, couple, spring, damper, attraction, drag"),
        ("curve c on b: wave(1 m);", True, "line, circle, ellipse, parametric"),
        ("surface s on b: torus(1 m);", False, "plane, sphere, ellipsoid, cylinder, parametric"),
        ("liaison l: rotoide(ground, b) with glue(1);", True, "coulomb, rolling_resistance"),
        ("output Real x = bessel(1);", True, "sin, cos, tan"),
    ],
)
def test_an_unknown_kind_is_told_with_those_that_there_are(
    statement: str, planar: bool, listed: str
) -> None:
    ((code, _, _, notes),) = told(in_model(statement, planar=planar))
    assert code == "E0202" and notes.startswith("there are: ") and listed in notes
