"""Viscous, Stribeck's and smooth friction, laws of one's own, coefficients of place and time."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from space_models import G, last, model

import frot

ALONG = """
    {planar}model Along
      parameter Mass m = 2 kg;
      body b: {body};
      liaison g: {kind} with {law};
      {more}
    initial
      {start}
      experiment(stop = {stop} s, tolerance = 1e-11);
    end Along;
    """
IN_SPACE = "b.position = (0, 0, 0) m; b.velocity = ({x}, {y}, 0) m/s;"
IN_PLANE = "b.position = (0, 0) m; b.velocity = ({x}, 0) m/s;"


def along(kind: str, law: str, start: str, stop: float = 3, **more: str) -> frot.Model:
    fields = {"planar": "", "body": "particle(mass = m)", "more": "", **more}
    return model(ALONG.format(kind=kind, law=law, start=start, stop=stop, **fields))


@pytest.mark.parametrize("mass", [2, 2e6, 2e-6])
def test_a_viscous_guide_slows_down_exponentially(mass: float) -> None:
    """Its reaction along the axis and its power are those of the law."""
    scene = along(
        "prismatique(ground, b, axis = (1, 2, 3))",
        f"viscous({1.5 * mass} N.s/m)",
        "g.speed = -1 m/s;",
        more="world(gravity = 0 m/s^2); output Force f = g.force.z;",
    )
    result = scene.simulate(parameters={"m": f"{mass} kg"})
    speed = -np.exp(-1.5 * result.time)
    assert np.abs(result["g.speed"] - speed).max() < 1e-10
    friction = -1.5 * mass * speed
    assert result["f"] == pytest.approx(friction * 3 / math.sqrt(14), rel=1e-7)
    assert result["g.power"] == pytest.approx(friction * speed, rel=1e-7)
    assert result.balance.relative < 1e-9


@pytest.mark.parametrize(
    ("kind", "name", "start"),
    [
        ("rotoide(ground, b, axis = x)", "g.speed", "g.speed = 2 rad/s;"),
        ("verrou(ground, b, axis = x)", "g.speed_angle", "g.speed_angle = 2 rad/s;"),
        ("appui_plan(ground, b)", "b.angular_velocity.z",
         "g.angle = 0 rad; b.angular_velocity.z = 2 rad/s;"),
        ("spherique(ground, b)", "b.angular_velocity.z", "b.angular_velocity = (1, 0, 2) rad/s;"),
        ("cardan(ground, b)", "b.angular_velocity.z", "der(g.angle_a) = 2 rad/s;"),
    ],
)  # fmt: skip
def test_a_viscous_joint_damps_what_turns(kind: str, name: str, start: str) -> None:
    scene = along(
        kind,
        "viscous(0.012 N.m.s)",
        start,
        body="sphere(mass = 2 kg, radius = 0.1 m)",
        more="world(gravity = 0 m/s^2);",
    )
    result = scene.simulate()
    assert np.abs(result[name] - 2 * np.exp(-1.5 * result.time)).max() < 1e-10


def test_a_viscous_contact_damps_its_slip_in_every_direction() -> None:
    surface = "surface s on ground: plane(through = (0, 0, 0) m, normal = (0, 0, 1));"
    start = IN_SPACE.format(x=1, y=-2)
    result = along("point_surface(b, s)", "viscous(3 N.s/m)", start, more=surface).simulate()
    fall = np.exp(-1.5 * result.time)
    assert np.abs(result["b.velocity.x"] - fall).max() < 1e-10
    assert np.abs(result["b.velocity.y"] + 2 * fall).max() < 1e-10


def test_dry_and_viscous_friction_of_one_guide_add_up() -> None:
    """M v' = -mu m g - c v: it stops at t = (m/c) ln(1 + c v/(mu m g))."""
    result = along(
        "prismatique(ground, b, axis = x)", "coulomb(0.1), viscous(3 N.s/m)", "g.speed = 2 m/s;"
    ).simulate()
    (stop,) = result.events
    assert stop.time == pytest.approx(2 / 3 * math.log1p(3 * 2 / (0.1 * 2 * G)), rel=1e-10)
    assert last(result, "g.speed") == [0]


