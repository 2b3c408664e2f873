"""Text to tree: the grammar, spellings, literals, recovery, and texts that are no texts."""

import logging
import os
import stat
from pathlib import Path

import pytest
from frot.dsl import Log, Source, compile_text, dump, parse
from frot.dsl.text import tree
from frot.dsl.text.grammar import GRAMMAR, OPTIONS

EXAMPLES = sorted((Path(__file__).parent / "examples").glob("*.frot"))


def parsed(text: str) -> tree.Tree:
    log = Log()
    found = parse(Source("<text>", text), log)
    assert not log.diagnostics, [d.message for d in log]
    return found


def value(text: str) -> tree.Expression:
    """The expression in a parameter."""
    model = parsed(f"planar model M\n parameter Real x = {text};\nend M;\n").elements[0]
    found = model.elements[0].declared[0].value
    assert found.span.text == text
    return found


def shape(node: tree.Expression) -> object:
    """An expression as nested tuples."""
    match node:
        case tree.Number(value=v, unit=u):
            return (v, u) if u else v
        case tree.Name(text=t):
            return t
        case tree.Infix(op=op, left=a, right=b):
            return (op, shape(a), shape(b))
        case tree.Prefix(op=op, operand=a):
            return (op, shape(a))
        case tree.Tuple(items=items, unit=u):
            return (*map(shape, items), u)
        case tree.Member(operand=a, name=n):
            return (shape(a), "." + n.text)
        case tree.Conditional(condition=c, yes=a, no=b):
            return ("if", shape(c), shape(a), shape(b))
    return type(node).__name__


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda p: p.stem)
def test_every_example_parses(path: Path) -> None:
    found = parsed(path.read_text(encoding="utf-8"))
    assert all(isinstance(e, tree.Definition) for e in found.elements)
    assert not found.lost


def test_the_grammar_has_no_conflicts(caplog: pytest.LogCaptureFixture) -> None:
    import lark

    lark.logger.setLevel(logging.DEBUG)
    try:
        with caplog.at_level(logging.DEBUG, logger="lark"):
            options = {**OPTIONS, "lexer": "contextual"}
            lark.Lark(GRAMMAR.read_text(encoding="utf-8"), debug=True, **options)
    finally:
        lark.logger.setLevel(logging.CRITICAL + 1)
    told = [r.getMessage() for r in caplog.records]
    assert not [m for m in told if "onflict" in m or "ollision" in m]


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("a + b*c", ("+", "a", ("*", "b", "c"))),
        ("a - b - c", ("-", ("-", "a", "b"), "c")),
        ("a/b*c", ("*", ("/", "a", "b"), "c")),
        ("a^b^c", ("^", "a", ("^", "b", "c"))),
        ("-a^2", ("-", ("^", "a", 2.0))),
        ("-a*b", ("-", ("*", "a", "b"))),
        ("-a + b", ("+", ("-", "a"), "b")),
        ("a*-b", ("*", "a", ("-", "b"))),
        ("a^-2", ("^", "a", ("-", 2.0))),
        ("(a + b)*c", ("*", ("+", "a", "b"), "c")),
        ("a + b < c and d", ("and", ("<", ("+", "a", "b"), "c"), "d")),
        ("not a == b or c", ("or", ("not", ("==", "a", "b")), "c")),
        ("if a then b else if c then d else e", ("if", "a", "b", ("if", "c", "d", "e"))),
        ("a.b.c", (("a", ".b"), ".c")),
    ],
)
def test_precedence(text: str, wanted: object) -> None:
    model = parsed(f"planar model M\n parameter Real x = {text};\nend M;\n").elements[0]
    assert shape(model.elements[0].declared[0].value) == wanted


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("12 mm", (12.0, "mm")),
        ("9.81 m/s^2", (9.81, "m/s^2")),
        ("4 N.m", (4.0, "N.m")),
        ("1e-5 kg.m^2", (1e-5, "kg.m^2")),
        ("3 1/s", (3.0, "1/s")),
        ("5 %", (5.0, "%")),
        ("20 °", (20.0, "°")),
        ("-90 deg", ("-", (90.0, "deg"))),
        ("2*x", ("*", 2.0, "x")),
        ("3 m / s", ("/", (3.0, "m"), "s")),
        ("3 m*x", ("*", (3.0, "m"), "x")),
        ("1 m/s*t", ("*", (1.0, "m/s"), "t")),
        ("1 and b", ("and", 1.0, "b")),
        ("if 1 then 2 else 3", ("if", 1.0, 2.0, 3.0)),
        ("(1, 0, 2) m/s", (1.0, 0.0, 2.0, "m/s")),
        ("(0, 0)", (0.0, 0.0, "")),
    ],
)
def test_units_are_glued_to_their_number(text: str, wanted: object) -> None:
    assert shape(value(text)) == wanted


