"""Rods of unlike masses and lengths on dry pins let go from rest: friction falls to rounding.

In free fall each pin carries a small part of what the one before it does: far out friction is a
billionth of the weight. What it does is followed as far as rounding lets it be known, no further.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding

RODS = 14
RIGHT = np.pi / 2


@cache
def chain() -> frot.Model:
    at = ["ground", *(f"b{i}.tip" for i in range(RODS - 1))]
    parts = [
        f"""
  parameter Angle A{i} = 0 rad;
  parameter Mass m{i} = 1 kg;
  parameter Length l{i} = 1 m;
  parameter Real u{i} = 0.1;
  parameter Length p{i} = 1 cm;
  body b{i}: rod(mass = m{i}, length = l{i});
  liaison j{i}: rotoide({at[i]}, b{i}.start) with coulomb(u{i}, mu_s = u{i}*more, radius = p{i});"""
        for i in range(RODS)
    ]
    starts = [f"  b{i}.angle = A{i};\n  b{i}.angular_velocity = 0 rad/s;\n" for i in range(RODS)]
    return frot.compile(f"""planar model Chain
  world(gravity = 9.81 m/s^2);
  parameter Real more = 1;
{"".join(parts)}
initial
{"".join(starts)}
  experiment(stop = 0.2 s);
end Chain;
""")


def draw(seed: int, lengths: float, angles: list[float]) -> dict[str, float]:
    """Masses over four decades, lengths over so many to either side of 1 m."""
    rng = np.random.default_rng(seed)
    values = {"more": float(rng.choice([1.0, 1.2]))}
    for i in range(RODS):
        length = float(10 ** rng.uniform(-lengths, lengths))
        values |= {
            f"m{i}": float(10 ** rng.uniform(-2, 2)),
            f"l{i}": length,
            f"u{i}": float(rng.uniform(0.05, 0.6)),
            f"p{i}": 0.02 * length,
            f"A{i}": float(rng.choice(angles)),
        }
    return values


EVERY_WAY = [0.0, RIGHT, -RIGHT, np.pi]


@pytest.mark.parametrize(
    ("seed", "lengths", "angles", "tolerance"),
    [
        (2, 0.0, EVERY_WAY, 1e-6),  # of reactions that cancel no pass leaves less than rounding
        (2, 0.0, EVERY_WAY, 1e-10),
        (0, 1.0, EVERY_WAY, 1e-10),  # an error that is rounding shortens no step
        (1, 0.5, [0.0], 1e-6),  # slips that slack alone admits end at once
        (100, 0.5, [0.0], 1e-6),
        (142, 0.0, [0.0], 1e-6),
    ],
)
def test_friction_far_out_is_followed_as_far_as_rounding_lets_it(
    seed: int, lengths: float, angles: list[float], tolerance: float
) -> None:
    values = draw(seed, lengths, angles)
    result = chain().simulate(tolerance=tolerance, parameters=values)
    assert result.time[-1] == 0.2
    assert result.figures.steps < 400
    weight = 9.81 * sum(values[f"m{i}"] for i in range(RODS))
    for t in (0.05, 0.1, 0.15, 0.2):
        now = result.at(t)
        for i in range(RODS):
            couple, slip = float(now[f"j{i}.torque"]), float(now[f"j{i}.slip"])
            pin = values[f"u{i}"] * values[f"p{i}"]
            bound = pin * np.hypot(float(now[f"j{i}.force.x"]), float(now[f"j{i}.force.y"]))
            rounding = 1e-12 * weight * pin
            if slip == 0:
                assert abs(couple) <= values["more"] * bound * (1 + 1e-6) + rounding
            else:
                expected = -np.sign(slip) * bound
                assert couple == pytest.approx(expected, rel=1e-6, abs=rounding)
    assert abs(result.balance.residual) <= 1e-5 * result.balance.scale
