"""The table of liaisons that coordinates can keep: a row is all that the tests need to know.

`pose` tells by plain geometry where b stands in the axes of a, from the coordinates alone.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

Pose = tuple[np.ndarray, np.ndarray]  # the place of b (3) and its axes (3 x 3), in the axes of a


def unit(*axis: float) -> np.ndarray:
    """A direction."""
    return np.array(axis, dtype=float) / np.linalg.norm(axis)


def turned(axis: np.ndarray, angle: float) -> np.ndarray:
    """Axes turned about a unit vector (Rodrigues)."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def of_quaternion(r: Sequence[float]) -> np.ndarray:
    """Axes of a unit quaternion w, x, y, z."""
    angle = 2 * np.arctan2(np.linalg.norm(r[1:]), r[0])
    return np.eye(3) if angle == 0 else turned(unit(*r[1:]), angle)


@dataclass(frozen=True)
class Row:
    """A liaison: options, the same with a and b exchanged, coordinates, what they say.

    `driven` are coordinates that can be prescribed, `speeds` names of prescribed speeds. `ring`:
    how many of it, with these options, close a loop that moves; None where no such loop can.
    """

    options: str
    back: str
    relations: int
    coordinates: tuple[str, ...]
    pose: Callable[[Mapping[str, float]], Pose]
    driven: tuple[str, ...] = ()
    speeds: tuple[str, ...] = ()
    ring: tuple[int, tuple[str, ...]] | None = None


HERE = np.zeros(3)
AXES = ("(0.1, 1, 0.2)", "(1, 0.3, 0)", "(0, 0.2, 1)", "(1, -1, 0.4)")
AXES += ("(0.3, 1, 1)", "(-0.5, 0.2, 1)", "(1, 1, 1)")
ABOUT = tuple(f", axis = {a}" for a in AXES)
N = unit(0.3, 0.1, 1)


def across(normal: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The directions of x and y of a plane: x is the one nearest to the x axis."""
    first = np.array([1.0, 0, 0]) - normal[0] * normal
    first /= np.linalg.norm(first)
    return first, np.cross(normal, first)


JOINTS: dict[str, Row] = {
    "encastrement": Row("", "", 6, (), lambda q: (HERE, np.eye(3))),
    "rotoide": Row(
        ", axis = (0.2, 1, 0.3)",
        ", axis = (0.2, 1, 0.3)",
        5,
        ("angle",),
        lambda q: (HERE, turned(unit(0.2, 1, 0.3), q["angle"])),
        ("angle",),
        ("speed",),
        (7, ABOUT),
    ),
    "prismatique": Row(
        ", axis = (1, 0.3, -0.5)",
        ", axis = (1, 0.3, -0.5)",
        5,
        ("displacement",),
        lambda q: (q["displacement"] * unit(1, 0.3, -0.5), np.eye(3)),
        ("displacement",),
        ("speed",),
        (7, ABOUT),
    ),
    "verrou": Row(
        ", axis = (0.5, 1, 0.1)",
        ", axis = (0.5, 1, 0.1)",
        4,
        ("angle", "displacement"),
        lambda q: (q["displacement"] * unit(0.5, 1, 0.1), turned(unit(0.5, 1, 0.1), q["angle"])),
        ("displacement", "angle"),
        ("speed_angle", "speed"),
        (4, ABOUT[:4]),
    ),
    "helicoidale": Row(
        ", axis = (0.1, 1, 0.2), pitch = 300 mm",
        ", axis = (0.1, 1, 0.2), pitch = 300 mm",
        5,
        ("angle",),
        lambda q: (
            0.3 * q["angle"] / (2 * np.pi) * unit(0.1, 1, 0.2),
            turned(unit(0.1, 1, 0.2), q["angle"]),
        ),
        ("angle",),
        (),
        (7, tuple(f"{a}, pitch = {0.5 + 0.1 * k} m" for k, a in enumerate(ABOUT))),
    ),
    "cardan": Row(
        ", axis_a = y, axis_b = x",
        ", axis_a = x, axis_b = y",
        4,
        ("angle_a", "angle_b"),
        lambda q: (
            HERE,
            turned(unit(0, 1, 0), q["angle_a"]) @ turned(unit(1, 0, 0), q["angle_b"]),
        ),
        ("angle_b", "angle_a"),
        (),
        (4, (", axis_a = x, axis_b = y", ", axis_a = y, axis_b = z") * 2),
    ),
    "spherique": Row(
        "",
        "",
        3,
        ("orientation",),
        lambda q: (HERE, of_quaternion(q["orientation"])),
        ring=(3, ("", "", "")),
    ),
    "appui_plan": Row(
        ", normal = (0.3, 0.1, 1)",
        ", normal = (0.3, 0.1, 1)",
        3,
        ("x", "y", "angle"),
        lambda q: (q["x"] * across(N)[0] + q["y"] * across(N)[1], turned(N, q["angle"])),
        ("angle", "x", "y"),
        (),
        (3, tuple(f", normal = {a}" for a in AXES[:3])),
    ),
    "libre": Row(
        "",
        "",
        0,
        ("x", "y", "z", "orientation"),
        lambda q: (
            np.array([q["x"], q["y"], q["z"]]),
            of_quaternion(q["orientation"]),  # type: ignore[arg-type]
        ),
        ("x", "y", "z"),
    ),
}
