"""What friction holds is zero to the last bit wherever the text reads it."""

import numpy as np
import pytest

import frot

TEXT = """
planar model Rolling "A disc with backspin comes to roll; beside it a rod rests in its dry pin"
  parameter Angle s = 0.3;
  parameter Real side = 1;
  body d: disc(mass = 5 kg, radius = 33 mm);
  curve l on ground: line(through = (0.3, 0.2) m, direction = (-cos(s), -sin(s)));
  liaison c: contact_ponctuel(l, d.rim) with coulomb(0.3);
  body base: rod(mass = 1 kg, length = 1 m);
  body bar: rod(mass = 1 kg, length = 1 m);
  liaison hinge: rotoide(ground, base.start);
  liaison pin: rotoide(base.tip, bar.start) with coulomb(1, radius = 0.3 m);
  Integer forward(start = 0), backward(start = 0);
  Boolean moves = side*c.slip < 0 m/s;
  output Velocity slip = c.slip;
  output Velocity less = -0.1*c.slip + 0*pin.speed*(1 m);
  output Acceleration rate = der(c.slip);
  output AngularVelocity turn = pin.speed;
  output Real sense = if c.slip > 0 m/s then 1 elseif c.slip < 0 m/s then -1 else 0;
  output Real rests = if c.mode == stick then 1 else 0;
initial
  c.gap = 0 m;
  d.velocity = side*(cos(s), sin(s)) m/s;
  d.angular_velocity = side*10 rad/s;
  base.angle = -60 deg;
  bar.angle = -50 deg;
equation
  when side*c.slip >= 0 m/s then
    forward = pre(forward) + 1;
  end when;
  when not moves then
    backward = pre(backward) + 1;
  end when;
  experiment(stop = 1 s);
end Rolling;
"""


@pytest.fixture(scope="module")
def model() -> frot.Model:
    return frot.compile(TEXT)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-8, 1e-12])
@pytest.mark.parametrize(("slope", "side"), [(0.3, 1), (-0.3, 1), (0.1, 1), (0.3, -1), (0.1, -1)])
def test_a_held_slip_is_zero_in_outputs_and_conditions(
    slope: float, side: int, tolerance: float, model: frot.Model
) -> None:
    result = model.simulate(parameters={"s": slope, "side": side}, tolerance=tolerance)
    (stick,) = (e for e in result.events if e.kind == "stick")
    # Friction slows the disc and its turn, which is twice as fast at the rim; the weight helps.
    lost = 9.81 * (3 * 0.3 * np.cos(slope) + side * np.sin(slope))
    assert stick.time == pytest.approx((1 + 10 * 0.033) / lost, rel=10 * tolerance)
    held = result.time > stick.time
    assert (result["rests"] == held).all() and held.sum() > 300
    for name in ("slip", "less", "rate", "sense", "c.slip"):
        assert not result[name][held].any(), name
        assert result[name][~held].all(), name
    assert not result["turn"].any()
    # Zero is not below zero, and not above.
    assert (result["forward"][-1], result["backward"][-1], result["moves"][-1]) == (1, 1, 0)


def test_an_output_of_what_is_held_leaves_the_motion_alone(model: frot.Model) -> None:
    named = ("slip", "less", "rate", "turn", "sense", "rests")
    shorter = [x for x in TEXT.splitlines() if not any(f" {n} = " in x for n in named)]
    bare = frot.compile("\n".join(shorter)).simulate(tolerance=1e-9)
    result = model.simulate(tolerance=1e-9)
    assert [e.time for e in bare.events] == [e.time for e in result.events]
    for name in ("d.position.x", "bar.angle", "c.slip"):
        assert (bare[name] == result[name]).all()


