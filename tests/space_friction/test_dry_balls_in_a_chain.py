"""Dry ball joints of a chain stop and depart in motion, beside others that slip slowly."""

from __future__ import annotations

import textwrap

import numpy as np
import pytest

import frot
from tests.space.newton_euler import vector

CHAIN = """
    model Chain
      body a: cylinder(mass = 1 kg, radius = 2 cm, length = 0.2 m);
      body b: cylinder(mass = 1 kg, radius = 2 cm, length = 0.2 m);
      body c: cylinder(mass = 1 kg, radius = 2 cm, length = 0.2 m);
      liaison j1: spherique(ground, a.top) with coulomb(0.2, radius = 1 cm);
      liaison j2: spherique(a.bottom, b.top) with coulomb(0.2, radius = 1 cm);
      liaison j3: spherique(b.bottom, c.top) with coulomb(0.2, radius = 1 cm);
    initial
      a.angular_velocity = (0.5, 0.7, 0.5) rad/s;
      b.angular_velocity = (1, 0.4, 0.5) rad/s;
      c.angular_velocity = (0, 0.1, 0.5) rad/s;
      experiment(stop = 0.4 s);
    end Chain;
    """


@pytest.fixture(scope="module")
def chain() -> frot.Model:
    return frot.compile(textwrap.dedent(CHAIN))


def test_balls_that_depart_in_motion_go_on(chain: frot.Model) -> None:
    """A departure at the bound, with others slipping, begins in the direction of its slip."""
    runs = [chain.simulate(tolerance=tolerance) for tolerance in (1e-7, 1e-9)]
    for result in runs:
        assert result.balance.relative < 1e-9
    first, second = ([(e.liaison, e.kind) for e in run.events] for run in runs)
    assert first == second
    assert ("j1", "slip") in first
    times = [np.array([event.time for event in run.events]) for run in runs]
    assert np.abs(times[0] - times[1]).max() < 1e-5


def test_every_ball_obeys_its_law(chain: frot.Model) -> None:
    result = chain.simulate(tolerance=1e-9)
    bodies = {"j1": (None, "a"), "j2": ("a", "b"), "j3": ("b", "c")}
    for t in np.linspace(0.01, 0.39, 14):
        at = result.at(float(t))
        for name, (carrier, own) in bodies.items():
            slip = vector(at, f"{own}.angular_velocity")
            if carrier:
                slip = slip - vector(at, f"{carrier}.angular_velocity")
            couple = vector(at, f"{name}.torque")
            bound = 0.2 * 0.01 * np.linalg.norm(vector(at, f"{name}.force"))
            if at[f"{name}.mode"] == 1:
                assert np.linalg.norm(couple) <= bound * (1 + 1e-9)
                assert np.linalg.norm(slip) < 1e-14
            else:
                assert couple == pytest.approx(-bound * slip / np.linalg.norm(slip), rel=1e-6)
