"""The kernel's impact of one component, called from Python: see contact/impact_law.h."""

from __future__ import annotations

import ctypes as ct
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

HELD, READS, PRESSES, BALL = 1, 2, 3, 4
ENERGETIC, POISSON, NEWTON = range(3)


class Block(ct.Structure):
    _fields_ = (
        *((name, ct.c_int) for name in ("rule", "at", "n", "bounding", "n_bounding")),
        *((name, ct.c_double) for name in ("slipping", "resting")),
        ("is_zero", ct.c_int),
        ("restitution", ct.c_double),
        ("law", ct.c_int),
    )


class Problem(ct.Structure):
    _fields_ = (
        *((name, ct.c_int) for name in ("rows", "n_blocks")),
        *((name, ct.c_void_p) for name in ("w", "blocks")),
    )


@dataclass(frozen=True)
class Impact:
    """Status (0: solved), speeds after, impulses, work taken by each block, changes of phase."""

    status: int
    u: NDArray[np.float64]
    p: NDArray[np.float64]
    lost: NDArray[np.float64]
    phases: int


def normal(at: int, e: float = 0.0, law: int = ENERGETIC) -> Block:
    """A contact that can part."""
    return Block(PRESSES, at, 1, 0, 0, 0, 0, 0, e, law)


def friction(at: int, n: int, bounding: int, mu: float, mu_s: float = 0.0) -> Block:
    """Friction on n rows, bounded by the impulse in one row."""
    return Block(BALL, at, n, bounding, 1, mu, max(mu, mu_s), 0, 0, 0)


def solve(
    kernel: ct.CDLL, w: NDArray[np.float64], u: object, blocks: list[Block], driver: int = -1
) -> Impact:
    """The impact of bodies with the matrix w of their rows and the speeds u before."""
    w, speeds = np.ascontiguousarray(w, dtype=float), np.array(u, dtype=float)
    n, count = len(speeds), len(blocks)
    listed = (Block * count)(*blocks)
    problem = Problem(n, count, w.ctypes.data, ct.addressof(listed))
    impulses, lost, phases = np.zeros(n), np.zeros(count), ct.c_int()
    doubles = np.zeros(kernel.frot_impact_doubles(n, count))
    integers = np.zeros(kernel.frot_impact_integers(n), dtype=np.intc)
    arrays = [x.ctypes.data_as(ct.c_void_p) for x in (speeds, impulses, lost)]
    scratch = [x.ctypes.data_as(ct.c_void_p) for x in (doubles, integers)]
    status = kernel.frot_solve_impact(
        ct.byref(problem), driver, *arrays, ct.byref(phases), *scratch
    )
    return Impact(status, speeds, impulses, lost, phases.value)
