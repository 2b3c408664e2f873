"""States that die out, and what is left of them feeds others: errors follow the tolerance.

References: H. Bateman, Proc. Cambridge Phil. Soc. 15 (1910) 423, in eighty digits; E5 of W. H.
Enright, T. E. Hull, B. Lindberg, BIT 15 (1975) 10, by SciPy's Radau at 1e-12 on the logarithms of
its states.
"""

from __future__ import annotations

from decimal import Decimal, getcontext

import numpy as np
import pytest

import frot

E5 = """model E5
  constant AngularVelocity k = 1 s^-1;
  Real y[4];
initial
  y[1] = 1.76e-3; y[2] = 0; y[4] = 0;
equation
  der(y[1]) = -k*(7.89e-10*y[1] + 1.1e7*y[1]*y[3]);
  der(y[2]) = k*(7.89e-10*y[1] - 1.13e9*y[2]*y[3]);
  y[3] = y[2] - y[4];
  der(y[4]) = k*(1.1e7*y[1]*y[3] - 1.13e3*y[4]);
  experiment(stop = 1e13 s);
end E5;
"""
# time, y[1], y[2], y[3]
E5_REFERENCE = (
    (1e2, np.exp(-6.346161102), 1.088906102e-10, 6.02636214e-12),
    (1e5, np.exp(-11.8031012), 2.373478156e-12, 2.212358669e-12),
    (1e8, np.exp(-26.12021685), 1.783069946e-15, 1.783069867e-15),
    (1e10, np.exp(-40.41187597), 1.571263289e-18, 1.571263289e-18),
    (1e13, None, 8.861233521e-23, 8.861233521e-23),
)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8])
def test_what_dies_out_over_twenty_decades_feeds_what_stays(tolerance: float) -> None:
    """Rounding of rates that have died out since is no excuse for the next error."""
    result = frot.compile(E5).simulate(tolerance=tolerance)
    for time, *exact in E5_REFERENCE:
        found = result.at(time)
        for i, value in enumerate(exact, start=1):
            if value is not None:
                assert found[f"y[{i}]"] == pytest.approx(value, rel=10 * tolerance), (time, i)


CHAIN = """model Chain
  parameter Frequency k[5] = (1 Hz, 1 Hz, 1 Hz, 1 Hz, 1 Hz);
  parameter Real part[5] = (1, 1, 1, 1, 1);
  Real x[5];
initial
  x[1] = 1;
  for i in 2:5 loop
    x[i] = 0;
  end for;
equation
  der(x[1]) = -k[1]*x[1];
  for i in 2:5 loop
    der(x[i]) = part[i-1]*k[i-1]*x[i-1] - k[i]*x[i];
  end for;
  experiment(stop = 1e6 s, method = METHOD);
end Chain;
"""
# rates, and the part of what each loses that the next one gets
CHAINS = (
    ((40.0, 2e-3, 3e-6, 2e-6, 6e3), (9e-2, 2e-5, 6e-4, 3e-6, 1.0)),
    ((1.0, 3e5, 5e-5, 2e5, 6e-3), (1e-7, 9e-3, 8e-8, 4e-6, 1.0)),
    ((3e5, 3e-4, 9e3, 6e-5, 1.0), (4e-11, 2e-4, 1e-2, 1e-7, 1.0)),
    ((8e-3, 7e5, 7e-3, 3e3, 3e4), (5e-8, 2e-7, 3e-8, 2e-11, 1.0)),
)


def bateman(rates: tuple[float, ...], parts: tuple[float, ...], time: float) -> list[Decimal]:
    """The states of a chain at a time."""
    getcontext().prec = 80
    k = [Decimal(rate) for rate in rates]
    states, fed = [], Decimal(1)
    for n in range(len(k)):
        total = Decimal(0)
        for j in range(n + 1):
            apart = Decimal(1)
            for i in range(n + 1):
                apart *= k[i] - k[j] if i != j else 1
            total += (-k[j] * Decimal(time)).exp() / apart
        states.append(fed * total)
        fed *= Decimal(parts[n]) * k[n]
    return states


@pytest.mark.parametrize(
    ("method", "tolerances"), [("auto", (1e-3, 1e-5, 1e-8)), ("implicit", (1e-5, 1e-8))]
)
@pytest.mark.parametrize("chain", range(len(CHAINS)))
def test_decays_that_feed_each_other_over_twelve_decades(
    chain: int, method: str, tolerances: tuple[float, ...]
) -> None:
    """Each state, until it has fallen by 28 decades, once it is a hundredth of what it comes to."""
    rates, parts = CHAINS[chain]
    times = [10.0**power for power in np.arange(-6, 6.1, 0.5)]
    exact = [bateman(rates, parts, time) for time in times]
    model = frot.compile(CHAIN.replace("METHOD", method))
    for tolerance in tolerances:
        result = model.simulate(
            tolerance=tolerance, parameters={"k": list(rates), "part": list(parts)}
        )
        assert result.figures.steps < 2500
        for i in range(len(rates)):
            history = [states[i] for states in exact]
            for n, value in enumerate(history):
                rises, is_gone = (
                    max(history[n:]) > 100 * value,
                    max(history) > value * Decimal(10) ** 28,
                )
                if times[n] < 1e-3 or rises or is_gone:
                    continue
                found = Decimal(float(result.at(times[n])[f"x[{i + 1}]"]))
                assert abs(found / value - 1) < 20 * tolerance, (tolerance, times[n], i + 1)
