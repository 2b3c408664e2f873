"""Bars and tables that slide on too many feet: normal reactions are those of equal springs.

N = a + b x (+ c y) for the feet that bear, by the equilibrium of forces and moments; a foot whose
spring would be stretched bears nothing.
"""

from __future__ import annotations

import functools

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq, fsolve

import frot

G = 9.81
X, MU, HAND = np.array([-0.6, -0.2, 0.2, 0.6]), np.array([0.3, 0.45, 0.3, 0.35]), 0.3


def springs(places: np.ndarray, equilibrium: np.ndarray) -> np.ndarray:
    """N (feet) from rows `places` (feet x unknowns), with places' N = equilibrium."""
    bears = np.ones(len(places), dtype=bool)
    while True:
        own = places[bears]
        if np.linalg.matrix_rank(own, 1e-9) < len(equilibrium):
            raise ValueError("the body tips")
        give = np.linalg.solve(own.T @ own, equilibrium)
        found = np.where(bears, places @ give, 0)
        if np.all(found >= 0):
            return found
        bears &= found > 0


@functools.cache
def bar(pull: str) -> frot.Model:
    """A bar of 2 kg per unit of m, drawn along a floor at any tilt, the hand 0.3 m above it."""
    feet = range(4)
    return frot.compile(
        "\n".join(
            [
                "planar model Bar",
                "  world(gravity = 0 m/s^2);",
                "  parameter Mass m = 2 kg;",
                "  parameter Angle tilt = 0;",
                "  parameter Real side = 1;",
                "  parameter Force F = 9 N;",
                "  parameter Velocity v = 0 m/s;",
                "  Real along = side*cos(tilt);",
                "  Real up = side*sin(tilt);",
                "  body b: rod(mass = m, length = 2 m);",
                *(f"  frame f{i} on b at (side*({X[i]}) m, 0 m);" for i in feet),
                "  frame hand on b at (0, 0.3) m;",
                "  curve floor on ground: line(through = (0, 0) m, "
                "direction = (cos(tilt), sin(tilt)));",
                *(
                    f"  liaison c{i}: contact_ponctuel(f{i}, floor) with coulomb({MU[i]});"
                    for i in feet
                ),
                f"  force drawn: on(hand, value = m/(2 kg)*F*({pull})*(along, up));",
                "  force weight: on(b, value = m*9.81*(1 m/s^2)*(sin(tilt), -cos(tilt)));",
                "initial",
                "  b.position = (0, 0) m;",
                "  b.angle = tilt;",
                "  b.velocity = v*(along, up);",
                "  experiment(stop = 1 s);",
                "end Bar;",
            ]
        )
    )


def normal_forces(pull: float) -> np.ndarray:
    return springs(np.column_stack([np.ones(4), X]), np.array([2 * G, HAND * pull]))


def acceleration(pull: float) -> float:
    return float(pull - MU @ normal_forces(pull)) / 2


@pytest.mark.parametrize("m", [2e-6, 2.0, 2e6])
@pytest.mark.parametrize(("tilt", "side"), [(0.0, 1.0), (0.4, -1.0), (-1.1, 1.0)])
@pytest.mark.parametrize("pull", [9.0, 20.0, 24.0, 30.0])
def test_a_bar_starts_as_on_equal_springs(m: float, tilt: float, side: float, pull: float) -> None:
    """From rest, with one foot that bears nothing at 24 N and 30 N."""
    values = {"m": m, "tilt": tilt, "side": side, "F": pull}
    model = bar("1")
    result = model.simulate(parameters=values)
    found = np.array([float(result[f"c{i}.normal_force"][-1]) for i in range(4)])
    assert found == pytest.approx(normal_forces(pull) * m / 2, rel=1e-11, abs=1e-11 * m)
    way = np.hypot(result["b.position.x"][-1], result["b.position.y"][-1])
    assert way == pytest.approx(acceleration(pull) / 2, rel=1e-11)
    (motion,) = model.motions(parameters=values)
    assert motion.family and motion.springs
    assert motion.values["c3.normal_force"] * 2 / m == pytest.approx(
        normal_forces(pull)[3], rel=1e-11
    )


