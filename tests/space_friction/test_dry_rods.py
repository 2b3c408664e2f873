"""Massless rods (`tige`) whose ends turn in dry or viscous pins, in the plane and in space."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from space_models import G, last, model

import frot

PENDULUM = """
    {planar}model Pendulum
      parameter Mass m = 1 kg;
      parameter Real mu = 0.4;
      world(down = {down});
      body p: particle(mass = m);
      liaison on: tige({places}, length = 0.8 m) with {law};
      output Force pull = on.normal_force;
    initial
      p.position = {place} m;
      p.velocity = {speed} m/s;
      experiment(stop = 1.4 s, tolerance = 1e-11);
    end Pendulum;
    """
LENGTH, RADIUS = 0.8, 0.03


def swing(angle: float, rate: float, mu: float, c: float, stop: float) -> tuple[list[float], float]:
    """Reversals, last angle: L^2 a'' = -g L sin(a) - mu r |g cos(a) + L a'^2| sign(a') - c a'."""
    times: list[float] = []
    state, t = [angle, rate], 0.0

    def slope(_: float, x: np.ndarray, sign: float) -> list[float]:
        pull = abs(G * math.cos(x[0]) + LENGTH * x[1] ** 2)
        moment = -G * LENGTH * math.sin(x[0]) - mu * RADIUS * pull * sign - c * x[1]
        return [x[1], moment / LENGTH**2]

    def zero(_: float, x: np.ndarray, sign: float) -> float:
        return float(x[1])

    zero.terminal = True
    while t < stop:
        sign = math.copysign(1, state[1] or -state[0])
        zero.direction = -sign
        found = solve_ivp(
            slope, (t, stop), state, args=(sign,), events=zero, rtol=1e-12, atol=1e-13,
            method="DOP853",
        )  # fmt: skip
        t, state = float(found.t[-1]), [float(found.y[0, -1]), 0.0]
        if found.t_events[0].size:
            times.append(t)
    return times, state[0]


def unit_axes(turn: float) -> np.ndarray:
    """Columns: across the swing's plane, along it, up, all turned about (1, 2, 2)/3."""
    axis = np.array([1, 2, 2]) / 3
    cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + math.sin(turn) * cross + (1 - math.cos(turn)) * cross @ cross


@pytest.mark.parametrize("places", ["ground, p", "p, ground"])
@pytest.mark.parametrize("mass", [1, 1e6, 1e-6])
@pytest.mark.parametrize("angle", [1.2, -1.2])
@pytest.mark.parametrize("law", ["coulomb", "viscous", "both"])
@pytest.mark.parametrize("space", [False, True])
def test_a_pendulum_on_a_rod_in_a_rough_pin(
    places: str, mass: float, angle: float, law: str, space: bool
) -> None:
    """A particle has no angle: the pin at the ground alone rubs, by mu*radius times the pull."""
    mu = 0.4 if law != "viscous" else 0.0
    c = 0.05 if law != "coulomb" else 0.0
    dry, damped = "coulomb(mu, radius = 3 cm)", f"viscous({c * mass} N.m.s)"
    laws = {"coulomb": dry, "viscous": damped, "both": f"{dry}, {damped}"}[law]
    axes = unit_axes(0.7 if space else 0.0)
    along, up = (axes[:, 0], axes[:, 1]) if space else (np.array([1, 0]), np.array([0, 1]))

    def text(vector: np.ndarray) -> str:
        return "(" + ", ".join(str(float(x)) for x in vector) + ")"

    place = LENGTH * (math.sin(angle) * along - math.cos(angle) * up)
    scene = model(
        PENDULUM.format(
            planar="" if space else "planar ", down=text(-up), places=places, law=laws,
            place=text(place), speed=text(0 * along),
        )
    )  # fmt: skip
    result = scene.simulate(parameters={"m": f"{mass} kg"})
    times, end = swing(angle, 0, mu, c, 1.4)
    here = np.array(last(result, *(f"p.position.{c}" for c in ("xyz" if space else "xy"))))
    assert math.atan2(here @ along, -(here @ up)) == pytest.approx(end, abs=1e-8)
    if not space:
        turns = [e.time for e in result.events if "reverses" in str(e)]
        assert mu == 0 or turns == pytest.approx(times, abs=1e-9)
    assert result.balance.relative < 1e-8


