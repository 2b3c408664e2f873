"""Slips of the pen: each message names the slip and its remedy."""

import pytest
from frot.dsl import Log, compile_text, format_text


def told(text: str) -> list[tuple[str, str, str]]:
    log = Log()
    compile_text(text, log)
    return [(d.code, d.message, d.help) for d in log if d.is_error]


def only(text: str) -> tuple[str, str, str]:
    found = told(text)
    assert len(found) == 1, found
    return found[0]


MODEL = "model M\n Length a; Real b;\nequation\n {}\nend M;\n"


@pytest.mark.parametrize(
    ("slip", "words", "remedy"),
    [
        ("b := 3;", "':='", "'='"),
        ("b = 0,3;", "comma in a number", "'0.3'"),
        ("a = 10,25 mm;", "comma in a number", "'10.25'"),
        ("b = 3 \u2212 2;", "minus sign", "write '-'"),
        ("b = 3 – 2;", "en dash", "write '-'"),
        ("b = 3 × 2;", "multiplication sign", "write '*'"),
        ("a = 3 N·m;", "middle dot", "'.' in a unit"),
        ("assert(b > 0, “no”);", "left double quotation mark", "write '\"'"),
        ('assert(b ≥ 0, "no");', "greater-than or equal to", "write '>='"),
        ("b = 3; /* and so on\n a = 1 m;", "comment is not closed", "'*/'"),
        ("b = 3 /* and so on\n ;", "comment is not closed", "'*/'"),
        ("b = max(1; 2; 3);", "';' inside of parentheses", "','"),
        ("b = (if b != 2 then 1 else 0);", "'!'", "'a <> b'"),
        ("b = (if b > 2 && b < 3 then 1 else 0);", "'&'", "'and'"),
        ("b = (if b > 2 || b < 1 then 1 else 0);", "'|'", "'or'"),
        ("# b = 3;", "'#'", "'// ...'"),
        ("b = 3 % 2;", "after '%'", "'mod(a, b)'"),
        ("b += 2;", "'+='", "pre(x) + ..."),
        ("b = 3²;", "glued together", "'3^2'"),
        ("b = 3°;", "'°'", "'20 °'"),
        ("b = 3; */", "without a comment to end", "'/*'"),
        ("b = 3 + 2);", "closes nothing", "put '('"),
        ("a = 3 m);", "closes nothing", "put '('"),
        ("b = sum(A[1, :]);", "without its ends", "1:3"),
        ("b = 1; a = 3 m / s;", "unknown name 's'", "'3 m/s'"),
        ("b = if time > 1 s then 3 elif time > 2 s then 2 else 4;", "'elif'", "'elseif'"),
        ("when time > 1 s then b = 3; end;", "without its word", "'end when;'"),
        ("when time > 1 s then b = 3;", "without its word", "'end when;'"),
        ("for i in 1:3 loop b = 3; end;", "without its word", "'end for;'"),
        ("b = 3; end when;", "no 'when' is open", "away"),
        ("algorithm b := 3;", "'algorithm' is no word", "'equation'"),
        ("b = True;", "unknown name 'True'", "'true'"),
        ("b = ln(2);", "unknown function 'ln'", "'log'"),
    ],
)
def test_a_slip_in_the_signs_is_told(slip: str, words: str, remedy: str) -> None:
    _, message, help_text = only(MODEL.format(slip))
    assert words in message
    assert remedy in help_text


