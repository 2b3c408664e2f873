"""Where bodies are put at the start: as stated, or told that no place is."""

import math
import random

import pytest

import frot

# The pin keeps p at the rod's tip, 0.3 m from the line: no place of the rod closes the contact.
FLY = """
planar model Fly
  parameter Length l = 1 m;
  body rod1: rod(mass = {mass}, length = l);
  body p: particle(mass = 1 kg);
  curve top on rod1: line(through = (0, -0.3*l/(1 m)) m, direction = (cos({tilt}), sin({tilt})));
  liaison pin: rotoide(rod1.tip, p);
  liaison c: contact_ponctuel(p, top, unilateral = {unilateral});
initial
  {statements}
  experiment(stop = 0.1 s);
end Fly;
"""


@pytest.mark.parametrize("length", [1e-6, 1.0, 1e6])
@pytest.mark.parametrize(
    ("statements", "unilateral", "mass"),
    [
        ("c.gap = 0 m;", "true", "1 kg"),
        ("c.gap = 0 m; guess(rod1.angle = 0.7);", "true", "1 kg"),
        ("c.gap = 0 m; guess(rod1.angle = 2.9);", "true", "1e6 kg"),
        ("guess(rod1.angle = 0.7);", "false", "1e-6 kg"),
    ],
)
def test_a_contact_that_cannot_hold_is_told(
    statements: str, unilateral: str, mass: str, length: float
) -> None:
    text = FLY.format(statements=statements, unilateral=unilateral, mass=mass, tilt="0")
    with pytest.raises(frot.FrotError) as told:
        frot.compile(text).simulate(parameters={"l": length})
    assert told.value.diagnostics[0].code == "E0601"


@pytest.mark.parametrize("guess", ["", "guess(rod1.angle = 0.7);"])
@pytest.mark.parametrize("place", [1.0, 1e6])
def test_what_can_hold_far_away_is_put_there(guess: str, place: float) -> None:
    text = """
planar model Far
  parameter Length x = 1 m;
  body rod1: rod(mass = 1 kg, length = 1 m);
  body p: particle(mass = 1 kg);
  liaison pin: rotoide(rod1.tip, p);
initial
  p.position.x + p.position.y = x;
  p.position.y - p.position.x = 0 m;
  GUESS
  experiment(stop = 0.1 s);
end Far;
""".replace("GUESS", guess)
    result = frot.compile(text).simulate(parameters={"x": place})
    assert result["p.position.x"][0] == pytest.approx(place / 2, rel=1e-12)


@pytest.mark.parametrize("guess", [(5.0, 5.0), (1e9, 1e9), (-3e-7, 0.1)])
@pytest.mark.parametrize("stated", [0.0, 1.0, 1e-3])
def test_a_guess_of_what_is_stated_too_does_not_move_it(
    stated: float, guess: tuple[float, float]
) -> None:
    text = """
planar model Both
  parameter Velocity v = 1 m/s; parameter Velocity gx = 1 m/s; parameter Velocity gy = 1 m/s;
  body b: particle(mass = 1 kg);
  curve l on ground: line(through = (0, 0) m, direction = (2, 1));
  liaison p: contact_ponctuel(b, l, unilateral = false);
initial
  b.position.x = 1 m;
  b.velocity.x = v;
  guess(b.velocity = (gx, gy));
  experiment(stop = 0.1 s);
end Both;
"""
    given = {"v": stated, "gx": guess[0], "gy": guess[1]}
    result = frot.compile(text).simulate(parameters=given)
    assert result["b.velocity.x"][0] == stated
    assert result["b.velocity.y"][0] == pytest.approx(stated / 2, rel=1e-14, abs=1e-300)
    assert result["b.position.x"][0] == 1


