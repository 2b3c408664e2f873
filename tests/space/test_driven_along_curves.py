"""Points whose places on curves are values of time, with curves on the ground and on bodies."""

import numpy as np
import pytest

import frot
from tests.space.newton_euler import axes, orientation, vector

# How a curve is written, and its point by the parameter, in the axes of its owner.
CURVES = {
    "line": (
        "line(through = (1, 2, 0.5) m, direction = (2, 3, 6))",
        lambda u: (1 + 2 * u / 7, 2 + 3 * u / 7, 0.5 + 6 * u / 7),
    ),
    "circle": ("circle(radius = 1.5 m)", lambda u: (1.5 * np.cos(u), 1.5 * np.sin(u), 0 * u)),
    "ellipse": ("ellipse(a = 1 m, b = 0.5 m)", lambda u: (np.cos(u), 0.5 * np.sin(u), 0 * u)),
    "bent": (
        "parametric((1 m*u, 0.4 m*u^2, 0.1 m*u^3), u = (-2, 2))",
        lambda u: (u, 0.4 * u**2, 0.1 * u**3),
    ),
    "closed": (
        "parametric((1 m*cos(u), 0.4 m*sin(u), 0.1 m*sin(2*u)), u = (0, 2*pi), periodic = true)",
        lambda u: (np.cos(u), 0.4 * np.sin(u), 0.1 * np.sin(2 * u)),
    ),
}
# Bodies, and the curves that are tried with them.
BODIES = {
    "particle": ("particle(mass = 2 kg)", ("line", "circle", "bent")),
    "box": ("box(mass = 2 kg, size = (0.2, 0.3, 0.4) m)", ("ellipse", "bent")),
    "rod": ("rod(mass = 2 kg, length = 0.5 m)", ("circle", "closed")),
}


def told(time: np.ndarray | float) -> np.ndarray | float:
    """The parameter."""
    return 0.3 + 0.7 * np.sin(time)


def scene(body: str) -> str:
    """On each curve of the ground a body, and each curve on a body that keeps a place."""
    parts = ""
    shape, names = BODIES[body]
    for name in names:
        curve = CURVES[name][0]
        unit = "1 m" if name == "line" else "1"
        drive = f"driven(u = (0.3 + 0.7*sin(time/(1 s)))*({unit}))"
        parts += f"""
  body b_{name}: {shape};
  curve c_{name} on ground: {curve};
  liaison k_{name}: point_courbe(b_{name}, c_{name}) {drive};
  output Force f_{name} = k_{name}.force;"""
        if body != "particle":
            parts += f"""
  body d_{name}: {shape};
  curve e_{name} on d_{name}: {curve};
  liaison h_{name}: point_courbe(ground, e_{name}) {drive};"""
    return f"model M{parts}\n  experiment(stop = 0.4 s, tolerance = 1e-10);\nend M;"


@pytest.mark.parametrize("body", BODIES)
def test_a_driven_point_is_where_its_curve_says(body: str) -> None:
    """The body at x = c(u(t)) pulls the curve with m g - m a; or the curve goes by the origin."""
    run = frot.compile(scene(body)).simulate()
    for name in BODIES[body][1]:
        point = CURVES[name][1]
        want = np.array(np.broadcast_arrays(*point(told(run.time))))
        got = np.array([run[f"b_{name}.position.{c}"] for c in "xyz"])
        assert np.abs(got - want).max() < 1e-11, name
        force = np.array([run[f"f_{name}.{c}"] for c in "xyz"])
        pushed = np.array([run[f"b_{name}.acceleration.{c}"] for c in "xyz"])
        pushed[2] += 9.81
        assert np.abs(force + 2 * pushed).max() < 1e-9, name
        if body != "particle":
            at = run.at(0.4)
            place = axes(orientation(at, f"d_{name}")) @ np.array(point(told(0.4)))
            assert np.abs(vector(at, f"d_{name}.position") + place).max() < 1e-9, name
            assert at[f"h_{name}.u"] == pytest.approx(told(0.4), abs=1e-9)


def test_a_driven_point_leaves_the_end_of_its_curve() -> None:
    """The parameter that time gives passes the end u = 2."""
    text = """
model M
  body b: particle(mass = 2 kg);
  curve c on ground: parametric((1 m*u, 0.4 m*u^2, 0.1 m*u^3), u = (-2, 2));
  liaison k: point_courbe(b, c) driven(u = 1 + 2*time/(1 s));
  experiment(stop = 1 s);
end M;
"""
    with pytest.raises(frot.SimulationError, match="leaves 'c'") as failed:
        frot.compile(text).simulate()
    assert failed.value.result is not None
    assert failed.value.result.time[-1] == pytest.approx(0.5, abs=1e-9)
