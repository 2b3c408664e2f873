"""Relations of one's own that hold variables and inputs, or are not linear in velocities."""

import numpy as np
import pytest

import frot

TEXT = """
liaison Gear(a: frame, b: frame, Real ratio)
  kinematic b.angular_velocity = ratio*a.angular_velocity;
end Gear;
liaison Along(a: frame, b: frame, Velocity v)
  kinematic b.velocity.x - a.velocity.x = v;
end Along;
liaison At(a: frame, b: frame, Length l)
  geometric b.position.x - a.position.x = l;
end At;
liaison Pace(a: frame, b: frame, Velocity v)
  kinematic norm(b.velocity - a.velocity) = v;
end Pace;
liaison Cam(a: frame, b: frame, Angle turn)
  geometric b.position.x - a.position.x = 0.2 m*sin(turn);
end Cam;
planar model Own
  parameter Mass m = 2 kg;
  parameter Velocity c = 3 m/s;
  input Velocity u(start = 0.5 m/s);
  Velocity r;
  Length l; Velocity dl;
  body p: disc(mass = m, radius = 0.2 m);
  body q: disc(mass = m, radius = 0.2 m);
  body d: particle(mass = m);
  body e: particle(mass = m);
  body f: particle(mass = m);
  body g: particle(mass = m);
  body wheel: disc(mass = 1 kg, radius = 0.5 m);
  body tappet: particle(mass = m);
  liaison gear: Gear(p, q, ratio = 1 + time/(1 s) + 0*r/(1 m/s));
  liaison along: Along(ground, d, v = r);
  liaison at: At(ground, e, l = l);
  liaison pace: Pace(ground, f, v = c);
  liaison given: Along(ground, g, v = u);
  liaison axle: rotoide(ground, wheel);
  liaison cam: Cam(ground, tappet, turn = axle.angle);
  output Force push = along.force.x;
  output Force hold = at.force.x;
  output Force brake = pace.force.x;
  output Force pressed = cam.force.x;
initial
  p.angular_velocity = 1 rad/s;
  r = 1 m/s;
  l = 1 m;
  dl = 0 m/s;
  f.velocity = (c, 0 m/s);
  axle.speed = 4 rad/s;
equation
  der(r) = -r/(1 s);
  der(l) = dl;
  der(dl) = -l/(1 s^2);
  experiment(stop = 0.8 s, tolerance = 1e-11);
end Own;
"""


@pytest.fixture(scope="module")
def run():
    return frot.compile(TEXT).simulate()


def test_a_gear_whose_ratio_a_variable_gives(run):
    # p' + r q' = 0 with q = r p: p sqrt(1 + r^2) stays
    ratio = 1 + run.time
    speed = np.sqrt(2 / (1 + ratio**2))
    assert run["p.angular_velocity"] == pytest.approx(speed, rel=1e-9)
    assert run["q.angular_velocity"] == pytest.approx(ratio * speed, rel=1e-9)


def test_a_speed_and_a_place_that_states_of_the_text_give(run):
    assert run["d.velocity.x"] == pytest.approx(np.exp(-run.time), rel=1e-9)
    assert run["push"] == pytest.approx(-2 * np.exp(-run.time), rel=1e-8)
    assert run["e.position.x"] == pytest.approx(np.cos(run.time), rel=1e-9)
    assert run["hold"] == pytest.approx(-2 * np.cos(run.time), rel=1e-8)
    assert run["g.velocity.x"] == pytest.approx(0.5, rel=1e-12)
    assert run["g.velocity.y"] == pytest.approx(-9.81 * run.time, abs=1e-9)


def test_a_relation_that_is_not_linear_in_velocities(run):
    # The reaction is along the velocity: its angle a follows c a' = -g cos(a), a Gudermannian.
    angle = -2 * np.arctan(np.tanh(9.81 * run.time / 6))
    assert run["f.velocity.x"] == pytest.approx(3 * np.cos(angle), abs=1e-8)
    assert run["f.velocity.y"] == pytest.approx(3 * np.sin(angle), abs=1e-8)
    assert run["brake"] == pytest.approx(2 * 9.81 * np.sin(angle) * np.cos(angle), abs=1e-7)


def test_a_relation_that_reads_a_coordinate_of_another_liaison(run):
    # (I + m s^2 cos(a)^2) w^2 stays, with I = 1/8 kg m^2 and s = 0.2 m
    angle, speed = run["axle.angle"], run["axle.speed"]
    assert run["tappet.position.x"] == pytest.approx(0.2 * np.sin(angle), abs=1e-9)
    carried = 0.125 + 2 * 0.04 * np.cos(angle) ** 2
    assert carried * speed**2 == pytest.approx((0.125 + 0.08) * 16, rel=1e-9)
    assert run["pressed"] == pytest.approx(2 * run["tappet.acceleration.x"], abs=1e-7)


