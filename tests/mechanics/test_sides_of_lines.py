"""The side of a line on which a body is: chosen once, by the point itself, and kept."""

from __future__ import annotations

import math

import numpy as np
import pytest

import frot

DOWN = {"+x": (1, 0), "-x": (-1, 0), "+y": (0, 1), "-y": (0, -1)}


def left_of(direction: tuple[float, float]) -> np.ndarray:
    x, y = direction
    return np.array((-y, x)) / math.hypot(x, y)


def on_a_line(direction: tuple[float, float], world: str, body: str, more: str = "") -> frot.Model:
    x, y = direction
    return frot.compile(
        "planar model Placed\n"
        f"  world({world});\n"
        "  parameter Force fx = 0 N;\n  parameter Force fy = 0 N;\n"
        f"  body b: {body};\n"
        f"  curve l on ground: line(through = (0.3, -0.2) m, direction = ({x!r}, {y!r}));\n"
        f"  {more or 'liaison c: contact_ponctuel(b, l) with coulomb(0.9);'}\n"
        "  force push: on(b, value = (fx, fy));\n"
        "initial\n  b.position = (0.3, -0.2) m;\n  experiment(stop = 10 ms);\nend Placed;\n"
    )


@pytest.mark.parametrize("down", DOWN)
@pytest.mark.parametrize("tilt", [-20.0, 0.0, 40.0])
@pytest.mark.parametrize("turned", [1, -1])
def test_a_body_that_starts_on_a_line_is_on_the_side_against_gravity(
    down: str, tilt: float, turned: int
) -> None:
    fall = np.array(DOWN[down])
    across = math.atan2(fall[1], fall[0]) + math.pi / 2 + math.radians(tilt)
    direction = (turned * math.cos(across), turned * math.sin(across))
    start = on_a_line(direction, f"down = {down}", "particle(mass = 2 kg)").simulate().at(0)
    assert start["c.mode"] == 1  # at rest: tan 40 deg < 0.9
    assert start["c.normal_force"] == pytest.approx(2 * 9.81 * math.cos(math.radians(tilt)))
    force = -np.array((start["c.force.x"], start["c.force.y"]))  # of the line on the body
    assert force == pytest.approx(-2 * 9.81 * fall, abs=1e-12)


@pytest.mark.parametrize("direction", [(1, 0), (-1, 0), (0, 1), (3, -4), (-3, -4)])
@pytest.mark.parametrize("world", ["gravity = 0 m/s^2", "gravity = 0 m/s^2, down = +x"])
def test_without_gravity_the_free_side_is_the_left_one(
    direction: tuple[float, float], world: str
) -> None:
    model, left = on_a_line(direction, world, "particle(mass = 2 kg)"), left_of(direction)
    pressed = model.simulate(parameters={"fx": -5 * left[0], "fy": -5 * left[1]})
    assert pressed.at(0)["c.normal_force"] == pytest.approx(5)
    lifted = model.simulate(parameters={"fx": 5 * left[0], "fy": 5 * left[1]})
    assert lifted.at(0)["c.mode"] == 0
    assert lifted.at(0.01)["c.gap"] == pytest.approx(5 / 2 * 0.01**2 / 2)


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("side", [1, -1])
def test_the_end_of_a_ladder_at_a_vertical_wall_is_on_the_side_of_the_ladder(
    sense: int, side: int
) -> None:
    """Gravity does not tell there. Without friction the ladder falls and both ends press."""
    model = frot.compile(
        "planar model Ladder\n"
        "  body bar: rod(mass = 3 kg, length = 2 m);\n"
        f"  curve wall on ground: line(through = (0, 0) m, direction = (0, {sense}));\n"
        "  liaison foot: contact_ponctuel(bar.start, ground.line) with coulomb(0);\n"
        "  liaison head: contact_ponctuel(bar.tip, wall) with coulomb(0);\n"
        f"initial\n  bar.angle = {90 + side * 30} deg;\n  foot.gap = 0 m;\n  head.gap = 0 m;\n"
        "  experiment(stop = 0.1 s);\nend Ladder;\n"
    )
    start = model.simulate().at(0)
    # By the angle a from the ground: I a'' = -m g l/2 cos a about the point over G, I = m l^2/3.
    turn = 3 * 9.81 / 4 * math.cos(math.radians(60))
    assert start["bar.angular_acceleration"] == pytest.approx(side * turn)
    assert start["head.normal_force"] == pytest.approx(3 * turn * math.sin(math.radians(60)))
    assert start["bar.position.x"] == pytest.approx(side * 0.5)


