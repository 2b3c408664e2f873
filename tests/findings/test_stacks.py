"""Boxes on boxes: the load of each is shared in many ways, and one that is pushed slips."""

from __future__ import annotations

import functools

import pytest

import frot

BOXES, MU, G = 5, 0.5, 9.81


@functools.cache
def stack() -> frot.Model:
    lines = ["planar model Stack", "  parameter Mass m = 1 kg;"]
    below = "ground.line"
    for i in range(BOXES):
        lines += [
            f"  parameter Real push{i} = 0;",
            f"  body b{i}: box(mass = m, size = (1, 0.5) m);",
            f"  liaison c{i}: appui_faces(b{i}.bottom, {below}) with coulomb({MU});",
            f"  force f{i}: on(b{i}, value = (push{i}*m*time*1 m/s^3, 0 N));",
        ]
        below = f"b{i}.top"
    lines += ["initial"]
    lines += [f"  b{i}.position = (0, {0.25 + 0.5 * i}) m; b{i}.angle = 0;" for i in range(BOXES)]
    lines += ["  experiment(stop = 0.9 s, tolerance = 1e-8);", "end Stack;"]
    return frot.compile("\n".join(lines))


@pytest.mark.parametrize("pushed", [4, 3, 1, 0])
@pytest.mark.parametrize(("m", "way"), [(1.0, 1), (1e-6, -1), (1e6, 1)])
def test_what_is_pushed_slips_with_what_it_carries(pushed: int, m: float, way: int) -> None:
    """At P = mu (n - k) m g all corners of the face below let go at one instant, where no reaction
    is told by the others; then P - mu (n - k) m g moves n - k boxes.

    Corners that lie at the ends of faces stay there to rounding while both move."""
    result = stack().simulate(parameters={f"push{pushed}": way * 8.0 * (BOXES - pushed), "m": m})
    slips = [e for e in result.events if e.kind == "slip"]
    corners = range(1, 5 if pushed > 0 else 3)
    assert {e.liaison for e in slips} == {f"c{pushed}[{k}]" for k in corners}
    assert [e.time for e in slips] == pytest.approx([MU * G / 8] * len(slips), rel=1e-9)
    assert {e.liaison.split("[")[0] for e in result.events} == {f"c{pushed}"}
    at = result.at(0.9)
    gone = way * 8 * (0.9 - MU * G / 8) ** 3 / 6
    for i in range(BOXES):
        x = at[f"b{i}.position.x"]
        assert x == pytest.approx(gone if i >= pushed else 0.0, rel=1e-6, abs=1e-20)
        told = [at[f"c{i}[{k}].normal_force"] for k in range(1, 5 if i > 0 else 3)]
        assert sum(told) == pytest.approx(m * G * (BOXES - i), rel=1e-9)
