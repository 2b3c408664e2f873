"""The sign conventions of docs/language.md, shown by a body of 1 kg that slides to the right."""

from __future__ import annotations

import pytest

import frot

WEIGHT, MU = 9.81, 0.2


def start(
    liaison: str, direction: str = "(1, 0)", more: str = "", initial: str = ""
) -> frot.Result:
    return frot.compile(
        "planar model Signs\n"
        "  body b: disc(mass = 1 kg, radius = 0.1 m);\n"
        f"  curve l on ground: line(through = (0, 0) m, direction = {direction});\n"
        f"  liaison c: {liaison} with coulomb({MU});\n"
        f"  {more}\n"
        "initial\n"
        f"  {initial or 'b.velocity = (1, 0) m/s;'}\n"
        "  experiment(stop = 10 ms);\n"
        "end Signs;\n"
    ).simulate()


@pytest.mark.parametrize(("direction", "sense"), [("(1, 0)", 1), ("(-2, 0)", -1)])
def test_the_normal_of_a_point_on_a_line_is_left_of_its_direction(
    direction: str, sense: int
) -> None:
    run = start("point_courbe(b, l)", direction).at(0)
    assert run["c.slip"] == pytest.approx(sense)
    assert run["c.normal_force"] == pytest.approx(sense * WEIGHT)
    assert run["c.tangential_force"] == pytest.approx(-sense * MU * WEIGHT)


@pytest.mark.parametrize(("direction", "sense"), [("(1, 0)", 1), ("(-2, 0)", -1)])
@pytest.mark.parametrize(
    "liaison", ["contact_ponctuel(b, l)", "point_courbe(b, l, unilateral = true)"]
)
def test_the_normal_of_what_can_part_is_against_gravity(
    liaison: str, direction: str, sense: int
) -> None:
    run = start(liaison, direction).at(0)
    assert run["c.normal_force"] == pytest.approx(WEIGHT)
    assert run["c.slip"] == pytest.approx(sense)
    assert run["c.tangential_force"] == pytest.approx(-sense * MU * WEIGHT)


@pytest.mark.parametrize(("places", "sense"), [("b, l", -1), ("l, b", 1)])
def test_the_force_is_that_of_the_first_place_on_the_second(places: str, sense: int) -> None:
    run = start(f"contact_ponctuel({places})").at(0)
    assert run["c.force.x"] == pytest.approx(sense * -MU * WEIGHT)
    assert run["c.force.y"] == pytest.approx(sense * WEIGHT)
    assert run["c.normal_force"] == pytest.approx(WEIGHT)
    assert run["c.power"] == pytest.approx(-MU * WEIGHT)


@pytest.mark.parametrize("side", [-1, 1])
def test_a_body_stays_on_the_side_of_a_wall_where_it_starts(side: int) -> None:
    run = start(
        "contact_ponctuel(b.rim, l)",
        "(0, 1)",
        f"force push: on(b, value = ({-20 * side}, 0) N);",
        f"b.position = ({0.1 * side}, 0) m; b.velocity = (0, 1) m/s;",
    ).at(0)
    assert run["c.gap"] == pytest.approx(0, abs=1e-15)
    assert run["c.normal_force"] == pytest.approx(20)
    assert run["c.force.x"] == pytest.approx(-20 * side)
    assert run["c.slip"] == pytest.approx(1) and run["c.tangential_force"] == pytest.approx(-4)


def test_a_body_under_a_ceiling_is_pressed_downwards() -> None:
    run = start(
        "contact_ponctuel(b.rim, l)",
        more="force lift: on(b, value = (0, 30) N);",
        initial="b.position = (0, -0.1) m;",
    ).at(0)
    assert run["c.normal_force"] == pytest.approx(30 - WEIGHT)
    assert run["c.force.y"] == pytest.approx(30 - WEIGHT)


def test_a_contact_that_cannot_part_pulls_with_a_negative_normal_force() -> None:
    run = start(
        "contact_ponctuel(b.rim, l, unilateral = false)",
        more="force lift: on(b, value = (0, 30) N);",
    ).at(0)
    assert run["c.normal_force"] == pytest.approx(WEIGHT - 30)


def test_the_couple_of_rolling_resistance_is_against_the_rolling() -> None:
    run = start(
        "contact_ponctuel(b.rim, l)",
        initial="b.velocity = (1, 0) m/s; c.slip = 0 m/s;",
    ).at(0)
    assert run["b.angular_velocity"] == pytest.approx(-10)
    held = frot.compile(
        "planar model Held\n"
        "  body b: disc(mass = 1 kg, radius = 0.1 m);\n"
        "  liaison c: contact_ponctuel(b.rim, ground.line)\n"
        f"    with coulomb({MU}), rolling_resistance(5 mm);\n"
        "initial\n  b.velocity = (1, 0) m/s;\n  c.slip = 0 m/s;\n"
        "  experiment(stop = 10 ms);\nend Held;\n"
    )
    # Clockwise, so the couple on the disc is positive, and that on the ground negative.
    assert held.simulate().at(0)["c.torque"] == pytest.approx(-5e-3 * WEIGHT)


def test_the_abscissa_is_measured_from_through_along_the_direction() -> None:
    run = start("point_courbe(b, l)", "(-2, 0)", initial="b.position = (3, 0) m;").at(0)
    assert run["c.abscissa"] == run["c.u"] == -3


def test_a_contact_is_not_closed_by_being_declared() -> None:
    run = start("contact_ponctuel(b.rim, l)", initial="b.position = (0, 1) m;").at(0)
    assert run["c.mode"] == 0 and run["c.gap"] == pytest.approx(0.9)
    assert run["b.acceleration.y"] == pytest.approx(-WEIGHT)
