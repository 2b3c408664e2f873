"""Siconos: Moreau-Jean time stepping with theta = 1/2, friction and rolling friction in 2D."""

from __future__ import annotations

import math
import time
from functools import partial

import numpy as np
import siconos.kernel as sk
from closed_forms import BLOCK, GRAVITY, HOOP, OSCILLATOR

from peers.interface import Outcome, Setting

NAME = "Siconos"
_HOW = "unilateral contact with reaction-dependent friction; Lagrangian system, steps from Python"
NOTES = {
    "block": _HOW,
    "oscillator": _HOW,
    "hoop": f"{_HOW}; NewtonImpactRollingFrictionNSL",
}


def version() -> str:
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version("siconos")
    except PackageNotFoundError:
        return "unknown"


def settings(scene: str) -> list[Setting]:
    method = "Moreau-Jean, theta 1/2"
    return [
        Setting(method, f"h = {h:g} s, solver 1e-14", "steps", partial(_run, scene, h))
        for h in (1e-2, 1e-3, 1e-4)
    ]


def _run(scene: str, step: float) -> Outcome:
    normal_first = np.array([[0.0, 1.0], [1.0, 0.0]])
    if scene == "hoop":
        r, stop = HOOP.r, HOOP.stop
        system = sk.LagrangianLinearTIDS([0.0, r, 0.0], [HOOP.v0, 0.0, 0.0], np.diag([1, 1, r * r]))
        system.setFExtPtr(np.array([0.0, -GRAVITY, 0.0]))
        rows = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, -r], [0.0, 0.0, 1.0]])
        relation = sk.LagrangianLinearTIR(rows, np.array([-r, 0.0, 0.0]))
        law = sk.NewtonImpactRollingFrictionNSL(0.0, 0.0, HOOP.mu, HOOP.delta, 3)
        problem = sk.RollingFrictionContact(3)
    else:
        slope, mu, stop = (
            (BLOCK.slope, BLOCK.mu, BLOCK.stop)
            if scene == "block"
            else (0.0, OSCILLATOR.mu, OSCILLATOR.stop)
        )
        start = (
            ([0.0, 0.0], [BLOCK.v0, 0.0]) if scene == "block" else ([OSCILLATOR.x0, 0.0], [0, 0])
        )
        system = sk.LagrangianLinearTIDS(*start, np.eye(2))
        if scene == "oscillator":
            system.setKPtr(np.diag([OSCILLATOR.k, 0.0]))
        system.setFExtPtr(GRAVITY * np.array([math.sin(slope), -math.cos(slope)]))
        relation = sk.LagrangianLinearTIR(normal_first, np.zeros(2))
        law = sk.NewtonImpactFrictionNSL(0.0, 0.0, mu, 2)
        problem = sk.FrictionContact(2)
    model = sk.NonSmoothDynamicalSystem(0.0, stop)
    model.insertDynamicalSystem(system)
    model.link(sk.Interaction(law, relation), system)
    options = problem.numericsSolverOptions()
    options.dparam[0], options.iparam[0] = 1e-14, 1000
    stepping = sk.TimeStepping(
        model, sk.TimeDiscretisation(0.0, step), sk.MoreauJeanOSI(0.5), problem
    )
    stepping.setNewtonOptions(sk.SICONOS_TS_LINEAR)
    count = round(stop / step)
    begun = time.perf_counter()
    for _ in range(count):
        stepping.computeOneStep()
        stepping.nextStep()
    wall = time.perf_counter() - begun
    q, v = system.q(), system.velocity()
    positions = (q[0], HOOP.r * q[2]) if scene == "hoop" else (q[0],)
    return Outcome(tuple(map(float, positions)), float(np.max(np.abs(v))), wall, count)
