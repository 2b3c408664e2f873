"""Freedoms, redundant relations with their loops and cures, holonomy: what the report counts."""

import re
from pathlib import Path

import pytest

import frot

# Each is hyperstatic by itself: four parallel pins (3), six pins on the edges of a cube (1: R.
# Bricard 1897), four points on a plane (1). The last three are held by what is in their names.
SPACE = """
liaison Half(a: frame, b: frame)
  kinematic b.angular_velocity.z - 0.5*a.angular_velocity.z = 0;
end Half;

model Scenes "Loops side by side"
  parameter Length L = 1 m;
  parameter AngularVelocity w = 1 rad/s;
  body left:  rod(mass = 1 kg, length = L);
  body top:   rod(mass = 1 kg, length = L);
  body right: rod(mass = 1 kg, length = L);
  frame far on ground at (L, 0 m, 0 m);
  liaison A: {A}(ground, left.start{axis});
  liaison B: {B}(left.tip, top.start, axis = y);
  liaison C: rotoide(top.tip, right.tip, axis = y);
  liaison D: rotoide(far, right.start, axis = y);

  body b1: box(mass = 1 kg, size = (1, 0.1, 0.1) m);
  body b2: box(mass = 1 kg, size = (0.1, 1, 0.1) m);
  body b3: box(mass = 1 kg, size = (0.1, 0.1, 1) m);
  body b4: box(mass = 1 kg, size = (1, 0.1, 0.1) m);
  body b5: box(mass = 1 kg, size = (0.1, 1, 0.1) m);
  frame a1 on b1 at (-0.5, 0, 0) m;
  frame c1 on b1 at (0.5, 0, 0) m;
  frame a2 on b2 at (0, 0.5, 0) m;
  frame c2 on b2 at (0, -0.5, 0) m;
  frame a3 on b3 at (0, 0, -0.5) m;
  frame c3 on b3 at (0, 0, 0.5) m;
  frame a4 on b4 at (0.5, 0, 0) m;
  frame c4 on b4 at (-0.5, 0, 0) m;
  frame a5 on b5 at (0, -0.5, 0) m;
  frame c5 on b5 at (0, 0.5, 0) m;
  frame over on ground at (0, 0, 1) m;
  liaison J1: {J1}(ground, a1, axis = y);
  liaison J2: rotoide(c1, a2, axis = z);
  liaison J3: rotoide(c2, a3, axis = x);
  liaison J4: rotoide(c3, a4, axis = y);
  liaison J5: rotoide(c4, a5, axis = z);
  liaison J6: rotoide(c5, over, axis = x);

  body slab: box(mass = 1 kg, size = (1, 1, 0.5) m);
  frame f1 on slab at (0.5, 0.5, -0.25) m;
  frame f2 on slab at (-0.5, 0.5, -0.25) m;
  frame f3 on slab at (0.5, -0.5, -0.25) m;
  frame f4 on slab at (-0.5, -0.5, -0.25) m;
  {k1}liaison k1: contact_ponctuel(ground.plane, f1, unilateral = false);
  liaison k2: contact_ponctuel(ground.plane, f2, unilateral = false);
  liaison k3: contact_ponctuel(ground.plane, f3, unilateral = false);
  liaison k4: contact_ponctuel(ground.plane, f4, unilateral = false);

  body hoop: ring(mass = 1 kg, radius = 1 m);
  liaison rolls: roulement(ground.plane, hoop.rim);
  body p: box(mass = 2 kg, size = (0.3, 0.5, 0.7) m);
  body q: box(mass = 2 kg, size = (0.3, 0.5, 0.7) m);
  frame there on ground at (9, 0, 0) m;
  liaison P: rotoide(ground, p);
  liaison Q: rotoide(there, q);
  liaison gear: Half(p, q);
  body r: box(mass = 2 kg, size = (0.3, 0.5, 0.7) m);
  body s: box(mass = 2 kg, size = (0.3, 0.5, 0.7) m);
  liaison loose: Half(r, s);
  body arm: rod(mass = 1 kg, length = 1 m);
  liaison motor: rotoide(ground, arm.start) driven(angle = w*time);
  body needle: rod(mass = 1 kg, length = 1 m);
  liaison ball: spherique(ground, needle.start);
initial
  left.tip.position  = (0 m, 0 m, L);
  right.tip.position = (L, 0 m, L);
  guess(b1.position = (0.5, 0, 0) m);
  slab.position = (0, 0, 0.25) m;
  hoop.position = (0, 0, sin(1.2)) m;
  hoop.orientation = (cos(0.6), sin(0.6), 0, 0);
end Scenes;
"""
HYPERSTATIC = {"A": "rotoide", "B": "rotoide", "axis": ", axis = y", "J1": "rotoide", "k1": ""}


