"""Prescribed coordinates in loops and alone, by switches and inputs; supports that time moves."""

import numpy as np
import pytest

import frot
from tests.space.newton_euler import vector
from tests.space.test_loops import AXES, ring


def test_a_drive_that_closes_a_loop_moves_as_one_in_the_tree() -> None:
    """Six pins and a driven liaison, once last (it is cut), once first (it is built in)."""
    text = ring("rotoide", 7, 6, [f", axis = {a}" for a in AXES])
    plain = next(x for x in text.splitlines() if "liaison J6" in x)
    options = ", axis_a = y, axis_b = z) driven(angle_b = 0.4*cos(2*time/(1 s)) - 0.4);"
    driven = plain.replace("rotoide", "cardan").split(", axis")[0] + options
    driven += " output Real f = J6.force.x/(1 N);"
    names = [f"b{k}.position" for k in range(1, 7)]
    ends = []
    for written in (
        text.replace(plain, driven),
        text.replace(plain, "").replace("  liaison J0", f"{driven}\n  liaison J0"),
    ):
        result = frot.compile(written).simulate(stop=0.5)
        ends.append(np.concatenate([vector(result.at(0.5), n) for n in names]))
        ends[-1] = np.append(ends[-1], result.at(0.5)["f"])
        for t in (0.0, 0.2, 0.5):
            want = 0.4 * (np.cos(2 * t) - 1)
            assert result.at(t)["J6.angle_b"] == pytest.approx(want, abs=1e-11)
    assert ends[0] == pytest.approx(ends[1], abs=1e-8)


def test_what_is_driven_altogether_has_its_couple() -> None:
    """A rod that swings as told: I a = couple + weight, without any freedom left."""
    result = frot.compile(
        """
model Told "A rod whose angle is given"
  parameter AngularVelocity w = 1 rad/s;
  body b: rod(mass = 1 kg, length = 1 m);
  liaison A: rotoide(ground, b.start, axis = y) driven(angle = sin(w*time));
  output Torque drive = A.torque.y;
  experiment(stop = 2 s, tolerance = 1e-11);
end Told;
"""
    ).simulate(parameters={"w": 1.5})
    for t in (0.0, 0.8, 2.0):
        angle = np.sin(1.5 * t)
        want = -(1.5**2) * angle / 3 - 9.81 * 0.5 * np.cos(angle)
        assert result.at(t)["drive"] == pytest.approx(want, abs=1e-12)


def test_a_bead_on_a_line_that_time_turns() -> None:
    """Painlevé (1895, p. 65) without friction: r'' = (w sin(a))^2 r."""
    result = frot.compile(
        """
model Turning "Bead on a line about Oz"
  parameter AngularVelocity w = 2 rad/s;
  world(gravity = 0 m/s^2);
  body b: particle(mass = 1 kg);
  frame f on ground rotated(axis = z, angle = w*time);
  frame g on f rotated(axis = y, angle = 0.5 rad);
  liaison A: prismatique(g, b, axis = z);
initial
  A.displacement = 1 m;
  A.speed = 0.1 m/s;
  experiment(stop = 2 s, tolerance = 1e-11);
end Turning;
"""
    ).simulate()
    k = 2 * np.sin(0.5)
    want = np.cosh(2 * k) + 0.1 / k * np.sinh(2 * k)
    assert result["A.displacement"][-1] == pytest.approx(want, abs=1e-10)


def test_what_cannot_be_driven_is_told() -> None:
    text = """
model Wrong "A drive"
  body b: rod(mass = 1 kg, length = 1 m);
  liaison A: rotoide(ground, b.start, axis = y) driven({drive});
end Wrong;
"""
    for drive, said in (
        ("angle = 1, angle = 2", "driven twice"),
        ("way = 1", "not a coordinate"),
    ):
        with pytest.raises(frot.FrotError, match=said):
            frot.compile(text.format(drive=drive)).report()


