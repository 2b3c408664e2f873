"""Faults in a model's text and in its values: place, cause and remedy, status 1, no file left."""

import pytest
from front_door import BLOCK, HOOP, OSCILLATOR, Door

WITH_NUMBERS = """planar model Numbers
  parameter Real dx = 1;
  parameter Mass m = 1 kg;
  parameter Integer n = 3;
  parameter Boolean windy = false;
  parameter Length x = 1 m;
  input Force push(start = 0 N);
  body b: disc(mass = m, radius = 0.1 m);
  curve c on ground: line(through = (0, 0) m, direction = (dx, 0));
  liaison guide: point_courbe(b, c) with coulomb(0.1, mu_s = 0.2);
  force f: spring(b, (2, 0) m, k = n*(1 N/m), length = x);
  force wind: on(b, value = (if windy then push else 0 N, 0 N));
  experiment(stop = 1 s);
end Numbers;
"""

FAULTS = {
    "an unknown name": ("radius = r)", "radius = rr)", "E0201", "'rr'", "7:41"),
    "a wrong unit": ("mass = 1 kg", "mass = 1 m", "E0301", "expected a mass (kg)", "7:26"),
    "an unknown unit": ("mass = 1 kg", "mass = 1 kgg", "E0302", "did you mean 'kg'", "7:28"),
    "a missing end": ("end BackspinHoop;\n", "", "E0104", "end BackspinHoop", "15:43"),
    "a negative mass": ("1 kg", "-1 kg", "E0401", "mass must be positive; it is -1 kg", "7:26"),
    "a zero radius": ("= 0.5 m ", "= 0 m ", "E0401", "radius must be positive; it is 0 m", "7:41"),
    "a liaison of other places": (
        "contact_ponctuel(ground.line, hoop.rim)",
        "appui_faces(ground.line, hoop.rim)",
        "E0205",
        "appui_faces does not join these two places",
        "8:3",
    ),
    "an unsupported law": (
        "coulomb(mu)",
        "pivoting_resistance(delta = 1 mm)",
        "E0701",
        "the law 'pivoting_resistance' in the plane is not supported yet",
        "8:63",
    ),
    "an unknown variable": (
        "hoop.velocity",
        "hoop.speed",
        "E0203",
        "no variable 'speed' on body 'hoop'",
        "12:8",
    ),
}


@pytest.mark.parametrize("fault", FAULTS)
@pytest.mark.parametrize("command", ["check", "simulate", "fmu"])
def test_a_fault_in_the_text_is_told_by_every_command(fault: str, command: str, door: Door) -> None:
    old, new, code, cause, place = FAULTS[fault]
    name = door.hoop_with(old, new)
    door(command, name).refuses(code, cause, place=f"{name}:{place}")


def test_initial_values_that_contradict_each_other_are_both_named(door: Door) -> None:
    name = door.hoop_with("(1, 0) m/s;", "(1, 0) m/s;\n  hoop.velocity.x = 2 m/s;")
    answer = door("simulate", name)
    answer.refuses(
        "E0601",
        "`hoop.velocity = (1, 0) m/s`",
        "`hoop.velocity.x = 2 m/s`",
        place=f"{name}:12:3",
    )
    assert f"at {name}:13:3" in answer.err


def test_initial_values_that_contradict_a_liaison_name_it(door: Door) -> None:
    name = door.hoop_with("(0 m, r)", "(0 m, 0.2*r)")
    answer = door("simulate", name)
    answer.refuses("E0601", "liaison 'floor'", "`hoop.position = (0 m, 0.2*r)`")


def test_a_contradiction_is_as_large_as_the_values_differ(door: Door) -> None:
    # Two statements, 1 m/s and 2 m/s: they are at odds by 1 m/s.
    name = door.hoop_with("(1, 0) m/s;", "(1, 0) m/s;\n  hoop.velocity.x = 2 m/s;")
    assert "by 1 m/s" in door("simulate", name).err


