"""A slip that friction holds is zero wherever the text writes it as a difference of speeds."""

import numpy as np
import pytest

import frot

# Two rotors in a clutch. Both turn as one while the couple between them, J_b/(J_a + J_b) of the
# drive, stays below the limit: the slip, written in four ways, is zero.
CLUTCH = """
model Together
  parameter AngularVelocity w0 = 0.3 rad/s;
  parameter Torque limit = 500 N.m;
  parameter Real sense = 1;
  parameter Real ratio = 1;
  parameter Inertia J = 1 kg.m^2;
  Angle a, b;
  AngularVelocity slip, shaft;
  Torque M;
  Integer up(start = 0), down(start = 0), below(start = 0), seen(start = 0);
  Real root = sqrt(abs(ratio*shaft - der(a))/(1 rad/s));
  output AngularVelocity twice = 2*(der(a) + 1 rad/s) - 2*ratio*der(b) - 2 rad/s;
initial
  a = 0 rad;
  b = 0 rad;
  der(a) = ratio*w0;
  der(b) = w0;
equation
  shaft = der(b);
  slip = ratio*shaft - der(a);
  M = friction(slip, limit);
  0.1*J*der(der(a)) = sense*(J/(1 kg.m^2))*5 N.m*sin(7*time/(1 s)) - M;
  J*der(der(b)) = ratio*M;
  when slip > 0 rad/s then
    up = pre(up) + 1;
  end when;
  when der(a) > ratio*shaft then
    down = pre(down) + 1;
  end when;
  when 3*(der(a) + 1 rad/s) - ratio*(der(b) + 2*shaft) < 3 rad/s then
    below = pre(below) + 1;
  end when;
  when abs(der(a) - ratio*der(b)) > 0 rad/s then
    seen = pre(seen) + 1;
  end when;
  experiment(stop = 4 s);
end Together;
"""


@pytest.fixture(scope="module")
def clutch() -> frot.Model:
    return frot.compile(CLUTCH)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9, 1e-12])
@pytest.mark.parametrize("w0", [0.0, 0.3, -0.7])
@pytest.mark.parametrize(("ratio", "inertia"), [(1, 1), (0.3, 1), (-7.1, 1e6), (1, 1e-6)])
def test_a_clutch_that_never_slips_fires_nothing(
    tolerance: float, w0: float, ratio: float, inertia: float, clutch: frot.Model
) -> None:
    given = {"w0": w0, "ratio": ratio, "J": inertia, "limit": 500 * inertia}
    result = clutch.simulate(parameters=given, tolerance=tolerance)
    assert [result[x][-1] for x in ("up", "down", "below", "seen")] == [0, 0, 0, 0]
    for name in ("slip", "root", "twice"):
        assert not result[name].any(), name
    assert not result.events and result.figures.steps < 200


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9, 1e-12])
@pytest.mark.parametrize(("w0", "ratio"), [(0.0, 1), (0.3, 1), (-0.7, 1), (0.3, 0.3)])
@pytest.mark.parametrize("sense", [1, -1])
def test_conditions_on_a_slip_change_where_its_mode_does(
    tolerance: float, w0: float, ratio: float, sense: int, clutch: frot.Model
) -> None:
    given = {"w0": w0, "limit": 3, "sense": sense, "ratio": ratio}
    result = clutch.simulate(parameters=given, tolerance=tolerance, interval=1e-3)
    starts = [e.time for e in result.events if e.kind == "slip"]
    # while both turn as one, the clutch carries this part of the drive
    part = 1 / (0.1 * ratio**2 + 1)
    first = np.arcsin(3 / (5 * part)) / 7
    assert starts[0] == pytest.approx(first, rel=10 * tolerance)
    assert len(starts) > 5
    for name, forward in (("up", True), ("down", False), ("below", True)):
        # each departure is forwards or backwards in turn, as the drive is
        senses = [sense * np.sin(7 * t) < 0 for t in starts]
        assert result[name][-1] == senses.count(forward), name
    texts = ("slip > 0 rad/s", "der(a) > ratio*shaft")
    risen = [e.time for e in result.events if e.text.startswith(texts) and "-> true" in e.text]
    assert risen == starts


