"""Light bodies that carry heavy ones: what they resist by themselves is not lost in inertias.

The reference takes each body by itself, with its own accelerations and the reactions of its pins as
unknowns, in numbers of sixty digits.
"""

from __future__ import annotations

import decimal
import math
from collections.abc import Sequence
from decimal import Decimal

import numpy as np
import pytest

import frot

GRAVITY, MU, RADIUS, LENGTH = 9.81, 0.1, 0.01, 1.0
LIGHT = [
    [1.0, 1e-8, 1e-8, 1e-8, 1.0],
    [1e-6, 1e-6, 1e-6, 1e5],
    [80.0, 2e-4, 1e-5, 4600.0, 4.6],
    [1.0, 1e-9, 1e-10, 1e-9, 3.0, 1e-8, 1e-7, 1e-9, 10.0, 1e-10, 1e-10, 1e-10, 1.0],
]


def chain(masses: Sequence[float], *, planar: bool = True, mu: float = 0.0) -> str:
    """Rods on pins, from the ground, in a vertical plane."""
    lines = [f"{'planar ' * planar}model Chain", "  world(gravity = 9.81 m/s^2, down = -y);"]
    before, axis = "ground", "" if planar else ", axis = z"
    for i, mass in enumerate(masses):
        law = f" with coulomb(mu = {mu!r}, radius = {RADIUS!r} m)" if mu else ""
        lines.append(f"  body b{i}: rod(mass = {mass!r} kg, length = {LENGTH!r} m);")
        lines.append(f"  liaison p{i}: rotoide({before}, b{i}.start{axis}){law};")
        before = f"b{i}.tip"
    starts = (
        f"  p{i}.angle = {0.3 + 0.4 * (i % 2)!r}; p{i}.speed = {0.2 + 0.1 * i!r} rad/s;"
        for i in range(len(masses))
    )
    return "\n".join([*lines, "initial", *starts, "  experiment(tolerance = 1e-9);", "end Chain;"])


def solve(a: list[list[Decimal]], b: list[Decimal]) -> list[Decimal]:
    """A x = b by elimination with pivoting."""
    n = len(b)
    rows = [[*row, x] for row, x in zip(a, b, strict=True)]
    for k in range(n):
        best = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[best] = rows[best], rows[k]
        for i in range(k + 1, n):
            part = rows[i][k] / rows[k][k]
            if part:
                rows[i] = [x - part * y for x, y in zip(rows[i], rows[k], strict=True)]
    x = [Decimal(0)] * n
    for k in reversed(range(n)):
        x[k] = (rows[k][n] - sum(rows[k][j] * x[j] for j in range(k + 1, n))) / rows[k][k]
    return x