def faded(v: float) -> float:
    return 0.1 + 0.2 * math.exp(-((v / 0.5) ** 2))


@pytest.mark.parametrize(
    ("kind", "start", "planar"),
    [
        ("contact_ponctuel(b, ground.plane)", IN_SPACE.format(x=1.2, y=-1.6), False),
        ("prismatique(ground, b, axis = x)", "g.speed = -2 m/s;", False),
        ("lineaire_annulaire(ground, b, axis = x)", IN_SPACE.format(x=2, y=0), False),
        ("contact_ponctuel(b, ground.line)", IN_PLANE.format(x=2), True),
        ("prismatique(ground, b)", "g.speed = -2 m/s;", True),
    ],
)
def test_stribecks_coefficient_rises_as_the_slip_ends(kind: str, start: str, planar: bool) -> None:
    """The time to the stop is a quadrature over the speed; rest is exact."""
    scene = along(kind, "stribeck(0.1, 0.3, v_s = 0.5 m/s)", start,
                  planar="planar " if planar else "")  # fmt: skip
    result = scene.simulate()
    exact = quad(lambda v: 1 / (G * faded(v)), 0, 2, epsabs=1e-13, epsrel=1e-12)[0]
    (stop,) = result.events
    assert stop.time == pytest.approx(exact, rel=1e-10)
    assert last(result, "b.velocity.x", "b.velocity.y") == [0, 0]


@pytest.mark.parametrize(("speed", "unit"), [(20, "rad/s"), (1, "m/s")])
def test_stribecks_friction_of_a_pin_falls_with_its_turning(speed: float, unit: str) -> None:
    """At a radius of 5 cm 20 rad/s are 1 m/s at the surface of the pin."""
    result = along(
        "rotoide(ground, b)",
        f"stribeck(0.1, 0.3, v_s = {speed} {unit}, radius = 5 cm)",
        "g.speed = 30 rad/s;",
        stop=9,
        body="sphere(mass = m, radius = 0.1 m)",
    ).simulate()
    inertia = 0.4 * 0.1**2

    def slows(w: float) -> float:
        return (0.1 + 0.2 * math.exp(-((w / 20) ** 2))) * 0.05 * G / inertia

    exact = quad(lambda w: 1 / slows(w), 0, 30, epsabs=1e-13, epsrel=1e-12)[0]
    (stop,) = result.events
    assert stop.time == pytest.approx(exact, rel=1e-10)
    assert last(result, "g.speed") == [0]


def test_what_departs_against_stribecks_friction_runs_away() -> None:
    """At rest up to mu_s N; then m v' = k t - mu(v) m g, without a jump, by another integrator."""
    from scipy.integrate import solve_ivp

    result = along(
        "contact_ponctuel(b, ground.plane)",
        "stribeck(0.1, 0.3, v_s = 0.5 m/s)",
        IN_SPACE.format(x=0, y=0),
        stop=2,
        more="force f: on(b, value = (3.6 N*time/(1 s), -4.8 N*time/(1 s), 0 N));",
    ).simulate()
    begin = 0.3 * 2 * G / 6
    assert [event.time for event in result.events] == pytest.approx([begin], rel=1e-9)
    run = solve_ivp(
        lambda t, v: [(6 * t - faded(v[0]) * 2 * G) / 2], (begin, 2), [0],
        rtol=1e-12, atol=1e-15, method="DOP853",
    )  # fmt: skip
    speed = float(run.y[0, -1])
    assert last(result, "b.velocity.x", "b.velocity.y") == pytest.approx(
        [0.6 * speed, -0.8 * speed], rel=1e-8
    )


