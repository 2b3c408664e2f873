"""Two FMUs coupled by a spring: with first derivatives the error falls with the square of the step.

A motor with a dry bearing drives a load through a spring. The spring is in the FMU of the load: it
reads the angle of the motor and gives the couple on it. Both make their steps at once (Jacobi), or
one after the other, and no step is repeated.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy import extract, instantiate_fmu, read_model_description

import frot

MOTOR = """planar model Motor
  input Torque load(start = 0 N.m);
  body rotor: disc(mass = 2 kg, radius = 10 cm);
  liaison bearing: rotoide(ground, rotor.G) with coulomb(mu = 0.2, radius = 20 mm);
  force drive: couple(bearing, value = 0.5 N.m*sin(3*time/(1 s)) + load);
  output Angle angle = bearing.angle;
  output AngularVelocity speed = bearing.speed;
initial
  bearing.angle = 0 rad;
  bearing.speed = 0 rad/s;
  experiment(stop = 2 s, tolerance = 1e-11);
end Motor;
"""
LOAD = """planar model Load
  parameter Real k = 3;
  input Angle angle(start = 0 rad);
  body wheel: disc(mass = 1 kg, radius = 10 cm);
  liaison axle: rotoide(ground, wheel.G);
  force spring: couple(axle, value = 0.3 N.m*(angle - axle.angle)/(1 rad));
  output Torque couple = 0.3 N.m*(axle.angle - angle)/(1 rad);
  output Angle turned = axle.angle;
initial
  axle.angle = 0 rad;
  axle.speed = 0 rad/s;
  experiment(stop = 2 s, tolerance = 1e-11);
end Load;
"""
BOTH = """planar model Both
  body rotor: disc(mass = 2 kg, radius = 10 cm);
  body wheel: disc(mass = 1 kg, radius = 10 cm);
  liaison bearing: rotoide(ground, rotor.G) with coulomb(mu = 0.2, radius = 20 mm);
  liaison axle: rotoide(ground, wheel.G);
  force drive: couple(bearing, value = 0.5 N.m*sin(3*time/(1 s)) + 0.3 N.m*behind);
  force spring: couple(axle, value = -0.3 N.m*behind);
  output Real behind = (axle.angle - bearing.angle)/(1 rad);
initial
  bearing.angle = 0 rad;
  bearing.speed = 0 rad/s;
  axle.angle = 0 rad;
  axle.speed = 0 rad/s;
  experiment(stop = 2 s, tolerance = 1e-12);
end Both;
"""
STOP = 2.0
STEPS = (20, 40, 80, 160)
PARTS = ("motor", "load")


@pytest.fixture(scope="module")
def exact() -> tuple[float, float]:
    result = frot.compile(BOTH).simulate()
    # the bearing sticks, slips and turns round
    assert [event.kind for event in result.events] == ["slip", "reversal"]
    return float(result["bearing.angle"][-1]), float(result["axle.angle"][-1])


@pytest.fixture(scope="module")
def archives(tmp_path_factory: pytest.TempPathFactory) -> dict[tuple[str, str], Path]:
    folder = tmp_path_factory.mktemp("coupled")
    found = {}
    for name, text in (("motor", MOTOR), ("load", LOAD)):
        model = frot.compile(text)
        for version in ("2.0", "3.0"):
            found[name, version] = folder / f"{name}{version[0]}.fmu"
            model.export_fmu(found[name, version], version, "native")
    return found


class Part:
    """An instance ready for its first step."""

    def __init__(self, path: Path, **options: Any) -> None:
        description = read_model_description(str(path))
        self.references = {v.name: v.valueReference for v in description.modelVariables}
        self.fmu = instantiate_fmu(extract(str(path)), description, "CoSimulation", **options)
        if description.fmiVersion == "2.0":
            self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def close(self) -> None:
        self.fmu.terminate()
        self.fmu.freeInstance()


def couple_2(archives: dict[tuple[str, str], Path], n: int, order: int) -> tuple[float, float]:
    """Jacobi's scheme, FMI 2.0, with inputs of order 0 or 1."""
    motor, load = Part(archives["motor", "2.0"]), Part(archives["load", "2.0"])
    a, b = motor.references, load.references
    h = STOP / n
    for k in range(n):
        (angle,), (couple,) = (
            motor.fmu.getReal([a["angle"]]),
            load.fmu.getReal([b["couple"]]),
        )
        rates = motor.fmu.getRealOutputDerivatives([a["angle"]], [1])[0], 0.0
        load.fmu.setReal([b["angle"]], [angle])
        if order:
            load.fmu.setRealInputDerivatives([b["angle"]], [1], [rates[0]])
        (couple,) = load.fmu.getReal([b["couple"]])
        motor.fmu.setReal([a["load"]], [couple])
        if order:
            rate = load.fmu.getRealOutputDerivatives([b["couple"]], [1])[0]
            motor.fmu.setRealInputDerivatives([a["load"]], [1], [rate])
        motor.fmu.doStep(k * h, h)
        load.fmu.doStep(k * h, h)
    found = motor.fmu.getReal([a["angle"]])[0], load.fmu.getReal([b["turned"]])[0]
    motor.close()
    load.close()
    return found


