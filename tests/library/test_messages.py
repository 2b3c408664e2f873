"""What is told to one who connects the parts of the library wrongly."""

from __future__ import annotations

import pytest

import frot

FRICTION = """
model Wrong
  import Rotational; import Translational;
  Rotational.Inertia rotor;
  Translational.Mass mass;
  Rotational.Brake brake(mu = 0.2, mu_s = 0.25);
  Rotational.Clutch clutch(mu = 0.2, mu_s = 0.25);
  Rotational.Bearing bearing(sliding = 1 N.m, rest = 1.2 N.m);
  Translational.Slide slide(mu = 0.2, mu_s = 0.25);
  Translational.Support support(sliding = 1 N, rest = 1.2 N);
  Rotational.Fixed shaft;
  Translational.Fixed place;
initial
  rotor.angle = 0 rad; rotor.speed = 9 rad/s; mass.position = 0 m; mass.speed = 9 m/s;
equation
  brake.force = 10 N; clutch.force = 10 N; slide.normal_force = 10 N;
  connect(rotor.b, brake.a); connect(rotor.b, bearing.a); connect(rotor.b, clutch.a);
  connect(clutch.b, shaft.a);
  connect(mass.b, slide.a); connect(slide.b, place.a); connect(mass.b, support.a);
  experiment(stop = 10 ms);
end Wrong;
"""


@pytest.mark.parametrize(
    "wrong",
    [
        {"brake.mu_s": 0.1},
        {"clutch.mu_s": 0.1},
        {"bearing.rest": 0.4},
        {"slide.mu_s": 0.1},
        {"support.rest": 0.4},
    ],
    ids=lambda p: next(iter(p)),
)
def test_friction_of_rest_below_that_of_motion_is_refused(wrong: dict[str, float]) -> None:
    model = frot.compile(FRICTION)
    assert model.simulate().time[-1] == 0.01
    with pytest.raises(frot.FrotError, match="below that of motion") as told:
        model.simulate(parameters=wrong)
    assert "E0904" in str(told.value)
    assert next(iter(wrong)).split(".")[0] in str(told.value)


def told(declarations: str, equations: str, initial: str = "") -> str:
    text = (
        "model Wrong\n  import Rotational.*; import Electrical;\n"
        f"{declarations}\ninitial\n{initial}\nequation\n{equations}\nend Wrong;\n"
    )
    with pytest.raises(frot.FrotError) as raised:
        frot.compile(text).simulate()
    return str(raised.value)


def test_a_forgotten_force_of_a_clutch_is_named() -> None:
    message = told(
        "Inertia one; Inertia two; Clutch clutch;",
        "connect(one.b, clutch.a); connect(clutch.b, two.a);",
    )
    assert "E0603" in message
    assert "clutch.force" in message


def test_two_first_values_under_a_gear_are_both_named() -> None:
    message = told(
        "Inertia one; Inertia two; Gear gear(ratio = 3);",
        "connect(one.b, gear.a); connect(gear.b, two.a);",
        "one.speed = 3 rad/s; two.speed = 3 rad/s;",
    )
    assert "E0601" in message
    assert "one.speed" in message
    assert "two.speed" in message


def test_friction_on_a_spring_without_inertia_is_refused() -> None:
    message = told(
        "Fixed wall; Spring spring; Bearing bearing;",
        "connect(wall.a, spring.a); connect(spring.b, bearing.a);",
    )
    assert "E0606" in message
    assert "bearing.friction" in message


def test_a_circuit_without_ground_is_refused() -> None:
    message = told(
        "Electrical.ConstantVoltage battery; Electrical.Resistor r;",
        "connect(battery.p, r.p); connect(battery.n, r.n);",
    )
    assert "E0611" in message
    assert "Ground" in message


def test_a_flange_and_a_pin_are_not_alike() -> None:
    message = told("Inertia rotor; Electrical.Ground earth;", "connect(rotor.a, earth.p);")
    assert "E0515" in message
    assert "RotationalFlange" in message
