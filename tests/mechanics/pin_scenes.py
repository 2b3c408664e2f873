"""Scenes with rotoïdes as texts, and their motion by equations written out by hand."""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp

# `turn` is the direction of gravity; at `th0` = 0 the rod hangs along it.
PENDULUM = """
planar model Pendulum "Homogeneous rod on a horizontal axis"
  parameter Mass m = 1 kg;
  parameter Length l = 1 m;
  parameter Acceleration g = 9.81 m/s^2;
  parameter Angle th0 = 2.5;
  parameter AngularVelocity w0 = 0 rad/s;
  parameter Angle turn = -90 deg;
  parameter Real mu = 0.25;
  parameter Length radius = 40 mm;
  world(gravity = 0 m/s^2);
  body arm: rod(mass = m, length = l);
  liaison hinge: rotoide({places}){laws};
  force weight: on(arm, value = (m*g*cos(turn), m*g*sin(turn)));
  {outputs}
initial
  {sign}hinge.angle = turn + th0;
  {sign}hinge.speed = w0;
  experiment(stop = 3 s, tolerance = 1e-11);
end Pendulum;
"""

_REACTION = "output Force reaction = norm(hinge.force);"


def pendulum(
    *, a_carried: bool = False, friction: bool = False, reaction: bool = False, laws: str = ""
) -> str:
    """The pendulum; `a_carried`: the rod is the first place of the liaison."""
    return PENDULUM.format(
        places="arm.start, ground" if a_carried else "ground, arm.start",
        sign="-" if a_carried else "",
        laws=" with coulomb(mu, radius = radius)" if friction else laws,
        outputs=_REACTION if reaction else "",
    )


# Two heavy points: discs so small that their inertia is nothing.
TWO_POINTS = """
planar model TwoPoints "Vieille 1849, problem II: two heavy points, one below the other"
  parameter Mass m1 = 1 kg;
  parameter Mass m2 = 0.5 kg;
  parameter Length a = 1 m;
  parameter Length b = 0.7 m;
  parameter Angle th0 = 0.5;
  parameter Angle ph0 = -0.3;
  body upper: disc(mass = m1, radius = 1 mm, inertia = 1e-15 kg.m^2);
  body lower: disc(mass = m2, radius = 1 mm, inertia = 1e-15 kg.m^2);
  frame hook on upper at (0 m, a);
  frame eye on lower at (0 m, b);
  liaison O: rotoide(ground, hook);
  liaison A: rotoide(upper, eye);
initial
  upper.angle = th0;
  lower.angle = ph0;
  experiment(stop = 5 s, tolerance = 1e-12);
end TwoPoints;
"""


def chain(count: int, *, reverse: bool = False, laws: str = "") -> str:
    """Rods hanging on one another at their ends, released from absolute angles 0.3 k.

    `reverse` writes the liaisons from the last to the first, with their places exchanged.
    """
    bodies = [
        f"  body r{k}: rod(mass = {1 + 0.2 * k} kg, length = {1 - 0.1 * k} m);"
        for k in range(count)
    ]
    ends = [("ground" if k == 0 else f"r{k - 1}.tip", f"r{k}.start") for k in range(count)]
    liaisons = [
        f"  liaison h{k}: rotoide({f'{b}, {a}' if reverse else f'{a}, {b}'}){laws};"
        for k, (a, b) in enumerate(ends)
    ]
    initial = [
        f"  r{k}.angle = {0.3 * k};\n  r{k}.angular_velocity = {0.1 * k} rad/s;"
        for k in range(count)
    ]
    return "\n".join(
        [
            'planar model Chain "Rods that hang on one another"',
            *bodies,
            *(reversed(liaisons) if reverse else liaisons),
            "initial",
            *initial,
            "  experiment(stop = 2 s, tolerance = 1e-12);",
            "end Chain;",
            "",
        ]
    )


def chain_by_hand(count: int, stop: float) -> np.ndarray:
    """Absolute angles and their rates (2, count) of `chain` at `stop`.

    Lagrange's equations of absolute angles: G of rod k is at the sum of the whole lengths above and
    half its own, so that M_ij = c_ij cos(th_i - th_j), with the couples of centrifugal forces and
    weights that follow from it.
    """
    k = np.arange(count)
    mass, length, g = 1 + 0.2 * k, 1 - 0.1 * k, 9.81
    arm = np.tril(np.outer(np.ones(count), length), -1) + np.diag(length / 2)  # body, angle
    c = arm.T @ (mass[:, None] * arm)
    inertia = np.diag(mass * length**2 / 12)
    moment = mass @ arm

    def slope(_: float, x: np.ndarray) -> np.ndarray:
        th, w = x[:count], x[count:]
        apart = th[:, None] - th[None, :]
        force = -(c * np.sin(apart)) @ w**2 - g * moment * np.cos(th)
        return np.concatenate([w, np.linalg.solve(c * np.cos(apart) + inertia, force)])

    start = np.concatenate([0.3 * k, 0.1 * k])
    run = solve_ivp(slope, (0, stop), start, method="DOP853", rtol=1e-13, atol=1e-14)
    return run.y[:, -1].reshape(2, count)


