"""The kernel's impact of contacts that act on each other (kernel/contact/impact_law.h)."""

from __future__ import annotations

import ctypes as ct
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

# Rules of rows: frot_contact_rule. Rules of restitution: frot_impact_rule.
HELD, READS, PRESSES, BALL = 1, 2, 3, 4
ENERGETIC, POISSON, NEWTON = range(3)
SOLVED, NO_MODES, ENDLESS = range(3)


class Block(ct.Structure):
    """The C struct `frot_impact_block`."""

    _fields_ = (
        *((name, ct.c_int) for name in ("rule", "at", "n", "bounding", "n_bounding")),
        *((name, ct.c_double) for name in ("slipping", "resting")),
        ("is_zero", ct.c_int),
        ("restitution", ct.c_double),
        ("law", ct.c_int),
        ("norm", ct.c_int * 3),
    )


class Problem(ct.Structure):
    """The C struct `frot_impact_problem`."""

    _fields_ = (
        *((name, ct.c_int) for name in ("rows", "n_blocks")),
        *((name, ct.c_void_p) for name in ("w", "blocks")),
    )


@dataclass(frozen=True, slots=True, eq=False)
class Impact:
    """An impact that is solved, or not.

    Attributes:
        status: SOLVED, NO_MODES or ENDLESS.
        u: Speeds of the rows after it, m/s or rad/s.
        p: Impulses in the rows, N.s or N.m.s.
        lost: Energy that each block has taken, J.
        phases: How often slip, stick or compression changed.
    """

    status: int
    u: NDArray[np.float64]
    p: NDArray[np.float64]
    lost: NDArray[np.float64]
    phases: int


def held(at: int) -> Block:
    """A row without speed: a relation."""
    return Block(HELD, at, 1)


def reading(at: int) -> Block:
    """A row whose impulse other impulses give."""
    return Block(READS, at, 1)


def normal(at: int, e: float = 0.0, law: int = ENERGETIC, *, is_zero: bool = False) -> Block:
    """A contact that can part; `is_zero`: it is closed, without speed."""
    return Block(PRESSES, at, 1, is_zero=int(is_zero), restitution=e, law=law)


def friction(
    at: int,
    n: int,
    bounding: int,
    mu: float,
    mu_s: float = 0.0,
    *,
    n_bounding: int = 1,
    norm: Sequence[int] = (),
    is_zero: bool = False,
) -> Block:
    """Friction on n rows, bounded by the impulses of `n_bounding` rows from `bounding` on."""
    norms = (ct.c_int * 3)(*norm)
    return Block(
        BALL,
        at,
        n,
        bounding,
        n_bounding,
        slipping=mu,
        resting=max(mu, mu_s),
        is_zero=int(is_zero),
        norm=norms,
    )


def solve_impact(
    kernel: ct.CDLL,
    w: NDArray[np.float64],
    u: object,
    blocks: Sequence[Block],
    driver: int = -1,
) -> Impact:
    """The impact of rows with the speeds u before it.

    `w` (rows x rows) are the effects of impulses on speeds; `kernel` is the library of a program.
    `driver`: a block that presses by its friction alone, or -1.
    """
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
