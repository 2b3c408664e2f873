"""Where bodies are put at the start: as stated, or told that no place is."""

import cmath
import itertools
import math
import random

import numpy as np
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


ASSEMBLED = """
planar model Assembled "A four-bar whose crank's end is stated: the rest goes to one of two places"
  parameter Length l = 1 m;
  parameter Real turn = 0;
  parameter Real crank_angle = 1.2;
  parameter Mass m1 = 1 kg; parameter Mass m2 = 1 kg; parameter Mass m3 = 1 kg;
  parameter Real c[3] = (0, 0, 0);
  parameter Real f[3] = (0, 0, 0);
  BODIES
  frame far on ground at (1.1*l*cos(turn), 1.1*l*sin(turn));
  LIAISONS
initial
  crank.tip.position = (l*cos(crank_angle + turn), l*sin(crank_angle + turn));
  GUESS
  experiment(stop = 1 s);
end Assembled;
"""
LINKS = [
    "body crank: rod(mass = m1, length = l);",
    "body coupler: rod(mass = m2, length = 1.2*l);",
    "body follower: rod(mass = m3, length = 1.1*l);",
]
PINS = [
    "liaison A: rotoide(ground, crank.start);",
    "liaison B: rotoide(crank.tip, coupler.start);",
    "liaison C: rotoide(coupler.tip, follower.tip);",
    "liaison D: rotoide(follower.start, far);",
]
PLACES = "guess(coupler.position = (c[1]*l, c[2]*l)); guess(follower.position = (f[1]*l, f[2]*l));"


def _assembly(side: int, turn: float, crank: float) -> tuple[list[float], list[float]]:
    """Places (in lengths of the crank) and angle of coupler and follower, by two circles."""
    tip, far = cmath.exp(1j * crank), complex(1.1)
    way = far - tip
    half = math.acos((abs(way) ** 2 + 1.2**2 - 1.1**2) / (2 * 1.2 * abs(way)))
    end = tip + 1.2 * way / abs(way) * cmath.exp(1j * side * half)
    tip, far, end = (z * cmath.exp(1j * turn) for z in (tip, far, end))
    made = [((start + end) / 2, cmath.phase(end - start)) for start in (tip, far)]
    return tuple([z.real, z.imag, angle] for z, angle in made)


@pytest.mark.parametrize(
    ("links", "pins", "guess"),
    [
        ((0, 1, 2), (0, 1, 2, 3), PLACES),
        ((1, 2, 0), (3, 2, 1, 0), PLACES),
        ((2, 0, 1), (0, 3, 1, 2), "guess(follower.position = (f[1]*l, f[2]*l));"),
        ((0, 1, 2), (3, 2, 1, 0), "guess(coupler.angle = c[3]); guess(follower.angle = f[3]);"),
    ],
)
def test_a_loop_is_put_together_as_it_is_guessed(
    links: tuple[int, ...], pins: tuple[int, ...], guess: str
) -> None:
    """Either assembly, guessed exactly or nearly, at any size, masses and order."""
    text = ASSEMBLED.replace("BODIES", "\n".join(LINKS[k] for k in links))
    text = text.replace("LIAISONS", "\n".join(PINS[k] for k in pins)).replace("GUESS", guess)
    model = frot.compile(text)
    masses = ((1, 1, 1), (1e6, 1, 1e-6), (1e-6, 1e6, 1))
    cases = itertools.product((1, -1), (0.0, 2.5), (1.2, -0.4), masses, (0.0, 0.05))
    for k, (side, turn, crank, (m1, m2, m3), off) in enumerate(cases):
        length = (1, 1e-5, 1e4)[k % 3]
        c, f = _assembly(side, turn, crank)
        given: dict[str, float] = {f"c[{i + 1}]": c[i] + off * (-1) ** i for i in range(3)}
        given |= {f"f[{i + 1}]": f[i] + off * (-0.7) ** i for i in range(3)}
        given |= {"l": length, "turn": turn, "crank_angle": crank, "m1": m1, "m2": m2, "m3": m3}
        start = model.simulate(stop=1e-9, parameters=given).at(0)
        found = [start[f"{b}.position.{x}"] / length for b in ("coupler", "follower") for x in "xy"]
        assert found == pytest.approx([*c[:2], *f[:2]], abs=1e-11)
        if "angle" in guess:
            assert start["coupler.angle"] == pytest.approx(c[2], abs=1e-11)


