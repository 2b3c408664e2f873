"""Arrays of FMI 3.0: vectors and matrices of the text as single variables."""

from __future__ import annotations

import ctypes
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy import extract, instantiate_fmu, read_model_description, simulate_fmu
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu
from fmu_host import ERROR, OK, Host, unpack_library
from frot.runtime.fmi.arrays import grouped
from frot.runtime.fmi.scalars import scalars

import frot

# m a = push + weight; what is turned has a full matrix of inertia.
TEXT = """model Vectors
  parameter Length p[3] = (0, 0, 1) m;
  parameter Inertia I[3,3] = ((1, 0, 0), (0, 2, 0), (0, 0, 3)) kg.m^2;
  parameter Real k[2] = (2, 3);
  parameter Boolean on[2] = (true, false);
  input Force push[3](start = (1, 2, 3) N);
  world(gravity = 10 m/s^2);
  body b: particle(mass = 4 kg);
  body c: solid(mass = 1 kg, inertia = I);
  force f: on(b, value = (push[1], push[2], push[3]));
  output Acceleration a[3] = b.acceleration;
  output Length where[3] = b.position;
initial
  b.position = p;
  b.velocity = (0, 0, 0) m/s;
  c.position = (0, 0, 0) m;
  c.orientation = (1, 0, 0, 0);
  c.velocity = (0, 0, 0) m/s;
  c.angular_velocity = (0.1, 2, 0.2) rad/s;
  experiment(stop = 1 s);
end Vectors;
"""


@pytest.fixture(scope="module")
def model() -> frot.Model:
    return frot.compile(TEXT)


