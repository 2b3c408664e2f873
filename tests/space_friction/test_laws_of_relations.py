"""Friction of liaisons kept by relations: of the text, tangent curves, a line on a plane."""

from __future__ import annotations

import math

import numpy as np
import pytest
from space_models import G, last, model

import frot

STATED = """
    liaison OnPlane(a: frame, b: frame)
      geometric dot(b.position - a.position, a.ez) = 0;
    end OnPlane;
    liaison OnLine(a: frame, b: frame)
      geometric dot(b.position - a.position, a.ez) = 0;
      geometric 3*dot(b.position - a.position, a.ey - 2*a.ez) = 0;
    end OnLine;
    liaison AtPoint(a: frame, b: frame)
      geometric 2*(b.position - a.position) = 0;
    end AtPoint;
    liaison Hinge(a: frame, b: frame)
      geometric dot(b.ez, a.ex) = 0;
      geometric b.position.x + b.position.y = a.position.x + a.position.y;
      geometric 3*(b.position.z - a.position.z) = 0;
      geometric dot(b.ez, 2*a.ey + a.ex) = 0;
      geometric b.position.x - 2*b.position.y = a.position.x - 2*a.position.y;
    end Hinge;
    liaison OnSphere(a: frame, b: frame, Length r)
      geometric dot(b.position - a.position, b.position - a.position) = r^2;
    end OnSphere;
    """
POINT = """
    model Point
      parameter Mass m = 1 kg;
      parameter Angle slope = 0.1 rad;
      parameter Real axis[3] = (1, 2, 2);
      parameter Velocity v[3] = (0, 0, 0) m/s;
      parameter Damping c = 0.4 N.s/m;
      body p: particle(mass = m);
      frame hill on ground at (0.3, -0.2, 0.1) m rotated(axis = axis, angle = slope);
      surface plane on hill: plane(through = (0, 0, 0) m, normal = (0, 0, 1));
      curve line on hill: line(through = (0, 0, 0) m, direction = (1, 0, 0));
      liaison on: {liaison} with {laws};
      force side: on(p, value = m*(1 m/s^2)*(0.5*cos(3*time/(1 s)), 2, -1));
    initial
      p.position = (0.3, -0.2, 0.1) m;
      guess(p.velocity = v);
      experiment(stop = 1 s, tolerance = 1e-11);
    end Point;
    """
LAWS = [
    "coulomb(0.3, mu_s = 0.45)",
    "stribeck(0.2, mu_s = 0.4, v_s = 0.3 m/s)",
    "coulomb(0.2), viscous(c)",
    "viscous(c)",
]
PAIRS = {
    "plane": ("OnPlane(hill, p)", "point_surface(p, plane)"),
    "line": ("OnLine(hill, p)", "lineaire_annulaire(hill, p, axis = x)"),
    "curve": ("OnLine(hill, p)", "point_courbe(p, line)"),
}
STATE = [f"p.{what}.{k}" for what in ("position", "velocity") for k in "xyz"]


def ends(text: str, values: dict[str, object]) -> tuple[np.ndarray, list[float]]:
    """The last state of a scene, and the times of its events of `on`."""
    result = model(STATED + text).simulate(parameters=values)
    return np.array(last(result, *STATE)), [e.time for e in result.events if e.liaison == "on"]


@pytest.mark.parametrize("pair", PAIRS)
@pytest.mark.parametrize("laws", LAWS)
@pytest.mark.parametrize(
    ("slope", "axis", "velocity", "mass"),
    [
        (0.5, (0, 1, 0), (1, 0, 0), 1),
        (0.5, (0, 1, 0), (-1, 0, 0), 1e6),
        (-0.2, (1, 2, 2), (0.7, 0.4, 0), 1e-6),
        (-0.2, (1, 2, 2), (-0.7, -0.4, 0), 1),
        (0.1, (1, 0, 0), (0, 0, 0), 1),
    ],
)
def test_a_point_with_stated_relations_moves_as_in_the_liaison_of_the_catalogue(
    pair: str,
    laws: str,
    slope: float,
    axis: tuple[float, ...],
    velocity: tuple[float, ...],
    mass: float,
) -> None:
    """The relations are scaled and skew; friction acts across their force all the same."""
    values = {"slope": slope, "axis": axis, "v": velocity, "m": mass, "c": 0.4 * mass}
    texts = [POINT.format(liaison=liaison, laws=laws) for liaison in PAIRS[pair]]
    found, wanted = (ends(text, values) for text in texts)
    assert found[0] == pytest.approx(wanted[0], abs=2e-9)
    assert found[1] == pytest.approx(wanted[1], abs=1e-9)


