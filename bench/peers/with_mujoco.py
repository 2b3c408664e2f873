"""MuJoCo: friction as a soft convex constraint, in a contact or as friction loss of a joint."""

from __future__ import annotations

import math
import time
from functools import partial

import mujoco
import numpy as np
from closed_forms import BLOCK, GRAVITY, HOOP, OSCILLATOR

from peers.interface import Outcome, Setting

NAME = "MuJoCo"
_STIFF = (
    "solref = 2 steps, solimp 0.99 0.9999, 20 noslip iterations (stiffer than the "
    "default, and more accurate here)"
)
_BOTH = f"contact: elliptic cone, impratio 100; joint: friction loss of given force; {_STIFF}"
NOTES = {
    "block": _BOTH,
    "oscillator": f"{_BOTH}; the contact here with MuJoCo's own defaults (pyramidal cone, soft), "
    "which are more accurate in this scene",
    "hoop": "contact for sliding, elliptic cone, impratio 100; the rolling couple given as "
    "friction loss of the hinge, since MuJoCo's own rolling friction shares one cone with sliding; "
    + _STIFF,
}
_START = {"block": 0.0, "oscillator": OSCILLATOR.x0, "hoop": 0.0}
_SPEED = {"block": BLOCK.v0, "oscillator": 0.0, "hoop": HOOP.v0}
_STOP = {"block": BLOCK.stop, "oscillator": OSCILLATOR.stop, "hoop": HOOP.stop}


def version() -> str:
    return str(mujoco.__version__)


def settings(scene: str) -> list[Setting]:
    # A step of RK4 evaluates four times.
    ways = [("contact", "Euler", 1), ("contact", "RK4", 4)]
    if scene != "hoop":
        ways += [("joint", "Euler", 1), ("joint", "RK4", 4)]
    return [
        Setting(
            f"{way}, {scheme}",
            f"h = {step:g} s",
            "evaluations",
            partial(_run, scene, way, scheme, stages, step),
        )
        for way, scheme, stages in ways
        for step in (2e-3, 1e-3, 2e-4)
    ]


def _run(scene: str, way: str, scheme: str, stages: int, step: float) -> Outcome:
    model = mujoco.MjModel.from_xml_string(_text(scene, way, scheme, step))
    data = mujoco.MjData(model)
    data.qpos[0], data.qvel[0] = _START[scene], _SPEED[scene]
    count = round(_STOP[scene] / step)
    begun = time.perf_counter()
    mujoco.mj_step(model, data, nstep=count)
    wall = time.perf_counter() - begun
    x = float(data.qpos[0])
    positions = (x, HOOP.r * float(data.qpos[2])) if scene == "hoop" else (x,)
    return Outcome(positions, float(np.max(np.abs(data.qvel))), wall, stages * count)


def _text(scene: str, way: str, scheme: str, step: float) -> str:
    slope = BLOCK.slope if scene == "block" else 0.0
    mu = {"block": BLOCK.mu, "oscillator": OSCILLATOR.mu, "hoop": HOOP.mu}[scene]
    weight = GRAVITY * math.cos(slope)
    contact = way == "contact"
    defaults = contact and scene == "oscillator"
    soft = f'"{2 * step} 1"', '"0.99 0.9999 0.001"'
    if defaults:
        soft = '"0.02 1"', '"0.9 0.95 0.001"'
    cone = "pyramidal" if defaults else "elliptic"
    ratio, noslip = (1, 0) if defaults else (100, 20)
    geometry = f'condim="3" friction="{mu} 0 0" solref={soft[0]} solimp={soft[1]}'
    joint = f"solreffriction={soft[0]} solimpfriction={soft[1]}"
    stiffness = OSCILLATOR.k if scene == "oscillator" else 0.0
    joints = [
        f'<joint type="slide" axis="1 0 0" stiffness="{stiffness}" {joint} '
        f'frictionloss="{0.0 if contact else mu * weight}"/>'
    ]
    if contact:
        joints.append('<joint type="slide" axis="0 0 1"/>')
    if scene == "hoop":
        couple = HOOP.delta * weight
        joints.append(f'<joint type="hinge" axis="0 1 0" frictionloss="{couple}" {joint}/>')
    inertia = HOOP.r**2
    touches = "" if contact else 'contype="0" conaffinity="0"'
    return f"""
      <mujoco>
        <option timestep="{step}" integrator="{scheme}" cone="{cone}" impratio="{ratio}"
                tolerance="1e-14" iterations="100" ls_iterations="50"
                noslip_iterations="{noslip}" noslip_tolerance="1e-14"
                gravity="{GRAVITY * math.sin(slope)} 0 {-weight}"/>
        <worldbody>
          <geom type="plane" size="0 0 1" {geometry}/>
          <body pos="0 0 {HOOP.r}">
            {"".join(joints)}
            <inertial pos="0 0 0" mass="1" diaginertia="{inertia} {inertia} {inertia}"/>
            <geom type="sphere" size="{HOOP.r}" {geometry} {touches}/>
          </body>
        </worldbody>
      </mujoco>"""
