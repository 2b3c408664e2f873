"""Boxes on boxes: the load of each is shared in many ways, and what is pushed slips or tips."""

from __future__ import annotations

import functools

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding

BOXES, MU, G = 5, 0.5, 9.81


@functools.cache
def stack() -> frot.Model:
    lines = ["planar model Stack", "  parameter Mass m = 1 kg;", "  parameter Length wide = 1 m;"]
    below = "ground.line"
    for i in range(BOXES):
        lines += [
            f"  parameter Real push{i} = 0;",
            f"  body b{i}: box(mass = m, size = (wide, 0.5 m));",
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
def test_a_pushed_box_slips_with_its_load(pushed: int, m: float, way: int) -> None:
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


@pytest.mark.parametrize(("pushed", "growth"), [(2, 30.0), (1, 40.0)])
@pytest.mark.parametrize("way", [1, -1])
def test_a_narrow_stack_tips_and_slips_as_it_turns(pushed: int, growth: float, way: int) -> None:
    """It tips when P (1/4 + k/2) = n m g wide/2; then boxes slip on each other while all of them
    turn. Newton's law holds for each of them, whatever share of a load a corner has."""
    wide = 0.5
    given = {f"push{pushed}": way * growth, "wide": wide}
    try:
        result = stack().simulate(parameters=given, stop=0.9)
    except frot.SimulationError as end:
        assert "E0901" in str(end), end  # after a corner has fallen back: docs/limits.md
        result = end.result
    tips = BOXES * G * wide / 2 / ((0.25 + pushed / 2) * growth)
    first = result.events[0]
    assert (first.kind, first.liaison[:2]) == ("separation", "c0")
    assert first.time == pytest.approx(tips, rel=1e-9)
    assert {e.liaison[:2] for e in result.events if e.kind == "slip"} - {"c0"}
    falls_back = next((e.time for e in result.events if e.kind == "impact"), result.time[-1])
    for t in [*np.linspace(0.1 * tips, 0.999 * falls_back, 12)]:
        at = result.at(float(t))
        # 1 where the force that a contact tells acts on the box above it
        sign = float(np.sign(at["c0[1].force.y"] + at["c0[2].force.y"]))
        for k, axis in enumerate("xy"):
            held = [
                sum(at[f"c{i}[{j}].force.{axis}"] for j in range(1, 5 if i > 0 else 3))
                for i in range(BOXES)
            ]
            for i in range(BOXES):
                load = (way * growth * t if i == pushed else 0.0) if k == 0 else -G
                above = held[i + 1] if i + 1 < BOXES else 0.0
                rest = at[f"b{i}.acceleration.{axis}"] - load
                assert rest == pytest.approx(sign * (held[i] - above), abs=1e-9 * BOXES * G)