@pytest.mark.parametrize(
    ("slip", "words", "remedy"),
    [
        ("a = 3 m.s-1;", "cannot subtract", "a power is written with '^': '3 m.s^-1'"),
        ("b = 2*3 rad.s-1;", "cannot subtract", "'3 rad.s^-1'"),
        ("b = dot((3, 4) m.s-1, (1, 2));", "cannot subtract", "'(3, 4) m.s^-1'"),
        ("a = 3 kg.m2;", "unknown unit 'm2'", "'kg.m^2'"),
        ("a = 3 N.m/(rad/s);", "no parentheses", "write '3 N.m.s/rad'"),
        ("a = 3 kg*m^2;", "unknown name 'm'", "'3 kg.m^2'"),
        ("a = 3 kg m^2;", "no blanks", "write 'kg.m^2'"),
        ("a = 3 m s-1;", "no blanks", "write 'm.s^-1'"),
        ("a = 3 m/s⁻²;", "no raised signs", "write 'm/s^-2'"),
        (
            "a = 3 m.s^(-1);",
            "without '+' or parentheses",
            "'3 m.s^-1' for the unit, or '(3 m.s)^-1'",
        ),
        ("a = 3 m^+2;", "without '+' or parentheses", "'3 m^2' for the unit, or '(3 m)^2'"),
        ("a = 3 m^(1/2);", "without '+' or parentheses", "write '(3 m)^...'"),
        ("a = 3 [m/s];", "no brackets", "write 'm/s'"),
        ("b = 3 º;", "unknown unit 'º'", "'°'"),
        ("b = 3˚;", "'˚'", "'20 °'"),
    ],
)
def test_a_unit_of_another_notation_is_told(slip: str, words: str, remedy: str) -> None:
    _, message, help_text = only(MODEL.format(slip))
    assert words in message
    assert remedy in help_text


@pytest.mark.parametrize("unit", ["m.s-1", "m·s⁻¹", "m*s^-1", "m.s^(-1)", "m/(s)"])
def test_a_unit_of_a_declaration_is_told_whole(unit: str) -> None:
    text = f'model M\n Real v(unit = "{unit}");\nequation\n v = 3;\nend M;\n'
    assert only(text)[2] == f"did you mean {'m/s' if '/' in unit else 'm.s^-1'!r}?"


def test_the_power_of_a_value_with_a_unit_stands_apart() -> None:
    assert told(MODEL.format("b = (3 m)^2/(9 m^2) + (3 m ^ 2)/(9 m^2);")) == []


@pytest.mark.parametrize(
    ("written", "word", "remedy"),
    [
        ("discrete Real k(start = 0);", "discrete", "between"),
        ("protected\n Real k;", "protected", "from outside"),
        ("Real k annotation(a = 1);", "annotation", "experiment"),
        ("inner Real k;", "inner", "parameter"),
    ],
)
def test_words_of_modelica_are_told(written: str, word: str, remedy: str) -> None:
    _, message, help_text = only(f"model M\n {written}\nequation\n k = 1;\nend M;\n")
    assert message == f"'{word}' is no word of this language" and remedy in help_text


@pytest.mark.parametrize(
    ("declared", "meant"),
    [("body b: cube(1 kg)", "box"), ("liaison l: hinge(ground, ground)", "pivot")],
)
def test_names_of_other_tools_lead_to_those_of_this_one(declared: str, meant: str) -> None:
    assert only(f"planar model M\n {declared};\nend M;\n")[2] == f"did you mean '{meant}'?"


def test_a_library_that_is_not_imported_is_told() -> None:
    assert "'import Electrical;'" in only("model M\n Electrical.Ground g;\nend M;\n")[2]


@pytest.mark.parametrize("declared", ["frame f[2] on b", "curve c[2] on b: circle(radius = 1 m)"])
def test_what_is_no_array_is_told(declared: str) -> None:
    text = f"planar model M\n body b: particle(mass = 1 kg);\n {declared};\nend M;\n"
    _, message, help_text = only(text)
    assert "cannot be declared as an array" in message and "array of that model" in help_text


def test_a_slip_in_the_statement_that_uses_a_model_is_the_only_fault() -> None:
    text = "model P\n Real x = 1;\nend P;\nmodel M\n P p[2](x = {1, 2});\nend M;\n"
    assert only(text)[0] == "E0101"


@pytest.mark.parametrize("said", ["start(1)", "start(y = 1)", "start()", "nominal(1)", "max(2)"])
def test_an_attribute_with_brackets_is_told(said: str) -> None:
    for text in (f"model M Real x({said}); ", f"type T = Real({said}); model M T x; "):
        code, _, remedy = only(f"{text}equation x = 1; end M;")
        assert code == "E0204" or "a modifier is written 'name = value'" in remedy


def test_a_when_of_a_loop_of_initial_is_told() -> None:
    when = "when x > 1 then x = 2; end when;"
    text = f"model M Real x; initial for i in 1:2 loop {when} end for; equation x = 1; end M;"
    code, message, _ = only(text)
    assert (code, message) == ("E0501", "a 'when' in the section 'initial'")


