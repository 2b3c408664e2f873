"""Guesses of speeds that follow from several: met where they can be, else missed the least."""

from __future__ import annotations

import numpy as np
import pytest

import frot

ROD_A, ROD_B = (1.0, 1.0), (2.0, 0.8)  # mass, length
ANGLES = np.radians([30.0, -50.0])


def start_of(text: str, *names: str) -> np.ndarray:
    """The values of some variables at the start."""
    result = frot.compile(text).simulate(stop=1e-6)
    return np.array([result[name][0] for name in names])


def two_rods(initial: str) -> np.ndarray:
    """The angular velocities of two hinged rods."""
    text = f"""planar model TwoRods
  body a: rod(mass = {ROD_A[0]} kg, length = {ROD_A[1]} m);
  body b: rod(mass = {ROD_B[0]} kg, length = {ROD_B[1]} m);
  liaison A: rotoide(ground, a.start);
  liaison B: rotoide(a.tip, b.start);
initial
  a.angle = {ANGLES[0]} rad; b.angle = {ANGLES[1]} rad;
  {initial}
end TwoRods;"""
    return start_of(text, "a.angular_velocity", "b.angular_velocity")


def slopes() -> tuple[np.ndarray, np.ndarray]:
    """The velocity of b's middle in both angular velocities, and the inertia."""
    (ma, la), (mb, lb) = ROD_A, ROD_B
    beside = np.array([-np.sin(ANGLES), np.cos(ANGLES)])
    velocity = beside * [la, lb / 2]
    own = np.diag([ma * la**2 / 3, mb * lb**2 / 12])
    return velocity, own + mb * velocity.T @ velocity


@pytest.mark.parametrize("wanted", [(1.0, -1.0), (-3.0, 0.5), (0.0, 2e6)])
def test_a_velocity_that_both_angles_can_make_is_met(wanted: tuple[float, float]) -> None:
    found = two_rods(f"guess(b.velocity = ({wanted[0]}, {wanted[1]}) m/s);")
    size = np.abs(wanted).max()
    assert slopes()[0] @ found == pytest.approx(np.array(wanted), abs=1e-12 * size)


def test_one_item_is_met_with_the_least_kinetic_energy() -> None:
    velocity, inertia = slopes()
    found = two_rods("guess(b.velocity.x = 1 m/s);")
    way = np.linalg.solve(inertia, velocity[0])
    assert found == pytest.approx(way / (velocity[0] @ way), rel=1e-12)


def test_what_is_guessed_of_a_coordinate_and_what_is_stated_holds() -> None:
    assert two_rods("guess(B.speed = 2 rad/s);") == pytest.approx([0, 2], abs=1e-14)
    velocity = slopes()[0]
    found = two_rods("a.angular_velocity = 1 rad/s; guess(b.velocity.y = 1 m/s);")
    assert found[0] == 1
    assert velocity[1] @ found == pytest.approx(1, rel=1e-12)


def test_guesses_that_contradict_each_other_are_missed_the_least() -> None:
    """Each vector counts by its own effective mass: that of its items together."""
    velocity, inertia = slopes()
    turn = np.array([[0.0, 1.0]])
    half = np.linalg.inv(np.linalg.cholesky(inertia))
    rows, wanted = [], []
    for row, value in ((velocity, (1.0, 2.0)), (turn, (3.0,))):
        scaled = row @ half.T
        rows.append(scaled / np.linalg.norm(scaled))
        wanted += list(np.array(value) / np.linalg.norm(scaled))
    least = half.T @ np.linalg.lstsq(np.vstack(rows), np.array(wanted), rcond=None)[0]
    found = two_rods("guess(b.velocity = (1, 2) m/s, b.angular_velocity = 3 rad/s);")
    assert found == pytest.approx(least, rel=1e-12)


@pytest.mark.parametrize("seed", range(3))
def test_a_ball_on_a_rotule_turns_by_what_of_its_velocity_is_across(seed: int) -> None:
    """In any direction: omega = r x v / r^2 of the way r from the rotule, without spin about it."""
    rng = np.random.default_rng(seed)
    way, wanted = rng.normal(size=(2, 3))
    text = f"""model Hung
  body b: sphere(mass = 3 kg, radius = 20 cm);
  frame f on b at ({-way[0]}, {-way[1]}, {-way[2]}) m;
  liaison A: spherique(ground, f);
initial
  guess(b.velocity = ({wanted[0]}, {wanted[1]}, {wanted[2]}) m/s);
end Hung;"""
    found = start_of(text, *(f"b.angular_velocity.{x}" for x in "xyz"))
    assert found == pytest.approx(np.cross(way, wanted) / (way @ way), rel=1e-11, abs=1e-11)


def bead(guess: str) -> np.ndarray:
    text = f"""model Bead
  body b: particle(mass = 1 kg);
  curve wire on ground: line(through = (0, 0, 0) m, direction = (0.01, 1, 0));
  liaison on: point_courbe(b, wire);
initial
  guess({guess});
end Bead;"""
    return start_of(text, *(f"b.velocity.{x}" for x in "xyz"))


def test_a_bead_takes_what_of_a_velocity_is_along_its_wire() -> None:
    along = np.array([0.01, 1, 0]) / np.hypot(0.01, 1)
    wanted = np.array([0.6, 0.1, 0.2])
    expected = pytest.approx(along * (along @ wanted), rel=1e-12)
    assert bead("b.velocity = (0.6, 0.1, 0.2) m/s") == expected
    each = "b.velocity.z = 0.2 m/s, b.velocity.x = 0.6 m/s, b.velocity.y = 0.1 m/s"
    assert bead(each) == expected
    # a hundred times faster along the wire it would meet this one
    assert bead("b.velocity.x = 0.6 m/s") == pytest.approx([0, 0, 0])


def test_guesses_where_the_body_comes_to_be_do_not_make_it_fast() -> None:
    """On an ellipse, whose direction at the guessed place is another than where it is put."""
    text = """model OnEllipse
  world(gravity = 0 m/s^2);
  body b: sphere(mass = 1.4 kg, radius = 36 cm);
  curve c on ground: ellipse(a = 76 cm, b = 58 cm);
  frame f on b at (0.0142, -0.0464, 0.3592) m;
  liaison A: point_courbe(f, c);
initial
  guess(b.position = (0.679, -0.77, 0.768) m, b.velocity.x = 0.606 m/s);
  guess(b.angular_velocity.y = -1.477 rad/s, b.angular_velocity.z = 1.838 rad/s);
  experiment(stop = 0.3 s);
end OnEllipse;"""
    result = frot.compile(text).simulate()
    guessed = 0.5 * 1.4 * (0.606**2 + 0.4 * 0.36**2 * (1.477**2 + 1.838**2))
    assert result["b.kinetic_energy"][0] < 4 * guessed
    assert result.figures.steps < 100
