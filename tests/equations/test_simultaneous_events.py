"""What happens at one instant: relations looked at anew, timers and ticks at their exact times."""

from __future__ import annotations

import re

import numpy as np
import pytest
from records import HEAD, records

import frot

TIMED_STATES = """
model Machine
  Integer state(start = 1);
  Time entered(start = 0 s);
  parameter Time first = 1 s, stay = 0.7 s;
  Real x;
initial
  x = 0;
equation
  der(x) = 1 1/s;
  {branches}
  experiment(stop = {stop} s);
end Machine;
"""
WHENS = {
    "elsewhen": """
  when state == 1 and time > first then
    state = 2;
    entered = time;
  elsewhen state == 2 and time > entered + stay then
    state = 3;
    entered = time;
  end when;""",
    "pre": """
  when pre(state) == 1 and time > first then
    state = 2;
    entered = time;
  elsewhen pre(state) == 2 and time > pre(entered) + stay then
    state = 3;
    entered = time;
  end when;""",
    "separate": """
  when time > first then
    entered = time;
  end when;
  when entered > 0 s and time > entered + stay then
    state = 3;
  end when;""",
    "the other order": """
  when state == 2 and time > entered + stay then
    state = 3;
    entered = time;
  elsewhen state == 1 and time > first then
    state = 2;
    entered = time;
  end when;""",
    "of an equation": """
  state = if pre(state) == 1 and time > first then 2
    else if pre(state) == 2 and time > pre(entered) + stay then 3 else pre(state);
  when change(state) then
    entered = time;
  end when;""",
}


def times_of_change(result: frot.Result, name: str) -> list[float]:
    """The ends of the steps at which a value that jumps has another value than before."""
    starts = np.array([segment[HEAD] for segment in records(result._record)])
    values = result.at(np.unique(np.clip(starts, 0, result.time[-1])))[name]
    at = np.unique(starts)[1:][np.diff(values) != 0]
    return list(at)


@pytest.mark.parametrize("way", WHENS)
@pytest.mark.parametrize("scale", [1.0, 1e-9, 1e9])
def test_a_timed_state_lasts_as_long_as_it_says(way: str, scale: float) -> None:
    model = frot.compile(TIMED_STATES.format(branches=WHENS[way], stop=3 * scale))
    given = {"first": scale, "stay": 0.7 * scale}
    result = model.simulate(parameters=given)
    last = scale + 0.7 * scale
    assert times_of_change(result, "state")[-1] == last
    assert result["state"][-1] == 3
    assert result.at(last * (1 - 1e-12))["state"] < 3


ALARM = """
model Alarm
  Boolean armed(start = false);
  Real x, ta(start = -1);
initial
  x = 0;
equation
  der(x) = 1 1/s;
  when x > 1 then
    reinit(x, 0);
    armed = true;
  end when;
  when armed and x > 0.5 then
    ta = time/(1 s);
  end when;
  experiment(stop = 1.8 s);
end Alarm;
"""


def test_a_reinit_is_seen_by_the_conditions_of_the_same_instant() -> None:
    assert frot.compile(ALARM).simulate()["ta"][-1] == pytest.approx(1.5, rel=1e-12)


SAMPLED_ERROR = """
model Sampled
  Real held(start = 0), error, sum(start = 0);
equation
  error = 1 - held;
  when sample(0 s, 1 s) then
    held = pre(held) + 0.25;
    sum = pre(sum) + error;
  end when;
  experiment(stop = 2.5 s);
end Sampled;
"""


def test_an_equation_between_sampled_values_holds_in_the_tick_itself() -> None:
    """Errors 0.75, 0.5, 0.25 in the three ticks."""
    assert frot.compile(SAMPLED_ERROR).simulate()["sum"][-1] == 1.5


HYSTERESIS = """
model Hysteresis
  Real T(start = 15);
  Boolean heat(start = true);
  Integer on(start = 0), off(start = 0), turns;
  parameter Real low = 18, high = 22;
initial
  T = 15;
equation
  heat = not pre(heat) and T < low or pre(heat) and T <= high;
  turns = pre(turns) + (if change(heat) then 1 else 0);
  der(T) = ((if heat then 30 else 0) - (T - 10))*0.1 1/s;
  when heat then
    on = pre(on) + 1;
  end when;
  when edge(not heat) then
    off = pre(off) + 1;
  end when;
  experiment(stop = 100 s, tolerance = 1e-10);
end Hysteresis;
"""


