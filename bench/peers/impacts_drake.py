"""Drake: compliant point contact, in continuous time without dissipation, or in discrete steps."""

from __future__ import annotations

import logging
import math
import time
from functools import partial
from importlib.metadata import version as installed
from typing import Any

import numpy as np
from pydrake.geometry import (
    AddContactMaterial,
    HalfSpace,
    ProximityProperties,
    Sphere,
)
from pydrake.math import RigidTransform, RollPitchYaw, RotationMatrix
from pydrake.multibody.plant import (
    AddMultibodyPlantSceneGraph,
    ContactModel,
    CoulombFriction,
    DiscreteContactApproximation,
)
from pydrake.multibody.tree import (
    FixedOffsetFrame,
    PlanarJoint,
    RevoluteJoint,
    SpatialInertia,
    UnitInertia,
)
from pydrake.systems.analysis import ResetIntegratorFromFlags, Simulator
from pydrake.systems.framework import DiagramBuilder

from peers.impact_scenes import BALL, BILLIARD, BLOCK, CHAIN, GRAVITY
from peers.interface import Outcome, Setting

logging.getLogger("drake").setLevel(logging.ERROR)

NAME = "Drake"
_ELASTIC = "continuous, compliant point contact of 1e8 N/m without dissipation"
_PLASTIC = "discrete, SAP, compliant point contact of 1e7 N/m, relaxation 1e-4 s"
NOTES = {
    "ball": _ELASTIC,
    "block": f"{_PLASTIC}; spheres of 1 um at the corners",
    "billiard": _ELASTIC,
    "chain": f"{_PLASTIC}; spheres of 1 um at the ends of the rods",
}
TINY = 1e-6
UPRIGHT = RotationMatrix(RollPitchYaw(math.pi / 2, 0, 0))  # x right, y up, in the world's x, z


def version() -> str:
    return installed("drake")


def settings(scene: str, times: dict[str, tuple[float, float]]) -> list[Setting]:
    run = partial(_run, scene, times[scene])
    if scene in ("ball", "billiard"):
        return [
            Setting("continuous, radau3", f"accuracy {x:.0e}", "evaluations", partial(run, 0.0, x))
            for x in ((1e-3, 1e-5) if scene == "billiard" else (1e-4, 1e-6))
        ]
    return [
        Setting("discrete, SAP", f"h = {h:g} s", "steps", partial(run, h, 0.0))
        for h in (1e-3, 1e-4)
    ]


def _properties(mu: float, stiffness: float, discrete: bool) -> ProximityProperties:
    found = ProximityProperties()
    AddContactMaterial(0.0, stiffness, CoulombFriction(mu, mu), found)
    if discrete:
        found.AddProperty("material", "relaxation_time", 1e-4)
    return found


def _run(scene: str, times: tuple[float, float], step: float, accuracy: float) -> Outcome:
    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlantSceneGraph(builder, step)
    discrete = step > 0
    mu = {"block": BLOCK.mu, "chain": CHAIN.mu}.get(scene, 0.0)
    how = _properties(mu, 1e7 if discrete else 1e8, discrete)
    plant.mutable_gravity_field().set_gravity_vector(
        [0.0, 0.0, 0.0 if scene == "billiard" else -GRAVITY]
    )
    joints = BUILD[scene](plant, how)
    plant.set_contact_model(ContactModel.kPoint)
    if discrete:
        plant.set_discrete_contact_approximation(DiscreteContactApproximation.kSap)
    plant.Finalize()
    simulator = Simulator(builder.Build())
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    START[scene](context, joints)
    if not discrete:
        ResetIntegratorFromFlags(simulator, "radau3", 0.01)
        simulator.get_mutable_integrator().set_target_accuracy(accuracy)
    simulator.Initialize()
    compared, stop = times
    begun = time.perf_counter()
    simulator.AdvanceTo(compared)
    wall = time.perf_counter() - begun
    q = plant.GetPositions(context)
    begun = time.perf_counter()
    if stop > compared:
        simulator.AdvanceTo(stop)
    wall += time.perf_counter() - begun
    energy = float(plant.CalcKineticEnergy(context))
    work = (
        round(stop / step)
        if discrete
        else simulator.get_integrator().get_num_derivative_evaluations()
    )
    return Outcome(tuple(_places(scene, np.array(q))), energy, wall, work)


def _floor(plant: Any, how: ProximityProperties, low: float = 0.0) -> None:
    plant.RegisterCollisionGeometry(
        plant.world_body(), RigidTransform([0, 0, low]), HalfSpace(), "floor", how
    )


def _planar(plant: Any, name: str, mass: float, inertia: float, at: float = 0.0) -> tuple[Any, Any]:
    """A body that moves in the world's x, z; its axes x, y are those of the scene."""
    unit = inertia / mass
    moments = UnitInertia(unit, unit, unit)
    arm = np.array([at, 0.0, 0.0])
    moments = moments.ShiftFromCenterOfMass(arm) if at else moments
    body = plant.AddRigidBody(name, SpatialInertia(mass, arm, moments))
    upright = RigidTransform(UPRIGHT, [0, 0, 0])
    frame = plant.AddFrame(FixedOffsetFrame(f"{name}_plane", plant.world_frame(), upright))
    return body, plant.AddJoint(PlanarJoint(name, frame, body.body_frame()))


