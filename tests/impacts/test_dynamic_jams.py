"""A rod whose slip runs into Painlevé's coefficient p = 0, where its reaction grows without bound.

F. Génot, B. Brogliato (1999): from an open set of starts p and the acceleration b of the tip vanish
together. Where the reaction becomes infinite an impact without collision follows (A. Nordmark,
P. Várkonyi, A. Champneys 2018): the friction presses until the slip ends.
"""

from __future__ import annotations

import math

import pytest
import sliding_rod

import frot

G = 9.81


JAMS = {"start": 0.4, "rate": 3.0, "slip": -10.0}


def rod(on_impasse: str) -> frot.Model:
    return sliding_rod.rod(f"tolerance = 1e-10, on_impasse = {on_impasse}")


def coefficient(mu: float, angle: float) -> float:
    c, s = math.cos(angle), math.sin(angle)
    return 1 + 3 * c * c - 3 * mu * s * c


@pytest.mark.parametrize(
    "values",
    [
        {},
        {"side": -1.0},
        {"m": 1e6},
        {"m": 1e-6, "side": -1.0},
        {"mu": 2.2, "rate": 3.3},
        {"slip": -20.0},
    ],
)
def test_a_tangential_impact_ends_the_slip_where_the_coefficient_is_zero(
    values: dict[str, float],
) -> None:
    result = rod("impact").simulate(parameters={**JAMS, **values})
    hit = next(e for e in result.events if e.kind == "tangential_impact")
    mu, m, side = values.get("mu", 2.0), values.get("m", 1.0), values.get("side", 1.0)
    before = result.at(hit.time * (1 - 1e-13))
    angle = before["rod.angle"] if side > 0 else math.pi - before["rod.angle"]
    # Both vanish: p, and with the length 1 m to the middle omega^2 sin - g.
    assert coefficient(mu, angle) == pytest.approx(0, abs=1e-11)
    # The latter as the cube root of the time left, which is 1e-14 s here.
    assert before["rod.angular_velocity"] ** 2 * math.sin(angle) == pytest.approx(G, rel=5e-4)
    # The slip per impulse: mu W_tt + W_tn, with W in 1/m.
    c, s = math.cos(angle), math.sin(angle)
    slip = abs(float(result.at(hit.time * (1 - 1e-15))["tip.slip"]))
    impulse = m * slip / (mu * (1 + 3 * s * s) - 3 * s * c)
    assert hit.impulse == pytest.approx(impulse, rel=1e-5)
    assert abs(float(result.at(hit.time)["tip.slip"])) < 1e-8 * slip
    assert result.time[-1] == 0.2


def test_the_run_stops_there_by_name_where_the_text_asks_for_it() -> None:
    with pytest.raises(frot.SimulationError, match=r"E0901.*'tip'.*jamming"):
        rod("stop").simulate(parameters=JAMS)
