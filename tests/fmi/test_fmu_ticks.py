"""A sampled value is seen at the communication point of its tick, as in `simulate`."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from fmu_host import OK, Host, unpack_library

import frot

PERIOD, COUNT = 0.1, 1000
TEXT = """
model Ticks
  Integer k(start = 0);
  Real held(start = 0), x;
initial
  x = 1;
equation
  der(x) = -0.1*x/(1 s);
  when sample(0.1 s, 0.1 s) then
    k = pre(k) + 1;
    held = x;
  end when;
  experiment(stop = 100 s);
end Ticks;
"""


@pytest.fixture(scope="module", params=["2.0", "3.0"])
def instance(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory):
    model = frot.compile(TEXT)
    folder = tmp_path_factory.mktemp("ticks")
    model.export_fmu(folder / "ticks.fmu", request.param, "native")
    library = unpack_library(folder / "ticks.fmu", request.param, folder)
    names = [v.name for v in model.program().variables]
    first = 1 + len(model.program().parameters)
    reference = {name: first + k for k, name in enumerate(names)}
    key = model.program().key.encode()

    def make() -> tuple[Host, dict[str, int]]:
        return Host(library, int(request.param[0]), token=key), reference

    return model, make


def summed() -> list[float]:
    points = [0.0]
    for _ in range(COUNT):
        points.append(points[-1] + PERIOD)
    return points


POINTS: dict[str, Callable[[], list[float]]] = {
    "summed": summed,
    "multiplied": lambda: [k * PERIOD for k in range(COUNT + 1)],
    "divided": lambda: [k / 10 for k in range(COUNT + 1)],
}


@pytest.mark.parametrize("way", POINTS)
def test_each_value_is_seen_at_its_own_point(instance, way: str) -> None:
    model, make = instance
    points = POINTS[way]()
    host, reference = make()
    result = model.simulate(tolerance=1e-8, interval=PERIOD)
    held = result["held"]
    try:
        host.start()
        for k in range(1, COUNT + 1):
            step = PERIOD if way == "summed" else points[k] - points[k - 1]
            assert host.step(points[k - 1], step) == OK
            assert host.get(reference["k"], "Integer" if host.version == 2 else "Int32") == k
            assert host.get(reference["held"]) == held[k]
    finally:
        host.free()


def test_simulate_sees_each_tick_on_its_grid(instance) -> None:
    model, _ = instance
    for stop in (0.3, 0.7, 1.0, 100.0):
        result = model.simulate(stop=stop, interval=PERIOD)
        assert list(result["k"]) == list(range(round(stop / PERIOD) + 1))
        assert len(result.events) == round(stop / PERIOD)


def test_the_library_shows_the_functions_of_fmi_alone(instance) -> None:
    """Kernels of other versions may be in the same process."""
    _, make = instance
    host, _ = make()
    seen = "fmi2DoStep" if host.version == 2 else "fmi3DoStep"
    assert hasattr(host.library, seen)
    assert not any(hasattr(host.library, name) for name in ("frot_advance", "frot_the_model"))
    host.free()
