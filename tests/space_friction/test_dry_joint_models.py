"""The models of `models/` with dry joints, against closed forms and Newton's and Euler's laws."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad
from space_models import G, last, loaded, run

import frot
from tests.space.newton_euler import Body, Link, Place, residual, vector


@pytest.mark.parametrize("offset", ["15 cm", "-15 cm"])
def test_the_drawer(offset: str) -> None:
    """M v = (1 - mu d/L) int P: it locks from mu = L/d = 4/3 on."""
    assert last(run("drawer", offset=offset), "rail.speed") == pytest.approx(
        [36 * (1 - 0.2 * 0.75) / 4], rel=1e-10
    )
    assert last(run("drawer", offset=offset, mu=1.34), "rail.speed") == [0]


@pytest.mark.parametrize("mass", ["40 kg", "1e6 kg", "1e-6 kg"])
def test_the_screw_jack(mass: str) -> None:
    h, arm, inertia = 0.03 / (2 * math.pi), 0.2 * 0.02, 0.15**2 / 2
    result = run("screw_jack", m=mass)
    (turns,) = (event.time for event in result.events)
    up = G * (h + arm) / (inertia + h * h + h * arm)
    down = G * (h - arm) / (inertia + h * h - h * arm)
    assert turns == pytest.approx(10 / up, rel=1e-10)
    assert last(result, "thread.speed") == pytest.approx([-down * (2.5 - turns)], rel=1e-9)
    held = run("screw_jack", m=mass, mu=0.24)
    assert held.events[-1].after == "stick"
    assert last(held, "thread.speed", "load.velocity.z") == [0, 0]


def test_the_shaft_in_a_bush() -> None:
    """It holds the push until the motor turns it; then it drifts to v = r w P/sqrt(F^2 - P^2).

    Its turning is that of the motor's couple less the friction on the rest of the slip.
    """
    result = loaded("shaft_in_a_bush").simulate(stop=30)
    assert result.at(0.999)["bush.speed"] == 0
    speed, turning = last(result, "bush.speed", "bush.speed_angle")
    friction = 0.3 * 2 * G
    assert speed == pytest.approx(0.05 * turning * 2 / math.sqrt(friction**2 - 4), rel=1e-9)
    couple = 0.05 * math.sqrt(friction**2 - 4)
    assert 20 * (1 - turning / 20) == pytest.approx(couple, rel=1e-9)


def test_the_dry_gimbal() -> None:
    brake = 0.1 * 0.05 * G / (0.4 * 0.2**2)
    times = [event.time for event in run("dry_gimbal").events]
    assert times == pytest.approx([2 / brake, 3 / brake], rel=1e-10)


def test_the_plate_on_a_slope() -> None:
    """P. Painlevé 1895, p. 71 of its centre, and delta m g cos(i)/I of its turning."""
    load, angle = G * math.sin(0.4), math.atan2(1, -0.5)
    k, u = 0.6 / math.tan(0.4), math.tan(angle / 2)
    c = 2 * math.hypot(0.5, 1) / (u ** (k - 1) + u ** (k + 1))
    slides = c / (2 * load) * (u ** (k - 1) / (k - 1) + u ** (k + 1) / (k + 1))
    turns = 10 * (0.4**2 + 0.3**2) / 12 / (0.02 * G * math.cos(0.4))
    result = run("plate_on_a_slope")
    assert [event.time for event in result.events] == pytest.approx([slides, turns], rel=1e-10)
    names = [f"plate.{x}.{c}" for x in ("velocity", "angular_velocity") for c in "xyz"]
    assert last(result, *names) == [0] * 6


def test_the_laws_compared() -> None:
    """Each of four pucks by its own closed form or quadrature; the smooth one never sticks."""
    result = run("laws_compared")
    stops = {event.liaison: event.time for event in result.events}
    exact = quad(lambda v: 1 / (G * (0.1 + 0.2 * math.exp(-((v / 0.5) ** 2)))), 0, 2)[0]
    assert stops == pytest.approx({"d": 2 / (0.1 * G), "s": exact}, rel=1e-8)
    assert result["oiled.velocity.x"] == pytest.approx(2 * np.exp(-2 * result.time), rel=1e-7)
    assert abs(last(result, "smooth.velocity.x")[0]) < 1e-9
    assert last(result, "dry.velocity.x", "stribeck_puck.velocity.x") == [0, 0]


BODIES = [
    Body("crank", 1, (0, 0.2**2 / 12, 0.2**2 / 12)),
    Body("link", 1, (5e-5, 0.0534, 0.0534)),
    Body("slider", 2, (2 * 0.02 / 12, 2 * 0.05 / 12, 2 * 0.05 / 12)),
]
LINKS = [
    Link("axle", Place(None, (0, 0, 0)), Place("crank", (-0.1, 0, 0))),
    Link("big", Place("crank", (0.1, 0, 0)), Place("link", (-0.4, 0, 0))),
    Link("small", Place("link", (0.4, 0, 0)), Place("slider", (0, 0, 0))),
    Link("guide", Place(None, (0, 0, 0.3)), Place("slider", (0, 0, 0))),
]


def test_the_spatial_slider_crank_satisfies_newton_euler_and_every_law() -> None:
    """The motor's couple is taken for a part of the axle's."""
    result = loaded("spatial_slider_crank").simulate()
    assert result.balance.relative < 1e-8
    moved = [Link("motor", *_places(LINKS[0]))]
    for t in (0.1, 0.3, 0.5, 0.7, 0.95):
        at = result.at(t)
        assert _left(result, moved, t) < 1e-7
        size = 0.1 * 0.01 * np.linalg.norm(vector(at, "axle.force"))
        friction = at["axle.torque.z"]
        assert friction == pytest.approx(-size * np.sign(at["axle.speed"]), rel=1e-8)
        for ball, (one, other) in {"big": ("crank", "link"), "small": ("link", "slider")}.items():
            size = 0.1 * 0.01 * np.linalg.norm(vector(at, f"{ball}.force"))
            omega = vector(at, f"{other}.angular_velocity") - vector(at, f"{one}.angular_velocity")
            couple = vector(at, f"{ball}.torque")
            assert couple == pytest.approx(-size * omega / np.linalg.norm(omega), rel=1e-7)
        force, couple = vector(at, "guide.force"), vector(at, "guide.torque")
        across, lever = force * (0, 1, 1), np.cross(couple, (1, 0, 0)) * (0, 1, 1) / 0.1
        ends = sum(np.linalg.norm(across + sign * lever) / 2 for sign in (1, -1))
        assert force[0] == pytest.approx(-0.1 * ends * np.sign(at["guide.speed"]), rel=1e-8)


def _places(link: Link) -> tuple[Place, Place]:
    return link.a, link.b


def _left(result: frot.Result, motor: list[Link], t: float) -> float:
    """The motor pushes the crank by 2 N m about z, which the residual must find missing."""

    class Motored:
        """The result with the motor's couple as one more reaction."""

        def at(self, time: float) -> dict[str, float]:
            values = dict(result.at(time))
            values |= {f"motor.{x}.{c}": 0.0 for x in ("force", "torque") for c in "xyz"}
            return values | {"motor.torque.z": 2.0}

    return residual(Motored(), BODIES, [*LINKS, *motor], [t])  # type: ignore[arg-type]
