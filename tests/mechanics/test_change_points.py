"""Four-bars whose links can all lie on one line: relations depend on each other there."""

from __future__ import annotations

import itertools
import math
from functools import partial

import casadi as ca
import numpy as np
import pytest
from four_bars import one_line
from scipy.integrate import quad

import frot

TEXT = """
planar model ChangePoint
  parameter Length a = 1 m;
  parameter Length b = 1 m;
  parameter Length c = 1 m;
  parameter Length g = 1 m;
  parameter Velocity v = 1 m/s;
  body crank: rod(mass = 1 kg, length = a);
  body coupler: rod(mass = 1 kg, length = c);
  body follower: rod(mass = 1 kg, length = b);
  frame far on ground at (g, 0 m);
  liaison A: rotoide(ground, crank.start);
  liaison B: rotoide(crank.tip, coupler.start);
  liaison C: rotoide(coupler.tip, follower.tip);
  liaison D: rotoide(far, follower.start);
initial
  crank.tip.position = (0 m, a);
  guess(follower.position = ((c + g)/2, a/2));
  crank.tip.velocity.x = v;
  experiment(stop = 2 s, tolerance = 1e-9);
end ChangePoint;
"""


def energies(a: float, b: float, c: float, g: float) -> ca.Function:
    """Twice the kinetic energy at unit crank speed, the potential and the coupler's end, by the
    crank's angle."""
    x, side = ca.SX.sym("x"), ca.SX.sym("side")
    kinetic, potential, end = one_line(a, b, c, g, x, side)
    return ca.Function("energies", [x, side], [kinetic, potential, end])


def tip(b: float, g: float, angle: float) -> ca.DM:
    """Where the follower ends."""
    return ca.DM([g + b * math.cos(angle), b * math.sin(angle)])


@pytest.fixture(scope="module")
def model() -> frot.Model:
    return frot.compile(TEXT)


@pytest.mark.parametrize(
    ("a", "b", "g", "v"),
    [(0.625, 1.75, 0.875, 14), (1.0, 2.125, 1.375, 11), (0.375, 1.625, 1.25, -7), (1, 1.1, 1.1, 9)],
)
def test_a_four_bar_runs_on_where_its_links_lie_on_one_line(
    model: frot.Model, a: float, b: float, g: float, v: float
) -> None:
    """The instant at which the crank has made two turns and a radian, by quadrature."""
    c = b + g - a
    run = partial(model.simulate, parameters={"a": a, "b": b, "c": c, "g": g, "v": v})
    first = run(stop=0.01).at(0)
    start, angle = float(first["crank.angle"]), float(first["follower.angle"])
    of = energies(a, b, c, g)
    side = min((1, -1), key=lambda s: float(ca.norm_2(of(start, s)[2] - tip(b, g, angle))))
    kinetic, potential = map(float, of(start, side)[:2])
    energy = potential + kinetic * (v / a) ** 2 / 2

    def slowness(x: float) -> float:
        twice, height = map(float, of(x, side)[:2])
        return math.sqrt(twice / (2 * (energy - height)))

    end = start - np.copysign(4 * np.pi + 1, v)
    low, high = sorted((start, end))
    flat = [2 * np.pi * k for k in range(-9, 10) if low < 2 * np.pi * k < high]
    assert len(flat) == 2
    spans = itertools.pairwise((low, *flat, high))
    t = sum(quad(slowness, *span, epsabs=1e-14, epsrel=1e-13, limit=200)[0] for span in spans)
    for tolerance in (1e-4, 1e-7, 1e-10, 1e-12):
        result = run(stop=t, tolerance=tolerance)
        assert abs(result.at(t)["crank.angle"] - end) < 10 * tolerance + 1e-10
        assert result.figures.crossings in (2, 3)  # the last step may end beyond one more
