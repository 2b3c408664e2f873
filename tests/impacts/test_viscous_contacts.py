"""Viscous friction of contacts that can part: -c times the slip while closed, nothing while open.

The scenes have closed forms. They are turned by any angle, mirrored, and scaled in mass.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from dae_runs import agrees, both
from fmpy import simulate_fmu
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import frot

G, MU, K, R = 9.81, 0.1, 0.5, 0.1
# Angle of the support in degrees, way of the motion, mass in kg.
TURNED = [(0, 1, 1.0), (25, -1, 1e-6), (-130, 1, 1e6)]

# A block on a table that ends 1 m from the start; `down` is that of the table turned back.
EDGE = """planar model Edge
  parameter Mass m = {mass!r} kg;
  world(down = ({sin!r}, -({cos!r})));
  frame turned on ground at (0, 0) m rotated(angle = {angle} deg);
  body table: box(mass = 1 kg, size = (2, 1) m);
  liaison fix: encastrement(turned, table);
  body b: {body};
  liaison top: {contact} with {laws};
  output Length x = dot(b.position, turned.ex);
  output Velocity v = dot(b.velocity, turned.ex);
  output Force f = top.tangential_force;
initial
  b.position = {height} m*turned.ey;
  {start}
  b.velocity = {way}*2 m/s*turned.ex;
  experiment(stop = {stop} s, tolerance = 1e-11);
end Edge;
"""


def edge(angle: float, way: int, mass: float, laws: str, face: str = "") -> frot.Model:
    """A particle, or a box whose face has this liaison with the table."""
    turned = math.radians(angle)
    return frot.compile(
        EDGE.format(
            mass=mass,
            angle=angle,
            way=way,
            sin=math.sin(turned),
            cos=math.cos(turned),
            laws=laws,
            body="box(mass = m, size = (0.2, 0.1) m)" if face else "particle(mass = m)",
            contact=face or "contact_ponctuel(table.top, b)",
            height=0.55 if face else 0.5,
            start=f"b.angle = {angle} deg; b.angular_velocity = 0 rad/s;" if face else "",
            stop=1.5,
        )
    )


def slowed(t: float, k: float = K, mu: float = MU) -> tuple[float, float]:
    """Way and speed of v' = -k v - mu g from 2 m/s."""
    least = mu * G / k
    speed = (2 + least) * math.exp(-k * t) - least
    return (2 - speed) / k - least * t, speed


@pytest.mark.parametrize(("angle", "way", "mass"), TURNED)
def test_a_block_slides_off_an_edge(angle: float, way: int, mass: float) -> None:
    """Behind the edge its speed along the table is that at the edge, to the last bits."""
    laws = f"coulomb({MU}), viscous({K * mass!r} N.s/m)"
    run = edge(angle, way, mass, laws).simulate()
    leaves = brentq(lambda t: slowed(t)[0] - 1, 0, 1.5, xtol=1e-15)
    (event,) = run.events
    assert event.kind == "separation"
    assert event.time == pytest.approx(leaves, abs=1e-10)
    last = slowed(leaves)[1]
    for t in (0.1, 0.5, leaves - 1e-6):
        now, (place, speed) = run.at(t), slowed(t)
        assert [way * float(now[x]) for x in "xv"] == pytest.approx([place, speed], abs=1e-9)
        want = mass * (MU * G + K * speed)
        assert abs(float(now["f"])) == pytest.approx(want, rel=1e-8)
        assert float(now["top.power"]) == pytest.approx(-want * speed, rel=1e-8)
    flight = run.time > leaves + 1e-9
    assert np.abs(way * run["v"][flight] - last).max() < 1e-9
    assert np.ptp(run["v"][flight]) < 1e-14
    assert run["f"][-1] == 0
    assert run.balance.relative < 1e-10


@pytest.mark.parametrize(("angle", "way", "mass"), TURNED)
@pytest.mark.parametrize("kept", [True, False])
def test_a_face_has_the_friction_of_one_liaison(
    angle: float, way: int, mass: float, kept: bool
) -> None:
    """Its corners share c. It stops at the instant and the place of a block, exactly at rest."""
    laws = f"coulomb({MU}), viscous({1.9 * mass!r} N.s/m)"
    option = ", unilateral = false" if kept else ""
    face = f"appui_faces(b.bottom, table.top{option})"
    run = edge(angle, way, mass, laws, face).simulate()
    stops = math.log(1 + 2 * 1.9 / (MU * G)) / 1.9
    assert run.events[-1].time == pytest.approx(stops, abs=1e-10)
    assert way * run["x"][-1] == pytest.approx(slowed(stops, 1.9)[0], abs=1e-10)
    assert run["v"][-1] == 0
    assert run.balance.relative < 1e-10


