"""Several rough corners of a body in space that meet at once: stiff slips, redundant friction."""

from __future__ import annotations

import ctypes as ct
import subprocess

import numpy as np
import pytest
from c_objects import c_objects
from frot.compiler.toolchain.compiler_choice import KERNEL_FLAGS
from frot.compiler.toolchain.objects import kernel_folder
from frot.runtime.impact_law import Block, Impact, friction, normal
from frot.runtime.impact_law import solve_impact as solve
from numpy.typing import NDArray

Floats = NDArray[np.float64]
ALL = ((1, 1), (1, -1), (-1, 1), (-1, -1))


def box(rng: np.random.Generator, count: int) -> Floats:
    """The rows (3 a corner: normal, tangents) of corners of the lower face of a box, by sqrt(M)."""
    size = rng.uniform(0.1, 0.8, 3)
    places = [np.array([x * size[0] / 2, y * size[1] / 2, -size[2] / 2]) for x, y in ALL[:count]]
    turn = rng.uniform(-np.pi, np.pi)
    ways = np.array([[0, 0, 1], [np.cos(turn), np.sin(turn), 0], [-np.sin(turn), np.cos(turn), 0]])
    rows = np.array([[*way, *np.cross(place, way)] for place in places for way in ways])
    squares = size**2
    inertia = np.array([squares[1] + squares[2], squares[0] + squares[2], squares[0] + squares[1]])
    return rows / np.sqrt([1, 1, 1, *inertia / 12])


def motion_of(rng: np.random.Generator, half: Floats, kind: str) -> Floats:
    """A motion in which the face falls flat, tips about two corners, or meets askew."""
    motion = rng.normal(size=6)
    normals = half[::3]
    if kind == "flat":  # every corner with one speed
        motion = motion - np.linalg.pinv(normals) @ (normals @ motion + rng.uniform(0.1, 2))
    elif kind == "tips":  # two corners are in contact
        two = normals[:2]
        motion = motion - np.linalg.pinv(two) @ (two @ motion)
        if len(normals) > 2 and (normals[2:] @ motion).min() > 0:
            motion = -motion
    return motion


def blocks_of(rng: np.random.Generator, count: int, mu: float) -> list[Block]:
    e = float(rng.choice([0.0, 0.3, 0.7, 0.95]))
    return [
        block
        for k in range(count)
        for block in (normal(3 * k, e), friction(3 * k + 1, 2, 3 * k, mu))
    ]


def check(half: Floats, before: Floats, found: Impact, mu: float) -> None:
    """Speeds part, impulses are in their cones, and the energy lost is what the blocks take."""
    count = len(before) // 3
    size = np.abs(before).max()
    assert found.u[::3].min() >= -1e-10 * size
    assert found.p[::3].min() >= 0
    for k in range(count):
        along = np.linalg.norm(found.p[3 * k + 1 : 3 * k + 3])
        assert along <= mu * found.p[3 * k] + 1e-8 * size
    after = before + half @ (half.T @ found.p)
    assert found.u == pytest.approx(after, abs=1e-8 * size)
    lost = -0.5 * found.p @ (before + after)
    assert lost >= -1e-9 * size**2
    assert sum(found.lost) == pytest.approx(lost, abs=1e-7 * size**2)


@pytest.mark.parametrize("kind", ["flat", "tips", "askew"])
@pytest.mark.parametrize("count", [2, 3, 4])
def test_every_impact_of_corners_ends(kernel: ct.CDLL, count: int, kind: str) -> None:
    rng = np.random.default_rng(count)
    for _ in range(12):
        half, mu = box(rng, count), float(rng.choice([0.2, 0.5, 1.2]))
        before = half @ motion_of(rng, half, kind)
        if kind == "tips":
            before[:6:3] = 0
        blocks = blocks_of(rng, count, mu)
        found = solve(kernel, half @ half.T, before, blocks)
        assert found.status == 0
        check(half, before, found, mu)


@pytest.fixture(scope="module")
def implicit(tmp_path_factory: pytest.TempPathFactory) -> ct.CDLL:
    """The law of impacts with the implicit method alone where several springs act."""
    folder = kernel_folder()
    names = ("law", "modes", "phases", "springs", "implicit")
    sources = [folder / "contact" / f"impact_{name}.c" for name in names]
    sources += [folder / x for x in ("contact/contact_newton.c", "numerics/basis.c")]
    sources.append(folder / "numerics" / "dense.c")
    objects = c_objects(sources, [folder], (*KERNEL_FLAGS, "-DFROT_EXPLICIT_STEPS=0"))
    library = tmp_path_factory.mktemp("implicit") / "impact.so"
    subprocess.run(["cc", "-shared", *map(str, objects), "-lm", "-o", str(library)], check=True)
    return ct.CDLL(str(library))


@pytest.mark.parametrize("count", [2, 3, 4])
def test_the_implicit_method_agrees_with_the_explicit_one(
    kernel: ct.CDLL, implicit: ct.CDLL, count: int
) -> None:
    """Slips that pass zero near by depend on rounding as its square root: some differ by 1e-6."""
    rng, apart = np.random.default_rng(10 + count), []
    for _ in range(8):
        half, mu = box(rng, count), float(rng.choice([0.1, 0.3, 0.6]))
        before = half @ motion_of(rng, half, "flat")
        blocks = blocks_of(rng, count, mu)
        one = solve(kernel, half @ half.T, before, blocks)
        other = solve(implicit, half @ half.T, before, blocks)
        assert one.status == other.status == 0
        apart.append(np.abs(other.u - one.u).max())
    assert max(apart) < 5e-5
    assert np.median(apart) < 1e-10
