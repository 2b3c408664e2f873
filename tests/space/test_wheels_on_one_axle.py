"""Two wheels of one body on a plane: what symmetry keeps at zero is rounding, and so small."""

from __future__ import annotations

import numpy as np
import pytest

import frot

MASS, ACROSS, ALONG, R, G = 1.0, 0.1, 0.05, 0.4, 9.81


def axle(
    slope: float, first: str, second: str, initial: str = "", scale: float = 1.0
) -> frot.Model:
    """`first` and `second`: a liaison, and what is written after its places."""
    (one, after), (other, also) = (x.partition(",")[::2] for x in (first, second))
    after, also = (f", {x}" if x else "" for x in (after, also))
    inertia = ", ".join(str(scale * x) for x in (ACROSS, ACROSS, ALONG))
    return frot.compile(f"""model Axle
  world(gravity = {G} m/s^2);
  body r: solid(mass = {MASS * scale} kg, inertia = ({inertia}) kg.m^2);
  curve left on r: circle(radius = {R} m, normal = x, centre = (0.5, 0, 0) m);
  curve right on r: circle(radius = {R} m, normal = x, centre = (-0.5, 0, 0) m);
  surface floor on ground: plane(through = (0, 0, 0) m, normal = (0, {slope}, 1));
  liaison a: {one}(floor, left{after});
  liaison b: {other}(floor, right{also});
initial
  guess(r.position = (0, 0, {R}) m);
  {initial}
  experiment(stop = 1 s);
end Axle;""")


TOUCHES = "contact_ponctuel,unilateral = false"


@pytest.mark.parametrize("scale", [1.0, 1e6, 1e-6])
@pytest.mark.parametrize("slope", [0.0, 0.2, -0.7])
def test_an_axle_rolls_down_without_a_turn(slope: float, scale: float) -> None:
    """I + m R^2 about the axis where it touches: a = g sin / (1 + I/(m R^2)), in any digit."""
    model = axle(slope, "roulement", "roulement", scale=scale)
    down = G * slope / np.hypot(1, slope) / (1 + ACROSS / (MASS * R**2))
    for tolerance in (1e-4, 1e-8, 1e-12):
        result = model.simulate(tolerance=tolerance)
        way = np.array([result[f"r.position.{x}"] for x in "xyz"])
        far = np.linalg.norm(way - way[:, :1], axis=0)
        assert np.abs(far - abs(down) * result.time**2 / 2).max() < 10 * tolerance + 1e-12
        assert np.abs(result["r.position.x"]).max() < 1e-12
        assert result.figures.steps < 200


@pytest.mark.parametrize("initial", ["", "guess(r.angular_velocity = (1, 0, 0) rad/s);"])
@pytest.mark.parametrize("slope", [0.0, 0.2])
@pytest.mark.parametrize("first", ["roulement", TOUCHES])
def test_an_axle_of_which_a_wheel_slips_keeps_its_energy(
    first: str, slope: float, initial: str
) -> None:
    result = axle(slope, first, TOUCHES, initial).simulate(tolerance=1e-10)
    energy = result["energy.kinetic"] + result["energy.potential"]
    assert np.abs(energy - energy[0]).max() < 1e-9
    assert result.figures.steps < 300
