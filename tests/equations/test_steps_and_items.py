"""`floor`, `ceil`, `mod`, `noEvent`, `smooth`, `elseif` in values, items of arrays in `when`."""

from math import acos, pi

import pytest

import frot

TEXT = """
planar model Steps
  Real x, y, z, w, u, c, s;
  Integer k;
  Real a[3];
  Real b[2, 2](start = ((1, 2), (3, 4)));
  body ball: particle(mass = 1 kg);
  force push: on(ball, value = (floor(time/(0.25 s))*1 N, 9.81 N));
initial
  x = 0; y = 0; z = 0; w = 0; s = 2.5;
  for i in 1:3 loop
    a[i] = i;
  end for;
equation
  der(x) = floor(time/(0.1 s))/(1 s);
  der(y) = ceil(3*cos(7*time/(1 s)))/(1 s);
  der(z) = mod(time, 0.3 s)/(1 s^2);
  der(w) = noEvent(max(0, cos(time/(1 s))))/(1 s);
  u = smooth(0, if time > 0.5 s then time/(1 s) - 0.5 else 0);
  c = if time < 0.2 s then 1 elseif time < 0.4 s then 2 elseif time < 0.6 s then 3 else 4;
  der(s) = -5/(1 s);
  k = floor(s);
  for i in 1:2 loop
    when time > i*0.3 s then
      a[i] = 10*i;
      b[i, 1] = 7;
    end when;
  end for;
  when time > 0.7 s then
    b[1, 2] = -1;
    a[3] = pre(a[3]) + 1;
  end when;
  experiment(stop = 1.01 s, tolerance = 1e-11);
end Steps;
"""


@pytest.fixture(scope="module")
def run():
    return frot.compile(TEXT).simulate()


def test_what_steps_is_integrated_to_its_closed_form(run):
    end = run.at(1.0)
    assert end["x"] == pytest.approx(4.5, abs=1e-12)
    assert end["z"] == pytest.approx(3 * 0.045 + 0.005, abs=1e-12)
    assert end["ball.velocity.x"] == pytest.approx(0.25 * (0 + 1 + 2 + 3), abs=1e-12)
    # 3 cos(7 t) is above n up to acos(n/3)/7, and again from 2 pi/7 less that
    above = sum(
        acos(n / 3) / 7 + max(0.0, 1 - (2 * pi - acos(n / 3)) / 7) for n in (-2, -1, 0, 1, 2)
    )
    assert end["y"] == pytest.approx(above - 2, abs=1e-10)


def test_each_step_is_an_event_at_its_instant(run):
    times = [e.time for e in run.events if e.liaison.startswith("floor(time/(0.1 s))")]
    assert times == pytest.approx([k / 10 for k in range(1, 11)], abs=1e-15)
    falls = [e.time for e in run.events if e.liaison.startswith("floor(s)")]
    assert falls == pytest.approx([0.1, 0.3, 0.5, 0.7, 0.9], abs=1e-11)
    assert run.at(0.0)["k"] == 2
    assert run.at(1.0)["k"] == -3


def test_without_events_and_in_branches(run):
    assert not [e for e in run.events if "max" in e.liaison]
    assert run.at(1.0)["w"] == pytest.approx(0.8414709848078965, rel=1e-10)
    assert run.at(0.9)["u"] == pytest.approx(0.4, rel=1e-12)
    assert [float(run.at(t)["c"]) for t in (0.1, 0.3, 0.5, 0.7)] == [1, 2, 3, 4]


def test_items_are_set_one_by_one(run):
    assert [run[f"a[{i}]"][-1] for i in (1, 2, 3)] == [10, 20, 4]
    assert [run[f"b[{i}]"][-1] for i in ("1,1", "1,2", "2,1", "2,2")] == [7, -1, 7, 4]
    assert run.at(0.5)["a[2]"] == 2


MODEL = "model M Real x[2](start = (1, 2)); Real y(start = 1); {} end M;"


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (
            "equation when time > 1 s then x[1] = 2; end when; when time > 2 s then x = (1, 1); "
            "end when; der(y) = 1 1/s;",
            "E0517",
        ),
        (
            "equation when time > 1 s then x[1] = 2; end when; when time > 2 s then x[1] = 1; "
            "end when; der(y) = 1 1/s;",
            "E0517",
        ),
        ("equation x = (time/(1 s), 1); der(y) = if x[1] == 1 then 1 1/s else 0 1/s;", "E0304"),
        (
            "output Velocity v = 1 m/s; output Force f = friction(v, 1 N); equation x = (1, 2); "
            "der(y) = 1 1/s;",
            "E0304",
        ),
    ],
)
def test_what_has_no_meaning_is_told(text, code):
    with pytest.raises(frot.FrotError, match=code):
        frot.compile(MODEL.format(text)).simulate()


def test_an_if_of_a_loop_looks_at_its_own_branch_only() -> None:
    """A chain between walls: no item before the first nor behind the last; energy stays 1/2."""
    model = frot.compile("""
model Chain
  parameter Integer n = 4;
  Real x[n], v[n], F[n + 1];
initial
  x = (1, 0, 0, 0);
  v = zeros(n);
equation
  for i in 1:n + 1 loop
    F[i] = (if i == 1 then 0 else x[i - 1]) - (if i <= n then x[i] else 0);
  end for;
  for i in 1:n loop
    der(x[i]) = v[i]*(1 1/s);
    der(v[i]) = (F[i] - F[i + 1])*(1 1/s);
  end for;
end Chain;
""")
    end = model.simulate(stop=10).at(10)
    energy = sum(end[f"v[{i}]"] ** 2 for i in range(1, 5))
    energy += sum(end[f"F[{i}]"] ** 2 for i in range(1, 6))
    assert energy == pytest.approx(2, abs=1e-6)