TURNING = """
    model Turning
      parameter Mass m = 1 kg;
      parameter Real mu = 0.3;
      parameter Length r = 2 cm;
      parameter RotationalDamping c = 0.02 N.m.s;
      parameter AngularVelocity spin[3] = (1, -2, 3) rad/s;
      body b: box(mass = m, size = (0.2, 0.3, 0.4) m);
      frame post on ground at (0.1, 0.2, 0.3) m;
      frame own on b at (0.1, 0.05, -0.2) m;
      liaison on: {liaison} with {laws};
    initial
      own.position = (0.1, 0.2, 0.3) m;
      b.orientation = (1, 0, 0, 0);
      b.angular_velocity = spin;
      experiment(stop = 0.6 s, tolerance = 1e-11);
    end Turning;
    """
TURNED = [f"b.angular_velocity.{k}" for k in "xyz"] + [f"b.orientation[{k}]" for k in (1, 2, 3, 4)]


@pytest.mark.parametrize(
    ("stated", "named", "spin"),
    [
        ("AtPoint(post, own)", "spherique(post, own)", (1, -2, 3)),
        ("AtPoint(post, own)", "spherique(post, own)", (-1, 2, -3)),
        ("Hinge(post, own)", "rotoide(post, own)", (0, 0, 2)),
        ("Hinge(post, own)", "rotoide(post, own)", (0, 0, -2)),
    ],
)
@pytest.mark.parametrize("mass", [1, 1e6, 1e-6])
@pytest.mark.parametrize(
    ("laws", "mu", "radius"),
    [
        ("coulomb(mu, radius = r)", 0.3, 0.02),
        ("viscous(c)", 0, 0),
        ("coulomb(mu, radius = r)", 0.2, 0.08),
    ],
)
def test_a_body_with_stated_relations_turns_as_in_the_liaison_of_the_catalogue(
    stated: str,
    named: str,
    spin: tuple[float, ...],
    mass: float,
    laws: str,
    mu: float,
    radius: float,
) -> None:
    """Friction is a couple of mu*radius*norm(R), whatever the relations' scales."""
    values: dict[str, object] = {"spin": spin, "m": mass, "c": 0.02 * mass}
    if mu:
        values |= {"mu": mu, "r": radius}
    made = [model(STATED + TURNING.format(liaison=x, laws=laws)) for x in (stated, named)]
    found, wanted = (x.simulate(parameters=values) for x in made)
    assert last(found, *TURNED) == pytest.approx(last(wanted, *TURNED), abs=1e-8)
    times = [[e.time for e in x.events] for x in (found, wanted)]
    assert times[0] == pytest.approx(times[1], abs=1e-9)


LINE = """
    model Line
      parameter Real mu = 0.3;
      parameter Length L = 20 cm;
      parameter Length h = 5 cm;
      parameter Mass m = 2 kg;
      parameter Force F = 30 N;
      world(down = {down});
      body b: box(mass = m, size = (0.5, 0.4, 0.3) m);
      curve edge on b: line(through = (0, 0, 0) m, direction = (2, 0, 0));
      frame table on ground at (1, 2, 3) m rotated(axis = {axis}, angle = 40 deg);
      surface top on table: plane(through = (0, 0, 0) m, normal = (0, 0, 1));
      frame handle on b at (0 m, 0 m, h);
      liaison on: lineaire_rectiligne({places}) with {law};
      force pull: on(handle, value = F*table.ex);
    initial
      b.position = (1, 2, 3) m;
      b.orientation = ({turn});
      b.velocity = (0, 0, 0) m/s;
      b.angular_velocity = (0, 0, 0) rad/s;
      experiment(stop = 0.3 s, tolerance = 1e-11);
    end Line;
    """


