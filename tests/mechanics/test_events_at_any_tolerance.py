"""Events are the same at every tolerance: none is seen where a guard only comes near zero, none is
missed, and none costs more than a few steps."""

from __future__ import annotations

import functools

import pytest

import frot

# Ten links on dry pins: every link's slip reverses, sticks and starts again, many of them in one
# step of a loose tolerance. The reference is the same text at 1e-10.
CHAIN = """\
planar model Chain
  body b[10]: rod(mass = 1 kg, length = 1 m);
  liaison o: rotoide(ground, b[1].start) with coulomb(0.2, radius = 10 mm);
  liaison j[9]: rotoide(b[1:9].tip, b[2:10].start) with coulomb(0.2, radius = 10 mm);
initial
  o.angle = -60 deg; o.speed = 1 rad/s;
  for i in 1:9 loop j[i].angle = 0.2 rad; j[i].speed = 0.5 rad/s; end for;
  experiment(stop = 1 s, tolerance = 1e-10);
end Chain;
"""
ANGLES = ("o.angle", *(f"j[{i}].angle" for i in range(1, 10)))


@pytest.fixture(scope="module")
def chain() -> frot.Model:
    return frot.compile(CHAIN)


@pytest.fixture(scope="module")
def exact(chain: frot.Model) -> frot.Result:
    return chain.simulate()


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4, 1e-6])
def test_a_loose_tolerance_sees_the_same_events(
    chain: frot.Model, exact: frot.Result, tolerance: float
) -> None:
    loose = chain.simulate(tolerance=tolerance)
    assert [(e.liaison, e.kind) for e in loose.events] == [
        (e.liaison, e.kind) for e in exact.events
    ]
    for a, b in zip(loose.events, exact.events, strict=True):
        assert a.time == pytest.approx(b.time, abs=tolerance)
    for name in ANGLES:
        assert abs(loose[name] - exact[name]).max() <= tolerance * abs(exact[name]).max()


@pytest.mark.parametrize("tolerance", [1e-3, 1e-4, 1e-6, 1e-8])
def test_a_step_ends_at_events_and_little_besides(chain: frot.Model, tolerance: float) -> None:
    result = chain.simulate(tolerance=tolerance)
    steps, events = result.figures.steps, len(result.events)
    assert steps < 4 * events  # a few between two of them
    # some events need a closer look at a guard that has just begun to rise
    assert result.figures.rejected <= 0.05 * steps + 0.2 * events
    # 15 of a step; that to an event is run two or three times more, oftener where it is long
    each = 60 if tolerance > 1e-5 else 42
    assert result.figures.evaluations < 15 * (steps + result.figures.rejected) + each * events


STRUCK = """
planar model Struck
  world(gravity = 0 m/s^2);
  parameter Force hard = 1e12 N;
  parameter Angle turn = 0;
  parameter Real mu = 0;
  parameter Time off = 0.5 s;
  curve floor on ground: line(through = (0, 0) m, direction = (cos(turn), sin(turn)));
  body block: particle(mass = 1 kg);
  liaison foot: contact_ponctuel(block, floor) with coulomb(mu);
  Force press = hard*exp(-((time - 0.1 s)/(0.01 s))^2) + 1e-3 N/s*(off - time);
  force f: on(block, value = press*(sin(turn), -cos(turn)));
initial
  block.position = (0, 0) m;
  block.velocity = (cos(turn), sin(turn))*(1 m/s);
  experiment(stop = 1 s, max_step = 1e-3 s);
end Struck;
"""


@functools.cache
def struck() -> frot.Model:
    return frot.compile(STRUCK)


@pytest.mark.parametrize("tolerance", [1e-4, 1e-7, 1e-12])
@pytest.mark.parametrize("turn", [0.0, 0.7, 2.5])
def test_a_force_that_was_without_bound_is_seen_when_it_ends(turn: float, tolerance: float) -> None:
    """A block that a blow of 1e12 N has pressed down is drawn off by 1e-3 N/s from 0.5 s on."""
    result = struck().simulate(tolerance=tolerance, parameters={"turn": turn})
    (event,) = result.events
    assert event.kind == "separation"
    assert abs(event.time - 0.5) <= 1e-9
    assert abs(result["foot.gap"][-1] - 1e-3 * 0.5**3 / 6) <= 1e-9 * 1e-3
