"""Drake: point contact, discrete (SAP, TAMSI) and continuous with regularised Coulomb friction."""

from __future__ import annotations

import logging
import math
import time
from functools import partial
from importlib.metadata import version as installed
from typing import Any

from closed_forms import BLOCK, GRAVITY, OSCILLATOR
from pydrake.geometry import HalfSpace, Sphere
from pydrake.math import RigidTransform
from pydrake.multibody.plant import (
    AddMultibodyPlantSceneGraph,
    ContactModel,
    CoulombFriction,
    DiscreteContactApproximation,
)
from pydrake.multibody.tree import (
    PrismaticJoint,
    PrismaticSpring,
    SpatialInertia,
    UnitInertia,
)
from pydrake.systems.analysis import ResetIntegratorFromFlags, Simulator
from pydrake.systems.framework import DiagramBuilder

from peers.interface import Outcome, Setting

logging.getLogger("drake").setLevel(logging.ERROR)

NAME = "Drake"
PENETRATION = 1e-5
_HOW = "sphere on a half space, penetration allowance 1e-5 m, begun at its static penetration"
NOTES = {
    "block": _HOW,
    "oscillator": _HOW,
    "hoop": "cannot: Drake has no law of rolling resistance",
}


def version() -> str:
    return installed("drake")


def settings(scene: str) -> list[Setting]:
    if scene == "hoop":
        return []
    chosen = [
        Setting(
            f"discrete, {name}",
            f"h = {step:g} s, stiction 1e-5 m/s",
            "steps",
            partial(_run, scene, step, approximation, None),
        )
        for name, approximation in (
            ("SAP", DiscreteContactApproximation.kSap),
            ("TAMSI", DiscreteContactApproximation.kTamsi),
        )
        for step in (1e-2, 1e-3, 1e-4)
    ]
    # The stiction tolerance bounds the error, so the two are tightened together. At 1e-7 the
    # oscillator takes 40 s and is less accurate than at 1e-5.
    levels = (1e-3, 1e-4, 1e-5) if scene == "oscillator" else (1e-3, 1e-5, 1e-7)
    return chosen + [
        Setting(
            "continuous, radau3",
            f"accuracy {level:.0e}, stiction {level:.0e} m/s",
            "evaluations",
            partial(_run, scene, 0.0, None, level),
        )
        for level in levels
    ]


def _run(scene: str, step: float, approximation: Any, level: float | None) -> Outcome:
    block = scene == "block"
    slope, mu = (BLOCK.slope, BLOCK.mu) if block else (0.0, OSCILLATOR.mu)
    friction, radius = CoulombFriction(mu, mu), 0.5
    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlantSceneGraph(builder, step)
    carriage = plant.AddRigidBody("carriage", SpatialInertia.Zero())
    body = plant.AddRigidBody("body", SpatialInertia(1.0, [0, 0, 0], UnitInertia(0.25, 0.25, 0.25)))
    along = plant.AddJoint(
        PrismaticJoint("along", plant.world_frame(), carriage.body_frame(), [1, 0, 0])
    )
    above = plant.AddJoint(
        PrismaticJoint("above", carriage.body_frame(), body.body_frame(), [0, 0, 1])
    )
    if not block:
        plant.AddForceElement(PrismaticSpring(along, 0.0, OSCILLATOR.k))
    plant.mutable_gravity_field().set_gravity_vector(
        [GRAVITY * math.sin(slope), 0.0, -GRAVITY * math.cos(slope)]
    )
    plant.RegisterCollisionGeometry(
        plant.world_body(), RigidTransform(), HalfSpace(), "ground", friction
    )
    plant.RegisterCollisionGeometry(body, RigidTransform(), Sphere(radius), "ball", friction)
    plant.set_contact_model(ContactModel.kPoint)
    if approximation is not None:
        plant.set_discrete_contact_approximation(approximation)
    plant.Finalize()
    plant.set_penetration_allowance(PENETRATION)
    plant.set_stiction_tolerance(level if level is not None else 1e-5)
    simulator = Simulator(builder.Build())
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    above.set_translation(context, radius - PENETRATION)
    if block:
        along.set_translation_rate(context, BLOCK.v0)
    else:
        along.set_translation(context, OSCILLATOR.x0)
    if level is not None:
        ResetIntegratorFromFlags(simulator, "radau3", 0.1)
        simulator.get_mutable_integrator().set_target_accuracy(level)
    simulator.Initialize()
    stop = BLOCK.stop if block else OSCILLATOR.stop
    begun = time.perf_counter()
    simulator.AdvanceTo(stop)
    wall = time.perf_counter() - begun
    work = (
        round(stop / step)
        if level is None
        else simulator.get_integrator().get_num_derivative_evaluations()
    )
    speed = max(abs(along.get_translation_rate(context)), abs(above.get_translation_rate(context)))
    return Outcome((along.get_translation(context),), speed, wall, work)
