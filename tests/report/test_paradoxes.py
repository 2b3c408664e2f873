"""Coefficients from which friction may leave no motion, against Painlevé's own."""

import math
import warnings

import numpy as np
import pytest
from frot.compiler.report.friction_coupling import SlidingLaw
from frot.compiler.report.numeric_dynamics import State

import frot

ROD = """
planar model Rod "Painlevé 1895, p. 99: one end of a rod on a rough line"
  body rod: rod(mass = 1 kg, length = 2 m);
  liaison foot: contact_ponctuel(ground.line, rod.start) with coulomb(0.5);
initial
  rod.start.position = (0, 0) m;
  rod.angle = 1.1 rad;
end Rod;
"""
DUMBBELL = """
planar model Dumbbell "Painlevé 1895, p. 13-16: two points on a rod, one on a rough line"
  body a: particle(mass = 1 kg);
  body b: particle(mass = 1 kg);
  liaison line: point_courbe(a, ground.line) with coulomb(0.5);
  liaison bar: tige(a, b, length = 1 m);
initial
  a.position.x = 0 m;
  b.position = (0.6, 0.8) m;
end Dumbbell;
"""
PENDULUM = """
planar model Pendulum "The friction couple changes the reaction of the pin by h m/(I + m h^2)"
  body rod: rod(mass = 1 kg, length = 2 m);
  liaison pin: rotoide(ground, rod.start) with coulomb(0.1, radius = 20 cm);
end Pendulum;
"""


def test_a_rod_and_a_dumbbell_from_four_thirds_and_from_the_root_of_eight() -> None:
    """At an angle: (1 + 3 cos^2)/(3 sin cos), and (1 + cos^2)/(sin cos); the least over all."""
    (rod,) = frot.compile(ROD).report().analysis.paradoxes
    s, c = np.sin(1.1), np.cos(1.1)
    assert rod.at_start == pytest.approx((1 + 3 * c * c) / (3 * s * c), rel=1e-12)
    assert rod.least == pytest.approx(4 / 3, rel=1e-5)
    # upright is where the rod stands at the cotangent of one half
    ((name, angle),) = rod.where
    assert name == "rod.angle" and abs(np.tan(angle)) == pytest.approx(2, rel=1e-2)
    (bar,) = frot.compile(DUMBBELL).report().analysis.paradoxes
    assert bar.at_start == pytest.approx((1 + 0.36) / (0.6 * 0.8), rel=1e-12)
    assert bar.least == pytest.approx(np.sqrt(8), rel=1e-5)
    assert (rod.mu, bar.mu) == (0.5, 0.5)


def test_a_pin_counts_with_its_radius() -> None:
    """C acts on the rod alone: R changes by m h C/I about the end, I = m (2 h)^2/3, h = 1 m."""
    report = frot.compile(PENDULUM).report()
    (pin,) = report.analysis.paradoxes
    assert pin.at_start == pytest.approx(4 / 3 / 0.2, rel=1e-12)
    assert "pin from mu = 6.667 at the start" in str(report)


def test_where_friction_does_not_change_its_reaction_there_is_no_paradox() -> None:
    text = """
planar model Hoop "The friction of a hoop turns it, and does not lift it"
  body hoop: ring(mass = 1 kg, radius = 0.5 m);
  liaison floor: contact_ponctuel(ground.line, hoop.rim) with coulomb(3);
initial
  hoop.position = (0, 0.5) m;
end Hoop;
"""
    assert frot.compile(text).report().analysis.paradoxes == ()


def test_where_the_place_is_followed_too() -> None:
    """An elliptic disc on a curve is, in each posture, one on the tangent there."""
    text = """
planar model Discs "The same on a line and on an ellipse"
  body p: ellipse(mass = 1 kg, a = 50 cm, b = 10 cm);
  body q: ellipse(mass = 1 kg, a = 50 cm, b = 10 cm);
  curve hill on ground: ellipse(a = 5 m, b = 3 m, centre = (20, -3) m);
  liaison C: contact_ponctuel(hill, p.rim) with coulomb(0.3);
  liaison D: contact_ponctuel(ground.line, q.rim) with coulomb(0.3);
initial
  p.position.x = 20 m;
  guess(p.position.y = 0.4 m);
  p.angle = 0;
  C.gap = 0 m;
  q.position.x = 0 m;
  q.angle = 0.9;
  D.gap = 0 m;
end Discs;
"""
    hill, line = frot.compile(text).report().analysis.paradoxes
    # N = N0 + c f with c = x y m/(I + m x^2), where the place of touch is (x, -y) from G
    s, c = np.sin(0.9), np.cos(0.9)
    y = np.sqrt(0.25 * s * s + 0.01 * c * c)
    x = 0.24 * s * c / y
    inertia = (0.25 + 0.01) / 4
    assert line.at_start == pytest.approx((inertia + x * x) / (x * y), rel=1e-9)
    assert hill.at_start is None
    assert hill.least == pytest.approx(line.least, rel=1e-5)


