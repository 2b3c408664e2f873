"""Points on lines and lines on planes: both bodies moving, one of them driven, both orders.

Newton-Euler residuals come from the results alone, and what is kept from plain geometry.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import frot
from tests.space.newton_euler import Link, Place, axes, box, orientation, place_of, residual

TIMES = (0.0, 0.21, 0.5)
LOCAL = {"p": (-0.15, 0.1, -0.35), "q": (0.2, 0.1, 0.1)}
WAY, NORMAL, AXIS = np.array([1, 0.3, -0.5]), np.array([0.2, -0.1, 1]), np.array([0.3, 1, 0.2])


def turned(at: object, body: str, local: np.ndarray) -> np.ndarray:
    """A unit vector of a body in ground axes."""
    return axes(orientation(at, body)) @ (local / np.linalg.norm(local))


def off_line(apart: np.ndarray, line: np.ndarray, other: np.ndarray) -> list[float]:
    """How far a point is from a line through the other place."""
    return list(np.cross(line, apart))


def off_plane(apart: np.ndarray, normal: np.ndarray, line: np.ndarray) -> list[float]:
    """How far a line is from a plane through the other place, and their angle."""
    return [normal @ apart, normal @ line]


Kept = Callable[[np.ndarray, np.ndarray, np.ndarray], list[float]]
# what stands in the text; the body of the line or plane, the one that is held at its place; their
# directions; what is kept; which order the text has
CASES: dict[str, tuple[str, str, np.ndarray, np.ndarray, Kept, bool]] = {
    "line": ("lineaire_annulaire(p_line_{0}, q_at_{0})", "pq", WAY, WAY, off_line, True),
    "line_back": ("lineaire_annulaire(q_at_{0}, p_line_{0})", "pq", WAY, WAY, off_line, False),
    "axis": (
        "lineaire_annulaire(p_at_{0}, q_at_{0}, axis = (0.3, 1, 0.2))",
        *("pq", AXIS, AXIS, off_line, True),
    ),
    "axis_back": (
        "lineaire_annulaire(q_at_{0}, p_at_{0}, axis = (0.3, 1, 0.2))",
        *("qp", AXIS, AXIS, off_line, True),
    ),
    "plane": ("lineaire_rectiligne(p_plane_{0}, q_line_{0})", "pq", NORMAL, WAY, off_plane, True),
    "plane_back": (
        "lineaire_rectiligne(p_line_{0}, q_plane_{0})",
        *("qp", NORMAL, WAY, off_plane, False),
    ),
}


def pair(name: str) -> str:
    """A box that a motor turns, another that is free, and what joins them."""
    places = "".join(
        f"""
  frame {x}_at_{name} on {x}_{name} at {LOCAL[x]} m;
  curve {x}_line_{name} on {x}_{name}: line(through = {LOCAL[x]} m, direction = (1, 0.3, -0.5));
  surface {x}_plane_{name} on {x}_{name}: plane(through = {LOCAL[x]} m, normal = (0.2, -0.1, 1));"""
        for x in "pq"
    )
    return f"""
  body p_{name}: box(mass = 2 kg, size = (0.3, 0.5, 0.7) m);
  body q_{name}: box(mass = 1 kg, size = (0.4, 0.2, 0.3) m);{places}
  liaison M_{name}: rotoide(f0, p_{name}, axis = (1, 0.2, 0.1))
    driven(angle = 0.3*sin(3*time/(1 s)) + time^2/(1 s^2));
  liaison L_{name}: {CASES[name][0].format(name)};
  output Force f_{name} = L_{name}.force.x + M_{name}.force.x;"""


@pytest.fixture(scope="module")
def result() -> frot.Result:
    starts = "".join(
        f"  guess(q_{n}.position = (0.5, 0.4, 0.6) m, q_{n}.orientation = (0.7, 0.3, 0.5, 0.4));\n"
        f"  guess(q_{n}.angular_velocity = (1, -2, 0.5) rad/s);\n"
        for n in CASES
    )
    return frot.compile(
        f"""
model PointsAndLines "A driven box holds another"
  frame f0 on ground at (0.1, 0.2, 0.3) m;{"".join(pair(n) for n in CASES)}
initial
{starts}  experiment(stop = 0.5 s, tolerance = 1e-11);
end PointsAndLines;
"""
    ).simulate()


@pytest.mark.parametrize("name", CASES)
def test_it_keeps_its_relations_and_obeys_newton_and_euler(result: frot.Result, name: str) -> None:
    _, (holder, held), first, second, kept, forth = CASES[name]
    p, q = f"p_{name}", f"q_{name}"
    where = {x: Place(f"{x}_{name}", LOCAL[x]) for x in "pq"}
    for t in TIMES:
        at = result.at(t)
        apart = place_of(at, where[held]) - place_of(at, where[holder])
        directions = turned(at, f"{holder}_{name}", first), turned(at, f"{held}_{name}", second)
        assert np.abs(kept(apart, *directions)).max() < 1e-11, t
    ends = (where[holder], where[held]) if forth else (where[held], where[holder])
    there = lambda at: place_of(at, where[held])  # noqa: E731
    links = [
        Link(f"M_{name}", Place(None, (0.1, 0.2, 0.3)), Place(p, (0, 0, 0))),
        Link(f"L_{name}", *ends, there),
    ]
    bodies = [box(p, 2, (0.3, 0.5, 0.7)), box(q, 1, (0.4, 0.2, 0.3))]
    assert residual(result, bodies, links, TIMES) < 1e-9


def test_both_orders_move_alike(result: frot.Result) -> None:
    for axis in "xyz":
        one, other = (result[f"q_{name}.position.{axis}"] for name in ("line", "line_back"))
        assert np.abs(one - other).max() < 1e-9
