"""Couples on bodies in space: a vector in ground axes; in a liaison a number about its axis."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import frot
from tests.space.newton_euler import axes

CHAIN = """
model Chain "A couple on the last link, and a pair of forces that make the same"
  parameter Integer n = 9;
  body a[n]: box(mass = 1 kg, size = (0.1, 0.2, 1) m);
  body b[n]: box(mass = 1 kg, size = (0.1, 0.2, 1) m);
  frame c on b[n] at (0, 0.1, 0) m;
  frame d on b[n] at (0, -0.1, 0) m;
  liaison p: spherique(ground, a[1].top);
  liaison q: spherique(ground, b[1].top);
  liaison u[n - 1]: spherique(a[1:n - 1].bottom, a[2:n].top);
  liaison v[n - 1]: spherique(b[1:n - 1].bottom, b[2:n].top);
  force one: couple(a[n], value = 0.2 m*cross(a[n].ey, (3, 2, -1) N));
  force up: on(c, value = (3, 2, -1) N);
  force down: on(d, value = -(3, 2, -1) N);
  experiment(stop = 0.5 s, tolerance = 1e-11);
end Chain;
"""


def test_a_couple_turns_a_body_as_euler_says() -> None:
    """Against the equations of a free body, integrated by another method."""
    result = frot.compile("""
model Turned "A box, a couple that grows"
  body s: box(mass = 2 kg, size = (0.3, 0.5, 0.7) m);
  force f: couple(value = (0.1 N.m, 0.2 N.m, 0.3 N/s*time*(1 m)), holder = s);
initial
  s.angular_velocity = (1, 2, 3) rad/s;
  experiment(stop = 1 s, tolerance = 1e-12);
end Turned;
""").simulate()
    inertia = np.diag([0.25 + 0.49, 0.49 + 0.09, 0.09 + 0.25]) / 6

    def rate(t: float, y: np.ndarray) -> np.ndarray:
        w, turn = y[:3], axes(y[3:] / np.linalg.norm(y[3:]))
        own = turn @ inertia @ turn.T
        couple = np.array([0.1, 0.2, 0.3 * t]) - np.cross(w, own @ w)
        q = 0.5 * np.array([-w @ y[4:], *(y[3] * w + np.cross(w, y[4:]))])
        return np.concatenate((np.linalg.solve(own, couple), q))

    begin = (1, 2, 3, 1, 0, 0, 0)
    want = solve_ivp(rate, (0, 1), begin, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
    got = [result.at(1.0)[f"s.angular_velocity.{c}"] for c in "xyz"]
    assert got == pytest.approx(want[:3], abs=1e-10)


def test_a_couple_is_a_pair_of_forces() -> None:
    """On the last link of a tree that keeps its recursion."""
    result = frot.compile(CHAIN).simulate()
    for axis in "xyz":
        one, pair = result[f"a[9].position.{axis}"], result[f"b[9].position.{axis}"]
        assert np.abs(one - pair).max() < 1e-9
    assert np.ptp(result["a[9].position.x"]) > 0.01


@pytest.mark.parametrize(
    ("holder", "value", "told"),
    [
        ("s", "1 N.m", "expected a vector of 3 torques"),
        ("p", "(0, 0, 1) N.m", "expected a torque"),
        ("m", "(0, 0, 1) N.m", "does not turn"),
        ("k", "1 N.m", "has no angle"),
    ],
)
def test_a_couple_of_another_form_is_told(holder: str, value: str, told: str) -> None:
    with pytest.raises(frot.FrotError, match=told):
        frot.compile(f"""
model Wrong "Couples that mean nothing"
  body s: box(mass = 1 kg, size = (1, 1, 1) m);
  body m: particle(mass = 1 kg);
  liaison p: rotoide(ground, s);
  liaison k: prismatique(ground, m);
  force f: couple({holder}, value = {value});
end Wrong;
""").report()
