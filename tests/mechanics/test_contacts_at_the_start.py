"""Contacts at the start: which are closed, which speeds are corrected, what is moved for them."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping

import numpy as np
import pytest

import frot

PAIR = """planar model Pair
  world(gravity = 0.7872426123766704 m/s^2);
  body b0: rod(mass = 0.5475911744473551 kg, length = 1.3623149127245289 m);
  curve c0 on ground: line(through = (0.1040951780706012, 0.33926293489214543) m,
    direction = (cos(-1.0021119741677609), sin(-1.0021119741677609)));
  liaison J0: point_courbe(b0.tip, c0, unilateral = true);
  body b1: particle(mass = 1.7280430946905194 kg);
  curve c1 on b0: line(through = (0.2993509277099085, 0.07746306105087858) m,
    direction = (cos(0.013850801810480096), sin(0.013850801810480096)));
  liaison J1: point_courbe(b1, c1);
  curve c4 on ground: line(through = (0.4070313471304472, 0.07365223146311473) m,
    direction = (cos(-2.7051351999142947), sin(-2.7051351999142947)));
  liaison J5: point_courbe(b1, c4);
  {beside}
initial
  guess(J0.abscissa = 0.5878064473422437 m);
  guess(b0.angle = 1.398229688977593);
  experiment(stop = 1.38 s);
end Pair;
"""
BESIDE = {
    "a bead that rides on a ring": (
        "body b2: ring(mass = 0.6949181497394069 kg, radius = 0.3111462133245647 m);"
        "body b3: particle(mass = 1.8683201243668341 kg);"
        "curve c3 on b2: line(through = (0.16402917267180123, -0.215669739019684) m,"
        " direction = (cos(0.24817735898995763), sin(0.24817735898995763)));"
        "liaison J3: point_courbe(b3, c3, unilateral = true);"
    ),
    "a free disc": "body b2: disc(mass = 1e6 kg, radius = 3 m);",
}


@pytest.mark.parametrize("beside", BESIDE)
def test_guesses_are_met_where_they_were_without_what_stands_beside(beside: str) -> None:
    """The place that meets both guesses is the nearest one, and the tip is outside of its line."""
    alone = frot.compile(PAIR.format(beside="")).simulate()
    whole = frot.compile(PAIR.format(beside=BESIDE[beside])).simulate()
    for name in alone:
        if name.startswith(("b0", "b1", "J")) and alone[name].ndim == 1:
            assert whole[name][0] == pytest.approx(alone[name][0], abs=1e-11), name
    for result in (alone, whole):
        start = result.at(0)
        assert start["J0.abscissa"] == pytest.approx(0.5878064473422437, abs=1e-12)
        assert start["b0.angle"] == pytest.approx(1.398229688977593, abs=1e-12)
        assert start["J0.gap"] > -1e-12
        assert abs(result.balance.relative) < 1e-9


def into_lines(rods: Mapping[str, np.ndarray], mass: np.ndarray, v: np.ndarray) -> np.ndarray:
    """The speeds nearest to v, in the metric of the mass, at which no gap shrinks.

    Of every set of contacts that stay closed, the one whose pushes and other rates are positive.
    """
    rows = np.array(list(rods.values()))
    for count in range(len(rows) + 1):
        for chosen in itertools.combinations(range(len(rows)), count):
            own = rows[list(chosen)]
            push = np.linalg.lstsq(own @ (own / mass).T, -own @ v, rcond=None)[0] if count else []
            found = v + (own / mass).T @ push if count else v
            if np.all(np.array(push) >= -1e-12) and np.all(rows @ found >= -1e-12):
                return found
    raise AssertionError("no admissible speeds")


ROD = """planar model Rod
  parameter Mass m = 2.51763 kg;
  parameter Velocity vx = 0 m/s;
  parameter Velocity vy = 0 m/s;
  parameter AngularVelocity w = 0 rad/s;
  world(gravity = 0 m/s^2);
  body b: rod(mass = m, length = 1.61811 m);
  curve c on ground: line(through = (-0.858853, 0.68884) m,
    direction = (cos(-0.676141), sin(-0.676141)));
  curve d on ground: line(through = (-0.956174, -0.923274) m,
    direction = (cos(3.10562), sin(3.10562)));
  {contacts}
initial
  J.gap = 0 m;
  K.gap = 0 m;
  guess(b.position = (-0.961203, 0.579331) m);
  guess(b.velocity = (vx, vy));
  guess(b.angular_velocity = w);
  experiment(stop = 1 ms);