def test_redundant_relations_in_space_their_loops_and_their_cures() -> None:
    report = frot.compile(SPACE.format(**HYPERSTATIC)).report()
    found = {loop.undetermined[0][0]: loop for loop in report.analysis.loops}
    bars, bricard, table = (found[name] for name in ("A", "J1", "k1"))
    assert " ".join(bars.path) == "ground A left B top C right D ground"
    assert (bars.degree, bricard.degree, table.degree) == (3, 1, 1)
    assert bars.undetermined == (("A", 3), ("B", 3), ("C", 3), ("D", 3))
    assert bars.cure == (("A", "spherique"), ("B", "verrou"))
    assert bricard.cure == (("J1", "verrou"),)
    assert table.cure == (("k1", ""),)
    assert report.mobility.hyperstatic == 5
    # 1 + 1 + 3 of the loops, 3 of the hoop, 1 of the gears, 11 of two free bodies, 0, 3 of the rod
    # about a point, whose turn about itself is none
    assert report.mobility.degrees_of_freedom == 22
    sizes = {name: n for name, _, n in report.bodies}
    assert (sizes["left"], sizes["needle"], sizes["b1"]) == (6, 5, 6)
    lines = {x.name: x for x in report.liaisons}
    assert [lines[n].kinematic for n in ("rolls", "gear", "A")] == [2, 1, 0]
    assert [lines[n].holonomic for n in ("rolls", "gear", "loose", "A")] == [
        False,
        True,
        False,
        True,
    ]
    assert [lines[n].moves_with_time for n in ("motor", "A")] == [True, False]
    assert lines["motor"].relations == 6
    text = str(report)
    assert "3 relations too many: ground - A - left - B - top - C - right - D - ground" in text
    assert "isostatic with A as spherique, B as verrou" in text
    assert "3 relations, bilateral, 2 kinematic, not holonomic" in text


def test_the_cures_make_the_same_mechanisms_isostatic() -> None:
    cured = {"A": "spherique", "B": "verrou", "axis": "", "J1": "verrou", "k1": "// "}
    report = frot.compile(SPACE.format(**cured)).report()
    assert report.analysis.loops == ()
    assert report.mobility.hyperstatic == 0
    assert report.mobility.degrees_of_freedom == 22