@pytest.mark.parametrize(
    "word", ["frame", "body", "liaison", "line", "initial", "world", "end1", "m"]
)
def test_words_of_the_language_can_be_names_where_no_keyword_fits(word: str) -> None:
    model = parsed(f"planar model M\n parameter Real {word} = 2;\nend M;\n").elements[0]
    assert model.elements[0].declared[0].name.text == word


def test_the_two_spellings_give_one_node_and_are_kept() -> None:
    text = """planar model M
      corps b: particle(mass = 1 kg);
      repère f on b at (0, 0) m;
      repere g on b;
      joint j: rotoide(ground, b) avec coulomb(0.2);
      effort e: on(b, value = (1, 0) N);
    end M;
    """
    found = parsed(text).elements[0].elements
    assert [(type(e).__name__, e.keyword) for e in found] == [
        ("Body", "corps"),
        ("Frame", "repère"),
        ("Frame", "repere"),
        ("Liaison", "joint"),
        ("Force", "effort"),
    ]


def test_identifiers_are_composed() -> None:
    model = parsed("planar model M\n parameter Real e\u0301 = 2;\nend M;\n").elements[0]
    assert model.elements[0].declared[0].name.text == "\u00e9"


def test_the_statements_after_a_fault_are_read() -> None:
    log = Log()
    text = "planar model M\n body b: disc(mass 1 kg;\n parameter Real x = 2;\nend M;\n"
    found = parse(Source("<text>", text), log)
    assert len(log.diagnostics) == 1
    assert [type(e).__name__ for e in found.elements[0].elements] == ["Component"]
    assert "b" in found.lost


@pytest.mark.parametrize(
    "text",
    [
        "",
        "\0",
        "\ud800",
        "\ufeff",
        "\xff\xfe\x00\x01 binary",
        ";" * 5000,
        "(" * 100_000,
        "end " * 5000,
        "planar model M\n" * 300,
        "planar model M parameter Real x = " + "(" * 5000 + "1" + ")" * 5000 + "; end M;",
        "planar model M parameter Real x = " + "1+" * 5000 + "1; end M;",
        "planar model M parameter Real x = " + "-" * 5000 + "1; end M;",
        "planar model M parameter Real x = " + "2^" * 5000 + "1; end M;",
        "planar model M parameter Real x = " + "sin(" * 99 + "1" + ")" * 99 + "; end M;",
        "planar model M parameter Real x = " + "(1+" * 120 + "1" + ")" * 120 + "; end M;",
        "planar model M parameter Real x = " + "if true then 1 else " * 5000 + "1; end M;",
        "planar model M parameter Real x = a" + ".b" * 5000 + "; end M;",
        "planar model M initial " + "if true then " * 3000 + " end M;",
    ],
    ids=range(18),
)
def test_no_text_raises(text: str) -> None:
    log = Log()
    model = compile_text(text, log)
    assert (model is None) == log.failed


def test_an_expression_at_the_limits_is_accepted() -> None:
    log = Log()
    for text in ("1+" * 150 + "1", "(" * 90 + "1" + ")" * 90, "sin(" * 60 + "1" + ")" * 60):
        assert compile_text(f"planar model M parameter Real x = {text}; end M;", log), log


def test_a_long_chain_of_parameters_takes_no_stack() -> None:
    lines = [f"parameter Real a{i} = a{i + 1};" for i in range(3000)]
    text = "planar model M\n" + "\n".join(lines) + "\nparameter Real a3000 = 1;\nend M;\n"
    log = Log()
    assert compile_text(text, log) is not None


def test_a_folder_that_cannot_be_written_is_no_fault(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from frot.dsl.text import grammar

    monkeypatch.setattr(grammar, "MADE", tmp_path / "none")
    blocked = tmp_path / "file"
    blocked.write_text("")
    monkeypatch.setenv("FROT_CACHE", str(blocked / "under"))
    built = grammar.grammar.__wrapped__()
    assert built.parse_interactive("") is not None
    kept = tmp_path / "cache"
    monkeypatch.setenv("FROT_CACHE", str(kept))
    grammar.grammar.__wrapped__()
    assert [p.suffix for p in kept.iterdir()] == [".bin"]
    assert stat.S_ISREG(os.stat(next(kept.iterdir())).st_mode)


def test_tables_of_the_installation_are_taken_and_damaged_ones_made_anew(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from frot.dsl.text import grammar

    made, kept = tmp_path / "made", tmp_path / "cache"
    grammar.make_tables(made)
    monkeypatch.setattr(grammar, "MADE", made)
    monkeypatch.setenv("FROT_CACHE", str(kept))
    (tables,) = made.iterdir()
    whole = tables.stat().st_size
    for content in (tables.read_bytes(), b"none", tables.read_bytes()[: whole // 2]):
        tables.write_bytes(content)
        assert grammar.grammar.__wrapped__().parse_interactive("") is not None
        assert not kept.exists() and tables.stat().st_size > 0.9 * whole


def test_dump_shows_a_tree() -> None:
    shown = dump(parsed("planar model M\n parameter Length r = 12 mm;\nend M;\n"))
    assert "unit: 'mm'" in shown
    assert shown.startswith("Tree")
