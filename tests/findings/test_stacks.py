"""Boxes on boxes: the load of each is shared in many ways, and one that is pushed slips."""

from __future__ import annotations

import functools

import numpy as np
import pytest

import frot

BOXES, MU, G = 8, 0.5, 9.81


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
    lines += ["  experiment(stop = 1 s, tolerance = 1e-8);", "end Stack;"]
    return frot.compile("\n".join(lines))


@pytest.mark.parametrize("m", [1.0, 1e-6, 1e6])
@pytest.mark.parametrize("way", [1, -1])
def test_the_uppermost_slips_by_itself(m: float, way: int) -> None:
    """At P = mu m g all corners of its face let go at one instant, where the reactions of none of
    the others are told; then P - mu m g moves it alone."""
    top = BOXES - 1
    result = stack().simulate(parameters={f"push{top}": way * 8.0, "m": m})
    slips = [e for e in result.events if e.kind == "slip"]
    assert {e.liaison for e in slips} == {f"c{top}[{k}]" for k in range(1, 5)}
    assert [e.time for e in slips] == pytest.approx([MU * G / 8] * 4, rel=1e-9)
    assert {e.liaison.split("[")[0] for e in result.events} == {f"c{top}"}
    at = result.at(1.0)
    gone = way * 8 * (1 - MU * G / 8) ** 3 / 6
    assert at[f"b{top}.position.x"] == pytest.approx(gone, rel=1e-6)
    pressed = [
        sum(at[f"c{i}[{k}].normal_force"] for k in range(1, 5 if i > 0 else 3))
        for i in range(BOXES)
    ]
    assert np.array(pressed) == pytest.approx(m * G * np.arange(BOXES, 0, -1), rel=1e-9)
    for i in range(top):
        assert abs(at[f"b{i}.velocity.x"]) < 1e-30
