"""Reactions that friction drives towards a pole, and what is left of digits there.

A wheel that cannot leave its rough line carries a far heavier load beyond its rim. Where it slips,
friction helps the load to turn it to where the reaction has a pole (of such: F. Génot,
B. Brogliato, Eur. J. Mech. A 18, 1999, p. 653); it bounces off, the nearer the faster it comes,
exponentially in the square of its speed. The values are those of the two equations of motion in
sixty digits (extrapolated midpoint rule, errors of 1e-22 a step).
"""

import pytest

import frot

WHEEL = frot.compile(
    """
planar model Pole
  parameter Mass heavy = 23200 kg;
  parameter Angle a = 1.33136 rad;
  parameter Length r = 0.33924 m;
  body wheel: ring(mass = 1 kg, radius = r);
  body load: particle(mass = heavy);
  frame far on wheel at (0.32636 m, 0.53261 m);
  curve slope on ground: line(through = (0 m, 0 m), direction = (cos(a), sin(a)));
  liaison floor: contact_ponctuel(wheel.rim, slope, unilateral = false) with coulomb(0.14574);
  liaison pin: rotoide(load, far);
initial
  wheel.position = (-r*sin(a), r*cos(a));
  wheel.velocity = (0.0764 m/s*cos(a), 0.0764 m/s*sin(a));
  wheel.angle = -1.36465 rad;
  wheel.angular_velocity = -1.96495 rad/s;
  experiment(stop = 0.15 s, tolerance = 1e-9);
end Pole;
"""
)
TOLERANCES = [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-12, 1e-13]


@pytest.mark.parametrize("tolerance", TOLERANCES)
def test_it_ends_where_rounding_decides_the_motion(tolerance: float) -> None:
    """The reaction passes 4e30 N: no angle in double precision is so near the pole."""
    with pytest.raises(frot.SimulationError, match=r"E0901.*'floor'.*reaction grows") as stop:
        WHEEL.simulate(tolerance=tolerance)
    result = stop.value.result
    assert result is not None
    assert result.time[-1] == pytest.approx(0.12499661458026843, abs=1e-3 * tolerance + 1e-12)


@pytest.mark.parametrize("tolerance", TOLERANCES)
def test_it_goes_on_where_digits_are_left(tolerance: float) -> None:
    """A lighter load does not come so near: the error follows the tolerance."""
    result = WHEEL.simulate(tolerance=tolerance, parameters={"heavy": 2000})
    assert result["wheel.angle"][-1] == pytest.approx(-1.34190117633974, abs=tolerance + 1e-11)
    speed = result["wheel.angular_velocity"][-1]
    assert speed == pytest.approx(-2.72037523534318, abs=20 * tolerance + 1e-10)
    assert result.figures.blurred < 1e-9