def reference(
    masses: Sequence[float], angles: Sequence[float], speeds: Sequence[float]
) -> np.ndarray:
    """Of each body the acceleration of G (2), of the angle, and the reaction (2) at its start.

    The pins slip, with friction by their reactions.
    """
    n = len(masses)
    m, w = [Decimal(x) for x in masses], [Decimal(x) for x in speeds]
    arms = [(Decimal(math.cos(x)) / 2, Decimal(math.sin(x)) / 2) for x in angles]
    signs = [1 if w[i] > (w[i - 1] if i else 0) else -1 for i in range(n)]
    couples = [Decimal(0)] * n
    for _ in range(60):
        a = [[Decimal(0)] * (5 * n) for _ in range(5 * n)]
        b = [Decimal(0)] * (5 * n)
        for i in range(n):
            x, y = arms[i]
            at, pin = 3 * i, 3 * n + 2 * i
            a[at][at] = a[at + 1][at + 1] = m[i]
            a[at + 2][at + 2] = m[i] / 12
            b[at + 1] = -m[i] * Decimal(GRAVITY)
            ends = [(pin, -x, -y, 1)] + ([(pin + 2, x, y, -1)] if i + 1 < n else [])
            for p, rx, ry, side in ends:
                a[at][p] -= side
                a[at + 1][p + 1] -= side
                a[at + 2][p] += side * ry
                a[at + 2][p + 1] -= side * rx
                a[p][at] += side
                a[p + 1][at + 1] += side
                a[p][at + 2] -= side * ry
                a[p + 1][at + 2] += side * rx
                b[p] += side * w[i] ** 2 * rx
                b[p + 1] += side * w[i] ** 2 * ry
                b[at + 2] += side * couples[(p - 3 * n) // 2]
        z = solve(a, b)
        before = couples
        reactions = [(z[3 * n + 2 * i], z[3 * n + 2 * i + 1]) for i in range(n)]
        sizes = [(x * x + y * y).sqrt() for x, y in reactions]
        couples = [
            -s * Decimal(MU) * Decimal(RADIUS) * r for s, r in zip(signs, sizes, strict=True)
        ]
        if all(
            abs(x - y) <= abs(x) * Decimal("1e-30") for x, y in zip(couples, before, strict=True)
        ):
            break
    return np.array(
        [[*map(float, z[3 * i : 3 * i + 3]), *map(float, reactions[i])] for i in range(n)]
    )


def told(result: frot.Result, t: float, n: int) -> np.ndarray:
    row = result.at(t)
    names = ("acceleration.x", "acceleration.y", "angular_acceleration")
    return np.array(
        [
            [float(row[f"b{i}.{x}"]) for x in names]
            + [float(row[f"p{i}.force.{x}"]) for x in ("x", "y")]
            for i in range(n)
        ]
    )


@pytest.mark.parametrize("masses", LIGHT)
@pytest.mark.parametrize("unit", [1.0, 1e6])
def test_accelerations_and_reactions_are_those_of_sixty_digits(
    masses: list[float], unit: float
) -> None:
    """Each reaction to 1e-12 of itself; accelerations, sums along the chain, to their rounding."""
    masses = [unit * m for m in masses]
    result = frot.compile(chain(masses, mu=MU)).simulate(stop=0.002)
    assert not result.events
    for t in (0.0, 0.0017):
        row, n = result.at(t), len(masses)
        angles = [float(row[f"b{i}.angle"]) for i in range(n)]
        speeds = [float(row[f"b{i}.angular_velocity"]) for i in range(n)]
        with decimal.localcontext(prec=60):
            expected = reference(masses, angles, speeds)
        found = told(result, t, n)
        for part, beside in ((slice(0, 2), 1e-14), (slice(2, 3), 1e-14), (slice(3, 5), 0.0)):
            sizes = np.linalg.norm(expected[:, part], axis=1)
            errors = np.linalg.norm((found - expected)[:, part], axis=1)
            assert np.all(errors < 1e-12 * sizes + beside * np.max(sizes))


@pytest.mark.parametrize("masses", LIGHT)
def test_what_is_turned_into_space_moves_as_in_the_plane(masses: list[float]) -> None:
    """The tree in space, in steps or written out, against that of the plane."""
    flat, space = (frot.compile(chain(masses, planar=p)).simulate(stop=0.05) for p in (True, False))
    for i in range(len(masses)):
        for name in (f"p{i}.angle", f"p{i}.speed"):
            assert space.at(0.05)[name] == pytest.approx(flat.at(0.05)[name], abs=1e-7)


@pytest.mark.parametrize("masses", LIGHT)
def test_the_error_follows_the_tolerance(masses: list[float]) -> None:
    model = frot.compile(chain(masses))
    runs = {tol: model.simulate(stop=0.04, tolerance=tol) for tol in (1e-5, 1e-8, 1e-13)}
    names = [f"p{i}.angle" for i in range(len(masses))]
    exact = np.array([float(runs[1e-13].at(0.04)[x]) for x in names])
    for tol in (1e-5, 1e-8):
        found = np.array([float(runs[tol].at(0.04)[x]) for x in names])
        assert np.max(np.abs(found - exact)) < 100 * tol


@pytest.mark.parametrize("masses", [*LIGHT, [1.0] * 30, [1e-8, 1.0], [1.0, 1e-8]])
def test_nothing_is_masked(masses: list[float]) -> None:
    result = frot.compile(chain(masses)).simulate(stop=0.01)
    assert result.figures.masked < 1e-11
    assert "rounding" not in result.summary()
