"""A point on a rough curve in space, fixed or carried by a body that turns freely."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from space_models import G, last, loaded, model

TUBE = """
    model Tube
      parameter Real mu = 0.3;
      parameter Force X = 1 N;
      parameter Force Y = 1 N;
      parameter Force Z = 1 N;
      parameter Mass m = 1 kg;
      parameter Angle i = 0.5 rad;
      body b: particle(mass = m);
      curve c on ground: line(through = (1, 2, 3) m, direction = (cos(i), 0, sin(i)));
      liaison g: {places} with coulomb(mu);
      force f: on(b, value = (X*cos(i) - Z*sin(i), Y, X*sin(i) + Z*cos(i)));
      world(gravity = 0 m/s^2);
    initial
      b.position = (1, 2, 3) m;
      b.velocity = (0, 0, 0) m/s;
      experiment(stop = 1 s, tolerance = 1e-11);
    end Tube;
    """
PLACES = ["point_courbe(b, c)", "lineaire_annulaire(b, c)", "lineaire_annulaire(c, b)"]


@pytest.mark.parametrize("places", PLACES)
@pytest.mark.parametrize(
    ("y", "z", "mu", "m"), [(3, 4, 0.3, 1), (-3, 4, 2, 1e6), (0, -5, 0.1, 1e-6)]
)
@pytest.mark.parametrize("sign", [1, -1])
def test_a_point_in_a_straight_tube_rests_below_the_cone(
    places: str, y: float, z: float, mu: float, m: float, sign: int
) -> None:
    """P. Painlevé 1895, p. 6: it rests where |X| <= f sqrt(Y^2 + Z^2)."""
    scene = model(TUBE.format(places=places))
    values = {"mu": mu, "m": f"{m} kg", "Y": f"{y * m} N", "Z": f"{z * m} N"}
    bound = 5 * mu * sign
    held = scene.simulate(parameters={**values, "X": f"{bound * m * (1 - 1e-9)} N"})
    assert len(held.events) == 0
    assert last(held, *(f"b.velocity.{c}" for c in "xyz")) == [0, 0, 0]
    freed = scene.simulate(parameters={**values, "X": f"{(bound + 0.1 * sign) * m} N"})
    speed = math.cos(0.5) * 0.1 * sign
    assert last(freed, "b.velocity.x", "b.velocity.y") == pytest.approx([speed, 0], abs=1e-11)


def test_a_bead_on_a_helix_follows_both_reactions() -> None:
    """V' = g c/k - f sqrt((g a/k)^2 + (v^2 a/k^2)^2) with k^2 = a^2 + c^2, downward."""
    result = model("""
        model Helix
          body b: particle(mass = 2 kg);
          curve wire on ground: parametric((0.3 m*cos(u), 0.3 m*sin(u), 0.2 m*u), u = (-99, 9));
          liaison g: point_courbe(b, wire) with coulomb(0.2);
        initial
          g.u = 0;
          b.velocity.z = 1 m/s;
          experiment(stop = 2 s, tolerance = 1e-11);
        end Helix;
        """).simulate()
    a, c, mu = 0.3, 0.2, 0.2
    k = math.hypot(a, c)

    def rate(t: float, v: np.ndarray) -> list[float]:
        size = math.hypot(G * a / k, v[0] ** 2 * a / k**2)
        return [G * c / k - mu * size * np.sign(v[0])]

    def zero(t: float, v: np.ndarray) -> float:
        return v[0]

    zero.terminal = True
    options = {"rtol": 1e-12, "atol": 1e-13, "method": "DOP853"}
    up = solve_ivp(rate, (0, 1), [-k / c], events=zero, **options)
    turn = float(up.t_events[0][0])
    down = solve_ivp(rate, (turn, 2), [1e-300], **options)
    assert [event.time for event in result.events] == pytest.approx([turn], rel=1e-9)
    assert last(result, "b.velocity.z") == pytest.approx([-down.y[0, -1] * c / k], rel=1e-9)