def test_a_two_point_controller_by_an_equation_of_its_own() -> None:
    """From 15 to 22 towards 40, then down to 18 towards 10 and up again."""
    result = frot.compile(HYSTERESIS).simulate()
    first, down, up = (10 * np.log(q) for q in (25 / 18, 12 / 8, 22 / 18))
    expected = [first]
    while expected[-1] < 100:
        expected.append(expected[-1] + (down if len(expected) % 2 else up))
    found = times_of_change(result, "heat")
    assert found == pytest.approx(expected[:-1], rel=1e-9)
    assert result["turns"][-1] == len(found)
    assert (result["on"][-1], result["off"][-1]) == (len(found) // 2, (len(found) + 1) // 2)


def test_contradictory_truths_are_reported_by_name() -> None:
    text = """
model Liar
  Boolean b;
equation
  b = not pre(b);
  experiment(stop = 1 s);
end Liar;
"""
    with pytest.raises(frot.FrotError, match=r"E0903.*`b`") as told:
        frot.compile(text).simulate()
    assert ":5:" in str(told.value)


TICKS = """
model Ticks
  Integer k(start = 0);
  parameter Time start = 0.1 s, interval = 0.1 s;
equation
  when sample(start, interval) then
    k = pre(k) + 1;
  end when;
  experiment(stop = 1 s);
end Ticks;
"""


@pytest.mark.parametrize(("start", "interval", "count"), [(0.1, 0.1, 10), (0.0, 1e-9, 1000)])
def test_ticks_lie_where_they_belong(start: float, interval: float, count: int) -> None:
    stop = start + (count - 1) * interval
    given = {"start": start, "interval": interval}
    result = frot.compile(TICKS).simulate(stop=stop, parameters=given)
    told = range(0 if start > 0 else 1, count)  # a tick at the start is no event
    assert [e.time for e in result.events] == [start + k * interval for k in told]
    assert result["k"][-1] == count


TWICE = """
model Count
  Integer a(start = 0), b(start = 0);
  Real x(start = 0);
  parameter Real gap = 3e-12;
equation
  der(x) = 1 1/s;
  when x > 1 then
    a = pre(a) + 1;
  end when;
  when x > 1 + gap then
    b = pre(b) + 1;
  end when;
  experiment(stop = 2 s, tolerance = 1e-10);
end Count;
"""


@pytest.mark.parametrize("gap", [0.0, 1e-15, 1e-14, 3e-13, 3e-12, 1e-9])
def test_conditions_close_to_each_other_come_once_each_and_truly_hold(gap: float) -> None:
    result = frot.compile(TWICE).simulate(parameters={"gap": gap})
    assert (result["a"][-1], result["b"][-1]) == (1, 1)
    rises = [e for e in result.events if e.after == "true"]
    assert len(rises) == len(result.events)
    assert result.at(rises[-1].time)["x"] >= 1 + gap - 1e-15


TANK = """
model Tank
  Real h(start = 1);
initial
  h = 1;
equation
  der(h) = if h > 0 then -sqrt(h)*(1 1/s) else 0 1/s;
  experiment(stop = 3 s);
end Tank;
"""


@pytest.mark.parametrize("tolerance", [1e-4, 1e-8, 1e-12])
def test_a_tank_runs_empty_with_zero_rate(tolerance: float) -> None:
    """Torricelli: h = (1 - t/2)^2; an error of h moves the end by twice its root."""
    result = frot.compile(TANK).simulate(tolerance=tolerance)
    exact = np.where(result.time < 2, (1 - result.time / 2) ** 2, 0)
    assert np.abs(result["h"] - exact).max() < tolerance
    assert [e.time for e in result.events] == pytest.approx([2], abs=2 * np.sqrt(tolerance))


ROOTS = """
model Roots
  Real x, y, root;
  parameter Real rate = 1;
initial
  x = 1;
  y = 0;
equation
  root = if x > 0 then sqrt(x) else -sqrt(-x);
  der(x) = -rate*(1 1/s);
  der(y) = root*(1 1/s);
  experiment(stop = 3 s, tolerance = 1e-10);
end Roots;
"""


@pytest.mark.parametrize("rate", [1.0, 0.37, 1e3])
def test_a_root_is_drawn_on_both_sides_of_its_switch(rate: float) -> None:
    """y = 2/3 (1 - |x|^1.5)/rate."""
    result = frot.compile(ROOTS).simulate(parameters={"rate": rate})
    size = (2 / 3) * rate**0.5 * 3**1.5
    exact = 2 / 3 * (1 - np.abs(result["x"]) ** 1.5) / rate
    assert np.abs(result["y"] - exact).max() < 1e-9 * size
    assert [e.time for e in result.events] == pytest.approx([1 / rate], rel=1e-12)


DEAD_BALL = """
model Bouncing
  parameter Real e = 0; parameter Length floor = 0 m;
  Length h; Velocity v;
initial
  h = floor + 1 m; v = 0 m/s;
equation
  der(h) = v;
  der(v) = -9.81 m/s^2;
  when {condition} then
    reinit(v, -e*pre(v));
  end when;
  experiment(stop = 8 s, tolerance = 1e-9);
end Bouncing;
"""


@pytest.mark.parametrize("tolerance", [1e-3, 1e-4, 1e-6, 1e-9, 1e-12])
@pytest.mark.parametrize("e", [0, 1e-16, 1e-12, 1e-8, 1e-3, 0.01, 0.03, 0.057, 0.1, 0.3, 0.8])
@pytest.mark.parametrize("condition", ["h < floor", "h <= floor", "floor + 0.7 m > h + 0.7 m"])
def test_a_ball_does_not_fall_through_the_floor(condition: str, e: float, tolerance: float) -> None:
    """However little it jumps, and however soon its jumps are lost in rounding."""
    model = frot.compile(DEAD_BALL.format(condition=condition))
    for floor in (0, 0.7):
        given = {"e": e, "floor": floor}
        with pytest.raises(frot.FrotError, match=rf"E0903.*`{re.escape(condition)}`") as told:
            model.simulate(parameters=given, tolerance=tolerance)
        limit = (2 / 9.81) ** 0.5 * (1 + 2 * e / (1 - e))
        assert told.value.result.time[-1] == pytest.approx(limit, rel=1e-3)


NUDGED = """
model Nudged
  Real x; Integer n(start = 0);
initial
  x = 0;
equation
  der(x) = 1 1/s;
  when x > 1 then
    n = pre(n) + 1;
    reinit(x, if pre(n) < 2 then 1 - 1e-9 else 0);
  end when;
  experiment(stop = 1.5 s);
end Nudged;
"""


def test_jumps_back_by_little_are_no_rounding() -> None:
    """Three rises to 1, the second and the third by 1e-9, then from 0 again."""
    result = frot.compile(NUDGED).simulate()
    assert result["n"][-1] == 3
    assert result["x"][-1] == pytest.approx(0.5 - 2e-9, abs=1e-12)


SLIDING = """
model Sliding
  Real x, y;
initial
  x = 1;
  y = 0.3;
equation
  der(x) = ({law})*(1 1/s) + 0.1*y/(1 s);
  der(y) = -x/(1 s);
  experiment(stop = 3 s);
end Sliding;
"""


@pytest.mark.parametrize("tolerance", [1e-4, 1e-8, 1e-12])
@pytest.mark.parametrize(
    "law", ["if x > 0 then -1 else 1", "if x > 0 then -1 else if x < 0 then 1 else 0"]
)
def test_branches_in_a_cycle_are_reported(law: str, tolerance: float) -> None:
    with pytest.raises(frot.FrotError, match=r"E0903.*`x [<>] 0`"):
        frot.compile(SLIDING.format(law=law)).simulate(tolerance=tolerance)


BRAKE = """
model Brake
  parameter Real w = 7;
  AngularVelocity omega;
initial
  omega = 30 rad/s;
equation
  1 kg.m^2*der(omega) = friction(omega, 20 N.m*max(0, sin(w*time/(1 s))));
  experiment(stop = 3 s);
end Brake;
"""


@pytest.mark.parametrize("tolerance", [1e-4, 1e-8, 1e-12])
@pytest.mark.parametrize("w", [7.0, 50.0])
def test_a_bound_of_friction_may_begin_and_end_at_zero(w: float, tolerance: float) -> None:
    """The brake takes 20/w (1 - cos) in every first half of a period."""
    result = frot.compile(BRAKE).simulate(tolerance=tolerance, parameters={"w": w})
    cycles, rest = divmod(w * 3, 2 * np.pi)
    taken = 2 * cycles + (1 - np.cos(rest) if rest < np.pi else 2)
    assert result["omega"][-1] == pytest.approx(30 - 20 / w * taken, abs=30 * tolerance)


NEAR_ZERO = """
model Falls
  Real x, y, z;
initial
  x = 1;
  z = 0;
equation
  y = {value};
  der(x) = -1/(1 s);
  der(z) = (2*y + x)/(1 s);
  experiment(stop = 3 s);
end Falls;
"""


@pytest.mark.parametrize("value", ["sqrt(x)", "log(x)", "asin(2*x - 2.5)", "(x - 0.2)^1.5"])
def test_an_equation_without_a_number_is_named_with_its_place(value: str) -> None:
    told = rf"(?s)E0904.*`y = {re.escape(value)}`.*<text>:8:3"
    with pytest.raises(frot.FrotError, match=told):
        frot.compile(NEAR_ZERO.format(value=value)).simulate()


TWO_REINITS = """
model Twice
  Real x, v;
initial
  x = 0;
  v = 1;
equation
  der(x) = v/(1 s);
  der(v) = 0/(1 s);
  when x > 1 then
    reinit(v, 2);
  end when;
  when {second} then
    reinit(v, -1);
  end when;
  experiment(stop = 3 s);
end Twice;
"""


def test_two_reinits_of_one_state_at_one_instant_are_told() -> None:
    with pytest.raises(frot.FrotError, match=r"E0909.*'v'"):
        frot.compile(TWO_REINITS.format(second="x >= 1")).simulate()


def test_two_reinits_of_one_state_at_two_instants_are_none() -> None:
    """v = 1 up to t = 1, 2 up to x = 2 at t = 1.5, then -1."""
    result = frot.compile(TWO_REINITS.format(second="x >= 2")).simulate()
    assert result["x"][-1] == pytest.approx(0.5, abs=1e-12)


@pytest.mark.parametrize("interval", [1e-300, 1e-20, 1e-17])
def test_ticks_closer_than_rounding_of_time_are_reported(interval: float) -> None:
    with pytest.raises(frot.FrotError, match=r"E0909.*sample\(start, interval\)"):
        frot.compile(TICKS).simulate(parameters={"interval": interval})


ARMED = {
    "of a variable": "out = go and time >= t0 + 0.5 s; when out then n = pre(n) + 1; end when;",
    "by itself": "out = go; when go and time >= t0 + 0.5 s then n = pre(n) + 1; end when;",
    "of a motion": "out = go and x - t0 > 0.5 s; when out then n = pre(n) + 1; end when;",
    "first in the text": "when out then n = pre(n) + 1; end when; out = go and time > t0 + 0.5 s;",
}


@pytest.mark.parametrize("way", ARMED)
@pytest.mark.parametrize("last", [False, True])
def test_a_timer_does_not_fire_at_its_own_start(way: str, last: bool) -> None:
    """What one `when` sets counts for the condition of another that would fire with it."""
    arm = "when go then t0 = time; end when;"
    result = frot.compile(f"""
model Armed
  Boolean go, out; Time t0(start = 0 s), x(start = 0 s); Integer n(start = 0);
equation
  go = time > 1 s;
  der(x) = 1;
  {ARMED[way] + arm if last else arm + ARMED[way]}
  experiment(stop = 3 s);
end Armed;
""").simulate()
    assert result.at(1.49)["n"] == 0
    assert result.at(1.51)["n"] == result["n"][-1] == 1
    assert result["t0"][-1] == 1


def test_a_when_ending_its_own_condition_has_fired() -> None:
    """Also beside one that fires with it."""
    result = frot.compile("""
model Own
  Real x(start = 0), off(start = 0); Integer n(start = 0), beside(start = 0);
equation
  der(x) = 1 1/s;
  when x - off > 0.4 then off = x; n = pre(n) + 1; end when;
  when time > 0.4 s then beside = 1; end when;
  experiment(stop = 1 s);
end Own;
""").simulate()
    assert result["n"][-1] == 2
    assert result["beside"][-1] == 1
