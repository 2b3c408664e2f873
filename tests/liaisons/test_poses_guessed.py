"""Bodies on joints whose places and orientations are guessed in full start where they are guessed.

The guesses are poses that the joints allow, moved by a small error of each body. A quaternion and
its opposite are one orientation: the signs of the guesses are drawn at random.
"""

from __future__ import annotations

import functools
import re
from pathlib import Path

import numpy as np
import pytest

import frot
from tests.liaisons.table import JOINTS, of_quaternion, unit

KINDS = sorted(JOINTS.keys() - {"libre"})
LENGTHS = ("displacement", "x", "y")
SCREW = "helicoidale"
SCALES = [1.0, 1e3, 1e-3]
CHAINS = [
    ("prismatique", SCREW),
    ("encastrement", SCREW),
    ("spherique", "encastrement", SCREW),
    ("cardan", "prismatique", SCREW),
    (SCREW, "appui_plan", "spherique"),
    (SCREW, "verrou"),
    ("rotoide", "rotoide", "appui_plan"),
]

NUT = """
model Screw
  world(gravity = 0 m/s^2);
  body nut: box(mass = 0.4399 kg, size = (0.1985, 0.5457, 0.5373) m);
  frame seat on ground at (0.3506, 0.3706, 0.1575) m
    rotated(axis = (0.4303, 0.8324, -0.3491), angle = 1.8646);
  frame thread on nut at (0.1732, -0.433, -0.4552) m
    rotated(axis = (-0.8014, -0.0239, 0.5976), angle = 2.9014);
  liaison J: helicoidale(seat, thread, axis = z, pitch = -0.354 m);
initial
  guess(nut.position = (-0.118, -0.0435, -0.0002) m);
  guess(nut.orientation = (0.4072, -0.3227, -0.4225, 0.7426));
  experiment(stop = 10 ms);
end Screw;
"""


@functools.cache
def scene(kinds: tuple[str, ...], free: bool, closed: bool = False) -> frot.Model:
    """A chain of joints from the ground, or from a body that nothing holds.

    `closed`: a rod joins a place of the first to one of the last.
    """
    lines = ["model Poses", "  world(gravity = 0 m/s^2);", "  parameter Length one = 1 m;"]
    starts = []
    for k in range(len(kinds) + free):
        lines += [
            f"  parameter Length r{k}[3] = (0, 0, 0) m;",
            f"  parameter Real o{k}[4] = (1, 0, 0, 0);",
            f"  body b{k}: solid(mass = 1 kg, inertia = (1, 1.2, 1.5) * (1 kg)*one^2);",
        ]
        starts.append(f"  guess(b{k}.position = r{k}, b{k}.orientation = o{k});")
    bodies = [f"b{k}" for k in range(len(kinds) + free)]
    bodies = bodies if free else ["ground", *bodies]
    for k, kind in enumerate(kinds):
        options = JOINTS[kind].options.replace("300 mm", "0.3*one")
        for side, body in zip("cd", bodies[k : k + 2], strict=True):
            lines += [
                f"  parameter Length {side}{k}[3] = (0, 0, 0) m;",
                f"  parameter Real {side}n{k}[3] = (0, 0, 1);",
                f"  parameter Angle {side}t{k} = 0;",
                f"  frame {side}f{k} on {body} at {side}{k}"
                f" rotated(axis = {side}n{k}, angle = {side}t{k});",
            ]
        lines.append(f"  liaison J{k}: {kind}(cf{k}, df{k}{options});")
    if closed:
        lines += [
            "  parameter Length first[3] = (0, 0, 0) m;",
            "  parameter Length last[3] = (0, 0, 0) m;",
            "  parameter Length between = 1 m;",
            f"  frame ff on {bodies[0]} at first;",
            f"  frame fl on {bodies[-1]} at last;",
            "  liaison R: tige(ff, fl, length = between);",
        ]
    lines += ["initial", *starts, "  experiment(stop = 1e-9 s);", "end Poses;"]
    return frot.compile("\n".join(lines))


