"""Exudyn: spheres with linear contact springs; DOPRI5 with fixed steps."""

from __future__ import annotations

import time
from functools import partial
from importlib.metadata import version as installed

import exudyn as exu
from exudyn import itemInterface as items

from peers.impact_scenes import BALL, BILLIARD, GRAVITY
from peers.interface import Outcome, Setting

NAME = "Exudyn"
_HOW = "contact springs without damping"
NOTES = {
    "ball": f"{_HOW}; it bounces on a ball of its size that is fixed",
    "block": "not set up: no contact of corners with friction in its items for the plane",
    "billiard": f"{_HOW}; walls as springs of coordinates",
    "chain": "not set up, as the block",
}


def version() -> str:
    return installed("exudyn")


def settings(scene: str, times: dict[str, tuple[float, float]]) -> list[Setting]:
    runs = {"ball": _ball, "billiard": _billiard}
    if scene not in runs:
        return []
    chosen = {"ball": ((1e5, 1e-4), (1e6, 5e-5)), "billiard": ((1e5, 1e-4), (1e7, 1e-5))}
    return [
        Setting(
            f"springs {stiffness:.0e} N/m, DOPRI5",
            f"h = {step:g} s",
            "steps",
            partial(runs[scene], stiffness, step, times[scene]),
        )
        for stiffness, step in chosen[scene]
    ]


def _solve(system: exu.MainSystem, times: list[float], step: float) -> tuple[list, float, int]:
    """Coordinates at each of the times; the whole time of solving."""
    system.Assemble()
    settings = exu.SimulationSettings()
    integration = settings.timeIntegration
    integration.verboseMode = 0
    integration.explicitIntegration.dynamicSolverType = exu.DynamicSolverType.DOPRI5
    integration.automaticStepSize = False
    settings.solutionSettings.writeSolutionToFile = False
    wall, count, now, found = 0.0, 0, 0.0, []
    for t in times:
        steps = max(1, round((t - now) / step))
        integration.startTime, integration.endTime = now, t
        integration.numberOfSteps = steps
        begun = time.perf_counter()
        system.SolveDynamic(settings, solverType=exu.DynamicSolverType.DOPRI5, showHints=False)
        wall += time.perf_counter() - begun
        count, now = count + steps, t
        q = system.systemData.GetODE2Coordinates()
        v = system.systemData.GetODE2Coordinates_t()
        system.systemData.SetODE2Coordinates(q, configuration=exu.ConfigurationType.Initial)
        system.systemData.SetODE2Coordinates_t(v, configuration=exu.ConfigurationType.Initial)
        data = system.systemData.GetDataCoordinates()
        system.systemData.SetDataCoordinates(data, configuration=exu.ConfigurationType.Initial)
        found.append((q, v))
    return found, wall, count


def _sphere(
    system: exu.MainSystem, mass: float, at: list[float], speed: list[float]
) -> tuple[int, int]:
    node = system.AddNode(items.NodePoint(referenceCoordinates=at, initialVelocities=speed))
    system.AddObject(items.MassPoint(nodeNumber=node, physicsMass=mass))
    return node, system.AddMarker(items.MarkerNodePosition(nodeNumber=node))


def _touch(system: exu.MainSystem, one: int, other: int, radius: float, stiffness: float) -> None:
    data = system.AddNode(
        items.NodeGenericData(initialCoordinates=[0.1, 0, 0, 0], numberOfDataCoordinates=4)
    )
    system.AddObject(
        items.ObjectContactSphereSphere(
            markerNumbers=[one, other],
            nodeNumber=data,
            spheresRadii=[radius, radius],
            contactStiffness=stiffness,
            contactDamping=0.0,
            impactModel=0,
            dynamicFriction=0.0,
        )
    )


def _ball(stiffness: float, step: float, times: tuple[float, float]) -> Outcome:
    system = exu.SystemContainer().AddSystem()
    r, h = BALL.radius, BALL.height
    _, marker = _sphere(system, 1.0, [0, r + h, 0], [0, 0, 0])
    ground = system.AddObject(items.ObjectGround())
    fixed = system.AddMarker(items.MarkerBodyPosition(bodyNumber=ground, localPosition=[0, -r, 0]))
    system.AddLoad(items.Force(markerNumber=marker, loadVector=[0, -GRAVITY, 0]))
    _touch(system, fixed, marker, r, stiffness)
    found, wall, count = _solve(system, [times[1]], step)
    q, v = found[-1]
    return Outcome((r + h + float(q[1]),), 0.5 * float(v[1]) ** 2, wall, count)


def _billiard(stiffness: float, step: float, times: tuple[float, float]) -> Outcome:
    system = exu.SystemContainer().AddSystem()
    r, m, half = BILLIARD.radius, BILLIARD.mass, BILLIARD.half
    markers = []
    zero = system.AddNode(items.NodePointGround())
    for k, place in enumerate(BILLIARD.places):
        speed = BILLIARD.speed if k == 0 else (0.0, 0.0)
        node, marker = _sphere(system, m, [*place, 0], [*speed, 0])
        fixed = system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=zero, coordinate=0))
        for axis in (0, 1):
            along = system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=axis))
            low, high = -half[axis] + r - place[axis], half[axis] - r - place[axis]
            data = system.AddNode(
                items.NodeGenericData(initialCoordinates=[1.0, 0.0, 0.0], numberOfDataCoordinates=3)
            )
            system.AddObject(
                items.CoordinateSpringDamperExt(
                    markerNumbers=[fixed, along],
                    nodeNumber=data,
                    limitStopsLower=low,
                    limitStopsUpper=high,
                    limitStopsStiffness=stiffness,
                    useLimitStops=True,
                )
            )
        for other in markers:
            _touch(system, other, marker, r, stiffness)
        markers.append(marker)
    found, wall, count = _solve(system, list(times), step)
    q = found[0][0]
    places = [
        float(q[3 * k + i]) + place[i] for k, place in enumerate(BILLIARD.places) for i in (0, 1)
    ]
    energy = 0.5 * m * sum(float(x) ** 2 for x in found[-1][1])
    return Outcome(tuple(places), energy, wall, count)