def test_a_rod_rests_within_the_angle_of_its_pin() -> None:
    """It holds up to L sin(a) = mu r cos(a)."""
    limit = math.atan(0.4 * RADIUS / LENGTH)
    for angle, rests in ((limit * (1 - 1e-8), True), (limit * (1 + 1e-6), False)):
        place = (LENGTH * math.sin(angle), -LENGTH * math.cos(angle))
        scene = model(
            PENDULUM.format(
                planar="planar ", down="-y", places="ground, p", law="coulomb(mu, radius = 3 cm)",
                place=place, speed=(0, 0),
            )
        )  # fmt: skip
        assert (last(scene.simulate(stop=0.1), "p.velocity.x") == [0]) == rests


COUPLED = """
    {planar}model Coupled
      world(gravity = 0 m/s^2);
      body p: {disc};
      body q: {disc};
      frame right on ground at {far} m;
      frame pin_p on p at {up} m;
      frame pin_q on q at {up} m;
      liaison a: rotoide(ground, p);
      liaison b: rotoide(right, q);
      {between}
      force load: couple(b, value = -0.5 N.m);
    initial
      a.angle = 0.3 rad;
      a.speed = {spin} rad/s;
      guess(b.angle = 0.3 rad);
      experiment(stop = 0.35 s, tolerance = 1e-11);
    end Coupled;
    """
ROD = "liaison on: tige(pin_p, pin_q, length = 0.8 m) with coulomb(0.5, radius = 2 cm);"
BODY = """
      body r: rod(mass = 1e-7 kg, length = 0.8 m);
      liaison on: rotoide(pin_p, r.start) with coulomb(0.5, radius = 2 cm);
      liaison other: rotoide(r.tip, pin_q) with coulomb(0.5, radius = 2 cm);
      """


@pytest.mark.parametrize("spin", [3, -3])
def test_a_rod_between_two_discs_rubs_at_both_ends(spin: float) -> None:
    """As a light rod in two pins does, to half the square of 2*mu*r/L: R is the pull alone."""
    plane = {"planar": "planar ", "far": (0.8, 0), "up": (0, 0.1), "spin": spin}
    space = {"planar": "", "far": (0.8, 0, 0), "up": (0, 0.1, 0), "spin": spin}
    disc = "disc(mass = 1 kg, radius = 20 cm)"
    rod, light, turned = (
        model(COUPLED.format(disc=disc, between=between, **where)).simulate()
        for between, where in ((ROD, plane), (BODY, plane), (ROD, space))
    )
    names = ("a.angle", "b.angle", "a.speed")
    assert last(rod, *names) == pytest.approx(last(light, *names), abs=3e-4)
    assert last(rod, *names) == pytest.approx(last(turned, *names), abs=1e-9)
    assert rod.balance.dissipated == pytest.approx(light.balance.dissipated, rel=4e-4)


@pytest.mark.parametrize(
    ("law", "code"),
    [
        ("coulomb(0.1)", "E0204"),
        ("viscous(1 N.s/m)", "E0"),
        ("coulomb(0.1, half_length = 1 m)", "E0"),
    ],
)
def test_laws_of_a_rod_are_couples(law: str, code: str) -> None:
    """It has no slip, and no half length."""
    text = PENDULUM.format(
        planar="planar ", down="-y", places="ground, p", law=law, place=(0, -0.8), speed=(0, 0)
    )
    with pytest.raises(frot.FrotError, match=code):
        model(text).simulate()


def test_a_rod_in_the_plane_has_no_one_slip() -> None:
    """It turns at two ends: no number is shown in its place."""
    text = PENDULUM.format(
        planar="planar ", down="-y", places="ground, p", law="coulomb(0.1, radius = 1 mm)",
        place=(0, -0.8), speed=(0, 0),
    ).replace("normal_force", "slip").replace("Force pull", "Velocity pull")  # fmt: skip
    with pytest.raises(frot.FrotError, match="E0203"):
        model(text).simulate()


def test_friction_of_a_rod_whose_length_an_equation_prescribes_is_refused() -> None:
    """Its reaction is an unknown of the text; a length that follows time keeps its pins."""
    text = """
        model Drawn
          body p: particle(mass = 1 kg);
          Length x;
          liaison on: tige(ground, p) driven(length = VALUE) with coulomb(0.4, radius = 1 cm);
        initial
          p.position = (1, 0, 0) m;
        equation
          x = 1 m + 0.1 m*sin(time/(1 s));
          experiment(stop = 0.1 s);
        end Drawn;
        """
    with pytest.raises(frot.FrotError, match=r"E0701.*length an equation prescribes"):
        model(text.replace("VALUE", "x")).simulate()
    result = model(text.replace("VALUE", "1 m + 0.1 m*sin(time/(1 s))")).simulate()
    assert last(result, "p.position.x")[0] > 0
