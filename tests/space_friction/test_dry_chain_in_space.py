"""A chain of ten dry hinges about crossed axes: its laws, Newton's and Euler's, its energy."""

from __future__ import annotations

import numpy as np
import pytest

import frot
from tests.space.newton_euler import Body, Link, Place, residual, vector

COUNT = 10
MOMENTS = (0.02**2 / 4 + 0.2**2 / 12, 0.02**2 / 4 + 0.2**2 / 12, 0.02**2 / 2)


def text() -> str:
    body = "cylinder(mass = 1 kg, radius = 2 cm, length = 0.2 m)"
    lines = ["model Chain", *(f"  body b{k}: {body};" for k in range(1, COUNT + 1))]
    for k in range(1, COUNT + 1):
        above = "ground" if k == 1 else f"b{k - 1}.bottom"
        joint = f"rotoide({above}, b{k}.top, axis = {'xy'[k % 2]})"
        lines.append(f"  liaison j{k}: {joint} with coulomb(0.2, radius = 1 cm);")
    lines.append("initial")
    for k in range(1, COUNT + 1):
        lines.append(f"  j{k}.angle = {0.5 if k < 3 else 0.1} rad;")
        lines.append(f"  j{k}.speed = {1 if k % 3 else -2} rad/s;")
    lines += ["  experiment(stop = 0.5 s, tolerance = 1e-9);", "end Chain;"]
    return "\n".join(lines)


def test_ten_dry_hinges_in_space() -> None:
    result = frot.compile(text()).simulate()
    assert result.balance.relative < 1e-10
    bodies = [Body(f"b{k}", 1, MOMENTS) for k in range(1, COUNT + 1)]
    links = [
        Link(
            f"j{k}",
            Place(None, (0, 0, 0)) if k == 1 else Place(f"b{k - 1}", (0, 0, -0.1)),
            Place(f"b{k}", (0, 0, 0.1)),
        )
        for k in range(1, COUNT + 1)
    ]
    for t in (0.05, 0.2, 0.35, 0.45):
        assert residual(result, bodies, links, [t]) < 1e-8
        at = result.at(t)
        for k in range(1, COUNT + 1):
            speed = at[f"j{k}.speed"]
            size = 0.2 * 0.01 * np.linalg.norm(vector(at, f"j{k}.force"))
            if at[f"j{k}.mode"] == 2:
                assert at[f"j{k}.power"] == pytest.approx(-size * abs(speed), rel=1e-8)
            else:
                assert speed == 0
