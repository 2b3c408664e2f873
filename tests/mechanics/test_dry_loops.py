"""Loops of pins with friction in every one: a body beside the last is taken in two halves."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import frot

PINS = {"A": ("ground", "crank.start"), "B": ("crank.tip", "coupler.start")}
PINS |= {"C": ("coupler.tip", "rocker.tip"), "D": ("far", "rocker.start")}
LENGTH = {"crank": 0.3, "coupler": 1.0, "rocker": 0.8}
MASS = {"crank": 1.0, "coupler": 2.0, "rocker": 1.5}
RADIUS, G = 0.012, 9.81
ENDS = {"start": -0.5, "tip": 0.5}


def four_bar(order: str = "ABCD", swapped: str = "", scale: float = 1.0, mu: float = 0.25) -> str:
    """The pins in this order of the text; those named in `swapped` with their places exchanged."""
    bodies = [f"body {n}: rod(mass = {MASS[n] * scale} kg, length = {LENGTH[n]} m);" for n in MASS]
    pins = []
    for name in order:
        a, b = PINS[name][::-1] if name in swapped else PINS[name]
        law = f"coulomb({mu}, radius = {RADIUS} m)"
        pins.append(f"liaison {name}: rotoide({a}, {b}) with {law};")
    return "\n".join(
        [
            "planar model FourBar",
            *bodies,
            "frame far on ground at (0.9 m, 0 m);",
            *pins,
            f"force push: couple(crank, value = {6 * scale} N.m*sin(3 rad/s*time));",
            "initial",
            "  crank.angle = 60 deg; crank.angular_velocity = 8 rad/s;",
            "  guess(rocker.angle = 80 deg, coupler.angle = 30 deg);",
            "  experiment(stop = 1.5 s, tolerance = 1e-10);",
            "end FourBar;",
        ]
    )


def turned(angle: float, way: np.ndarray) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([c * way[0] - s * way[1], s * way[0] + c * way[1]])


@pytest.mark.parametrize("scale", [1.0, 1e6, 1e-6])
def test_newton_euler_the_loop_and_the_law_hold_in_every_pin(scale: float) -> None:
    """Read from the results alone, and written here for themselves."""
    result = frot.compile(four_bar(swapped="BD", scale=scale)).simulate()
    events = [0.0, *sorted({e.time for e in result.events}), 1.5]
    times = [(a + b) / 2 for a, b in itertools.pairwise(events) if b - a > 1e-6]
    assert len(times) > 8  # it slips to and fro
    for t in times:
        now = result.at(t)

        def vector(name: str, now: object = now) -> np.ndarray:
            return np.array([float(now[f"{name}.{k}"]) for k in "xy"])  # type: ignore[index]

        force = {n: np.array([0.0, -m * scale * G]) for n, m in MASS.items()}
        moment = dict.fromkeys(MASS, 0.0)
        moment["crank"] += 6 * scale * np.sin(3 * t)
        for name, places in PINS.items():
            places = places[::-1] if name in "BD" else places
            reaction, couple = vector(f"{name}.force"), float(now[f"{name}.torque"])
            spots, spins = [], []
            for place, sign in zip(places, (-1.0, 1.0), strict=True):
                body, _, end = place.partition(".")
                if not end:
                    spots.append(np.array([0.9, 0.0]) if body == "far" else np.zeros(2))
                    spins.append(0.0)
                    continue
                angle = float(now[f"{body}.angle"])
                arm = turned(angle, np.array([ENDS[end] * LENGTH[body], 0.0]))
                spots.append(vector(f"{body}.position") + arm)
                spins.append(float(now[f"{body}.angular_velocity"]))
                force[body] = force[body] + sign * reaction
                moment[body] += sign * (couple + arm[0] * reaction[1] - arm[1] * reaction[0])
            assert np.max(np.abs(spots[0] - spots[1])) < 1e-13
            bound = 0.25 * RADIUS * float(np.hypot(*reaction))
            slip = spins[1] - spins[0]
            if int(now[f"{name}.mode"]) == 2:
                assert abs(couple + np.sign(slip) * bound) < 1e-9 * bound
            else:
                assert abs(couple) < bound * (1 + 1e-9) and abs(slip) < 1e-12
        for n, m in MASS.items():
            size = scale * (m * G + 6)
            rest = force[n] - m * scale * vector(f"{n}.acceleration")
            inertia = m * scale * LENGTH[n] ** 2 / 12
            turning = moment[n] - inertia * float(now[f"{n}.angular_acceleration"])
            assert np.max(np.abs(rest)) < 1e-9 * size and abs(turning) < 1e-9 * size
    assert result.balance.relative < 1e-9


def test_it_does_not_matter_where_the_loop_is_taken_apart() -> None:
    finals = [
        frot.compile(four_bar(order)).simulate().at(1.5) for order in ("ABCD", "DCBA", "BADC")
    ]
    for other in finals[1:]:
        for name in ("crank.angle", "rocker.angular_velocity", "C.force.x", "B.torque"):
            assert abs(other[name] - finals[0][name]) < 1e-7 * max(1.0, abs(finals[0][name]))


def test_the_halves_are_not_told() -> None:
    model = frot.compile(four_bar())
    result = model.simulate(stop=0.1)
    assert not any("'" in name for name in (v.name for v in result.program.variables))
    assert model.report().mobility.degrees_of_freedom == 1
    assert "rocker'" not in str(model.report())
    told = frot.compile(four_bar(mu=0.0)).simulate()
    assert abs(result.at(0.0)["energy.kinetic"] - told.at(0.0)["energy.kinetic"]) < 1e-12


BOWL = """
planar model RodInBowl
  world(gravity = 9.81 m/s^2);
  parameter Angle start = 0 deg;
  parameter Real mu = 0;
  body bar: rod(mass = 1 kg, length = 1 m);
  curve bowl on ground: circle(centre = (0, 0) m, radius = 1 m);
  liaison A: point_courbe(bar.start, bowl) with coulomb(mu);
  liaison B: point_courbe(bar.tip, bowl) with coulomb(mu);
initial
  bar.angle = start;
  guess(bar.position = (0, -0.866) m);
  bar.angular_velocity = 0 rad/s;
  experiment(stop = 1 s, tolerance = 1e-9);
end RodInBowl;
"""


def test_a_rod_with_both_ends_on_a_circle_stays_in_its_equilibrium() -> None:
    """What rounding moves there has no energy to lose; beside it the rod swings."""
    model = frot.compile(BOWL)
    arm, gyration = np.sqrt(0.75), 1 / 12
    way = np.cos(np.sqrt(G * arm / (gyration + arm**2)))
    for start, stays in ((0.0, 0.0), (np.pi, np.pi), (1e-6, 1e-6 * way)):
        result = model.simulate(parameters={"start": start})
        assert result["bar.angle"][-1] == pytest.approx(
            stays, abs=1e-14 + 1e-8 * abs(start % np.pi)
        )
    assert model.simulate(parameters={"start": 0.3, "mu": 1.0})["bar.angle"][-1] == 0.3
