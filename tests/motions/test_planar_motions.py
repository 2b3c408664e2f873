"""Lists of admissible motions in the plane, against closed forms.

A list is written as one word a motion, one sign a law: `s` sticks, `+` and `-` slip, `o` opens; the
order of the time after the instant at which a motion begins follows it where that is not 0.
"""

from __future__ import annotations

import functools
import math

import pytest
from frot.runtime.listed_motions import Motion

import frot

G = 9.81


@functools.cache
def compiled(text: str) -> frot.Model:
    return frot.compile(text)


def word(motion: Motion) -> str:
    told = ""
    laws = {law.liaison: law for law in motion.laws}
    for name, mode in motion.modes.items():
        law = laws.get(name)
        if mode == "open":
            told += "o"
        elif law is not None and law.moving:
            told += "+" if law.direction[0] > 0 else "-"
        elif law is not None:
            told += "s"
        if law is not None and law.since:
            told += str(law.since)
    return told


def words(text: str, **values: float) -> list[str]:
    found = compiled(text).motions(parameters=values)
    assert found.complete
    return sorted(word(motion) for motion in found)


BLOCK = """
planar model Block
  parameter Real mu = 0.3;
  parameter Real mu_s = 0.3;
  body block: particle(mass = 2 kg);
  liaison floor: contact_ponctuel(ground.line, block) with coulomb(mu, mu_s = mu_s);
  force pull: on(block, value = (@, 0) N);
initial
  block.position = (0, 0) m;
  experiment(stop = 2 s);
end Block;
"""
BOUND = 0.3 * 2 * G


@pytest.mark.parametrize(
    ("load", "right"),
    [
        ("{b} + tau", "+1"),
        ("{b}", "s"),
        ("{b} - tau", "s"),
        ("{b} + sin(tau)^2", "+2"),
        ("{b} - sin(tau)^2", "s"),
        ("{b} + tau^3", "+3"),
        ("-{b} - tau", "-1"),
        ("-{b} - tau^2", "-2"),
        ("-{b} + tau^2", "s"),
        ("{b} + 1", "+"),
        ("{b} - 1", "s"),
    ],
)
def test_the_growth_of_a_load_decides_at_the_bound(load: str, right: str) -> None:
    text = BLOCK.replace("@", load.format(b=repr(BOUND)).replace("tau", "(time/(1 s))"))
    assert words(text) == [right]


@pytest.mark.parametrize(("sign", "right"), [("+", "+"), ("-", "s")])
def test_what_departs_at_the_static_bound_moves_with_the_coefficient_of_motion(
    sign: str, right: str
) -> None:
    """At mu_s N = 7.848 N the acceleration is (mu_s - mu) g = 0.981 m/s^2 at once."""
    text = BLOCK.replace("@", f"{0.4 * 2 * G!r} {sign} time/(1 s)")
    assert words(text, mu_s=0.4) == [right]
    (motion,) = compiled(text).motions(parameters={"mu_s": 0.4})
    expected = 0.1 * G if right == "+" else 0.0
    assert motion["block.acceleration.x"] == pytest.approx(expected, abs=1e-9)


def bar_on_feet(places: list[float], mus: list[float], height: float, load: str, lift: str) -> str:
    feet = "".join(
        f"  frame f{k} on bar at ({x!r} m, 0 m);\n"
        f"  liaison c{k}: contact_ponctuel(ground.line, f{k}) with coulomb({mu!r});\n"
        for k, (x, mu) in enumerate(zip(places, mus, strict=True))
    )
    return f"""
planar model Feet
  body bar: solid(mass = 2 kg, inertia = 0.5 kg.m^2);
{feet}  frame hand on bar at (0 m, {height!r} m);
  force pull: on(hand, value = ({load}, 0 N));
  {lift}
initial
  bar.position = (0, 0) m;
  bar.angle = 0;
  experiment(stop = 4 s);
end Feet;
"""


@pytest.mark.parametrize("n", [3, 5, 7])
def test_all_legs_slip_when_the_load_passes_the_bound(n: int) -> None:
    places = [-0.6 + 1.2 * k / (n - 1) for k in range(n)]
    text = bar_on_feet(places, [0.3] * n, 0.2, f"{BOUND!r} N + time*1 N/(1 s)", "")
    (found,) = words(text)
    assert found == "+1" * n or found == "+" * n
    rest = bar_on_feet(places, [0.3] * n, 0.2, "3 N", "")
    assert words(rest) == ["s" * n]
    over = bar_on_feet(places, [0.3] * n, 0.2, "9 N", "")
    assert words(over) == ["+" * n]


@pytest.mark.parametrize(
    ("load", "right"), [("+ t", "os"), ("", "ss"), ("- t", "ss"), ("+ t*t", "os"), ("- t*t", "ss")]
)
def test_a_box_tips_where_its_load_grows(load: str, right: str) -> None:
    """Half a width of 0.2 m against a pull 0.5 m high: 2 g 0.2/0.5 N."""
    tip = 2 * G * 0.2 / 0.5
    pull = f"({tip!r} {load.replace('t', '(time/(1 s))')})*1 N"
    text = bar_on_feet([-0.2, 0.2], [0.8, 0.8], 0.5, pull, "")
    assert [w.replace("1", "").replace("2", "") for w in words(text)] == [right]


