"""A curve ends where its parameter does; a size that time takes to nothing has no meaning."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

import frot

SLOPE = """
model Slope "A bead slides down a straight wire of 2 m"
  body bead: particle(mass = 1 kg);
  curve wire on ground: parametric((u, 0 m, -0.75*u), u = (-1 m, 1 m){periodic});
  liaison guide: point_courbe(bead, wire);
  experiment(stop = 1 s);
end Slope;
"""


def test_a_point_ends_where_its_curve_does() -> None:
    """It falls from the middle with 0.6 g along the wire, whose half is 1.25 m long."""
    with pytest.raises(frot.FrotError, match=r"'guide' leaves 'wire', which ends there") as raised:
        frot.compile(SLOPE.format(periodic="")).simulate()
    result = raised.value.result  # type: ignore[attr-defined]
    assert result.time[-1] == pytest.approx(np.sqrt(2 * 1.25 / (0.6 * 9.81)), rel=1e-9)


def test_a_closed_curve_has_no_end() -> None:
    result = frot.compile(SLOPE.format(periodic=", periodic = true")).simulate()
    assert result["guide.u"][-1] > 2


@pytest.mark.parametrize(("ends", "begins"), [("(1 m, 3 m)", 1), ("(-1 m, -4 m)", -1)])
def test_a_point_begins_between_the_ends(ends: str, begins: float) -> None:
    """Where nothing is said, and in whichever order they stand."""
    text = SLOPE.format(periodic="").replace("(-1 m, 1 m)", ends).replace("-0.75*u", "0 m")
    result = frot.compile(text).simulate()
    assert result["guide.u"][0] == begins
    assert result["bead.position.x"][-1] == pytest.approx(begins)


def test_a_bead_ends_where_its_rod_does() -> None:
    """The rod turns as told: with x = |u| + 1/2 from its pin, x'' = w^2 x, so x = cosh(w t)/2."""
    with pytest.raises(frot.FrotError, match=r"'slide' leaves 'arm.axis', which ends") as raised:
        frot.compile("""
planar model Thrown "A bead from the middle of a turning rod"
  world(gravity = 0 m/s^2);
  body arm: rod(mass = 1 kg, length = 1 m);
  body bead: particle(mass = 1 kg);
  liaison hinge: rotoide(ground, arm.start) driven(angle = 2*time/(1 s));
  liaison slide: point_courbe(bead, arm.axis);
initial
  slide.u = 0 m;
  bead.velocity = (0, 1) m/s;
  experiment(stop = 2 s);
end Thrown;
""").simulate()
    result = raised.value.result  # type: ignore[attr-defined]
    assert result.time[-1] == pytest.approx(np.arccosh(2) / 2, rel=1e-9)


@pytest.mark.parametrize(
    ("figure", "liaison", "told"),
    [
        ("circle(radius = SIZE)", "point_courbe(b, c)", "liaison 'L': the radius of 'c' vanishes"),
        (
            "ellipse(a = SIZE, b = 1 m)",
            "point_courbe(b, c)",
            "a of curve 'c' is not positive any more",
        ),
        (
            "circle(radius = 1 m)",
            "tige(ground, b, length = SIZE)",
            "liaison 'L': its length vanishes",
        ),
    ],
)
def test_sizes_stay_positive(figure: str, liaison: str, told: str) -> None:
    text = f"""
planar model Shrinking "Something that time takes to nothing at 0.1 s"
  world(gravity = 0 m/s^2);
  body b: particle(mass = 1 kg);
  curve c on ground: {figure};
  liaison L: {liaison};
  experiment(stop = 1 s);
end Shrinking;
""".replace("SIZE", "(1 m - 10 m/s*time)")
    with pytest.raises(frot.FrotError, match=told):
        frot.compile(text).simulate()


def test_a_surface_whose_normal_vanishes_everywhere_is_told() -> None:
    """Its two parameters go the same way: it is a line."""
    with pytest.raises(frot.FrotError, match=r"the normal of 'c' vanishes everywhere"):
        frot.compile("""
model Line "A surface that is none"
  body b: particle(mass = 1 kg);
  surface c on ground: parametric((u + v, u + v, 0 m), u = (-1 m, 1 m), v = (-1 m, 1 m));
  liaison L: point_surface(b, c);
end Line;
""").simulate()


SHEET = """
model Sheet
  body b: particle(mass = 1 kg);
  body s: sphere(mass = 1 kg, radius = 0.1 m);
  surface low on ground: parametric((1 m*u, 1 m*v, 0.1 m*u^2), u = (1, -1), v = (-1, 2){});
  surface high on ground: parametric((1 m*u, 1 m*v, 5 m), u = (-1, 1), v = (-9, 9));
  liaison on: point_surface(b, low);
  liaison far: contact_ponctuel(s.surface, high, unilateral = false);
initial
  b.position = (0, 0.2, 0) m;
  guess(s.position = (0, 0, 5.1) m);
  b.velocity.x = {} m/s;
  b.velocity.y = {} m/s;
  s.velocity.y = 3 m/s;
  experiment(stop = 1 s);
end Sheet;
"""

# up to x = 1 on z = x^2/10 from 2 m/s, by the energy
DOWN = quad(lambda x: np.sqrt((1 + 0.04 * x**2) / (4 - 0.2 * 9.81 * x**2)), 0, 1)[0]


@pytest.mark.parametrize(
    ("periodic", "x", "y", "end"),
    [
        ("", 0, 3, 0.6),
        ("", 0, -3, 0.4),
        (", periodic = (true, false)", 0, 3, 0.6),
        (", periodic = (false, true)", 0, 3, None),
        (", periodic = (false, true)", 2, 0, DOWN),
        (", periodic = true", 2, 3, None),
    ],
)
def test_a_surface_of_points_ends_at_its_bounds(
    periodic: str, x: float, y: float, end: float | None
) -> None:
    """Level along y, so that the speed there stays; a ball stays where its own surface goes on."""
    model = frot.compile(SHEET.format(periodic, x, y))
    if end is None:
        assert model.simulate()["b.position.y"][-1] == pytest.approx(0.2 + y, abs=1e-9)
        return
    with pytest.raises(frot.FrotError, match=r"E0906.*liaison 'on' leaves 'low'") as raised:
        model.simulate()
    assert raised.value.result.time[-1] == pytest.approx(end, abs=1e-8)