@pytest.mark.parametrize("height", [0.03, -0.03])
@pytest.mark.parametrize("sense", [1, -1])
def test_a_point_off_the_line_is_on_its_own_side_wherever_its_body_is(
    height: float, sense: int
) -> None:
    """The tip is just over (under) the plank, the middle of the rod far below (above) it."""
    model = frot.compile(
        "planar model Tip\n"
        "  body bar: rod(mass = 1 kg, length = 2 m);\n"
        f"  curve plank on ground: line(through = (0, 1) m, direction = ({sense}, 0));\n"
        "  liaison c: contact_ponctuel(bar.tip, plank);\n"
        f"initial\n  bar.tip.position = (0, {1 + height!r}) m;\n"
        f"  bar.angle = {math.copysign(90, height)} deg;\n  experiment(stop = 1 ms);\nend Tip;\n"
    )
    assert model.simulate().at(0)["c.gap"] == pytest.approx(abs(height))


@pytest.mark.parametrize("middle", [0.5, -0.5])
def test_the_side_is_that_of_the_point_where_liaisons_that_cannot_part_put_it(
    middle: float,
) -> None:
    """The guess has the bob at the other side; the pin brings it 0.4 m over or under the line."""
    model = frot.compile(
        "planar model Swung\n"
        "  world(gravity = 0 m/s^2);\n"
        "  body arm: rod(mass = 1 kg, length = 1 m);\n"
        "  body bob: disc(mass = 1 kg, radius = 0.1 m);\n"
        "  curve l on ground: line(through = (0, 0) m, direction = (1, 0));\n"
        "  liaison hinge: rotoide(ground, arm.start);\n"
        "  liaison rail: point_courbe(bob, track);\n"
        "  curve track on arm: line(through = (0, 0) m, direction = (1, 0));\n"
        "  liaison c: contact_ponctuel(bob.rim, l);\n"
        f"initial\n  arm.angle = {math.copysign(90, middle)} deg;\n"
        f"  guess(bob.position = (0, {-middle}) m);\n  rail.abscissa = -0.1 m;\n"
        "  experiment(stop = 1 ms);\nend Swung;\n"
    )
    start = model.simulate().at(0)
    assert start["bob.position.y"] == pytest.approx(math.copysign(0.4, middle))
    assert start["c.gap"] == pytest.approx(0.3)


@pytest.mark.parametrize("stated", ["under.gap = 0 m;", ""])
def test_a_disc_under_a_ceiling_may_have_its_gap_stated(stated: str) -> None:
    run = frot.compile(
        "planar model Under\n"
        "  body high: disc(mass = 1 kg, radius = 10 cm);\n"
        "  curve ceiling on ground: line(through = (0, 1) m, direction = (1, 0));\n"
        "  liaison under: contact_ponctuel(high.rim, ceiling) with coulomb(0.2);\n"
        "  force lift: on(high, value = (0, 20) N);\n"
        f"initial\n  high.position = (0, 0.9) m;\n  {stated}\nend Under;\n"
    ).simulate(stop=0.01)
    assert run.at(0)["under.normal_force"] == pytest.approx(20 - 9.81)


def test_below_the_line_of_the_ground_nothing_is_free() -> None:
    text = (
        "planar model Below\n  world(down = {down});\n  body b: particle(mass = 1 kg);\n"
        "  liaison c: contact_ponctuel(b, ground.line);\ninitial\n"
        "  b.position = (0, {y}) m;\n  experiment(stop = 0.1 s);\nend Below;\n"
    )
    for down in ("-y", "+y"):
        with pytest.raises(frot.FrotError, match="E0601"):
            frot.compile(text.format(down=down, y=-1)).simulate()
    falls_up = frot.compile(text.format(down="+y", y=0)).simulate().at(0.1)
    assert falls_up["c.gap"] == pytest.approx(9.81 / 2 * 0.1**2)


FLIP = """planar model Flip
  body plank: rod(mass = 1 kg, length = 1 m);
  body p: particle(mass = 1 kg);
  curve top on plank: line(through = (0, 0) m, direction = ({direction}, 0));
  liaison hinge: rotoide(ground, plank);
  liaison c: contact_ponctuel(p, top);
initial
  hinge.angle = 60 deg;
  hinge.speed = 1 rad/s;
  p.position = (-1, 3) m;
  experiment(stop = 1 s);
end Flip;
"""


@pytest.mark.parametrize("direction", [1, -1])
def test_a_line_that_turns_through_the_vertical_keeps_its_side(direction: int) -> None:
    """The point falls freely, 3 m away; the plank turns uniformly about its middle."""
    run = frot.compile(FLIP.format(direction=direction)).simulate()
    assert not run.events
    t = run.time
    angle, y = math.radians(60) + t, 3 - 9.81 * t**2 / 2
    assert run["c.gap"] == pytest.approx(np.sin(angle) + np.cos(angle) * y, rel=1e-9)


