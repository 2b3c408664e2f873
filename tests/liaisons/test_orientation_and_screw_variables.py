"""Variables that a text reads by name: the items of an orientation, the speed of a screw."""

import math

import numpy as np
import pytest

import frot

SPIN = """
model Spin
  world(gravity = 0 m/s^2);
  body a: {body};
  {liaison}
  output Real w = {of}.orientation.w;
  output Real x = {of}.orientation.x;
  output Real y = {of}.orientation.y;
  output Real z = {of}.orientation.z;
  output Real same[4] = {of}.orientation;
initial
  a.angular_velocity = (0.4, -0.5, 0.6) rad/s;
  experiment(stop = 2 s, tolerance = 1e-11);
end Spin;
"""


@pytest.mark.parametrize("of", ["a", "b"])
def test_the_items_of_an_orientation_have_names(of: str) -> None:
    """A sphere turns evenly: by |w| t about w."""
    liaison = "liaison b: spherique(ground, a);" if of == "b" else ""
    text = SPIN.format(body="sphere(mass = 1 kg, radius = 1 m)", liaison=liaison, of=of)
    result = frot.compile(text).simulate()
    axis = np.array([0.4, -0.5, 0.6])
    rate = np.linalg.norm(axis)
    assert result["w"] == pytest.approx(np.cos(rate * result.time / 2), abs=1e-9)
    for name, part in zip("xyz", axis / rate, strict=True):
        wanted = part * np.sin(rate * result.time / 2)
        assert result[name] == pytest.approx(wanted, abs=1e-9)
    for k, name in enumerate("wxyz", 1):
        assert np.array_equal(result[name], result[f"same[{k}]"])


def test_an_orientation_can_be_stated_item_by_item() -> None:
    text = SPIN.format(body="sphere(mass = 1 kg, radius = 1 m)", liaison="", of="a").replace(
        "initial\n", "initial\n  a.orientation.x = 0.6;\n  guess(a.orientation.w = 0.8);\n"
    )
    result = frot.compile(text).simulate()
    assert result["x"][0] == pytest.approx(0.6, abs=1e-12)
    assert result["w"][0] ** 2 + result["y"][0] ** 2 + result["z"][0] ** 2 == pytest.approx(0.64)


@pytest.mark.parametrize(("name", "code"), [("v", "E0203"), ("q", "E0203")])
def test_other_names_are_none_of_an_orientation(name: str, code: str) -> None:
    text = SPIN.format(body="sphere(mass = 1 kg, radius = 1 m)", liaison="", of="a")
    with pytest.raises(frot.FrotError, match=r"\.w, \.x, \.y, \.z") as refused:
        frot.compile(text.replace("a.orientation.w", f"a.orientation.{name}"))
    assert refused.value.diagnostics[0].code == code


def test_an_array_of_four_has_no_such_names() -> None:
    with pytest.raises(frot.FrotError, match="E0203"):
        frot.compile("model M\n  Real a[4] = (1, 2, 3, 4);\n  output Real w = a.w;\nend M;")


SCREW = """
model Screw "A nut on a vertical screw: m z'' and J phi'' with z = p phi/(2 pi)"
  parameter Length pitch = 0.2 m;
  body nut: disc(mass = 2 kg, radius = 0.3 m);
  liaison thread: helicoidale(ground, nut, pitch = pitch){driven};
  output AngularVelocity speed = thread.speed;
  output AngularVelocity rate = der(thread.angle);
  output Velocity rises = nut.velocity.z;
initial
  {initial}
  experiment(stop = 1 s, tolerance = 1e-11);
end Screw;
"""


@pytest.mark.parametrize("pitch", [0.2, -0.05, 3.0])
def test_the_speed_of_a_screw_is_the_rate_of_its_angle(pitch: float) -> None:
    model = frot.compile(SCREW.format(driven="", initial="thread.speed = 3 rad/s;"))
    result = model.simulate(parameters={"pitch": pitch})
    h = pitch / (2 * math.pi)
    rate = -2 * 9.81 * h / (2 * 0.3**2 / 2 + 2 * h * h)
    assert result["speed"] == pytest.approx(3 + rate * result.time, rel=1e-9)
    assert np.array_equal(result["speed"], result["rate"])
    assert result["thread.speed"] == pytest.approx(result["speed"], abs=0)
    assert result["rises"] == pytest.approx(h * result["speed"], rel=1e-12)


def test_the_speed_of_a_screw_can_be_driven() -> None:
    driven = " driven(speed = 2 rad/s*cos(time/(1 s)))"
    result = frot.compile(SCREW.format(driven=driven, initial="thread.angle = 0.1 rad;")).simulate()
    assert result["speed"] == pytest.approx(2 * np.cos(result.time), abs=1e-9)
    assert result["thread.angle"] == pytest.approx(0.1 + 2 * np.sin(result.time), abs=1e-9)