FOLLOWS = """
planar model Follows "Drives by an input, by another motion, by a switch"
  input Real target(start = 0.2);
  parameter AngularVelocity jump = 0 rad/s;
  body a: rod(mass = 1 kg, length = 1 m);
  body b: rod(mass = 1 kg, length = 1 m);
  body c: rod(mass = 1 kg, length = 1 m);
  body d: particle(mass = 2 kg);
  frame f on b at (0.1 m*sin(3*time/(1 s)), 0 m);
  liaison A: rotoide(ground, a.start) driven(angle = target);
  liaison B: rotoide(ground, b.start);
  liaison C: rotoide(ground, c.start) driven(angle = 0.5*B.angle);
  liaison D: point_courbe(d, ground.line)
    driven(u = if time > 0.5 s then 1 m*(time/(1 s) - 0.5)^3 + jump*(time - 0.5 s)*(1 m) else 0 m);
  output Torque holds = A.torque;
  output Torque turns = C.torque;
  output Force pulls = D.tangential_force;
  output Length moved = dot(f.position, b.ex);
  experiment(stop = 1 s, tolerance = 1e-11);
end Follows;
"""


def test_a_drive_follows_inputs_motions_and_switches() -> None:
    """Each couple is I a + m g cos(angle)/2 of its rod; a speed that would jump is told."""
    model = frot.compile(FOLLOWS)
    result = model.simulate()
    t, down = result.time, 0.5 * 9.81
    assert np.abs(result["holds"] - down * np.cos(0.2)).max() < 1e-12
    assert np.abs(result["C.angle"] - 0.5 * result["B.angle"]).max() < 1e-12
    assert np.ptp(result["C.angle"]) > 0.5
    want = result["c.angular_acceleration"] / 3 + down * np.cos(result["C.angle"])
    assert np.abs(result["turns"] - want).max() < 1e-11
    late = np.maximum(t - 0.5, 0)
    assert np.abs(result["D.u"] - late**3).max() < 1e-11
    assert np.abs(result["pulls"] - 12 * late).max() < 1e-9
    assert np.abs(result["moved"] - 0.5 - 0.1 * np.sin(3 * t)).max() < 1e-12
    with pytest.raises(frot.SimulationError, match="a switch moves at once"):
        model.simulate(parameters={"jump": 1.0})


TURNS = """
model Turns "Pins and screws that close loops, in tilted frames"
  parameter Angle tilt = 0.3;
  frame g on ground rotated(axis = (1, 2, 3), angle = tilt);
  frame far on g at (0.5, 0.1, 0) m;
  body wheel: box(mass = 1 kg, size = (1, 1, 1) m);
  frame w on wheel at (0.3, 0.2, 0.1) m rotated(axis = (1, 2, 3), angle = tilt);
  frame v on w at (0.5, 0.1, 0) m;
  liaison A: rotoide(g, w, axis = (1, 0.2, 0));
  liaison B: rotoide(far, v, axis = (1, 0.2, 0));
  body nut: box(mass = 1 kg, size = (1, 1, 1) m);
  frame n on nut rotated(axis = (1, 2, 3), angle = tilt);
  liaison C: verrou(g, n, axis = (1, 0.2, 0)) driven(angle = 7*time/(1 s));
  liaison D: helicoidale(g, n, axis = (1, 0.2, 0), pitch = 0.3 m);
initial
  A.speed = 9 rad/s;
  experiment(stop = 3 s, tolerance = 1e-11);
end Turns;
"""


def test_what_closes_a_loop_counts_its_turns_and_holds_nothing_that_is_free() -> None:
    """Two pins on one shaft, whatever its direction; a screw that goes on for many turns."""
    result = frot.compile(TURNS).simulate()
    assert result["A.angle"][-1] > 20
    assert np.abs(result["A.angle"] - result["B.angle"]).max() < 1e-10
    assert np.abs(result["D.angle"] - 7 * result.time).max() < 1e-10
    assert np.abs(result["C.displacement"] - 0.3 * 7 * result.time / (2 * np.pi)).max() < 1e-10


