"""`drag` with any exponent from 1 on: a body slows down as its closed form says."""

import pytest

import frot

TEXT = """
planar model Slowed
  world(gravity = 0 m/s^2);
  body a: particle(mass = 2 kg);
  body b: particle(mass = 2 kg);
  body c: particle(mass = 2 kg);
  force fa: drag(a, c = 3 N/(1 m/s)^1.5, exponent = 1.5);
  force fb: drag(b, c = 3 N.s^3/m^3, exponent = 3);
  force fc: drag(c, c = 3 N.s/m);
initial
  a.velocity = (2.4, 3.2) m/s;
  b.velocity = (2.4, 3.2) m/s;
  experiment(stop = 2 s, tolerance = 1e-11);
end Slowed;
"""


def test_a_body_slows_down_by_any_power_of_its_speed():
    # with k = c/m and v0 = 4: v^(1-n) = v0^(1-n) + (n - 1) k t
    run = frot.compile(TEXT).simulate()
    for name, n in (("a", 1.5), ("b", 3)):
        speed = (4 ** (1 - n) + (n - 1) * 1.5 * run.time) ** (1 / (1 - n))
        assert run[f"{name}.velocity.x"] == pytest.approx(0.6 * speed, rel=1e-9)
        assert run[f"{name}.velocity.y"] == pytest.approx(0.8 * speed, rel=1e-9)
    assert run["c.velocity.x"][-1] == 0


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ("c = 3 N.s/m, exponent = 3", r"E0301.*exponent 3 is in"),
        ("c = 3 N, exponent = 0", r"must be positive|E0305"),
        ("c = 3 N.s/m, exponent = 0.5", "E0305.*1 or more"),
    ],
)
def test_what_has_no_unit_is_told(given, message):
    text = TEXT.replace("c = 3 N.s/m)", f"{given})")
    with pytest.raises(frot.FrotError, match=message):
        frot.compile(text).simulate()
