"""Siconos: Moreau-Jean time stepping, and its event-driven scheme for the ball.

The billiard uses its own discs.
"""

from __future__ import annotations

import time
from functools import partial

import numpy as np
import siconos.kernel as sk

from peers.impact_scenes import BALL, BILLIARD, GRAVITY
from peers.interface import Outcome, Setting

NAME = "Siconos"
NOTES = {
    "ball": "Newton's rule, e = 1; steps and events from Python",
    "block": "not set up: relations of corners written in Python end its process",
    "billiard": "its own discs and lines, Newton's rule, e = 1; all pairs kept, steps from Python",
    "chain": "not set up: joints and contacts with friction in one problem",
}


def version() -> str:
    return "4.4.0 (Debian)"


def settings(scene: str, times: dict[str, tuple[float, float]]) -> list[Setting]:
    runs = {"ball": _ball, "billiard": _billiard}
    if scene not in runs:
        return []
    steps = {"ball": (1e-2, 1e-3, 1e-4), "billiard": (1e-2, 1e-3)}
    found = [
        Setting(
            "Moreau-Jean, theta 1/2", f"h = {h:g} s", "steps", partial(runs[scene], h, times[scene])
        )
        for h in steps[scene]
    ]
    if scene == "ball":
        found.append(
            Setting(
                "event-driven, LSODAR", "tolerance 1e-9", "steps", partial(_events, times[scene])
            )
        )
    return found


def _stepped(stepping: object, h: float, times: tuple[float, float], places) -> tuple:
    """Steps to the end; places at the first time, moved on with the speed by what is missing."""
    compared, stop = times
    first, every = round(compared / h), round(stop / h)
    found: tuple[float, ...] = ()
    begun = time.perf_counter()
    for k in range(every):
        stepping.computeOneStep()
        stepping.nextStep()
        if k + 1 == first:
            found = places(compared - first * h)
    return found, time.perf_counter() - begun, every


def _ball(h: float, times: tuple[float, float]) -> Outcome:
    system = sk.LagrangianLinearTIDS([BALL.radius + BALL.height], [0.0], np.eye(1))
    system.setFExtPtr(np.array([-GRAVITY]))
    relation = sk.LagrangianLinearTIR(np.eye(1), np.array([-BALL.radius]))
    model = sk.NonSmoothDynamicalSystem(0.0, times[1] + h)
    model.insertDynamicalSystem(system)
    model.link(sk.Interaction(sk.NewtonImpactNSL(1.0), relation), system)
    stepping = sk.TimeStepping(
        model, sk.TimeDiscretisation(0.0, h), sk.MoreauJeanOSI(0.5), sk.LCP()
    )
    stepping.setNewtonOptions(sk.SICONOS_TS_LINEAR)
    found, wall, count = _stepped(
        stepping, h, times, lambda left: (float(system.q()[0] + left * system.velocity()[0]),)
    )
    return Outcome(found, 0.5 * float(system.velocity()[0]) ** 2, wall, count)


def _events(times: tuple[float, float]) -> Outcome:
    stop = times[1]
    system = sk.LagrangianLinearTIDS([BALL.radius + BALL.height], [0.0], np.eye(1))
    system.setFExtPtr(np.array([-GRAVITY]))
    relation = sk.LagrangianLinearTIR(np.eye(1), np.array([-BALL.radius]))
    model = sk.NonSmoothDynamicalSystem(0.0, stop)
    model.insertDynamicalSystem(system)
    model.link(sk.Interaction(sk.NewtonImpactNSL(1.0), relation), system)
    integrator = sk.LsodarOSI()
    scheme = sk.EventDriven(model, sk.TimeDiscretisation(0.0, 0.1))
    scheme.insertIntegrator(integrator)
    scheme.setToleranceED(1e-9)
    for problem, kind in (
        (sk.LCP(), sk.SICONOS_OSNSP_ED_IMPACT),
        (sk.LCP(), sk.SICONOS_OSNSP_ED_SMOOTH_ACC),
    ):
        scheme.insertNonSmoothProblem(problem, kind)
    scheme.initialize()
    count = 0
    begun = time.perf_counter()
    while scheme.hasNextEvent():
        scheme.advanceToEvent()
        scheme.processEvents()
        count += 1
    wall = time.perf_counter() - begun
    return Outcome((float(system.q()[0]),), 0.5 * float(system.velocity()[0]) ** 2, wall, count)


def _billiard(h: float, times: tuple[float, float]) -> Outcome:
    from siconos.mechanics.collision import bodies

    r, m, (x, y) = BILLIARD.radius, BILLIARD.mass, BILLIARD.half
    model = sk.NonSmoothDynamicalSystem(0.0, times[1] + h)
    discs = []
    for k, (px, py) in enumerate(BILLIARD.places):
        u, v = BILLIARD.speed if k == 0 else (0.0, 0.0)
        discs.append(bodies.Disk(r, m, [px, py, 0.0], [u, v, 0.0]))
        model.insertDynamicalSystem(discs[-1])
    for k, disc in enumerate(discs):
        for a, b, c in ((1.0, 0.0, x), (-1.0, 0.0, x), (0.0, 1.0, y), (0.0, -1.0, y)):
            law = sk.NewtonImpactFrictionNSL(1.0, 0.0, 0.0, 2)
            model.link(sk.Interaction(law, bodies.DiskPlanR(r, a, b, c)), disc)
        for other in discs[:k]:
            law = sk.NewtonImpactFrictionNSL(1.0, 0.0, 0.0, 2)
            model.link(sk.Interaction(law, bodies.DiskDiskR(r, r)), other, disc)
    problem = sk.FrictionContact(2)
    stepping = sk.TimeStepping(model, sk.TimeDiscretisation(0.0, h), sk.MoreauJeanOSI(0.5), problem)

    def places(left: float) -> tuple[float, ...]:
        return tuple(float(d.q()[i] + left * d.velocity()[i]) for d in discs for i in (0, 1))

    found, wall, count = _stepped(stepping, h, times, places)
    energy = sum(0.5 * m * float(d.velocity()[0] ** 2 + d.velocity()[1] ** 2) for d in discs)
    return Outcome(found, energy, wall, count)
