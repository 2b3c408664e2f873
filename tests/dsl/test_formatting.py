"""The formatter: what it sets, what it leaves to the author, and what it never changes."""

import random
import re
import time
from pathlib import Path

import pytest
from frot.dsl import CODES, Log, Source, dump, format_text, parse
from frot.dsl.text.parsing import Lexeme
from frot.dsl.text.tree import Tree
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

HERE = Path(__file__).parent
EXAMPLES = [*sorted((HERE / "examples").glob("*.frot")), *sorted((HERE / "sound").glob("*.frot"))]
# Statements that no example has.
MORE = """import Library.Parts.*;
import Library.Gear as Wheel;
type Turns = Real(unit = "1/min") "turns a minute";

package Parts
  record Data
    Real a[3], b = 1 "b";
  end Data;
  function cube
    input Real x;
    output Real y;
  equation
    y = x^3;
  end cube;
end Parts;

liaison HalfRate(a: frame, b: frame, ratio = 0.5) "b turns at half the rate of a"
  kinematic b.angular_velocity.z - ratio*a.angular_velocity.z = 0;      // along z
end HalfRate;

loi Softer(Real mu) tangential = mu*slip;
end Softer;

/* A comment
   of several lines */
model M
  parameter Real k(unit = "N.m/A") = 0.05 "constant";
  Part p(final a = 2, final q(start = 3), r.s = 1);
  final constant Real t[2, 2] = ((1, 20), (300, 4));
  corps b: solid(mass = 1 kg, inertia = (1, 2, 3) kg.m^2);
  repère f on b at (0, 0, 0) m rotated(axis = y, angle = 20 deg) "doc";
  joint j: rotoide(ground, f, axis = y) driven(angle = -2*pi*time/(3 s)) avec coulomb(0.1);
  effort e: on(b, value = if time < 1 s then (1, 0, 0) N else -(1, 0, 0) N);
initial
  guess(b.position.x = 1 m);
equation
  for i in 1:2 loop
    x[i] = (3 m / (2 s))*t[i, 1]^2 + 2 m / v;
  end for;
  if not (k > 1 and k <= 2) or k == 3 then
    y = -x[1] - -2;
  elseif (if k <> 1 then true else false) then
    y = 2 m ^ 2;
  else
    y = +1; // positive
  end if;
  when edge(a) then reinit(v, -e*pre(v)); end when;
  when sample(0 s, 1 s) then
    n = pre(n) + 1;
  elsewhen b then
    n = 0;
  end when;
end M;
"""
TEXTS = [*(p.read_text(encoding="utf-8") for p in EXAMPLES), MORE]
GAPS = [" ", "  ", "     ", "\t", "\n", "\r\n", "\r", "\n\n\n\n", "\u00a0", "\f", "\n        "]
GAPS += [" /* c */ ", " /**/", "\n// d  \n", " // e\r\n", "\n/* f\n   g */\n", "\n  // h\n\n"]


def read(text: str) -> tuple[Tree, list[Lexeme]]:
    log = Log()
    tokens: list[Lexeme] = []
    tree = parse(Source("<text>", text), log, tokens)
    assert not log.failed, [(d.message, d.span and d.span.place) for d in log]
    return tree, tokens


def comments_of(text: str, tokens: list[Lexeme]) -> list[str]:
    """The comments, blanks apart."""
    found = []
    offset = 0
    for token in tokens:
        found += re.findall(r"//[^\n]*|/\*.*?\*/", text[offset : token.start], re.DOTALL)
        offset = token.end
    found += re.findall(r"//[^\n]*|/\*.*?\*/", text[offset:], re.DOTALL)
    return ["".join(comment.split()) for comment in found]


def check_form(text: str) -> str:
    """What holds for the form of every text without faults."""
    form = format_text(text)
    (tree, tokens), (same, own) = read(text), read(form)
    assert dump(same) == dump(tree)
    assert comments_of(form, own) == comments_of(text, tokens)
    assert format_text(form) == form
    assert form.endswith("\n")
    assert not form.startswith("\n")
    assert not form.endswith("\n\n")
    assert "\n\n\n" not in form
    assert not re.search(r"[ \t]\n|\r\n", form)
    return form


