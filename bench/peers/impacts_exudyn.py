"""Exudyn: spheres with linear contact springs; DOPRI5 with fixed steps.

Corners and ends are small spheres about them, on a triangle that lies lower by their radius. A
sphere whose centre comes through the triangle has no contact any more, which bounds the radius.
"""

from __future__ import annotations

import math
import time
from functools import partial
from importlib.metadata import version as installed

import exudyn as exu
import numpy as np
from exudyn import itemInterface as items

from peers.impact_scenes import BALL, BILLIARD, BLOCK, CHAIN, GRAVITY
from peers.interface import Outcome, Setting

NAME = "Exudyn"
_HOW = "contact springs without damping"
NOTES = {
    "ball": f"{_HOW}; it bounces on a ball of its size that is fixed",
    "block": "spheres of 1 mm about the corners on a triangle, critical damping, friction "
    "proportional below 1e-3 m/s. That creeps, and the block has come to rest before the last "
    "blow: the error is the whole tilt. So it is with its implicit generalized-alpha method",
    "billiard": f"{_HOW}; walls as springs of coordinates",
    "chain": "a kinematic tree; spheres of 5 mm about the ends, as the block's, friction "
    "proportional below 0.1 m/s. With smaller spheres or stiffer friction its rods fall through, "
    "or its steps do not end",
}


def version() -> str:
    return installed("exudyn")


def settings(scene: str, times: dict[str, tuple[float, float]]) -> list[Setting]:
    runs = {"ball": _ball, "block": _block, "billiard": _billiard, "chain": _chain}
    chosen = {"ball": ((1e5, 1e-4), (1e6, 5e-5)), "billiard": ((1e5, 1e-4), (1e7, 1e-5))}
    chosen |= {"block": ((1e6, 5e-5), (1e7, 2e-5)), "chain": ((1e5, 5e-5), (1e5, 2e-5))}
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


def _floor(system: exu.MainSystem, radius: float) -> int:
    ground = system.AddObject(items.ObjectGround())
    return system.AddMarker(items.MarkerBodyRigid(bodyNumber=ground, localPosition=[0, -radius, 0]))


def _corner(
    system: exu.MainSystem,
    floor: int,
    marker: int,
    radius: float,
    mu: float,
    zone: float,
    stiffness: float,
    mass: float,
) -> None:
    data = system.AddNode(
        items.NodeGenericData(initialCoordinates=[0.1, 0, 0, 0], numberOfDataCoordinates=4)
    )
    points = [[-50.0, 0.0, -50.0], [0.0, 0.0, 100.0], [50.0, 0.0, -50.0]]
    system.AddObject(
        items.ObjectContactSphereTriangle(
            markerNumbers=[marker, floor],
            nodeNumber=data,
            sphereRadius=radius,
            trianglePoints=exu.Vector3DList(points),
            includeEdges=0,
            dynamicFriction=mu,
            frictionProportionalZone=zone,
            contactStiffness=stiffness,
            contactDamping=2 * math.sqrt(stiffness * mass),
            impactModel=0,
        )
    )


def _block(stiffness: float, step: float, times: tuple[float, float]) -> Outcome:
    system, radius = exu.SystemContainer().AddSystem(), 1e-3
    a, wide, high = BLOCK.tilt, BLOCK.wide / 2, BLOCK.high / 2
    inertia = (BLOCK.wide**2 + BLOCK.high**2) / 12
    place = [0, wide * math.sin(a) + high * math.cos(a), a]
    node = system.AddNode(
        items.NodeRigidBody2D(referenceCoordinates=place, initialVelocities=[0, 0, 0])
    )
    body = system.AddObject(items.RigidBody2D(nodeNumber=node, mass=1.0, inertia=inertia))
    centre = system.AddMarker(items.MarkerBodyPosition(bodyNumber=body, localPosition=[0, 0, 0]))
    system.AddLoad(items.Force(markerNumber=centre, loadVector=[0, -GRAVITY, 0]))
    floor = _floor(system, radius)
    for x in (-wide, wide):
        marker = items.MarkerBodyRigid(bodyNumber=body, localPosition=[x, -high, 0])
        marker = system.AddMarker(marker)
        _corner(system, floor, marker, radius, BLOCK.mu, 1e-3, stiffness, 0.25)
    found, wall, count = _solve(system, [times[1]], step)
    q, v = found[-1]
    energy = 0.5 * float(v[0] ** 2 + v[1] ** 2 + inertia * v[2] ** 2)
    return Outcome((a + float(q[2]),), energy, wall, count)


def _chain(stiffness: float, step: float, times: tuple[float, float]) -> Outcome:
    system, radius, n = exu.SystemContainer().AddSystem(), 5e-3, CHAIN.rods
    start = np.array([0.0, 0.3, *np.diff([0.0, *CHAIN.angles])])
    size, length, mass = len(start), CHAIN.length, CHAIN.mass
    node = system.AddNode(
        items.NodeGenericODE2(
            numberOfODE2Coordinates=size,
            referenceCoordinates=list(start),
            initialCoordinates=[0.0] * size,
            initialCoordinates_t=[0.0] * size,
        )
    )
    own, none = np.diag([0, mass * length**2 / 12, mass * length**2 / 12]), np.zeros((3, 3))
    kinds = exu.JointType
    tree = system.AddObject(
        items.ObjectKinematicTree(
            nodeNumber=node,
            jointTypes=[kinds.PrismaticX, kinds.PrismaticY, *[kinds.RevoluteZ] * n],
            linkParents=list(range(-1, size - 1)),
            jointTransformations=exu.Matrix3DList([np.eye(3)] * size),
            jointOffsets=exu.Vector3DList([[0, 0, 0]] * 3 + [[length, 0, 0]] * (n - 1)),
            linkInertiasCOM=exu.Matrix3DList([none] * 2 + [own] * n),
            linkCOMs=exu.Vector3DList([[0, 0, 0]] * 2 + [[length / 2, 0, 0]] * n),
            linkMasses=[0.0, 0.0, *[mass] * n],
            baseOffset=[0.0, 0, 0],
            gravity=[0, -GRAVITY, 0],
        )
    )
    floor = _floor(system, radius)
    for link, place in [(2, 0.0), *((2 + k, length) for k in range(n))]:
        marker = items.MarkerKinematicTreeRigid(
            objectNumber=tree, linkNumber=link, localPosition=[place, 0, 0]
        )
        marker = system.AddMarker(marker)
        _corner(system, floor, marker, radius, CHAIN.mu, 0.1, stiffness, mass / 4)
    found, wall, count = _solve(system, list(times), step)
    x, y, *turns = start + np.array(found[0][0])
    places: list[float] = []
    for angle in np.cumsum(turns):
        dx, dy = length * math.cos(angle), length * math.sin(angle)
        places += [float(x + dx / 2), float(y + dy / 2)]
        x, y = x + dx, y + dy
    return Outcome(tuple(places), _energy(start, found[-1]), wall, count)


def _energy(start: np.ndarray, state: tuple[list, list]) -> float:
    """Of the chain in motion."""
    angle, rate = (np.cumsum(part[2:]) for part in (start + np.array(state[0]), state[1]))
    u, v = float(state[1][0]), float(state[1][1])
    length, found = CHAIN.length, 0.0
    for a, w in zip(angle, rate, strict=True):
        du, dv = -length * math.sin(a) * w, length * math.cos(a) * w
        found += (u + du / 2) ** 2 + (v + dv / 2) ** 2 + (length * w) ** 2 / 12
        u, v = u + du, v + dv
    return 0.5 * CHAIN.mass * found