CRANK = """
planar model Crank
  parameter Length r = 80 mm;
  parameter Angle tilt = 0 deg;
  parameter Angle stated = 90 deg;
  body crank: rod(mass = 0.6 kg, length = r);
  body bielle: rod(mass = 1.1 kg, length = 3*r);
  body piston: particle(mass = 0.9 kg);
  liaison O: rotoide(ground, crank.start);
  liaison A: rotoide(crank.tip, bielle.start);
  liaison B: rotoide(bielle.tip, piston);
  curve bore on ground: line(through = (0, 0) m, direction = (SIGN*cos(tilt), SIGN*sin(tilt)));
  liaison C: point_courbe(piston, bore);
  body aside: rod(mass = 2 kg, length = r);
  liaison D: rotoide(ground, aside.start);
initial
  O.angle = stated;
  experiment(stop = 1e-6 s);
end Crank;
"""


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("r", [80e-9, 0.08, 80e3])
@pytest.mark.parametrize("tilt", [0.0, 0.7])
@pytest.mark.parametrize("off", [0.0, 1e-5])
def test_a_crank_is_completed_from_a_posture_that_tells_no_way(
    sign: int, r: float, tilt: float, off: float
) -> None:
    """The guess has the rod along the crank: across the bore no turn of it closes the gap."""
    model = frot.compile(CRANK.replace("SIGN", str(sign)))
    for quarter in range(4):
        angle = tilt + quarter * math.pi / 2 + off
        given = {"r": r, "tilt": tilt, "stated": angle}
        start = model.simulate(parameters=given).at(0)
        assert start["O.angle"] == pytest.approx(angle, rel=1e-12, abs=1e-15)
        assert start["D.angle"] == 0  # nothing asks it to move
        assert abs(start["A.angle"]) < math.pi
        along = start["piston.position.x"] * math.cos(tilt)
        along += start["piston.position.y"] * math.sin(tilt)
        across = start["piston.position.y"] * math.cos(tilt)
        across -= start["piston.position.x"] * math.sin(tilt)
        turned = quarter * math.pi / 2 + off
        reach = math.sqrt(9 - math.sin(turned) ** 2)
        assert min(
            abs(along / r - math.cos(turned) - side * reach) for side in (1, -1)
        ) == pytest.approx(0, abs=1e-9)
        assert abs(across) <= 1e-9 * r


def test_a_crank_whose_rod_is_too_short_is_told() -> None:
    short = CRANK.replace("SIGN", "1").replace("length = 3*r", "length = 0.9*r")
    with pytest.raises(frot.FrotError, match="E0601"):
        frot.compile(short).simulate()


PINNED = """
planar model Pinned
  parameter Length L = 1 m;
  parameter Angle a = 0;
  parameter Angle b = 0;
  body p: disc(mass = 1 kg, radius = 0.3*L);
  body q: disc(mass = 1 kg, radius = 0.3*L);
  frame f on p at (1.2*L, 0.4*L);
  frame h on q at (0.3*L, -0.2*L);
  liaison j: rotoide(f, h);
initial
  p.position = (0 m, 0 m);
  p.angle = a;
  q.position = (L*(1.2*cos(a) - 0.4*sin(a) - 0.3*cos(b) - 0.2*sin(b)),
                L*(1.2*sin(a) + 0.4*cos(a) - 0.3*sin(b) + 0.2*cos(b)));
  q.angle = b;
  experiment(stop = 1e-6 s);
end Pinned;
"""


@pytest.mark.parametrize("length", [1e-6, 1.0, 1e2, 1e6])
def test_places_that_agree_are_found_whatever_the_unit_of_length(length: float) -> None:
    model, chance = frot.compile(PINNED), random.Random(5)
    for _ in range(20):
        a, b = chance.uniform(-3, 3), chance.uniform(-3, 3)
        start = model.simulate(parameters={"L": length, "a": a, "b": b}).at(0)
        assert start["p.angle"] == pytest.approx(a, abs=1e-12)
        assert start["q.angle"] == pytest.approx(b, abs=1e-12)


LOCKED = """
planar model Locked
  parameter Length x = 0.27 m;
  parameter Length y = -0.46 m;
  parameter Angle s = -2.75;
  body p: disc(mass = 1 kg, radius = 0.3 m);
  body q: rod(mass = 1 kg, length = 0.5 m);
  frame f on p at (x, y);
  curve c on p: line(through = (x - 0.3 m*cos(s), y - 0.3 m*sin(s)), direction = (cos(s), sin(s)));
  liaison o: rotoide(ground, p);
  liaison j: rotoide(f, q.start);
  liaison g: contact_ponctuel(q.tip, c, unilateral = false);
initial
  o.angle = -2.9 rad;
  j.angle = s;
  experiment(stop = 1e-6 s);
end Locked;
"""


def test_a_gap_that_is_zero_but_for_rounding_is_closed() -> None:
    model, chance = frot.compile(LOCKED), random.Random(7)
    for _ in range(50):
        given = {k: chance.uniform(-0.5, 0.5) for k in "xy"} | {"s": chance.uniform(-3, 3)}
        start = model.simulate(parameters=given).at(0)
        assert start["j.angle"] == pytest.approx(given["s"], abs=1e-12)
