"""`model.dae()` where relations are redundant: unique accelerations, the least reactions."""

from __future__ import annotations

from pathlib import Path

import casadi as ca
import numpy as np
import pytest
from frot.compiler.product.dae import Dae
from scipy.integrate import solve_ivp

import frot

G = 9.81
# A bar of two kg on parallel cranks of one kg. In the plane the third crank keeps what two keep; in
# space the relations out of the plane of two cranks are kept twice.
PLANE = """planar model Cranks
  parameter Real k = 1;
  body left: rod(mass = k*1 kg, length = 0.5 m);
  body mid: rod(mass = k*1 kg, length = 0.5 m);
  body right: rod(mass = k*1 kg, length = 0.5 m);
  body top: rod(mass = k*2 kg, length = 0.8 m);
  frame heel on ground at (0.4, 0) m;
  frame foot on ground at (0.8, 0) m;
  liaison a: rotoide(ground, left.start);
  liaison b: rotoide(left.tip, top.start);
  liaison c: rotoide(top.tip, right.tip);
  liaison d: rotoide(foot, right.start);
  liaison e: rotoide(heel, mid.start);
  liaison f: rotoide(mid.tip, top.G);
  world(gravity = 9.81 m/s^2);
initial
  left.angle = 2 rad; left.angular_velocity = -3 rad/s;
  guess(top.angle = 0 rad, right.angle = 2 rad, mid.angle = 2 rad);
  experiment(stop = 0.5 s);
end Cranks;
"""
SPACE = """model Cranks
  parameter Real k = 1;
  body left: rod(mass = k*1 kg, length = 0.5 m);
  body right: rod(mass = k*1 kg, length = 0.5 m);
  body top: rod(mass = k*2 kg, length = 0.8 m);
  frame foot on ground at (0.8, 0, 0) m;
  liaison a: rotoide(ground, left.start, axis = y);
  liaison b: rotoide(left.tip, top.start, axis = y);
  liaison c: rotoide(top.tip, right.tip, axis = y);
  liaison d: rotoide(foot, right.start, axis = y);
  world(gravity = 9.81 m/s^2);
initial
  left.tip.position = (0.5*cos(2 rad), 0, 0.5*sin(2 rad)) m;
  right.tip.position = (0.8 + 0.5*cos(2 rad), 0, 0.5*sin(2 rad)) m;
  left.tip.velocity.x = 1.5*sin(2 rad)*1 m/s;
  experiment(stop = 0.5 s);
end Cranks;
"""


def state_of(dae: Dae, result: frot.Result, t: float) -> np.ndarray:
    """x of the DAE; the turn of a pin that closes a loop, `turned`, acts on nothing."""
    now, known, values = result.at(t), {v.name for v in result.program.variables}, []
    for name in dae.names.x:
        own = name[4:-1].replace("angle", "speed") if name.startswith("der(") else name
        values.append(float(now[own]) if own in known else 0.0)
    return np.array(values)


