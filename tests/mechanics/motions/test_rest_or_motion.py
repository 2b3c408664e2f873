"""States at rest of which rest and motion are both admissible, as friction holds a self-stress.

P. Painlevé 1895, p. 94: two points on parallel rough lines are joined by a rod at the angle alpha,
and drawn by equal forces F along the lines. The rod bears R, so that the points rest if
|F + R cos alpha| <= f |R| sin alpha and |F - R cos alpha| <= f |R| sin alpha: some R serves if and
only if f sin alpha > cos alpha. With R = 0 there is no friction, and the points move with F/m.
"""

from __future__ import annotations

import functools
import math

import numpy as np
import pytest

import frot


@functools.cache
def lines(choice: str) -> frot.Model:
    return frot.compile(f"""
planar model ParallelLines
  world(gravity = 0 m/s^2);
  parameter Real f = 1.2;
  parameter Angle alpha = 45 deg;
  parameter Angle tilt = 0;
  parameter Mass scale = 1 kg;
  parameter Acceleration pull = 1 m/s^2;
  body M:  particle(mass = scale);
  body M1: particle(mass = scale);
  curve ox on ground: line(through = (0, 0) m, direction = (cos(tilt), sin(tilt)));
  curve pq on ground: line(through = (-sin(alpha)*sin(tilt)*1 m, sin(alpha)*cos(tilt)*1 m),
                           direction = (cos(tilt), sin(tilt)));
  liaison low:  point_courbe(M,  ox) with coulomb(f);
  liaison high: point_courbe(M1, pq) with coulomb(f);
  liaison bar:  tige(M, M1, length = 1 m);
  force one: on(M,  value = scale*pull*(cos(tilt), sin(tilt)));
  force two: on(M1, value = scale*pull*(cos(tilt), sin(tilt)));
initial
  M.position = (0, 0) m;
  M1.position = (cos(alpha + tilt)*1 m, sin(alpha + tilt)*1 m);
  experiment(stop = 1 s, tolerance = 1e-9, on_indeterminate = {choice});
end ParallelLines;
""")


SETTINGS = [
    {"tilt": tilt, "scale": scale, "pull": pull, "alpha": alpha}
    for tilt, scale, pull, alpha in (
        (0.0, 1.0, 1.0, math.pi / 4),
        (0.0, 1.0, -1.0, math.pi / 4),
        (2.1, 1e6, 1.0, 1.1),
        (-1.3, 1e-6, 3.0, math.pi - 1.0),
    )
]


def limit_of(setting: dict[str, float]) -> float:
    """The coefficient above which friction holds a self-stress of the rod."""
    return abs(1 / math.tan(setting["alpha"]))


@pytest.mark.parametrize("setting", SETTINGS)
def test_rest_and_motion_are_both_reported(setting: dict[str, float]) -> None:
    values = {**setting, "f": 1.05 * limit_of(setting)}
    with pytest.raises(frot.FrotError, match="2 motions are admissible"):
        lines("stop").simulate(parameters=values)


@pytest.mark.parametrize("setting", SETTINGS)
def test_the_points_rest_where_a_self_stress_holds_them(setting: dict[str, float]) -> None:
    result = lines("rest").simulate(parameters={**setting, "f": 1.05 * limit_of(setting)})
    assert {e.kind for e in result.events} == {"several"}
    for name in ("M", "M1"):
        assert np.all(result[f"{name}.velocity.x"] == 0)
        assert np.all(result[f"{name}.velocity.y"] == 0)
    assert np.all(np.abs(result["low.force.x"]) > 0)


@pytest.mark.parametrize("setting", SETTINGS)
def test_the_points_move_where_no_self_stress_holds_them(setting: dict[str, float]) -> None:
    """Below the limit motion alone is admissible: without a force of the rod, as if it were not."""
    result = lines("stop").simulate(parameters={**setting, "f": 0.95 * limit_of(setting)})
    assert result.events == ()
    way = setting["pull"] / 2
    assert result["M.position.x"][-1] == pytest.approx(way * math.cos(setting["tilt"]), rel=1e-9)
    assert result["M.position.y"][-1] == pytest.approx(
        way * math.sin(setting["tilt"]), rel=1e-9, abs=1e-12
    )