@pytest.mark.parametrize("before", ["", ", axis = (1, 0, 0)", ", (1, 0, 0)"])
def test_a_drive_inside_of_the_bracket_is_told(before: str) -> None:
    drive = "driven(displacement = 1 m)"
    text = f"model M body b: particle(mass = 1 kg); liaison l: prismatique(ground, b{before}, "
    code, message, remedy = only(f"{text}{drive}); end M;")
    assert (code, message) == ("E0204", "'driven' stands behind the bracket")
    assert f"prismatique(...) {drive}" in remedy


@pytest.mark.parametrize("word", ["initial", "equation", "when", "driven", "end", "not", "with"])
def test_a_word_of_the_language_as_a_name_is_told(word: str) -> None:
    found = told(f"planar model M\n parameter Real {word} = 3;\nend M;\n")
    assert f"'{word}' is a word of the language" in found[0][1]


@pytest.mark.parametrize("word", ["force", "body", "input", "output", "frame", "model", "shape"])
def test_a_noun_of_the_language_can_be_a_name(word: str) -> None:
    equations = f" {word} = 3;\n {word} /* ? */ - z = 0;\n"
    text = f"model M\n Real {word}; Real z;\nequation\n{equations}end M;"
    assert told(text) == []


@pytest.mark.parametrize("space", ["\u00a0", "\u202f", "\u2009"])
def test_a_space_of_a_word_processor_is_a_space(space: str) -> None:
    declared = f"  parameter Length l{space}= 3{space}mm;\n  Length x = (l,{space}l)[1];\n"
    text = f"model M\n{declared}end M;\n"
    assert told(text) == []
    assert "l = 3 mm;" in format_text(text).replace(space, " ")


def test_raised_digits_are_powers() -> None:
    text = (
        'model M\n parameter Acceleration a = 3 m/s²;\n parameter Real b(unit = "s⁻¹") = 1;\nend M;'
    )
    assert told(text) == []


@pytest.mark.parametrize(
    ("equation", "remedy"),
    [
        ("der(b) = c;", "'c/(1 s)'"),
        ("der(b) = -2*c;", "'(-2*c)/(1 s)'"),
        ("der(b) = 3;", "3 1/s"),
        ("der(der(b)) + b/(1 s^2) = der(c);", "divide by 1 s"),
        ("c = der(b);", "multiply it by 1 s"),
    ],
)
def test_a_rate_of_a_number_is_told_with_the_time_that_is_missing(
    equation: str, remedy: str
) -> None:
    code, _, help_text = only(f"model M\n Real b; Real c;\nequation\n {equation}\nend M;\n")
    assert code == "E0301"
    assert remedy in help_text


@pytest.mark.parametrize(
    ("declaration", "words"),
    [
        ("parameter Force f = 1 kg;", "expected a force (N), found a mass (kg)"),
        ("parameter Voltage u = 1 kg;", "expected a voltage (V), found a mass (kg)"),
        ("parameter Torque u = 1 W;", "expected a torque or energy (N.m), found a power (W)"),
        ("parameter Stiffness k = 1 Ohm;", "expected a stiffness (N/m), found a resistance (Ohm)"),
        (
            "parameter Inertia j = 1 F;",
            "expected a moment of inertia (kg.m^2), found a capacitance (F)",
        ),
        ("parameter Mass m = 2 s*(1 m);", "found a quantity in m.s"),
        ("parameter Mass m = (2 N)*(1 m^2);", "found a quantity in kg.m^3/s^2"),
    ],
)
def test_units_are_told_as_people_write_them(declaration: str, words: str) -> None:
    assert words in only(f"model M\n {declaration}\nend M;\n")[1]


def test_a_package_is_told_to_be_one() -> None:
    code, message, help_text = only("package Parts\n model R\n  Real x = 1;\n end R;\nend Parts;\n")
    assert code == "E0509"
    assert "'Parts' is a package" in message
    assert "import Parts.*;" in help_text


PLANE = "planar model M\n body b: disc(mass = 1 kg, radius = 1 m);\n {}\nend M;\n"


