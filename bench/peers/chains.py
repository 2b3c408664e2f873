"""Chains of pinned rods in the peers, run by their own interpreter: see ../chains.py.

`python chains.py N` prints, for each peer that is installed, lines of JSON with the tip of the last
rod of N after a second and the time of the integration (least of several).
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable

import numpy as np

GRAVITY = 9.81
REPEAT = 3


def _least(run: Callable[[], object]) -> tuple[object, float]:
    best, found = 1e30, None
    begun = time.perf_counter()
    for _ in range(REPEAT):
        first = time.perf_counter()
        found = run()
        best = min(best, time.perf_counter() - first)
        if time.perf_counter() - begun > 6:
            break
    return found, best


def _tell(peer: str, setting: str, tip: object, seconds: float) -> None:
    place = [float(x) for x in np.asarray(tip).ravel()[:2]]
    line = {"peer": peer, "setting": setting, "tip": place, "seconds": seconds}
    print(json.dumps(line), flush=True)


def pinocchio(n: int) -> None:
    """Articulated-body recursion in C++, integrated by SciPy's DOP853."""
    import pinocchio as pin
    from scipy.integrate import solve_ivp

    model = pin.Model()
    model.gravity.linear = np.array([0, -GRAVITY, 0])
    inertia = pin.Inertia(1.0, np.array([0.5, 0, 0]), np.diag([1e-9, 1 / 12, 1 / 12]))
    parent = 0
    for k in range(n):
        placement = pin.SE3(np.eye(3), np.array([1.0 if k else 0.0, 0, 0]))
        parent = model.addJoint(parent, pin.JointModelRZ(), placement, f"j{k}")
        model.appendBodyToJoint(parent, inertia, pin.SE3.Identity())
    data = model.createData()
    torque = np.zeros(n)

    def slope(_: float, z: np.ndarray) -> np.ndarray:
        return np.concatenate((z[n:], pin.aba(model, data, z[:n], z[n:], torque)))

    def run(tolerance: float) -> np.ndarray:
        start = np.zeros(2 * n)
        end = solve_ivp(slope, (0, 1), start, "DOP853", rtol=tolerance, atol=tolerance).y[:n, -1]
        angle = np.cumsum(end)
        return np.array([np.cos(angle).sum(), np.sin(angle).sum()])

    for tolerance in (1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13):
        _tell("Pinocchio, DOP853", f"rtol {tolerance:g}", *_least(lambda: run(tolerance)))  # noqa: B023


def mujoco(n: int) -> None:
    """RK4 of fixed step, whole in C."""
    import mujoco as mj

    text = "".join(
        f'<body pos="{1 if k else 0} 0 0"><joint type="hinge" axis="0 0 1"/>'
        '<inertial pos="0.5 0 0" mass="1" '
        'diaginertia="1e-6 0.083333333333333333 0.083333333333333333"/>'
        for k in range(n)
    )
    xml = (
        f'<mujoco><option gravity="0 {-GRAVITY} 0" integrator="RK4">'
        '<flag constraint="disable"/></option>'
        f'<compiler boundmass="0" boundinertia="0"/>'
        f"<worldbody>{text}{'</body>' * n}</worldbody></mujoco>"
    )
    model = mj.MjModel.from_xml_string(xml)
    for steps in (100, 300, 1000, 3000, 10000, 30000):
        model.opt.timestep = 1 / steps

        def run(steps: int = steps) -> np.ndarray:
            data = mj.MjData(model)
            mj.mj_step(model, data, steps)
            angle = np.cumsum(data.qpos)
            return np.array([np.cos(angle).sum(), np.sin(angle).sum()])

        _tell("MuJoCo, RK4", f"{steps} steps", *_least(run))


def exudyn(n: int) -> None:
    """A kinematic tree in minimal coordinates, DOPRI5 with its step control, whole in C++."""
    import exudyn as exu
    from exudyn import itemInterface as items

    def run(tolerance: float) -> tuple[np.ndarray, float]:
        system = exu.SystemContainer()
        mbs = system.AddSystem()
        node = mbs.AddNode(
            items.NodeGenericODE2(
                numberOfODE2Coordinates=n,
                referenceCoordinates=[0.0] * n,
                initialCoordinates=[0.0] * n,
                initialCoordinates_t=[0.0] * n,
            )
        )
        arms = [[1.0 if k else 0.0, 0, 0] for k in range(n)]
        mbs.AddObject(
            items.ObjectKinematicTree(
                nodeNumber=node,
                jointTypes=[exu.JointType.RevoluteZ] * n,
                linkParents=list(range(-1, n - 1)),
                jointTransformations=exu.Matrix3DList([np.eye(3)] * n),
                jointOffsets=exu.Vector3DList(arms),
                linkInertiasCOM=exu.Matrix3DList([np.diag([0, 1 / 12, 1 / 12])] * n),
                linkCOMs=exu.Vector3DList([[0.5, 0, 0]] * n),
                linkMasses=[1.0] * n,
                baseOffset=[0.0, 0, 0],
                gravity=[0, -GRAVITY, 0],
            )
        )
        mbs.Assemble()
        settings = exu.SimulationSettings()
        settings.timeIntegration.endTime = 1
        settings.timeIntegration.numberOfSteps = 1
        settings.timeIntegration.relativeTolerance = tolerance
        settings.timeIntegration.absoluteTolerance = tolerance
        settings.solutionSettings.writeSolutionToFile = False
        settings.timeIntegration.verboseMode = 0
        first = time.perf_counter()
        mbs.SolveDynamic(settings, solverType=exu.DynamicSolverType.DOPRI5, showHints=False)
        spent = time.perf_counter() - first
        angle = np.cumsum(mbs.GetNodeOutput(node, exu.OutputVariableType.Coordinates))
        return np.array([np.cos(angle).sum(), np.sin(angle).sum()]), spent

    for tolerance in (1e-3, 1e-5, 1e-7, 1e-9, 1e-11):
        found = [run(tolerance) for _ in range(3)]
        _tell("Exudyn, DOPRI5", f"rtol {tolerance:g}", found[0][0], min(s for _, s in found))


def main() -> None:
    """Every peer that can be loaded; what fails is said on standard error."""
    n = int(sys.argv[1])
    for peer in (pinocchio, mujoco, exudyn):
        try:
            peer(n)
        except Exception as error:
            print(f"{peer.__name__}: {type(error).__name__}: {error}", file=sys.stderr, flush=True)


if __name__ == "__main__":
    main()