# What the second clutch can carry follows the slip of the first; a brake acts on their difference.
BOUNDS = """
model Bounds
  Angle a, b, c;
  Torque M, N, P;
  parameter Torque limit = 50 N.m;
  AngularVelocity root;
initial
  a = 0 rad; b = 0 rad; c = 0 rad;
  der(a) = 0.3 rad/s; der(b) = 0.3 rad/s; der(c) = 2.3 rad/s;
equation
  root = sqrt(abs(der(b) - der(a))*(1 rad/s));
  M = friction(der(b) - der(a), limit);
  N = friction(der(c) - der(b), 0.4 N.m + 1e6 N.m.s*abs(der(a) - der(b)));
  P = 1e8 N.m.s*(der(a) - der(b)) + 1e3 N.m.s*root;
  0.1 kg.m^2*der(der(a)) = -M;
  1 kg.m^2*der(der(b)) = M - N;
  0.4 kg.m^2*der(der(c)) = 0.1 N.m*sin(3*time/(1 s)) + N + P;
  experiment(stop = 1 s);
end Bounds;
"""


@pytest.mark.parametrize("tolerance", [1e-3, 1e-8, 1e-12])
def test_bounds_and_loads_of_a_held_slip_are_exact(tolerance: float) -> None:
    result = frot.compile(BOUNDS).simulate(tolerance=tolerance)
    assert not result["root"].any() and not result["P"].any()
    assert set(result["N"]) == {-0.4}
    # the third is slowed by 0.4 N.m, from 2.3 rad/s
    t = 1.0
    expected = 2.3 + (0.1 * (1 - np.cos(3 * t)) / 3 - 0.4 * t) / 0.4
    assert result["der(c)"][-1] == pytest.approx(expected, rel=10 * tolerance)


CHAIN = """
model Chain
  Angle a, b, c;
  Torque M, N;
  Integer n(start = 0);
  output AngularVelocity whole = der(c) - der(a);
initial
  a = 0 rad; b = 0 rad; c = 0 rad;
  der(a) = 0.1 rad/s; der(b) = 0.1 rad/s; der(c) = 0.1 rad/s;
equation
  M = friction(der(b) - der(a), 50 N.m);
  N = friction(der(c) - der(b), 3 N.m);
  0.1 kg.m^2*der(der(a)) = 5 N.m*sin(7*time/(1 s)) - M;
  0.3 kg.m^2*der(der(b)) = M - N;
  0.9 kg.m^2*der(der(c)) = N;
  when der(c) - der(a) < 0 rad/s then
    n = pre(n) + 1;
  end when;
  experiment(stop = 0.5 s, interval = 1 ms);
end Chain;
"""


def test_a_sum_of_two_held_slips_is_zero_while_both_are_held() -> None:
    result = frot.compile(CHAIN).simulate()
    slip, stick = (next(e.time for e in result.events if e.kind == k) for k in ("slip", "stick"))
    # the second clutch carries 0.9/1.3 of the drive until then
    assert slip == pytest.approx(np.arcsin(3 / (5 * 0.9 / 1.3)) / 7, rel=1e-5)
    held = (result.time < slip) | (result.time > stick + 1e-12)
    assert not result["whole"][held].any() and result["whole"][~held].any()
    assert result["n"][-1] == 1


# A wheel that rolls until the thrust exceeds what friction can turn it by: 3 mu m g.
WHEEL = """
planar model Wheel
  parameter Real sense = 1;
  parameter Velocity v0 = 0.3 m/s;
  body d: disc(mass = 5 kg, radius = 33 mm);
  liaison c: contact_ponctuel(ground.line, d.rim) with coulomb(0.3);
  force f: on(d, value = (sense*100 N*sin(2*time/(1 s)), 0 N));
  Integer up(start = 0), down(start = 0), whole(start = 0);
initial
  d.position = (0 m, 33 mm);
  d.velocity = (v0, 0 m/s);
  d.angular_velocity = -v0/(33 mm);
equation
  when c.slip > 0 m/s then
    up = pre(up) + 1;
  end when;
  when d.velocity.x + 33 mm*d.angular_velocity < 0 m/s then
    down = pre(down) + 1;
  end when;
  when 0*c.slip + d.velocity.x > -33 mm*d.angular_velocity then
    whole = pre(whole) + 1;
  end when;
  experiment(stop = 1.5 s);
end Wheel;
"""


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9, 1e-12])
@pytest.mark.parametrize("v0", [0.0, 0.3])
@pytest.mark.parametrize("sense", [1, -1])
def test_a_wheel_that_begins_to_slip_does_so_once(tolerance: float, v0: float, sense: int) -> None:
    result = frot.compile(WHEEL).simulate(
        parameters={"sense": sense, "v0": v0}, tolerance=tolerance
    )
    (slip,) = (e for e in result.events if e.kind == "slip")
    assert slip.time == pytest.approx(np.arcsin(3 * 0.3 * 5 * 9.81 / 100) / 2, rel=10 * tolerance)
    count = (1, 0, 1) if sense > 0 else (0, 1, 0)
    assert tuple(result[x][-1] for x in ("up", "down", "whole")) == count
    assert {e.time for e in result.events if "-> true" in e.text} == {slip.time}