def quaternion(rng: np.random.Generator) -> np.ndarray:
    return unit(*rng.normal(size=4))


def product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    scalar = a[0] * b[0] - a[1:] @ b[1:]
    return np.concatenate(([scalar], a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:])))


def of_axes(axes: np.ndarray) -> np.ndarray:
    """A quaternion of these axes, of either sign: the eigenvector of Bar-Itzhack (2000)."""
    m = axes
    own = np.array(
        [
            [m[0, 0] + m[1, 1] + m[2, 2], m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]],
            [0, m[0, 0] - m[1, 1] - m[2, 2], m[0, 1] + m[1, 0], m[0, 2] + m[2, 0]],
            [0, 0, m[1, 1] - m[0, 0] - m[2, 2], m[1, 2] + m[2, 1]],
            [0, 0, 0, m[2, 2] - m[0, 0] - m[1, 1]],
        ]
    )
    return np.linalg.eigh(own + np.triu(own, 1).T)[1][:, -1]


def drawn(rng: np.random.Generator, kind: str, scale: float) -> tuple[np.ndarray, np.ndarray]:
    """Where the second place of a joint is from the first: angles of a few turns on a screw."""
    values: dict = {}
    for name in JOINTS[kind].coordinates:
        if name == "orientation":
            values[name] = quaternion(rng)
        elif name in LENGTHS:
            values[name] = rng.normal()
        else:
            values[name] = rng.uniform(-12, 12) if kind == SCREW else rng.uniform(-3, 3)
    place, axes = JOINTS[kind].pose(values)
    return scale * place, axes


def allowed(
    rng: np.random.Generator, kinds: tuple[str, ...], free: bool, scale: float
) -> tuple[dict, list[tuple[np.ndarray, np.ndarray]]]:
    """The parameters of the joints, and poses of all that they join that they allow."""
    place, turn = np.zeros(3), np.array([1.0, 0, 0, 0])
    if free:
        place, turn = scale * rng.normal(size=3), quaternion(rng)
    poses = [(place, turn)]
    given: dict = {"one": scale}
    for k, kind in enumerate(kinds):
        frames = []
        for side in "cd":
            at, axis, angle = (
                scale * rng.normal(size=3),
                unit(*rng.normal(size=3)),
                rng.uniform(-3, 3),
            )
            given |= {f"{side}{k}": at, f"{side}n{k}": axis, f"{side}t{k}": angle}
            frames.append((at, np.r_[np.cos(angle / 2), np.sin(angle / 2) * axis]))
        (at, own), (there, other) = frames
        move, axes = drawn(rng, kind, scale)
        place = place + of_quaternion(turn) @ at
        place = place + of_quaternion(product(turn, own)) @ move
        turn = product(product(turn, own), of_axes(axes))
        turn = product(turn, other * [1, -1, -1, -1])
        place = place - of_quaternion(turn) @ there
        poses.append((place, turn))
    return given, poses


def most_missed(
    seed: list[int],
    kinds: tuple[str, ...],
    free: bool,
    scale: float = 1.0,
    error: float = 0.0,
    closed: bool = False,
) -> float:
    """What the start misses the guesses by, which miss poses that are allowed by this error."""
    rng = np.random.default_rng(seed)
    given, poses = allowed(rng, kinds, free, scale)
    if closed:
        first, last = scale * rng.normal(size=(2, 3))
        (start, own), (end, other) = poses[0], poses[-1]
        way = end + of_quaternion(other) @ last - start - of_quaternion(own) @ first
        given |= {"first": first, "last": last, "between": float(np.linalg.norm(way))}
    guessed = []
    for k, (place, turn) in enumerate(poses if free else poses[1:]):
        place = place + scale * error * unit(*rng.normal(size=3))
        small = unit(1, *(0.5 * error * unit(*rng.normal(size=3))))
        turn = rng.choice([-1, 1]) * product(small, turn)
        guessed.append((place, turn))
        given |= {f"r{k}": place, f"o{k}": turn}
    return missed(scene(kinds, free, closed).simulate(parameters=given), guessed, scale)