@pytest.fixture(scope="module")
def path(model: frot.Model, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("arrays") / "v.fmu"
    model.export_fmu(path, "3.0", "native", arrays=True)
    return path


class Instance:
    """One for co-simulation that is ready for steps, called by FMPy."""

    def __init__(self, path: Path, **options: Any) -> None:
        self.description = read_model_description(str(path))
        self.fmu: Any = instantiate_fmu(
            extract(str(path)), self.description, "CoSimulation", **options
        )
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()
        self.references = {v.name: v.valueReference for v in self.description.modelVariables}

    def get(self, *names: str, count: int) -> list[float]:
        return list(self.fmu.getFloat64([self.references[n] for n in names], count))

    def derive(self, way: str, of: list[str], by: list[str], seed: list[float], n: int) -> Any:
        answer = (ctypes.c_double * n)()
        lists = [(ctypes.c_uint32 * len(x))(*(self.references[one] for one in x)) for x in (of, by)]
        getattr(self.fmu, f"fmi3Get{way}Derivative")(
            self.fmu.component, lists[0], len(of), lists[1], len(by),
            (ctypes.c_double * len(seed))(*seed), len(seed), answer, n,
        )  # fmt: skip
        return list(answer)


def test_vectors_and_matrices_are_variables_with_dimensions(path: Path) -> None:
    assert not validate_fmu(str(path))
    variables = {v.name: v for v in read_model_description(str(path)).modelVariables}
    shapes = {name: [int(d.start) for d in v.dimensions] for name, v in variables.items()}
    assert shapes["p"] == [3] and shapes["I"] == [3, 3] and shapes["k"] == [2]
    assert shapes["push"] == shapes["where"] == shapes["b.position"] == [3]
    assert shapes["c.orientation"] == [4]
    # FMPy reads no start values of others than real numbers
    assert shapes["on[1]"] == shapes["on[2]"] == []
    assert shapes["energy.kinetic"] == shapes["time"] == []
    assert variables["I"].start == "1.0 0.0 0.0 0.0 2.0 0.0 0.0 0.0 3.0"
    assert variables["push"].start == "1.0 2.0 3.0"
    assert not any(name.endswith(".x") for name in variables)


def test_what_is_no_full_array_stays_apart(model: frot.Model) -> None:
    """Integrals of several units, a lonely index; no element is lost or named twice."""
    _, variables = scalars(model.program())
    groups = grouped(variables, arrays=True)
    assert [v for one in groups for v in one.elements] == list(variables)
    names = [one.name for one in groups]
    assert len(set(names)) == len(names)
    assert "first_integrals[1]" in names and "exchange.state[1]" in names
    assert grouped(variables, arrays=False) == tuple(
        type(groups[0])(v.name, (v,)) for v in variables
    )
    fewer = [v for v in variables if v.plain != "push[2]"]
    assert {"push[1]", "push[3]"} <= {one.name for one in grouped(fewer, arrays=True)}


def test_arrays_are_read_and_set_whole(path: Path) -> None:
    one = Instance(path)
    push, where = one.references["push"], one.references["where"]
    assert one.get("push", "a", count=6) == [1, 2, 3, 0.25, 0.5, 0.75 - 10]
    one.fmu.setFloat64([push], [4.0, 8.0, 40.0])
    assert one.get("a", "time", "p", count=7) == [1, 2, 0, 0, 0, 0, 1]
    one.fmu.doStep(0.0, 1.0)
    assert one.get("where", count=3) == pytest.approx([0.5, 1, 1], rel=1e-9)
    for references, count in (([push], 1), ([push + 1], 1), ([push, where], 3), ([10**6], 1)):
        with pytest.raises(FMICallException):
            one.fmu.getFloat64(references, count)
    with pytest.raises(FMICallException):
        one.fmu.setFloat64([push], [1.0])
    with pytest.raises(FMICallException):
        one.fmu.setFloat64([push + 2], [1.0])
    # nothing was set in part
    assert one.get("push", count=3) == [4, 8, 40]


def test_derivatives_have_a_number_for_each_element(path: Path) -> None:
    """da/dpush = 1/m in each direction; the adjoint is the transpose."""
    one = Instance(path)
    found = one.derive("Directional", ["a", "where"], ["push"], [4.0, 8.0, 12.0], 6)
    assert found == pytest.approx([1, 2, 3, 0, 0, 0], abs=1e-9)
    found = one.derive("Adjoint", ["a"], ["push", "time"], [4.0, 8.0, 12.0], 4)
    assert found == pytest.approx([1, 2, 3, 0], abs=1e-9)
    one.fmu.doStep(0.0, 0.5)
    rates = (ctypes.c_double * 4)()
    references = (ctypes.c_uint32 * 2)(one.references["where"], one.references["energy.kinetic"])
    orders = (ctypes.c_int32 * 2)(1, 1)
    one.fmu.fmi3GetOutputDerivatives(one.fmu.component, references, 2, orders, rates, 4)
    speed = np.array([0.125, 0.25, -4.625])
    power = speed @ [1, 2, 3 - 40] + 100 * 0.5  # of the solid too, which falls
    assert list(rates) == pytest.approx([*speed, power], rel=1e-8)
    with pytest.raises(FMICallException):
        one.derive("Adjoint", ["a"], ["push"], [1.0], 3)


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_a_run_gives_the_vectors_of_simulate(path: Path, model: frot.Model, kind: str) -> None:
    got: Any = simulate_fmu(
        str(path), fmi_type=kind, stop_time=1.0, output=["b.position", "c.angular_velocity"],
        output_interval=0.1, relative_tolerance=1e-9, start_values={"push": [3.0, 2.0, 1.0]},
    )  # fmt: skip
    expected = model.simulate(inputs={"push[1]": 3.0, "push[3]": 1.0}, tolerance=1e-11)
    other = expected.at(np.asarray(got["time"]))
    for name in ("b.position", "c.angular_velocity"):
        for k, letter in enumerate("xyz"):
            assert got[name][:, k] == pytest.approx(other[f"{name}.{letter}"], abs=1e-6)


def test_inputs_inside_a_step_are_arrays_too(path: Path, model: frot.Model, tmp_path: Path) -> None:
    """A force that grows linearly in a step: 4 t N on 4 kg go t^3/6. An element is refused."""
    variables = read_model_description(str(path)).modelVariables
    references = {v.name: v.valueReference for v in variables}
    library = unpack_library(path, "3.0", tmp_path)
    token = model.program().key.encode()
    asked: list[int] = []

    def put(x: float) -> int:
        reference, values = (ctypes.c_uint32 * 1)(references["push"]), (ctypes.c_double * 3)(x)
        sizes = ctypes.c_size_t(1), ctypes.c_size_t(3)
        return one.call("SetFloat64", reference, sizes[0], values, sizes[1])

    def update(_: Any, t: float, asks: bool, *_more: Any) -> None:
        if asks:
            asked.append(put(4 * t))

    one = Host(library, 3, token=token, update=update, required=[references["push"]])
    assert one.setup() == OK and put(0.0) == OK
    assert one.call("ExitInitializationMode") == OK
    assert one.step(0.0, 1.0) == OK
    assert asked == 8 * [OK]
    # the first of the elements cannot be read alone
    status, _ = one.try_get(references["where"])
    assert status == ERROR and "3 numbers" in one.last
    x = (ctypes.c_double * 3)()
    reference = (ctypes.c_uint32 * 1)(references["where"])
    assert one.call("GetFloat64", reference, ctypes.c_size_t(1), x, ctypes.c_size_t(3)) == OK
    assert x[0] == pytest.approx(1 / 6, rel=1e-8)
    one.free()
    refused = Host(library, 3, token=token, update=update, required=[references["push"] + 1])
    assert refused.instance is None and "element of an array" in refused.last


def test_an_fmu_with_arrays_is_checked(path: Path, model: frot.Model) -> None:
    checked = model.check_fmu(path)
    assert checked.good and checked.apart == 0.0
    other = frot.compile(TEXT.replace("(0.1, 2, 0.2)", "(0.1, 2, 0.3)")).check_fmu(path)
    assert not other.good


def test_elements_depend_on_elements(path: Path) -> None:
    """m a = push + weight: each component on its own force; a place is a state of its own.

    The description names whole variables alone.
    """
    one = Instance(path)
    of = one.references

    def call(name: str, *arguments: Any) -> int:
        function = getattr(one.fmu.dll, f"fmi3Get{name}")
        return int(function(ctypes.c_void_p(one.fmu.component), *arguments))

    def listed(name: str) -> set[tuple[int, int, int, int]]:
        size = ctypes.c_size_t()
        assert call("NumberOfVariableDependencies", of[name], ctypes.byref(size)) == OK
        n = size.value
        own, other, kind = (ctypes.c_size_t * n)(), (ctypes.c_size_t * n)(), (ctypes.c_int * n)()
        who = (ctypes.c_uint32 * n)()
        rest = (of[name], own, who, other, kind)
        assert call("VariableDependencies", *rest, ctypes.c_size_t(n)) == OK
        assert call("VariableDependencies", *rest, ctypes.c_size_t(n + 1)) == ERROR
        return set(zip(own, who, other, kind, strict=True))

    dependent = 5  # fmi3Dependent
    assert listed("a") == {(k, of["push"], k, dependent) for k in (1, 2, 3)}
    assert listed("where") == {(k, of[f"exchange.state[{k}]"], 1, dependent) for k in (1, 2, 3)}
    assert listed("p") == set()
    [output] = [x for x in one.description.outputs if x.variable.name == "a"]
    assert [v.name for v in output.dependencies] == ["push"]
    assert call("NumberOfVariableDependencies", of["push"] + 1, None) == ERROR
    assert call("NumberOfVariableDependencies", 10**6, None) == ERROR


def test_fmi_2_has_none(model: frot.Model, tmp_path: Path) -> None:
    with pytest.raises(frot.FrotError, match=r"E0806.*no arrays"):
        model.export_fmu(tmp_path / "a.fmu", "2.0", "native", arrays=True)
    assert not list(tmp_path.iterdir())
