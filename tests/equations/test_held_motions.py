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