def _ball(plant: Any, how: ProximityProperties) -> list[Any]:
    _floor(plant, how)
    body, joint = _planar(plant, "ball", 1.0, 0.4 * BALL.radius**2)
    plant.RegisterCollisionGeometry(body, RigidTransform(), Sphere(BALL.radius), "ball", how)
    return [joint]


def _block(plant: Any, how: ProximityProperties) -> list[Any]:
    _floor(plant, how, -TINY)
    body, joint = _planar(plant, "block", 1.0, (BLOCK.wide**2 + BLOCK.high**2) / 12)
    for k, x in enumerate((-BLOCK.wide / 2, BLOCK.wide / 2)):
        place = RigidTransform([x, -BLOCK.high / 2, 0])
        plant.RegisterCollisionGeometry(body, place, Sphere(TINY), f"corner{k}", how)
    return [joint]


def _billiard(plant: Any, how: ProximityProperties) -> list[Any]:
    x, y = BILLIARD.half
    walls = (([-x, 0, 0], [1, 0, 0]), ([x, 0, 0], [-1, 0, 0]), ([0, 0, -y], [0, 0, 1]))
    walls += (([0, 0, y], [0, 0, -1]),)
    for k, (at, normal) in enumerate(walls):
        place = RigidTransform(RotationMatrix.MakeFromOneVector(normal, 2), at)
        plant.RegisterCollisionGeometry(plant.world_body(), place, HalfSpace(), f"wall{k}", how)
    joints = []
    for k in range(len(BILLIARD.places)):
        inertia = 0.4 * BILLIARD.mass * BILLIARD.radius**2
        body, joint = _planar(plant, f"b{k}", BILLIARD.mass, inertia)
        ball = Sphere(BILLIARD.radius)
        plant.RegisterCollisionGeometry(body, RigidTransform(), ball, f"ball{k}", how)
        joints.append(joint)
    return joints


def _chain(plant: Any, how: ProximityProperties) -> list[Any]:
    _floor(plant, how, -TINY)
    inertia, length = CHAIN.mass * CHAIN.length**2 / 12, CHAIN.length
    body, joint = _planar(plant, "b0", CHAIN.mass, inertia, length / 2)
    joints, bodies = [joint], [body]
    plant.RegisterCollisionGeometry(body, RigidTransform(), Sphere(TINY), "first", how)
    for k in range(1, CHAIN.rods):
        unit = UnitInertia(*[inertia / CHAIN.mass] * 3)
        arm = np.array([length / 2, 0, 0])
        whole = SpatialInertia(CHAIN.mass, arm, unit.ShiftFromCenterOfMass(arm))
        bodies.append(plant.AddRigidBody(f"b{k}", whole))
        end = FixedOffsetFrame(
            f"end{k}", bodies[k - 1].body_frame(), RigidTransform([length, 0, 0])
        )
        frame = plant.AddFrame(end)
        joints.append(
            plant.AddJoint(RevoluteJoint(f"h{k}", frame, bodies[k].body_frame(), [0, 0, 1]))
        )
    for k, body in enumerate(bodies):
        place = RigidTransform([length, 0, 0])
        plant.RegisterCollisionGeometry(body, place, Sphere(TINY), f"tip{k}", how)
    return joints


def _start_ball(context: Any, joints: list[Any]) -> None:
    joints[0].set_translation(context, [0.0, BALL.radius + BALL.height])


def _start_block(context: Any, joints: list[Any]) -> None:
    a, b, t = BLOCK.wide / 2, BLOCK.high / 2, BLOCK.tilt
    joints[0].set_translation(context, [0.0, a * math.sin(t) + b * math.cos(t)])
    joints[0].set_rotation(context, t)


def _start_billiard(context: Any, joints: list[Any]) -> None:
    for joint, place in zip(joints, BILLIARD.places, strict=True):
        joint.set_translation(context, place)
    joints[0].set_translational_velocity(context, BILLIARD.speed)


def _start_chain(context: Any, joints: list[Any]) -> None:
    joints[0].set_translation(context, [0.0, 0.3])
    joints[0].set_rotation(context, CHAIN.angles[0])
    for joint, turn in zip(joints[1:], np.diff(CHAIN.angles), strict=True):
        joint.set_angle(context, float(turn))


BUILD = {"ball": _ball, "block": _block, "billiard": _billiard, "chain": _chain}
START = {
    "ball": _start_ball,
    "block": _start_block,
    "billiard": _start_billiard,
    "chain": _start_chain,
}


def _places(scene: str, q: np.ndarray) -> list[float]:
    if scene == "ball":
        return [float(q[1])]
    if scene == "block":
        return [float(q[2])]
    if scene == "billiard":
        return [float(x) for k in range(len(BILLIARD.places)) for x in q[3 * k : 3 * k + 2]]
    angles, at = np.cumsum(q[2:]), q[:2]
    found: list[float] = []
    for a in angles:
        arm = CHAIN.length / 2 * np.array([math.cos(a), math.sin(a)])
        found += [float(x) for x in at + arm]
        at = at + 2 * arm
    return found
