"""Four-bars of rods whose links can all lie on one line: a + c = b + g."""

from __future__ import annotations

import casadi as ca

G = 9.81


def one_line(
    a: float, b: float, c: float, g: float, x: ca.SX, side: ca.SX | float
) -> tuple[ca.SX, ca.SX, ca.SX]:
    """Twice the kinetic energy at unit crank speed, the potential and the coupler's far end.

    By the crank's angle x. With r from D to the crank's tip, half of the angle at D between r and
    the follower has the cosine sin(x/2) sqrt(a g (b + r + c)/(b r (r + g - a))): with its sign it
    is smooth where all links lie on one line, at x = 0.
    """
    tip = a * ca.vertcat(ca.cos(x), ca.sin(x))
    way = tip - ca.vertcat(g, 0)
    r = ca.norm_2(way)
    half = ca.sin(x / 2) * ca.sqrt(a * g * (b + r + c) / (b * r * (r + g - a)))
    turn = 2 * side * ca.acos(half)
    along = ca.vertcat(
        ca.cos(turn) * way[0] - ca.sin(turn) * way[1], ca.sin(turn) * way[0] + ca.cos(turn) * way[1]
    )
    end = ca.vertcat(g, 0) + b / r * along
    tip_rate, end_rate = ca.jacobian(tip, x), ca.jacobian(end, x)
    kinetic = (ca.sumsqr(tip_rate) + ca.sumsqr(end_rate)) / 3
    kinetic += ca.sumsqr(tip_rate + end_rate) / 4 + ca.sumsqr(end_rate - tip_rate) / 12
    return kinetic, G * (tip[1] + end[1]), end