PLANE = """
liaison Blade(a: frame, b: frame)
  kinematic dot(b.velocity, b.ey) = 0;
end Blade;

planar model Scenes "Loops side by side, and what rolls and cuts"
  parameter Length L = 1 m;
  body left:  rod(mass = 1 kg, length = L);
  body top:   rod(mass = 1 kg, length = 2*L);
  body right: rod(mass = 1 kg, length = L);
  body mid:   rod(mass = 1 kg, length = L);
  frame m on ground at (L, 0 m);
  frame far on ground at (2*L, 0 m);
  liaison A: rotoide(ground, left.start);
  liaison B: rotoide(left.tip, top.start);
  liaison C: rotoide(top.tip, right.tip);
  liaison D: rotoide(far, right.start);
  liaison M1: rotoide(m, mid.start);
  liaison M2: rotoide(mid.tip, top.G);

  body crank: rod(mass = 1 kg, length = 1 m);
  body coupler: rod(mass = 1 kg, length = 3 m);
  body rocker: rod(mass = 1 kg, length = 2.5 m);
  frame away on ground at (3, 0) m;
  liaison O: rotoide(ground, crank.start);
  liaison U: rotoide(crank.tip, coupler.start);
  liaison V: rotoide(coupler.tip, rocker.tip);
  liaison W: rotoide(away, rocker.start);

  body hoop: ring(mass = 1 kg, radius = 0.5 m);
  liaison rolls: roulement(ground.line, hoop.rim);
  body knife: rod(mass = 1 kg, length = 1 m);
  liaison cuts: Blade(ground, knife);
  body blade: rod(mass = 1 kg, length = 1 m);
  liaison rail: prismatique(ground, blade);
  liaison along: Blade(ground, blade);
  body block: box(mass = 1 kg, size = (1, 1) m);
  frame l on block at (-0.5, -0.5) m;
  frame r on block at (0.5, -0.5) m;
  frame over on block at (0, 0.5) m;
  liaison foot: contact_ponctuel(ground.line, l);
  liaison toe: contact_ponctuel(ground.line, r);
  liaison middle: contact_ponctuel(ground.line, over);
initial
  left.angle = {angle} rad;
  guess(mid.angle = {angle} rad);
  guess(right.angle = {angle} rad);
  crank.angle = 1 rad;
  hoop.position = (0, 0.5) m;
  block.position = (0, 0.5) m;
end Scenes;
"""


@pytest.mark.parametrize(("angle", "more"), [(1.2, 0), (0, 1)])
def test_loops_in_the_plane_rolling_blades_and_a_dead_centre(angle: float, more: int) -> None:
    """Three parallel legs are one too many; a flat parallelogram has one freedom more."""
    report = frot.compile(PLANE.format(angle=angle)).report()
    mobility = report.mobility
    degrees = {frozenset(n for n, _ in x.undetermined): x.degree for x in report.analysis.loops}
    assert degrees == {
        frozenset(("A", "B", "C", "D", "M1", "M2")): 1,
        frozenset(("rail", "along")): 1,
    }
    # the legs 1, the four-bar 1, hoop 1, knife 2, blade 1, block 3
    assert mobility.degrees_of_freedom == 9
    assert mobility.independent - mobility.independent_at_start == more
    assert (mobility.unilateral, mobility.touching, mobility.touching_independent) == (3, 2, 2)
    assert ("singular start" in str(report)) == bool(more)
    holonomic = {x.name: x.holonomic for x in report.liaisons if x.kinematic}
    assert holonomic == {"rolls": True, "cuts": False, "along": True}


COIN = """
liaison Upright(a: frame, b: frame)
  geometric b.ez.z = 0;
end Upright;

model Coin "It rolls upright: brackets of brackets are needed to see that nothing is integrable"
  body coin: ring(mass = 1 kg, radius = 0.5 m);
  liaison up: Upright(ground, coin);
  liaison rolls: roulement(ground.plane, coin.rim);
initial
  coin.position = (0, 0, 0.5) m;
  coin.orientation = (cos(pi/4), sin(pi/4), 0, 0);
end Coin;
"""


def test_frobenius_looks_at_brackets_of_brackets() -> None:
    report = frot.compile(COIN).report()
    assert {x.name: x.holonomic for x in report.liaisons} == {"up": True, "rolls": False}
    assert report.mobility.degrees_of_freedom == 2
    on_rails = COIN.replace(
        "liaison up", "liaison way: Straight(ground, coin);\n  liaison up"
    ).replace(
        "model",
        "liaison Straight(a: frame, b: frame)\n  geometric b.ez.x = 0;\nend Straight;\nmodel",
    )
    report = frot.compile(on_rails).report()
    assert all(x.holonomic for x in report.liaisons)


