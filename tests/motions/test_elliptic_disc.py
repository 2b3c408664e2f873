"""Sliding motions of an elliptic disc on a rough line (Painlevé 1895, p. 82-83): one, two or none.

The disc cannot leave the line. Beyond a critical coefficient one sense of the slip has two motions
and the other none. Values from the two equations of the disc, with the sign eps of the reaction.
"""

from __future__ import annotations

import math

import pytest
from test_planar_motions import compiled

G = 9.81
TEXT = """
planar model Disc
  parameter Length a = 1 m;
  parameter Length b = 0.3 m;
  parameter Real mu = 0.3;
  parameter Angle angle = 0;
  parameter AngularVelocity turning = 0.2 rad/s;
  parameter Velocity speed = 1 m/s;
  parameter Mass m = 1 kg;
  body disc: ellipse(mass = m, a = a, b = b);
  liaison floor: contact_ponctuel(ground.line, disc.rim, unilateral = false) with coulomb(mu);
initial
  disc.angle = angle;
  disc.angular_velocity = turning;
  disc.position.x = 0 m;
  disc.velocity.x = speed;
  experiment(stop = 0.5 s, on_impasse = stop, on_indeterminate = stop);
end Disc;
"""


def expected(
    a: float, b: float, mu: float, th: float, w: float, u: float
) -> list[tuple[float, ...]]:
    """(N, x'', theta'') of every admissible sliding motion of a disc of 1 kg.

    Height h = sqrt(a^2 sin^2 + b^2 cos^2) of the centre; the point of contact is beside it by
    -h' = -(a^2 - b^2) sin cos/h, so that the couple of N about G is -h' N and that of T is h T.
    """
    s, c = math.sin(th), math.cos(th)
    h = math.sqrt(a * a * s * s + b * b * c * c)
    first = (a * a - b * b) * s * c / h
    second = ((a * a - b * b) * (c * c - s * s) - first * first) / h
    inertia = (a * a + b * b) / 4
    slip = u + h * w
    found = []
    for eps in (1, -1):
        # N = G + h'' w^2 + h' theta'', T = -mu eps N sign(slip), I theta'' = -h' N + h T
        per_normal = (-first - mu * eps * math.copysign(1, slip) * h) / inertia
        normal = (G + second * w * w) / (1 - first * per_normal)
        if eps * normal > 0:
            force = -mu * eps * normal * math.copysign(1, slip)
            found.append((normal, force, per_normal * normal))
    return found


CASES = [
    (1.0, 0.3, 0.3, 0.5, 0.2, 1.0),
    (1.0, 0.1, 1.6, -1.1, 0.2, 1.0),
    (1.0, 0.1, 1.6, -1.1, -0.2, -1.0),
    (1.0, 0.1, 1.6, 1.1, 0.2, 1.0),
    (1.0, 0.6, 0.5, 2.0, 0.4, -2.0),
]


def test_the_equations_give_the_values_of_the_worked_example() -> None:
    (one,) = expected(*CASES[0])
    assert one == pytest.approx((3.046939874232486, -0.9140819622697458, -9.66171283222298))
    assert expected(*CASES[1]) == []
    assert len(expected(*CASES[2])) == len(expected(*CASES[3])) == 2


@pytest.mark.parametrize("m", [1.0, 1e-6])
@pytest.mark.parametrize("case", CASES)
def test_all_sliding_motions_are_listed(case: tuple[float, ...], m: float) -> None:
    names = ("a", "b", "mu", "angle", "turning", "speed")
    values = dict(zip(names, case, strict=True))
    found = compiled(TEXT).motions(parameters={**values, "m": m})
    told = sorted(
        (
            motion["floor.normal_force"] / m,
            motion["disc.acceleration.x"],
            motion["disc.angular_acceleration"],
        )
        for motion in found
    )
    right = sorted(expected(*case))
    assert found.complete and len(told) == len(right)
    for own, one in zip(told, right, strict=True):
        assert own == pytest.approx(one, rel=1e-9)
