"""A box slides over the edge of another: its face rests on the corner there, without a blow."""

from __future__ import annotations

import math

import pytest

import frot

TEXT = """
planar model Edge
  parameter Real mu = 0;
  parameter Real foot = 1;
  parameter Velocity v = 3 m/s;
  parameter Length size = 1 m;
  body table: box(mass = 1 kg, size = (4*size, size));
  body load: box(mass = 1 kg, size = (size, size));
  liaison feet: appui_faces(table.bottom, ground.line) with coulomb(foot);
  liaison on: appui_faces(load.bottom, table.top) with coulomb(mu);
initial
  table.position = (0 m, size/2);
  load.position = (0 m, 1.5*size);
  load.velocity = (v, 0 m/s);
end Edge;
"""
G = 9.81


@pytest.fixture(scope="module")
def model() -> frot.Model:
    return frot.compile(TEXT)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9, 1e-12])
@pytest.mark.parametrize(
    ("v", "mu", "size"),
    [(3, 0, 1), (-3, 0, 1), (4.1, 0.1, 1), (-4.1, 0.1, 1), (3.3, 0.001, 1), (0.03, 0, 1e-4)],
)
def test_the_corner_takes_over_where_the_face_comes_to_it(
    model: frot.Model, v: float, mu: float, size: float, tolerance: float
) -> None:
    """The front is at the edge after 1.5 sizes; it tips where weight and friction pass there."""
    result = model.simulate(
        stop=2.2 * size / abs(v) / (1 - 2.2 * mu * G * size / v**2),
        tolerance=tolerance,
        parameters={"v": v, "mu": mu, "size": size},
    )

    def after(way: float) -> float:
        brake = mu * G
        return way / abs(v) if mu == 0 else (abs(v) - math.sqrt(v * v - 2 * brake * way)) / brake

    corner, front, rear = ("on[3]", "on[2]", "on[1]") if v > 0 else ("on[4]", "on[1]", "on[2]")
    kept = [(e.liaison, e.after) for e in result.events]
    assert sorted(kept[:2]) == sorted([(corner, "slip"), (front, "open")])
    assert kept[2] == (rear, "open")
    times = [e.time for e in result.events]
    near = 1e-9 * result.time[-1]
    assert times[:2] == pytest.approx([after(1.5 * size)] * 2, abs=near)
    assert times[2] == pytest.approx(after((2 - mu / 2) * size), abs=near)
    assert len(kept) == 3