@pytest.mark.parametrize("m", [2e-6, 2.0, 2e6])
@pytest.mark.parametrize(("tilt", "side"), [(0.0, 1.0), (0.4, -1.0)])
@pytest.mark.parametrize("tolerance", [1e-6, 1e-9, 1e-11])
def test_a_foot_is_unloaded_and_loaded_again_while_the_bar_slides(
    m: float, tilt: float, side: float, tolerance: float
) -> None:
    model = bar("1 + cos(6.283185307179586*time/(1 s))")
    pull = 14.0
    values = {"m": m, "tilt": tilt, "side": side, "F": pull, "v": 0.0}
    result = model.simulate(parameters=values, tolerance=tolerance)

    def force(t: float) -> float:
        return pull * (1 + np.cos(2 * np.pi * t))

    bound = brentq(lambda t: G / 2 + X[0] * HAND * force(t) / (X @ X), 0, 0.5)
    speed = 2 * (
        quad(lambda t: acceleration(force(t)), 0, bound, epsabs=1e-13)[0]
        + quad(lambda t: acceleration(force(t)), bound, 0.5, epsabs=1e-13)[0]
    )
    found = np.hypot(result["b.velocity.x"][-1], result["b.velocity.y"][-1])
    assert found == pytest.approx(speed, abs=max(1e-12, tolerance))


def test_the_dae_slides_as_the_run_does() -> None:
    model = bar("1")
    dae = model.dae()
    modes = {"closed": 1, "reaction_sign": 1, "friction": 2, "rolling": 0, "side": 1}
    mode = [modes[name.split(".")[1]] for name in dae.names.mode]
    x = [0.0] * len(dae.names.x)
    x[dae.names.x.index("der(b.position.x)")] = 0.5
    for m in (2e-6, 2.0, 2e6):
        z = np.array(dae.solve(0, x, [], [m, 0, 1, 9, 0], mode)).ravel()
        found = [z[dae.names.z.index(f"c{i}.normal_force")] for i in range(4)]
        assert found == pytest.approx(normal_forces(9) * m / 2, rel=1e-9)
        assert z[dae.names.z.index("der(der(b.position.x))")] == pytest.approx(
            acceleration(9), rel=1e-9
        )


CORNERS = np.array([[-0.5, -0.4], [0.5, -0.4], [0.5, 0.4], [-0.5, 0.4]])
INERTIA, MASS = 1.5, 10.0


@functools.cache
def table() -> frot.Model:
    feet = range(4)
    return frot.compile(
        "\n".join(
            [
                "model Table",
                "  world(gravity = 0 m/s^2);",
                "  parameter Real scale = 1;",
                "  parameter Angle turn = 0;",
                "  parameter Force pull = 60 N;",
                "  parameter Force side = 0 N;",
                "  parameter Length h = 0.3 m;",
                "  parameter Velocity vx = 0 m/s;",
                "  parameter Velocity vy = 0 m/s;",
                "  parameter AngularVelocity w = 0 rad/s;",
                *(f"  parameter Real mu{i} = 0.3;" for i in feet),
                "  body t: solid(mass = scale*10 kg, "
                "inertia = scale*(1.2 kg.m^2, 1.0 kg.m^2, 1.5 kg.m^2));",
                "  surface floor on ground: "
                "plane(through = (0, 0, 0) m, normal = (0, -sin(turn), cos(turn)));",
                *(f"  frame f{i} on t at ({x}, {y}, 0) m;" for i, (x, y) in enumerate(CORNERS)),
                "  frame hand on t at (0 m, 0.1 m, h);",
                *(
                    f"  liaison c{i}: contact_ponctuel(f{i}, floor) with coulomb(mu{i});"
                    for i in feet
                ),
                "  force drawn: on(hand, value = scale*(pull, side*cos(turn), side*sin(turn)));",
                "  force weight: on(t, value = scale*98.1 N*(0, sin(turn), -cos(turn)));",
                "initial",
                "  t.position = (0, 0, 0) m;",
                "  t.orientation = (cos(turn/2), sin(turn/2), 0, 0);",
                "  t.velocity = (vx, vy*cos(turn), vy*sin(turn));",
                "  t.angular_velocity = w*(0, -sin(turn), cos(turn));",
                "  experiment(stop = 1 s);",
                "end Table;",
            ]
        )
    )


def of_table(pull: float, side: float, h: float, turned: float = 0.0) -> tuple[np.ndarray, ...]:
    """N of the feet, their places and that of the hand, the table turned about the normal."""
    c, s = np.cos(turned), np.sin(turned)
    turn = np.array([[c, -s], [s, c]])
    feet, hand = CORNERS @ turn.T, turn @ np.array([0, 0.1])
    rows = np.column_stack([np.ones(4), feet[:, 1], -feet[:, 0]])
    return springs(rows, np.array([MASS * G, h * side, -h * pull])), feet, hand