def line(law: str, places: str = "top, edge", sign: int = 1) -> object:
    """A body with its line on a tilted plane across gravity, pulled along the line."""
    axis = np.array([1, 2, 2 * sign]) / 3
    angle = math.radians(40)
    turn = [math.cos(angle / 2), *(math.sin(angle / 2) * axis)]
    cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    matrix = np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
    return model(
        LINE.format(
            down=tuple(float(x) for x in -matrix[:, 2]),
            axis=tuple(float(x) for x in axis),
            turn=", ".join(map(str, turn)),
            places=places,
            law=law,
        )
    )


@pytest.mark.parametrize("places", ["top, edge", "edge, top"])
@pytest.mark.parametrize("mass", [2, 2e6, 2e-6])
@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("h", [0.05, 0.5, -0.5])
def test_a_line_presses_with_two_ends(places: str, mass: float, sign: int, h: float) -> None:
    """N1 + N2 = m g, L (N1 - N2) = F h: friction mu (|N1| + |N2|) = mu max(m g, F |h|/L)."""
    scene = line("coulomb(mu, half_length = L)", places, sign)
    force, length, mu = 15 * mass, 0.2, 0.3
    values = {"m": f"{mass} kg", "F": f"{force} N", "h": f"{h} m", "mu": mu}
    result = scene.simulate(parameters=values)
    friction = mu * max(mass * G, force * abs(h) / length)
    speed = math.sqrt(sum(x * x for x in last(result, *(f"b.velocity.{c}" for c in "xyz"))))
    assert speed == pytest.approx(0.3 * (force - friction) / mass, rel=1e-9)


@pytest.mark.parametrize("factor", [1 - 1e-8, 1 + 1e-8])
@pytest.mark.parametrize("sign", [1, -1])
def test_a_pulled_line_locks_from_mu_equal_to_half_length_over_height(
    factor: float, sign: int
) -> None:
    """As a drawer does: F - mu F h/L < 0."""
    scene = line("coulomb(mu, half_length = L)", sign=sign)
    values = {"mu": 0.4 * factor, "h": "0.5 m", "F": "1000 N"}
    result = scene.simulate(parameters=values)
    speeds = last(result, *(f"b.velocity.{c}" for c in "xyz"))
    assert (speeds == [0, 0, 0]) == (factor > 1)


@pytest.mark.parametrize(
    "law", ["coulomb(mu)", "coulomb(mu), viscous(3 N.s/m)", "viscous(3 N.s/m)"]
)
def test_a_line_without_ends_rubs_at_its_point(law: str) -> None:
    """Friction mu N against the slip of the point, whatever the couple."""
    result = line(law).simulate(parameters={"h": "0.5 m"})
    dry = 0.3 * 2 * G if "coulomb" in law else 0
    drive, c = 30 - dry, 3 if "viscous" in law else 0
    speed = drive / c * (1 - math.exp(-c * 0.3 / 2)) if c else 0.3 * drive / 2
    found = math.sqrt(sum(x * x for x in last(result, *(f"b.velocity.{c}" for c in "xyz"))))
    assert found == pytest.approx(speed, rel=1e-9)


def test_both_ends_share_what_damps_a_line() -> None:
    """A law of the whole line: half of its coefficient acts at either end."""
    result = line("coulomb(mu, half_length = L), viscous(3 N.s/m)").simulate()
    speed = (30 - 0.3 * 2 * G) / 3 * (1 - math.exp(-0.45))
    found = math.sqrt(sum(x * x for x in last(result, *(f"b.velocity.{c}" for c in "xyz"))))
    assert found == pytest.approx(speed, rel=1e-9)