end Rod;
"""
ROD_ORDERS = (
    "liaison J: contact_ponctuel(b.tip, c); liaison K: contact_ponctuel(d, b.start);",
    "liaison K: contact_ponctuel(b.start, d); liaison J: contact_ponctuel(c, b.tip);",
)


@pytest.mark.parametrize("contacts", ROD_ORDERS)
def test_guessed_speeds_into_two_lines_are_corrected_together(contacts: str) -> None:
    """Speeds that leave one line may meet it where the other one corrects them."""
    model, chance = frot.compile(ROD.format(contacts=contacts)), np.random.default_rng(5)
    speeds = [np.array((-0.0124023, -0.195478, 0.0)), *chance.uniform(-1, 1, (12, 3))]
    corrected = 0
    for k, speed in enumerate(speeds):
        m = 2.51763 * (1, 1e6, 1e-6)[k % 3]
        given = {"m": m, "vx": speed[0], "vy": speed[1], "w": speed[2]}
        start = model.simulate(parameters=given).at(0)
        x, y, angle = (start[f"b.{n}"] for n in ("position.x", "position.y", "angle"))
        rows: dict[str, np.ndarray] = {}
        for name, sign, direction, through in (
            ("J", 1, -0.676141, (-0.858853, 0.68884)),
            ("K", -1, 3.10562, (-0.956174, -0.923274)),
        ):
            arm = sign * 1.61811 / 2 * np.array((math.cos(angle), math.sin(angle)))
            normal = np.array((-math.sin(direction), math.cos(direction)))
            assert abs(normal @ (np.array((x, y)) + arm - through)) < 1e-12
            centre = normal @ (np.array((x, y)) - through)  # no gravity: the side is that of G
            normal *= math.copysign(1, centre)
            rows[name] = np.array((*normal, arm[0] * normal[1] - arm[1] * normal[0]))
        mass = m * np.array((1, 1, 1.61811**2 / 12))
        expected = into_lines(rows, mass, speed)
        names = ("velocity.x", "velocity.y", "angular_velocity")
        assert [start[f"b.{n}"] for n in names] == pytest.approx(list(expected), abs=1e-12)
        for name, row in rows.items():
            met = row @ speed < 0 and abs(row @ expected) < 1e-12
            corrected += met
            assert met or start[f"{name}.mode"] == 0 or abs(row @ expected) < 1e-12
    assert corrected > 10


def test_a_stated_speed_into_a_line_is_an_impact_at_the_start() -> None:
    text = ROD.format(contacts=ROD_ORDERS[0]).replace("guess(b.velocity = (vx, vy))", "{}")
    stated = text.format("b.velocity = (-0.0124023, -0.195478) m/s; b.angular_velocity = 0 rad/s")
    result = frot.compile(stated.replace("guess(b.angular_velocity = w);", "")).simulate()
    assert {(e.kind, e.time) for e in result.events[:1]} == {("impact", 0.0)}
    assert result.balance.dissipated > 0


FEET = """planar model Feet
  parameter Mass m = 991520 kg;
  world(gravity = 830.107 m/s^2);
  body b: disc(mass = m, radius = 0.000544512 m);
  curve c on ground: line(through = (5.05806e-06, -0.00110891) m,
    direction = (cos(-0.35411), sin(-0.35411)));
  frame f on b at (-0.000393027, -0.000273101) m;
  liaison J0: point_courbe(f, c, unilateral = true);
  frame g on b at (-0.000593857, -0.00068984) m rotated(angle = 0.536315);
  liaison J2: contact_ponctuel(c, g);
initial
  guess(b.angle = -2.04861);
  guess(b.angular_velocity = {spin} rad/s);
  J2.gap = 0 m;
  experiment(stop = 0.4 ms);