SPATIAL = """
model SpatialFourBar "Crank about z, follower about x, a rod with two ball joints between them"
  parameter Real angle = 0.5;
  parameter Real c[3] = (0, 0, 0);
  parameter Real f[3] = (0, 0, 0);
  body crank: rod(mass = 1 kg, length = 1 m);
  body coupler: rod(mass = 1 kg, length = 2.5 m);
  body follower: rod(mass = 1 kg, length = 1.5 m);
  frame far on ground at (0.5, 1.5, 0.8) m rotated(axis = z, angle = 90 deg);
  liaison A: rotoide(ground, crank.start);
  liaison B: spherique(crank.tip, coupler.start);
  liaison C: spherique(coupler.tip, follower.tip);
  liaison D: rotoide(far, follower.start, axis = y);
initial
  crank.tip.position = (cos(angle), sin(angle), 0) m;
  guess(coupler.position = (c[1], c[2], c[3]) m);
  guess(follower.position = (f[1], f[2], f[3]) m);
  experiment(stop = 1 s);
end SpatialFourBar;
"""


def test_a_loop_in_space_is_put_together_as_it_is_guessed() -> None:
    """The follower's end on its circle, 2.5 m from the crank's: A cos x + B sin x = C."""
    model = frot.compile(SPATIAL)
    far = np.array([0.5, 1.5, 0.8])
    for angle, side, off in itertools.product((0.5, 0.9), (1, -1), (0.0, 0.04)):
        tip = np.array([math.cos(angle), math.sin(angle), 0])
        way = far - tip  # |way + 1.5 (0, cos x, sin x)| = 2.5
        right = (2.5**2 - 1.5**2 - way @ way) / 3
        x = math.atan2(way[2], way[1]) + side * math.acos(right / math.hypot(way[1], way[2]))
        end = far + 1.5 * np.array([0, math.cos(x), math.sin(x)])
        c, f = (tip + end) / 2, (far + end) / 2
        given = {f"c[{i + 1}]": c[i] + off for i in range(3)}
        given |= {f"f[{i + 1}]": f[i] - off for i in range(3)} | {"angle": angle}
        start = model.simulate(stop=1e-9, parameters=given).at(0)
        found = [start[f"{b}.position.{i}"] for b in ("coupler", "follower") for i in "xyz"]
        assert found == pytest.approx([*c, *f], abs=1e-11)


def row_of_parallelograms(count: int) -> str:
    """Rods of 1 m that stand 1 m apart, each tip joined to the next one by a rod."""
    lines = [f"  body s{k}: rod(mass = 1 kg, length = 1 m);" for k in range(count + 1)]
    lines += [f"  body t{k}: rod(mass = 1 kg, length = 1 m);" for k in range(count)]
    lines += [f"  frame f{k} on ground at ({k} m, 0 m);" for k in range(count + 1)]
    lines += [f"  liaison A{k}: rotoide(f{k}, s{k}.start);" for k in range(count + 1)]
    for k in range(count):
        lines.append(f"  liaison B{k}: rotoide(s{k}.tip, t{k}.start);")
        lines.append(f"  liaison C{k}: rotoide(t{k}.tip, s{k + 1}.tip);")
    text = "\n".join(lines)
    head = "planar model Row\n  parameter Angle a = 1 rad;"
    return f"{head}\n{text}\ninitial\n  s0.angle = a;\nend Row;"


@pytest.mark.parametrize("count", [1, 2, 8, 20])
def test_flat_loops_are_put_together_without_hints_and_without_whole_turns(count: int) -> None:
    """From where all rods lie along one line: upright rods, and level ones between them."""
    model = frot.compile(row_of_parallelograms(count))
    for turn in np.radians([5, 45, 90, 135, 175, -60, -90, -150]):
        start = model.simulate(stop=1e-6, parameters={"a": turn}).at(0)
        for k in range(count):
            assert start[f"s{k + 1}.angle"] == pytest.approx(turn, abs=1e-11)
            assert start[f"t{k}.angle"] == pytest.approx(0, abs=1e-11)


def test_a_guess_may_follow_from_other_places() -> None:
    """Of two rods between the same ends the joint is guessed above or below a place of the text."""
    text = """
planar model Beside
  parameter Length up = 0.3 m;
  body a: rod(mass = 1 kg, length = 1 m);
  body b: rod(mass = 1 kg, length = 1 m);
  frame middle on ground at (0.5, 0) m;
  frame far on ground at (1, 0) m;
  liaison left: rotoide(ground, a.start);
  liaison joint_: rotoide(a.tip, b.start);
  liaison right: rotoide(b.tip, far);
  body free: particle(mass = 1 kg);
initial
  guess(a.tip.position = middle.position + (0 m, up));
  guess(free.position = a.tip.position + (1, 0) m);
  guess(free.velocity = 2*middle.ex*(1 m/s));
  experiment(stop = 1e-3 s);
end Beside;
"""
    model = frot.compile(text)
    for up in (0.3, -0.3):
        at = model.simulate(parameters={"up": up}).at(0.0)
        assert at["b.position.y"] * up > 0
        assert at["free.velocity.x"] == pytest.approx(2, rel=1e-12)
        assert at["free.position.x"] > 1
