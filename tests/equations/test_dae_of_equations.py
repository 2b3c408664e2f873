"""`model.dae()` of texts with equations, integrated by CasADi, beside the kernel's results."""

from __future__ import annotations

from pathlib import Path

import casadi as ca
import numpy as np
import pytest
from frot.compiler.product.dae import Dae

import frot

MODELS = Path(frot.__file__).parents[1] / "models"
STATES = {"der(hinge.angle)": "hinge.speed"}
STICK, FORWARD, BACKWARD = 1.0, 2.0, 3.0

# y is given by a cubic, z is its square: a block that is not linear, and a formula after it
CUBIC = """
model Cubic
  Real x; Real y; Real z; Real rate;
equation
  der(x) = rate/(1 s) - 0.1*z/(1 s);
  rate = -y;
  y + y^3 = x + 0.1*sin(z);
  z = y*y;
initial
  x = 2; guess(y = 1);
end Cubic;
"""
# the pendulum in x and y: index 3, kept on its circle by two invariants
PENDULUM = """
model Pendulum
  parameter Acceleration g = 9.81 m/s^2;
  parameter Length r = 1 m;
  Length x; Length y; Velocity u; Velocity v; Real T(unit = "1/s^2");
equation
  der(x) = u; der(y) = v;
  der(u) = T*x; der(v) = T*y - g;
  x^2 + y^2 = r^2;
initial
  x = 1 m; guess(y = 0 m, v = 0 m/s); v = 0 m/s;
end Pendulum;
"""
BALL = """
model Ball
  parameter Real e = 0.5;
  Length h; Velocity w; Integer count;
equation
  der(h) = w; der(w) = -10 m/s^2;
  when h < 0 m then
    reinit(w, -e*w);
    count = pre(count) + 1;
  end when;
initial
  h = 1 m; w = 0 m/s; count = 0;
end Ball;
"""


def mode_of(dae: Dae, result: frot.Result, t: float) -> np.ndarray:
    """The DAE's mode at an instant of a result: its slips, and the conditions that agree."""
    now, mode = result.at(t), np.zeros(len(dae.names.mode))
    for k, name in enumerate(dae.names.mode):
        owner, _, part = name.rpartition(".")
        if part == "closed" or part == "side":
            mode[k] = 1.0
        elif part == "friction":
            slips = int(now[f"{owner}.mode"]) == 2
            slip = float(now[f"{owner}.slip"]) if slips else 0.0
            mode[k] = (FORWARD if slip > 0 else BACKWARD) if slips else STICK
    flags = [k for k, name in enumerate(dae.names.mode) if name.startswith("condition_")]
    guards = [k for k, name in enumerate(dae.names.guards) if name.startswith("condition_")]
    mode[flags] = 1.0
    x, u, p = state_of(dae, result, t), dae.u0, dae.p0
    values = dae.guards(t, x, dae.solve(t, x, u, p, mode), u, p, mode)
    mode[flags] = [float(values[k]) > 0 for k in guards]
    return mode


def state_of(dae: Dae, result: frot.Result, t: float) -> np.ndarray:
    now = result.at(t)
    return np.array([float(now[STATES.get(name, name)]) for name in dae.names.x])


def follow(dae: Dae, x: np.ndarray, mode: np.ndarray, begin: float, end: float) -> np.ndarray:
    """The DAE's ODE integrated by CasADi, in one mode."""
    t, y = ca.MX.sym("t"), ca.MX.sym("x", len(x))
    z = dae.solve(t, y, dae.u0, dae.p0, mode)
    problem = {"t": t, "x": y, "ode": dae.ode(t, y, z, dae.u0, dae.p0, mode)}
    options = {"abstol": 1e-12, "reltol": 1e-12}
    return np.array(ca.integrator("step", "erk", problem, begin, end, options)(x0=x)["xf"]).ravel()


@pytest.mark.parametrize(
    ("name", "begin", "end"),
    [
        ("clutch_engagement", 0.6, 1.7),  # slips
        ("clutch_engagement", 2.0, 3.0),  # is stuck
        ("geared_motor", 0.01, 2.0),
        ("speed_drive", 0.2, 0.45),
    ],
)
def test_equations_mechanics_and_friction_agree_with_the_kernel(
    name: str, begin: float, end: float
) -> None:
    model = frot.load(MODELS / f"{name}.frot")
    result, dae = model.simulate(tolerance=1e-11), model.dae()
    mode = mode_of(dae, result, begin)
    reached = follow(dae, state_of(dae, result, begin), mode, begin, end)
    expected = state_of(dae, result, end)
    assert np.all(np.abs(reached - expected) < 1e-8 * np.maximum(1.0, np.abs(expected)))
    z = dae.solve(end, reached, dae.u0, dae.p0, mode)
    residual = np.array(dae.alg(end, reached, z, dae.u0, dae.p0, mode))
    assert np.max(np.abs(residual), initial=0.0) < 1e-9


def test_a_block_that_is_not_linear_is_solved_from_its_guess() -> None:
    model = frot.compile(CUBIC)
    result, dae = model.simulate(stop=2.0, tolerance=1e-12), model.dae()
    assert set(dae.names.z) & {"y", "z"}
    reached = follow(dae, state_of(dae, result, 0.0), np.zeros(0), 0.0, 2.0)
    assert np.all(np.abs(reached - state_of(dae, result, 2.0)) < 1e-10)


def test_what_differentiated_equations_demand_of_the_states_comes_along() -> None:
    model = frot.compile(PENDULUM)
    result, dae = model.simulate(stop=1.0, tolerance=1e-11), model.dae()
    x = state_of(dae, result, 1.0)
    values = [dae.invariants(1.0, s, dae.u0, dae.p0, []) for s in (x, x * 1.1)]
    assert np.max(np.abs(np.array(values[0]))) < 1e-12 < 0.1 < np.max(np.abs(np.array(values[1])))
    reached = follow(dae, state_of(dae, result, 0.0), np.zeros(0), 0.0, 1.0)
    assert np.all(np.abs(reached - x) < 1e-8)


def test_what_a_when_does_comes_along() -> None:
    dae = frot.compile(BALL).dae()
    assert dae.update is not None and dae.names.mode[-1] == "count"
    x = [0.0 if name == "h" else -4.0 for name in dae.names.x]
    mode = np.zeros(len(dae.names.mode))
    mode[-1] = 2.0
    flag = dae.names.mode.index(dae.names.fired[0])
    # the ball is above the ground while the guard of its condition is positive
    above = [3.0 if name == "h" else 0.0 for name in dae.names.x]
    guard = dae.names.guards.index(dae.names.fired[0])
    assert mode[flag] == 0 and dae.guards(0, above, [], [], dae.p0, mode)[guard] == 3.0
    after, values, asked = dae.update(0.0, x, [], [], dae.p0, mode, [1.0])
    assert dict(zip(dae.names.x, np.array(after).ravel(), strict=True)) == {"h": 0.0, "w": 2.0}
    assert float(values[0]) == 3.0 and asked.numel() == len(dae.names.outcomes)
