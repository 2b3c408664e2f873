"""Chains whose hinges rub fall on a floor: contacts that meet in a hinge share their reactions."""

from __future__ import annotations

import functools

import numpy as np
import pytest

import frot

G = 9.81


@functools.cache
def chain() -> frot.Model:
    """Two rods on a slope. Both have contacts at the hinge: reactions there are redundant."""
    return frot.compile("""
planar model DryChain
  parameter Mass m = 1.5 kg;
  parameter Real ratio = 2.5;
  parameter Length l = 0.5 m;
  parameter Real longer = 1.8;
  parameter Angle first = -114 deg;
  parameter Angle second = 147 deg;
  parameter Angle slope = -9 deg;
  parameter Real mu = 0.22;
  parameter Real mu_hinge = 0.5;
  parameter Length radius = 0.04 m;
  parameter Real e = 0;
  body a: rod(mass = m, length = l);
  body b: rod(mass = ratio*m, length = longer*l);
  curve floor on ground: line(through = (0, 0) m, direction = (cos(slope), sin(slope)));
  liaison hinge: rotoide(a.tip, b.start) with coulomb(mu_hinge, radius = radius);
  liaison a1: contact_ponctuel(a.tip, floor) with coulomb(mu), restitution(e);
  liaison a2: contact_ponctuel(a.start, floor) with coulomb(mu), restitution(e);
  liaison b1: contact_ponctuel(b.tip, floor) with coulomb(mu), restitution(e);
  liaison b2: contact_ponctuel(b.start, floor) with coulomb(mu), restitution(e);
initial
  a.tip.position = 2*l*(-sin(slope), cos(slope));
  a.velocity = (0, 0) m/s;
  a.angle = first;
  a.angular_velocity = 0 rad/s;
  b.angle = second;
  b.angular_velocity = 0 rad/s;
  experiment(stop = 3 s, tolerance = 1e-8);
end DryChain;
""")


SCENES = [
    {},
    {"first": np.radians(-66), "second": np.radians(33), "slope": np.radians(9)},
    {"m": 1.5e6, "mu": 0.5},
    {"ratio": 0.1, "mu_hinge": 1.0},
    {"first": np.radians(-80), "second": np.radians(170), "e": 0.4},
    {"l": 50.0, "radius": 4.0, "slope": 0.0},
]


@pytest.mark.parametrize("values", SCENES)
def test_a_chain_with_a_dry_hinge_falls_and_comes_to_rest(values: dict[str, float]) -> None:
    stop = 3.0 * np.sqrt(values.get("l", 0.5) / 0.5)
    result = chain().simulate(parameters=values, stop=stop)
    assert result.time[-1] == stop
    at = result.at(np.linspace(0, stop, 401))
    m, l = values.get("m", 1.5), values.get("l", 0.5)
    size = m * G * l
    for name in ("a1", "a2", "b1", "b2"):
        assert np.min(at[f"{name}.gap"]) >= -1e-11 * l
        assert np.min(at[f"{name}.normal_force"]) >= -1e-9 * m * G
        bound = values.get("mu", 0.22) * at[f"{name}.normal_force"]
        assert np.all(np.abs(at[f"{name}.tangential_force"]) <= bound + 1e-9 * m * G)
    couple = values.get("mu_hinge", 0.5) * values.get("radius", 0.04)
    bound = couple * np.hypot(at["hinge.force.x"], at["hinge.force.y"])
    assert np.all(np.abs(at["hinge.torque"]) <= bound * (1 + 1e-9) + 1e-9 * size)
    turns = np.abs(at["hinge.speed"]) > 0
    assert np.abs(at["hinge.torque"])[turns] == pytest.approx(bound[turns], rel=1e-8)
    for name in ("a", "b"):
        assert at[f"{name}.angular_velocity"][-1] == 0
