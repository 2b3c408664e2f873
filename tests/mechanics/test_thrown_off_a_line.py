"""What lies on a line is thrown off it at the start, and not into it: by its speeds alone."""

from __future__ import annotations

import functools

import numpy as np
import pytest

import frot

G = 9.81


@functools.cache
def thrown(body: str, contacts: str) -> frot.Model:
    return frot.compile(f"""
planar model Thrown
  parameter Mass m = 1 kg;
  parameter Length y = 0 m;
  parameter Velocity u = 1 m/s;
  parameter Velocity v = 1 m/s;
  body b: {body};
  {contacts}
  body aside: particle(mass = 1 kg);
initial
  b.position = (0 m, y);
  b.velocity = (u, v);
  experiment(stop = 0.1 s);
end Thrown;
""")


DISC = (
    "disc(mass = m, radius = 0.5 m)",
    "liaison c: contact_ponctuel(ground.line, b.rim) with coulomb(0.3);",
)
BAR = (
    "rod(mass = m, length = 1 m)",
    "liaison c: contact_ponctuel(b.start, ground.line) with coulomb(0.3);"
    "liaison d: contact_ponctuel(b.tip, ground.line);",
)


@pytest.mark.parametrize(("scene", "y"), [(DISC, 0.5), (BAR, 0.0)])
@pytest.mark.parametrize("m", [1e-6, 1.0, 1e6])
@pytest.mark.parametrize(("u", "v"), [(1.0, 2.0), (-3.0, 0.6), (0.0, 1.0)])
def test_it_flies(scene: tuple[str, str], y: float, m: float, u: float, v: float) -> None:
    result = thrown(*scene).simulate(parameters={"m": m, "y": y, "u": u, "v": v})
    t = result.time
    assert np.abs(result["b.position.x"] - u * t).max() < 1e-12
    assert np.abs(result["b.position.y"] - (y + v * t - G * t**2 / 2)).max() < 1e-12
    assert result["b.angle"] == pytest.approx(0 * t, abs=1e-12)


@pytest.mark.parametrize(("scene", "y"), [(DISC, 0.5), (BAR, 0.0)])
@pytest.mark.parametrize("m", [1e-6, 1.0, 1e6])
def test_thrown_into_the_line_it_meets_it_at_once(
    scene: tuple[str, str], y: float, m: float
) -> None:
    result = thrown(*scene).simulate(parameters={"m": m, "y": y, "u": 0.5, "v": -1.0})
    first = result.events[0]
    assert (first.kind, first.time) == ("impact", 0.0)
    assert first.impulse > 0
    assert abs(result.balance.relative) < 1e-8


@pytest.mark.parametrize("u", [1e-9, 1.0, 1e12, 3e13, -1e20])
def test_along_the_line_it_goes_however_fast(u: float) -> None:
    carried = "particle(mass = m)", "liaison c: point_courbe(b, ground.line) with coulomb(0.3);"
    end = {"stop": f"{0.1 / max(1, abs(u))!r} s"}
    result = thrown(*carried).simulate(parameters={"u": u, "v": 0.0}, **end)
    assert result["b.velocity.x"][0] == pytest.approx(u, rel=1e-12)
