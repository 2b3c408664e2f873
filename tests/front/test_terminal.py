"""A terminal acts on no character of a text: what cannot be printed is shown escaped."""

import pytest
from front_door import Door

import frot

# A colour in either way of writing the introducer, a bell, a change of direction.
RED, GREEN, BELL, TURNED = "\x1b[31m", "\x9b32m", "\x07", "\u202e"
TEXT = f"""// {RED}
model A "doc {RED}{GREEN}{TURNED} $x$ {BELL}"
  parameter Real k = 1 "of every rate {RED}";
  Real x(start = 1) "of x {GREEN}";
  body b: particle(mass = 1 kg) "a body {RED}";
initial
  x = 1 /* {RED} */;
equation
  der(x) = -k*x*(1 1/s) /* {RED} */;
  when x < 0.5 /* {RED} */ then
    assert(false, "{RED}red{GREEN}{TURNED}{BELL}", level = warning);
  end when;
  when x < /* {GREEN} */ 0.4 then
    terminate("{RED}bye");
  end when;
  assert(x > 0.1 /* {RED} */, "{RED}never{GREEN}");
  experiment(stop = 1 s);
end A;
"""
STAGES = ("tree", "instance", "mechanism", "reduced", "equations", "cost", "c")


def unprintable(text: str) -> set[str]:
    return {c for c in text if c != "\n" and not c.isprintable()}


@pytest.mark.parametrize(
    "words",
    [
        ("simulate",),
        ("simulate", "--plot", "a.png"),
        ("check",),
        ("check", "--json"),
        *(("check", "--emit", stage) for stage in STAGES),
        ("fmu", "--platforms", "native"),
    ],
    ids=" ".join,
)
def test_no_command_prints_a_control_character(words: tuple[str, ...], door: Door) -> None:
    answer = door(*words[:1], door.write(TEXT), *words[1:]).succeeds()
    assert not unprintable(answer.out + answer.err)


def test_messages_of_a_run_are_shown_escaped(door: Door) -> None:
    out = door("simulate", door.write(TEXT)).succeeds().out
    assert r"warning: \x1b[31mred\x9b32m\u202e\x07 at t = 0.69314718" in out
    assert r"terminate: \x1b[31mbye at t = " in out
    assert r"x < /* \x9b32m */ 0.4: false -> true at t = " in out
    events = frot.compile(TEXT).simulate().events
    assert not unprintable("".join(e.text + e.liaison for e in events))


def test_faults_are_shown_escaped(door: Door) -> None:
    broken = door.write(TEXT.replace("x > 0.1", "x > 0.9"))
    door("simulate", broken).refuses("E0906", r"\x1b[31mnever\x9b32m (assertion failed at t = ")
    wrong = door("check", door.write(TEXT.replace("= -k*x*", "= -k*y*")))
    wrong.refuses("E0201")
    assert r"der(x) = -k*y*(1 1/s) /* \x1b[31m */;" in wrong.err
    assert not unprintable(wrong.out + wrong.err)
