"""`model.dae()` through impacts, percussions and `when`s by SciPy's DOP853, beside `simulate`.

Both have the same law of impact; the motion between is another integrator's, at 1e-11.
"""

from __future__ import annotations

from pathlib import Path

import casadi as ca
import numpy as np
import pytest
from dae_runs import agrees, both, impulses, run_dae, state_of

import frot

ERROR = 1e-10

BALL = """planar model Ball
  parameter Real e = 0.7; parameter Real mu = 0.2; parameter Angle slope = 0.3 rad;
  parameter Mass m = 1 kg; parameter AngularVelocity spin = 20 rad/s;
  body b: disc(mass = m, radius = 0.1 m);
  curve floor on ground: line(through = (0, 0) m, direction = (cos(slope), sin(slope)));
  liaison c: contact_ponctuel(floor, b.rim) with coulomb(mu), restitution(e{rule});
  world(gravity = 9.81 m/s^2);
initial
  b.position = (0, 1) m; b.velocity = (0.3, 0) m/s; b.angular_velocity = spin;
  experiment(stop = 1.5 s);
end Ball;
"""
ROD = """planar model Rod
  parameter Real e = 0; parameter Real mu = 0.4; parameter Real mu2 = 0.3;
  parameter Mass m = 2 kg; parameter Velocity v = 0.5 m/s; parameter Angle tilt = 0 rad;
  body b: rod(mass = m, length = 1 m);
  curve floor on ground: line(through = (0, 0) m, direction = (cos(tilt), sin(tilt)));
  liaison heel: contact_ponctuel(floor, b.start) with coulomb(mu), restitution(e);
  liaison toe: contact_ponctuel(floor, b.tip) with coulomb(mu2), restitution(e);
  world(gravity = 9.81 m/s^2);
initial
  b.angle = 0.4 rad + tilt; b.velocity = (v*cos(tilt), v*sin(tilt));
  b.position = (cos(0.4 + tilt/(1 rad))*0.5 m, sin(0.4 + tilt/(1 rad))*0.5 m);
  experiment(stop = 0.7 s);
end Rod;
"""
STOPPED = """planar model Stop
  parameter Real e = 0.6; parameter Mass m = 2 kg; parameter Velocity v = 3 m/s;
  body b: box(mass = m, size = (0.4, 0.2) m);
  frame rail on ground rotated(angle = 0.3 rad);
  liaison way: prismatique(rail, b) with coulomb(0.1, half_length = 0.1 m),
    stops(-1 m, 0.2 m, e);
  world(gravity = 9.81 m/s^2);
initial
  way.displacement = 0 m; way.speed = v;
  experiment(stop = 1.5 s);
end Stop;
"""
CORD = """planar model Cord
  parameter Real e = 0.3; parameter Mass m = 1 kg;
  body b: disc(mass = m, radius = 0.1 m);
  frame hook on ground at (0, 2) m;
  liaison cord: fil(hook, b.G, length = 1 m) with restitution(e);
  world(gravity = 9.81 m/s^2);
initial
  b.position = (0.3, 1.8) m; b.velocity = (1, 0) m/s;
  experiment(stop = 0.8 s);
end Cord;
"""
GUIDED = """planar model Guided
  parameter Real mu = 0.3; parameter Mass m = 2 kg; parameter Real k = 1;
  body b: box(mass = m, size = (0.4, 0.2) m);
  frame rail on ground rotated(angle = 0.4 rad);
  liaison way: prismatique(rail, b) with coulomb(mu, half_length = 0.1 m);
  world(gravity = 9.81 m/s^2);
  force hit: impulse(b.G, at = 0.25 s, value = (4*k, 1) N.s);
initial
  way.displacement = 0 m; way.speed = 0.1 m/s;
  experiment(stop = 0.5 s);
end Guided;
"""
PINNED = """planar model Pinned
  parameter Real mu = 0.2;
  body b: rod(mass = 2 kg, length = 1 m);
  liaison pin: rotoide(ground, b.start) with coulomb(mu, radius = 0.05 m);
  world(gravity = 9.81 m/s^2);
  force hit: impulse(b.tip, value = (3, 1) N.s, at = 0.1 s);
initial
  b.angle = 0.3 rad; b.angular_velocity = 0.2 rad/s;
  experiment(stop = 0.3 s);
end Pinned;
"""
REINIT = """model Ball
  parameter Real e = 0.5;
  Length h; Velocity w; Integer count;
equation
  der(h) = w; der(w) = -10 m/s^2;
  when h < 0 m then
    reinit(w, -e*w);
    count = pre(count) + 1;
  end when;
initial
  h = 1 m; w = 0 m/s; count = 0;
  experiment(stop = 1.2 s);
end Ball;
"""
# A dry crank lifts a striker that drops on a table: relations of a loop are in the impact.
LOOP = """planar model Loop
  parameter Real e = 0.4; parameter Real mu = 0.2;
  body left: rod(mass = 1 kg, length = 0.5 m);
  body top: rod(mass = 2 kg, length = 0.8 m);
  body right: rod(mass = 1 kg, length = 0.5 m);
  frame foot on ground at (0.8, 0) m;
  curve wall on ground: line(through = (0.9, 0) m, direction = (0, 1));
  liaison a: rotoide(ground, left.start) with coulomb(mu, radius = 2 cm);
  liaison b: rotoide(left.tip, top.start);
  liaison c: rotoide(top.tip, right.tip);
  liaison d: rotoide(foot, right.start);
  liaison hit: contact_ponctuel(wall, top.tip) with coulomb(0.3), restitution(e);
  world(gravity = 9.81 m/s^2);
initial
  left.angle = 2 rad; left.angular_velocity = -3 rad/s;
  guess(top.angle = 0 rad, right.angle = 2 rad);
  experiment(stop = 0.5 s);
end Loop;
"""