CART = """
planar model CartOnLine "A pendulum with a bob on a point that slides freely along a slope"
  parameter Angle slope = 20 deg;
  body cart: particle(mass = 2 kg);
  body arm: rod(mass = 1 kg, length = 1 m);
  body bob: particle(mass = 0.5 kg);
  curve rail on ground: line(through = (0, 0) m, direction = (cos(slope), sin(slope)));
  liaison knot: rotoide(arm.tip, bob);
  liaison hinge: rotoide(arm.start, cart);
  liaison guide: point_courbe(cart, rail);
initial
  guide.abscissa = 0.1 m;
  arm.angle = -60 deg;
  experiment(stop = 2 s, tolerance = 1e-12);
end CartOnLine;
"""


def cart_by_hand(slope: float, stop: float) -> np.ndarray:
    """Abscissa, angle of the arm and their rates of `CART` at `stop`."""
    cart, rod, bob, length, g = 2.0, 1.0, 0.5, 1.0, 9.81
    total, first = cart + rod + bob, (rod / 2 + bob) * length
    second = (rod / 3 + bob) * length**2

    def rate(_: float, x: np.ndarray) -> np.ndarray:
        _, th, u, w = x
        mix = first * np.sin(slope - th)  # of abscissa and angle: first (-sin, cos) . (cos, sin)
        mass = np.array([[total, mix], [mix, second]])
        force = [
            first * np.cos(slope - th) * w**2 - total * g * np.sin(slope),
            -g * first * np.cos(th),
        ]
        return np.array([u, w, *np.linalg.solve(mass, force)])

    start = [0.1, -np.pi / 3, 0, 0]
    return solve_ivp(rate, (0, stop), start, method="DOP853", rtol=1e-13, atol=1e-14).y[:, -1]


SLIDER_CRANK = """
planar model SliderCrank "Crank, connecting rod and piston, driven by a couple"
  parameter Length r = 80 mm;
  parameter Length l = 240 mm;
  parameter Torque drive = 4 N.m;
  world(gravity = 0 m/s^2);
  body crank: rod(mass = 0.6 kg, length = r);
  body bielle: rod(mass = 1.1 kg, length = l);
  body piston: particle(mass = 0.9 kg);
  liaison B: rotoide(bielle.tip, piston);
  liaison A: rotoide(crank.tip, bielle.start);
  liaison O: rotoide(ground, crank.start);
  curve bore on ground: line(through = (0, 0) m, direction = (1, 0));
  liaison C: point_courbe(piston, bore);
  force motor: couple(O, value = drive);
initial
  O.angle = 30 deg;
  O.speed = 0 rad/s;
  guess(piston.position = (0.3, 0) m);
  experiment(stop = 0.6 s, tolerance = 1e-11);
end SliderCrank;
"""


def crank_rate(angle: float, turned: float) -> float:
    """Angular velocity of the crank at `angle` when the couple has turned it by `turned` from rest.

    From the kinetic energy alone: one freedom.
    """
    r, length, crank, rod, piston, drive = 0.08, 0.24, 0.6, 1.1, 0.9, 4.0
    sine = r * np.sin(angle) / length
    swing = (
        -r * np.cos(angle) / (length * np.sqrt(1 - sine**2))
    )  # of the rod, per turn of the crank
    phi = -np.arcsin(sine)
    mid = np.array(
        [
            -r * np.sin(angle) - length / 2 * np.sin(phi) * swing,
            r * np.cos(angle) + length / 2 * np.cos(phi) * swing,
        ]
    )
    end = -r * np.sin(angle) - length * np.sin(phi) * swing
    inertia = crank * r**2 / 3 + rod * mid @ mid + rod * length**2 / 12 * swing**2 + piston * end**2
    return float(np.sqrt(2 * drive * turned / inertia))


FREE_PAIR = """
planar model FreePair "Two rods on one pin in empty space, pushed apart by a couple"
  world(gravity = 0 m/s^2);
  body p: rod(mass = 1 kg, length = 1 m);
  body q: rod(mass = 2 kg, length = 0.6 m);
  frame eye on q at (0.1, 0.05) m rotated(angle = 25 deg);
  liaison hinge: rotoide(p.tip, eye){laws};
  force drive: couple(hinge, value = 0.3 N.m*sin(4*time/(1 s)));
initial
  p.position = (0.2, 0.1) m;
  p.velocity = (0.5, -0.2) m/s;
  p.angular_velocity = 1.5 rad/s;
  hinge.angle = 40 deg;
  hinge.speed = -0.7 rad/s;
  experiment(stop = 3 s, tolerance = 1e-12);
end FreePair;
"""
