"""Array parameters are set as a whole or item by item, and nothing is compiled for it."""

from pathlib import Path
from zipfile import ZipFile

import numpy as np
import pytest
from scipy.linalg import expm

import frot

ARRAYS = """
model Arrays
  parameter Integer n = 2;
  parameter Real A[n, n](unit = "1/s") = ((-1, 0.5), (0.5, -2));
  parameter Length l[3] = (1, 2, 3) mm;
  parameter Length twice[3] = 2*l;
  parameter Boolean on[2] = (true, false);
  parameter String name = "arrays";
  input Real u[2](start = (0, 1));
  Real x[n](start = (1, 1));
  output Length s = sum(twice);
  output Real chosen = if on[2] then 1 else 0;
  output Real both = u[1] + 10*u[2];
equation
  der(x) = A*x;
  experiment(stop = 1 s, tolerance = 1e-10);
end Arrays;
"""


@pytest.fixture(scope="module")
def model() -> frot.Model:
    return frot.compile(ARRAYS)


def exact(a: list[list[float]]) -> np.ndarray:
    return expm(np.array(a)) @ np.ones(2)


DEFAULT = [[-1, 0.5], [0.5, -2]]


@pytest.mark.parametrize(
    ("given", "matrix"),
    [
        ({}, DEFAULT),
        ({"A[1,2]": 0.25}, [[-1, 0.25], [0.5, -2]]),
        ({"A[1, 2]": "15 1/min"}, [[-1, 0.25], [0.5, -2]]),
        ({"A": [[-3, 0], [1, 0]]}, [[-3, 0], [1, 0]]),
        ({"A": np.array([[-3, 0], [1, 0]])}, [[-3, 0], [1, 0]]),
        ({"A": "((-3, 0), (1, 0))"}, [[-3, 0], [1, 0]]),
        ({"A": "{{-3, 0}, {1, 0}} 1/s"}, [[-3, 0], [1, 0]]),
        ({"A[2,1]": 1, "A": 0}, [[0, 0], [1, 0]]),
    ],
)
def test_a_matrix_is_set_as_a_whole_or_by_items(
    model: frot.Model, given: dict[str, object], matrix: list[list[float]]
) -> None:
    result = model.simulate(parameters=given)
    found = [result["x[1]"][-1], result["x[2]"][-1]]
    assert found == pytest.approx(exact(matrix), rel=1e-8)


@pytest.mark.parametrize(
    ("given", "total"),
    [
        ({}, 0.012),
        ({"l[2]": "5 mm"}, 0.018),
        ({"l": "(1, 1, 1) mm"}, 0.006),
        ({"l": "{1 mm, 1 cm, 1 m}"}, 2.022),
        ({"l": [1, "1 cm", 0]}, 2.02),
        ({"l": 0.5}, 3.0),
        ({"twice[3]": 1}, 1.006),
    ],
)
def test_what_follows_from_an_array_follows_what_is_set(
    model: frot.Model, given: dict[str, object], total: float
) -> None:
    assert model.simulate(parameters=given)["s"][0] == pytest.approx(total, rel=1e-14)


def test_arrays_of_conditions_and_inputs_are_set(model: frot.Model) -> None:
    result = model.simulate(parameters={"on": [False, True]}, inputs={"u[1]": 3, "u[2]": 0})
    assert (result["chosen"][0], result["both"][0]) == (1, 3)
    assert model.simulate(inputs={"u": (1, 2)})["both"][0] == 21


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"l": [1, 2]}, "2 items, expected 3"),
        ({"A": [[1, 2, 3], [1, 2, 3]]}, "2x3 items, expected 2x2"),
        ({"A": [[1, 2], [3]]}, "expected 2x2"),
        ({"l": "(1, 2, x)"}, r"'l\[1\]'"),
        ({"l[4]": 1}, r"no parameter 'l\[4\]'"),
        ({"n": 3}, "decides"),
        ({"on": [1, 2]}, "not true or false"),
        ({"l": "1, 2, 3"}, "bad value"),
    ],
)
def test_a_bad_array_is_told(model: frot.Model, given: dict[str, object], words: str) -> None:
    with pytest.raises(frot.FrotError, match=words) as told:
        model.simulate(parameters=given)
    assert told.value.diagnostics[0].help


def test_an_fmu_has_the_items_as_parameters(model: frot.Model, tmp_path: Path) -> None:
    for fmi in ("2.0", "3.0"):
        model.export_fmu(tmp_path / "a.fmu", fmi, "native")
        with ZipFile(tmp_path / "a.fmu") as archive:
            described = archive.read("modelDescription.xml").decode()
        assert 'variableNamingConvention="structured"' in described
        for name in ("l[1]", "A[2,1]", "on[2]", "u[1]"):
            assert f'name="{name}"' in described


def test_parameters_without_names_and_times_with_units(model: frot.Model) -> None:
    with pytest.raises(frot.FrotError, match="not by their names"):
        model.simulate(parameters=[1, 2])  # type: ignore[arg-type]
    assert model.simulate(stop="200 ms").time[-1] == pytest.approx(0.2)
    assert len(model.simulate(stop="1 s", interval="500 ms").time) == 3
    for bad in ({"stop": "2 kg"}, {"stop": [1]}, {"tolerance": "small"}, {"interval": "often"}):
        with pytest.raises(frot.FrotError, match=f"bad value of '{next(iter(bad))}'") as told:
            model.simulate(**bad)  # type: ignore[arg-type]
        assert told.value.diagnostics[0].help