def test_the_energy_balance_counts_what_keeps_them(run):
    gained = run["energy.kinetic"] + run["energy.potential"] - run["energy.work"]
    assert gained == pytest.approx(gained[0], abs=1e-8)


@pytest.mark.filterwarnings("error::RuntimeWarning")
def test_the_report_says_how_they_are_kept():
    told = {x.name: x for x in frot.compile(TEXT).report().liaisons}
    assert told["pace"].kept == told["at"].kept == "kept by an equation of the text each"
    assert (told["pace"].kinematic, told["at"].kinematic) == (1, 0)
    assert (told["pace"].relations, told["axle"].kept) == (1, "built into the coordinates")


def test_relations_without_a_meaning_are_told():
    liaison = "liaison L(a: frame, b: frame, Real x = 0) {} end L;"
    model = "planar model M body b: particle(mass = 1 kg); liaison l: L(ground, b); end M;"
    for relation, word in (
        ("geometric b.velocity.x = 0;", "b.velocity"),
        ("kinematic b.acceleration.x = 0;", "b.acceleration"),
    ):
        with pytest.raises(frot.FrotError, match=r"E0205.*does not hold '" + word):
            frot.compile(liaison.format(relation) + model).simulate()


@pytest.mark.parametrize(
    ("kind", "given", "told"),
    [
        ("curve", "ground", "'c' of 'On' is a curve, found point 'ground.origin'"),
        ("frame", "wire", "'c' of 'On' is a frame, found curve 'wire'"),
        ("curve", "wire", "needs two places that are frames, points or bodies"),
    ],
)
def test_places_of_another_kind_are_told(kind: str, given: str, told: str) -> None:
    """Relations hold variables, and a curve has none."""
    with pytest.raises(frot.FrotError) as raised:
        frot.compile(f"""
liaison On(a: frame, c: {kind})
  geometric a.position.x = 0 m;
end On;
model Wire "A box and a wire"
  body s: box(mass = 1 kg, size = (1, 1, 1) m);
  curve wire on ground: circle(radius = 1 m);
  liaison e: On(s, {given});
end Wire;
""").report()
    assert told in str(raised.value)


def test_equations_without_a_common_highest_derivative() -> None:
    """Two bodies beside each other, whose relations a decaying variable opens."""
    run = frot.compile("""
liaison Slide(a: frame, b: frame, Real z)
  geometric dot(b.position - a.position, a.ex) = z*(1 m);
  geometric dot(b.position - a.position, a.ey) = z*(1 m);
  geometric dot(a.ex, b.ey) = z;
  geometric dot(a.ey, b.ez) = z;
  geometric dot(a.ez, b.ex) = z;
end Slide;
liaison Cross(a: frame, b: frame, Real z)
  geometric b.position - a.position = z*(1, 1, 1)*(1 m);
  geometric dot(a.ex, b.ey) = z;
end Cross;
model Two
  body p: box(mass = 3 kg, size = (0.5, 0.4, 0.5) m);
  body q: box(mass = 1 kg, size = (0.4, 0.3, 0.4) m);
  frame f1 on ground at (0.1, -0.3, -0.5) m rotated(axis = (1, 1, 0.3), angle = 0.2);
  frame f2 on p at (-0.4, 0, 0) m rotated(axis = (-0.9, -0.6, -0.5), angle = 2);
  frame f3 on ground at (0.5, -0.1, -0.4) m rotated(axis = (-0.6, 0.8, 0), angle = 0.8);
  frame f4 on q at (-0.1, 0.4, 0.2) m rotated(axis = (0.6, -0.5, -0.8), angle = -2.3);
  Real z;
  liaison cross: Cross(f1, f2, z = z);
  liaison slide: Slide(f4, f3, z = z);
  output Length apart = f2.position - f1.position;
  output Real turned = dot(f1.ex, f2.ey);
  output Real across = dot(f4.ez, f3.ex);
initial
  z = 0.1;
equation
  der(z) = -z/(1 s);
  experiment(stop = 0.2 s);
end Two;
""").simulate()
    for name in ("apart.x", "apart.y", "apart.z", "turned", "across"):
        assert run[name] == pytest.approx(0.1 * np.exp(-run.time), abs=1e-8)
