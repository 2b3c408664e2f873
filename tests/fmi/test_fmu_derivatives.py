"""Derivatives within the mode: in directions of states, inputs and parameters, and of outputs."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
import pytest
from fmpy import extract, instantiate_fmu, read_model_description
from fmpy.fmi1 import FMICallException

import frot

MODELS = Path(__file__).parents[2] / "models"
VERSIONS = ("2.0", "3.0")
SMOOTH = ("double_pendulum", "flyball_governor", "andrews_squeezer", "bicycle")
# Of the largest derivative: what extrapolated differences leave, beside rounding.
CLOSE = 1e-11

# A rough slope: a = (pull - mu (m g cos - lift)) / m - g sin, while the body slips upwards.
SLOPE = """planar model Slope
  parameter Real mu = 0.3;
  parameter Mass m = {mass} kg;
  parameter Velocity v0 = 4 m/s;
  input Force pull(start = 0 N);
  input Force lift(start = 0 N);
  world(gravity = 10 m/s^2);
  body b: particle(mass = m);
  curve floor on ground: line(through = (0, 0) m, direction = (0.8, 0.6));
  liaison c: contact_ponctuel(b, floor) with coulomb(mu);
  force f: on(b, value = pull*(0.8, 0.6) + lift*(-0.6, 0.8));
  output Acceleration a = 0.8*b.acceleration.x + 0.6*b.acceleration.y;
  output Length along = 0.8*b.position.x + 0.6*b.position.y;
  output Real squared = (0.8*b.velocity.x + 0.6*b.velocity.y)^2/(1 m^2/s^2);
initial
  b.position = (0, 0) m;
  b.velocity = v0*(0.8, 0.6);
  experiment(stop = 1 s, tolerance = 1e-11);
end Slope;
"""


class Instance:
    """One that is ready, of either version and kind."""

    def __init__(self, path: Path, kind: str) -> None:
        self.description = read_model_description(str(path))
        self.version = self.description.fmiVersion
        self.fmu: Any = instantiate_fmu(extract(str(path)), self.description, kind)
        if self.version == "2.0":
            self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()
        if kind == "ModelExchange":
            update = "newDiscreteStates" if self.version == "2.0" else "updateDiscreteStates"
            getattr(self.fmu, update)()
            self.fmu.enterContinuousTimeMode()
        self.references = {v.name: v.valueReference for v in self.description.modelVariables}

    def derive(self, unknowns: list[int], knowns: list[int], seed: list[float]) -> list[float]:
        return list(self.fmu.getDirectionalDerivative(unknowns, knowns, seed))

    def adjoint(self, unknowns: list[int], knowns: list[int], seed: list[float]) -> list[float]:
        """Of FMI 3.0."""
        answer = (ctypes.c_double * len(knowns))()
        of, by = ((ctypes.c_uint32 * len(x))(*x) for x in (unknowns, knowns))
        seeds = (ctypes.c_double * len(seed))(*seed)
        self.fmu.fmi3GetAdjointDerivative(
            self.fmu.component, of, len(unknowns), by, len(knowns), seeds, len(seed), answer,
            len(knowns),
        )  # fmt: skip
        return list(answer)

    def set(self, name: str, value: float) -> None:
        put = self.fmu.setReal if self.version == "2.0" else self.fmu.setFloat64
        put([self.references[name]], [value])

    def get(self, name: str) -> float:
        read = self.fmu.getReal if self.version == "2.0" else self.fmu.getFloat64
        return float(read([self.references[name]])[0])

    def rates(self, names: list[str]) -> list[float]:
        read = "getRealOutputDerivatives" if self.version == "2.0" else "getOutputDerivatives"
        return list(getattr(self.fmu, read)([self.references[n] for n in names], [1] * len(names)))

    def states(self) -> np.ndarray:
        count = len(self.description.derivatives)
        x = (ctypes.c_double * count)()
        read = f"fmi{self.version[0]}GetContinuousStates"
        getattr(self.fmu, read)(self.fmu.component, x, count)
        return np.array(x)


@pytest.fixture(params=VERSIONS)
def version(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(params=[1.0, 1e6, 1e-6])
def mass(request: pytest.FixtureRequest) -> float:
    return float(request.param)


@pytest.fixture
def slope(tmp_path: Path, version: str, mass: float) -> Iterator[Path]:
    path = tmp_path / "slope.fmu"
    frot.compile(SLOPE.format(mass=mass)).export_fmu(path, version, "native")
    yield path


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_friction_follows_inputs_and_parameters(slope: Path, kind: str, mass: float) -> None:
    """Of the acceleration in slip: 1/m by the pull, mu/m by the lift, -g cos + lift/m by mu."""
    one = Instance(slope, kind)
    refer = one.references
    one.set("lift", 0.5 * mass)
    one.set("pull", 0.25 * mass)
    seen = [
        one.derive([refer["a"]], [refer[name]], [1.0])[0] for name in ("pull", "lift", "mu", "m")
    ]
    by_mass = -(0.25 * mass + 0.3 * 0.5 * mass) / mass**2
    assert seen == pytest.approx([1 / mass, 0.3 / mass, -8 + 0.5, by_mass], rel=1e-9)
    # a direction is the sum of its parts, also with a known named twice
    (both,) = one.derive(
        [refer["a"]], [refer["pull"], refer["mu"], refer["pull"]], [2 * mass, 0.5, mass]
    )
    assert both == pytest.approx(3 - 0.5 * 7.5, rel=1e-9)
    if one.version == "3.0":
        both = one.adjoint([refer["a"], refer["squared"]], [refer["pull"], refer["mu"]], [2.0, 7.0])
        assert both == pytest.approx([2 / mass, -15], rel=1e-9)
    # nothing has moved
    assert one.get("a") == pytest.approx(0.25 - 0.3 * (8 - 0.5) - 6, rel=1e-12)


def test_rates_of_outputs(slope: Path, mass: float) -> None:
    """y' = v, (v^2)' = 2 v a, and a' by the inputs alone, which are linear in time."""
    one = Instance(slope, "CoSimulation")
    a = 0.1 - 0.3 * 8 - 6
    one.set("pull", 0.1 * mass)
    one.fmu.doStep(0.0, 0.1)
    v = 4 + a * 0.1
    assert one.rates(["along", "squared", "a"]) == pytest.approx([v, 2 * v * a, 0], abs=1e-9)
    if one.version == "3.0":
        return
    one.fmu.setRealInputDerivatives([one.references["pull"]], [1], [3 * mass])
    assert one.rates(["a"]) == pytest.approx([3], rel=1e-9)
    one.fmu.doStep(0.1, 0.1)
    v += a * 0.1 + 1.5 * 0.01
    assert one.get("along") == pytest.approx(4 * 0.2 + a * 0.02 + 0.5 * 0.001, rel=1e-9)
    assert one.rates(["along", "a"]) == pytest.approx([v, 3], rel=1e-9)
    # the input stays where it has come to
    assert one.get("pull") == pytest.approx(0.4 * mass, rel=1e-12)
    one.fmu.doStep(0.2, 0.05)
    assert one.get("a") == pytest.approx(a + 0.3, rel=1e-9)
    assert one.rates(["a"]) == pytest.approx([0], abs=1e-9)


