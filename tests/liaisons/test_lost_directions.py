"""Where a figure has no tangent or normal, a run says which, in which liaison and where."""

from __future__ import annotations

import numpy as np
import pytest

import frot

POINT = "body a: particle(mass = 1 kg);"
CASES = {
    "a cusp at the start": (
        f"{POINT} curve c on ground: parametric((1 m*u^3, 0 m, 1 m*u^2), u = (-1, 1));",
        "point_courbe(a, c)",
        "L.u = 0;",
        "the tangent of 'c' vanishes at u = 0 at t = 0",
    ),
    "an apex": (
        f"{POINT} surface c on ground: implicit(x^2 + y^2 - z^2);",
        "point_surface(a, c)",
        "a.velocity.x = 1 m/s;",
        "the normal of 'c' vanishes at x = 0, y = 0, z = 0 at t = 0",
    ),
    "a pole of a surface of points": (
        f"{POINT} surface c on ground: "
        "parametric((1 m*u*cos(v), 1 m*u*sin(v), 1 m*u^2), u = (0, 1), v = (0, 6));",
        "point_surface(a, c)",
        "a.velocity.x = 1 m/s;",
        "the normal of 'c' vanishes at u = 0, v = 0 at t = 0",
    ),
    "a rim that lies flat": (
        "body a: disc(mass = 1 kg, radius = 0.1 m);",
        "roulement(a.rim, ground.plane)",
        "a.velocity.x = 1 m/s;",
        "no single place of 'a.rim' is the nearest at t = 0",
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_the_start_tells_it(name: str) -> None:
    declared, liaison, stated, words = CASES[name]
    text = f"model M\n{declared}\nliaison L: {liaison};\ninitial\n{stated}\nend M;"
    with pytest.raises(frot.FrotError) as told:
        frot.compile(text).simulate()
    assert "E0911" in str(told.value)
    assert f"liaison 'L': {words}" in str(told.value)


def test_a_run_that_comes_to_a_cusp_tells_it() -> None:
    """Down x = u^3, z = u^2 from u = 0.7: there at the time the arc length gives, by energy."""
    declared, liaison, _, _ = CASES["a cusp at the start"]
    text = f"model M\n{declared}\nliaison L: {liaison};\ninitial\nL.u = 0.7;\nend M;"
    with pytest.raises(frot.SimulationError) as told:
        frot.compile(text).simulate(tolerance=1e-10)
    # dt = |c'| du/sqrt(2 g (0.49 - u^2)), where u = 0.7 sin s takes the root away
    s = np.linspace(0, np.pi / 2, 200_001)
    path = 0.7 * np.sin(s)
    rate = np.sqrt(9 * path**4 + 4 * path**2) / np.sqrt(2 * 9.81)
    assert "the tangent of 'c' vanishes at u = " in str(told.value)
    assert told.value.result is not None
    assert told.value.result.time[-1] == pytest.approx(np.trapezoid(rate, s), abs=1e-7)