@pytest.mark.parametrize(
    ("value", "cause"),
    [
        ("r=0", "the radius of body 'hoop' is 0: it must be positive"),
        ("r=-1 m", "the radius of body 'hoop' is -1: it must be positive"),
        ("mu=-0.5", "the mu of liaison 'floor' is -0.5: it must not be negative"),
        ("delta=-1", "the delta of liaison 'floor' is -1: it must not be negative"),
    ],
)
def test_a_parameter_the_model_cannot_have_is_refused_at_run_time(
    value: str, cause: str, door: Door
) -> None:
    answer = door("simulate", HOOP, "--set", value, "-o", "out.csv")
    answer.refuses("E0401", cause)
    assert f"at {HOOP}:" in answer.err


@pytest.mark.parametrize(
    ("value", "cause"),
    [
        ("m=0", "the mass of body 'b' is 0: it must be positive"),
        ("dx=0", "the length of the direction of curve 'c' is 0: it must be positive"),
        ("n=-1", "the k of force 'f' is -1: it must not be negative"),
        ("x=-1", "the length of force 'f' is -1: it must not be negative"),
    ],
)
def test_a_parameter_that_makes_the_problem_singular_is_refused(
    value: str, cause: str, door: Door
) -> None:
    answer = door("simulate", door.write(WITH_NUMBERS), "--set", value, "-o", "out.csv")
    answer.refuses("E0401", cause)


def test_a_radius_too_small_for_numbers_has_place_and_remedy(door: Door) -> None:
    # Its moment of inertia is below the smallest number: the mass matrix is singular.
    answer = door("simulate", HOOP, "--set", "r=1e-300")
    answer.refuses("E0901", "singular")


def test_a_force_without_a_value_names_its_own_line(door: Door) -> None:
    name = door.write(
        "planar model Root\n"
        "  body b: particle(mass = 1 kg);\n"
        "  liaison floor: contact_ponctuel(b, ground.line) with coulomb(0.1);\n"
        "  force f: on(b, value = (sqrt(0.5 - time/(1 s))*1 N, 0 N));\n"
        "  experiment(stop = 1 s);\n"
        "end Root;\n"
    )
    answer = door("simulate", name)
    assert answer.status == 1 and "error[E0904]" in answer.err and "Traceback" not in answer.err
    assert f"at {name}:3:" not in answer.err, "the liaison is not to blame"
    assert f"{name}:4:" in answer.err


def test_what_was_computed_before_a_variable_lost_its_value_is_kept(door: Door) -> None:
    name = door.write(
        "model Logs\n  Real x;\n  output Real y = log(x);\ninitial\n  x = 1;\nequation\n"
        "  der(x) = -2 1/s;\n  experiment(stop = 1 s, interval = 0.09 s);\nend Logs;\n"
    )
    answer = door("simulate", name, "-o", "out.csv")
    assert answer.status == 1 and "variable 'y' has no finite value at t = 0.54" in answer.err
    last = float((door.folder / "out.csv").read_text().splitlines()[-1].split(",")[0])
    assert abs(last - 0.5) <= 1e-12


def test_a_run_that_cannot_go_on_keeps_the_motion_up_to_there(door: Door) -> None:
    name = door.write(
        "planar model Drop\n"
        "  body b: particle(mass = 1 kg);\n"
        "  liaison floor: contact_ponctuel(b, ground.line);\n"
        "initial\n"
        "  b.position = (0, 1) m;\n"
        "equation\n"
        '  assert(b.position.y > 0.2 m, "too low");\n'
        "  experiment(stop = 1 s);\n"
        "end Drop;\n"
    )
    answer = door("simulate", name, "-o", "drop.csv")
    assert answer.status == 1 and "error[E0906]" in answer.err
    assert "Drop: 0 s to 0.403" in answer.out
    assert answer.new == ("drop.csv",)