@pytest.mark.parametrize("unilateral", ["true", "false"])
@pytest.mark.parametrize("spin", [3, -3])
def test_the_axis_of_a_rod_slides_on_its_ends(unilateral: str, spin: float) -> None:
    """It spins about the normal: both ends slip, the couple is mu m g L, L half its length."""
    scene = model(f"""
        model Spinning
          parameter Mass m = 3 kg;
          body r: rod(mass = m, length = 60 cm);
          liaison on: lineaire_rectiligne(r.axis, ground.plane, unilateral = {unilateral})
            with coulomb(0.2);
        initial
          r.position = (0, 0, 0) m;
          r.orientation = (1, 0, 0, 0);
          r.velocity = (0, 0, 0) m/s;
          r.angular_velocity = (0, 0, {spin}) rad/s;
          experiment(stop = 1 s, tolerance = 1e-11);
        end Spinning;
        """)
    result = scene.simulate()
    stop = abs(spin) / (0.2 * G * 0.3 * 12 / 0.6**2)  # w' = mu g L/(l^2/12)
    assert [e.time for e in result.events] == pytest.approx([stop] * len(result.events), abs=1e-10)
    assert result.events
    assert last(result, "r.angular_velocity.z") == [0]


def test_a_rod_that_parts_needs_ends() -> None:
    """A line of the text has none."""
    text = """
        model Parts
          body b: box(mass = 1 kg, size = (0.5, 0.4, 0.3) m);
          curve edge on b: line(through = (0, 0, 0) m, direction = (1, 0, 0));
          liaison on: lineaire_rectiligne(edge, ground.plane, unilateral = true);
        initial
          b.position = (0, 0, 0) m;
          experiment(stop = 1 s);
        end Parts;
        """
    with pytest.raises(frot.FrotError, match="half_length"):
        model(text).simulate()


TANGENT = """
    {planar}model Tangent
      parameter Mass m = 1 kg;
      parameter Real mu = 0.2;
{values}
      world(down = {down});
      body p: ring(mass = m, radius = 0.1 m);
      frame wall on ground at {zero} m{turned};
      curve track on wall: circle(radius = 0.5 m);
      liaison on: courbe_courbe(track, p.rim) with {law};
      output Force N = on.normal_force;
    initial
      {start}
      experiment(stop = 1.3 s, tolerance = 1e-11);
    end Tangent;
    """


PLANAR = """
      parameter AngularVelocity spin = 20 rad/s;
"""
PLANAR_START = """
      p.position = {at} m;
      p.velocity = {fast} m/s;
      p.angular_velocity = spin;
"""
SPATIAL = """
      parameter Real axis[3] = (1, 0, 0);
      parameter Real down[3] = (0, -1, 0);
      parameter Length place[3] = (0, 0, 0) m;
      parameter Velocity fast[3] = (0, 0, 0) m/s;
      parameter Real turn[4] = (1, 0, 0, 0);
      parameter AngularVelocity spin[3] = (0, 0, 0) rad/s;
"""
SPATIAL_START = """
      p.position = place;
      p.velocity = fast;
      p.orientation = turn;
      p.angular_velocity = spin;
"""