@pytest.mark.parametrize(
    ("slip", "words", "remedy"),
    [
        ("body c: particle(mass = 0,5 kg);", "a comma in a number", "'0.5 kg'"),
        ("body c: disc(m = 1 kg, radius = 1 m);", "no argument 'm'", "'mass'"),
        ("body c: particle(mass = 1 kg2);", "unknown unit 'kg2'", "'kg^2'"),
        ("output Real x = if b.position.x > 0 then 1 else 0;", "cannot compare", "'0 m'"),
        ("force f: on(b, value = 3 N);", "a vector of 2 forces (N)", "'(3 N, 0 N)'"),
        ("force f: couple(b, value = 2 N*m);", "unknown name 'm'", "'2 N.m'"),
        ("output E = b.kinetic_energy;", "'E' is declared without a type", "'Real E = ...'"),
        (
            "liaison c: contact_ponctuel(b.rim, ground.line), coulomb(0.3);",
            "unexpected ','",
            "'... with coulomb(0.3);'",
        ),
        ("Real x;\nequation\n x' = 2;", 'unexpected "\'"', "'der(x)'"),
        ("Real x;\nequation\n x = time**2;", "'**'", "'x^2'"),
        ("experiment(stop = 5 s)", "missing ';'", ""),
        ("Real x;\nequation\n x = 2", "missing ';'", ""),
    ],
)
def test_a_slip_of_a_new_user_is_told(slip: str, words: str, remedy: str) -> None:
    found = told(PLANE.format(slip))
    assert words in found[0][1]
    assert remedy in found[0][2]


@pytest.mark.parametrize(
    ("section", "remedy"),
    [
        ("equations\n x = 1;", "'equation'"),
        ("eqution\n der(x) = 2 1/s;", "'equation'"),
        ("Equation\n x = 1;", "'equation'"),
        ("equation\n x = 1;\ninitially\n x = 1;", "'initial'"),
        ("initial equation\n x = 1;\nequation\n der(x) = 2 1/s;", "leave out"),
        ("equation\n x = 1;\nexperiments(stop = 1 s);", "'experiment'"),
    ],
)
def test_a_misspelt_section_is_told_once(section: str, remedy: str) -> None:
    assert remedy in only(f"model M\n Real x;\n{section}\nend M;\n")[2]


def test_a_type_of_ones_own_is_no_section() -> None:
    assert told("type Equation = Real;\nmodel M\n Equation x = 1;\nend M;\n") == []


@pytest.mark.parametrize("matrix", ["[1, 2; 3, 4]", "[1, 2;\n 3, 4]", "{{1, 2}, {3, 4}}"])
def test_a_matrix_of_another_language_is_told_with_ours(matrix: str) -> None:
    found = told(f"model M\n parameter Real A[2, 2] = {matrix};\n Real x = A[1, 1];\nend M;\n")
    assert "((" in found[0][2]
    assert len(found) == 1 or "\n" in matrix


@pytest.mark.parametrize(
    ("equation", "remedy"),
    [
        ("der(b) = 2*b;", "divide by 1 s, '(2*b)/(1 s)'"),
        ("der(b) + b = 0;", "divide by 1 s, 'b/(1 s)'"),
        ("der(der(b)) = -b;", "divide by 1 s^2, '(-b)/(1 s^2)'"),
        ("b = der(b);", "multiply it by 1 s, '(1 s)*der(...)'"),
        ("b - 3*der(der(b)) = 0;", "multiply it by 1 s^2, '(1 s^2)*der(...)'"),
    ],
)
def test_missing_seconds_are_named(equation: str, remedy: str) -> None:
    assert remedy in only(MODEL.format(equation))[2]


def test_missing_seconds_of_an_output_are_named() -> None:
    text = "model M\n Real b;\n output Real d = der(b);\nequation\n b = 1;\nend M;\n"
    assert "'(1 s)*der(...)'" in only(text)[2]


def test_the_end_of_a_block_whose_beginning_is_lost_is_no_second_fault() -> None:
    text = (
        "model M\n Real x;\nequation\n when time > 1 s, time > 2 s then x = 1; end when;\nend M;\n"
    )
    assert only(text)[0] == "E0101"
