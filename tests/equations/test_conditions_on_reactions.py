"""Conditions on accelerations, reactions and friction that are solved for in the present modes."""

import numpy as np
import pytest

import frot

PIN = """
planar model Breaks "A rod let go level on a dry pin that holds so much"
  parameter Force most = 30 N;
  body b: rod(mass = 2 kg, length = 1 m);
  liaison p: rotoide(ground, b.start) with coulomb(0.2, radius = 20 mm);
  Integer n(start = 0);
equation
  when norm(p.force) > most then
    n = pre(n) + 1;
  end when;
  when n > 0 and norm(p.force) > 1.5*most then
    terminate("it breaks");
  end when;
  experiment(stop = 1 s, tolerance = 1e-11);
end Breaks;
"""


def test_a_dry_pin_breaks_where_its_reaction_says_so() -> None:
    model = frot.compile(PIN)
    result = model.simulate()
    first, second = (e.time for e in result.events if "norm" in e.before + e.liaison + str(e.kind))
    for t, force in ((first, 30), (second, 45)):
        at = result.at(t)
        assert np.hypot(at["p.force.x"], at["p.force.y"]) == pytest.approx(force, rel=1e-11)
    assert result.time[-1] == second and result["n"][-1] == 1
    assert model.simulate(parameters={"most": 50}).time[-1] == 1.0


BRAKE = """
planar model Bag "The brakes grow with the way: mu = 1/10 + 3 x/10; fires below -2 m/s^2"
  body b: particle(mass = 1 kg);
  liaison floor: contact_ponctuel(b, ground.line) with coulomb(0.1 + 0.3 1/m*b.position.x);
  Boolean fired(start = false);
  Length spot(start = 0 m);
  Time rest(start = 0 s);
initial
  b.velocity.x = 2 m/s;
equation
  when b.acceleration.x < -2 m/s^2 then
    fired = true;
    spot = b.position.x;
  elsewhen fired and b.acceleration.x > -1 m/s^2 then
    rest = time;
  end when;
  experiment(stop = 2 s, tolerance = 1e-11);
end Bag;
"""


def test_a_deceleration_fires_and_ends_with_the_slip() -> None:
    """The acceleration jumps to zero where the block comes to rest: that fires too."""
    result = frot.compile(BRAKE).simulate()
    assert result["spot"][-1] == pytest.approx((2 / 9.81 - 0.1) / 0.3, rel=1e-11)
    (stop,) = (e.time for e in result.events if e.after == "stick")
    assert result["rest"][-1] == stop


PUSHED = """
planar model Pushed "Where the floor holds more than {at} N, another push acts"
  body b: particle(mass = 1 kg);
  liaison floor: contact_ponctuel(b, ground.line) with coulomb(0.3);
  force push: on(b, value = (if floor.tangential_force < -{at} N then {then} N else {push}, 0 N));
  {more}
  experiment(stop = 1 s, tolerance = 1e-11{method});
end Pushed;
"""


def pushed(at: float, then: float, push: str = "4 N/s*time", more: str = "", method: str = ""):
    return frot.compile(PUSHED.format(at=at, then=then, push=push, more=more, method=method))


@pytest.mark.parametrize("method", ["", ", method = implicit"])
def test_what_acts_may_follow_a_reaction(method: str) -> None:
    """From 1/2 s on 6 N act against mu m g; a spring that does not move lets Radau's method run."""
    spring = "body c: particle(mass = 1 kg); force k: spring((1, 1) m, c, k = 1 N/m, length = 1 m);"
    result = pushed(2, 6, more=spring, method=method).simulate()
    grown = np.maximum(result.time - 0.5, 0)
    want = (6 - 0.3 * 9.81) * grown**2 / 2
    assert np.abs(result["b.position.x"] - want).max() < 1e-10


def test_what_holds_at_the_start_acts_from_the_start() -> None:
    result = pushed(2, 6, "2.5 N").simulate()
    assert result["b.position.x"][-1] == pytest.approx((6 - 0.3 * 9.81) / 2, rel=1e-10)
    result = pushed(2, 2.2, "2.5 N").simulate()
    assert result["floor.tangential_force"] == pytest.approx(-2.2)


def test_a_condition_that_undoes_itself_is_told() -> None:
    with pytest.raises(frot.SimulationError, match="no truth of it") as told:
        pushed(2, 1).simulate()
    assert told.value.diagnostics[0].code == "E0903"


LOOP = """
planar model Loop "A four-bar on dry pins with one that is told where it carries more than asked"
  parameter Force most = 20 N;
  body a: rod(mass = 1 kg, length = 0.3 m);
  body b: rod(mass = 1 kg, length = 0.8 m);
  body c: rod(mass = 1 kg, length = 0.6 m);
  frame far on ground at (0.7, 0) m;
  liaison A: rotoide(ground, a.start) with coulomb(0.2, radius = 10 mm);
  liaison B: rotoide(a.tip, b.start);
  liaison C: rotoide(b.tip, c.tip);
  liaison D: rotoide(far, c.start);
  Integer n(start = 0);
initial
  A.angle = 40 deg;
  A.speed = 5 rad/s;
  guess(b.angle = 30 deg, c.angle = 80 deg);
equation
  when norm(C.force) > most then
    n = pre(n) + 1;
  end when;
  experiment(stop = 2 s, tolerance = 1e-10);
end Loop;
"""


def test_in_a_dry_loop_every_passage_is_met() -> None:
    result = frot.compile(LOOP).simulate()
    events = [e.time for e in result.events if "C.force" in str(e)]
    size = np.array(
        [np.hypot(result.at(t)["C.force.x"], result.at(t)["C.force.y"]) for t in events]
    )
    assert size == pytest.approx(20, rel=1e-8)
    fine = np.linspace(0, 2, 4001)
    above = [np.hypot(x["C.force.x"], x["C.force.y"]) > 20 for x in map(result.at, fine)]
    assert len(events) == np.count_nonzero(np.diff(above)) > 1
    assert result["n"][-1] == sum(np.diff(np.array(above, dtype=int)) > 0)
