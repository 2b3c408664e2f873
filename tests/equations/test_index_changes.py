"""Branches of an equation: one holds the unknown it is solved for, the other does not."""

import pytest

import frot

PARTING = """
model Parting
  Real x, y, f;
  Boolean free(start = false);
initial
  x = 0;
  y = 0;
equation
  der(x) = ((if time < 1 s then 1 else -1) - f)*1 1/s;
  der(y) = f*1 1/s;
  if free then
    f = 0;
  else
    {tie};
  end if;
  when f < 0 then
    free = true;
  end when;
  experiment(stop = 2 s);
end Parting;
"""


def test_a_branch_without_the_unknown_is_named_at_the_start() -> None:
    with pytest.raises(frot.SimulationError) as told:
        frot.compile(PARTING.format(tie="y = x")).simulate()
    text = str(told.value)
    assert "E0912" in text and "does not hold 'f'" in text and "`f = 0`" in text
    assert "`der(y) = der(x)`" in text and "division by zero" not in text


@pytest.mark.parametrize("tolerance", [1e-4, 1e-9])
def test_the_remedy_ties_the_states_until_they_part(tolerance: float) -> None:
    run = frot.compile(PARTING.format(tie="der(y) = der(x)")).simulate(tolerance=tolerance)
    # together at half the speed for a second; then x alone goes back at the whole of it
    assert run["x"][-1] == pytest.approx(-0.5, abs=tolerance)
    assert run["y"][-1] == pytest.approx(0.5, abs=tolerance)


def test_a_switch_that_closes_over_a_capacitor_is_named_where_it_closes() -> None:
    text = """
model Closing
  Voltage u(start = 1 V);
  Current i;
initial
  u = 1 V;
equation
  1e-3 F*der(u) = 1e-3 A - i;
  if time > 0.3 s then
    u = 0 V;
  else
    i = 0 A;
  end if;
  experiment(stop = 1 s);
end Closing;
"""
    with pytest.raises(frot.SimulationError, match=r"E0912.*does not hold 'i'") as told:
        frot.compile(text).simulate()
    assert told.value.result is not None
    assert told.value.result["u"][-1] == pytest.approx(1.3, rel=1e-6)


def test_a_division_by_zero_in_a_branch_stays_one() -> None:
    text = """
model Pole
  Real x(start = 1), y;
initial
  x = 1;
equation
  der(x) = -1 1/s;
  (if time > 0.2 s then 2 else x - 1)*y = 1;
  experiment(stop = 1 s);
end Pole;
"""
    with pytest.raises(frot.FrotError, match=r"E0904.*division by zero"):
        frot.compile(text).simulate()
