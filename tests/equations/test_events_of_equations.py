"""`when`, `reinit`, `sample`, `assert` and `terminate`, and `if` equations."""

import numpy as np
import pytest

import frot

BALL = """
model Bouncing
  parameter Real e = {e};
  Length h(start = 1 m); Velocity v;
  Integer bounces;
initial
  h = {h} m; v = 0 m/s; bounces = 0;
equation
  der(h) = v;
  der(v) = -9.81 m/s^2;
  when h < 0 m then
    reinit(v, -e*pre(v));
    bounces = pre(bounces) + 1;
  end when;
  experiment(stop = {stop} s, tolerance = 1e-11);
end Bouncing;
"""


@pytest.mark.parametrize(("e", "h"), [(0.8, 1.0), (0.5, 3.0)])
def test_a_ball_bounces_at_the_instants_of_its_closed_form(e: float, h: float) -> None:
    first = (2 * h / 9.81) ** 0.5
    times = [first * (1 + 2 * sum(e**k for k in range(1, n + 1))) for n in range(5)]
    stop = times[-1] + first * e**5 * 0.9
    result = frot.compile(BALL.format(e=e, h=h, stop=stop)).simulate()
    rising = [x.time for x in result.events if x.after in ("true", True, 1)]
    assert rising == pytest.approx(times, rel=1e-9)
    assert result["bounces"][-1] == 5


SAMPLED = """
model Sampled
  Real x; Real held(start = 0);
  Integer n;
initial
  x = 0; n = 0;
equation
  der(x) = 1/(1 s);
  when sample(0.25 s, 0.5 s) then
    held = x;
    n = pre(n) + 1;
  end when;
  experiment(stop = 3.1 s);
end Sampled;
"""


def test_samples_come_at_their_instants() -> None:
    result = frot.compile(SAMPLED).simulate(interval=0.1)
    assert result["n"][-1] == 6
    for t, held in zip(result.time, result["held"], strict=True):
        expected = 0.0 if t < 0.25 else 0.25 + 0.5 * np.floor((t - 0.25 + 1e-12) / 0.5)
        if abs((t - 0.25) % 0.5) > 1e-9:
            assert held == pytest.approx(expected, abs=1e-12)


def counted(condition: str, before: str = "") -> frot.Model:
    """A model that counts how often a condition comes to hold while x = t/(1 s)."""
    return frot.compile(f"""
model Counted
  Real x; Boolean on(start = false);
  Integer n(start = 0);
initial
  x = 0;
equation
  der(x) = 1/(1 s);
  {before or "on = x > 0.9;"}
  when {condition} then
    n = pre(n) + 1;
  end when;
  experiment(stop = 3.1 s);
end Counted;
""")


TOGGLED = "when sample(0 s, 1 s) then on = not pre(on); end when;"


@pytest.mark.parametrize(
    ("condition", "before", "count"),
    [
        ("sample(0.25 s, 0.5 s) and x > 1", "", 4),
        ("x > 1 and sample(0.25 s, 0.5 s) and x < 2", "", 2),
        ("sample(0.25 s, 0.5 s) and on", "", 4),
        ("sample(0.25 s, 0.5 s) and not (x > 1)", "", 2),
        ("sample(0.25 s, 0.5 s) and pre(n) < 3", "", 3),
        ("(sample(0.25 s, 0.5 s) and x > 1, x > 0.1)", "", 5),
        # Both clocks strike together at 0, 1.5 and 3 s.
        ("sample(0 s, 0.5 s) and sample(0 s, 0.75 s)", "", 3),
        # On in [0, 1) and [2, 3): what another `when` sets in the tick counts.
        ("sample(0 s, 0.5 s) and on", TOGGLED, 4),
        ("initial() and x < 1", "", 1),
        ("initial() and x > 1", "", 0),
    ],
)
def test_a_sample_counts_where_other_conditions_hold(
    condition: str, before: str, count: int
) -> None:
    assert counted(condition, before).simulate()["n"][-1] == count


