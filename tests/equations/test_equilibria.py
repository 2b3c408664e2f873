"""An equilibrium asked of all bodies is found, though fewer statements would do."""

from __future__ import annotations

from math import cos, pi, radians, sin, sqrt, tan

import pytest

import frot

G = 9.81

PENDULUM = """
planar model Hangs
  parameter Mass m = 1 kg;
  world(gravity = 9.81 m/s^2, down = {down});
  body a: rod(mass = m, length = 1 m);
  liaison A: rotoide(ground, a.start);
initial
  a.angular_acceleration = 0 rad/s^2;
  a.acceleration = (0, 0) m/s^2;
  a.tip.acceleration.x = 0 m/s^2;
  guess(a.angle = {guess} deg);
  experiment(stop = 10 ms);
end Hangs;
"""

LINKS = """
planar model Links
  parameter Mass m = 1 kg;
  body a: rod(mass = m, length = 1 m);
  body b: rod(mass = m, length = 1 m);
  body c: rod(mass = m, length = 1 m);
  frame far on ground at (1.5, 0) m;
  liaison A: rotoide(ground, a.start);
  liaison B: rotoide(a.tip, b.start);
  liaison C: rotoide(b.tip, c.start);
  liaison D: rotoide(c.tip, far);
initial
  {statements}
  guess(a.angle = -70 deg);
  guess(c.angle = 70 deg);
  experiment(stop = 10 ms);
end Links;
"""

CHAIN = """
planar model Chain
  parameter Integer n = {n};
  body l[n]: rod(mass = {mass} kg, length = {length} m);
  frame far on ground at (1, 0) m;
  liaison a: rotoide(ground, l[1].start);
  liaison p[n - 1]: rotoide(l[1:n - 1].tip, l[2:n].start);
  liaison b: rotoide(l[n].tip, far);
  output Force H = a.force.x;
initial
  for i in 1:n loop
    l[i].angular_acceleration = 0 rad/s^2;
  end for;
  {more}
  experiment(stop = 1 ms);
end Chain;
"""


@pytest.mark.parametrize(
    ("down", "guess", "angle"),
    [("-y", -70, -90), ("-y", 80, 90), ("+x", -20, 0), ("-x", 170, 180)],
)
@pytest.mark.parametrize("mass", [1.0, 1e6, 1e-6])
def test_a_pendulum_at_rest_may_be_stated_twice(down, guess, angle, mass):
    """Its centre does not accelerate where it turns at no rate: the second statement is true."""
    model = frot.compile(PENDULUM.format(down=down, guess=guess))
    run = model.simulate(parameters={"m": mass})
    assert run["a.angle"][0] == pytest.approx(radians(angle), abs=1e-12)
    assert abs(run["a.angular_velocity"][0]) < 1e-15


@pytest.mark.parametrize("mass", [1.0, 1e6])
def test_an_equilibrium_of_three_links_is_asked_of_all(mass):
    """The middle one is level; with 2 cos(a) = 0.5 the others stand as they reach."""
    at_rest = "".join(f"{x}.angular_acceleration = 0 rad/s^2;" for x in "abc")
    run = frot.compile(LINKS.format(statements=at_rest)).simulate(parameters={"m": mass})
    found = [run[f"{x}.angle"][0] for x in "abc"]
    assert found == pytest.approx([-1.3181160716528182, 0, 1.3181160716528182], abs=1e-12)
    assert [run[f"{x}.angular_velocity"][0] for x in "abc"] == pytest.approx([0, 0, 0], abs=1e-15)


@pytest.mark.parametrize(("n", "length", "mass"), [(4, 0.35, 0.1), (5, 0.25, 1e5)])
def test_a_chain_hangs_from_two_pins(n, length, mass):
    """Moments about the pins of a link: tan(angle) is its number from the middle times m g/H."""
    text = CHAIN.format(n=n, length=length, mass=mass, more="")
    run = frot.compile(text).simulate()
    pull = -run["H"][0]
    angles = [run[f"l[{i + 1}].angle"][0] for i in range(n)]
    assert pull > 0
    for i, angle in enumerate(angles):
        assert tan(angle) == pytest.approx((i - (n - 1) / 2) * mass * G / pull, abs=1e-9)
    assert length * sum(map(cos, angles)) == pytest.approx(1, abs=1e-12)
    for i in range(n):
        assert abs(run[f"l[{i + 1}].angular_velocity"][0]) < 1e-15


def test_a_statement_that_no_rest_meets_finds_a_speed():
    """The pin turns beside a stated angle: its centre has no acceleration along x at one speed."""
    text = """
    planar model Turns
      body a: rod(mass = 1 kg, length = 2 m);
      body b: rod(mass = 1 kg, length = 2 m);
      liaison A: rotoide(ground, a.start);
      frame beside on ground at (5, 0) m;
      liaison B: rotoide(beside, b.start);
    initial
      a.angular_acceleration = 0 rad/s^2;
      guess(a.angle = -80 deg);
      b.angle = 45 deg;
      b.acceleration.x = 0 m/s^2;
      guess(b.angular_velocity = 1 rad/s);
      experiment(stop = 1 ms);
    end Turns;
    """
    run = frot.compile(text).simulate()
    assert run["a.angle"][0] == pytest.approx(-pi / 2, abs=1e-12)
    # 0 = -w^2 cos(b) - b'' sin(b), with b'' = -(3/4) g cos(b) over an arm of 1 m
    assert run["b.angular_velocity"][0] == pytest.approx(sqrt(0.75 * G * sin(pi / 4)), rel=1e-9)


def test_what_contradicts_is_named_with_its_round_and_unit():
    """Free links cannot hang at rest beside heights that their angles do not reach."""
    text = """
    planar model Heights
      body l[3]: rod(mass = 1 kg, length = 2 m);
      liaison p[3]: rotoide(ground, l.start);
    initial
      for i in 2:3 loop
        l[i].tip.position.y = i*0.9 m;
      end for;
      experiment(stop = 1 ms);
    end Heights;
    """
    with pytest.raises(frot.FrotError) as fault:
        frot.compile(text).simulate()
    message = str(fault.value)
    assert "E0601" in message
    assert "`l[i].tip.position.y = i*0.9 m for i = 3`" in message
    assert "(by 0.7 m)" in message
