"""The layout of messages."""

import re

from frot.dsl import CODES, Diagnostic, Label, Log, Source, Span, render, render_log


def at(text: str, part: str, name: str = "a.frot") -> Span:
    start = text.index(part)
    return Span(Source(name, text), start, start + len(part))


def test_the_layout() -> None:
    text = "line one\n  liaison A: rotoide(crank.tipp, b);\n"
    span = at(text, "tipp", "slider.frot")
    label = Label(at(text, "one"), "declared here")
    message = "no frame 'tipp' on body 'crank'"
    shown = render(
        Diagnostic("E0203", message, span, "here", (label,), ("a note",), "did you mean 'tip'?")
    )
    assert shown == "\n".join(
        [
            "error[E0203]: no frame 'tipp' on body 'crank'",
            " --> slider.frot:2:28",
            "  |",
            "2 |   liaison A: rotoide(crank.tipp, b);",
            "  |                            ^^^^ here",
            "1 | line one",
            "  |      --- declared here",
            "  = note: a note",
            "  = help: did you mean 'tip'?",
        ]
    )


def test_carets_stand_below_tabs_and_wide_characters() -> None:
    text = "\tb = 漢é x;\n"
    lines = render(Diagnostic("E0101", "m", at(text, "x"))).splitlines()
    before = lines[3].partition("x")[0]
    # 漢 takes two columns of a terminal.
    assert lines[4].index("^") == len(before) + 1
    assert "\t" not in lines[3]


def test_a_span_at_the_end_of_the_text() -> None:
    for text in ("", "abc", "abc\n"):
        span = Span(Source("a.frot", text), len(text), len(text))
        assert render(Diagnostic("E0104", "m", span)).count("^") == 1


def test_a_span_of_several_lines_shows_its_first_and_last() -> None:
    text = "aa bb\ncc\n  dd ee\n"
    span = Span(Source("a.frot", text), 3, text.index(" ee"))
    lines = render(Diagnostic("E0101", "m", span, "whole")).splitlines()
    assert lines[3:7] == ["1 | aa bb", "  |    ^^", "3 |   dd ee", "  |   ^^ whole"]


def test_a_message_without_its_own_help_has_that_of_its_code() -> None:
    lines = render(Diagnostic("E0401", "m", None)).splitlines()
    assert lines[-1] == f"  = help: {CODES['E0401'].remedy}"


def test_without_a_place() -> None:
    shown = render(Diagnostic("E0801", "no C compiler", None, notes=("n",), help="h"))
    assert shown.splitlines() == ["error[E0801]: no C compiler", "  = note: n", "  = help: h"]


def test_control_characters_are_not_printed() -> None:
    text = "x = \x1b[31m;\n"
    shown = render(Diagnostic("E0101", "bad \x1b", at(text, "31"))).splitlines()
    assert shown[0] == r"error[E0101]: bad \x1b"
    assert shown[3] == r"1 | x = \x1b[31m;" and shown[4].index("^^") == shown[3].index("31")


def test_colours_change_nothing_but_colours() -> None:
    text = "x = 2;\n"
    diagnostic = Diagnostic("E0101", "m", at(text, "2"), "c", notes=("n",), help="h")
    coloured = render(diagnostic, colour=True)
    assert coloured != render(diagnostic)
    assert re.sub(r"\x1b\[[0-9;]*m", "", coloured) == render(diagnostic)


def test_at_most_twenty_in_the_order_of_the_text() -> None:
    text = "x" * 30
    source = Source("a.frot", text)
    log = Log()
    for start in reversed(range(30)):
        log.report("E0101", f"m{start}", Span(source, start, start + 1))
    shown = render_log(log)
    assert shown.endswith("... and 10 more")
    assert re.findall(r"m\d+", shown) == [f"m{i}" for i in range(20)]