def missed(result: frot.Result, guessed: list, scale: float) -> float:
    """The most that a place or an orientation of a body is missed by."""
    most = 0.0
    for k, (place, turn) in enumerate(guessed):
        start = [result[f"b{k}.position.{x}"][0] for x in "xyz"]
        own = np.array([result[f"b{k}.orientation[{i}]"][0] for i in range(1, 5)])
        apart = min(np.linalg.norm(own - turn), np.linalg.norm(own + turn))
        most = max(most, float(np.linalg.norm(start - place)) / scale, 2 * float(apart))
    return most


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("free", [False, True])
@pytest.mark.parametrize("kind", KINDS)
def test_a_body_on_one_joint_starts_where_it_is_guessed(
    kind: str, free: bool, scale: float
) -> None:
    """The place that misses guesses least, weighed by masses, misses each by a few errors."""
    for k in range(6):
        seed = [KINDS.index(kind), free, k]
        assert most_missed(seed, (kind,), free, scale) < 1e-11, k
        assert most_missed(seed, (kind,), free, scale, 1e-4) < 1e-3, k


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("free", [False, True])
@pytest.mark.parametrize("kinds", CHAINS, ids="-".join)
def test_chains_start_where_all_bodies_are_guessed(
    kinds: tuple[str, ...], free: bool, closed: bool
) -> None:
    """Closed by a rod too. A screw is turns away, and only its body's place says so.

    A body whose G is near its axis weighs much: others are missed by more than one error.
    """
    for k in range(8):
        seed = [CHAINS.index(kinds), free, closed, k]
        assert most_missed(seed, kinds, free, closed=closed) < 1e-10, k
        assert most_missed(seed, kinds, free, 1.0, 1e-4, closed) < 5e-3, k


@pytest.mark.parametrize("error", [1e-2, 1e-1])
def test_coarse_guesses_find_the_turn_of_a_screw(error: float) -> None:
    """A pitch of 0.3 m: an error of 0.1 m or rad is less than what half a turn moves."""
    for k in range(6):
        assert most_missed([k], (SCREW,), False, 1.0, error) < 5 * error


@pytest.mark.parametrize("name", ["screw_in_a_loop", "slide_of_two"])
def test_two_bodies_start_at_poses_that_agree_to_rounding(name: str) -> None:
    """One quaternion is guessed as the opposite of what the other one and the joint give."""
    path = Path(__file__).with_name(f"{name}.frot")
    given = dict(re.findall(r"parameter \w+ (\w+) = ([-+.e\d]+)", path.read_text()))
    start = frot.load(path).simulate()
    for body in ("b0", "b1") if name == "screw_in_a_loop" else ("b2", "b3"):
        place = [float(given[f"{x}0_{body}"]) for x in "xyz"]
        turn = np.array([float(given[f"q{k}_{body}"]) for k in range(1, 5)])
        found = np.array([start[f"{body}.orientation[{k}]"][0] for k in range(1, 5)])
        found *= np.sign(found @ turn)
        assert [start[f"{body}.position.{x}"][0] for x in "xyz"] == pytest.approx(place, abs=1e-11)
        assert found == pytest.approx(turn, abs=1e-11)


def test_a_nut_starts_on_its_turn_where_guesses_miss_each_other_by_rounded_digits() -> None:
    """Guesses of four digits: the place is missed by their rounding, not by a turn of 0.354 m."""
    start = frot.compile(NUT).simulate()
    place = [start[f"nut.position.{x}"][0] for x in "xyz"]
    assert place == pytest.approx([-0.118, -0.0435, -0.0002], abs=3e-4)
