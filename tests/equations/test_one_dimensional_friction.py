"""Clutches, brakes and bearings by the engine of friction, against closed forms."""

import numpy as np
import pytest

import frot

CLUTCH = """
model TwoDiscs
  import Rotational.*;
  parameter Torque drive = {drive} N.m;
  Inertia one(J = 2 kg.m^2);
  Inertia two(J = 3 kg.m^2);
  Clutch clutch(mu = {mu}, radius = 100 mm);
  TorqueSource motor;
initial
  one.speed = {w1} rad/s; two.speed = {w2} rad/s; one.angle = 0 rad; two.angle = 0 rad;
equation
  motor.torque = drive;
  clutch.force = 100 N;
  connect(motor.a, one.a);
  connect(one.b, clutch.a);
  connect(clutch.b, two.a);
  experiment(stop = 30 s, tolerance = 1e-10);
end TwoDiscs;
"""


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize(("drive", "mu"), [(0.0, 0.14), (1.0, 0.14), (0.5, 0.3)])
def test_a_clutch_locks_when_the_speeds_meet(drive: float, mu: float, sign: float) -> None:
    text = CLUTCH.format(drive=sign * drive, mu=mu, w1=sign * 10, w2=sign * 1)
    result = frot.compile(text).simulate()
    bound = mu * 0.1 * 100
    a1, a2 = (drive - bound) / 2, bound / 3
    meet = 9 / (a2 - a1)
    (event,) = result.events
    assert event.time == pytest.approx(meet, rel=1e-12)
    assert (event.liaison, event.before, event.after) == ("clutch", "slip", "stick")
    after = result.time > meet
    assert np.abs(result["clutch.slip"][after]).max() < 1e-14  # rounding of two speeds
    speed = 1 + a2 * meet + drive / 5 * (result.time[after] - meet)
    assert np.abs(result["one.speed"][after] - sign * speed).max() < 1e-9


def test_a_clutch_slips_again_when_the_drive_is_too_strong() -> None:
    text = CLUTCH.format(drive=0, mu=0.14, w1=0, w2=0).replace(
        "motor.torque = drive;", "motor.torque = 1 N.m/s*time;"
    )
    result = frot.compile(text).simulate(stop=5.0)
    # held until the couple on the second disc, 3/5 of the drive, is what the clutch can carry
    (event,) = result.events
    assert event.time == pytest.approx(1.4 * 5 / 3, rel=1e-10)
    assert (event.before, event.after) == ("stick", "slip")


SERIES = """
model Series "two brakes one behind the other: a shaft without inertia between them"
  import Rotational.*;
  Inertia disc(J = 1 kg.m^2);
  Inertia middle(J = {j} kg.m^2);
  Clutch first(mu = 0.1, radius = 1 m);
  Clutch second(mu = 0.2, radius = 1 m);
  Fixed wall;
  TorqueSource motor;
initial
  disc.speed = 0 rad/s; middle.speed = 0 rad/s; disc.angle = 0 rad; middle.angle = 0 rad;
equation
  motor.torque = 1 N.m/s*time;
  first.force = 10 N;
  second.force = 10 N;
  connect(motor.a, disc.a);
  connect(disc.b, first.a);
  connect(first.b, middle.a);
  connect(middle.b, second.a);
  connect(second.b, wall.a);
  experiment(stop = 2 s, tolerance = 1e-9);
end Series;
"""


@pytest.mark.parametrize("inertia", [1.0, 1e-6])
def test_two_stuck_elements_in_series_give_at_the_weaker_one(inertia: float) -> None:
    result = frot.compile(SERIES.format(j=inertia)).simulate()
    (event,) = result.events
    assert event.liaison == "first"
    assert event.time == pytest.approx(1.0, rel=1e-9)
    assert np.all(result["middle.speed"] == 0)


PARALLEL = """
model Parallel "two brakes on one shaft: what each carries at rest is not determined, the sum is"
  import Rotational.*;
  Inertia disc(J = 1 kg.m^2);
  Bearing left(sliding = 1 N.m);
  Bearing right(sliding = 2 N.m);
  TorqueSource motor;
initial
  disc.speed = {speed} rad/s; disc.angle = 0 rad;
equation
  motor.torque = {drive};
  connect(motor.a, disc.a);
  connect(disc.b, left.a);
  connect(disc.b, right.a);
  experiment(stop = 5 s, tolerance = 1e-10);
end Parallel;
"""