def test_the_viscous_part_of_stribecks_law() -> None:
    """Far above v_s: m v' = -mu m g - c v."""
    result = along(
        "prismatique(ground, b, axis = x)",
        "stribeck(0.1, 0.3, v_s = 0.001 m/s, c = 3 N.s/m)",
        "g.speed = 2 m/s;",
        stop=0.5,
    ).simulate()
    steady = 0.1 * 2 * G / 3
    exact = (2 + steady) * math.exp(-0.75) - steady
    assert last(result, "g.speed") == pytest.approx([exact], rel=1e-9)


@pytest.mark.parametrize("planar", [False, True])
def test_regularized_friction_creeps(planar: bool) -> None:
    """S' = -mu g s/sqrt(s^2 + v^2): sqrt(s^2 + v^2) - v asinh(v/s) falls with mu g t."""
    kind = "contact_ponctuel(b, ground.line)" if planar else "contact_ponctuel(b, ground.plane)"
    start = IN_PLANE.format(x=2) if planar else IN_SPACE.format(x=1.2, y=1.6)
    scene = along(kind, "regularized(0.3, v = 0.1 m/s)", start, stop=0.7,
                  planar="planar " if planar else "")  # fmt: skip
    result = scene.simulate()
    slip = np.abs(result["b.velocity.x"]) if planar else result["b.velocity.x"] / 0.6
    known = np.sqrt(slip**2 + 0.01) - 0.1 * np.arcsinh(0.1 / slip)
    assert known == pytest.approx(known[0] - 0.3 * G * result.time, abs=1e-10)
    assert slip[-1] > 0
    assert len(result.events) == 0


@pytest.mark.parametrize("mass", [2, 2e6, 2e-6])
@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(
    ("kind", "start"),
    [
        ("prismatique(ground, b, axis = x)", "g.speed = @ m/s;"),
        ("lineaire_annulaire(ground, b, axis = x)", IN_SPACE.format(x="@", y=0)),
        ("appui_plan(ground, b)", IN_SPACE.format(x="@", y=0)),
        ("contact_ponctuel(ground.plane, b, unilateral = false)", IN_SPACE.format(x="@", y=0)),
        ("point_surface(b, ground.plane)", IN_SPACE.format(x="@", y=0)),
        ("planar point_courbe(b, ground.line)", IN_PLANE.format(x="@")),
        ("planar prismatique(ground, b)", IN_PLANE.format(x="@")),
    ],
)
def test_regularized_friction_of_what_holds_both_ways(
    mass: float, sign: int, kind: str, start: str
) -> None:
    """Its bound is the length of the reaction, here m g: the closed form of what can part."""
    planar = "planar " if kind.startswith("planar ") else ""
    scene = along(
        kind.removeprefix("planar "),
        "regularized(0.3, v = 0.1 m/s)",
        start.replace("@", str(2 * sign)),
        stop=0.7,
        planar=planar,
    )
    result = scene.simulate(parameters={"m": f"{mass} kg"})
    slip = sign * result["b.velocity.x"]
    known = np.sqrt(slip**2 + 0.01) - 0.1 * np.arcsinh(0.1 / slip)
    assert known == pytest.approx(known[0] - 0.3 * G * result.time, abs=1e-9)
    assert len(result.events) == 0


