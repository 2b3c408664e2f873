"""Runs of `model.dae()` by an integrator of SciPy, event after event, and of the kernel."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import casadi as ca
import numpy as np
from frot.compiler.product.dae import Dae
from frot.compiler.product.dae_events import After
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

import frot

TOLERANCE = 1e-11
RATES = (
    ("position", "velocity"),
    ("angle", "angular_velocity"),
    ("displacement", "speed"),
    ("abscissa", "slip"),
)
Vector = NDArray[np.float64]


@dataclass
class DaeRun:
    """x and mode at the end, the instants of the events and what followed from each."""

    x: Vector
    mode: Vector
    times: list[float] = field(default_factory=list)
    happened: list[After] = field(default_factory=list)


def state_of(dae: Dae, result: frot.Result, t: float) -> Vector:
    """x of the DAE from the variables of a result."""
    now, values, known = result.at(t), [], {v.name for v in result.program.variables}
    for name in dae.names.x:
        base = name[4:-1] if name.startswith("der(") else name
        if base != name:
            base = next(base.replace(a, b) for a, b in RATES if a in base)
            base = base if base in known else base.replace("angular_velocity", "speed")
        values.append(float(now[base]))
    return np.array(values)


def run_dae(
    dae: Dae, stop: float, x: Vector, mode: Vector, p: Vector, slow: float = 1e-9
) -> DaeRun:
    """Integrate to `stop` by DOP853; a guard that falls through zero is an event."""
    t, m, u = ca.MX.sym("t"), ca.MX.sym("m", len(dae.names.mode)), dae.u0
    y = ca.MX.sym("x", len(dae.names.x))
    z = dae.solve(t, y, u, p, m)
    right = ca.Function("right", [t, y, m], [dae.ode(t, y, z, u, p, m)])
    guards = ca.Function("guards", [t, y, m], [dae.guards(t, y, z, u, p, m)])
    run, now = DaeRun(x, mode), 0.0

    def guard(k: int, begin: float) -> Callable[[float, Vector], float]:
        def value(s: float, v: Vector) -> float:
            # what is zero at the beginning is not below zero there by rounding
            return float(guards(s, v, run.mode)[k]) if s > begin else 1.0

        value.terminal, value.direction = True, -1.0  # type: ignore[attr-defined]
        return value

    while now < stop:
        found = solve_ivp(
            lambda s, v: np.array(right(s, v, run.mode)).ravel(),
            (now, stop),
            run.x,
            "DOP853",
            rtol=TOLERANCE,
            atol=0.1 * TOLERANCE,
            events=[guard(k, now) for k in range(len(dae.names.guards))],
            max_step=stop / 20,
        )
        assert found.success
        now, run.x = float(found.t[-1]), found.y[:, -1]
        if found.status == 1:
            pairs = zip(dae.names.guards, found.t_events, strict=True)
            fired = [name for name, instants in pairs if len(instants)]
            after = dae.event(now, run.x, u, p, run.mode, fired, slow=slow)
            run.x, run.mode = after.x, after.mode
            run.times.append(now)
            run.happened.append(after)
            assert len(run.times) < 100
    return run


def both(
    text: str,
    closed: Sequence[str] = (),
    slow: float = 1e-9,
    stop: float | None = None,
    **parameters: float,
) -> tuple[Dae, frot.Result, DaeRun]:
    """The DAE, the kernel's run and that of the DAE, from the same start."""
    model = frot.compile(text)
    result = model.simulate(tolerance=1e-12, parameters=parameters, stop=stop)
    dae = model.dae()
    p = np.array([result.parameters[name] for name in dae.names.p])
    x = state_of(dae, result, 0.0)
    mode = dae.first_mode(0.0, x, dae.u0, p, closed)
    return dae, result, run_dae(dae, float(result.time[-1]), x, mode, p, slow)


def agrees(dae: Dae, result: frot.Result, run: DaeRun, error: float) -> None:
    """The states at the end agree to `error`, relative to the largest of them."""
    expected = state_of(dae, result, float(result.time[-1]))
    size = max(1.0, float(np.max(np.abs(expected))))
    assert np.max(np.abs(run.x - expected)) < error * size


def impulses(dae: Dae, run: DaeRun, row: str) -> list[float]:
    """The impulses of a row at the events, those that are none left out."""
    k = dae.impacts.rows.index(row)
    return [float(a.impulses[k]) for a in run.happened if a.impulses[k] > 0]
