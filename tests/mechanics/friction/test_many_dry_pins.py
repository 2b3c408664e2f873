"""Rods on dry pins let go from rest: modes are found however many there are, and steps go on."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding

DOWN, LEVEL, UP = -np.pi / 2, 0.0, np.pi / 2


@cache
def chain(n: int) -> frot.Model:
    at = ["ground", *(f"b{i}.tip" for i in range(n - 1))]
    parts = [
        f"""
  parameter Angle A{i} = 0 rad;
  body b{i}: rod(mass = 1 kg, length = 1 m);
  liaison j{i}: rotoide({at[i]}, b{i}.start) with coulomb(mu, mu_s = mu*more, radius = 1 cm);"""
        for i in range(n)
    ]
    starts = [f"  b{i}.angle = A{i};\n  b{i}.angular_velocity = 0 rad/s;\n" for i in range(n)]
    return frot.compile(f"""planar model Chain
  world(gravity = 9.81 m/s^2);
  parameter Real mu = 0.1;
  parameter Real more = 1;
{"".join(parts)}
initial
{"".join(starts)}
  experiment(stop = 1 s);
end Chain;
""")


def run(angles: list[float], stop: float, tolerance: float, **values: float) -> frot.Result:
    every = {f"A{i}": float(a) for i, a in enumerate(angles)} | values
    return chain(len(angles)).simulate(stop=stop, tolerance=tolerance, parameters=every)


def test_rounding_keeps_no_steps_short_though_none_fails() -> None:
    """At 1e-13 the estimate is rounding; steps that follow it shorten without end."""
    angles = [-0.22, 2.31, -1.1, -2.87, 1.96, -2.63, -2.44, 2.78, 1.52, -0.97]
    loose, tight = (run(angles, 0.2, tolerance) for tolerance in (1e-10, 1e-13))
    assert tight.figures.steps < 5 * loose.figures.steps
    for i in range(10):
        assert tight[f"b{i}.angle"][-1] == pytest.approx(loose[f"b{i}.angle"][-1], abs=1e-8)


@pytest.mark.parametrize(
    ("angles", "values"),
    [
        ([UP, LEVEL, DOWN, UP, DOWN, UP, LEVEL, np.pi, UP, LEVEL], {"mu": 0.03}),
        ([-0.7] * 14, {"mu": 0.1, "more": 1.3}),
        ([-0.7] * 14, {"mu": 0.3, "more": 1.3}),
    ],
)
def test_many_pins_depart_each_at_its_bound(angles: list[float], values: dict[str, float]) -> None:
    """A pin at rest is held within its bound, one that slips has the friction of motion."""
    result = run(angles, 0.2, 1e-9, **values)
    mu, most = values["mu"], values["mu"] * values.get("more", 1)
    for t in (0.05, 0.1, 0.15, 0.2):
        now = result.at(t)
        for i in range(len(angles)):
            couple, slip = float(now[f"j{i}.torque"]), float(now[f"j{i}.slip"])
            bound = 0.01 * np.hypot(now[f"j{i}.force.x"], now[f"j{i}.force.y"])
            if slip == 0:
                assert abs(couple) <= most * bound * (1 + 1e-6)
            else:
                assert couple == pytest.approx(-np.sign(slip) * mu * bound, rel=1e-6)
    assert abs(result.balance.residual) <= 1e-7 * result.balance.scale


def test_a_bar_slides_on_three_bilateral_feet() -> None:
    """Their friction is mu times the weight while all of them press: where friction is least one
    pulls, another share of the weight has none that does."""
    feet = "".join(
        f"""
  frame f{i} on bar at ({x} m, -1.2 m);
  liaison c{i}: contact_ponctuel(ground.line, f{i}, unilateral = false)
    with coulomb(mu, mu_s = 1.2*mu);"""
        for i, x in enumerate((-0.5, -0.06, 0.5))
    )
    result = frot.compile(f"""planar model Slide
  world(gravity = 9.81 m/s^2);
  parameter Real mu = 0.33;
  body bar: rod(mass = 2 kg, length = 1 m);{feet}
initial
  bar.position = (0, 1.2) m;
  bar.angle = 0;
  bar.velocity = (3, 0) m/s;
  experiment(stop = 0.5 s, tolerance = 1e-9);