def test_what_is_not_looked_at_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    from frot.compiler.report import analysis

    text = """
planar model Hung "A rod on two pins"
  body arm: rod(mass = 1 kg, length = 1 m);
  liaison left: rotoide(ground, arm.start);
  frame wall on ground at (1, 0) m;
  liaison right: rotoide(wall, arm.tip);
end Hung;
"""
    found = str(frot.compile(text).report())
    assert "hyperstatic" in found
    assert "taken as independent" not in found
    assert "looked for" not in found
    monkeypatch.setattr(analysis, "MOST_RELATIONS", 3)
    monkeypatch.setattr(analysis, "MOST_SPEEDS", 0)
    told = frot.compile(text).report()
    assert "taken as independent    the 4 relations that left belongs to" in str(told)
    assert "(of 1 speeds no other is looked for)" in str(told)
    assert told.mobility.independent == 4


def test_what_is_no_mechanism_has_no_more_than_its_counts() -> None:
    text = """
model Rc "A circuit without bodies"
  Real u(start = 1);
equation
  der(u) = -u/(1 s);
end Rc;
"""
    report = frot.compile(text).report()
    assert re.fullmatch(r"Rc: equations only\n  variables 1, equations 1", str(report))
    assert report.analysis is None


def test_what_rolls_is_told_the_same_where_coordinates_keep_it() -> None:
    report = frot.load(Path(frot.__file__).parents[1] / "models" / "rolling_ring.frot").report()
    (rolls,) = report.liaisons
    assert (rolls.relations, rolls.kinematic, rolls.holonomic) == (3, 2, False)
    assert report.mobility.degrees_of_freedom == 3
    ways = "built into the coordinates, the rest kept by its reaction and projection"
    assert f"3 relations, bilateral, 2 kinematic, not holonomic; {ways}" in str(report)


def test_ranks_where_the_places_of_touch_are_solved_for() -> None:
    """A ball between two ellipsoids on a dome, told twice to touch one; another rolls by itself."""
    text = """
model Followed "Figures that touch where no formula says"
  body e: ellipsoid(mass = 1 kg, semi_axes = (0.3, 0.2, 0.15) m);
  body f: ellipsoid(mass = 1 kg, semi_axes = (0.3, 0.2, 0.15) m);
  body s: sphere(mass = 1 kg, radius = 0.1 m);
  body g: ellipsoid(mass = 1 kg, semi_axes = (0.3, 0.2, 0.15) m);
  surface dome on ground: implicit(z/(1 m) + 0.2*(x^2 + y^2)/(1 m^2));
  liaison A: contact_ponctuel(dome, e.surface, unilateral = false);
  liaison B: contact_ponctuel(dome, f.surface, unilateral = false);
  liaison C: contact_ponctuel(e.surface, s.surface, unilateral = false);
  liaison D: contact_ponctuel(f.surface, s.surface, unilateral = false);
  liaison E: contact_ponctuel(s.surface, f.surface, unilateral = false);
  liaison R: roulement(dome, g.surface);
initial
  guess(e.position = (0, 0, 0.15) m, f.position = (1, 0, 0) m, s.position = (0.5, 0, 0.2) m);
  guess(g.position = (-1, 0.2, 0) m);
end Followed;
"""
    report = frot.compile(text).report()
    assert (report.mobility.hyperstatic, report.mobility.degrees_of_freedom) == (1, 24 - 7)
    (loop,) = report.analysis.loops
    assert dict(loop.undetermined) == {"D": 1, "E": 1}
    assert {x.name: x.holonomic for x in report.liaisons}["R"] is False
    assert "energy\n" in str(report)


