"""A side touches no rim at its own rims: where these meet the run ends, before any penetration."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import pytest
from frot.runtime.run import SimulationError

import frot

G = 9.81
RADIUS, HALF = 0.1, 0.3
# An upright cylinder that is fixed; what falls turns freely.
TEXT = """
model Rims
  parameter Mass m = 1 kg;
  parameter Angle tilt = 0;
  parameter Length x = 0.15 m;
  parameter Length y = 0 m;
  parameter Length z = 0.6 m;
  parameter Angle yaw = 0;
  parameter Angle pitch = 0;
  parameter Real wx = 0;
  parameter Real wy = 0;
  parameter Real wz = 0;
  world(gravity = 9.81 m/s^2, down = (-sin(tilt), 0, -cos(tilt)));
  frame f on ground at (0, 0, 0) m rotated(axis = y, angle = tilt);
  frame p on f at (x, y, z) rotated(axis = z, angle = yaw);
  frame g on p at (0, 0, 0) m rotated(axis = x, angle = pitch);
  body a: cylinder(mass = 1 kg, radius = 0.1 m, length = 0.6 m);
  body b: {second};
  liaison w: encastrement(f, a);
  liaison c: contact_ponctuel({places});
  {more}
initial
  b.position = g.position;
  b.orientation = g.orientation;
  b.angular_velocity = (wx, wy, wz)*(1 1/s);
  experiment(stop = 0.45 s, tolerance = 1e-10);
end Rims;
"""
DISC, CAN = "disc(mass = m, radius = 0.1 m)", "cylinder(mass = m, radius = 0.07 m, length = 0.3 m)"
AROUND = np.linspace(0, 2 * math.pi, 3001)


def model(second: str, places: str, more: str = "") -> frot.Model:
    return frot.compile(TEXT.format(second=second, places=places, more=more))


def meets(own: frot.Model, given: dict[str, object]) -> tuple[float | None, frot.Result]:
    """The time at which rims meet, if they do, and the motion up to there."""
    try:
        return None, own.simulate(parameters=given)
    except SimulationError as error:
        assert "E0911" in str(error), str(error)
        assert "meets a rim in which a side ends" in str(error)
        assert error.result is not None
        return float(str(error).split("t = ")[1].split()[0]), error.result


@pytest.mark.parametrize(("second", "places"), [(DISC, "a.side, b.rim"), (DISC, "b.rim, a.side")])
@pytest.mark.parametrize(
    ("x", "yaw", "mass", "tilt"), [(0.15, 0, 1, 0), (-0.12, 0.3, 1e6, 0.8), (0.17, -0.3, 1e-3, -2)]
)
def test_an_upright_disc_falls_onto_the_rim_of_a_cylinder(
    second: str, places: str, x: float, yaw: float, mass: float, tilt: float
) -> None:
    """Its points at the height h of the end are w = (R^2 - (z - h)^2)^(1/2) off its middle.

    The inner one meets the rim where (x - w cos)^2 + (w sin)^2 = r^2.
    """
    given = {"x": f"{x} m", "yaw": yaw, "pitch": math.pi / 2, "m": f"{mass} kg", "tilt": tilt}
    found, result = meets(model(second, places), given)
    along = abs(x) * math.cos(yaw)
    wide = along - math.sqrt(RADIUS**2 - x**2 + along**2)
    height = HALF + math.sqrt(0.1**2 - wide**2)
    assert found == pytest.approx(math.sqrt(2 * (0.6 - height) / G), abs=1e-7)
    assert not result.events


def test_a_contact_of_both_rims_carries_it() -> None:
    """The remedy that the limits name: the disc hits the rim where the run would end."""
    more = "liaison d: contact_ponctuel(a.rims[2], b.rim);"
    result = model(DISC, "a.side, b.rim", more).simulate(parameters={"pitch": 1.3}, stop=0.25)
    found, _ = meets(model(DISC, "a.side, b.rim"), {"pitch": 1.3})
    assert result.events[0].liaison == "d"
    assert result.events[0].time == pytest.approx(found, abs=1e-7)


def test_a_disc_that_falls_beside_or_into_a_pipe_does_not_end_the_run() -> None:
    own = model("disc(mass = m, radius = 0.05 m)", "a.side, b.rim")
    for x, pitch in ((0.01, 0.2), (0.0, 1.2), (0.151, 1.4), (0.3, 0.0)):
        found, result = meets(own, {"x": f"{x} m", "pitch": pitch})
        assert found is None
        assert not result.events


def circles(rows: dict[str, np.ndarray], k: int, tilt: float, can: bool) -> Iterator[np.ndarray]:
    """Points of the rims of b in the axes of f, (n, 3)."""
    w, x, y, z = (float(rows[f"b.orientation.{c}"][k]) for c in "wxyz")
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    turn = np.eye(3) + 2 * w * skew + 2 * skew @ skew
    c, s = math.cos(tilt), math.sin(tilt)
    base = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    centre = np.array([float(rows[f"b.position.{c}"][k]) for c in "xyz"])
    for end in (-0.15, 0.15) if can else (0.0,):
        size = 0.07 if can else 0.1
        flat = np.array([size * np.cos(AROUND), size * np.sin(AROUND), end + 0 * AROUND])
        yield (centre + (turn @ flat).T) @ base


def pierces(points: np.ndarray) -> bool:
    """Whether a closed curve passes through the side, and not through an end of it."""
    out = np.hypot(points[:, 0], points[:, 1]) - RADIUS
    through = (np.sign(out[1:]) != np.sign(out[:-1])) & (np.abs(points[1:, 2]) < HALF - 1e-3)
    deep = np.minimum(out[1:], out[:-1]).clip(max=0)
    return bool((through & (deep < -1e-5)).any())


@pytest.mark.parametrize(("second", "places"), [(DISC, "a.side, b.rim"), (CAN, "a.side, b.side")])
def test_thrown_rims_do_not_pass_through_a_side(second: str, places: str) -> None:
    """Where the run ends the rims are at one place; before, none is in the other side."""
    rng, own, ended = np.random.default_rng(4), model(second, places), 0
    can = "cylinder" in second
    for _ in range(24):
        tilt = rng.uniform(-2, 2)
        given = {"x": f"{rng.uniform(0.02, 0.25)} m", "y": f"{rng.uniform(-0.1, 0.1)} m"}
        given |= {"yaw": rng.uniform(0, 6), "pitch": rng.uniform(0, 3), "tilt": tilt}
        given |= {k: rng.uniform(-6, 6) for k in ("wx", "wy", "wz")}
        try:
            found, result = meets(own, given)
        except AssertionError as other:  # another named end of the run
            assert "E09" in str(other)
            continue
        last = result.time[-1] if found is None else found
        times = np.linspace(0, last, 60)
        rows = result.at(times)
        for k in range(60):
            assert not any(pierces(x) for x in circles(rows, k, tilt, can))
        if found is None:
            continue
        ended += 1
        rim = RADIUS * np.array([np.cos(AROUND), np.sin(AROUND), 0 * AROUND]).T
        far = []
        for points in circles(rows, -1, tilt, can):
            for end in (-HALF, HALF):
                way = points[::3, None] - rim[None, ::3] - np.array([0, 0, end])
                far.append(np.linalg.norm(way, axis=2))
        assert min(x.min() for x in far) < 1e-3
    assert ended > 4