@pytest.mark.parametrize("rule", ["", ", rule = poisson", ", rule = newton"])
@pytest.mark.parametrize(
    "values",
    [{}, {"m": 1e6, "slope": 0.0}, {"m": 1e-6, "spin": -20.0}, {"e": 0.0, "slope": -0.2}],
    ids=["given", "heavy", "light and mirrored", "plastic"],
)
def test_a_spinning_ball_bounces_as_in_the_kernel(rule: str, values: dict[str, float]) -> None:
    dae, result, run = both(BALL.format(rule=rule), **values)
    agrees(dae, result, run, ERROR)
    told = [e.impulse for e in result.events if "impact" in e.kind]
    found = impulses(dae, run, "c.normal_force")
    assert told and np.allclose(found, told, rtol=1e-9, atol=0)
    lost = [e.energy_lost for e in result.events if "impact" in e.kind]
    assert np.allclose([a.lost for a in run.happened if a.lost > 0], lost, rtol=1e-8)


@pytest.mark.parametrize("values", [{}, {"m": 1e6}, {"m": 1e-6, "tilt": 0.9}, {"v": -0.5}])
def test_a_rough_rod_slaps_down_and_comes_to_rest(values: dict[str, float]) -> None:
    """Both ends stick then: their friction is not unique."""
    dae, result, run = both(ROD, ["heel"], **values)
    agrees(dae, result, run, ERROR)


def test_a_rod_that_bounces_from_end_to_end_comes_to_rest() -> None:
    """Infinitely many impacts: `slow` ends them, by an error of its size."""
    dae, result, run = both(ROD, ["heel"], 1e-7, stop=0.35, e=0.5)
    agrees(dae, result, run, 1e-8)
    assert len(run.times) > 15


@pytest.mark.parametrize("m", [1e-6, 2.0, 1e6])
@pytest.mark.parametrize("e", [0.0, 0.6])
def test_a_dry_guide_ends_in_stops(e: float, m: float) -> None:
    dae, result, run = both(STOPPED, e=e, m=m)
    agrees(dae, result, run, ERROR)
    assert any(a.phases > 0 for a in run.happened)


def test_a_cord_goes_slack_and_taut() -> None:
    dae, result, run = both(CORD, stop=0.56)
    agrees(dae, result, run, ERROR)
    assert len(impulses(dae, run, "cord.normal_force")) == 3


@pytest.mark.parametrize(
    ("text", "values"),
    [(GUIDED, {}), (GUIDED, {"k": -1.0}), (GUIDED, {"m": 1e6}), (PINNED, {}), (PINNED, {"mu": 5})],
)
def test_a_percussion_strikes_what_rubs(text: str, values: dict[str, float]) -> None:
    dae, result, run = both(text, **values)
    agrees(dae, result, run, ERROR)
    assert dae.impacts.percussions == ("hit",)
    struck = [t for t, a in zip(run.times, run.happened, strict=True) if a.phases]
    assert struck == pytest.approx([0.25 if text is GUIDED else 0.1], rel=1e-9)


def test_reinit_is_a_reset_of_the_same_shape() -> None:
    dae, result, run = both(REINIT)
    agrees(dae, result, run, ERROR)
    assert run.mode[dae.names.mode.index("count")] == result["count"][-1] == 3


def test_an_impact_goes_through_a_dry_loop() -> None:
    dae, result, run = both(LOOP)
    assert any(e.kind == "impact" for e in result.events)
    agrees(dae, result, run, 1e-9)


def test_the_functions_are_those_of_the_law() -> None:
    """v+ = v- + A^-1 J' P and u+ = u- + W P, and they can be differentiated."""
    dae, result, run = both(BALL.format(rule=""), stop=0.6)
    p = np.array([result.parameters[name] for name in dae.names.p])
    x = state_of(dae, result, run.times[0] * (1 - 1e-13))
    mode = np.array([1.0, 1, 3, 0, 1])
    given = (run.times[0], x, dae.solve(0, x, [], p, mode), [], p, mode)
    effect, (before, _) = np.array(dae.impacts.effect(*given)), dae.impacts.rate(*given)
    impulse = run.happened[0].impulses
    after = dae.impacts.strike(*given, impulse)
    rate, _ = dae.impacts.rate(0, after, given[2], [], p, mode)
    assert np.allclose(np.array(rate - before).ravel(), effect @ impulse, rtol=1e-12)
    assert effect[0, 0] == pytest.approx(1.0) and effect[1, 1] == pytest.approx(3.0)
    assert float(rate[0]) == pytest.approx(-0.7 * float(before[0]), rel=1e-9)
    assert abs(float(dae.impacts.gap(*given)[0])) < 1e-12
    symbol = ca.SX.sym("P", 2)
    slope = ca.jacobian(dae.impacts.strike(*given, symbol), symbol)
    assert not ca.depends_on(slope, symbol) and slope.nnz() > 0


