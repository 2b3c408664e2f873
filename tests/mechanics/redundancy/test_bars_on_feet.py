"""A bar on rough feet, drawn ever harder, rests while any share of its weight can hold.

The largest pull F is a maximum over the weights N of the feet: F = sum of mu N and what draws down
the slope, with the sum of N and their moment given. A linear program has it where two feet carry,
so that every pair is looked at.
"""

from __future__ import annotations

import functools
import itertools

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding

G = 9.81


@functools.cache
def bar(n: int) -> frot.Model:
    feet = range(n)
    lines = [
        "planar model Feet",
        "  parameter Mass m = 2 kg;",
        "  parameter Force pull = 3 N;",
        "  parameter Angle tilt = 0;",
        "  parameter Length h = 0 m;",
        "  parameter Real more = 1;",
        *(f"  parameter Real mu{i} = 0.3;" for i in feet),
        *(f"  parameter Length x{i} = {i} m;" for i in feet),
        "  body b: rod(mass = m, length = 2 m);",
        *(f"  frame f{i} on b at (x{i}, 0 m);" for i in feet),
        "  curve floor on ground: line(through = (0, 0) m, direction = (cos(tilt), sin(tilt)));",
        "  frame hand on b at (0 m, h);",
        *(
            f"  liaison c{i}: contact_ponctuel(f{i}, floor) with coulomb(mu{i}, mu_s = more*mu{i});"
            for i in feet
        ),
        "  force drawn: on(hand, value = pull*(time/(1 s))*(cos(tilt), sin(tilt)));",
        "initial",
        "  b.position = (0, 0) m;",
        "  b.angle = tilt;",
        "  experiment(stop = 2.2 s);",
        "end Feet;",
    ]
    return frot.compile("\n".join(lines))


def largest_pull(x: np.ndarray, mu: np.ndarray, weight: float, down: float, h: float) -> float:
    """The best vertex: F = down + sum mu N, sum N = weight, sum N x = h F, two feet or one."""
    best = -np.inf
    for i, k in itertools.combinations(range(len(x)), 2):
        system = [[mu[i], mu[k], -1], [1, 1, 0], [x[i], x[k], -h]]
        if abs(np.linalg.det(system)) < 1e-12:
            continue
        left, right, pull = np.linalg.solve(system, [-down, weight, 0])
        if left >= -1e-12 * weight and right >= -1e-12 * weight:
            best = max(best, pull)
    return best


@pytest.mark.parametrize("n", [2, 3, 4, 5, 6, 8, 12])
@pytest.mark.parametrize("alike", [True, False])
def test_a_bar_departs_when_no_share_of_its_weight_holds_it(n: int, alike: bool) -> None:
    random = np.random.default_rng(100 + n)
    model = bar(n)
    for tilt, h, m, tolerance in (
        (0.0, 0.0, 1.0, 1e-4),
        (0.15, 0.1, 1e6, 1e-7),
        (-0.1, 0.1, 1e-6, 1e-10),
    ):
        x = np.sort(random.uniform(-1, 1, n))
        x[0], x[-1] = -1, 1
        mu = np.full(n, 0.37) if alike else random.uniform(0.2, 0.6, n)
        weight, down = m * G * np.cos(tilt), m * G * np.sin(tilt)
        pull = largest_pull(x, mu, weight, down, h)
        values = {"m": m, "tilt": tilt, "h": h, "pull": pull / 2}
        values |= {f"x{i}": x[i] for i in range(n)} | {f"mu{i}": mu[i] for i in range(n)}
        result = model.simulate(tolerance=tolerance, parameters=values)
        departed = [e.time for e in result.events if e.kind == "slip"]
        assert len(departed) == n and departed == pytest.approx([2.0] * n, rel=1e-9)
        assert result.time[-1] == 2.2 and result.at(2.2)["c0.slip"] > 0
        at = result.at(np.linspace(0, 1.999, 40))
        held = sum(at[f"c{i}.tangential_force"] for i in range(n))
        assert held == pytest.approx(down - pull / 2 * np.linspace(0, 1.999, 40), abs=1e-8 * weight)
        for i in range(n):
            normal, friction = at[f"c{i}.normal_force"], at[f"c{i}.tangential_force"]
            assert np.all(normal >= -1e-9 * weight)
            assert np.all(np.abs(friction) <= mu[i] * normal + 1e-9 * weight)
            assert np.all(at[f"c{i}.slip"] == 0)


@pytest.mark.parametrize("n", [4, 9, 12])
@pytest.mark.parametrize("side", [1, -1])
def test_a_start_between_slipping_and_resting_is_rest(n: int, side: int) -> None:
    """What slips on could slip here, and what rests may rest: the default takes rest, however many
    feet there are."""
    random = np.random.default_rng(200 + n)
    model = bar(n)
    for m, tolerance in ((1.0, 1e-4), (1e6, 1e-9), (1e-6, 1e-12)):
        x = np.sort(random.uniform(-1, 1, n))
        x[0], x[-1] = -1, 1
        mu = random.uniform(0.2, 0.6, n)
        pull = side * largest_pull(x, 1.3 * mu, m * G, 0.0, 0.0)
        values = {"m": m, "more": 1.3, "pull": pull / 2}
        values |= {f"x{i}": x[i] for i in range(n)} | {f"mu{i}": mu[i] for i in range(n)}
        result = model.simulate(start=1.9, tolerance=tolerance, parameters=values)
        departed = [e.time for e in result.events if e.kind == "slip"]
        assert departed == pytest.approx([2.0] * n, rel=1e-9)
        assert np.all(result.at(np.linspace(1.9, 1.999, 9))["b.velocity.x"] == 0)