end Feet;
"""


@pytest.mark.parametrize("spin", [-371.724, 371.724])
@pytest.mark.parametrize("mass", [991520.0, 1.0])
def test_a_disc_stands_on_one_of_two_feet(spin: float, mass: float) -> None:
    """Where it leaves its line by spinning, it flies freely; both feet are outside all the time."""
    result = frot.compile(FEET.format(spin=spin)).simulate(parameters={"m": mass})
    assert result["J2.gap"][0] == pytest.approx(0, abs=1e-16)
    assert result["J0.gap"].min() > -1e-15
    assert result["J2.gap"].min() > -1e-15
    assert abs(result.balance.relative) < 1e-9
    if spin < 0:
        t, start = result.time, result.at(0)
        assert start["b.angle"] == pytest.approx(-2.04861, abs=1e-12)
        fall = start["b.position.y"] + start["b.velocity.y"] * t - 830.107 / 2 * t**2
        assert result["b.position.y"] == pytest.approx(fall, abs=1e-15)


BESIDE_A_LINE = """planar model BesideALine
  world(down = {down});
  body b: rod(mass = 1 kg, length = 1 m);
  curve c on ground: line(through = {through} m, direction = {direction});
  frame f on b at (-0.114, 0.45) m;
  liaison J2: contact_ponctuel(f, c);
  body p: particle(mass = {bead} kg);
  curve d on b: line(through = (-0.2, -0.547) m, direction = (cos(0.276), sin(0.276)));
  liaison J3: point_courbe(p, d);
initial
  guess(b.position = {place} m);
  guess(b.velocity = {speed} m/s);
  b.angle = {angle};
  J3.abscissa = -0.83 m;
  experiment(stop = 0.3 s);
end BesideALine;
"""


@pytest.mark.parametrize("turns", range(4))
@pytest.mark.parametrize("bead", [1.0, 1e-6, 1e6])
def test_a_rod_that_is_guessed_beside_a_line_stays_there(turns: int, bead: float) -> None:
    """The frame's place is 0.39 m from the line; rod and bead fall freely and do not turn."""

    def turned(x: float, y: float) -> tuple[float, float]:
        for _ in range(turns):
            x, y = -y, x
        return x, y

    text = BESIDE_A_LINE.format(
        down=("+x", "+y", "-x", "-y")[turns],
        through=turned(1.185, -0.396),
        direction=turned(math.cos(-1.832), math.sin(-1.832)),
        place=turned(1.77, -0.226),
        speed=turned(0, 0.04),
        angle=-0.2127 + turns * math.pi / 2,
        bead=bead,
    )
    result = frot.compile(text).simulate()
    start, end = result.at(0), result.at(0.3)
    assert (start["b.position.x"], start["b.position.y"]) == pytest.approx(turned(1.77, -0.226))
    assert (start["b.velocity.x"], start["b.velocity.y"]) == (
        pytest.approx(turned(0, 0.04), abs=1e-12)
    )
    assert start["J2.gap"] == pytest.approx(0.385571272194, abs=1e-11)
    place = turned(1.77 + 9.81 / 2 * 0.09, -0.226 + 0.04 * 0.3)
    assert (end["b.position.x"], end["b.position.y"]) == pytest.approx(place, abs=1e-9)


@pytest.mark.parametrize("order", [("J", "K"), ("K", "J")])
@pytest.mark.parametrize("turns", range(4))
@pytest.mark.parametrize("mass", [1.0, 1e6])
def test_a_disc_guessed_inside_of_two_lines_is_moved_as_little_as_possible(
    order: tuple[str, str], turns: int, mass: float
) -> None:
    """Out of the steeper line alone: outside of that it is outside of the other one too."""
    lean = turns * math.pi / 2
    lines = {"J": 0.0, "K": math.radians(20)}
    curves = "".join(
        f"  curve c{k} on ground: line(through = (0, 0) m,"
        f" direction = (cos({lines[k] + lean!r}), sin({lines[k] + lean!r})));\n"
        f"  liaison {k}: contact_ponctuel(b.rim, c{k});\n"
        for k in order
    )
    c, s = math.cos(lean), math.sin(lean)
    x, y = 0.5, 0.3
    text = (
        f"planar model Wedge\n  world(gravity = 0 m/s^2);\n"
        f"  body b: disc(mass = {mass} kg, radius = 0.5 m);\n{curves}initial\n"
        f"  guess(b.position = ({c * x - s * y!r}, {s * x + c * y!r}) m);\n"
        "  experiment(stop = 1 ms);\nend Wedge;"
    )
    start = frot.compile(text).simulate().at(0)
    normal = np.array((-math.sin(lines["K"]), math.cos(lines["K"])))
    x, y = np.array((x, y)) + (0.5 - normal @ (x, y)) * normal
    found = (start["b.position.x"], start["b.position.y"])
    assert found == pytest.approx((c * x - s * y, s * x + c * y), abs=1e-14)
    assert start["J.gap"] == pytest.approx(y - 0.5, abs=1e-14)
    assert start["K.gap"] == pytest.approx(0, abs=1e-15)