def test_first_derivatives_give_order_two(
    archives: dict[tuple[str, str], Path], exact: tuple[float, float]
) -> None:
    """Constant inputs: order one. Linear ones: order two, and far smaller errors."""
    table = {
        order: [max(np.abs(np.subtract(couple_2(archives, n, order), exact))) for n in STEPS]
        for order in (0, 1)
    }
    constant, linear = np.array(table[0]), np.array(table[1])
    ratios = linear[:-1] / linear[1:]
    assert ratios.min() > 3
    assert (constant[:-1] / constant[1:]).max() < 3
    assert (linear < 0.1 * constant).all()
    # as docs/fmu.md shows them
    assert linear == pytest.approx([0.550, 0.132, 0.0327, 0.00814], rel=0.01)


def couple_3(archives: dict[tuple[str, str], Path], n: int) -> tuple[float, float]:
    """Jacobi's scheme, FMI 3.0: in intermediate updates inputs are extrapolated linearly."""
    coming: dict[str, tuple[float, float, float]] = {}

    def giver(name: str, reference: int) -> Callable[..., None]:
        def update(_env: Any, time: float, asks: bool, *_others: Any) -> None:
            if asks:
                begin, value, rate = coming[name]
                parts[name].fmu.setFloat64([reference], [value + rate * (time - begin)])

        return update

    parts: dict[str, Part] = {}
    references = {
        name: {
            v.name: v.valueReference
            for v in read_model_description(str(archives[name, "3.0"])).modelVariables
        }
        for name in ("motor", "load")
    }
    reads, gives = {"motor": "load", "load": "angle"}, {"motor": "angle", "load": "couple"}
    other = {"motor": "load", "load": "motor"}
    for name in PARTS:
        required = references[name][reads[name]]
        parts[name] = Part(
            archives[name, "3.0"],
            required_intermediate_variables=[required],
            intermediate_update=giver(name, required),
        )
    h = STOP / n
    for k in range(n):
        for name in PARTS:
            source = parts[other[name]]
            reference = source.references[gives[other[name]]]
            (value,) = source.fmu.getFloat64([reference])
            rate = source.fmu.getOutputDerivatives([reference], [1])[0]
            coming[name] = k * h, value, rate
        for name in PARTS:
            parts[name].fmu.doStep(k * h, h)
    found = (
        parts["motor"].fmu.getFloat64([references["motor"]["angle"]])[0],
        parts["load"].fmu.getFloat64([references["load"]["turned"]])[0],
    )
    for part in parts.values():
        part.close()
    return found


def test_intermediate_updates_give_order_two(
    archives: dict[tuple[str, str], Path], exact: tuple[float, float]
) -> None:
    """The same in FMI 3.0, whose inputs have no derivatives."""
    errors = np.array([max(np.abs(np.subtract(couple_3(archives, n), exact))) for n in STEPS])
    assert (errors[:-1] / errors[1:]).min() > 3
    assert errors == pytest.approx([3.05, 0.652, 0.158, 0.0392], rel=0.01)
