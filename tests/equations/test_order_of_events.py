"""What happens at one instant comes in the order in which one thing reads the other."""

from __future__ import annotations

import frot
from tests.equations.discrete_systems import settling

CHAIN = """
model Chain
  Real x(start = 0), y(start = 0);
  Integer n(start = 0), k(start = 0);
equation
  when n > 0 then k = pre(n) + 10; end when;
  when x > 3 then y = pre(x); n = pre(n) + 1; end when;
  when time > 1 s then x = 5; end when;
  experiment(stop = 2 s);
end Chain;
"""

TIMERS = """
model Timer
  parameter Time hold = 1 s;
  Boolean go(start = false), out(start = false);
  Time t0(start = 0 s);
equation
  when go then t0 = time; end when;
  out = go and time >= t0 + hold;
end Timer;
model Pair
  Timer a(hold = 0.5 s), b(hold = 0.25 s);
  Boolean q(start = true);
  Integer rounds(start = 0);
equation
  a.go = pre(q);
  b.go = not pre(q);
  when a.out then q = false; elsewhen b.out then q = true; end when;
  when b.out then rounds = pre(rounds) + 1; end when;
  experiment(stop = 3.2 s);
end Pair;
"""


def test_values_before_are_those_before_all_that_happens_at_the_instant() -> None:
    """`x`, `n` and `k` change at once, each after what it reads; `pre` is 0 for each."""
    end = frot.compile(CHAIN).simulate().at(1.5)
    assert [end[x] for x in ("x", "y", "n", "k")] == [5, 0, 1, 10]


def test_two_timers_that_arm_each_other_take_turns() -> None:
    """A round takes 0.5 s and 0.25 s; the second timer does not fire as it is armed."""
    run = frot.compile(TIMERS, model="Pair").simulate()
    for t in (0.3, 0.6, 0.8, 1.3, 1.6, 2.9, 3.1):
        assert run.at(t)["rounds"] == int(t / 0.75)
        assert run.at(t)["q"] == (t % 0.75 < 0.5)


def test_random_systems_do_what_modelica_says() -> None:
    """Values before, timers and `when`s that set each other off, at every instant."""
    text, systems = settling(12, 3.0)
    run = frot.compile(text).simulate(stop=3.1)
    for system, values in systems:
        for t, expected in values:
            found = run.at(t + 1 / 32)
            assert all(found[x] == expected[x] for x in expected), (system.text(), t)
