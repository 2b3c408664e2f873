"""Contacts that friction holds, contacts at rest beside others, and impacts without a last turn."""

from __future__ import annotations

import ctypes as ct

import numpy as np
import pytest
from frot.runtime.impact_law import ENERGETIC, NEWTON, POISSON, friction, normal
from frot.runtime.impact_law import solve_impact as solve

import frot

LAWS = (ENERGETIC, POISSON, NEWTON)


@pytest.mark.parametrize("scale", [1, 1e6, 1e-6])
@pytest.mark.parametrize("side", [1, -1])
def test_a_wedge_that_friction_holds_gives_nothing_back(
    kernel: ct.CDLL, scale: float, side: float
) -> None:
    """One degree of freedom moves both rows: stuck, no force of the spring moves it.

    The impulse of compression is |u_n|/(W_nn + mu |W_nt|) while it slips; with W_nt^2 = W_nn W_tt
    both speeds end at once.
    """
    row = np.array([1.0, 0.6 * side])
    w = scale * np.outer(row, row)
    before = -2.0 * row
    for law in (ENERGETIC, POISSON):
        found = solve(kernel, w, before, [normal(0, 0.7, law), friction(1, 1, 0, 2.0)])
        compression = 2 / (scale * (1 + 2.0 * 0.6))
        assert found.status == 0
        assert found.u == pytest.approx([0, 0], abs=1e-14)
        given_back = 0.7 if law == POISSON else 0.0
        assert found.p[0] == pytest.approx((1 + given_back) * compression, rel=1e-12)
        assert sum(found.lost) == pytest.approx(2 / scale, rel=1e-12)
    found = solve(kernel, w, before, [normal(0, 0.7, NEWTON), friction(1, 1, 0, 2.0)])
    assert found.status == 2


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("e", [0.0, 0.12, 0.6])
def test_two_contacts_that_take_turns_come_to_an_end(kernel: ct.CDLL, e: float, law: int) -> None:
    """A light body between two cords throws each taut in turn, in a ratio: both end at rest.

    In the limit the impulses are those of rigid contacts, p = -W^-1 u.
    """
    w = np.array([[3905.8553, -3859.8944], [-3859.8944, 5971.2941]])
    before = np.array([0.0, -6.58418376])
    found = solve(kernel, w, before, [normal(0, e, law), normal(1, e, law)])
    assert found.status == 0
    assert found.u.min() >= 0
    assert found.u == pytest.approx(before + w @ found.p, abs=1e-8)
    lost = -0.5 * found.p @ (before + found.u)
    assert lost >= 0
    assert sum(found.lost) == pytest.approx(lost, abs=1e-9)
    if e < 0.2 and law != NEWTON:
        assert found.u == pytest.approx([0, 0], abs=1e-8)
        assert found.p == pytest.approx(-np.linalg.solve(w, before), rel=1e-8)


@pytest.mark.parametrize("e", [0.3, 0.7])
def test_newton_asks_nothing_of_a_contact_at_rest(kernel: ct.CDLL, e: float) -> None:
    """It bears the impulse of the one that meets: u_2 = -e u, u_1 = 0 where W_12 < 0."""
    w = np.array([[4.0, -2.0], [-2.0, 4.0]])
    found = solve(kernel, w, [0.0, -0.5], [normal(0, e, NEWTON), normal(1, e, NEWTON)])
    assert found.status == 0
    assert found.u == pytest.approx([0, 0.5 * e], abs=1e-13)
    assert found.p == pytest.approx(np.linalg.solve(w, [0, 0.5 * (1 + e)]), rel=1e-12)


SLAP = """
    planar model Slap
      parameter Real mu = 1;
      parameter Real e = 0.4;
      parameter Mass m = 1 kg;
      parameter Length l = 1 m;
      parameter Angle lean = 0.1 rad;
      parameter Real g = 9.81;
      world(gravity = g*1 m/s^2);
      body b: rod(mass = m, length = l);
      liaison c0: contact_ponctuel(b.tip, ground.line) with coulomb(mu), restitution(e);
      liaison c1: contact_ponctuel(b.start, ground.line) with coulomb(mu), restitution(e);
    initial
      b.position = (0 m, l/2*abs(sin(lean)));
      b.angle = lean;
      experiment(stop = 0.5 s);
    end Slap;
    """


