"""Siconos: Moreau-Jean time stepping, and its event-driven scheme for the ball.

The billiard uses its own discs; relations of the block and the chain are in C (siconos_corners.py).
"""

from __future__ import annotations

import functools
import math
import time
from functools import partial

import numpy as np
import siconos.kernel as sk

from peers.impact_scenes import BALL, BILLIARD, BLOCK, CHAIN, GRAVITY
from peers.interface import Outcome, Setting
from peers.siconos_corners import library, start_height

NAME = "Siconos"
NOTES = {
    "ball": "Newton's rule, e = 1; steps and events from Python",
    "block": "corners as relations in C, Newton's rule with friction, e = 0; steps from Python",
    "billiard": "its own discs and lines, Newton's rule, e = 1; all pairs kept, steps from Python",
    "chain": "minimal coordinates, inertia and ends in C, Newton's rule with friction, e = 0; "
    "steps from Python. At 1e-5 s its error is 2.0e-3: it converges to another law, in which "
    "friction acts on the slip after the impact. At 1e-2 s it diverges",
}


def version() -> str:
    return "4.4.0 (Debian)"


def settings(scene: str, times: dict[str, tuple[float, float]]) -> list[Setting]:
    runs = {"ball": _ball, "block": _block, "billiard": _billiard, "chain": _chain}
    steps = {"ball": (1e-2, 1e-3, 1e-4), "billiard": (1e-2, 1e-3)}
    steps |= {"block": (1e-2, 1e-3, 1e-4), "chain": (1e-3, 1e-4)}
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


@functools.cache
def _library() -> str:
    return library(GRAVITY)


def _rough(
    system: object, mu: float, ends: list[str], h: float, stop: float
) -> tuple[object, list[object]]:
    """A stepping with a rough contact at each of the ends, and what must stay alive."""
    model = sk.NonSmoothDynamicalSystem(0.0, stop + h)
    model.insertDynamicalSystem(system)
    kept: list[object] = [model]
    for end in ends:
        relation = sk.LagrangianScleronomousR(f"{_library()}:{end}_h", f"{_library()}:{end}_G")
        contact = sk.Interaction(sk.NewtonImpactFrictionNSL(0.0, 0.0, mu, 2), relation)
        model.link(contact, system)
        kept += [relation, contact]
    kept += [sk.TimeDiscretisation(0.0, h), sk.MoreauJeanOSI(0.5), sk.FrictionContact(2)]
    return sk.TimeStepping(model, *kept[-3:]), kept


def _block(h: float, times: tuple[float, float]) -> Outcome:
    inertia = (BLOCK.wide**2 + BLOCK.high**2) / 12
    masses = np.diag([1.0, 1.0, inertia])
    system = sk.LagrangianLinearTIDS([0.0, start_height(), BLOCK.tilt], [0.0] * 3, masses)
    system.setFExtPtr(np.array([0.0, -GRAVITY, 0.0]))
    stepping, _kept = _rough(system, BLOCK.mu, ["left", "right"], h, times[1])
    found, wall, count = _stepped(
        stepping, h, times, lambda left: (float(system.q()[2] + left * system.velocity()[2]),)
    )
    return Outcome(found, 0.5 * float(np.diag(masses) @ system.velocity() ** 2), wall, count)


def _chain(h: float, times: tuple[float, float]) -> Outcome:
    start = [0.0, 0.3, *CHAIN.angles]
    system = sk.LagrangianDS(start, [0.0] * len(start), f"{_library()}:mass")
    system.setComputeFGyrFunction(_library(), "gyroscopic")
    ends = [f"end{k}" for k in range(CHAIN.rods + 1)]
    stepping, _kept = _rough(system, CHAIN.mu, ends, h, times[1])

    def centres(left: float) -> tuple[float, ...]:
        x, y, *angles = system.q() + left * system.velocity()
        found: list[float] = []
        for a in angles:
            dx, dy = CHAIN.length * math.cos(a), CHAIN.length * math.sin(a)
            found += [float(x + dx / 2), float(y + dy / 2)]
            x, y = x + dx, y + dy
        return tuple(found)

    found, wall, count = _stepped(stepping, h, times, centres)
    system.computeMass()
    speeds = system.velocity()
    return Outcome(found, 0.5 * float(speeds @ system.mass() @ speeds), wall, count)


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
