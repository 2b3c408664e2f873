"""Rest in space that ends under loads that grow: the instant, and the motion after it."""

from __future__ import annotations

import math
import textwrap
from functools import cache
from pathlib import Path

import pytest

import frot

HERE = Path(__file__).parent
G = 9.81


@cache
def rod() -> frot.Model:
    return frot.load(HERE / "rod_departs_on_two_feet.frot")


@cache
def point() -> frot.Model:
    return frot.compile(
        textwrap.dedent("""
        model Point
          parameter Real mu = 0.3;
          parameter Real mu_s = 0.3;
          parameter Mass m = 1 kg;
          parameter Angle tilt = 0 deg;
          parameter Angle turn = 0 deg;
          parameter AngularVelocity w = 0 rad/s "at which the load turns";
          world(down = (-sin(tilt), 0, -cos(tilt)));
          frame floor on ground rotated(axis = y, angle = tilt);
          surface s on floor: plane(through = (0, 0, 0) m, normal = (0, 0, -1));
          body b: particle(mass = m);
          liaison c: contact_ponctuel(b.G, s) with coulomb(mu, mu_s);
          force f: on(b, value = m*(4 m/s^3)*time*(cos(turn + w*time)*floor.ex
                                                   + sin(turn + w*time)*floor.ey));
          output Velocity along = dot(b.velocity, cos(turn)*floor.ex + sin(turn)*floor.ey);
          output Velocity beside = dot(b.velocity, cos(turn)*floor.ey - sin(turn)*floor.ex);
        initial
          b.position = (0, 0, 0) m;
          experiment(stop = 2 s, tolerance = 1e-11);
        end Point;
        """)
    )


@pytest.mark.parametrize("m", ["2 kg", "1e-6 kg", "1e6 kg"])
@pytest.mark.parametrize(("mu", "turn"), [(0.3, 0), (0.1, 0), (0.3, 180)])
def test_a_rod_on_two_feet_is_pulled_along_itself(m: str, mu: float, turn: float) -> None:
    """4 t = mu m g/2 + 0.2 (m g/2 - t), for a mass of 2 kg; then both feet brake."""
    result = rod().simulate(parameters={"m": m, "mu": mu, "turn": f"{turn} deg"})
    departs = (mu + 0.2) * G / 4.2
    assert [event.time for event in result.events] == pytest.approx([departs] * 2, abs=1e-10)
    speed = math.hypot(*(float(result[f"b.velocity.{axis}"][-1]) for axis in "xy"))
    assert speed == pytest.approx(4.2 * (4 - departs) ** 2 / 4, abs=1e-9)


@pytest.mark.parametrize("m", ["1 kg", "1e-6 kg", "1e6 kg"])
@pytest.mark.parametrize(("tilt", "turn"), [(0, 0), (0, 77), (40, 200), (-115, 10)])
@pytest.mark.parametrize(("mu", "mu_s"), [(0.3, 0.3), (0.2, 0.5)])
def test_a_point_departs_by_its_static_coefficient(
    m: str, tilt: float, turn: float, mu: float, mu_s: float
) -> None:
    values = {"m": m, "tilt": f"{tilt} deg", "turn": f"{turn} deg", "mu": mu, "mu_s": mu_s}
    result = point().simulate(parameters=values)
    departs = mu_s * G / 4
    assert [event.time for event in result.events] == pytest.approx([departs], abs=1e-10)
    along = 2 * (4 - departs**2) - mu * G * (2 - departs)
    found = [float(result[name][-1]) for name in ("along", "beside")]
    assert found == pytest.approx([along, 0], abs=1e-9)


@pytest.mark.parametrize("w", [0.5, -0.5, 2])
@pytest.mark.parametrize("tilt", [0, 40])
def test_a_point_departs_under_a_load_that_turns(w: float, tilt: float) -> None:
    """At first its velocity is along the load; mirrored loads move it into mirrored places."""
    one, other = (
        point().simulate(parameters={"w": v, "tilt": f"{tilt} deg", "turn": f"{turn} deg"})
        for v, turn in ((w, 0), (-w, 0))
    )
    assert [event.time for event in one.events][:1] == pytest.approx([0.3 * G / 4], abs=1e-10)
    for name, sign in (("along", 1), ("beside", -1)):
        assert one[name][-1] == pytest.approx(sign * other[name][-1], abs=1e-9)
    begun = 0.3 * G / 4 + 1e-4
    start = one.at(begun)
    turned = math.atan2(float(start["beside"]), float(start["along"]))
    assert turned == pytest.approx(w * begun, abs=1e-3)


@pytest.mark.parametrize("m", ["2 kg", "1e-6 kg", "1e6 kg"])
@pytest.mark.parametrize("turn", ["-140 deg", "17 deg", "200 deg"])
def test_a_rod_turned_about_the_vertical_departs_on_two_feet(m: str, turn: str) -> None:
    """4 t = 0.6 m g/2 + 0.2 (m g/2 - t), for a mass of 2 kg."""
    result = rod().simulate(parameters={"mu": 0.6, "turn": turn, "m": m})
    assert [e.time for e in result.events] == pytest.approx([0.8 * G / 4.2] * 2, abs=1e-10)


def test_a_sphere_that_rolls_slips_where_the_cone_is_reached() -> None:
    """The instant is that of the equation of rolling, integrated to 1e-13."""
    result = frot.load(HERE / "roll_turns_to_slip.frot").simulate()
    assert result.events[0].after == "slip"
    assert result.events[0].time == pytest.approx(1.4018226471724113, abs=1e-11)


def test_a_box_tips_over_two_corners_as_in_the_plane() -> None:
    """The push at 0.55 m balances the weight at 0.2 m: 30 t = m g 0.2/0.55. Then it slips."""
    flat = frot.compile(
        """
        planar model Flat
          body b: box(mass = 2 kg, size = (0.4, 0.6) m);
          liaison c: appui_faces(b.bottom, ground.line) with coulomb(0.8);
          frame p on b at (0, 0.25) m;
          force f: on(p, value = (30 N/s*time, 0 N));
        initial
          b.position = (0, 0.3) m;
          experiment(stop = 0.9 s, tolerance = 1e-11);
        end Flat;
        """
    ).simulate()
    result = frot.load(HERE / "box_tips_in_space.frot").simulate()
    times = sorted({round(e.time, 12) for e in result.events})
    assert times[0] == pytest.approx(2 * G * 0.2 / 0.55 / 30, abs=1e-11)
    assert times == pytest.approx(sorted({round(e.time, 12) for e in flat.events}), abs=1e-9)
    assert result["b.position.x"][-1] == pytest.approx(flat["b.position.x"][-1], abs=1e-8)
    assert result["b.position.z"][-1] == pytest.approx(flat["b.position.y"][-1], abs=1e-8)
