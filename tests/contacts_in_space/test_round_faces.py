"""Round faces on planes: they stand, lie, slide, spin to rest, tip and fall."""

from __future__ import annotations

import math

import numpy as np
import pytest

import frot

G = 9.81
TEXT = """
model Stands
  parameter Mass m = 1 kg;
  parameter Length r = 50 mm;
  parameter Angle tilt = 0;
  parameter Angle yaw = 0;
  parameter Angle way = 0;
  parameter Angle slope = 0;
  parameter Real mu = 0.5;
  parameter Velocity v = 0 m/s;
  parameter AngularVelocity w = 0 1/s;
  parameter Length h = 0 m;
  parameter Force pull = 0 N;
  world(gravity = 9.81 m/s^2, down = (-sin(tilt + slope), 0, -cos(tilt + slope)));
  frame f on ground at (1, 2, 3) m rotated(axis = y, angle = tilt);
  frame g on f at (0 m, 0 m, {half} + h) rotated(axis = z, angle = yaw);
  surface s on f: plane((0, 0, 0) m, normal = (0, 0, 1));
  body b: {shape};
  liaison c: appui_faces({places}) with coulomb(mu);
  force p: on(b, value = pull*time/(1 s)*(cos(way)*f.ex + sin(way)*f.ey));
initial
  b.position = g.position;
  b.orientation = g.orientation;
  b.velocity = v*f.ey;
  b.angular_velocity = w*f.ez;
  experiment(stop = 0.8 s, tolerance = 1e-10);
end Stands;
"""
CAN = "cylinder(mass = m, radius = r, length = 0.2 m)"


@pytest.fixture(scope="module")
def can() -> frot.Model:
    return frot.compile(TEXT.format(shape=CAN, half="0.1 m", places="b.rims[1], s"))


@pytest.fixture(scope="module")
def coin() -> frot.Model:
    shape = "disc(mass = m, radius = r)"
    return frot.compile(TEXT.format(shape=shape, half="0 m", places="s, b.rim"))


@pytest.mark.parametrize(
    ("mass", "tilt", "yaw"), [(1, 0, 0), (2e6, 0.7, 0.3), (3e-6, -2.4, math.pi / 2)]
)
def test_a_can_stands_until_it_tips(can: frot.Model, mass: float, tilt: float, yaw: float) -> None:
    """Pulled along x of the body, at its middle, it tips where F l/2 = m g r."""
    pull = 2 * mass * G
    given = {"m": f"{mass} kg", "tilt": tilt, "yaw": yaw, "way": yaw, "mu": 0.8}
    result = can.simulate(parameters=given | {"pull": f"{pull} N"})
    first = result.events[0]
    assert first.after == "open"
    assert first.time == pytest.approx(0.25, abs=1e-10)
    still = result.time < 0.25
    assert np.abs(result["b.velocity.x"][still]).max() == 0
    assert result["c.normal_force"][still] == pytest.approx(mass * G, rel=1e-9)


@pytest.mark.parametrize("yaw", [0.2, 0.35, 1.0])
def test_between_its_axes_it_tips_by_eight_percent_later_at_most(
    can: frot.Model, yaw: float
) -> None:
    """It tips over the nearest side, whose middle is at the angle a: where F l/2 cos a = m g r."""
    result = can.simulate(parameters={"yaw": yaw, "way": 0, "pull": f"{2 * G} N", "mu": 0.9})
    beside = abs((yaw + math.pi / 8) % (math.pi / 4) - math.pi / 8)
    assert result.events[0].time == pytest.approx(0.25 / math.cos(beside), abs=1e-9)


@pytest.mark.parametrize(("slope", "mu"), [(0.3, 0.32), (-0.2, 0.1)])
def test_a_can_on_a_slope_rests_or_slides(can: frot.Model, slope: float, mu: float) -> None:
    """It slides with g (sin - mu cos) where that is positive."""
    result = can.simulate(parameters={"slope": slope, "mu": mu, "m": "7 kg"})
    pace = G * max(math.sin(abs(slope)) - mu * math.cos(slope), 0)
    way = np.hypot(result["b.position.x"][-1] - 1, result["b.position.z"][-1] - 3.1)
    assert way == pytest.approx(pace * 0.32, abs=1e-9)
    assert np.abs(result["b.angular_velocity.y"]).max() < 1e-9


@pytest.mark.parametrize(("mass", "tilt"), [(0.01, 0), (1e6, 1.2)])
def test_a_coin_slides_to_rest(coin: frot.Model, mass: float, tilt: float) -> None:
    given = {"m": f"{mass} kg", "tilt": tilt, "v": "0.6 m/s", "mu": 0.2}
    result = coin.simulate(parameters=given)
    stop = 0.6 / (0.2 * G)
    assert {round(e.time, 9) for e in result.events} == {round(stop, 9)}
    assert result["b.position.y"][-1] == pytest.approx(2 + 0.3 * stop, abs=1e-9)
    assert result["b.velocity.y"][-1] == 0


@pytest.mark.parametrize("spin", [8, -3])
def test_a_coin_spins_to_rest_on_its_corners(coin: frot.Model, spin: float) -> None:
    """They press at r' = r/cos(pi/8): w' = -mu m g r'/(m r^2/2)."""
    result = coin.simulate(parameters={"w": f"{spin} 1/s", "mu": 0.3})
    far = 0.05 / math.cos(math.pi / 8)
    stop = abs(spin) * 0.05**2 / 2 / (0.3 * G * far)
    assert result.events[0].time == pytest.approx(stop, abs=1e-9)
    assert result["b.angular_velocity.z"][-1] == 0


@pytest.mark.parametrize(("mass", "tilt"), [(1, 0), (1e6, 0.9)])
def test_a_smooth_coin_falls_flat_and_lies(coin: frot.Model, mass: float, tilt: float) -> None:
    given = {"m": f"{mass} kg", "tilt": tilt, "h": "0.1 m", "mu": 0}
    result = coin.simulate(parameters=given)
    assert result.events[0].time == pytest.approx(math.sqrt(0.2 / G), abs=1e-11)
    lost = sum(e.energy_lost for e in result.events)
    assert lost == pytest.approx(mass * G * 0.1, rel=1e-9)
    assert result["c.normal_force"][-1] == pytest.approx(mass * G, rel=1e-9)
    assert abs(result["c.gap"][-1]) < 1e-12


@pytest.mark.parametrize(
    ("model", "a", "b"),
    [
        ("model", "coin.rim", "t.top"),
        ("planar model", "coin.rim", "ground.line"),
    ],
)
def test_a_rim_on_a_face_with_borders_and_in_the_plane_is_refused(
    model: str, a: str, b: str
) -> None:
    size = "(1, 1, 1) m" if model == "model" else "(1, 1) m"
    with pytest.raises(frot.FrotError, match=r"E0205.*appui_faces does not join"):
        frot.compile(f"""
            {model} Bad
              body t: box(mass = 1 kg, size = {size});
              body coin: disc(mass = 1 kg, radius = 0.1 m);
              liaison c: appui_faces({a}, {b});
              experiment(stop = 1 s);
            end Bad;
            """).simulate()