@pytest.mark.parametrize("mass", [2, 2e6, 2e-6])
@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(
    "kind", ["rotoide(ground, b)", "spherique(ground, b)", "verrou(ground, b)"]
)
@pytest.mark.parametrize("speed", ["1 cm/s", "0.5 rad/s"])
def test_regularized_friction_of_pins(mass: float, sign: int, kind: str, speed: str) -> None:
    """I w' = -mu r m g w/sqrt(w^2 + (v/r)^2) about the vertical; a verrou has no force across."""
    scene = along(
        kind,
        f"regularized(0.3, v = {speed}, radius = 2 cm)",
        f"b.angular_velocity = (0, 0, {4 * sign}) rad/s;",
        stop=0.7,
        body="sphere(mass = m, radius = 10 cm)",
    )
    result = scene.simulate(parameters={"m": f"{mass} kg"})
    turn = sign * result["b.angular_velocity.z"]
    if kind.startswith("verrou"):
        assert turn == pytest.approx(4, rel=1e-10)
        return
    known = np.sqrt(turn**2 + 0.25) - 0.5 * np.arcsinh(0.5 / turn)
    fall = 0.3 * 0.02 * G / (0.4 * 0.1**2)
    lost = known - (known[0] - fall * result.time)
    by_turn = np.sqrt(turn**2 + 0.25) / turn  # the slope of `known`
    assert np.abs(lost / by_turn).max() < 1e-9
    assert turn[-1] < 0.1


def test_a_block_creeps_down_a_guide_that_is_no_steeper_than_friction() -> None:
    """It never rests: mu cos(a) s/sqrt(s^2 + v^2) = sin(a) in the end."""
    slope = 0.2
    result = along(
        f"prismatique(ground, b, axis = ({math.cos(slope)}, 0, {-math.sin(slope)}))",
        "regularized(0.3, v = 1 mm/s)",
        "g.speed = 0 m/s;",
        stop=1,
    ).simulate()
    ratio = math.tan(slope) / 0.3
    creep = 1e-3 * ratio / math.sqrt(1 - ratio**2)
    assert last(result, "g.speed") == pytest.approx([creep], rel=1e-9)


@pytest.mark.parametrize("kind", ["prismatique(ground, b)", "appui_plan(ground, b)"])
@pytest.mark.parametrize("sign", [1, -1])
def test_regularized_friction_follows_slips_through_zero(kind: str, sign: int) -> None:
    """M r'' = -k r - mu m g r'/sqrt(|r'|^2 + v^2), solved by another method; no event breaks it."""
    flat = kind.startswith("appui")
    start = f"g.speed = {2 * sign} m/s;" if not flat else IN_SPACE.format(x=2 * sign, y=0.3)
    result = along(
        kind,
        "regularized(0.2, v = 5 cm/s)",
        start,
        stop=2,
        more="force f: on(b, value = (-40*b.position.x, -40*b.position.y, 0 m)*(1 N/m));",
    ).simulate()

    def rate(_: float, x: np.ndarray) -> np.ndarray:
        friction = 0.2 * G * x[2:] / math.sqrt(x[2] ** 2 + x[3] ** 2 + 0.05**2)
        return np.concatenate([x[2:], -20 * x[:2] - friction])

    first = [0, 0, 2 * sign, 0.3 if flat else 0]
    found = solve_ivp(rate, (0, 2), first, rtol=1e-12, atol=1e-13, method="DOP853")
    names = ("b.position.x", "b.position.y", "b.velocity.x", "b.velocity.y")
    assert last(result, *names) == pytest.approx(found.y[:, -1], abs=1e-8)


OILED = """
    law Oiled(Real mu, Velocity v)
      tangential = -mu*normal*tanh(slip/v);
    end Oiled;
    law Oil(Damping c)
      tangential = -c*slip;
    end Oil;
    """


def test_a_law_of_ones_own_acts_along_the_slip_in_space() -> None:
    """S' = -7/2 mu g tanh(s/v) of a sphere: sinh(s/v) falls exponentially."""
    text = (
        OILED
        + """
    model Own
      body b: sphere(mass = 2 kg, radius = 0.1 m);
      liaison g: contact_ponctuel(b.surface, ground.plane) with Oiled(0.3, v = 0.1 m/s);
    initial
      b.position = (0, 0, 0.1) m;
      b.velocity = (0.3, 0.4, 0) m/s;
      experiment(stop = 0.05 s, tolerance = 1e-11);
    end Own;
    """
    )
    result = model(text).simulate()
    fall = np.exp(-3.5 * 0.3 * G * result.time / 0.1)
    slip = 0.1 * np.arcsinh(np.sinh(5) * fall)
    # the centre loses 2/7 of what the slip loses
    assert result["b.velocity.x"] == pytest.approx(0.6 * (0.5 - 2 / 7 * (0.5 - slip)), abs=1e-10)
    assert result["b.velocity.y"] == pytest.approx(0.8 * (0.5 - 2 / 7 * (0.5 - slip)), abs=1e-10)