@functools.cache
def slider(choice: str) -> frot.Model:
    return frot.compile(f"""
planar model SlipOrRest
  world(gravity = 0 m/s^2);
  parameter Real f = 1.2;
  parameter Angle tilt = 0;
  parameter Real grows = 1;
  body M:  particle(mass = 1 kg);
  body M1: particle(mass = 1 kg);
  curve ox on ground: line(through = (0, 0) m, direction = (cos(tilt), sin(tilt)));
  curve pq on ground: line(through = (-sqrt(0.5)*sin(tilt)*1 m, sqrt(0.5)*cos(tilt)*1 m),
                           direction = (cos(tilt), sin(tilt)));
  liaison low:  point_courbe(M,  ox) with coulomb(f);
  liaison high: point_courbe(M1, pq) with coulomb(f);
  liaison bar:  tige(M, M1, length = 1 m);
  force one: on(M,  value = (1 N + grows*time*1 N/(1 s))*(cos(tilt), sin(tilt)));
  force two: on(M1, value = (1 N + grows*time*1 N/(1 s))*(cos(tilt), sin(tilt)));
initial
  M.position = (0, 0) m;
  M1.position = (cos(tilt + 45 deg)*1 m, sin(tilt + 45 deg)*1 m);
  experiment(stop = 2 s, tolerance = 1e-9, on_indeterminate = {choice});
end SlipOrRest;
""")


@pytest.mark.parametrize("grows", [-0.25, 0.0, 1.0, 10.0])
@pytest.mark.parametrize("tilt", [0.0, 2.5])
def test_a_self_stress_grows_with_the_load_that_it_holds(grows: float, tilt: float) -> None:
    """Any load is held by a self-stress in proportion to it; the reactions are within the cone."""
    result = slider("rest").simulate(parameters={"grows": grows, "tilt": tilt})
    assert {e.kind for e in result.events} <= {"several"}
    assert np.all(result["M.velocity.x"] == 0)
    at = result.at(np.linspace(0, 2, 21))
    for name in ("low", "high"):
        x, y = at[f"{name}.force.x"], at[f"{name}.force.y"]
        along = x * math.cos(tilt) + y * math.sin(tilt)
        across = y * math.cos(tilt) - x * math.sin(tilt)
        assert np.all(np.abs(along) <= 1.2 * np.abs(across) * (1 + 1e-9))


@functools.cache
def rails() -> frot.Model:
    """A bar on three rails that cannot part, two rough, one smooth: the normal reactions have a
    self-stress (+, -, +) of any size, so that friction holds any load."""
    return frot.compile("""
planar model ThreeRails
  world(gravity = 0 m/s^2);
  parameter Angle tilt = 0;
  parameter Mass scale = 2 kg;
  parameter Real way = -1;
  parameter Acceleration g = 9.81 m/s^2;
  curve r0 on ground: line(through = (0.6*sin(tilt), -0.6*cos(tilt)) m,
                           direction = (cos(tilt), sin(tilt)));
  curve r1 on ground: line(through = (-0.4*sin(tilt), 0.4*cos(tilt)) m,
                           direction = (cos(tilt), sin(tilt)));
  curve r2 on ground: line(through = (0, 0) m, direction = (cos(tilt), sin(tilt)));
  body bar: rod(mass = scale, length = 2 m);
  frame low on bar at (-0.5, -0.6) m;
  frame high on bar at (0.5, 0.4) m;
  frame last on bar at (1, 0) m;
  liaison c0: contact_ponctuel(r0, low, unilateral = false) with coulomb(0.55);
  liaison c1: contact_ponctuel(r1, high, unilateral = false) with coulomb(0.17);
  liaison c2: contact_ponctuel(r2, last, unilateral = false);
  parameter Acceleration a = 5 m/s^2;
  Real s = time/(1 s);
  force down: on(bar, value = scale*g*(sin(tilt), -cos(tilt)));
  force along: on(bar, value = 2*scale*a*way*s*(cos(tilt), sin(tilt)));
  force across: on(bar, value = scale*a*s*(-sin(tilt), cos(tilt)));
initial
  bar.position = (0, 0) m;
  bar.angle = tilt;
  experiment(stop = 2.5 s, tolerance = 1e-7);
end ThreeRails;
""")


@pytest.mark.parametrize("way", [-1.0, 1.0])
@pytest.mark.parametrize(("tilt", "scale"), [(0.0, 2.0), (1.3, 2e6), (-2.2, 2e-6)])
def test_a_self_stress_keeps_a_bar_on_three_rails_at_rest(
    tilt: float, scale: float, way: float
) -> None:
    result = rails().simulate(parameters={"tilt": tilt, "scale": scale, "way": way})
    assert {e.kind for e in result.events} <= {"reaction"}
    assert np.all(result["bar.velocity.x"] == 0)
    assert np.all(result["bar.velocity.y"] == 0)
    at = result.at(np.linspace(0, 2.5, 51))
    for name, mu in (("c0", 0.55), ("c1", 0.17), ("c2", 0.0)):
        x, y = at[f"{name}.force.x"], at[f"{name}.force.y"]
        along = x * math.cos(tilt) + y * math.sin(tilt)
        across = y * math.cos(tilt) - x * math.sin(tilt)
        slack = 1e-9 * scale * 30
        assert np.all(np.abs(along) <= mu * np.abs(across) * (1 + 1e-9) + slack)
