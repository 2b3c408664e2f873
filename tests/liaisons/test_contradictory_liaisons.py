"""Bodies and liaisons that cannot be: told with what is named, where, before or in a run."""

from __future__ import annotations

import math
import re

import pytest

import frot

SPACE = "model M\n  {}\n  experiment(stop = 0.2 s);\nend M;\n"
SOLID = "body b: solid(mass = 1 kg, inertia = {});"
CUBE = "body b: box(mass = 1 kg, size = (1, 1, 1) m); "


@pytest.mark.parametrize(
    ("given", "told"),
    [
        (
            SOLID.format("(1, 1, 3) kg.m^2"),
            "the sum of the other moments less moment 3 of the inertia of body 'b' is -1",
        ),
        (
            SOLID.format("((1, 0.9, 0), (0.9, 1, 0), (0, 0, 1)) kg.m^2"),
            "the product of what each two principal moments are more than the third",
        ),
        (
            SOLID.format("((1, 0.1, 0), (0.1, 1, 0.2), (0, 0.1, 1)) kg.m^2"),
            "the difference of items [2, 3] and [3, 2], taken from zero, of the inertia of body "
            "'b' is -0.1",
        ),
        (
            CUBE + "liaison j: cardan(ground, b, axis_a = x, axis_b = (2, 0, 0));",
            "product of the axes of liaison 'j', which must cross, is 0",
        ),
        (
            CUBE + "liaison j: cardan(ground, b, axis_a = (0, 0, 0));",
            "the length of the axis_a of liaison 'j' is 0",
        ),
        (
            CUBE + "surface s on b: plane(through = (0, 0, 0) m, normal = (0, 0, 0));",
            "the length of the normal of surface 's' is 0",
        ),
        (
            CUBE + "surface s on b: parametric((1 m*u, 1 m*v, 0 m), u = (0, 1), v = (2, 2));",
            "the length of the interval of v of surface 's' is 0",
        ),
    ],
)
def test_inertias_and_directions_are_told_before_anything_runs(given: str, told: str) -> None:
    """With the line of the text; one mistake is one message."""
    with pytest.raises(frot.FrotError) as raised:
        frot.compile(SPACE.format(given)).report()
    (one,) = raised.value.diagnostics
    assert one.code == "E0401"
    assert told in one.message
    assert "--> <text>:2:" in str(raised.value)


@pytest.mark.parametrize(
    ("given", "told"),
    [
        (
            "liaison j: rotoide(g, b, axis = (b.ex.x, 0, 1));",
            "'axis' of rotoïde 'j' follows other than time and parameters",
        ),
        ("liaison j: appui_plan(g, b, normal = (x, 0, 1));", "'normal' of appui_plan 'j' follows"),
        (
            "frame f on b rotated(axis = (b.ex.x, 0, 1), angle = 1); "
            "body c: particle(mass = 1 kg); liaison j: spherique(c, f);",
            "the axis of frame 'f' follows other than time",
        ),
        (
            "surface s on ground: sphere(radius = (1 + x)*1 m); liaison j: point_surface(b, s);",
            "'radius' of surface 's' follows other than time and parameters",
        ),
        (
            "surface s on ground: implicit(z - abs(x)); liaison j: point_surface(b, s);",
            "'value' of surface 's' switches: what follows it would jump",
        ),
    ],
)
def test_constant_contradictions_are_refused_by_name(given: str, told: str) -> None:
    own = "Real x; frame g on ground at (2, 0, 0) m; " + CUBE + given
    text = SPACE.replace("  experiment", "equation\n  x = 1 + time/(1 s);\n  experiment")
    with pytest.raises(frot.FrotError) as raised:
        frot.compile(text.format(own)).report()
    (one,) = raised.value.diagnostics
    assert one.code == "E0522"
    assert told in one.message


def test_a_liaison_of_ones_own_does_not_join_a_body_to_itself() -> None:
    own = "liaison Same(a: frame, b: frame)\n  geometric a.position.x = b.position.x;\nend Same;\n"
    with pytest.raises(frot.FrotError, match=r"both places of liaison 'j' are on body 'b'"):
        frot.compile(own + SPACE.format(CUBE + "frame f on b; liaison j: Same(b, f);"))