def formed(body: str, wanted: str) -> None:
    """Check the form of statements of a model."""
    form = check_form(f"model M\n{body}\nend M;\n")
    assert form == f"model M\n{wanted}\nend M;\n"


@pytest.mark.parametrize("text", TEXTS, ids=[*(p.stem for p in EXAMPLES), "more"])
def test_the_examples_have_their_usual_form(text: str) -> None:
    if text == MORE:
        # One law stands on one line with its header, to be parted.
        wanted = text.replace("(Real mu) tang", "(Real mu)\n  tang")
        assert check_form(text) == wanted
    else:
        assert check_form(text) == text


@pytest.mark.parametrize("code", [c for c in CODES if CODES[c].example])
def test_the_examples_of_the_codes_keep_their_tree(code: str) -> None:
    text = CODES[code].example
    log = Log()
    form = format_text(text, log)
    if log.failed:
        assert form == text
    else:
        check_form(text)


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("x=a+b*c^2/d", "x = a + b*c^2/d"),
        ("x = a * b", "x = a*b"),
        ("x = - a * - b - - c", "x = -a*-b - -c"),
        ("x = not(a and b)", "x = not (a and b)"),
        ("x = a<=b", "x = a <= b"),
        ("x = (1,0,- 2)  m/s", "x = (1, 0, -2) m/s"),
        ("x = 3   m", "x = 3 m"),
        ("x = 3 m/s", "x = 3 m/s"),
        ("x = 3 m /s", "x = 3 m / s"),
        ("x = 3 m ^ 2", "x = 3 m ^ 2"),
        ("x = (1, 2) m / s", "x = (1, 2) m / s"),
        ("x = 3 m * s", "x = 3 m*s"),
        ("(0, 0)kg = 1", "(0, 0)kg = 1"),
        ("x = f ( a , b = 2 ) . c [ 1 , 2 : n ]", "x = f(a, b = 2).c[1, 2:n]"),
        ("x = a//* not a quotient */ b".replace("//*", "/ /*"), "x = a/ /* not a quotient */ b"),
        ("x = if a then b else(c)", "x = if a then b else (c)"),
        ("body b:ring(mass=1 kg)", "body b: ring(mass = 1 kg)"),
        ("joint j:tige(a,b)with coulomb(.1)", "joint j: tige(a, b) with coulomb(.1)"),
        ('Real k(unit="N")=1"doc"', 'Real k(unit = "N") = 1 "doc"'),
    ],
)
def test_blanks(text: str, wanted: str) -> None:
    formed(f"  {text} ;", f"  {wanted};")


def test_margins() -> None:
    formed(
        """parameter Real a = 1;
            initial
       x = 1;
   equation
          when a then if b then
    x = 1; else
       x = 2; end if; end when;
          experiment(stop = 1 s);""",
        """  parameter Real a = 1;
initial
  x = 1;
equation
  when a then
    if b then
      x = 1;
    else
      x = 2;
    end if;
  end when;
  experiment(stop = 1 s);""",
    )


def test_a_definition_takes_lines_of_its_own() -> None:
    text = "planar model A body b: particle(mass = 1 kg); initial b.x = 1; end A; model B end B;"
    assert check_form(text) == (
        "planar model A\n  body b: particle(mass = 1 kg);\ninitial\n  b.x = 1;\nend A;\n"
        "model B\nend B;\n"
    )


def test_what_stands_on_one_line_may_stay_there() -> None:
    formed(
        "Pin p;   Pin n;\nequation when a then b = 1; end when;",
        "  Pin p; Pin n;\nequation\n  when a then b = 1; end when;",
    )


def test_lines_inside_of_a_statement() -> None:
    formed(
        """  liaison a: tige(b, c)
 with coulomb(0.1),
            restitution(0);
  x = f(a,
        b);
  experiment(
        stop = 1 s,

        method = auto
        );
  y = a
          + b;""",
        """  liaison a: tige(b, c)
    with coulomb(0.1),
    restitution(0);
  x = f(a,
        b);
  experiment(
    stop = 1 s,
    method = auto
  );
  y = a
    + b;""",
    )


def test_a_line_stays_below_what_it_was_put_below() -> None:
    formed(
        "    force f:on(a,\n               value = b\n                       + c);",
        "  force f: on(a,\n              value = b\n                      + c);",
    )