def test_a_bead_in_a_rough_tube_that_turns_freely() -> None:
    """P. Painlevé 1895, p. 68, integrated by hand: `turning_tube-1` of the worked examples."""
    result = loaded("rough_tube_that_turns").simulate()
    exact = [1.5715420800375863, 1.4546643525429421]
    assert last(result, "runs.abscissa", "axle.angle") == pytest.approx(exact, rel=1e-9)
    speed = 4.815246190577146
    tube = last(result, "bead.velocity.x", "bead.velocity.y", "bead.velocity.z")
    assert tube[2] == pytest.approx(speed * math.cos(math.radians(70)), rel=1e-9)
    spin = result["spin"]
    assert np.abs(spin / spin[0] - 1).max() < 1e-12


def _wire(u: float) -> np.ndarray:
    return np.array([0.3 * math.cos(u) + 0.1 * u, 0.4 * math.sin(u), 0.2 * u])


SKEW = """
    model Skew
      body wire: solid(mass = 1 kg, inertia = (0.1, 0.1, 0.15) kg.m^2);
      body bead: particle(mass = 0.7 kg);
      curve c on wire: parametric((0.3 m*cos(u) + 0.1 m*u, 0.4 m*sin(u), 0.2 m*u), u = (-99, 99));
      liaison axle: rotoide(ground, wire);
      liaison g: point_courbe(bead, c) with coulomb(0.25);
    initial
      g.u = 0;
      der(g.u) = {du} 1/s;
      axle.angle = 0 rad;
      axle.speed = 2 rad/s;
      experiment(stop = 0.25 s, tolerance = 1e-11);
    end Skew;
    """