def test_what_has_no_derivatives_is_named(slope: Path, mass: float) -> None:
    one = Instance(slope, "CoSimulation")
    refer = one.references
    for unknowns, knowns in (
        ([refer["pull"]], [refer["pull"]]),
        ([refer["a"]], [refer["along"]]),
        ([refer["a"]], [refer["v0"]]),
        ([refer["a"]], [10_000]),
        ([10_000], [refer["pull"]]),
        ([refer["c.mode"]], [refer["pull"]]),
    ):
        with pytest.raises(FMICallException):
            one.derive(unknowns, knowns, [1.0])
    with pytest.raises(FMICallException):
        one.derive([refer["a"]], [refer["pull"]], [float("nan")])
    name = "getRealOutputDerivatives" if one.version == "2.0" else "getOutputDerivatives"
    with pytest.raises(FMICallException):
        getattr(one.fmu, name)([refer["a"]], [2])
    if one.version == "3.0":
        for unknown, known, seed in (("a", "v0", 1.0), ("pull", "pull", 1.0), ("a", "mu", np.inf)):
            with pytest.raises(FMICallException):
                one.adjoint([refer[unknown]], [refer[known]], [seed])
    # the instance stays usable
    one.fmu.doStep(0.0, 0.1)
    assert one.derive([refer["a"]], [refer["pull"]], [mass]) == pytest.approx([1])


def reference(dae: frot.Dae, x: np.ndarray) -> np.ndarray:
    """The Jacobian of x' in x and the inputs by CasADi, reactions and accelerations eliminated."""
    t, own, z = (ca.SX.sym(n, *dae.ode.size_in(k)) for k, n in enumerate("txz"))
    u, p, mode = (ca.SX.sym(n, *dae.ode.size_in(3 + k)) for k, n in enumerate(("u", "p", "m")))
    places = [t, own, z, u, p, mode]
    ode, alg, known = dae.ode(*places), dae.alg(*places), ca.vertcat(own, u)
    parts = ca.Function(
        "parts",
        places,
        [ca.jacobian(one, by) for by in (known, z) for one in (ode, alg)],
    )
    solved = dae.solve(0, x, dae.u0, dae.p0, [])
    of_x, rest_x, of_z, rest_z = (np.array(m) for m in parts(0, x, solved, dae.u0, dae.p0, []))
    return of_x - of_z @ np.linalg.solve(rest_z, rest_x)


@pytest.mark.parametrize("name", SMOOTH)
def test_the_jacobian_is_that_of_casadi(tmp_path: Path, version: str, name: str) -> None:
    """Model exchange: how the rates of all states change with all states and inputs."""
    model = frot.load(MODELS / f"{name}.frot")
    dae = model.dae()
    path = tmp_path / "m.fmu"
    model.export_fmu(path, version, "native")
    one = Instance(path, "ModelExchange")
    listed = [v.variable for v in one.description.derivatives][:-2]
    rates = [v.valueReference for v in listed]
    inputs = [v.valueReference for v in one.description.modelVariables if v.causality == "input"]
    knowns = [v.derivative.valueReference for v in listed] + inputs
    found = np.array([one.derive(rates, [k], [1.0]) for k in knowns]).T
    expected = reference(dae, one.states()[:-2])
    assert np.abs(found - expected).max() < CLOSE * np.abs(expected).max()
    if version == "3.0":
        seed = np.cos(np.arange(len(rates)))
        sums = one.adjoint(rates, knowns, list(seed))
        assert np.abs(sums - seed @ expected).max() < CLOSE * len(rates) * np.abs(expected).max()