@pytest.mark.parametrize("condition", ["sample(0 s, 1 s) or x > 1", "not sample(0 s, 1 s)"])
def test_a_sample_that_is_not_joined_by_and_is_refused(condition: str) -> None:
    with pytest.raises(
        frot.FrotError, match=r"E0304.*'and'[^§]*`when sample\(\.\.\.\) and c then`"
    ):
        counted(condition).program()


def test_a_condition_beside_a_sample_reads_what_was_before_by_name() -> None:
    with pytest.raises(frot.FrotError, match=r"E0609[^§]*'pre\(\.\.\.\)'"):
        counted("sample(0 s, 1 s) and n < 3").program()


def test_the_interval_of_a_sample_beside_a_condition_is_checked() -> None:
    text = "parameter Time h = 1 s;\n  Real x;"
    model = frot.compile(SAMPLED.replace("Real x;", text).replace("0.5 s)", "h) and x > 1"))
    assert model.simulate(parameters={"h": 0.5})["n"][-1] == 4
    with pytest.raises(frot.FrotError, match="interval of 'sample'"):
        model.simulate(parameters={"h": 0.0})


def test_terminate_ends_a_run_well() -> None:
    text = """
model Ends
  Real x;
initial
  x = 0;
equation
  der(x) = 2/(1 s);
  when x > 3 then
    terminate("far enough");
  end when;
  experiment(stop = 10 s);
end Ends;
"""
    result = frot.compile(text).simulate()
    assert result.time[-1] == pytest.approx(1.5, abs=1e-9)
    assert "far enough" in result.summary()


ASSERTED = """
model Watched
  Real x;
initial
  x = {start};
equation
  der(x) = 1/(1 s);
  assert(x < 2, "x has left its range"{level});
  experiment(stop = 3 s);
end Watched;
"""


def test_an_assertion_that_fails_ends_the_run_with_its_text() -> None:
    with pytest.raises(frot.FrotError, match="x has left its range") as told:
        frot.compile(ASSERTED.format(start=0, level="")).simulate()
    assert told.value.result.time[-1] == pytest.approx(2.0, abs=1e-6)


def test_an_assertion_is_looked_at_from_the_start() -> None:
    with pytest.raises(frot.FrotError, match="x has left its range"):
        frot.compile(ASSERTED.format(start=2.5, level="")).simulate()


def test_a_warning_lets_the_run_go_on() -> None:
    result = frot.compile(ASSERTED.format(start=0, level=", level = warning")).simulate()
    assert result.time[-1] == 3
    assert "x has left its range" in result.summary()


RELAY = """
model Thermostat
  Real T(unit = "K"); Boolean on;
initial
  T = 290 K; on = true;
equation
  10 s*der(T) = (280 K - T) + (if on then 30 K else 0 K);
  when T > 300 K then
    on = false;
  elsewhen T < 295 K then
    on = true;
  end when;
  experiment(stop = 60 s, tolerance = 1e-10);
end Thermostat;
"""


def test_a_relay_cycles_between_its_bounds() -> None:
    result = frot.compile(RELAY).simulate(interval=0.01)
    heating = 10 * np.log(20 / 10)
    assert result["T"].max() <= 300 + 1e-9
    late = result.time > heating
    assert result["T"][late].min() >= 295 - 1e-9
    falls = np.flatnonzero(np.diff(result["on"]) < 0)
    cycle = 10 * np.log(20 / 15) + 10 * np.log(15 / 10)
    assert np.diff(result.time[falls]) == pytest.approx(np.full(len(falls) - 1, cycle), abs=0.021)


BRANCHES = """
model Branches
  Real x; Real y;
initial
  x = 0;
equation
  der(x) = 1/(1 s);
  if x < 1 then
    y = x;
  elseif x < 2 then
    y = 2 - x;
  else
    y = 0;
  end if;
  experiment(stop = 3 s);
end Branches;
"""


def test_branches_of_equations_change_at_events() -> None:
    result = frot.compile(BRANCHES).simulate(interval=0.1)
    exact = np.maximum(0, np.minimum(result.time, 2 - result.time))
    assert np.abs(result["y"] - exact).max() < 1e-9