@pytest.mark.parametrize("direction", [1, -1])
@pytest.mark.parametrize("kind", ["contact_ponctuel", "point_courbe"])
@pytest.mark.parametrize("down", ["-y", "+x"])
def test_the_reaction_of_a_turning_line_that_holds_has_no_jump(
    direction: int, kind: str, down: str
) -> None:
    """A bead on a rod that turns past the vertical: Newton's law along the rod's own normal."""
    run = frot.compile(
        "planar model Bead\n"
        f"  world(down = {down});\n"
        "  body arm: rod(mass = 1 kg, length = 2 m);\n"
        "  body bead: particle(mass = 200 g);\n"
        f"  curve shaft on arm: line(through = (0, 0) m, direction = ({direction}, 0));\n"
        "  liaison hinge: rotoide(ground, arm);\n"
        f"  liaison slide: {kind}(bead, shaft, unilateral = false);\n"
        "  output Force along = dot(bead.acceleration*(0.2 kg), arm.ey);\n"
        "  output Real nx = arm.ey.x;\n  output Real ny = arm.ey.y;\n"
        "  output Force normal = slide.normal_force;\n"
        "initial\n  hinge.angle = 10 deg;\n  hinge.speed = 7 rad/s;\n"
        "  bead.position = 0.2*(cos(10 deg), sin(10 deg)) m;\n"
        "  experiment(stop = 0.9 s, interval = 1 ms);\nend Bead;\n"
    ).simulate()
    weight = 0.2 * 9.81 * (DOWN[down][0] * run["nx"] + DOWN[down][1] * run["ny"])
    pushed = run["along"] - weight
    sign = np.sign(run["normal"][0] * pushed[0])
    assert run["normal"] == pytest.approx(sign * pushed, abs=1e-9)
    if kind == "point_courbe":
        assert sign == direction
    assert run["arm.angle"][-1] > math.radians(100)


LYING = """planar model Lying
  parameter Length a = 1 mm;
  parameter Length b = 1 mm;
  parameter Length c = 1 mm;
  body p: rod(mass = 1 kg, length = a);
  body q: rod(mass = 1 kg, length = b);
  body r: rod(mass = 1 kg, length = c);
  liaison j: rotoide(p.tip, q.start);
  liaison k: rotoide(q.tip, r.start);
  curve floor on ground: line(through = (0, 0) m, direction = (SENSE, 0));
  liaison foot: contact_ponctuel(r.tip, floor);
initial
  p.position = (a/2, HEIGHT);
  p.angle = 0 rad;
  q.position = (a + b/2, HEIGHT);
  q.angle = 0 rad;
  r.position = (a + b + c/2, HEIGHT);
  r.angle = 0 rad;
  experiment(stop = 1 ms);
end Lying;
"""


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("height", [0.0, 1e-40, -1e-40])
def test_a_height_of_rounding_tells_no_side(sense: int, height: float) -> None:
    """All the heights are rounding; the lengths of the rods tell how small that is."""
    text = LYING.replace("SENSE", str(sense)).replace("HEIGHT", f"{height!r} m")
    model, chance = frot.compile(text), np.random.default_rng(3)
    for _ in range(20):
        given = dict(zip("abc", chance.uniform(0.5e-3, 2e-3, 3), strict=True))
        run = model.simulate(parameters=given)
        assert run.at(0)["foot.normal_force"] > 0
        end = run.at(1e-3)
        assert end["r.position.y"] + given["c"] / 2 * math.sin(end["r.angle"]) > -1e-12


CROSSED = """planar model Crossed
  parameter Length x = 0 m;
  parameter Length wall_x = 0 m;
  parameter Length wall_y = 0 m;
  parameter Angle wall_turn = 0;
  parameter Length rail_x = 0 m;
  parameter Length rail_y = 0 m;
  parameter Angle rail_turn = 0;
  body p: particle(mass = 1 kg);
  curve wall on ground: line(
    through = (wall_x, wall_y), direction = (cos(wall_turn), sin(wall_turn)));
  curve rail on ground: line(
    through = (rail_x, rail_y), direction = (cos(rail_turn), sin(rail_turn)));
  liaison G: contact_ponctuel(p, rail, unilateral = false);
  liaison C: contact_ponctuel(p, wall) with coulomb(0.2);
initial
  guess(p.position.x = x);
  experiment(stop = 1 ms);
end Crossed;
"""


@pytest.mark.parametrize("scale", [1.0, 1e3])
@pytest.mark.parametrize("turned", [0.0, math.pi])
def test_a_point_guessed_by_one_coordinate_that_its_rail_puts_on_a_wall_is_over_it(
    scale: float, turned: float
) -> None:
    """The side is that of the place that is found, against gravity, not of where y was sought."""
    crossing, wall = (0.6708064724929594, 0.1751871152293), 3.3517794696338363 + turned
    given = {"x": scale * crossing[0], "wall_turn": wall, "rail_turn": 0.6115208112512827}
    for name, back in (("wall", 0.4), ("rail", 0.372)):
        turn = given[f"{name}_turn"]
        given[f"{name}_x"] = scale * (crossing[0] - back * math.cos(turn))
        given[f"{name}_y"] = scale * (crossing[1] - back * math.sin(turn))
    result = frot.compile(CROSSED).simulate(parameters=given)
    assert result["C.normal_force"][0] > 1
    assert abs(result["C.gap"][-1]) < 1e-12 * scale
    assert abs(result["p.velocity.y"][-1]) < 1e-12