@pytest.mark.parametrize(
    "kind", ["prismatique(ground, b, axis = x)", "lineaire_annulaire(ground, b, axis = x)"]
)
def test_a_law_of_ones_own_acts_along_a_guide(kind: str) -> None:
    text = OILED + ALONG.format(
        planar="", body="particle(mass = m)", kind=kind, law="Oil(3 N.s/m)", more="",
        start="b.velocity.x = 1 m/s;", stop=1,
    )  # fmt: skip
    assert last(model(text).simulate(), "b.velocity.x") == pytest.approx(
        [math.exp(-1.5)], rel=1e-10
    )


def test_a_coefficient_of_time_and_one_of_place() -> None:
    """V' = -g (0.1 + 0.05 t), and v^2/2 = v0^2/2 - g (0.2 x + 0.05 x^2)."""
    by_time = along(
        "prismatique(ground, b, axis = x)", "coulomb(0.1 + 0.05*time/(1 s))", "g.speed = 2 m/s;"
    ).simulate()
    (stop,) = by_time.events
    exact = (-0.1 + math.sqrt(0.1**2 + 0.1 * 2 / G)) / 0.05
    assert stop.time == pytest.approx(exact, rel=1e-10)
    by_place = along(
        "lineaire_annulaire(ground, b, axis = x)",
        "coulomb(0.2 + 0.1*b.position.x/(1 m))",
        IN_SPACE.format(x=2, y=0),
    ).simulate()
    place = (-0.2 + math.sqrt(0.2**2 + 0.2 * 2 / G)) / 0.1
    assert last(by_place, "b.position.x") == pytest.approx([place], rel=1e-10)
    assert last(by_place, "b.velocity.x") == [0]


@pytest.mark.parametrize(
    ("kind", "law", "code", "words"),
    [
        ("spherique(ground, b)", "regularized(0.1, v = 1 m/s)", "E0511", "do not turn"),
        ("prismatique(ground, b)", "coulomb(0.1), stribeck(0.1, 0.2, v_s = 1 m/s)", "E0511",
         "of one slip"),
        ("rotoide(ground, b)", "coulomb(0.1)", "E0511", "do not turn"),
        ("prismatique(ground, b)", "coulomb(0.1, radius = 1 cm)", "E0701", "radius"),
        ("appui_plan(ground, b)", "coulomb(0.1), rolling_resistance(1 mm)", "E0701", "rolling"),
        ("prismatique(ground, b)", "coulomb(0.1 + g.speed/(1 m/s))", "E0701", "speed"),
        ("verrou(ground, b)", "coulomb(0.2, half_length = 1 m)", "E0701", "half_length"),
        ("prismatique(ground, b)", "coulomb(0.1, half_length = 1 m*(1 + time/(1 s)))", "E0701",
         "half_length"),
    ],
)  # fmt: skip
def test_what_has_no_meaning_is_told(kind: str, law: str, code: str, words: str) -> None:
    with pytest.raises(frot.FrotError, match=words) as told:
        along(kind, law, "").simulate()
    assert code in str(told.value)


def test_a_pin_on_a_body_that_turns_needs_a_radius() -> None:
    with pytest.raises(frot.FrotError, match="needs radius"):
        along(
            "verrou(ground, b)", "coulomb(0.1)", "", body="sphere(mass = m, radius = 1 m)"
        ).report()