SHAFTS = """
model Shafts "Two shafts in a clutch, one of which hangs on a spring and a brake"
  import Rotational.*;
  model Motor "It rubs in itself; its power is told by somebody else"
    RotationalFlange a;
    AngularVelocity back "speed of the frame relative to the shaft";
    Power power;
  equation
    back = -der(a.angle);
    a.torque = friction(back, 3 N.m);
    power = 7 W*(2 + sin(3*time/(1 s)));
  end Motor;
  Inertia first(J = 0.37 kg.m^2), middle(J = 0.11 kg.m^2), last(J = 0.7 kg.m^2);
  Spring shaft(k = 100 N.m);
  Clutch clutch(mu = 0.3, radius = 130 mm);
  TorqueSource load;
  Motor motor;
  output AngularVelocity twice = 2*clutch.slip;
  output Power lost = clutch.friction_torque*clutch.slip;
  output Real sense = if clutch.slip > 0 rad/s then 1 elseif clutch.slip < 0 rad/s then -1 else 0;
  output AngularVelocity turn = motor.back;
initial
  first.angle = 0 rad; first.speed = 10 rad/s;
  middle.angle = 0 rad; middle.speed = 3 rad/s;
  last.angle = 0 rad; last.speed = 7 rad/s;
equation
  clutch.force = 50 N;
  load.torque = 0.1 N.m*sin(3*time/(1 s));
  connect(first.b, shaft.a);
  connect(shaft.b, middle.a);
  connect(middle.b, clutch.a);
  connect(clutch.b, last.a);
  connect(last.b, load.a);
  connect(first.a, motor.a);
  experiment(stop = 4 s, interval = 1 ms);
end Shafts;
"""


def spans(result: frot.Result, part: str) -> np.ndarray:
    """Where friction holds in a part, from its events; an instant on either side is left out."""
    held, begun = np.zeros(len(result.time), dtype=bool), None
    for event in (e for e in result.events if e.liaison == part):
        if event.kind == "stick":
            begun = event.time
        elif begun is not None:
            held |= (result.time > begun) & (result.time < event.time)
            begun = None
    return held if begun is None else held | (result.time > begun)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-8, 1e-12])
def test_a_slip_of_the_text_that_is_held_is_zero_to_the_last_bit(tolerance: float) -> None:
    result = frot.compile(SHAFTS).simulate(tolerance=tolerance)
    for part, names in {
        "clutch": ("clutch.slip", "twice", "lost", "sense"),
        "motor": ("motor.back", "turn"),
    }.items():
        held = spans(result, part)
        assert 100 < held.sum() < len(held) - 100, part
        for name in names:
            assert not result[name][held].any(), name
            assert result[name][~held].any(), name
    # What turns goes on turning, and a power that is not that of the friction stays what it is.
    assert result["middle.speed"][spans(result, "clutch")].any()
    expected = 7 * (2 + np.sin(3 * result.time))
    assert result["motor.power"] == pytest.approx(expected, rel=1e-14)


def test_outputs_that_read_a_slip_of_the_text_leave_the_motion_alone() -> None:
    without = "\n".join(x for x in SHAFTS.splitlines() if not x.startswith("  output"))
    one, other = (frot.compile(text).simulate() for text in (SHAFTS, without))
    assert [(e.time, e.text) for e in one.events] == [(e.time, e.text) for e in other.events]
    for name in ("first.angle", "last.speed", "clutch.slip", "clutch.friction_torque"):
        assert (one[name] == other[name]).all(), name


def test_a_slide_that_is_held_shows_no_slip() -> None:
    result = frot.compile("""
model Sledges
  import Translational.*;
  Mass a(m = 0.3 kg), b(m = 0.7 kg);
  Slide between(mu = 0.4);
  ForceSource push;
initial
  a.position = 0 m; a.speed = 1.7 m/s; b.position = 0 m; b.speed = 0.3 m/s;
equation
  between.normal_force = 10 N;
  push.force = 1 N*sin(5*time/(1 s));
  connect(a.b, between.a);
  connect(between.b, b.a);
  connect(b.b, push.a);
  experiment(stop = 3 s);
end Sledges;
""").simulate()
    held = spans(result, "between")
    assert held.sum() > 200 and not result["between.slip"][held].any()
    assert result["a.speed"][held].all()