end Slide;
""").simulate()
    assert result["bar.velocity.x"][-1] == pytest.approx(3 - 0.33 * 9.81 * 0.5, rel=1e-9)


def test_friction_follows_reactions_to_rounding_however_much_it_does_to_them() -> None:
    """In journals of a millimetre friction does next to nothing to the reactions, in those of the
    size of the rods as much as their weight: both are found as exactly."""
    n = 6
    parts = "".join(
        f"  body b{i}: rod(mass = {1 + i % 3} kg, length = 1 m);\n"
        f"  liaison j{i}: rotoide({f'b{i - 1}.tip' if i else 'ground'}, b{i}.start)"
        " with coulomb(mu, radius = r);\n"
        for i in range(n)
    )
    starts = "".join(
        f"  b{i}.angle = {0.7 * i - 1} rad;\n  b{i}.angular_velocity = {(-1) ** i * 20} rad/s;\n"
        for i in range(n)
    )
    model = frot.compile(
        "planar model Journals\n  parameter Real mu = 0.25;\n  parameter Length r = 1 mm;\n"
        f"{parts}initial\n{starts}end Journals;\n"
    )
    for radius in (1e-3, 0.03, 0.3):
        result = model.simulate(stop=0.03, tolerance=1e-9, parameters={"r": radius})
        slips = 0
        for t in (0.004, 0.012, 0.02, 0.028):
            now = result.at(t)
            for i in range(n):
                bound = 0.25 * radius * np.hypot(now[f"j{i}.force.x"], now[f"j{i}.force.y"])
                if (slip := float(now[f"j{i}.slip"])) == 0:
                    continue
                slips += 1
                assert float(now[f"j{i}.torque"]) == pytest.approx(
                    -np.sign(slip) * bound, rel=1e-12
                )
        assert slips > 12
        assert abs(result.balance.residual) <= 1e-8 * result.balance.scale


def test_the_instant_of_rest_does_not_depend_on_the_tolerance() -> None:
    """Journals larger than the rods: friction comes to do as much to the reactions as the weight,
    and two motions meet and end. Next to that instant neither reactions found roughly nor a look
    inside the step may end it sooner."""
    n = 4
    parts = "".join(
        f"  body b{i}: rod(mass = {1 + i % 3} kg, length = 1 m);\n"
        f"  liaison j{i}: rotoide({f'b{i - 1}.tip' if i else 'ground'}, b{i}.start)"
        " with coulomb(0.25, radius = 1.1 m);\n"
        for i in range(n)
    )
    angles, speeds = (2.2, 2.1, 1.9, -1.4), (-3.4, 3.6, 0.9, -4.0)
    starts = "".join(
        f"  b{i}.angle = {angles[i]} rad;\n  b{i}.angular_velocity = {speeds[i]} rad/s;\n"
        for i in range(n)
    )
    model = frot.compile(
        "planar model Journals\n  world(gravity = 9.81 m/s^2);\n"
        f"{parts}initial\n{starts}end Journals;\n"
    )
    ends = []
    for tolerance in (1e-6, 1e-9, 1e-11, 1e-12):
        with pytest.raises(frot.SimulationError) as stop:
            model.simulate(stop=0.5, tolerance=tolerance)
        ends.append(stop.value.result.time[-1])
    assert ends == pytest.approx([ends[-1]] * 4, rel=3e-8)


def test_a_bar_on_three_dry_legs_rests_where_it_is_found_to_rest() -> None:
    """Legs that strain each other rest under any load; each pin at the bound of its own strain.
    The rest was found, and its reactions looked for in other directions a moment later."""
    model = frot.compile("""
planar model ThreeLegs
  parameter Length r = 80 mm, pin = 5 mm, far = 300 mm;
  parameter Real mu = 0.1;
  body one: rod(mass = 0.6 kg, length = r);
  body two: rod(mass = 0.5 kg, length = r);
  body three: rod(mass = 0.7 kg, length = r);
  body bar: rod(mass = 1.1 kg, length = far);
  frame middle on bar at (far/6, 0 m);
  frame eye2 on ground at (far, 0 m);
  frame eye3 on ground at (2*far/3, 0 m);
  liaison O1: rotoide(ground, one.start) with coulomb(mu, radius = pin);
  liaison O2: rotoide(eye2, two.start) with coulomb(mu, radius = pin);
  liaison O3: rotoide(eye3, three.start) with coulomb(mu, radius = pin);
  liaison A1: rotoide(one.tip, bar.start) with coulomb(mu, radius = pin);
  liaison A2: rotoide(two.tip, bar.tip) with coulomb(mu, radius = pin);
  liaison A3: rotoide(three.tip, middle) with coulomb(mu, radius = pin);
  force motor: couple(O1, value = 4 N.m);
initial
  O1.angle = 30 deg;
  O1.speed = 0 rad/s;
  guess(bar.angle = 0 rad);
  experiment(stop = 0.5 s);
end ThreeLegs;
""")
    for mu in (3e-4, 1e-3, 0.1):
        result = model.simulate(parameters={"mu": mu})
        assert result["one.angle"][-1] == pytest.approx(np.pi / 6, rel=1e-15)
        assert [e.kind for e in result.events] == ["several"]
        now = result.at(0.25)
        for name in ("O1", "O2", "O3", "A1", "A2", "A3"):
            bound = 0.005 * np.hypot(now[f"{name}.force.x"], now[f"{name}.force.y"])
            assert abs(now[f"{name}.torque"]) <= mu * bound * (1 + 1e-9)


@pytest.mark.parametrize("tolerance", [1e-5, 1e-7, 1e-9])
def test_friction_of_pins_has_a_second_solution(finding, tolerance: float) -> None:
    """Where the solution that goes on lets nothing move as it must, another one does."""
    model = finding("folded_chain")
    result, exact = model.simulate(tolerance=tolerance), model.simulate(tolerance=1e-12)
    assert [(e.kind, e.liaison) for e in result.events] == [
        (e.kind, e.liaison) for e in exact.events
    ]
    assert abs(result["b0.angle"][-1] - exact["b0.angle"][-1]) <= 100 * tolerance
    times = np.linspace(0.56, 0.58, 41)
    now = result.at(times)
    for k in (0, 1, 4, 5):
        force = np.hypot(now[f"j{k}.force.x"], now[f"j{k}.force.y"])
        bound = 0.39035194460713274 * 0.024887619396974748 * force
        slips = now[f"j{k}.mode"] == 2
        law = -np.sign(now[f"j{k}.speed"]) * bound
        assert np.all(np.abs(now[f"j{k}.torque"] - law)[slips] <= 1e-9 * bound[slips])
