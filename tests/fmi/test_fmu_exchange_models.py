"""Model exchange over all worked models: FMPy's CVODE converges to the motion of `simulate`."""

from __future__ import annotations

import ctypes
from pathlib import Path

import numpy as np
import pytest
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi2 import FMU2Model
from frot.runtime.fmi.check_exchange import NEAR, NOMINAL, followed

import frot

MODELS = Path(__file__).parents[2] / "models"
# A motion may amplify the errors of steps and events, in three seconds of a fast crank by 1e5.
AMPLIFIED = 1e5
# What a hundred times smaller tolerance leaves of an error at most, above the noise of small ones.
FASTER, NOISE = 0.2, 1e-8
# With CVODE at 1e-6 the creepage of the rails takes more steps than FMPy allows. Of 0.3 s of a
# uniform turn it makes an error of up to 1e-7 at any tolerance, also of `x' = -y, y' = x`.
OTHER = {
    "wheelset": (1e-7, 1e-9),
    "two_points_on_an_axis": (1e-5, 1e-7),
}
# Impacts that accumulate: the last ones are lower than what the other integrator tells from rest.
ACCUMULATE = ("bouncing_ball", "ball_with_spin", "rocking_block")
# Conditions of its text say where friction is bounded: on the way they may change forth and back.
FLICKERS = ("wheelset",)


def runnable() -> list[str]:
    """Names of the files that hold a model: those of packages are capitalized."""
    return sorted(path.stem for path in MODELS.glob("*.frot") if path.stem[0].islower())


@pytest.mark.parametrize("name", runnable())
def test_a_worked_model_converges(tmp_path: Path, name: str) -> None:
    """Other steps, the same events: errors follow the tolerance of the other integrator."""
    model = frot.load(MODELS / f"{name}.frot")
    program = model.program()
    if not program.exchanges:
        pytest.skip("not offered for model exchange")
    path = tmp_path / "m.fmu"
    model.export_fmu(path, "2.0", "native")
    begin, end = program.experiment.times()
    expected = model.simulate(tolerance=1e-10)
    names = followed(program)
    assert names
    coarse, fine = OTHER.get(name, (1e-6, 1e-8))
    errors = []
    for tolerance in (coarse, fine):
        told: list[bytes] = []
        got = simulate_fmu(
            str(path),
            fmi_type="ModelExchange",
            start_time=begin,
            stop_time=end,
            relative_tolerance=tolerance,
            output=list(names),
            output_interval=(end - begin) / 200,
            record_events=False,
            debug_logging=True,
            logger=lambda *message, told=told: told.append(message[-1]),
        )
        time = np.asarray(got["time"])
        assert time[-1] == pytest.approx(end)
        other = expected.at(time)
        clear = np.ones(len(time), dtype=bool)
        for event in expected.events:
            clear &= np.abs(time - event.time) > NEAR * (end - begin)
        largest = 0.0
        for own, plain in names.items():
            size = max(float(np.abs(other[plain]).max()), NOMINAL)
            largest = max(largest, float(np.abs(got[own] - other[plain])[clear].max()) / size)
        errors.append(largest)
    assert errors[1] < AMPLIFIED * fine
    assert errors[1] < FASTER * errors[0] + NOISE
    if name in ACCUMULATE:
        assert 10 < len(told) <= len(expected.events)
    elif name not in FLICKERS:
        assert len(told) == len(expected.events)


def test_rates_of_a_closed_loop_are_exact_to_the_fourth_power_of_a_step(tmp_path: Path) -> None:
    """Two rough points on an axis by Runge's and Kutta's method: the body turns at 3 rad/s exactly.

    The error of the angle falls with the fourth power of the step, until rounding.
    """
    model = frot.load(MODELS / "two_points_on_an_axis.frot")
    model.export_fmu(tmp_path / "m.fmu", "2.0", "native")
    description = read_model_description(tmp_path / "m.fmu")
    folder = extract(tmp_path / "m.fmu", unzipdir=tmp_path / "fmu")
    errors = []
    for steps in (10, 20, 40):
        fmu = FMU2Model(
            guid=description.guid,
            unzipDirectory=folder,
            modelIdentifier=description.modelExchange.modelIdentifier,
            instanceName="fmu",
        )
        fmu.instantiate()
        fmu.setupExperiment(tolerance=1e-6, startTime=0.0)
        fmu.enterInitializationMode()
        fmu.exitInitializationMode()
        fmu.newDiscreteStates()
        fmu.enterContinuousTimeMode()
        h, n = 0.3 / steps, description.numberOfContinuousStates
        values = (ctypes.c_double * n)()
        fmu.getContinuousStates(values, n)
        x = np.array(values)

        def rate(t: float, x: np.ndarray, fmu: FMU2Model = fmu, n: int = n) -> np.ndarray:
            fmu.setTime(t)
            fmu.setContinuousStates((ctypes.c_double * n)(*x), n)
            found = (ctypes.c_double * n)()
            fmu.getDerivatives(found, n)
            return np.array(found)

        for t in h * np.arange(steps):
            a = rate(t, x)
            b = rate(t + h / 2, x + h / 2 * a)
            c = rate(t + h / 2, x + h / 2 * b)
            d = rate(t + h, x + h * c)
            x = x + h / 6 * (a + 2 * b + 2 * c + d)
        fmu.terminate()
        fmu.freeInstance()
        turned = 2 * np.arctan2(np.linalg.norm(x[2:5]), x[1])
        errors.append(abs(turned - 0.9))
    assert errors[0] < 1e-6
    assert errors[1] < errors[0] / 12 and errors[2] < errors[1] / 12
