"""Percussions, `impulse(frame, value, at)`, against closed forms and against large short forces."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import frot

G = 9.81

FREE = """{head}model Free
  parameter Mass m = 2 kg;
  body b: box(mass = m, size = ({size}) m);
  frame place on b at ({place}) m;
  world(gravity = 0 m/s^2);
  force hit: impulse(place, value = ({value}) N.s, at = 0.5 s);
initial
  experiment(stop = 1 s, tolerance = 1e-10);
end Free;
"""


@pytest.mark.parametrize("m", [1e-6, 2.0, 1e6])
def test_a_free_box_takes_speed_and_spin(m: float) -> None:
    """M v = P, I omega = r x P; the work is that of the mean speed of the place struck."""
    text = FREE.format(head="planar ", size="0.4, 0.3", place="0.1, 0.15", value="3, -1")
    result = frot.compile(text).simulate(parameters={"m": m})
    inertia = m * (0.4**2 + 0.3**2) / 12
    spin = (0.1 * -1 - 0.15 * 3) / inertia
    assert result["b.velocity.x"][0] == 0
    assert result["b.velocity.x"][-1] == pytest.approx(3 / m, rel=1e-13)
    assert result["b.velocity.y"][-1] == pytest.approx(-1 / m, rel=1e-13)
    assert result["b.angular_velocity"][-1] == pytest.approx(spin, rel=1e-13)
    energy = 10 / m / 2 + inertia * spin**2 / 2
    assert result["energy.work"][-1] == pytest.approx(energy, rel=1e-12)
    (event,) = result.events
    assert (event.kind, event.time) == ("percussion", 0.5)
    assert event.text.startswith("percussion 'hit' at t = 0.5")


def test_a_free_box_in_space_takes_speed_and_spin() -> None:
    text = FREE.format(head="", size="0.4, 0.3, 0.2", place="0.1, 0.15, 0.05", value="3, -1, 2")
    result = frot.compile(text).simulate(stop=0.5)
    turn = np.cross([0.1, 0.15, 0.05], [3, -1, 2])
    inertia = 2 / 12 * np.array([0.3**2 + 0.2**2, 0.4**2 + 0.2**2, 0.4**2 + 0.3**2])
    spin = [result[f"b.angular_velocity.{k}"][-1] for k in "xyz"]
    assert spin == pytest.approx(turn / inertia, rel=1e-12)


BLOCK = """planar model Block
  parameter Real mu = 0.3;
  parameter Mass m = 2 kg;
  parameter Momentum along = 4 N.s;
  parameter Momentum down = 1 N.s;
  parameter Velocity v = 0 m/s;
  parameter Angle slope = 0 rad;
  body b: box(mass = m, size = (0.4, 0.2) m);
  curve floor on ground: line(through = (0, 0) m, direction = (cos(slope), sin(slope)));
  {liaison}
  world(gravity = 0 m/s^2);
  force hit: impulse(b.G, at = 0.25 s, value = (
    along*cos(slope) + down*sin(slope), along*sin(slope) - down*cos(slope)));
  output Velocity slide = b.velocity.x*cos(slope) + b.velocity.y*sin(slope);
initial
  {start}
  experiment(stop = 0.5 s, tolerance = 1e-10);
end Block;
"""
ON_FACES = BLOCK.format(
    liaison="liaison way: appui_faces(floor, b.bottom) with coulomb(mu), restitution(0.7);",
    start="b.angle = slope; b.position = (-sin(slope)*0.1 m, cos(slope)*0.1 m);\n"
    "  b.velocity = (v*cos(slope), v*sin(slope));",
)
IN_GUIDE = BLOCK.format(
    liaison="frame rail on ground rotated(angle = slope);\n"
    "  liaison way: prismatique(rail, b) with coulomb(mu, half_length = 0.1 m);",
    start="way.displacement = 0 m; way.speed = v;",
)


@pytest.mark.parametrize("text", [ON_FACES, IN_GUIDE], ids=["faces", "guide"])
@pytest.mark.parametrize("slope", [0.0, 0.6, -2.0])
@pytest.mark.parametrize("m", [1e-6, 2.0, 1e6])
@pytest.mark.parametrize(
    ("along", "down", "v"),
    [(4, 1, 0), (-4, 1, 0), (0.2, 1, 0), (0, 1, 0.5), (0, 1, 0.05), (-2, 1, 0.5), (-0.8, 1, 0.2)],
)
def test_a_block_is_struck_into_its_rough_support(
    text: str, slope: float, m: float, along: float, down: float, v: float
) -> None:
    """Friction takes mu times the normal impulse at most: it ends a slip, or may turn it."""
    mu, v = 0.3, v * 2 / m  # the numbers are impulses for the mass of 2 kg
    values = {"slope": slope, "m": m, "along": along, "down": down, "v": v}
    result = frot.compile(text).simulate(parameters=values)
    speed, left = v, 1.0
    rate = (along - math.copysign(mu * down, v if v else along)) / m
    if v and speed * (speed + rate) < 0:  # the slip ends within
        left += speed / rate
        speed, rate = 0.0, (along - math.copysign(mu * down, along)) / m
    if speed == 0 and abs(along) <= mu * down:
        rate = 0.0
    assert result["slide"][-1] == pytest.approx(speed + left * rate, rel=1e-11, abs=1e-12 / m)


ROD = """planar model Rod
  parameter Real mu = 0.2;
  parameter Length r = 0.05 m;
  parameter Real x = 3;
  parameter Real y = 1;
  body b: rod(mass = 2 kg, length = 1 m);
  liaison pin: rotoide(ground, b.start) with coulomb(mu, radius = r);
  world(gravity = 0 m/s^2);
  force hit: impulse(b.tip, value = (x*1 N.s, y*1 N.s));