def test_hinges_on_one_shaft_are_one_loop_with_its_cure() -> None:
    """Five relations of the second say again what the first says, each by itself."""
    found = frot.compile("""
model Door "Two hinges"
  body d: box(mass = 1 kg, size = (0.8, 0.05, 2) m);
  frame h1 on ground at (0, 0, 0.5) m;
  frame h2 on ground at (0, 0, 1.5) m;
  frame g1 on d at (-0.4, 0, -0.5) m;
  frame g2 on d at (-0.4, 0, 0.5) m;
  liaison A: rotoide(h1, g1);
  liaison B: rotoide(h2, g2);
end Door;
""").report()
    [loop] = found.analysis.loops
    assert loop.degree == 5
    assert loop.left == 0
    assert dict(loop.cure) == {"A": "spherique", "B": "lineaire_annulaire"}


def test_the_energy_is_kept_where_a_loop_may_go_on_in_several_ways() -> None:
    """The second parallelogram starts folded up: about there states tell of nothing."""
    rods = "".join(f"  body {x}: rod(mass = 1 kg, length = 1 m);\n" for x in "abcde")
    found = frot.compile(
        "model Folded\n"
        + rods
        + """
  frame f1 on ground at (1, 0, 0) m;
  frame f2 on ground at (2, 0, 0) m;
  liaison A: rotoide(ground, a.start, axis = y);
  liaison B: rotoide(a.tip, b.start, axis = y);
  liaison C: rotoide(b.tip, c.tip, axis = y);
  liaison D: rotoide(f1, c.start, axis = y);
  liaison E: rotoide(b.tip, d.start, axis = y);
  liaison F: rotoide(d.tip, e.tip, axis = y);
  liaison G: rotoide(f2, e.start, axis = y);
initial
  guess(A.angle = -1.2, D.angle = -1.2, B.angle = 1.2, C.angle = 0);
end Folded;
"""
    ).report()
    assert [x.text for x in found.analysis.integrals] == ["energy"]


FOLDED = """
planar model Folded
  body a: rod(mass = 1 kg, length = 1 m);
  body b: rod(mass = 1 kg, length = 1 m);
  frame far on ground at ({} m, 0 m);
  liaison A: rotoide(ground, a.start);
  liaison B: rotoide(a.tip, b.start);
  liaison C: rotoide(b.tip, far);
end Folded;
"""


def test_a_loop_is_closed_from_rods_that_lie_in_a_line() -> None:
    """Folded rods turn about one pin; where a loop cannot be closed nothing is said to be held."""
    found = frot.compile(FOLDED.format(0)).report()
    assert (found.mobility.degrees_of_freedom, found.mobility.hyperstatic) == (1, 1)
    told = str(frot.compile(FOLDED.format(5)).report())
    assert "0  (where no relation follows from others)" in told
    assert "nothing can move" not in told


@pytest.mark.parametrize(
    ("joint", "nature"),
    [
        ("spherique(ground, b) driven(angular_velocity = (0, 0, 1) rad/s)",
         "6 relations, bilateral, 3 kinematic, holonomic"),
        ("libre(ground, b) driven(angular_velocity = (0, 0, 1) rad/s)",
         "3 relations, bilateral, kinematic, holonomic"),
        ("rotoide(ground, b) driven(speed = 1 rad/s*sin(time/(1 s)))",
         "6 relations, bilateral, 1 kinematic, holonomic, time-dependent"),
        ("prismatique(ground, b) driven(speed = u)",
         "6 relations, bilateral, 1 kinematic, holonomic or not"),
        ("rotoide(ground, b) driven(angle = time/(1 s))",
         "6 relations, bilateral, geometric, time-dependent"),
    ],
)  # fmt: skip
def test_a_prescribed_velocity_is_kinematic(joint: str, nature: str) -> None:
    text = f"""model Driven
      input Velocity u;
      body b: sphere(mass = 1 kg, radius = 0.1 m);
      liaison j: {joint};
    end Driven;
    """
    assert nature in str(frot.compile(text).report())
