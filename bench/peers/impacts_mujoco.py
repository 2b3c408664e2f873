"""MuJoCo: contacts are soft; stiffness and damping are given directly, or by times of two steps."""

from __future__ import annotations

import math
import time
from functools import partial

import mujoco
import numpy as np

from peers.impact_scenes import BALL, BILLIARD, BLOCK, CHAIN, GRAVITY
from peers.interface import Outcome, Setting

NAME = "MuJoCo"
_ELASTIC = "soft contact without damping, which lasts about ten steps"
_PLASTIC = "soft contact, solref = 2 steps, elliptic cone, impratio 100"
NOTES = {
    "ball": _ELASTIC,
    "block": _PLASTIC,
    "billiard": _ELASTIC,
    "chain": f"{_PLASTIC}; spheres of 1 um at the ends of the rods. Before the first impact it is "
    "right to 1e-13; from then on its error does not shrink with the step: its convex law lifts a "
    "contact that slides",
}
TINY = 1e-6


def version() -> str:
    return str(mujoco.__version__)


def settings(scene: str, times: dict[str, tuple[float, float]]) -> list[Setting]:
    steps = {"ball": (1e-3, 1e-4), "billiard": (1e-3, 1e-4, 1e-5)}.get(scene, (1e-3, 1e-4, 1e-5))
    return [
        Setting(
            f"soft contact, {scheme}",
            f"h = {h:g} s",
            "steps",
            partial(_run, scene, scheme, h, times),
        )
        for scheme in ("Euler", "RK4")
        for h in steps
        if not (scheme == "RK4" and h < 1e-4)
    ]


def _run(scene: str, scheme: str, step: float, times: dict[str, tuple[float, float]]) -> Outcome:
    model = mujoco.MjModel.from_xml_string(TEXTS[scene](scheme, step))
    data = mujoco.MjData(model)
    if scene == "block":
        data.qpos[2] = -BLOCK.tilt  # about -y
        half = np.array([BLOCK.wide, BLOCK.high]) / 2
        c, s = math.cos(BLOCK.tilt), math.sin(BLOCK.tilt)
        data.qpos[1] = half[0] * s + half[1] * c
    if scene == "billiard":
        data.qvel[:2] = BILLIARD.speed
    if scene == "chain":
        a = np.array(CHAIN.angles)
        data.qpos[:] = [0.0, 0.0, *(-np.diff(a, prepend=0.0))]
    compared, stop = times[scene]
    first, rest = round(compared / step), round((stop - compared) / step)
    begun = time.perf_counter()
    mujoco.mj_step(model, data, nstep=first)
    half_way = time.perf_counter()
    # the last step ends beside the instant that is compared: move on with the speed
    q = np.array(data.qpos) + (compared - first * step) * np.array(data.qvel)
    kept = half_way - begun
    begun = time.perf_counter()
    if rest:
        mujoco.mj_step(model, data, nstep=rest)
    wall = kept + time.perf_counter() - begun
    energy = _energy(model, data)
    return Outcome(tuple(_places(scene, q)), energy, wall, first + rest)


def _energy(model: mujoco.MjModel, data: mujoco.MjData) -> float:
    mujoco.mj_energyVel(model, data)
    return float(data.energy[1])


def _places(scene: str, q: np.ndarray) -> list[float]:
    if scene == "ball":
        return [float(q[0]) + BALL.radius + BALL.height]
    if scene == "block":
        return [-float(q[2])]
    if scene == "billiard":
        return [float(x + p) for x, p in zip(q, np.ravel(BILLIARD.places), strict=True)]
    angles = -np.cumsum(q[2:])
    at = np.array([q[0], q[1] + 0.3])
    found: list[float] = []
    for a in angles:
        arm = CHAIN.length / 2 * np.array([math.cos(a), math.sin(a)])
        found += [float(x) for x in at + arm]
        at = at + 2 * arm
    return found


def _option(scheme: str, step: float, gravity: float = GRAVITY) -> str:
    return (
        f'<option timestep="{step}" integrator="{scheme}" cone="elliptic" impratio="100" '
        f'tolerance="1e-14" iterations="100" gravity="0 0 {-gravity}"/>'
    )