initial
  b.angle = 0 rad;
  experiment(stop = 1 ms, tolerance = 1e-10);
end Rod;
"""


@pytest.mark.parametrize(("x", "y"), [(3, 1), (-3, -1), (0, 2), (30, 0.1)])
def test_a_dry_pin_resists_a_percussion_by_its_reaction(x: float, y: float) -> None:
    """I omega = P_y l - mu r |R|, with R_x = -P_x and R_y = m (l/2) omega - P_y."""
    result = frot.compile(ROD).simulate(parameters={"x": x, "y": y})
    spin, mass, mu, r = result["b.angular_velocity"][0], 2.0, 0.2, 0.05
    inertia = mass / 3
    reaction = math.hypot(-x, mass * 0.5 * spin - y)
    if spin == 0:
        assert abs(y) <= mu * r * reaction
    else:
        friction = math.copysign(mu * r * reaction, y)
        assert inertia * spin == pytest.approx(y - friction, rel=1e-11)


def test_a_rod_on_a_ball_joint_is_struck_into_steady_precession() -> None:
    """J.-L. Vieille 1849, problem I: a cone of 0.6 rad needs omega^2 = 5.684297."""
    text = """model Cone
      parameter Angle slope = 0.6 rad;
      parameter Real omega = 1;
      body rod: rod(mass = 3 kg, length = 1 m);
      liaison pivot: spherique(ground, rod.start);
      frame place on rod at (0.3, 0, 0) m;
      // m (l/2 + K2/(l/2)) (l/2) omega = P c
      force hit: impulse(place, value = (0 N.s, omega*1.25 kg.m/s, 0 N.s), at = 0 s);
      output Length height = rod.tip.position.z;
    initial
      rod.tip.position = (sin(slope)*1 m, 0 m, -cos(slope)*1 m);
      experiment(stop = 5 s, tolerance = 1e-11);
    end Cone;"""
    omega = math.sqrt(5.684297)
    result = frot.compile(text).simulate(parameters={"omega": omega})
    assert np.ptp(result["height"]) < 1e-6
    exact = math.sqrt(G / (2 / 3 * math.cos(0.6))) * math.sin(0.6)
    assert exact**2 == pytest.approx(5.684297, abs=1e-6)
    result = frot.compile(text).simulate(parameters={"omega": exact})
    assert np.ptp(result["height"]) < 1e-10


BALL = """model Ball
  parameter Real mu = 0.3;
  body b: sphere(mass = 2 kg, radius = 0.1 m);
  frame high on b at (0.02, 0.01, 0.06) m;
  liaison floor: contact_ponctuel(ground.plane, b.surface) with coulomb(mu);
  force hit: impulse(high, value = (4, 1, -3) N.s);
initial
  b.position = (0, 0, 0.1) m;
  b.velocity = (0.3, -0.7, 0) m/s;
  b.angular_velocity = (9, -4, 2) rad/s;
  experiment(stop = 1 ms, tolerance = 1e-10);