KEPT_APART = """
planar model Apart "Gaps and lengths by time, by the text and by other motions, in the plane"
  body a: disc(mass = 1 kg, radius = 0.2 m);
  body b: disc(mass = 1 kg, radius = 0.2 m);
  body c: disc(mass = 1 kg, radius = 0.2 m);
  body p: particle(mass = 1 kg);
  body q: particle(mass = 1 kg);
  body s: particle(mass = 1 kg);
  body s2: particle(mass = 2 kg);
  curve bowl on ground: circle(radius = 2 m, centre = (0, 2) m);
  Real x;
  liaison A: contact_ponctuel(a.rim, ground.line) driven(gap = 0.1 m*(2 + sin(3*time/(1 s))));
  liaison B: contact_ponctuel(ground.line, b.rim) driven(gap = 0.1 m*x);
  liaison C: contact_ponctuel(c.rim, bowl) driven(gap = 0.5*A.gap);
  liaison P: tige(ground, p, length = 1 m + 0.1 m*x);
  liaison Q: fil(p, q, length = 1 m + 0.5*p.position.x, unilateral = false);
  liaison S: rotoide(ground, s);
  liaison S2: rotoide(s, s2);
  output Force push_a = A.normal_force;
  output Force push_b = B.normal_force;
  output Velocity slides = B.slip;
  output Force pin = S.force;
initial
  x = 0.5;
  guess(a.position.y = 0.5 m, c.position = (0.3, 0.5) m);
  guess(p.position = (1, 0) m, q.position = (2, 0) m);
  b.velocity.x = 1 m/s;
equation
  der(der(x)) = -4*x*(1 1/s^2);
  experiment(stop = 1 s, tolerance = 1e-10);
end Apart;
"""


def test_gaps_and_lengths_of_the_plane_follow_time_the_text_and_motions() -> None:
    """What keeps apart pushes with m (g + y''); two particles in a pin stay together."""
    run = frot.compile(KEPT_APART).simulate()
    t, x = run.time, run["x"]
    assert np.abs(run["a.position.y"] - 0.4 - 0.1 * np.sin(3 * t)).max() < 1e-12
    assert np.abs(run["push_a"] - 9.81 + 0.9 * np.sin(3 * t)).max() < 1e-11
    assert np.abs(run["b.position.y"] - 0.2 - 0.1 * x).max() < 1e-11
    assert np.abs(run["push_b"] - 9.81 + 0.4 * x).max() < 1e-9
    assert np.abs(np.abs(run["slides"]) - 1).max() < 1e-12
    far = np.hypot(run["c.position.x"], run["c.position.y"] - 2)
    assert np.abs(2 - far - 0.2 - 0.05 * (2 + np.sin(3 * t))).max() < 1e-11
    px, py, qx, qy = (run[f"{b}.position.{k}"] for b in "pq" for k in "xy")
    assert np.abs(np.hypot(px, py) - 1 - 0.1 * x).max() < 1e-11
    assert np.abs(np.hypot(qx - px, qy - py) - 1 - 0.5 * px).max() < 1e-11
    assert np.abs(run["pin.y"] - 3 * 9.81).max() < 1e-12


def test_a_law_of_what_is_kept_apart_is_named() -> None:
    text = KEPT_APART.replace("(2 + sin(3*time/(1 s))));", "2) with coulomb(0.1);")
    with pytest.raises(frot.FrotError, match=r"law 'coulomb' of 'A', whose gap is driven"):
        frot.compile(text).report()


GLIDING = """
model Gliding "A sphere on a plane that a drive carries at a constant speed"
  body base: solid(mass = 1 kg, inertia = (1, 1, 1) kg.m^2);
  liaison glide: prismatique(ground, base, axis = (-0.6, 0.8, 0)) driven(displacement = 2 m/s*time);
  body ball: sphere(mass = 3 kg, radius = 0.3 m);
  surface wall on base: plane(through = (0.2 m, 0.1 m, 0 m), normal = NORMAL);
  liaison kept: contact_ponctuel(wall, ball.surface, unilateral = false);
  experiment(stop = 1 s, tolerance = 1e-9);
end Gliding;
"""


@pytest.mark.parametrize("normal", [(1, 0, 0), (0, -1, 0), (0, 0, 1), (0.6, 0, 0.8)])
def test_a_speed_that_a_constant_drive_gives_is_none_that_is_held_at_zero(
    normal: tuple[float, float, float],
) -> None:
    """The row of a wall that moves by itself is constant and has no acceleration, but a rate."""
    n = np.array(normal)
    result = frot.compile(GLIDING.replace("NORMAL", str(normal))).simulate()
    base, weight = np.array([-1.2, 1.6, 0]), np.array([0, 0, -9.81])
    want = n * (n @ base) + (weight - n * (n @ weight))
    assert vector(result.at(1.0), "ball.velocity") == pytest.approx(want, abs=1e-12)
    assert vector(result.at(1.0), "kept.force") == pytest.approx(-3 * n * (n @ weight), abs=1e-12)