def test_components_that_do_not_touch_meet_apart() -> None:
    """Two balls that land at one instant: each has the impact that it has alone."""
    body = (
        "  body {0}: disc(mass = 1 kg, radius = 0.1 m);\n"
        "  liaison {0}c: contact_ponctuel(floor, {0}.rim) with coulomb(0.2), restitution(0.5);\n"
    )
    start = (
        "  {0}.position = ({1}, 1) m; {0}.velocity = (0.3, 0) m/s; {0}.angular_velocity = {2};\n"
    )
    text = (
        "planar model Two\n  curve floor on ground: line(through = (0, 0) m, direction = (1, 0));\n"
        f"{body.format('a')}{body.format('b')}  world(gravity = 9.81 m/s^2);\ninitial\n"
        f"{start.format('a', 0, '20 rad/s')}{start.format('b', 2, '-30 rad/s')}"
        "  experiment(stop = 0.6 s);\nend Two;\n"
    )
    dae, result, run = both(text)
    agrees(dae, result, run, ERROR)
    assert sum(a.phases for a in run.happened) == 6
    assert max(run.times) - min(run.times) < 1e-12


@pytest.mark.parametrize("place", [0, 2])
def test_a_wall_is_met_from_either_side(place: int) -> None:
    text = f"""planar model Wall
  body b: disc(mass = 1 kg, radius = 0.1 m);
  curve wall on ground: line(through = (1, 0) m, direction = (0, 1));
  liaison c: contact_ponctuel(wall, b.rim) with coulomb(0.2), restitution(0.5);
initial
  b.position = ({place}, 0) m; b.velocity = ({4 * (1 - place)}, 1) m/s;
  experiment(stop = 0.5 s);
end Wall;
"""
    dae, result, run = both(text)
    agrees(dae, result, run, ERROR)
    assert run.times == pytest.approx([0.9 / 4], rel=1e-10)


def test_two_hoops_touch_from_outside() -> None:
    """A contact whose figures have two sides is on the one on which they touch."""
    text = (Path(frot.__file__).parents[1] / "models" / "two_hoops.frot").read_text("utf-8")
    dae, result, run = both(text, ["touch"])
    agrees(dae, result, run, ERROR)
    assert run.mode[dae.names.mode.index("touch.side")] == -1


def test_bad_calls_are_refused_by_name() -> None:
    dae = frot.compile(BALL.format(rule="")).dae()
    x = np.array(dae.start(0, [], dae.p0)).ravel()
    mode = dae.first_mode(0, x, [], dae.p0)
    with pytest.raises(frot.FrotError, match=r"E0806.*no guard 'floor'"):
        dae.event(0, x, [], dae.p0, mode, ["floor"])
    with pytest.raises(frot.FrotError, match=r"E0806.*no contact 'floor'"):
        dae.first_mode(0, x, [], dae.p0, ["floor"])
    with pytest.raises(frot.FrotError, match=r"E0806.*6 numbers"):
        dae.event(0, x[:3], [], dae.p0, mode, [])
    with pytest.raises(frot.FrotError, match=r"E0806.*finite"):
        dae.event(0, x * np.nan, [], dae.p0, mode, [])


def test_a_rod_that_no_mode_lets_move_is_said() -> None:
    """Painleve's rod: no admissible motion, which `simulate` leaves by a tangential impact."""
    text = ROD.replace("parameter Real mu = 0.4", "parameter Real mu = 3")
    model = frot.compile(text)
    dae = model.dae()
    p = np.array([float(v) for v in np.array(dae.p0).ravel()])
    x = np.array(dae.start(0, [], p)).ravel()
    angle = 1.2
    x[:3] = 0.5 * np.cos(angle), 0.5 * np.sin(angle), angle
    x[3:] = -1.0, 0.0, 0.0
    with pytest.raises(frot.FrotError, match="E0902"):
        dae.first_mode(0, x, [], p, ["heel"])


def test_a_run_of_the_dae_needs_no_result() -> None:
    """From `start` and `first_mode` alone; the ball lands by the law of free fall."""
    dae = frot.compile(BALL.format(rule="")).dae()
    x, p = np.array(dae.start(0, [], dae.p0)).ravel(), np.array(dae.p0).ravel()
    run = run_dae(dae, 0.5, x, dae.first_mode(0, x, [], p), p)
    fall = 0.1 / np.cos(0.3)  # y = tan(slope) x + radius / cos(slope)
    a, b, c = 0.5 * 9.81, 0.3 * np.tan(0.3), fall - 1
    assert run.times[0] == pytest.approx((-b + np.sqrt(b * b - 4 * a * c)) / (2 * a), rel=1e-10)