def moved(mu: np.ndarray, n: np.ndarray, feet: np.ndarray, way: np.ndarray) -> np.ndarray:
    """Force and couple of the friction against the ways (feet x 2)."""
    friction = -(mu * n)[:, None] * way / np.linalg.norm(way, axis=1)[:, None]
    return np.array(
        [*friction.sum(0), (feet[:, 0] * friction[:, 1] - feet[:, 1] * friction[:, 0]).sum()]
    )


def ways(feet: np.ndarray, u: np.ndarray) -> np.ndarray:
    return np.column_stack([u[0] - u[2] * feet[:, 1], u[1] + u[2] * feet[:, 0]])


def start_of(
    load: np.ndarray, masses: np.ndarray, mu: np.ndarray, n: np.ndarray, feet: np.ndarray
) -> np.ndarray | None:
    """Accelerations from rest, each foot against its own; None where they are not found."""

    def missing(u: np.ndarray) -> np.ndarray:
        return load + moved(mu, n, feet, ways(feet, u)) - masses * u

    u = fsolve(missing, load / masses, xtol=1e-13)
    return u if np.max(np.abs(missing(u))) < 1e-9 else None


@pytest.mark.parametrize(("scale", "turn"), [(1.0, 0.0), (1e6, 0.7), (1e-6, -1.2)])
def test_a_table_starts_as_on_equal_springs(scale: float, turn: float) -> None:
    random, model, started = np.random.default_rng(17), table(), 0
    for _ in range(12):
        mu, h = random.uniform(0.1, 0.6, 4), random.uniform(0, 0.5)
        pull, side = random.uniform(55, 90), random.uniform(-60, 60)
        try:
            n, feet, hand = of_table(pull, side, h)
        except ValueError:
            continue
        load = np.array([pull, side, hand[0] * side - hand[1] * pull])
        masses = np.array([MASS, MASS, INERTIA])
        u = start_of(load, masses, mu, n, feet)
        if u is None:
            continue
        values = {"scale": scale, "turn": turn, "pull": pull, "side": side, "h": h}
        values |= {f"mu{i}": mu[i] for i in range(4)}
        now = model.simulate(parameters=values, stop=1e-3).at(0.0)
        found = [float(now[f"c{i}.normal_force"]) for i in range(4)]
        assert found == pytest.approx(n * scale, rel=1e-9, abs=1e-9 * scale)
        assert float(now["t.acceleration.x"]) == pytest.approx(u[0], rel=1e-8)
        if started == 0:
            (motion,) = model.motions(parameters=values)
            assert motion["t.acceleration.x"] == pytest.approx(u[0], rel=1e-9)
            assert motion["c0.normal_force"] == pytest.approx(n[0] * scale, rel=1e-9)
        started += 1
    assert started > 6


@pytest.mark.parametrize(("scale", "turn"), [(1.0, 0.0), (1e6, 0.7)])
def test_a_table_slides_and_a_foot_bears_nothing_for_a_while(scale: float, turn: float) -> None:
    """Against a converged solution: the error follows the tolerance."""
    mu, pull, side, h = np.array([0.2, 0.5, 0.3, 0.45]), 80.0, 10.0, 0.42

    def slope(t: float, y: np.ndarray) -> np.ndarray:
        n, feet, hand = of_table(pull, side, h, y[2])
        load = np.array([pull, side, hand[0] * side - hand[1] * pull])
        total = load + moved(mu, n, feet, ways(feet, y[3:]))
        return np.array([*y[3:], *total / [MASS, MASS, INERTIA]])

    start = [0, 0, 0, 1.0, 0.2, 0.5]
    reference = solve_ivp(slope, (0, 1), start, "DOP853", rtol=1e-11, atol=1e-12, max_step=0.01)
    unloaded = [np.min(of_table(pull, side, h, a)[0]) == 0 for a in reference.y[2]]
    assert 0 < sum(unloaded) < len(unloaded)
    values = {"scale": scale, "turn": turn, "pull": pull, "side": side, "h": h}
    values |= {f"mu{i}": mu[i] for i in range(4)} | {"vx": 1.0, "vy": 0.2, "w": 0.5}
    for tolerance, error in ((1e-5, 3e-5), (1e-7, 1e-7), (1e-9, 2e-9)):
        result = table().simulate(parameters=values, tolerance=tolerance)
        end = result.at(1.0)
        assert float(end["t.position.x"]) == pytest.approx(reference.y[0, -1], abs=error)
        spin = np.hypot(float(end["t.angular_velocity.y"]), float(end["t.angular_velocity.z"]))
        assert spin == pytest.approx(abs(reference.y[5, -1]), abs=error)