@pytest.mark.parametrize("mu", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("e", [0.0, 0.4, 0.9])
def test_a_rod_slaps_down_on_its_other_end(mu: float, e: float) -> None:
    """Mirrored, of other masses and scales of length it does the same; energy is kept."""
    program = frot.compile(SLAP)
    ways: list[dict[str, float | str]] = [
        {},
        {"lean": "-0.1 rad"},
        {"m": "1e6 kg"},
        {"m": "1e-6 kg"},
    ]
    first = None
    for way in ways:
        result = program.simulate(parameters={**way, "mu": mu, "e": e})
        assert result.balance.relative < 1e-9
        met = next(event for event in result.events if event.kind.endswith("impact"))
        lost = sum(e.energy_lost for e in result.events if e.time == met.time)
        share = lost / result.balance.scale
        first = first or (met.time, share)
        assert met.time == pytest.approx(first[0], rel=1e-9)
        assert share == pytest.approx(first[1], rel=1e-8)
        end = result.at(0.5)
        assert float(end["c0.gap"]) > -1e-12
        assert float(end["c1.gap"]) > -1e-12


BETWEEN = """
    planar model Between
      parameter Real e = 0.5;
      body b: polygon(mass = 1 kg, vertices = ((0.02, 0.04) m, (0.2, 0) m, (0.1, 0.2) m));
      liaison c1: contact_ponctuel(ground.line, b.corners[1])
        with restitution(e, rule = poisson), coulomb(0.3, mu_s = 0.4);
      liaison c2: contact_ponctuel(ground.line, b.corners[2])
        with restitution(e, rule = poisson), coulomb(0.3, mu_s = 0.4);
      liaison c3: contact_ponctuel(ground.line, b.corners[3])
        with restitution(e, rule = poisson), coulomb(0.3, mu_s = 0.4);
    initial
      b.position = (0, 1) m;
      b.angle = 0.4;
      b.velocity = (1, 0) m/s;
      b.angular_velocity = 3 rad/s;
      experiment(stop = 1 s);
    end Between;
    """


@pytest.mark.parametrize("e", [0.2, 0.4, 0.5])
def test_events_come_in_the_order_of_time(e: float) -> None:
    """A limit of bounces that another impact precedes is reported at that impact."""
    result = frot.compile(BETWEEN).simulate(parameters={"e": e})
    times = [event.time for event in result.events]
    assert times == sorted(times)
    closed: dict[str, bool] = {}
    for event in result.events:
        if event.kind == "contact":
            assert not closed.get(event.liaison, False)
            closed[event.liaison] = True
        if event.kind == "separation":
            assert closed[event.liaison]
            closed[event.liaison] = False
    assert len(closed) >= 2


@pytest.mark.parametrize("tolerance", [1e-4, 1e-5, 1e-6, 1e-9])
def test_small_flights_do_not_go_below_the_floor(tolerance: float) -> None:
    """The instant of an impact is as exact as rounding at every tolerance."""
    text = """
        planar model Small
          body b: rod(mass = 1 kg, length = 0.4 m);
          liaison c: contact_ponctuel(b.start, ground.line) with restitution(0.01, rule = poisson);
        initial
          b.position = (0, 0.4) m;
          b.velocity = (0, -0.6) m/s;
          b.angle = -2 rad;
          b.angular_velocity = -4 rad/s;
          experiment(stop = 0.6 s);
        end Small;
        """
    result = frot.compile(text).simulate(tolerance=tolerance)
    assert len(result.events) >= 3
    for event in result.events:
        assert abs(float(result.at(event.time)["c.gap"])) < 1e-12
    assert min(float(result.at(t)["c.gap"]) for t in np.linspace(0, 0.6, 400)) > -1e-12
