"""Relations that say twice what holds: at every tolerance, the motion of the mechanism without."""

from __future__ import annotations

import numpy as np
import pytest

import frot

BODIES = """
  body l: rod(mass = {m} kg, length = 0.3 m);
  body m: rod(mass = {m} kg, length = 0.3 m);
  body r: rod(mass = {m} kg, length = 0.3 m);
  body top: rod(mass = {t} kg, length = 1 m);
  frame f1 on ground at ({half});
  frame f2 on ground at ({whole});
  liaison A: rotoide(ground, l.start{axis}){dry};
  liaison B: rotoide(l.tip, top.start{axis});
  liaison C: rotoide(m.tip, top{axis});
  liaison D: rotoide(f1, m.start{axis});
  liaison E: rotoide(r.tip, top.tip{axis});
  liaison F: rotoide(f2, r.start{axis});
"""
G, LEG = 9.81, 0.3


def three_legs(m: float = 1.0, t: float = 2.0, dry: str = "") -> str:
    places = {"half": "0.5 m, 0 m", "whole": "1 m, 0 m", "axis": ""}
    initial = "l.angle = 60 deg; guess(m.angle = 60 deg, r.angle = 60 deg);"
    text = BODIES.format(m=m, t=t, dry=dry, **places)
    return f"planar model Legs\n{text}initial\n  {initial}\nend Legs;\n"


def in_space() -> str:
    """The same about y, where z is up: three loops of six relations each."""
    places = {"half": "0.5 m, 0 m, 0 m", "whole": "1 m, 0 m, 0 m", "axis": ", axis = y"}
    initial = (
        "A.angle = -60 deg; A.speed = 0 rad/s;\n"
        "guess(D.angle = -60 deg, F.angle = -60 deg, B.angle = 60 deg);"
    )
    text = BODIES.format(m=1.0, t=2.0, dry="", **places)
    return f"model Legs\n{text}initial\n  {initial}\nend Legs;\n"


def angle_at(stop: float, m: float = 1.0, t: float = 2.0) -> float:
    """Every leg turns alike: (3 m l^2/3 + t l^2) th'' = -(3 m/2 + t) g l cos th."""
    from scipy.integrate import solve_ivp

    inertia, moment = (m + t) * LEG**2, (1.5 * m + t) * G * LEG
    run = solve_ivp(
        lambda _, x: [x[1], -moment / inertia * np.cos(x[0])],
        (0, stop),
        [np.pi / 3, 0.0],
        method="DOP853",
        rtol=1e-13,
        atol=1e-14,
    )
    return float(run.y[0, -1])


@pytest.mark.parametrize("masses", [(1.0, 2.0), (1e6, 2.0), (1.0, 2e6)])
def test_a_third_leg_changes_nothing_at_any_tolerance(masses: tuple[float, float]) -> None:
    model, expected = frot.compile(three_legs(*masses)), angle_at(0.25, *masses)
    for tolerance in (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-10, 1e-12):
        now = model.simulate(stop=0.25, tolerance=tolerance).at(0.25)
        error = max(abs(now[f"{leg}.angle"] - expected) for leg in "lmr")
        assert error < 10 * tolerance + 1e-12, (tolerance, error)
        assert abs(now["top.angle"]) < 1e-13


def test_nor_in_space() -> None:
    model, expected = frot.compile(in_space()), angle_at(0.25)
    for tolerance in (1e-4, 1e-6, 1e-8, 1e-11):
        now = model.simulate(stop=0.25, tolerance=tolerance).at(0.25)
        assert abs(now["A.angle"] + expected) < 10 * tolerance + 1e-12


def test_a_dry_pin_among_them_rubs_by_the_least_reactions() -> None:
    """Its reaction is not determined; the loss follows the law on the reaction that is shown."""
    dry = " with coulomb(0.1, radius = 10 mm)"
    result = frot.compile(three_legs(dry=dry)).simulate(stop=0.2, tolerance=1e-11)
    times = np.linspace(0.0, 0.2, 2001)
    values = result.at(times)
    power = np.abs(values["A.torque"] * values["A.speed"])
    bound = 0.1 * 0.01 * np.hypot(values["A.force.x"], values["A.force.y"])
    assert np.all(np.abs(np.abs(values["A.torque"]) - bound)[1:] < 1e-7 * bound[1:])
    lost = float(np.sum((power[1:] + power[:-1]) / 2) * (times[1] - times[0]))
    assert abs(lost - values["energy.dissipated"][-1]) < 1e-6 * lost
    assert result.balance.relative < 1e-7