@pytest.mark.parametrize(
    "law",
    [
        "coulomb(mu, mu_s = 0.3)",
        "stribeck(mu, mu_s = 0.3, v_s = 1 m/s)",
        "viscous(0.5 N.s/m)",
        "coulomb(mu), rolling_resistance(4 mm)",
        "rolling_resistance(4 mm, delta_s = 6 mm)",
    ],
)
@pytest.mark.parametrize("spin", [20, -20])
@pytest.mark.parametrize("axis", [(1, 0, 0), (1, 2, 2), (-2, 1, 2)])
def test_a_ring_in_a_circle_moves_in_space_as_in_the_plane(
    law: str, spin: float, axis: tuple[int, ...]
) -> None:
    """The plane of both and gravity are tilted; curves that stay in one plane touch as there."""
    sine, cosine = 0.4 * math.sin(0.5), 0.4 * math.cos(0.5)
    at, fast = (sine, -cosine), (-cosine, -sine)
    flat = PLANAR_START.format(at=at, fast=fast)
    filled = {"planar": "planar ", "values": PLANAR, "down": "-y", "zero": (0, 0), "turned": ""}
    scene = model(TANGENT.format(**filled, law=law, start=flat))
    plane = scene.simulate(parameters={"spin": spin})
    unit = np.array(axis) / 3 if axis[0] != 1 or axis[1] else np.array([1.0, 0, 0])
    angle = 0.9
    cross = np.array([[0, -unit[2], unit[1]], [unit[2], 0, -unit[0]], [-unit[1], unit[0], 0]])
    turn = np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
    quaternion = [math.cos(angle / 2), *(math.sin(angle / 2) * unit)]

    values = {
        "axis": unit,
        "down": -turn[:, 1],
        "place": turn[:, :2] @ at,
        "fast": turn[:, :2] @ fast,
        "turn": np.array(quaternion),
        "spin": turn[:, 2] * spin,
    }
    turned = " rotated(axis = axis, angle = 0.9 rad)"
    filled = {"planar": "", "values": SPATIAL, "down": "down", "zero": (0, 0, 0), "turned": turned}
    scene = model(TANGENT.format(**filled, law=law, start=SPATIAL_START))
    space = scene.simulate(parameters=values)
    here = np.array(last(space, *(f"p.position.{c}" for c in "xyz")))
    assert turn.T @ here == pytest.approx(
        [*last(plane, "p.position.x", "p.position.y"), 0], abs=1e-8
    )
    assert last(space, "N") == pytest.approx([abs(x) for x in last(plane, "N")], abs=1e-7)
    if "rolling" not in law:  # in space a rolling that reverses is no event
        times = [[e.time for e in x.events if e.liaison == "on"] for x in (space, plane)]
        assert times[0] == pytest.approx(times[1], abs=1e-8)


@pytest.mark.parametrize("mass", [1, 1e6, 1e-6])
@pytest.mark.parametrize("sign", [1, -1])
def test_skew_rings_obey_their_laws(mass: float, sign: int) -> None:
    """A ring on a leaning circle, tangent to it: cone, Newton's and Euler's laws, energy."""
    scene = model(f"""
        model Skew
          parameter Mass m = 1 kg;
          body p: ring(mass = m, radius = 0.3 m);
          curve track on ground: circle(radius = 0.5 m, normal = (0.2, 0.1, 1));
          liaison on: courbe_courbe(track, p.rim) with coulomb(0.2), pivoting_resistance(3 mm);
        initial
          guess(p.position = (0.5, 0.05, 0.3) m, p.orientation = (cos(0.6), 0.02, sin(0.6), 0.05));
          guess(p.velocity = ({sign}, {2 * sign}, 0) m/s,
            p.angular_velocity = (1, {-sign}, {2 * sign}) rad/s);
          experiment(stop = 0.2 s, tolerance = 1e-11);
        end Skew;
        """)
    result = scene.simulate(parameters={"m": f"{mass} kg"})
    assert result.balance.relative < 1e-9
    for t in np.linspace(0.01, 0.19, 7):
        at = result.at(t)
        slip, friction, force = (
            np.array([at[f"on.{name}.{c}"] for c in "xyz"])
            for name in ("slip", "tangential_force", "force")
        )
        assert np.linalg.norm(slip) > 1e-3
        way = slip / np.linalg.norm(slip)
        assert friction == pytest.approx(-0.2 * at["on.normal_force"] * way, rel=1e-9)
        pull = np.array(
            [at["p.acceleration.x"], at["p.acceleration.y"], at["p.acceleration.z"] + G]
        )
        assert force == pytest.approx(mass * pull, rel=1e-9, abs=1e-9 * mass)
        across = force - (force @ way) * way
        assert at["on.normal_force"] == pytest.approx(np.linalg.norm(across), rel=1e-9)