@pytest.mark.parametrize(
    ("load", "aside", "right"),
    [
        ("2*9.81 + t", "0", "oo"),
        ("2*9.81 - t^2", "0", "ss"),
        ("2*9.81 + t^2", "0", "oo"),
        ("2*9.81 + t", "t/10", "so"),
        ("2*9.81 + t", "-t/10", "os"),
    ],
)
def test_contacts_without_load_part_as_the_load_grows(load: str, aside: str, right: str) -> None:
    t = "(time/(1 s))"
    lift = f"force lift: on(bar, value = (0 N, ({load.replace('t', t)})*1 N));"
    if aside != "0":
        couple = f"({load.replace('t', t)})*({aside.replace('t', t)})"
        lift += f"\n  force turn: couple(bar, value = {couple}*1 N.m);"
    text = bar_on_feet([-0.5, 0.5], [0.3, 0.3], 0.0, "0 N", lift)
    found = [w.replace("1", "").replace("2", "") for w in words(text)]
    assert found == [right]


LINES = """
planar model ParallelLines
  parameter Real mu = 1;
  parameter Real mu1 = 1;
  parameter Angle alpha = 45 deg;
  parameter Force X = 1 N;
  parameter Force X1 = 1 N;
  parameter Velocity v0 = 0 m/s;
  parameter Angle tilt = 0 deg;
  world(gravity = 0 m/s^2);
  body M:  particle(mass = 1 kg);
  body M1: particle(mass = 1 kg);
  curve ox on ground: line(through = (0, 0) m, direction = (cos(tilt), sin(tilt)));
  curve pq on ground: line(through = (cos(alpha + tilt)*1 m, sin(alpha + tilt)*1 m),
                           direction = (cos(tilt), sin(tilt)));
  liaison low:  point_courbe(M,  ox) with coulomb(mu);
  liaison high: point_courbe(M1, pq) with coulomb(mu1);
  liaison bar:  tige(M, M1, length = 1 m);
  force f:  on(M,  value = (X*cos(tilt), X*sin(tilt)));
  force f1: on(M1, value = (X1*cos(tilt), X1*sin(tilt)));
initial
  M.position = (0, 0) m;
  M1.position = (cos(alpha + tilt)*1 m, sin(alpha + tilt)*1 m);
  M.velocity = (v0*cos(tilt), v0*sin(tilt));
  experiment(stop = 0.5 s, on_indeterminate = stop, on_impasse = stop);
end ParallelLines;
"""


@pytest.mark.parametrize("tilt", [0.0, 0.7, -2.0])
def test_of_rest_and_motion_both_are_admissible(tilt: float) -> None:
    """Painleve 1895, p. 94: x'' = g, and rest with |R| = 2 (1 + sqrt 2)/sqrt 2 g at least."""
    values = {"mu": math.sqrt(2), "mu1": math.sqrt(2), "tilt": tilt}
    found = compiled(LINES).motions(parameters=values)
    assert found.complete and len(found) == 2
    rest, motion = found
    assert word(rest) == "ss" and word(motion) == "++"
    assert all(x == 0 for x in rest.accelerations.values())
    along = motion["M.acceleration.x"] * math.cos(tilt) + motion["M.acceleration.y"] * math.sin(
        tilt
    )
    assert along == pytest.approx(1, rel=1e-10)
    least = 2 * (1 + math.sqrt(2)) / math.sqrt(2)
    # both signs of the rod's reaction: its component along the lines is that of R cos alpha
    rods = [v["low.tangential_force"] + 1 for v in (rest.values, *rest.others)]
    assert sorted(rods) == pytest.approx(
        [-least * math.cos(math.pi / 4), least * math.cos(math.pi / 4)]
    )


@pytest.mark.parametrize(
    ("mu", "mu1", "alpha"), [(1.2, 0.3, 1.2), (3.0, 0.1, 1.2), (2.0, 0.5, 1.0)]
)
def test_two_motions_one_way_and_none_the_other_beyond_the_threshold(
    mu: float, mu1: float, alpha: float
) -> None:
    """Painleve 1895, pp. 36 and 93: mu - mu1 > 2 cot alpha, a pressing load."""
    assert mu - mu1 > 2 / math.tan(alpha)
    values = {"mu": mu, "mu1": mu1, "alpha": alpha, "X": 2.0, "X1": 1.0}
    assert words(LINES, **values, v0=1.0) == ["++", "++"]
    assert words(LINES, **values, v0=-1.0) == []
    below = {**values, "mu": mu1 + 1.99 / math.tan(alpha)}
    assert words(LINES, **below, v0=1.0) == ["++"]
    assert words(LINES, **below, v0=-1.0) == ["--"]


