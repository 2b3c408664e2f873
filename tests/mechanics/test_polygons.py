"""Polygons: the moment of their area, and outlines that cross themselves, which have none."""

import pytest

import frot

PLATE = """
planar model Plate
  world(gravity = 0 m/s^2);
  parameter Length b = 3 m;
  body plate: polygon(mass = 3 kg, vertices = ({vertices}));
initial
  plate.angular_velocity = 2 rad/s;
end Plate;
"""


@pytest.mark.parametrize(
    "vertices",
    [
        "(0 m, 0 m), (3 m, 0 m), (0 m, b)",
        "(0 m, b), (3 m, 0 m), (0 m, 0 m)",
        "(7 m, 5 m), (7.1 m, 5 m), (7.3 m, 5 m), (8 m, 5 m), (10 m, 5 m), (7 m, 5 m + b)",
    ],
)
def test_a_right_triangle_has_the_moment_of_its_legs(vertices: str) -> None:
    """m (a^2 + b^2)/18 about G, whichever way its corners go round, and with corners on sides."""
    model = frot.compile(PLATE.format(vertices=vertices))
    energy = model.simulate(stop=0.1)["plate.kinetic_energy"][0]
    assert energy == pytest.approx(2 * 3 * 18 / 18, rel=1e-12)


def test_an_outline_that_crosses_itself_is_refused() -> None:
    with pytest.raises(frot.FrotError, match=r"E0401.*sides cross"):
        frot.compile(
            PLATE.format(vertices="(0 m, 0 m), (4 m, 1 m), (4 m, 0 m), (0 m, b)")
        ).simulate()
    model = frot.compile(PLATE.format(vertices="(0 m, 0 m), (4 m, 0 m), (4 m, 1 m), (0 m, b)"))
    model.simulate(stop=0.1)
    with pytest.raises(frot.FrotError, match=r"E0401.*sides cross"):
        model.simulate(stop=0.1, parameters={"b": -0.5})
