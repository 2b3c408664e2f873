"""Points and rims on curves of the plane, with friction and without, still and moving."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import frot

CYCLOID = """
planar model Cycloid "Heavy bead on a cycloid s = 4 R sin(u)"
  parameter Length R = 1 m;
  parameter Real mu = 0.2;
  parameter Angle start = 1.2;
  body bead: particle(mass = 1 kg);
  curve arch on ground: parametric((R*(2*u + sin(2*u)), R*(1 - cos(2*u))), u = (-pi/2, pi/2));
  liaison wire: point_courbe(bead, arch) with coulomb(mu);
initial
  wire.u = start;
  experiment(stop = 4 s, tolerance = 1e-11);
end Cycloid;
"""


def test_the_first_rest_on_a_rough_cycloid_does_not_depend_on_the_start() -> None:
    """Painlevé (1895, p. 60): the half swing lasts pi sqrt(4 R/g) cos(phi), tan(phi) = mu."""
    model = frot.compile(CYCLOID)
    for start in (1.2, 0.7):
        result = model.simulate(parameters={"start": start})
        half = np.pi * np.sqrt(4 / 9.81) * np.cos(np.arctan(0.2))
        assert result.events[0].time == pytest.approx(half, abs=1e-9)
    smooth = model.simulate(parameters={"mu": 0, "start": 0.9})
    for t in (0.7, 2.9):
        want = np.arcsin(np.sin(0.9) * np.cos(np.sqrt(9.81 / 4) * t))
        assert smooth.at(t)["wire.u"] == pytest.approx(want, abs=1e-10)


def test_a_bead_on_a_rough_circle_that_grows() -> None:
    """Painlevé (1895, p. 64): with w = 1/theta', w' = 2 w/t + mu."""
    result = frot.compile(
        """
planar model Growing "Each element of the circle moves along its radius"
  parameter Velocity K = 1 m/s;
  world(gravity = 0 m/s^2);
  body bead: particle(mass = 1 kg);
  curve circle on ground: parametric((K*time*cos(u), K*time*sin(u)), u = (0, 2*pi));
  liaison wire: point_courbe(bead, circle) with coulomb(0.3);
initial
  wire.u = 0;
  der(wire.u) = 2 1/s;
  experiment(start = 1 s, stop = 3 s, tolerance = 1e-11);
end Growing;
"""
    ).simulate()
    assert result.at(3)["wire.u"] == pytest.approx(np.log(1.4) / 0.3, abs=1e-11)
    # normal force: m r theta'^2 towards the centre, which is on the left
    assert result.at(3)["wire.normal_force"] == pytest.approx(3 * (10 / 63) ** 2, abs=1e-10)


def test_an_elliptic_disc_slides_as_its_own_equations_say() -> None:
    """Height h(q), contact beside G by -h'(q): two equations in x and q."""
    a, b, mu = 1.0, 0.6, 0.2

    def rate(t: float, y: np.ndarray) -> list[float]:
        q, w, v = y[1], y[3], y[2]
        h = np.sqrt((a * np.sin(q)) ** 2 + (b * np.cos(q)) ** 2)
        h1 = (a**2 - b**2) * np.sin(2 * q) / (2 * h)
        h2 = (a**2 - b**2) * np.cos(2 * q) / h - h1**2 / h
        arm = -h1 - mu * h * np.sign(v + h * w)
        inertia = (a**2 + b**2) / 4
        turn = (9.81 + h2 * w**2) * arm / (inertia - h1 * arm)
        normal = 9.81 + h2 * w**2 + h1 * turn
        return [v, w, -mu * normal * np.sign(v + h * w), turn]

    want = solve_ivp(rate, (0, 0.7), [0, 0.3, 3, 0.5], method="DOP853", rtol=1e-13, atol=1e-14)
    result = frot.compile(
        """
planar model Disc "Elliptic disc on a rough line"
  parameter Boolean kept = true;
  body disc: ellipse(mass = 1 kg, a = 1 m, b = 0.6 m);
  liaison floor: contact_ponctuel(ground.line, disc.rim, unilateral = not kept) with coulomb(0.2);
initial
  disc.angle = 0.3;
  disc.angular_velocity = 0.5 rad/s;
  disc.position.x = 0 m;
  disc.velocity.x = 3 m/s;
  experiment(stop = 0.7 s, tolerance = 1e-12);
end Disc;
"""
    ).simulate()
    at = result.at(0.7)
    assert [at["disc.position.x"], at["disc.angle"]] == pytest.approx(want.y[:2, -1], abs=1e-10)
    assert np.abs(result["floor.gap"]).max() < 1e-13


ROUND = """
planar model Round "Three ways round"
  body bar: rod(mass = 1 kg, length = 1.5 m);
  body rod: rod(mass = 1 kg, length = 1.5 m);
  body hoop: ring(mass = 1 kg, radius = 0.2 m);
  body puck: disc(mass = 1 kg, radius = 0.2 m);
  curve track on ground: line(through = (0, 0) m, direction = (1, 0));
  curve circle on ground: circle(radius = 0.5 m);
  curve bowl on ground: circle(radius = 1.2 m);
  liaison A: point_courbe(bar.start, track);
  liaison B: point_courbe(bar.tip, circle);
  liaison C: point_courbe(rod.start, track);
  liaison D: tige(ground, rod.tip, length = 0.5 m);
  liaison E: roulement(bowl, hoop.rim);
  liaison F: contact_ponctuel(bowl, puck.rim) with coulomb(0.3);
  output Force b = B.normal_force; output Force d = D.normal_force; output Force e = E.force.x;
initial
  bar.tip.position = (0.3, 0.4) m;
  rod.tip.position = (0.3, 0.4) m;
  guess(bar.tip.position = (0.3, 0.4) m, bar.start.position = (-1, 0) m);
  guess(rod.tip.position = (0.3, 0.4) m, rod.start.position = (-1, 0) m);
  hoop.position = (1, 0) m;
  puck.position = (0, -1) m;
  puck.velocity = (2, 0) m/s;
  experiment(stop = 1.5 s, tolerance = 1e-11);
end Round;
"""


def test_circles_hold_as_rods_do_and_hoops_roll_in_them() -> None:
    """A hoop that rolls in a bowl: 2 (R - r) q'' = -g sin(q)."""
    result = frot.compile(ROUND).simulate()
    for t in (0.0, 0.4, 1.5):
        at = result.at(t)
        assert at["bar.position.x"] == pytest.approx(at["rod.position.x"], abs=1e-9)
        # the left of a circle is its inside: there the reaction is positive where it pulls
        assert abs(at["b"]) == pytest.approx(at["d"], abs=1e-7)

    def rate(t: float, y: np.ndarray) -> list[float]:
        return [y[1], -9.81 * np.sin(y[0]) / 2]

    want = solve_ivp(rate, (0, 1.5), [np.pi / 2, 0], method="DOP853", rtol=1e-13, atol=1e-14)
    q = want.y[0, -1]
    at = result.at(1.5)
    assert at["hoop.position.x"] == pytest.approx(np.sin(q), abs=1e-9)
    assert at["hoop.angle"] == pytest.approx(-(q - np.pi / 2) * 1.0 / 0.2, abs=1e-8)
    away = np.hypot(result["puck.position.x"], result["puck.position.y"])
    assert np.abs(away - 1).max() < 1e-12
    assert "stick" in {event.after for event in result.events if event.liaison == "F"}