ROD = "planar model M\n  body a: rod(mass = 1 kg, length = 1 m);\n  {}\n"
ROD += "  experiment(stop = 2 s);\nend M;\n"
DRIVEN = "liaison p: rotoide(ground, a.start) driven(angle = {}); "


@pytest.mark.parametrize(
    ("liaisons", "told"),
    [
        # two drives of one pin: at different speeds, and from t = 0 on with different accelerations
        (
            DRIVEN.format("time/(1 s)") + DRIVEN.format("2*time/(1 s)").replace("p:", "q:"),
            "no speeds were found at which liaison 'q' holds together with the others",
        ),
        (
            DRIVEN.format("(time/(1 s))^2") + DRIVEN.format("2*(time/(1 s))^2").replace("p:", "q:"),
            "liaison 'q': time takes apart what it joins from t = 0 on",
        ),
        # the second goes its own way slowly, beside a body that is free
        (
            DRIVEN.format("time/(1 s)")
            + DRIVEN.format("time/(1 s) + (time/(1 s))^8").replace("p:", "q:")
            + "body free: particle(mass = 1 kg);",
            "liaison 'q': time takes apart what it joins from t = 0.0",
        ),
        # nothing moves, and a rod is too long
        (
            DRIVEN.format("0*time/(1 s)") + "frame f on ground at (2, 0) m; "
            "liaison t: tige(a.tip, f, length = 1.5 m);",
            "no positions were found at which liaison 't' holds together with the others: at "
            "best its places stay 0.5 m apart",
        ),
    ],
)
def test_contradictory_functions_of_time_are_reported_with_the_liaison(
    liaisons: str, told: str
) -> None:
    with pytest.raises(frot.FrotError) as raised:
        frot.compile(ROD.format(liaisons)).simulate()
    assert told in str(raised.value)


def test_consistent_drives_are_no_contradiction() -> None:
    text = DRIVEN.format("time/(1 s)") + DRIVEN.format("1*time/(1 s)").replace("p:", "q:")
    result = frot.compile(ROD.format(text)).simulate()
    assert abs(result["p.angle"][-1] - 2) < 1e-12


def test_a_plane_losing_its_normal_in_a_run_is_named() -> None:
    """At t = 0.1 s, which lies between two steps and is asked for by the output grid."""
    text = (
        "body b: particle(mass = 1 kg); surface s on ground: "
        "plane(through = (0, 0, 0) m, normal = (0, 0, 1 - 10*time/(1 s))); "
        "liaison j: point_surface(b, s);"
    )
    with pytest.raises(frot.FrotError) as raised:
        frot.compile(SPACE.format(text)).simulate()
    assert "E0911" in str(raised.value)
    assert "liaison 'j': 's' has no direction at t = 0.1" in str(raised.value)


CLOSED = """
{model} Closed
  body a: rod(mass = 1 kg, length = 0.3 m);
  body b: rod(mass = 1 kg, length = {b} m);
  body c: rod(mass = 1 kg, length = {c} m);
  frame far on ground at {far};
  liaison A: rotoide(ground, a.start{axis});
  liaison B: {joint}(a.tip, b.start{turn});
  liaison C: {joint}(b.tip, c.tip{turn});
  liaison D: rotoide(far, c.start{axis});
{initial}
end Closed;
"""
IN_SPACE = {"model": "model", "axis": ", axis = y"}


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"model": "planar model", "far": "(0.9, 0) m"}, "'D'.* its places stay 0.2 m apart"),
        (IN_SPACE | {"far": "(0.9, 0, 0) m", "joint": "spherique"}, "its places stay 0.2 m apart"),
        (
            IN_SPACE
            | {"turn": ", axis = y", "b": 1, "c": 0.7}
            | {"far": "(0.9, 0, 0) m rotated(axis = x, angle = 3 deg)"},
            "'D'.* its directions stay 0.0523 rad apart",
        ),
    ],
    ids=["plane", "space", "axes"],
)
def test_the_gap_of_an_open_loop_is_reported(given: dict[str, object], told: str) -> None:
    """0.9 m with rods of 0.3, 0.2 and 0.2 m; axes that are 3 degrees off each other."""
    usual = {"b": 0.2, "c": 0.2, "axis": "", "turn": "", "joint": "rotoide", "initial": ""}
    with pytest.raises(frot.FrotError, match=told) as raised:
        frot.compile(CLOSED.format(**usual | given)).simulate()
    assert raised.value.diagnostics[0].code == "E0601"