def test_a_bead_whose_reaction_changes_sides_goes_on(door: Door) -> None:
    # The only friction element of the model: its bound is zero where the reaction is.
    name = door.write(
        "planar model Bead\n"
        "  parameter Real mu = 0.2;\n"
        "  body arm:  rod(mass = 1 kg, length = 2 m);\n"
        "  body bead: particle(mass = 0.2 kg);\n"
        "  curve shaft on arm: line(through = (0, 0) m, direction = (1, 0));\n"
        "  liaison hinge: point_courbe(arm.start, ground.line);\n"
        "  liaison slide: point_courbe(bead, shaft) with coulomb(mu);\n"
        "initial\n"
        "  arm.angle = 60 deg;\n"
        "  slide.abscissa = 0.5 m;\n"
        "  experiment(stop = 2 s);\n"
        "end Bead;\n"
    )
    for mu in (0.05, 0.1, 0.2, 0.3, 0.5):
        answer = door("simulate", name, "--set", f"mu={mu}").succeeds()
        assert "slide: the reaction changes sides at t = 0.12" in answer.out


@pytest.mark.parametrize(
    ("value", "code", "cause"),
    [
        ("radius=1", "E0805", "model 'BackspinHoop' has no parameter 'radius'"),
        ("mu=nan", "E0806", "not a finite number"),
        ("mu=1e400", "E0806", "not a finite number"),
        ("mu=many", "E0806", "expected a number"),
        ("mu=0,4", "E0806", "the decimal sign is a point, '0.4'"),
        ("r=12,5 cm", "E0806", "the decimal sign is a point, '12.5'"),
        ("mu=3 m", "E0806", "expected a number, found a length (m)"),
        ("r=3 kg", "E0806", "expected a length (m), found a mass (kg)"),
        ("r=3 parsec", "E0806", "parsec"),
        ("r=(1", "E0806", "bad value of 'r'"),
        ("r=time", "E0806", "bad value of 'r'"),
    ],
)
def test_a_bad_value_of_a_parameter_is_told(value: str, code: str, cause: str, door: Door) -> None:
    door("simulate", HOOP, "--set", value, "-o", "out.csv").refuses(code, cause)


def test_an_unknown_parameter_gets_a_suggestion(door: Door) -> None:
    answer = door("simulate", BLOCK, "--set", "slop=20 deg")
    answer.refuses("E0805", "no parameter 'slop'", "did you mean 'slope'?")


def test_whole_numbers_and_truth_values_are_asked_for_by_name(door: Door) -> None:
    name = door.write(WITH_NUMBERS)
    door("simulate", name, "--set", "windy=2").refuses("E0806", "write true or false")
    door("simulate", name, "--set", "n=2.5").refuses("E0806", "'2.5' is not an integer")
    door("simulate", name, "--set", "windy=true", "--set", "n=4").succeeds()


def test_an_input_is_held_at_a_value_and_is_no_parameter(door: Door) -> None:
    name = door.write(WITH_NUMBERS)
    door("simulate", name, "--input", "push=2 kN").succeeds()
    door("simulate", name, "--input", "push=2 m").refuses("E0806", "expected a force")
    door("simulate", name, "--set", "push=2").refuses("E0805", "has no parameter 'push'")
    door("simulate", name, "--input", "pull=2").refuses("E0805", "has no input 'pull'")


@pytest.mark.parametrize(
    ("words", "cause"),
    [
        (("--stop", "-1"), "the run cannot go from 0 s to -1 s"),
        (("--stop", "0"), "the run cannot go from 0 s to 0 s"),
        (("--start", "99"), "the run cannot go from 99 s to 12 s"),
        (("--tolerance", "1"), "the tolerance 1 is out of range"),
        (("--tolerance", "0"), "the tolerance 0 is out of range"),
        (("--interval", "0"), "the interval 0 s is not positive"),
        (("--interval", "-1"), "the interval -1 s is not positive"),
        (("--interval", "1e-12"), "output times"),
    ],
)
def test_options_of_the_run_out_of_range_are_told(
    words: tuple[str, str], cause: str, door: Door
) -> None:
    door("simulate", OSCILLATOR, *words, "-o", "out.csv").refuses("E0806", cause)