ROD = """
planar model Rod
  parameter Real mu = 1;
  parameter Angle theta = 63 deg;
  parameter Force up = 0 N;
  parameter Velocity slip = -1 m/s;
  parameter Mass m = 1 kg;
  body rod: rod(mass = m, length = 2 m);
  liaison tip: contact_ponctuel(ground.line, rod.start) with coulomb(mu);
  force lift: on(rod, value = (0 N, up));
initial
  rod.start.position = (0, 0) m;
  rod.angle = theta;
  rod.velocity = (slip, 0 m/s);
  rod.angular_velocity = 0 rad/s;
  experiment(stop = 0.5 s, on_indeterminate = stop, on_impasse = stop);
end Rod;
"""


def coefficient(mu: float, theta: float, m: float = 1.0) -> float:
    """p = (1 + 3 cos^2 - 3 mu sin cos)/m of a homogeneous rod that slips to its left."""
    c, s = math.cos(theta), math.sin(theta)
    return (1 + 3 * c * c - 3 * mu * s * c) / m


@pytest.mark.parametrize("m", [1.0, 1e6])
@pytest.mark.parametrize(
    ("mu", "up", "right"), [(1.0, 0.0, ["-"]), (1.6, 0.0, []), (1.6, 12.0, ["-", "o"])]
)
def test_a_rod_on_a_rough_line_has_one_two_or_no_motion(
    m: float, mu: float, up: float, right: list[str]
) -> None:
    """Painleve 1895, p. 20; p < 0 beyond mu = 4/3 at tan theta = 2."""
    assert words(ROD, mu=mu, up=up * m, m=m) == right
    for motion in compiled(ROD).motions(parameters={"mu": mu, "up": up * m, "m": m}):
        for law in motion.laws:
            assert law.painleve == pytest.approx(coefficient(mu, math.radians(63), m), rel=1e-9)


def test_the_threshold_of_a_homogeneous_rod_is_four_thirds() -> None:
    theta = math.atan(2)
    assert words(ROD, mu=4 / 3 - 1e-6, theta=theta) == ["-"]
    assert words(ROD, mu=4 / 3 + 1e-6, theta=theta) == []
    mirrored = {"theta": math.pi - theta, "slip": 1.0}
    assert words(ROD, mu=4 / 3 - 1e-6, **mirrored) == ["+"]
    assert words(ROD, mu=4 / 3 + 1e-6, **mirrored) == []


@pytest.mark.parametrize("m", [1.0, 1e6])
@pytest.mark.parametrize("mu", [1.35, 1.4, 2.0, 5.0])
@pytest.mark.parametrize("mirrored", [False, True])
def test_the_angles_without_motion_are_those_of_the_closed_form(
    mu: float, m: float, mirrored: bool
) -> None:
    """p = 0 at tan^2 - 3 mu tan + 4 = 0: to 1e-9 degrees; drawn up, two motions lie between."""
    root = math.sqrt(9 * mu * mu - 16)
    near = math.radians(1e-9)
    way = "+" if mirrored else "-"
    for tangent, outwards in (((3 * mu - root) / 2, -1), ((3 * mu + root) / 2, 1)):
        for side in (-1, 1):
            theta = math.atan(tangent) + side * near
            values = {"mu": mu, "m": m, "theta": math.pi - theta if mirrored else theta}
            values["slip"] = 1.0 if mirrored else -1.0
            outside = side == outwards
            assert words(ROD, **values) == ([way] if outside else [])
            assert words(ROD, up=12 * m, **values) == (["o"] if outside else [way, "o"])


def test_the_threshold_of_two_masses_on_a_rod_is_two_roots_of_two() -> None:
    """The inertia of two equal masses at the ends: k = half the length, mu = 2 sqrt 2 (p. 20)."""
    text = ROD.replace("rod(mass = m, length = 2 m)", "solid(mass = m, inertia = m*(1 m)^2)")
    text = text.replace("rod.start", "low").replace(
        "  liaison tip", "  frame low on rod at (-1 m, 0 m);\n  liaison tip"
    )
    # p = 1 + cos^2 - mu sin cos = 0 first at tan theta = sqrt 2
    theta = math.atan(math.sqrt(2))
    critical = 2 * math.sqrt(2)
    assert words(text, mu=critical - 1e-6, theta=theta) == ["-"]
    assert words(text, mu=critical + 1e-6, theta=theta) == []


def test_a_bar_on_four_feet_rests_up_to_its_limit_load_with_continuous_reactions() -> None:
    """mu 0.3, 0.35, 0.4, 0.45, pulled 0.2 m up: the limit load, by tipping moments, is 7.546 N."""
    places = [-0.6, -0.2, 0.2, 0.6]
    text = bar_on_feet(places, [0.3, 0.35, 0.4, 0.45], 0.2, "F", "").replace(
        "  body bar", "  parameter Force F = 0 N;\n  body bar"
    )
    assert words(text, F=7.546) == ["ssss"]
    assert words(text, F=7.547) == ["++++"]
    before = None
    for k in range(101):
        (rest,) = compiled(text).motions(parameters={"F": 7.546 * k / 100})
        forces = [rest[f"c{i}.normal_force"] for i in range(4)]
        if before is not None:
            assert max(abs(a - b) for a, b in zip(forces, before, strict=True)) < 0.75
        before = forces