BALL = """planar model Ball
  parameter Mass m = {mass!r} kg;
  parameter Damping c = {damping!r} N.s/m;
  world(down = ({sin!r}, -({cos!r})));
  frame turned on ground at (0, 0) m rotated(angle = {angle} deg);
  curve floor on ground: line(through = (0, 0) m, direction = ({cos!r}, {sin!r}));
  body b: disc(mass = m, radius = {radius} m);
  liaison contact: contact_ponctuel(floor, b.rim) with {laws};
  force lift: on(b.G, value = m*9.81 m/s^2*time/(1 s)*turned.ey);
  output Velocity v = dot(b.velocity, turned.ex);
initial
  b.position = 0.3 m*turned.ey;
  b.velocity = {way}*2 m/s*turned.ex - 3 m/s*turned.ey;
  b.angular_velocity = {way}*4 rad/s;
  experiment(stop = 1.5 s, tolerance = {tolerance});
end Ball;
"""
LANDS = brentq(lambda t: 0.2 - 3 * t - G * t**2 / 2 + G * t**3 / 6, 0, 0.2, xtol=1e-16)


def ball_text(angle: float, way: int, mass: float, **more: object) -> str:
    turned = math.radians(angle)
    fields = {"laws": "viscous(c)", "tolerance": 1e-11, "damping": K * mass, **more}
    fields |= {"sin": math.sin(turned), "cos": math.cos(turned), "radius": R}
    return BALL.format(angle=angle, way=way, mass=mass, **fields)


def ball(angle: float, way: int, mass: float, **more: object) -> frot.Model:
    return frot.compile(ball_text(angle, way, mass, **more))


@pytest.mark.parametrize(("angle", "way", "mass"), TURNED)
def test_a_ball_lands_slides_and_is_lifted_off(angle: float, way: int, mass: float) -> None:
    """The impact has no part of it. Then s' = -3 k s, until the lift is the weight at 1 s."""
    run = ball(angle, way, mass).simulate()
    assert [e.kind for e in run.events] == ["impact", "contact", "separation"]
    assert [e.time for e in run.events] == pytest.approx([LANDS, LANDS, 1], abs=1e-10)
    slip = 2 + 4 * R  # the spin turns the lowest point forwards
    assert np.abs(way * run["v"][run.time < LANDS] - 2).max() < 1e-14
    closed = (run.time > LANDS) & (run.time < 1)
    decay = np.exp(-3 * K * (run.time[closed] - LANDS))
    assert np.abs(np.abs(run["contact.slip"][closed]) - slip * decay).max() < 1e-9
    assert np.abs(way * run["v"][closed] - (2 - slip * (1 - decay) / 3)).max() < 1e-9
    flight = run.time > 1 + 1e-9
    left = slip * (1 - math.exp(-3 * K * (1 - LANDS))) / 3
    assert np.abs(way * run["v"][flight] - (2 - left)).max() < 1e-9
    assert np.ptp(run["v"][flight]) < 1e-14
    assert np.ptp(run["b.angular_velocity"][flight]) < 1e-13
    assert run.balance.relative < 1e-10


def test_bounces_have_no_part_of_it() -> None:
    """Each bounce keeps speed and spin; the slip decays from the last one on."""
    run = ball(0, 1, 1.0, laws="viscous(c), restitution(0.2)").simulate()
    (last,) = (e for e in run.events if e.kind == "last_impact")
    ends = last.time
    assert last.until is not None
    assert 0 < last.until - ends < 1e-5
    assert sum(e.kind == "impact" for e in run.events) > 3
    before = run.time < ends - 1e-9
    assert np.ptp(run["v"][before]) == 0
    assert np.ptp(run["b.angular_velocity"][before]) == 0
    closed = (run.time > ends + 1e-9) & (run.time < 1)
    want = 2.4 * np.exp(-3 * K * (run.time[closed] - ends))
    assert np.abs(np.abs(run["contact.slip"][closed]) - want).max() < 1e-8


@pytest.mark.parametrize("mass", [1.0, 1e6, 1e-6])
def test_stribeck_with_its_viscous_part(mass: float) -> None:
    """S' = -3 (mu(s) N/m + k s) of the slip, by a numerical solution, until the lift-off.

    The impact of normal impulse P takes 3 mu P/m with the coefficient before it.
    """
    laws = f"stribeck(0.02, 0.05, 1 m/s, {K * mass!r} N.s/m)"
    run = ball(0, 1, mass, laws=laws).simulate()

    def rate(t: float, s: np.ndarray) -> np.ndarray:
        mu = 0.02 + 0.03 * math.exp(-(s[0] ** 2))
        return np.array([-3 * (mu * G * (1 - t) + K * s[0])])

    arrives = 3 + G * LANDS - G * LANDS**2 / 2
    slip = 2.4 - 3 * arrives * (0.02 + 0.03 * math.exp(-(2.4**2)))
    want = solve_ivp(rate, (LANDS, 1), [slip], "DOP853", rtol=1e-12, atol=1e-13).y[0, -1]
    assert abs(float(run.at(1 - 1e-9)["contact.slip"])) == pytest.approx(want, abs=1e-8)
    assert np.ptp(run["v"][run.time > 1 + 1e-9]) < 1e-14
    assert run.balance.relative < 1e-10


