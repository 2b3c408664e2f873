"""What is held has exactly the speed that its contacts prescribe.

That is zero where nothing moves, and the speed of its carrier where it is carried along.
"""

from __future__ import annotations

import functools

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding

TOLERANCES = [1e-3, 1e-6, 1e-10, 1e-12]


@functools.cache
def pinched() -> frot.Model:
    """A disc between two pads on guides that press it; in the frame `way`, turned by `tilt`."""
    return frot.compile("""
planar model Pinched "Held by friction alone"
  parameter Real mu = 0.9;
  parameter Force press = 12 N;
  parameter Mass mass = 45 g;
  parameter Real grow = 0;
  parameter Angle tilt = 0;
  frame way on ground rotated(angle = tilt);
  body load: disc(mass = mass, radius = 4 mm);
  body left: box(mass = 2*mass, size = (10, 40) mm);
  body right: box(mass = 3*mass, size = (10, 40) mm);
  liaison guide_left: prismatique(way, left.G);
  liaison guide_right: prismatique(way, right.G);
  liaison grip_left: contact_ponctuel(load.rim, left.right) with coulomb(mu);
  liaison grip_right: contact_ponctuel(load.rim, right.left) with coulomb(mu);
  parameter Force weight = mass*9.81 m/s^2;
  force push_left: on(left, value = press*(1 + grow*time/(1 s))*way.ex + 2*weight*ground.ey);
  force push_right: on(right, value = -press*(1 + grow*time/(1 s))*way.ex + 3*weight*ground.ey);
  force lift: on(load, value = weight*sin(tilt)*way.ex);
initial
  load.position = (0, 0) m;
  guess(left.position = (-9*cos(tilt), -9*sin(tilt)) mm);
  guess(right.position = (9*cos(tilt), 9*sin(tilt)) mm);
  guess(load.angle = 0);
  grip_left.gap = 0 m;
  grip_right.gap = 0 m;
  experiment(stop = 100 s);
end Pinched;""")


@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize("scale", [1e-6, 1.0, 1.7, 1e6])
@pytest.mark.parametrize("tilt", [0.0, 0.3])
def test_a_disc_between_two_pads_does_not_move(tilt: float, scale: float, tolerance: float) -> None:
    """The pads may move with the disc along their guides, and nothing makes them: the forces on
    all three cancel. Also where they grow together."""
    for grow in (0.0, 0.013, 0.3):
        values = {"tilt": tilt, "mass": 0.045 * scale, "press": 12 * scale, "grow": grow}
        result = pinched().simulate(parameters=values, tolerance=tolerance)
        assert not result.events
        for body in ("load", "left", "right"):
            for axis in "xy":
                assert np.all(result[f"{body}.velocity.{axis}"] == 0)
                assert np.ptp(result[f"{body}.position.{axis}"]) == 0
        assert np.all(result["load.angular_velocity"] == 0)
        assert result.balance.residual == 0


@functools.cache
def carried() -> frot.Model:
    """A box that sticks to a cart on a slope; the cart is pushed to and fro."""
    return frot.compile("""
planar model Carried
  parameter Mass mass = 1 kg;
  parameter Angle tilt = 0;
  frame way on ground rotated(angle = tilt);
  body cart: box(mass = 2 kg, size = (0.4, 0.1) m);
  body load: box(mass = mass, size = (0.1, 0.1) m);
  liaison guide: prismatique(way, cart.G);
  liaison feet: appui_faces(load.bottom, cart.top) with coulomb(0.7);
  parameter Force push_size = (2 kg + mass)*1 m/s^2;
  force push: on(cart, value = push_size*sin(3*time/(1 s))*way.ex);
initial
  cart.position = (0, 0) m;
  cart.velocity = (0, 0) m/s;
  load.position = (-0.1*sin(tilt), 0.1*cos(tilt)) m;
  load.angle = tilt;
  experiment(stop = 2 s);
end Carried;""")


@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize("mass", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("tilt", [0.0, 0.1, 0.3])
def test_a_box_on_a_cart_moves_as_the_cart(tilt: float, mass: float, tolerance: float) -> None:
    """x(t) along the slope is (1/3) t - sin(3 t)/9 - g sin(tilt) t^2/2. The feet keep the box from
    turning, wherever the cart is."""
    result = carried().simulate(parameters={"tilt": tilt, "mass": mass}, tolerance=tolerance)
    assert not result.events
    assert np.abs(result["load.angular_velocity"]).max() < 1e-12
    assert np.ptp(result["load.angle"]) < 1e-12
    t = result.time
    along = t / 3 - np.sin(3 * t) / 9 - 9.81 * np.sin(tilt) * t**2 / 2
    size = np.abs(along).max()
    for body in ("cart", "load"):
        moved = result[f"{body}.position.x"] - result[f"{body}.position.x"][0]
        assert np.abs(moved - along * np.cos(tilt)).max() < (20 * tolerance + 1e-13) * size
    speed = np.abs(result["cart.velocity.x"]).max()
    difference = result["load.velocity.x"] - result["cart.velocity.x"]
    assert np.abs(difference).max() <= 8 * np.finfo(float).eps * speed


@functools.cache
def on_three_corners() -> frot.Model:
    """A box that three bilateral corners keep on a level plane; the force turns it too."""
    return frot.compile("""
model Three
  parameter Angle yaw = 0;
  parameter Length off = 0 m;
  body b: box(mass = 1 kg, size = (0.1, 0.1, 0.02) m);
  liaison f1: contact_ponctuel(b.corners[1], ground.plane, unilateral = false);
  liaison f2: contact_ponctuel(b.corners[2], ground.plane, unilateral = false);
  liaison f3: contact_ponctuel(b.corners[3], ground.plane, unilateral = false);
  parameter Force side = 2.5 N;
  force f: on(b.top, value = (side*cos(2*time/(1 s)), 0 N, 0 N));
  force turn: couple(b, value = (0 N.m, 0 N.m, side*off*cos(2*time/(1 s))));
initial
  b.position = (0, 0, 0.01) m;
  b.orientation = (cos(yaw/2), 0, 0, sin(yaw/2));
  experiment(stop = 1 s);
end Three;""")


@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize("off", [0.0, 1e-3])
def test_a_box_on_three_corners_stays_level(off: float, tolerance: float) -> None:
    """Three corners on a plane leave no tilt, wherever the box goes and however it turns: z and the
    axis are constant. x(t) = 0.625 (1 - cos 2t), and with J = m a^2/6 the couple makes the angular
    velocity side off sin(2t)/(2 J)."""
    for yaw in (0.0, 0.6, 2.0):
        values = {"yaw": yaw, "off": off}
        result = on_three_corners().simulate(parameters=values, tolerance=tolerance)
        for value in ("velocity.z", "angular_velocity.x", "angular_velocity.y"):
            assert np.all(result[f"b.{value}"] == 0)
        assert np.ptp(result["b.position.z"]) == 0
        exact = 0.625 * (1 - np.cos(2 * result.time))
        assert np.abs(result["b.position.x"] - exact).max() < 20 * tolerance + 1e-13
        turning = 750 * off * np.sin(2 * result.time)
        error = np.abs(result["b.angular_velocity.z"] - turning).max()
        assert error <= (20 * tolerance + 1e-13) * 750 * off
        assert result.figures.steps < 100
