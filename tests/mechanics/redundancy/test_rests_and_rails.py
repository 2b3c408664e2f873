"""Reactions that are zero or shared: corners, rails, rows of legs, bodies of unlike masses."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding

Finding = Callable[..., frot.Model]
TOLERANCES = [1e-4, 1e-8, 1e-12]


@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize("mu", ["0.13*(1 + 0.3*time/(1 s))", "0"])
def test_a_point_in_a_corner_rests_on_the_floor_alone(
    finding: Finding, mu: str, tolerance: float
) -> None:
    """Nothing holds against a reaction of the slope, since its tangent is above the coefficient."""
    changes = {"0.13*(1 + 0.3*time/(1 s))": mu}
    result = finding("corner", changes).simulate(tolerance=tolerance)
    assert not result.events and result.time[-1] == 2
    assert np.abs(result["J0.normal_force"]).max() < 1e-12
    assert np.abs(result["J2.normal_force"] - 9.81).max() < 1e-12
    for axis in "xy":
        assert np.abs(result[f"b.position.{axis}"]).max() < 1e-14


@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize(("heavy", "light"), [("1e5", "1e-9"), ("1e-9", "1e5"), ("1e12", "1e-12")])
def test_blocks_of_unlike_masses_stop_each_at_its_own_time(
    finding: Finding, heavy: str, light: str, tolerance: float
) -> None:
    changes = {
        "u: particle(mass = 1e5 kg)": f"u: particle(mass = {heavy} kg)",
        "w: particle(mass = 1e-9 kg)": f"w: particle(mass = {light} kg)",
    }
    result = finding("mixed_scales", changes).simulate(tolerance=tolerance)
    stops = [1 / (0.3 * 9.81), 2 / (0.2 * 9.81)]
    assert [e.kind for e in result.events] == ["stick", "stick"]
    assert [e.time for e in result.events] == pytest.approx(stops, rel=1e-9)
    at = result.at(2.0)
    assert at["u.position.x"] == pytest.approx(2**2 / (2 * 0.2 * 9.81), rel=1e-9)
    assert at["w.position.x"] == pytest.approx(5 - 1 / (2 * 0.3 * 9.81), rel=1e-9)


@pytest.mark.parametrize("tolerance", [1e-4, 1e-8, 1e-10, 3e-12, 1e-12])
@pytest.mark.parametrize("slope", [0.0, 30.0, -75.0, 90.0])
def test_a_bead_whose_reaction_is_zero_swings_as_if_without_friction(
    finding: Finding, slope: float, tolerance: float
) -> None:
    """cos(sqrt(10) t): it turns back at every k pi/sqrt(10)."""
    model = finding("rail")
    result = model.simulate(tolerance=tolerance, parameters={"s": np.radians(slope)})
    w = np.sqrt(10)
    assert np.abs(result["g.abscissa"] - np.cos(w * result.time)).max() < 10 * w * 10 * tolerance
    turns = [e.time for e in result.events if e.kind == "reversal"]
    assert len(turns) == len(result.events)
    expected = np.pi / w * np.arange(1, 11)
    assert turns == pytest.approx(expected, abs=10 * tolerance + 1e-10)
    assert result.figures.steps < 1000


@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize(("mass", "k"), [(1.0, 100.0), (1e6, 1e8), (1e-6, 1.0), (1.0, 1e4)])
def test_a_spring_at_its_rest_length_is_pulled_from_zero(
    finding: Finding, mass: float, k: float, tolerance: float
) -> None:
    """The middle goes on as t^3/12m, the length as (sin wt/w - t)/2k with w^2 = 2k/m."""
    changes = {
        "body a: particle(mass = 1 kg)": f"body a: particle(mass = {mass} kg)",
        "body b: particle(mass = 1 kg)": f"body b: particle(mass = {mass} kg)",
        "k = 100 N/m": f"k = {k} N/m",
    }
    result = finding("rest_length", changes).simulate(tolerance=tolerance)
    t, w = result.time, np.sqrt(2 * k / mass)
    longer = (np.sin(w * t) / w - t) / (2 * k)
    middle = 1.5 + t**3 / (12 * mass)
    allowed = 10 * tolerance * (np.abs(longer).max() + 1 / (12 * mass)) + 1e-14
    assert np.abs(result["a.position.x"] - (middle - (1 + longer) / 2)).max() < allowed
    assert np.abs(result["b.position.x"] - (middle + (1 + longer) / 2)).max() < allowed
    assert result.figures.steps < 1000 + 100 * w


@pytest.mark.parametrize("name", ["rods_on_floor", "three_legs"])
@pytest.mark.parametrize("tolerance", TOLERANCES)
def test_legs_under_one_weight_slip_together(finding: Finding, name: str, tolerance: float) -> None:
    """However the weight is shared, friction holds the pull up to its whole bound.

    A pull of r t passes mu M g at t0; from there the speed is r (t - t0)^2/2M.
    """
    legs, mass, rate, stop = (13, 12, 20, 3) if name == "rods_on_floor" else (3, 1, 1, 4)
    result = finding(name).simulate(tolerance=tolerance)
    start = 0.3 * mass * 9.81 / rate
    assert [e.kind for e in result.events] == ["slip"] * legs
    assert [e.time for e in result.events] == pytest.approx([start] * legs, rel=1e-12)
    first = "link[1]" if name == "rods_on_floor" else "bar"
    before = result.time < start
    assert np.all(result[f"{first}.velocity.x"][before] == 0)
    speed = rate * (stop - start) ** 2 / (2 * mass)
    assert result.at(stop)[f"{first}.velocity.x"] == pytest.approx(
        speed, rel=10 * tolerance + 1e-12
    )


def test_a_slip_shorter_than_a_rounding_of_time_ends() -> None:
    """Late in a run time is resolved to 1e-13 of itself: a slip may stop in less."""
    model = frot.compile("""
planar model Late
  parameter Velocity u = 1 m/s;
  body b: particle(mass = 2 kg);
  liaison floor: contact_ponctuel(b, ground.line) with coulomb(0.3);
initial
  b.position = (0, 0) m;
  b.velocity = (u, 0 m/s);
  experiment(stop = 1 s);
end Late;
""")
    for start, u in ((1e3, 1e-11), (1e3, -1e-14), (1e6, 1e-8), (1e6, -1e-12), (1e3, 1e-4)):
        result = model.simulate(start=start, stop=start + 0.01, parameters={"u": u})
        [stick] = [e.time for e in result.events if e.kind == "stick"]
        assert stick == pytest.approx(start + abs(u) / (0.3 * 9.81), rel=4e-15)
        assert result["b.velocity.x"][-1] == 0


def test_a_gap_kept_by_coordinates_may_be_stated() -> None:
    """A point at a parameter's distance on a slope: its gap is zero wherever it is."""
    result = frot.compile("""
planar model Rail
  parameter Length wide = 0.1 m;
  curve rail on ground: line(through = (0, 0) m, direction = (1, 0.5));
  body rod: rod(mass = 2 kg, length = 0.5 m);
  frame p on rod at (-wide/2, 0 m);
  liaison one: point_courbe(p, rail, unilateral = false);
initial
  rod.position.x = 0 m;
  rod.angle = 0.3 rad;
  one.gap = 0 m;
  experiment(stop = 0.1 s);
end Rail;
""").simulate()
    assert result["rod.position.x"][0] == pytest.approx(0, abs=1e-15)
    assert result["rod.position.y"][0] == pytest.approx(0.05 * (np.sin(0.3) - np.cos(0.3) / 2))