def test_columns_follow_when_a_blank_is_put_in() -> None:
    formed(
        """\
    parameter Length r =1 m     "radius";
    parameter Real   mu=0.25    "friction";
    parameter Length ll=2 m     "length"; // a
    body a:   ring(mass=1 kg);            // b
    body abc: ring(mass=10 kg, radius=r); // c""",
        """\
  parameter Length r  = 1 m     "radius";
  parameter Real   mu = 0.25    "friction";
  parameter Length ll = 2 m     "length";   // a
  body a:   ring(mass = 1 kg);              // b
  body abc: ring(mass = 10 kg, radius = r); // c""",
    )


def test_numbers_line_up_at_their_ends() -> None:
    formed(
        "   Length a =  80 mm;\n   Length b = 240 mm;\n   Length c =  -5 mm;",
        "  Length a =  80 mm;\n  Length b = 240 mm;\n  Length c =  -5 mm;",
    )


def test_blanks_that_line_up_nothing_are_taken_out() -> None:
    formed(
        "  Length a  =  80 mm;\n\n  Mass   b  = 240 kg;\n  Real x  = 1;\n  Real y  = 2;",
        "  Length a = 80 mm;\n\n  Mass b = 240 kg;\n  Real x = 1;\n  Real y = 2;",
    )


def test_comments_stay_where_they_belong() -> None:
    text = """\
// before


 model M // header
        // of a
   Real a;     // far
      /* of b
           second line */
   Real b; /* near */
// at the margin
initial
   // of the start
  a = 1;
      // the last
end M;
      // after"""
    assert (
        check_form(text)
        == """\
// before

model M // header
  // of a
  Real a;     // far
  /* of b
       second line */
  Real b; /* near */
// at the margin
initial
  // of the start
  a = 1;
  // the last
end M;
// after
"""
    )


def test_the_spelling_is_the_authors() -> None:
    formed(
        "corps é: particle(mass=1 kg);\nrepe\u0300re f on é;\n"
        "joint j: libre(é, f) avec viscous(1);",
        "  corps é: particle(mass = 1 kg);\n  repe\u0300re f on é;\n"
        "  joint j: libre(é, f) avec viscous(1);",
    )


def test_a_text_with_faults_is_left_and_its_faults_told() -> None:
    log = Log()
    text = "model   M\n  body b ring();\nend N;\n"
    assert format_text(text, log, "m.frot") == text
    assert {d.code for d in log} == {"E0101", "E0105"}
    assert all(d.span is not None and d.span.source.name == "m.frot" for d in log)


@pytest.mark.parametrize("text", ["", " \n\n", "\n// only a comment", "/* a */ // b"])
def test_texts_without_statements(text: str) -> None:
    form = format_text(text)
    assert form == (f"{text.strip()}\n" if text.strip() else "")


def disorder(text: str, chance: random.Random, much: float) -> str:
    """The text with other blanks and more comments between its tokens."""
    parts: list[str] = []
    offset = 0
    for token in read(text)[1]:
        gap = text[offset : token.start]
        if chance.random() < much:
            gap += chance.choice(GAPS)
        elif gap.isspace() and chance.random() < much:
            gap = chance.choice(GAPS)
        parts += (gap, text[token.start : token.end])
        offset = token.end
    return "".join([*parts, text[offset:]])


@settings(max_examples=120, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.sampled_from(TEXTS), st.randoms(use_true_random=False), st.sampled_from([0.02, 0.1, 0.6]))
def test_any_blanks_and_comments_keep_the_tree_and_settle_at_once(
    text: str, chance: random.Random, much: float
) -> None:
    check_form(disorder(text, chance, much))


def test_a_long_text_takes_linear_time() -> None:
    """Sixteen times the lines: 16 times the time, where a square law would take 256."""

    def seconds(lines: int) -> float:
        text = "\n".join(
            f"  parameter Real {'long' * (i % 3)}a{i}   = {i};  // c" for i in range(lines)
        )
        begun = time.process_time()
        format_text(f"model M\n{text}\nend M;\n")
        return time.process_time() - begun

    seconds(1)
    short = min(seconds(250) for _ in range(3))
    assert seconds(4000) < 64 * short