@pytest.mark.parametrize("du", [9, -3])
def test_a_bead_on_a_skew_curve_that_turns_freely(du: float) -> None:
    """P. Painlevé 1895, p. 68: the reaction holds s'' too, so that s'' is one of two roots.

    By hand: the bead's m p'' = m g + N - mu |N| t, the wire's A w' = -(p x R)_z.
    """
    m, inertia, mu = 0.7, 0.15, 0.25

    def derivatives(u: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        first = np.array([-0.3 * math.sin(u) + 0.1, 0.4 * math.cos(u), 0.2])
        return _wire(u), first, np.array([-0.3 * math.cos(u), -0.4 * math.sin(u), 0])

    def rates(t: float, x: np.ndarray) -> list[float]:
        u, du, _, w = x
        p, slope, bend = derivatives(u)  # in the axes of the wire
        z, tangent = np.array([0, 0, 1.0]), slope / np.linalg.norm(slope)
        bias = bend * du**2 + 2 * w * du * np.cross(z, slope) - w**2 * np.array([p[0], p[1], 0])
        size = 0.0
        for _ in range(200):  # |N|
            # unknown u'', w', N (3) with N . tangent = 0
            a = np.zeros((5, 5))
            a[:3, 0], a[:3, 1], a[:3, 2:] = m * slope, m * np.cross(z, p), -np.eye(3)
            a[3, 1], a[3, 2], a[3, 3] = inertia, -p[1], p[0]
            a[4, 2:] = tangent
            friction = -mu * size * np.sign(du) * tangent
            b = np.concatenate([m * np.array([0, 0, -G]) + friction - m * bias,
                                [-(p[0] * friction[1] - p[1] * friction[0]), 0]])  # fmt: skip
            found = np.linalg.solve(a, b)
            before, size = size, float(np.linalg.norm(found[2:]))
            if abs(size - before) < 1e-14 * size:
                break
        return [du, found[0], w, found[1]]

    exact = solve_ivp(rates, (0, 0.25), [0, du, 0, 2], rtol=1e-12, atol=1e-13, method="DOP853")
    turned = np.sign(exact.y[1]) != np.sign(du)
    assert not turned.any(), "the comparison holds until the bead turns back"
    result = model(SKEW.format(du=du)).simulate()
    assert last(result, "g.u", "axle.angle", "axle.speed") == pytest.approx(
        exact.y[[0, 2, 3], -1], rel=1e-9
    )


def _brakes(b: float, spin: float, sign: int) -> float:
    """The friction over the mass of the solid on two points while z' has a sign.

    NA + NB = S = -r w^2, a NA + b NB = sign mu r (|NA| + |NB|).
    """
    mu, r, a, s = 0.2, 0.5, 1.5, -0.5 * spin**2
    for first in (1, -1):
        for second in (1, -1):
            # sizes by their signs: |NA| = first NA, |NB| = second NB
            system = [[1, 1], [a - sign * mu * r * first, b - sign * mu * r * second]]
            one, other = np.linalg.solve(system, [s, 0])
            if first * one >= 0 and second * other >= 0:
                return mu * (abs(one) + abs(other))
    raise AssertionError


@pytest.mark.parametrize("b", [0.3, -0.3])
@pytest.mark.parametrize("spin", [3, 0, -6])
def test_a_solid_on_an_axis_by_two_points(b: float, spin: float) -> None:
    """P. Painlevé 1895, p. 100: constant accelerations up and down; `two_points_axis-1` and -2."""
    if spin == 3:
        assert G - _brakes(b, spin, 1) == pytest.approx({0.3: 8.19, -0.3: 8.91}[b], rel=1e-12)
    result = loaded("two_points_on_an_axis").simulate(
        stop=0.6, parameters={"b": f"{b} m", "w": f"{spin} rad/s"}
    )
    assert last(result, "solid.angular_velocity.z") == pytest.approx([spin], abs=1e-9)
    turns = 4 / (G + _brakes(b, spin, 1))
    speed = -(G - _brakes(b, spin, -1)) * (0.6 - turns)
    assert last(result, "solid.velocity.z") == pytest.approx([speed], rel=1e-9)
    for name in ("upper", "lower"):
        found = [event.time for event in result.events if event.liaison == name]
        assert found == pytest.approx([turns], rel=1e-10)


@pytest.mark.parametrize("factor", [1 - 1e-9, 1 + 1e-9])
def test_a_solid_on_an_axis_hangs_from_mu_equal_to_the_arms_on(factor: float) -> None:
    """P. Painlevé 1895, p. 102: f = (a - b)/(2 r)."""
    values = {"mu": 1.2 * factor, "v": "0 m/s", "w": "0 rad/s"}
    result = loaded("two_points_on_an_axis").simulate(parameters=values)
    assert (last(result, "solid.velocity.z") == [0]) == (factor > 1)


@pytest.mark.parametrize("mass", [1, 1e6, 1e-6])
@pytest.mark.parametrize("curve", ["circle(radius = 1 m, normal = {n})", "{e}"])
@pytest.mark.parametrize("sign", [1, -1])
def test_a_bead_on_a_rough_circle_slows_down_by_both_reactions(
    mass: float, curve: str, sign: int
) -> None:
    """A circle of radius r across gravity: d(v^2)/ds = -2 mu sqrt(g^2 + (v^2/r)^2).

    With w = v^2/(g r) that is asinh(w) = asinh(w_0) - 2 mu s/r. An ellipse of equal semi-axes is
    the circle.
    """
    form = curve.format(n="(1, 2, 2)", e="ellipse(a = 1 m, b = 1 m, normal = (1, 2, 2))")
    first = (2 / 3, 1 / 3, -2 / 3)  # across the normal (1, 2, 2)/3
    along = (-2 / 3, 2 / 3, -1 / 3)  # the normal x first
    scene = model(f"""
        model Round
          world(down = (-1, -2, -2));
          body p: particle(mass = {mass} kg);
          curve c on ground: {form};
          liaison s: point_courbe(p, c) with coulomb(0.1);
        initial
          p.position = {first} m;
          p.velocity = ({", ".join(str(3 * sign * x) for x in along)}) m/s;
          experiment(stop = 0.5 s, tolerance = 1e-11);
        end Round;
        """)
    result = scene.simulate()
    turned = result["s.u"][-1] - result["s.u"][0]
    speed = math.sqrt(sum(x * x for x in last(result, *(f"p.velocity.{c}" for c in "xyz"))))
    left = math.asinh(9 / G) - 0.2 * abs(turned)
    assert speed == pytest.approx(math.sqrt(G * math.sinh(left)), rel=1e-9)
    assert abs(turned) > 1