def test_the_error_follows_the_tolerance() -> None:
    slip = 2.4 * math.exp(-3 * K * (1 - LANDS))
    errors = []
    for tolerance in (1e-4, 1e-6, 1e-8, 1e-10):
        run = ball(0, 1, 1.0, tolerance=tolerance).simulate()
        errors.append(abs(abs(float(run.at(1 - 1e-9)["contact.slip"])) - slip))
        assert errors[-1] < 10 * tolerance
    assert errors[-1] < 1e-2 * errors[0] or errors[0] < 1e-9


def test_a_law_of_ones_own_acts_as_the_built_in_one() -> None:
    """One that does not read the normal reaction: to the same bits."""
    text = ball_text(25, -1, 2.0, laws="Oil(c)")
    law = "law Oil(Damping c)\n  tangential = -c*slip;\nend Oil;\n"
    own, built_in = frot.compile(law + text).simulate(), ball(25, -1, 2.0).simulate()
    assert [e.time for e in own.events] == [e.time for e in built_in.events]
    assert np.abs(own["v"] - built_in["v"]).max() < 1e-13


@pytest.mark.parametrize("law", ["viscous(0 N.s/m)", "stribeck(0.1, 0.2, 1 m/s, 0 N.s/m)"])
def test_a_coefficient_of_zero_costs_nothing(law: str) -> None:
    """The run has the bits and the evaluations of one without it."""
    other = "stribeck(0.1, 0.2, 1 m/s)" if "stribeck" in law else "restitution(0)"
    own, without = (ball(0, 1, 1.0, laws=x).simulate() for x in (law, other))
    assert np.array_equal(own["v"], without["v"])
    assert own.figures.evaluations == without.figures.evaluations


def test_an_fmu_and_the_dae_agree(tmp_path: Path) -> None:
    text = ball_text(25, -1, 2.0)
    model = frot.compile(text)
    run = model.simulate()
    path = tmp_path / "ball.fmu"
    model.export_fmu(path, "3.0", "native")
    found = simulate_fmu(
        str(path),
        stop_time=1.5,
        output_interval=0.01,
        output=["v"],
        fmi_type="ModelExchange",
        relative_tolerance=1e-9,
        record_events=False,
    )
    assert found["v"][-1] == pytest.approx(run["v"][-1], abs=1e-7)
    dae, same, other = both(text)
    assert other.times == pytest.approx([LANDS, 1], abs=1e-9)
    agrees(dae, same, other, 1e-9)


TIP = """planar model Tip "A rod whose lower end slides on a line"
  parameter Damping c = {c} N.s/m;
  body b: rod(mass = 1 kg, length = 1 m);
  liaison floor: contact_ponctuel(ground.line, b.start) with viscous(c);
initial
  floor.gap = 0 m;
  b.angle = 60 deg;
  b.position.x = 0 m;
  b.velocity = ({way}*2, 0) m/s;
  b.angular_velocity = 0 rad/s;
  experiment(stop = 0.1 s, tolerance = 1e-11);
end Tip;
"""


def reaction(c: float, way: int) -> float:
    """N of the tip at the start: zero vertical acceleration of it, with the force F = -c s.

    With G at (a, b) from the tip, I w' = -a N + b F and N = m (g + y''), y'' = a w'.
    """
    a, b, inertia = 0.5 * math.cos(math.pi / 3), 0.5 * math.sin(math.pi / 3), 1 / 12
    push = -c * way * 2
    return (G + a * b * push / inertia) / (1 + a**2 / inertia)


@pytest.mark.parametrize(("c", "way"), [(1.0, 1), (1.0, -1), (50.0, -1)])
def test_the_list_of_motions_has_it(c: float, way: int) -> None:
    """The contact stays closed by a reaction that its viscous force changes."""
    model = frot.compile(TIP.format(c=c, way=way))
    (motion,) = model.motions()
    normal = next(v for k, v in motion.reactions.items() if k.endswith("normal_force"))
    tangent = motion["floor.tangential_force"]
    sign = 1 if way * 1.0 > 0 else -1
    assert tangent == pytest.approx(-sign * 2 * c, rel=1e-12)
    assert normal == pytest.approx(reaction(c, way), rel=1e-10)


def test_a_contact_that_it_lifts_and_that_closes_without_it_has_no_motion() -> None:
    """Closed its reaction would pull; open it would go into the line: no mode is admissible."""
    assert reaction(50.0, 1) < 0
    model = frot.compile(TIP.format(c=50.0, way=1))
    assert len(model.motions()) == 0
    with pytest.raises(frot.SimulationError, match=r"E0902.*'floor': no admissible motion"):
        model.simulate()
