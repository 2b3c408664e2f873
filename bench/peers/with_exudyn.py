"""Exudyn: bristle friction of given force on a coordinate, penalty contact for the rolling disc."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from functools import partial
from importlib.metadata import version as installed
from typing import Any

import exudyn as exu
import numpy as np
from closed_forms import BLOCK, GRAVITY, HOOP, OSCILLATOR
from exudyn import itemInterface as items

from peers.interface import Outcome, Setting

NAME = "Exudyn"
_BRISTLE = "friction force given (mu N known beforehand), bristle of damping ratio 1/2"
NOTES = {
    "block": f"{_BRISTLE}; full Newton iteration, more accurate here than the modified",
    "oscillator": f"{_BRISTLE}, modified Newton iteration, as accurate here as the full",
    "hoop": "RollingDiscPenalty (regularised slip, penalty contact); rolling couple as a bristle "
    "of given couple on the angle",
}


def version() -> str:
    return installed("exudyn")


def settings(scene: str) -> list[Setting]:
    if scene == "hoop":
        return [
            Setting(
                f"penalty {_plain(stiffness)} N/m, zone {_plain(zone)} m/s, trapezoidal",
                f"h = {step:g} s",
                "steps",
                partial(_hoop, stiffness, zone, step),
            )
            for stiffness, zone in ((1e5, 1e-3), (1e6, 1e-4))
            for step in (1e-2, 1e-3, 1e-4)
        ]
    return [
        Setting(
            f"bristle {_plain(stiffness)} N/m, trapezoidal",
            f"h = {step:g} s",
            "steps",
            partial(_point, scene, stiffness, step),
        )
        for stiffness in (1e5, 1e7)
        for step in (1e-2, 1e-3, 1e-4)
    ]


def _plain(x: float) -> str:
    return f"{x:.0e}".replace("e+0", "e").replace("e-0", "e-")


def _point(scene: str, bristle: float, step: float) -> Outcome:
    system = exu.SystemContainer().AddSystem()
    slope = BLOCK.slope if scene == "block" else 0.0
    mu, stop = (BLOCK.mu, BLOCK.stop) if scene == "block" else (OSCILLATOR.mu, OSCILLATOR.stop)
    x0, v0 = (0.0, BLOCK.v0) if scene == "block" else (OSCILLATOR.x0, 0.0)
    node = system.AddNode(
        items.Node1D(referenceCoordinates=[0.0], initialCoordinates=[x0], initialVelocities=[v0])
    )
    system.AddObject(items.Mass1D(nodeNumber=node, mass=1.0))
    moving = system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=0))
    system.AddLoad(items.LoadCoordinate(markerNumber=moving, load=GRAVITY * math.sin(slope)))
    # A bristle that sticks where the motion begins from rest, and slips where it does not.
    _bristle(
        system,
        moving,
        [1.0 if v0 else 0.0, x0, 0.0],
        stiffness=OSCILLATOR.k if scene == "oscillator" else 0.0,
        dynamicFrictionForce=mu * GRAVITY * math.cos(slope),
        stickingStiffness=bristle,
        stickingDamping=math.sqrt(bristle),
    )
    count, wall = _solve(system, stop, step, modified=scene != "block")
    return Outcome((_get(system, node)[0],), abs(_get(system, node, True)[0]), wall, count)


def _hoop(stiffness: float, zone: float, step: float) -> Outcome:
    system = exu.SystemContainer().AddSystem()
    r, inertia, couple = HOOP.r, HOOP.r**2, HOOP.delta * GRAVITY
    # The axle is x, so that the angle is the first of the three and never singular.
    node = system.AddNode(
        items.NodeRigidBodyRxyz(
            referenceCoordinates=[0, 0, r, 0, 0, 0],
            initialCoordinates=[0, 0, -GRAVITY / stiffness, 0, 0, 0],
            initialVelocities=[0, HOOP.v0, 0, 0, 0, 0],
        )
    )
    body = system.AddObject(
        items.RigidBody(nodeNumber=node, mass=1.0, inertia=[inertia, inertia, inertia, 0, 0, 0])
    )
    ground = system.AddObject(items.ObjectGround())
    centre, origin = (
        system.AddMarker(items.MarkerBodyRigid(bodyNumber=number, localPosition=[0, 0, 0]))
        for number in (body, ground)
    )
    mass = system.AddMarker(items.MarkerBodyMass(bodyNumber=body))
    system.AddLoad(items.Gravity(markerNumber=mass, loadVector=[0, 0, -GRAVITY]))
    data = system.AddNode(
        items.NodeGenericData(initialCoordinates=[0, 0, 0], numberOfDataCoordinates=3)
    )
    system.AddObject(
        items.RollingDiscPenalty(
            markerNumbers=[origin, centre],
            nodeNumber=data,
            discRadius=r,
            discAxis=[1, 0, 0],
            planeNormal=[0, 0, 1],
            contactStiffness=stiffness,
            contactDamping=math.sqrt(stiffness),
            dryFriction=[HOOP.mu, HOOP.mu],
            dryFrictionProportionalZone=zone,
            useLinearProportionalZone=True,
        )
    )
    angle = system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=3))
    bristle = stiffness / 10
    _bristle(
        system,
        angle,
        [0.0, 0.0, 0.0],
        dynamicFrictionForce=couple,
        stickingStiffness=bristle,
        stickingDamping=math.sqrt(bristle * inertia),
    )
    count, wall = _solve(system, HOOP.stop, step)
    q, v = _get(system, node), _get(system, node, True)
    return Outcome((q[1], -r * q[3]), max(map(abs, v)), wall, count)


def _bristle(system: Any, moving: int, start: list[float], **values: float) -> None:
    fixed = system.AddMarker(
        items.MarkerNodeCoordinate(nodeNumber=system.AddNode(items.NodePointGround()), coordinate=0)
    )
    data = system.AddNode(
        items.NodeGenericData(initialCoordinates=start, numberOfDataCoordinates=3)
    )
    system.AddObject(
        items.CoordinateSpringDamperExt(markerNumbers=[fixed, moving], nodeNumber=data, **values)
    )


def _solve(system: Any, stop: float, step: float, modified: bool = True) -> tuple[int, float]:
    system.Assemble()
    settings = exu.SimulationSettings()
    count = round(stop / step)
    settings.timeIntegration.numberOfSteps = count
    settings.timeIntegration.endTime = stop
    settings.timeIntegration.verboseMode = 0
    settings.timeIntegration.newton.useModifiedNewton = modified
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = stop
    solve: Callable[..., Any] = system.SolveDynamic
    begun = time.perf_counter()
    solve(settings, solverType=exu.DynamicSolverType.TrapezoidalIndex2)
    return count, time.perf_counter() - begun


def _get(system: Any, node: int, rates: bool = False) -> list[float]:
    kind = exu.OutputVariableType.Coordinates_t if rates else exu.OutputVariableType.Coordinates
    return [float(x) for x in np.atleast_1d(system.GetNodeOutput(node, kind))]