end Ball;
"""


@pytest.mark.parametrize("mu", [0.05, 0.3, 0.8])
def test_the_slip_of_a_ball_turns_within_a_percussion(mu: float) -> None:
    """Against an integration of m v' = P + R, I w' = r x P + a x R, until slip ends."""
    mass, radius, inertia = 2.0, 0.1, 2 / 5 * 2 * 0.01
    pushed, place = np.array([4.0, 1, -3]), np.array([0.02, 0.01, 0.06])
    arm = np.array([0, 0, -radius])

    def slip(y: np.ndarray) -> np.ndarray:
        return (y[:3] + np.cross(y[3:], arm))[:2]

    def rates(_: float, y: np.ndarray, direction: np.ndarray | None = None) -> np.ndarray:
        s = slip(y)
        along = s / np.linalg.norm(s)
        reaction = np.array([*(-mu * 3 * along), 3.0])
        turn = np.cross(place, pushed) + np.cross(arm, reaction)
        return np.concatenate([(pushed + reaction) / mass, turn / inertia])

    def ends(_: float, y: np.ndarray) -> float:
        return float(np.linalg.norm(slip(y)) - 1e-9)

    ends.terminal = True  # type: ignore[attr-defined]
    begin = np.array([0.3, -0.7, 0, 9, -4, 2.0])
    found = solve_ivp(rates, (0, 1), begin, rtol=1e-12, atol=1e-13, events=ends, method="DOP853")
    y, left = found.y[:, -1], 1 - found.t[-1]
    if left > 0:  # what sticks rolls on, if friction can hold it
        turn = np.cross(place, pushed)
        free = pushed[:2] / mass + np.cross(turn / inertia, arm)[:2]
        effect = 1 / mass + radius**2 / inertia
        friction = -free / effect
        assert np.linalg.norm(friction) < mu * 3
        reaction = np.array([*friction, 3.0])
        y = y + left * np.concatenate(
            [(pushed + reaction) / mass, (turn + np.cross(arm, reaction)) / inertia]
        )
    result = frot.compile(BALL).simulate(parameters={"mu": mu})
    names = [f"b.{v}.{k}" for v in ("velocity", "angular_velocity") for k in "xyz"]
    assert [result[n][0] for n in names] == pytest.approx(y, rel=1e-7, abs=1e-8)


LINKAGE = """planar model Linkage
  parameter Time short = 1 us;
  parameter Real pulse = 0;
  body r1: rod(length = 1 m, mass = 1 kg);
  body r2: rod(length = 2 m, mass = 1 kg);
  body r3: rod(length = 1.5 m, mass = 1 kg);
  body foot: box(mass = 1 kg, size = (0.2, 0.1) m);
  liaison h1: rotoide(ground, r1.start) with coulomb(0.2, radius = 20 mm);
  liaison h2: rotoide(r1.tip, r2.start) with coulomb(0.2, radius = 20 mm);
  liaison h3: rotoide(r2.tip, r3.tip);
  liaison h4: rotoide(foot.G, r3.start);
  liaison floor: appui_faces(ground.line, foot.bottom) with coulomb(0.4);
  force hit: impulse(r2.G, value = (1 - pulse)*(0.7, -1.3) N.s, at = 0 s);
  force press: on(r2.G, value =
    if time < short then pulse*(0.7, -1.3) * 1 N.s / short else (0, 0) N);
initial
  r1.angle = 90 deg;
  foot.position = (2 m, 0.05 m);
  foot.angle = 0 rad;
  guess(r2.angle = 10 deg, r3.angle = 60 deg);
  experiment(stop = 0.1 ms, tolerance = 1e-12);
end Linkage;
"""


def test_a_percussion_is_the_limit_of_a_large_force_in_a_short_time() -> None:
    """A loop with dry hinges on a rough floor: the difference falls with the duration."""
    model = frot.compile(LINKAGE)
    names = [f"r{k}.angular_velocity" for k in (1, 2, 3)]
    struck = model.simulate(stop=1e-9)
    exact = np.array([struck[n][-1] for n in names])
    errors = []
    for short in (1e-5, 1e-6, 1e-7):
        pressed = model.simulate(parameters={"pulse": 1.0, "short": short}, stop=short)
        errors.append(np.abs(np.array([pressed[n][-1] for n in names]) - exact).max())
    assert errors[0] < 1e-2
    assert errors[1] < 0.2 * errors[0]
    assert errors[2] < 0.2 * errors[1]


def test_a_percussion_before_the_start_is_past() -> None:
    text = FREE.format(head="planar ", size="0.4, 0.3", place="0.1, 0.15", value="3, -1")
    result = frot.compile(text.replace("at = 0.5 s", "at = -1 s")).simulate()
    assert result.events == ()
    assert result["b.velocity.x"][-1] == 0


def test_two_percussions_at_one_instant_add_up() -> None:
    text = FREE.format(head="planar ", size="0.4, 0.3", place="0.1, 0.15", value="3, -1")
    second = "  force other: percussion(b.G, value = (1, 1) N.s, at = 0.5 s);\ninitial"
    result = frot.compile(text.replace("initial", second)).simulate()
    assert result["b.velocity.x"][-1] == pytest.approx(2.0, rel=1e-13)
    assert [x.kind for x in result.events] == ["percussion", "percussion"]


@pytest.mark.parametrize(
    ("old", "new", "code"),
    [
        ("at = 0.5 s", "at = time", "E0701"),
        ("at = 0.5 s", "at = 0.5 m", "E0301"),
        ("N.s, at", "N, at", "E0301"),
        ("(3, -1)", "(3, 1/0)", "E04"),
    ],
)
def test_percussions_that_mean_nothing_are_refused(old: str, new: str, code: str) -> None:
    text = FREE.format(head="planar ", size="0.4, 0.3", place="0.1, 0.15", value="3, -1")
    with pytest.raises(frot.FrotError) as raised:
        frot.compile(text.replace(old, new)).simulate()
    assert code in str(raised.value)


EVENTS = """{kind}model Blows
  parameter Mass m = {mass!r} kg;
  body b: {body};
  liaison floor: contact_ponctuel({places}) with coulomb(0.2);
  force up: impulse(b.G, value = {up}*m/(1 kg), at = {at} s);
  {more}