def _elastic(step: float) -> str:
    """Of a contact that lasts pi/sqrt(k) = 10 steps."""
    return f'condim="1" solref="{-((math.pi / (10 * step)) ** 2)} 0" solimp="0.99 0.99 0.001"'


def _plastic(step: float, mu: float) -> str:
    return f'condim="3" friction="{mu} 0 0" solref="{2 * step} 1" solimp="0.99 0.9999 0.001"'


def _ball(scheme: str, step: float) -> str:
    how = _elastic(step)
    return f"""<mujoco>{_option(scheme, step)}<worldbody>
      <geom type="plane" size="0 0 1" {how}/>
      <body pos="0 0 {BALL.radius + BALL.height}"><joint type="slide" axis="0 0 1"/>
      <geom type="sphere" size="{BALL.radius}" mass="1" {how}/></body></worldbody></mujoco>"""


def _block(scheme: str, step: float) -> str:
    how, (a, b) = _plastic(step, BLOCK.mu), (BLOCK.wide / 2, BLOCK.high / 2)
    inertia = (BLOCK.wide**2 + BLOCK.high**2) / 12
    corners = "".join(
        f'<geom type="sphere" size="{TINY}" pos="{x} 0 {-b + TINY}" {how}/>' for x in (-a, a)
    )
    return f"""<mujoco><compiler inertiafromgeom="false"/>{_option(scheme, step)}<worldbody>
      <geom type="plane" size="0 0 1" {how}/>
      <body><inertial pos="0 0 0" mass="1" diaginertia="{inertia} {inertia} {inertia}"/>
      <joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/>
      <joint type="hinge" axis="0 1 0"/>{corners}</body></worldbody></mujoco>"""


def _billiard(scheme: str, step: float) -> str:
    how, (x, y) = _elastic(step), BILLIARD.half
    walls = "".join(
        f'<geom type="plane" size="0 0 1" pos="{p}" zaxis="{n}" {how}/>'
        for p, n in (
            (f"{-x} 0 0", "1 0 0"),
            (f"{x} 0 0", "-1 0 0"),
            (f"0 {-y} 0", "0 1 0"),
            (f"0 {y} 0", "0 -1 0"),
        )
    )
    balls = "".join(
        f'<body pos="{px} {py} 0"><joint type="slide" axis="1 0 0"/>'
        '<joint type="slide" axis="0 1 0"/>'
        f'<geom type="sphere" size="{BILLIARD.radius}" mass="{BILLIARD.mass}" {how}/></body>'
        for px, py in BILLIARD.places
    )
    option = _option(scheme, step, 0.0)
    return f"<mujoco>{option}<worldbody>{walls}{balls}</worldbody></mujoco>"


def _chain(scheme: str, step: float) -> str:
    how, m, length = _plastic(step, CHAIN.mu), CHAIN.mass, CHAIN.length
    inertia = m * length**2 / 12
    end = f'<geom type="sphere" size="{TINY}" pos="{length} 0 0" {how}/>'
    first = f'<geom type="sphere" size="{TINY}" {how}/>'
    text = ""
    for k in range(CHAIN.rods):
        joints = '<joint type="hinge" axis="0 1 0"/>'
        place = f"{length} 0 0"
        if k == 0:
            joints = f'<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/>{joints}'
            place = "0 0 0.3"
        text += (
            f'<body pos="{place}">{joints}<inertial pos="{length / 2} 0 0" mass="{m}" '
            f'diaginertia="{inertia * 1e-6} {inertia} {inertia}"/>{end}{first if k == 0 else ""}'
        )
    return f"""<mujoco><compiler inertiafromgeom="false" boundmass="0" boundinertia="0"
      balanceinertia="true"/>{_option(scheme, step)}<worldbody>
      <geom type="plane" size="0 0 1" {how} pos="0 0 {-TINY}"/>
      {text}{"</body>" * CHAIN.rods}</worldbody></mujoco>"""


TEXTS = {"ball": _ball, "block": _block, "billiard": _billiard, "chain": _chain}
