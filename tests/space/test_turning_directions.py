"""Directions of liaisons and of frames that time turns, and what is read where nothing touches."""

import numpy as np
import pytest

import frot

# The axis n leans by atan(1/2) from z and goes round it; `far` turns so that its z axis is n.
TEXT = """
model Turning "Liaisons along n(time), and the same along the z axes of frames that lean with it"
  parameter AngularVelocity w = 1.3 rad/s;
  parameter Angle lean = atan(0.5);
  frame g on ground at (0.1, 0.2, 0.3) m;
  frame leaning on g rotated(axis = (-cos(w*time), sin(w*time), 0), angle = lean);
  frame first on g rotated(axis = z, angle = -w*time);
  frame second on first rotated(axis = (-1, 0, 0), angle = lean);
  frame third on second rotated(axis = z, angle = w*time);
  frame out on leaning at (1, 2, 3) m;
  frame out_by_three on third at (1, 2, 3) m;
{bodies}
  liaison A: rotoide(g, h_a, axis = N);
  liaison A2: verrou(h_a, g, axis = N);
  liaison B: rotoide(leaning, l_b);
  liaison C: helicoidale(g, c, axis = N, pitch = (1 + 0.2*sin(w*time))*1 m);
  liaison D: appui_plan(g, d, normal = N);
  liaison E: appui_plan(leaning, l_e);
  liaison F: prismatique(f, g, axis = N) driven(displacement = 0.1 m*sin(2*time/(1 s)));
  liaison S: prismatique(g, s, axis = N);
  liaison R: rotoide(s, r, axis = N);
  liaison H: helicoidale(g, r, axis = N, pitch = 0.5 m);
  curve hoop on ground: circle(radius = 1 m, normal = (0, 1, 0));
  liaison O: point_courbe(o, hoop);
  output Force pull = A.force;
  output Force pull_b = B.force;
  output Force drives = F.tangential_force;
  output Velocity slides = F.slip;
  output Force holds = O.normal_force;
  output Acceleration apart = norm(out.acceleration - out_by_three.acceleration);
  output Power loss = dot(C.force, c.velocity) + dot(C.torque, c.angular_velocity);
initial
  guess(a.angular_velocity = (0.5, 0.2, 1) rad/s, b.angular_velocity = (0.5, 0.2, 1) rad/s);
  guess(d.angular_velocity = (0, 0.2, 1) rad/s, d.velocity = (0.1, 0.2, 0) m/s);
  guess(e.angular_velocity = (0, 0.2, 1) rad/s, e.velocity = (0.1, 0.2, 0) m/s);
  guess(o.position = (1, 0, 0) m);
  D.x = 0.1 m;
  E.x = 0.1 m;
  D.angle = 0;
  E.angle = 0;
  experiment(stop = 1.5 s, tolerance = 1e-10);
end Turning;
"""
N = "(0.5*sin(w*time), 0.5*cos(w*time), 1)"
LEAN = "rotated(axis = (-cos(w*time), sin(w*time), 0), angle = lean)"
BODIES = "".join(
    f"  body {x}: box(mass = 1 kg, size = (1, 0.7, 0.5) m);\n"
    f"  frame h_{x} on {x} at (0.3, 0.1, 0.2) m;\n  frame l_{x} on h_{x} {LEAN};\n"
    for x in "abcdefsr"
)


@pytest.fixture(scope="module")
def run() -> frot.Result:
    bodies = (
        BODIES.replace("frame l_e on h_e", "frame l_e on e") + "  body o: particle(mass = 1 kg);"
    )
    return frot.compile(TEXT.replace("{bodies}", bodies).replace("= N", f"= {N}")).simulate()


def vectors(run: frot.Result, name: str) -> np.ndarray:
    return np.array([run[f"{name}.{axis}"] for axis in "xyz"])


def test_an_axis_that_turns_is_that_of_a_frame_that_turns(run: frot.Result) -> None:
    """By Rodrigues' formula for a moving axis, and by three turns about axes that stay."""
    assert np.abs(run["apart"]).max() < 1e-13
    for x, y in ("ab", "de"):
        apart = vectors(run, f"{x}.position") - vectors(run, f"{y}.position")
        assert np.abs(apart).max() < 1e-9, x
    assert np.abs(vectors(run, "pull") - vectors(run, "pull_b")).max() < 1e-8
    assert np.ptp(run["a.position.x"]) > 0.1
    assert np.ptp(run["d.position.x"]) > 0.1


def test_what_closes_a_loop_along_a_turning_axis_counts_the_same(run: frot.Result) -> None:
    assert np.abs(run["A.angle"] + run["A2.angle"]).max() < 1e-12
    assert np.abs(run["H.angle"] - run["R.angle"]).max() < 1e-10
    assert np.abs(run["S.displacement"] - 0.5 * run["H.angle"] / (2 * np.pi)).max() < 1e-10
    assert np.ptp(run["H.angle"]) > 1


def test_slip_and_tangential_force_are_those_along_the_ways_of_a_liaison(run: frot.Result) -> None:
    """Of a on b: f drives the ground; what holds a bead on a hoop is across it, at full size."""
    t = run.time
    n = np.array([0.5 * np.sin(1.3 * t), 0.5 * np.cos(1.3 * t), np.ones_like(t)]) / np.sqrt(1.25)
    along = np.sum(vectors(run, "slides") * n, 0)
    assert np.abs(along - 0.2 * np.cos(2 * t)).max() < 1e-10
    push, across = np.sum(vectors(run, "drives") * n, 0), np.cross(vectors(run, "drives").T, n.T)
    assert np.abs(across).max() < 1e-10
    need = vectors(run, "f.acceleration") + np.array([[0.0], [0.0], [9.81]])
    assert np.abs(push + np.sum(need * n, 0)).max() < 1e-9
    out = vectors(run, "o.position")
    held = np.sum(vectors(run, "o.acceleration") * out, 0) + 9.81 * out[2]
    assert np.abs(run["holds"] - np.abs(held)).max() < 1e-9


def test_a_pitch_that_changes_is_an_advance_that_changes(run: frot.Result) -> None:
    """The weight moves the screw; where the pitch stands its reaction does no work."""
    t = run.time
    advance = (1 + 0.2 * np.sin(1.3 * t)) * run["C.angle"] / (2 * np.pi)
    n = np.array([0.5 * np.sin(1.3 * t), 0.5 * np.cos(1.3 * t), np.ones_like(t)]) / np.sqrt(1.25)
    way = vectors(run, "c.position") - np.array([[0.1], [0.2], [0.3]])
    assert np.abs(way - advance * n).max() < 1e-12