initial
  b.position = {place} m;
  experiment(stop = 0.5 s);
end Blows;
"""
PLANE = {"kind": "planar ", "body": "disc(mass = m, radius = 0.1 m)", "place": "(0, 0.1)"}
PLANE |= {"places": "ground.line, b.rim"}
SPACE = {"kind": "", "body": "sphere(mass = m, radius = 0.1 m)", "place": "(0, 0, 0.1)"}
SPACE |= {"places": "ground.plane, b.surface"}


@pytest.mark.parametrize("at", [0.0, 0.25])
@pytest.mark.parametrize("mass", [1e-6, 1.0, 1e6])
@pytest.mark.parametrize(("scene", "vector"), [(PLANE, (3, 4)), (SPACE, (2, 3, 6))])
def test_the_event_has_name_impulse_and_work(
    scene: dict[str, str], vector: tuple[float, ...], mass: float, at: float
) -> None:
    """A ball at rest that is struck upwards takes P^2/2m; at the start of the run too."""
    text = EVENTS.format(**scene, mass=mass, up=f"{vector} N.s", at=at, more="")
    result = frot.compile(text).simulate()
    event = next(e for e in result.events if e.kind == "percussion")
    size = float(np.linalg.norm(vector))
    assert (event.liaison, event.time) == ("up", at)
    assert event.vector == pytest.approx(tuple(mass * x for x in vector), rel=1e-13)
    assert event.impulse == pytest.approx(mass * size, rel=1e-13)
    assert event.energy_lost == pytest.approx(-mass * size**2 / 2, rel=1e-9)
    assert result["energy.work"][-1] == pytest.approx(-event.energy_lost, rel=1e-9)
    assert event.as_data()["vector"] == event.vector
    (said,) = (e.reason for e in result.explain() if e.kind == "percussion")
    numbers = ", ".join(f"{mass * x:.6g}" for x in vector)
    assert said.startswith(
        f"an impulse of the text acts, 'up' of ({numbers}) N.s; it does the work"
    )


def test_of_a_blow_into_a_support_the_work_is_shared() -> None:
    """Down and along: of the work of the impulse the impact of the floor takes its part."""
    text = EVENTS.format(**PLANE, mass=1.0, up="(1, -5) N.s", at=0.25, more="")
    result = frot.compile(text).simulate()
    blow, hit = (e for e in result.events if e.kind in ("percussion", "impact"))
    kept = result.at(0.25)["b.kinetic_energy"]
    assert -blow.energy_lost - hit.energy_lost == pytest.approx(float(kept), rel=1e-9)
    assert hit.impulse == pytest.approx(5, rel=1e-9)


def test_of_several_at_one_instant_the_first_has_the_work_of_all() -> None:
    second = "force side: impulse(b.G, value = (2, 0) N.s, at = 0.25 s);"
    text = EVENTS.format(**PLANE, mass=1.0, up="(0, 4) N.s", at=0.25, more=second)
    result = frot.compile(text).simulate()
    first, other = (e for e in result.events if e.kind == "percussion")
    assert (first.liaison, other.liaison) == ("up", "side")
    assert (first.vector, other.vector) == ((0, 4), (2, 0))
    assert first.energy_lost == pytest.approx(-(4**2 + 2**2) / 2, rel=1e-9)
    assert other.energy_lost == 0
    reasons = [e.reason for e in result.explain() if e.kind == "percussion"]
    assert reasons[0].endswith("all of the instant do the work 10 J")
    assert reasons[1].endswith("'side' of (2, 0) N.s")


def test_a_saved_run_keeps_them(tmp_path: Path) -> None:
    text = EVENTS.format(**PLANE, mass=1.0, up="(3, 4) N.s", at=0.25, more="")
    result = frot.compile(text).simulate()
    result.save(tmp_path / "blow.frotrun")
    assert frot.load_result(tmp_path / "blow.frotrun").events == result.events