def test_two_stuck_elements_in_parallel_hold_together() -> None:
    result = frot.compile(PARALLEL.format(speed=0, drive="1 N.m/s*time")).simulate()
    assert {e.time for e in result.events} == {result.events[0].time}
    assert result.events[0].time == pytest.approx(3.0, rel=1e-9)
    exact = (result.time[result.time > 3] - 3) ** 2 / 2
    assert np.abs(result["disc.speed"][result.time > 3] - exact).max() < 1e-8


def test_elements_in_parallel_stop_a_disc_together_and_hold_it() -> None:
    result = frot.compile(PARALLEL.format(speed=6, drive="0 N.m")).simulate()
    assert result.events[0].time == pytest.approx(2.0, rel=1e-11)
    assert np.all(result["disc.speed"][result.time > 2.0] == 0)


PRESCRIBED = """
model Prescribed "a clutch between a shaft whose motion is prescribed and a disc"
  import Rotational.*;
  AngleSource shaft;
  Clutch clutch(mu = 0.1, radius = 1 m);
  Inertia disc(J = 1 kg.m^2);
initial
  disc.speed = 0 rad/s; disc.angle = 0 rad;
equation
  shaft.angle = 0.5*(1 - cos({w} rad/s*time));
  clutch.force = 10 N;
  connect(shaft.a, clutch.a);
  connect(clutch.b, disc.a);
  experiment(stop = 3 s, tolerance = 1e-10);
end Prescribed;
"""


def test_a_stuck_clutch_carries_a_prescribed_motion() -> None:
    # largest acceleration 0.5 w^2 = 0.72 rad/s^2, the clutch carries 1 N.m
    result = frot.compile(PRESCRIBED.format(w=1.2)).simulate()
    assert not result.events
    exact = 0.5 * (1 - np.cos(1.2 * result.time))
    assert np.abs(result["disc.angle"] - exact).max() < 1e-8


def test_it_slips_where_the_prescribed_motion_asks_too_much() -> None:
    result = frot.compile(PRESCRIBED.format(w=2.0)).simulate()
    assert result.events[0].time == 0 or result["clutch.mode"][0] == 2
    assert np.abs(np.diff(result["disc.speed"])).max() <= 1.0 * np.diff(result.time).max() + 1e-9


BOTH = """
model Both "both sides of the element are prescribed: its couple at rest is free"
  import Rotational.*;
  AngleSource one;
  AngleSource two;
  Clutch clutch(mu = 0.1, radius = 1 m);
equation
  one.angle = 1 rad/s*time;
  two.angle = {two};
  clutch.force = 10 N;
  connect(one.a, clutch.a);
  connect(clutch.b, two.a);
  experiment(stop = 2 s);
end Both;
"""


def test_an_element_between_two_prescribed_motions_neither_hangs_nor_fails() -> None:
    same = frot.compile(BOTH.format(two="1 rad/s*time + 0.3")).simulate()
    assert not same.events
    assert np.all(same["clutch.mode"] == 1)
    apart = frot.compile(BOTH.format(two="0.5 rad/s^2*time^2")).simulate()
    # relative speed t - 1: slips, meets at t = 1 and goes on the other way
    assert apart["clutch.friction_torque"][0] == pytest.approx(1.0)
    assert apart["clutch.friction_torque"][-1] == pytest.approx(-1.0)
    assert [e.time for e in apart.events] == pytest.approx([1.0], abs=1e-9)


BRAKE = """
model Stopping
  import Rotational.*;
  Inertia wheel(J = 2 kg.m^2);
  Brake brake(mu = 0.4, radius = 0.5 m);
initial
  wheel.speed = 8 rad/s; wheel.angle = 0 rad;
equation
  brake.force = if time > 1 s then 20 N else 0 N;
  connect(wheel.b, brake.a);
  experiment(stop = 10 s, tolerance = 1e-10);
end Stopping;
"""


def test_a_brake_stops_a_wheel_and_holds_it() -> None:
    result = frot.compile(BRAKE).simulate()
    stop = next(e for e in result.events if e.liaison == "brake")
    assert stop.time == pytest.approx(1 + 8 * 2 / 4, rel=1e-11)
    assert result["wheel.angle"][-1] == pytest.approx(8 + 16, rel=1e-10)
    assert np.all(result["wheel.speed"][result.time > stop.time] == 0)
