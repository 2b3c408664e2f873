"""One motion of a body on rough feet: what parts, rests and begins to slip, against the laws."""

from __future__ import annotations

import ctypes as ct

import numpy as np
import pytest

ABSENT, HELD, READING, NORMAL, BALL, SLIDING = range(6)
AXES = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]], float)


class Block(ct.Structure):
    _fields_ = (
        *((name, ct.c_int) for name in ("rule", "at", "n", "bounding", "n_bounding")),
        ("ratio", ct.c_double),
        ("d", ct.c_double * 3),
        ("norm", ct.c_int * 3),
    )


class Equations(ct.Structure):
    _fields_ = (
        ("rows", ct.c_int),
        ("n_blocks", ct.c_int),
        *((name, ct.c_void_p) for name in ("w", "b", "blocks")),
        ("tolerance", ct.c_double),
    )


def solve(
    kernel: ct.CDLL, w: np.ndarray, b: np.ndarray, blocks: list[Block], sweeps: int = 30
) -> tuple[bool, np.ndarray, np.ndarray]:
    w, b, n = np.ascontiguousarray(w), np.ascontiguousarray(b), len(b)
    listed = (Block * len(blocks))(*blocks)
    problem = Equations(n, len(blocks), w.ctypes.data, b.ctypes.data, ct.addressof(listed), 1e-12)
    x, a = np.zeros(n), np.zeros(n)
    doubles = np.zeros(kernel.frot_contact_newton_doubles(n))
    integers = np.zeros(kernel.frot_contact_newton_integers(n), dtype=np.intc)
    given = [y.ctypes.data_as(ct.c_void_p) for y in (x, a, doubles, integers)]
    return kernel.frot_contact_newton(ct.byref(problem), sweeps, *given) == 0, x, a


def random_body(rng: np.random.Generator, feet: int) -> tuple[np.ndarray, np.ndarray]:
    """Delassus matrix and free accelerations of a loaded body on its feet."""
    places = np.c_[rng.normal(size=(feet, 2)), -rng.uniform(0.1, 0.6, feet)]
    rows = np.array([[*axis, *np.cross(place, axis)] for place in places for axis in AXES])
    inverse = np.diag(1 / np.array([1, 1, 1, *rng.uniform(0.1, 0.5, 3)]))
    load = np.array([*(4 * rng.normal(size=2)), -9.81, *rng.normal(size=3)])
    return rows @ inverse @ rows.T, rows @ inverse @ load


@pytest.mark.parametrize("feet", [1, 2, 3, 4, 5])
def test_the_motion_of_a_body_on_feet_obeys_every_law(kernel: ct.CDLL, feet: int) -> None:
    rng = np.random.default_rng(feet)
    found = 0
    for _ in range(200):
        w, b = random_body(rng, feet)
        mu = rng.uniform(0.1, 0.7, feet)
        blocks = [
            block
            for k in range(feet)
            for block in (
                Block(NORMAL, 3 * k, 1, 0, 0, 0),
                Block(BALL, 3 * k + 1, 2, 3 * k, 1, mu[k]),
            )
        ]
        done, x, a = solve(kernel, w, b, blocks)
        if not done:
            continue
        found += 1
        assert np.allclose(a, b + w @ x, atol=1e-10 * np.abs(b).max())
        normal, apart = x[::3], a[::3]
        assert normal.min() >= -1e-10
        assert apart.min() >= -1e-9
        assert np.abs(normal * apart).max() <= 1e-7
        for k in range(feet):
            force, slip = x[3 * k + 1 : 3 * k + 3], a[3 * k + 1 : 3 * k + 3]
            assert np.hypot(*force) <= mu[k] * normal[k] + 1e-9
            if np.hypot(*slip) > 1e-7:
                opposed = -mu[k] * normal[k] * slip / np.hypot(*slip)
                assert force == pytest.approx(opposed, abs=1e-7)
    assert found >= 195


def test_a_slip_that_is_there_keeps_its_direction_and_a_pin_reads_its_reaction(
    kernel: ct.CDLL,
) -> None:
    """A block slides along (0.6, 0.8); a couple follows the length of a reaction of two readings.

    N = 9.81, f = -0.3 N d; the readings are the load and the friction along x and y, so the couple
    is at its bound 0.1 |R|, against the turning.
    """
    w = np.zeros((6, 6))
    w[0, 0] = w[1, 1] = w[2, 2] = w[5, 5] = 1
    w[3, 1] = w[4, 2] = 1
    b = np.array([-9.81, 0, 0, 2, 3, 5], float)
    blocks = [
        Block(NORMAL, 0, 1, 0, 0, 0),
        Block(SLIDING, 1, 2, 0, 1, 0.3, (0.6, 0.8, 0)),
        Block(READING, 3, 1, 0, 0, 0),
        Block(READING, 4, 1, 0, 0, 0),
        Block(BALL, 5, 1, 3, 2, 0.1),
    ]
    done, x, a = solve(kernel, w, b, blocks)
    assert done
    friction = -0.3 * 9.81 * np.array([0.6, 0.8])
    assert x[:3] == pytest.approx([9.81, *friction], rel=1e-11)
    assert x[3:5] == pytest.approx([2 + friction[0], 3 + friction[1]], rel=1e-11)
    assert x[5] == pytest.approx(-0.1 * np.hypot(*x[3:5]), rel=1e-11)
    assert a[5] == pytest.approx(5 + x[5], rel=1e-11)
