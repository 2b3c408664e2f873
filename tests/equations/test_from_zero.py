"""Equations that start from zero: terms that cancel have grown far above what they drive."""

from __future__ import annotations

import functools
from collections.abc import Sequence

import casadi as ca
import numpy as np
import pytest
from frot.compiler.symbolic.sums import sizes_of_terms
from scipy.integrate import solve_ivp

import frot


@functools.cache
def beam(n: int) -> frot.Model:
    """The beam of E. Hairer and G. Wanner (Solving ODE II, sect. IV.10) of n segments, at rest."""
    return frot.compile(f"""
model Beam
  constant Integer n = {n};
  constant Frequency one = 1 1/s;
  Angle th[n];
  Real om[n];
  Real v[n], g[n], w[n], s[n], c[n], F;
initial
  th = zeros(n);
  om = zeros(n);
equation
  F = if time < pi*1 s then 1.5*sin(time*one)^2 else 0;
  v[1] = n^4*(-3*th[1] + th[2]) + n^2*F*(cos(th[1]) + sin(th[1]));
  for i in 2:n - 1 loop
    v[i] = n^4*(th[i - 1] - 2*th[i] + th[i + 1]) + n^2*F*(cos(th[i]) + sin(th[i]));
  end for;
  v[n] = n^4*(th[n - 1] - th[n]) + n^2*F*(cos(th[n]) + sin(th[n]));
  s[1] = 0;
  c[1] = 1;
  for i in 2:n loop
    s[i] = sin(th[i] - th[i - 1]);
    c[i] = cos(th[i] - th[i - 1]);
  end for;
  g[1] = s[2]*v[2] + om[1]^2;
  w[1] - c[2]*w[2] = g[1];
  for i in 2:n - 1 loop
    g[i] = -s[i]*v[i - 1] + s[i + 1]*v[i + 1] + om[i]^2;
    -c[i]*w[i - 1] + 2*w[i] - c[i + 1]*w[i + 1] = g[i];
  end for;
  g[n] = -s[n]*v[n - 1] + om[n]^2;
  -c[n]*w[n - 1] + 3*w[n] = g[n];
  for i in 1:n loop
    der(th[i]) = one*om[i];
  end for;
  der(om[1]) = one*(v[1] - c[2]*v[2] + s[2]*w[2]);
  for i in 2:n - 1 loop
    der(om[i]) = one*(2*v[i] - c[i]*v[i - 1] - c[i + 1]*v[i + 1]
      - s[i]*w[i - 1] + s[i + 1]*w[i + 1]);
  end for;
  der(om[n]) = one*(3*v[n] - c[n]*v[n - 1] - s[n]*w[n - 1]);
  experiment(stop = 5 s);
end Beam;""")


def slopes(t: float, state: np.ndarray, pushed: bool) -> np.ndarray:
    """The same equations: (th, om)' with the matrix of the segments, bidiagonal in exp(i th)."""
    n = len(state) // 2
    th, om = state[:n], state[n:]
    force = 1.5 * np.sin(t) ** 2 if pushed else 0.0
    v = -2 * n**4 * th + n**2 * force * (np.cos(th) + np.sin(th))
    v[0] -= n**4 * th[0]
    v[-1] += n**4 * th[-1]
    v[1:] += n**4 * th[:-1]
    v[:-1] += n**4 * th[1:]
    sine, cosine = np.sin(np.diff(th)), np.cos(np.diff(th))
    own = np.full(n, 2.0)
    own[0], own[-1] = 1, 3
    c = np.diag(own) - np.diag(cosine, 1) - np.diag(cosine, -1)
    d = np.diag(sine, 1) - np.diag(sine, -1)
    w = np.linalg.solve(c, d @ v + om**2)
    return np.concatenate([om, c @ v + d @ w])


@functools.cache
def at_end(n: int) -> np.ndarray:
    """The angles at t = 5 by another method, to some 1e-12."""
    state = np.zeros(2 * n)
    for span, pushed in (((0, np.pi), True), ((np.pi, 5), False)):
        state = solve_ivp(
            slopes, span, state, method="DOP853", rtol=1e-12, atol=1e-15, args=(pushed,)
        ).y[:, -1]
    return np.asarray(state[:n])


@pytest.mark.parametrize("tolerance", [1e-3, 1e-5, 1e-6, 1e-7, 1e-9, 1e-12])
@pytest.mark.parametrize("n", [2, 3, 4, 5, 8])
def test_a_beam_is_bent_from_rest_at_zero(n: int, tolerance: float) -> None:
    """Of n segments the first begins as t^(2n + 2), far below the rounding of the loads t^2 whose
    difference bends it."""
    result = beam(n).simulate(tolerance=tolerance)
    angles = np.array([result[f"th[{k + 1}]"][-1] for k in range(n)])
    assert np.abs(angles - at_end(n)).max() < tolerance + 1e-11
    assert result.figures.steps < 2500


def sizes(expression: Sequence[ca.SX], values: dict[ca.SX, float]) -> list[float]:
    function = ca.Function("f", list(values), [sizes_of_terms(ca.vertcat(*expression))])
    return [float(x) for x in np.asarray(function(*values.values())).ravel()]


def test_terms_of_sums_are_found_behind_factors_and_branches() -> None:
    """A function of a sum is one term, and what is no sum has none."""
    a, b, c = ca.SX.sym("a"), ca.SX.sym("b"), ca.SX.sym("c")
    values = {a: 3.0, b: -5.0, c: 2.0}
    told = [a - b, (a + b) / c, -c * (a + b), ca.if_else(c > 0, a + b, 0), a * b, ca.sin(a + b)]
    assert sizes(told, values) == [8, 4, 16, 8, 0, 0]
    kept = 2 * (3 + abs(np.sin(3))) + 3
    assert sizes([(a + ca.sin(b + c)) * c - a], values) == pytest.approx([kept])