@pytest.mark.parametrize(
    ("text", "told", "place"),
    [
        (
            "model M\n  body b: rod(mass = 1 kg, length = 1 m);\n"
            "  liaison pin: rotoide(ground, b.start, axis = (0, 0, 0));\n",
            ("E0401", "the length of the axis of liaison 'pin' is 0"),
            "3:48",
        ),
        (
            "model M\n  parameter Real k = 0;\n  body b: rod(mass = 1 kg, length = 1 m);\n"
            "  frame f on ground at (0, 0, 0) m rotated(axis = (0, k, 0), angle = 1 rad);\n"
            "  liaison pin: cardan(f, b.start, axis_b = (1, 0, 0));\n",
            ("E0401", "the length of the axis of frame 'f' is 0"),
            "4:51",
        ),
        (
            "model M\n  body b: box(mass = 1 kg, size = (1, 2, 3) m);\n"
            "initial\n  b.orientation = (0, 0, 0, 0);\n",
            ("E0601", "b.orientation is a unit quaternion (cos(f/2), sin(f/2)*n)"),
            "2:3",
        ),
        (
            "planar model M\n  body a: rod(mass = 1 kg, length = 1 m);\n"
            "  body b: rod(mass = 1 kg, length = 1 m);\n  frame far on ground at (0, 5) m;\n"
            "  liaison A: rotoide(ground, a.start);\n  liaison B: rotoide(a.tip, b.start);\n"
            "  liaison C: rotoide(b.tip, far);\n",
            ("E0601", "positions were found at which liaison 'C' holds", "stay 3 m apart"),
            "7:3",
        ),
        (
            # rods of 1 m over 4.5 m: each lacks half a metre, nearly
            "planar model M\n  body a: particle(mass = 1 kg);\n  body b: particle(mass = 1 kg);\n"
            "  frame far on ground at (4.5, 0) m;\n  liaison A: tige(ground, a, length = 1 m);\n"
            "  liaison B: tige(a, b, length = 1 m);\n  liaison C: tige(b, far, length = 1 m);\n"
            "initial\n  guess(a.position = (1.5, 0.1) m);\n  guess(b.position = (3, -0.1) m);\n",
            ("E0601", "positions were found at which liaison ", "its places stay 0.5"),
            "",
        ),
    ],
    ids=["axis", "frame", "quaternion", "loop", "rods"],
)
def test_what_has_no_direction_and_what_cannot_close_is_named(
    text: str, told: tuple[str, ...], place: str, door: Door
) -> None:
    door.write(f"{text}  experiment(stop = 1 s);\nend M;\n", "bad.frot")
    where = f"bad.frot:{place}" if place else None
    door("simulate", "bad.frot").refuses(*told, place=where)


def test_the_centre_of_a_face_is_a_frame_where_a_point_is_meant(door: Door) -> None:
    text = (
        "model M\n  body b: box(mass = 1 kg, size = (1, 2, 3) m);\n"
        "  liaison l: rotoide(ground, b.top, axis = y);\n"
        "  output Length z = b.top.position.z;\n  output Length down = b.position.z;\n"
        "  experiment(stop = 0.1 s);\nend M;\n"
    )
    door.write(text, "face.frot")
    door("simulate", "face.frot", "-o", "face.csv").succeeds()
    head, first = (door.folder / "face.csv").read_text(encoding="utf-8").splitlines()[:2]
    values = dict(zip(head.split(","), first.split(","), strict=True))
    assert float(values["z"]) == 0.0 and float(values["down"]) == -1.5
