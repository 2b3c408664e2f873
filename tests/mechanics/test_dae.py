"""CasADi's own integrators on `model.dae()` between the events the kernel found."""

from __future__ import annotations

import itertools

import casadi as ca
import numpy as np
import pytest
from mechanical_scenes import (
    BEAD_AND_SPRING,
    DRAGGED,
    HOOP,
    LIFTED,
    OSCILLATOR,
    WEDGE_AND_BEAD,
    Scenes,
    weighed,
)

OPEN, HELD, FORWARD, BACKWARD = 0, 1, 2, 3


def mode_of(dae, result, t: float) -> np.ndarray:
    """The DAE's mode vector from the kernel's signs in the middle of a phase."""
    now, mode = result.at(t), []
    for name in dae.names.mode:
        liaison, part = name.rsplit(".", 1)
        kind = int(now[f"{liaison}.mode"])
        if part == "closed":
            mode.append(float(kind != 0))
        elif part == "reaction_sign":
            mode.append(-1.0 if now[f"{liaison}.normal_force"] < 0 else 1.0)
        elif part == "friction":
            forward = FORWARD if now[f"{liaison}.slip"] > 0 else BACKWARD
            mode.append([0, HELD, forward][kind])
        elif part == "rolling":
            couple = float(now[f"{liaison}.torque"])
            resisted = couple != 0
            mode.append((FORWARD if couple < 0 else BACKWARD) if kind and resisted else 0)
        else:
            assert part == "side"
            mode.append(1.0)
    return np.array(mode, dtype=float)


def state_of(dae, result, t: float) -> np.ndarray:
    """x of the DAE from a result's variables."""
    now, values = result.at(t), []
    for name in dae.names.x:
        speed = name.startswith("der(")
        base = name[4:-1] if speed else name
        body, _, part = base.rpartition(".")
        for coordinate, rate in (("position", "velocity"), ("angle", "angular_velocity")):
            if coordinate in base and speed:
                base = base.replace(coordinate, rate)
                break
        else:
            if speed:
                base = f"{body}.slip"
            elif part == "u":
                base = f"{body}.abscissa"
        values.append(float(now[base]))
    return np.array(values)


# text, parameters, stop, liaison of the first guard kinds
CASES = {
    "oscillator": (OSCILLATOR, {}, 4.0),
    "hoop": (weighed(HOOP, "hoop"), {}, 3.0),
    "hoop with rolling resistance": (weighed(HOOP, "hoop"), {"delta": 0.02, "slope": 0.1}, 1.5),
    "bead drawn by a spring": (BEAD_AND_SPRING, {"k": 15.0}, 0.3),
    "dragged block": (DRAGGED, {}, 2.0),
    "ring lifted off": (LIFTED, {"m": 1.0}, 2.5),
    "wedge and bead": (WEDGE_AND_BEAD, {}, 0.5),
}


@pytest.mark.parametrize("plugin", ["rosenbrock", "erk"])
@pytest.mark.parametrize("name", CASES)
def test_casadis_integrators_agree_with_the_kernel_between_its_events(
    scenes: Scenes, name: str, plugin: str
) -> None:
    text, parameters, stop = CASES[name]
    model = scenes.model(text)
    result = scenes.run(text, **parameters, stop=stop, tolerance=1e-12)
    dae = model.dae()
    p = np.array([result.parameters[n] for n in dae.names.p])
    u = np.array(dae.u0).ravel()
    times = [0.0, *sorted({e.time for e in result.events}), stop]
    x, bound = state_of(dae, result, 0.0), 0.0
    for begin, end in itertools.pairwise(times):
        mode = mode_of(dae, result, (begin + end) / 2)
        options = {"abstol": 1e-12, "reltol": 1e-12}
        if plugin == "rosenbrock":  # the DAE as it is, with its algebraic equations
            step = ca.integrator("step", plugin, dae.problem(), begin, end, options)
            start = dae.solve(begin, x, u, p, mode)
            x = np.array(step(x0=x, z0=start, p=ca.vertcat(u, p, mode))["xf"]).ravel()
        else:  # the ODE it is reduced to
            t, y, m = ca.SX.sym("t"), ca.SX.sym("x", len(x)), ca.SX.sym("m", len(mode))
            ode = dae.ode(t, y, dae.solve(t, y, u, p, m), u, p, m)
            problem = {"t": t, "x": y, "p": m, "ode": ode}
            step = ca.integrator("step", plugin, problem, begin, end, options)
            x = np.array(step(x0=x, p=mode)["xf"]).ravel()
        bound = max(1.0, float(np.max(np.abs(x))))
        assert np.max(np.abs(x - state_of(dae, result, end))) < 1e-9 * bound
        z = dae.solve(end, x, u, p, mode)
        guards = np.array(dae.guards(end, x, z, u, p, mode)).ravel()
        if end < stop:
            # something ends the mode at the event: its guard is zero there
            assert np.min(np.abs(guards)) < 1e-8 * bound
        assert np.min(guards) > -1e-8 * bound
        after = mode_of(dae, result, (end + times[min(times.index(end) + 1, len(times) - 1)]) / 2)
        x = np.array(dae.reset(end, x, z, u, p, after)).ravel() if end < stop else x
        if end < stop:
            assert np.max(np.abs(x - state_of(dae, result, end))) < 1e-9 * bound


@pytest.mark.parametrize("name", CASES)
def test_the_accelerations_and_reactions_of_the_dae_are_those_of_the_result(
    scenes: Scenes, name: str
) -> None:
    """alg(x, z) = 0 with z from `solve`, and z equals what the kernel gives."""
    text, parameters, stop = CASES[name]
    result = scenes.run(text, **parameters, stop=stop, tolerance=1e-12)
    dae = scenes.model(text).dae()
    p = np.array([result.parameters[n] for n in dae.names.p])
    u = np.array(dae.u0).ravel()
    times = [0.0, *sorted({e.time for e in result.events}), stop]
    for begin, end in itertools.pairwise(times):
        middle = (begin + end) / 2
        mode, x = mode_of(dae, result, middle), state_of(dae, result, middle)
        z = dae.solve(middle, x, u, p, mode)
        residual = np.array(dae.alg(middle, x, z, u, p, mode)).ravel()
        now = result.at(middle)
        values = dict(zip(dae.names.z, np.array(z).ravel(), strict=True))
        largest = max(1.0, *(abs(v) for v in values.values()))
        assert np.max(np.abs(residual)) < 1e-12 * largest
        for key, value in values.items():
            if key.endswith("_force"):
                assert abs(value - float(now[key])) < 1e-9 * largest