def test_numbers_beyond_all_others_leave_no_warning_of_numpy() -> None:
    """What loads of infinite size do is not asked."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        frot.compile("""
planar model Huge
  body b: box(mass = 1e308 kg, size = (1, 1) m);
  liaison l: contact_ponctuel(ground.line, b.corners[1]) with coulomb(1e300);
  liaison k: contact_ponctuel(ground.line, b.corners[2]) with coulomb(0.3);
initial
  l.gap = 0 m;
  k.gap = 0 m;
end Huge;
""").report()


@pytest.mark.parametrize("far", ["1e4", "1e6", "1e9"])
def test_a_coupling_that_grows_with_the_distance_has_no_worst_posture(
    far: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A block whose one corner is far away, turned by a = -pi/6 on a slope of 30 degrees.

    N = N0 + c f, where c = x y m/(I + m x^2) of the corner's place (x, y) from G along the line and
    its normal; here (w/2, -d) of the block, whose I = m(w^2 + h^2)/12. The other liaison is open.
    """
    tried = []
    coupling = SlidingLaw.coupling

    def counted(self: SlidingLaw, state: State) -> float | None:
        tried.append(state)
        if len(tried) > 5000:
            pytest.fail("the search goes on")
        return coupling(self, state)

    monkeypatch.setattr(SlidingLaw, "coupling", counted)
    report = frot.compile(f"""
planar model FarCorner
  parameter Angle slope = 30 deg;
  body block: box(mass = 2 kg, size = (0.4, 1) m);
  frame lower on block at (0.2, -{far}) m;
  frame upper on block at (-0.2, -0.5) m;
  curve incline on ground: line(through = (0, 0) m, direction = (cos(slope), -sin(slope)));
  liaison front: contact_ponctuel(incline, lower) with coulomb(0.3);
  liaison back: contact_ponctuel(incline, upper) with coulomb(0.3);
initial
  block.position = (0.5*sin(slope), 0.5*cos(slope))*(1 m);
  block.angle = -slope;
end FarCorner;
""").report()
    front, back = report.analysis.paradoxes
    assert "front from a mu that decreases with the posture" in str(report)
    inertia = (0.4**2 + 1) / 12
    assert (front.at_start, front.least) == (None, None)  # at the start it is far inside
    # The largest x y/(I + x^2) of x^2 + y^2 = r^2, at any turn of the block.
    square = 0.04 + 0.25
    assert back.least == pytest.approx(2 * np.sqrt(inertia * (inertia + square)) / square, rel=1e-5)


PARALLEL_LINES = """
planar model ParallelLines "Two points joined by a massless rod on two parallel rough lines"
  parameter Real mu  = 1.2;
  parameter Real mu1 = 0.3;
  parameter Angle alpha = 1.2 rad;
  parameter Length rod = 1 m;
  parameter Velocity v0 = 1 m/s;

  world(gravity = 0 m/s^2);
  body M:  particle(mass = 1 kg);
  body M1: particle(mass = 1 kg);
  curve ox on ground: line(through = (0, 0) m, direction = (1, 0));
  curve pq on ground: line(through = (0 m, rod*sin(alpha)), direction = (1, 0));
  liaison low:  point_courbe(M,  ox) with coulomb(mu);
  liaison high: point_courbe(M1, pq) with coulomb(mu1);
  liaison bar:  tige(M, M1, length = rod);
  force f:  on(M,  value = (2, 0) N);
  force f1: on(M1, value = (1, 0) N);

initial
  M.position = (0, 0) m;
  M1.position = (rod*cos(alpha), rod*sin(alpha));
  M.velocity = (v0, 0 m/s);

  experiment(stop = 0.5 s, on_indeterminate = stop, on_impasse = stop);
end ParallelLines;
"""


@pytest.mark.parametrize("mu1", [0.0, 0.3, 1.0])
def test_parallel_lines_from_the_difference_of_their_coefficients(mu1: float) -> None:
    """Painlevé 1895, p. 36, 93: mu - mu1 > 2 cot alpha; below that none."""
    text = PARALLEL_LINES.replace("mu1 = 0.3", f"mu1 = {mu1}")
    threshold = mu1 + 2 / math.tan(1.2)
    assert f"low from mu = {threshold:.4g} at the start" in str(frot.compile(text).report())