def test_an_inadmissible_speed_is_reported_with_its_statement() -> None:
    text = """
planar model Triangle
  body a: rod(mass = 1 kg, length = 1 m);
  body b: rod(mass = 1 kg, length = 1 m);
  frame far on ground at (1, 0) m;
  liaison A: rotoide(ground, a.start);
  liaison B: rotoide(a.tip, b.start);
  liaison C: rotoide(b.tip, far);
initial
  A.speed = 1 rad/s;
end Triangle;
"""
    with pytest.raises(frot.FrotError, match="contradict liaison 'C'") as told:
        frot.compile(text).simulate()
    assert "`A.speed = 1 rad/s`" in str(told.value)


DRIVEN_OFF = {
    "crank": (
        "  body a: rod(mass = 1 kg, length = 1 m);\n  body b: rod(mass = 1 kg, length = 1 m);\n"
        "  body c: rod(mass = 1 kg, length = 0.6 m);\n  frame far on ground at (1, 0) m;\n"
        "  liaison A: rotoide(ground, a.start) driven(angle = 1 rad/s*time + 0.5 rad);\n"
        "  liaison B: rotoide(a.tip, b.start);\n  liaison C: rotoide(b.tip, c.tip);\n"
        "  liaison D: rotoide(far, c.start);\n",
        # 2 sin(f/2) = 1.6, its rate cos(f/2) = 0.6
        (2 * math.asin(0.8) - 0.5, "'D'", "places stay at least", 0.6),
    ),
    "frame": (
        "  body a: rod(mass = 1 kg, length = 0.3 m);\n  body b: rod(mass = 1 kg, length = 1 m);\n"
        "  frame far on ground at (1.1 m + 0.3 m/s*time, 0 m);\n"
        "  liaison A: rotoide(ground, a.start);\n  liaison B: rotoide(a.tip, b.start);\n"
        "  liaison C: rotoide(b.tip, far);\n",
        (2 / 3, "'C'", "places stay at least", 0.3),
    ),
    "slider": (
        "  body a: rod(mass = 1 kg, length = 0.3 m);\n  body b: rod(mass = 1 kg, length = 1 m);\n"
        "  body p: particle(mass = 1 kg);\n"
        "  curve bore on ground: line(through = (0, 0) m, direction = (1, 0));\n"
        "  liaison A: rotoide(ground, a.start);\n  liaison B: rotoide(a.tip, b.start);\n"
        "  liaison C: rotoide(b.tip, p);\n"
        "  liaison D: point_courbe(p, bore) driven(abscissa = 1.1 m + 0.3 m/s*time);\n",
        (2 / 3, "'D'", "`1.1 m \\+ 0.3 m/s\\*time` is missed by at least", 0.3),
    ),
}


@pytest.mark.parametrize("name", DRIVEN_OFF)
def test_a_loop_driven_beyond_its_reach_is_reported(name: str) -> None:
    """Where its rods lie along one line, and by how much a little later: the rate beyond it."""
    body, (ends, liaison, told, rate) = DRIVEN_OFF[name]
    head = f"planar model Driven\n  world(gravity = 0 m/s^2);\n{body}"
    model = frot.compile(f"{head}initial\n  guess(a.angle = 0.5);\nend Driven;\n")
    with pytest.raises(frot.FrotError, match=f"liaison {liaison}: .* reach .*{told}") as raised:
        model.simulate(stop=3.0)
    fault = raised.value
    assert fault.diagnostics[0].code == "E0901"
    assert fault.result.time[-1] == pytest.approx(ends, abs=1e-8)
    number = r"at least (\S+) .* (\S+) s later"
    by, later = (float(x) for x in re.search(number, str(fault)).groups())
    assert by == pytest.approx(rate * later, rel=0.01)
