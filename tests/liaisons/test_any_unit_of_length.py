"""The same mechanism in micrometres and in megametres: no unit is built in."""

import re

import numpy as np
import pytest

import frot
from tests.space.newton_euler import vector

SCENES = {
    "an ellipsoid in an ellipsoid": """
  body b: ellipsoid(mass = 6 kg, semi_axes = (0.491 m, 0.393 m, 0.295 m));
  surface bowl on ground: implicit((x/(1.469 m))^2 + (y/(0.96 m))^2 + (z/(1.078 m))^2 - 1);
  liaison kept: contact_ponctuel(bowl, b.surface, unilateral = false);
""",
    "a sphere that rolls in an ellipsoid with a rod on it": """
  body b: sphere(mass = 2 kg, radius = 0.3 m);
  body rod: rod(mass = 1 kg, length = 0.7 m);
  frame eye on b at (0.1 m, 0.05 m, -0.1 m);
  surface bowl on ground: implicit((x/(1.376 m))^2 + (y/(1.273 m))^2 + (z/(0.992 m))^2 - 1);
  liaison rolls: roulement(bowl, b.surface);
  liaison hinge: spherique(eye, rod.start);
""",
    "a point of a ring on an ellipse, its rim on a parabola": """
  body b: ring(mass = 0.5 kg, radius = 0.2 m);
  frame eye on b at (0.05 m, 0.02 m, 0.01 m);
  curve round on ground: ellipse(a = 0.9 m, b = 0.4 m);
  surface valley on ground: parametric((u*1 m, v*1 m, 0.3 m*(u^2 + v^2)), u = (-3, 3), v = (-3, 3));
  liaison kept: point_courbe(eye, round);
  liaison low: contact_ponctuel(valley, b.rim, unilateral = false);
""",
}


def scaled(scene: str, factor: float) -> str:
    lengths = re.sub(
        r"([\d.]+) (m|kg)(?![\w/])",
        lambda found: f"{float(found[1]) * (factor if found[2] == 'm' else 1)!r} {found[2]}",
        scene,
    )
    return f"""
model Scaled
  world(gravity = {9.81 * factor!r} m/s^2);
{lengths}
initial
  guess(b.position = ({0.1 * factor!r}, {-0.3 * factor!r}, {-0.4 * factor!r}) m);
  guess(b.angular_velocity = (1, -0.5, 2) rad/s);
  experiment(stop = 0.5 s, tolerance = 1e-9);
end Scaled;
"""


@pytest.mark.parametrize("name", SCENES)
def test_lengths_have_no_unit_of_their_own(name: str) -> None:
    """What a millionth of the length costs is nothing: as many steps, the same places."""
    runs = [(f, frot.compile(scaled(SCENES[name], f)).simulate()) for f in (1.0, 2.0**-20, 2.0**20)]
    (_, plain), *others = runs
    want = np.stack([vector(plain.at(0.5), "b.position"), vector(plain.at(0.5), "b.velocity")])
    for factor, result in others:
        found = result.at(0.5)
        end = np.stack([vector(found, "b.position"), vector(found, "b.velocity")]) / factor
        assert end == pytest.approx(want, abs=1e-9)
        assert result.figures.steps < 1.2 * plain.figures.steps + 5