@pytest.mark.parametrize("k", [1e-6, 1.0, 1e6])
@pytest.mark.parametrize(("text", "cranks"), [(PLANE, 3), (SPACE, 2)], ids=["plane", "space"])
def test_a_bar_on_parallel_cranks_swings_as_a_pendulum(text: str, cranks: int, k: float) -> None:
    """theta'' (n m l^2/3 + M l^2) = -g cos theta (n m/2 + M) l, and the run is the kernel's."""
    model = frot.compile(text)
    result, dae = model.simulate(tolerance=1e-12, parameters={"k": k}), model.dae()
    p, mode, length = [k], np.zeros(len(dae.names.mode)), 0.5
    assert any(".reaction" in name for name in dae.names.z)
    for t in (0.0, 0.2, 0.5):
        x = state_of(dae, result, t)
        z = np.array(dae.solve(t, x, [], p, mode)).ravel()
        height = float(result.at(t)["top.position.z" if cranks == 2 else "top.position.y"])
        cosine = np.sqrt(length**2 - height**2) / length
        pull = G * cosine * (cranks / 2 + 2) / (length * (cranks / 3 + 2))
        assert abs(z[dae.names.z.index("der(der(a.angle))")]) == pytest.approx(pull, rel=1e-9)
        residual = np.array(dae.alg(t, x, z, [], p, mode)).ravel()
        assert np.max(np.abs(residual)) < 1e-9 * np.max(np.abs(z))
        # no large reactions that are in equilibrium by themselves
        reactions = [v for n, v in zip(dae.names.z, z, strict=True) if ".reaction" in n]
        assert np.max(np.abs(reactions)) < 10 * (cranks + 2) * k * G
    x, t = ca.MX.sym("x", len(dae.names.x)), ca.MX.sym("t")
    ode = dae.ode(t, x, dae.solve(t, x, [], p, mode), [], p, mode)
    options = {"abstol": 1e-12, "reltol": 1e-12}
    step = ca.integrator("step", "erk", {"t": t, "x": x, "ode": ode}, 0, 0.5, options)
    reached = np.array(step(x0=state_of(dae, result, 0.0))["xf"]).ravel()
    places = [i for i, name in enumerate(dae.names.x) if "turned" not in name]
    assert np.max(np.abs(reached - state_of(dae, result, 0.5))[places]) < 1e-9


def test_a_cone_rolls_about_its_apex_with_an_error_that_follows_the_tolerance() -> None:
    """A row that others keep vanishes on the motion, and is a rest of rounding beside it."""
    model = frot.load(Path(frot.__file__).parents[1] / "models" / "rolling_cone.frot")
    result, dae = model.simulate(tolerance=1e-12), model.dae()
    x, t = ca.MX.sym("x", len(dae.names.x)), ca.MX.sym("t")
    ode = dae.ode(t, x, dae.solve(t, x, [], dae.p0, []), [], dae.p0, [])
    right = ca.Function("right", [t, x], [ode])
    begin, expected = (
        np.array([float(result.at(s)[name]) for name in dae.names.x]) for s in (0.0, 2.0)
    )
    for tolerance, error in ((1e-6, 1e-4), (1e-9, 1e-7), (1e-11, 1e-9)):
        found = solve_ivp(
            lambda s, v: np.array(right(s, v)).ravel(),
            (0, 2),
            begin,
            "DOP853",
            rtol=tolerance,
            atol=0.1 * tolerance,
        )
        assert np.max(np.abs(found.y[:, -1] - expected)) < error
        assert found.nfev < 1000


def test_the_friction_of_two_ends_at_rest_shares_the_load() -> None:
    """A rod drawn along the floor, and held: both ends take the half, by symmetry."""
    text = """planar model Rod
  parameter Force along = 3 N;
  body b: rod(mass = 2 kg, length = 1 m);
  curve floor on ground: line(through = (0, 0) m, direction = (1, 0));
  liaison heel: contact_ponctuel(floor, b.start) with coulomb(0.4);
  liaison toe: contact_ponctuel(floor, b.tip) with coulomb(0.4);
  world(gravity = 9.81 m/s^2);
  force pull: on(b.G, value = (along, 0 N));
initial
  b.angle = 0 rad; b.position = (0.5, 0) m; b.velocity = (0, 0) m/s;
end Rod;
"""
    dae = frot.compile(text).dae()
    x = np.array(dae.start(0, [], dae.p0)).ravel()
    x[:2] = 0.5, 0.0
    for along, modes in ((3.0, (1, 1)), (-3.0, (1, 1)), (9.0, (2, 2)), (-9.0, (3, 3))):
        mode = dae.first_mode(0, x, [], [along], ["heel", "toe"])
        assert (mode[2], mode[6]) == modes
        z = dict(
            zip(dae.names.z, np.array(dae.solve(0, x, [], [along], mode)).ravel(), strict=True)
        )
        held = max(-0.4 * 9.81, min(0.4 * 9.81, along / 2))
        for end in ("heel", "toe"):
            assert z[f"{end}.normal_force"] == pytest.approx(9.81, rel=1e-9)
            assert z[f"{end}.tangential_force"] == pytest.approx(-held, rel=1e-8)
