"""Stiff mechanisms: the implicit method with trees, loops, dry friction and equations of the text.

Values: linear modes, laws of conservation, the explicit method where it is affordable, and
digits found with other programs (tests/reference).
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from frot.runtime.engine import OK, Engine

import frot

HERE = Path(__file__).parent
MODELS = HERE.parents[1] / "models"

# Two masses on a line, joined by a stiff spring and a damper; the first hangs on a soft one.
MASSES = """planar model Masses
  parameter Stiffness k = 1e8 N/m;
  parameter Damping c = 1e5 N.s/m;
  body a: particle(mass = 1 kg);
  body b: particle(mass = 2 kg);
  liaison on_a: prismatique(ground, a, axis = x);
  liaison on_b: prismatique(ground, b, axis = x);
  force soft: spring(ground, a, k = 10 N/m, length = 0.5 m);
  force stiff: spring(a, b, k = k, length = 1 m);
  force brake: damper(a, b, c = c);
initial
  a.position = (1, 0) m;
  b.position = (2, 0) m;
  experiment(stop = 3 s);
end Masses;
"""

# A rod in a pin, a bob on a stiff spring at its tip: what is stiff turns.
PENDULUM = """planar model Pendulum
  body arm: rod(mass = 1 kg, length = 1 m);
  body bob: particle(mass = 2 kg);
  liaison pin: rotoide(ground, arm.start);
  force stiff: spring(arm.tip, bob, k = 1e8 N/m, length = 0.5 m);
  force brake: damper(arm.tip, bob, c = 1e5 N.s/m);
initial
  arm.angle = 0 rad;
  bob.position = (1.5, 0) m;
  experiment(stop = 0.2 s, method = {});
end Pendulum;
"""

# A block on a belt, held by a spring; a motor of small inductance starts the belt.
BELT = """planar model Belt
  body belt: particle(mass = 5 kg);
  body block: particle(mass = 1 kg);
  liaison rail: prismatique(ground, belt, axis = x);
  curve track on belt: line(through = (0, 0) m, direction = (1, 0));
  liaison rub: point_courbe(block, track) with coulomb(0.3, mu_s = 0.5);
  force back: spring(ground, block, k = 50 N/m, length = 1 m);
  force drive: on(belt, value = (5 N/A*i, 0 N));
  Current i;
initial
  belt.position = (0, 0) m;
  block.position = (1, 0) m;
  belt.velocity = (0, 0) m/s;
  i = 0 A;
equation
  1e-5 H*der(i) = 2 V - 0.5 Ohm*i - 5 N/A*belt.velocity.x;
  experiment(stop = 1.5 s, method = {});
end Belt;
"""

# A crank on a stiff shaft, with a dry slider: a closed loop.
CRANK = """planar model Crank
  parameter Real k(unit = "N.m") = 1e6;
  parameter Real c(unit = "N.m.s") = 1e3;
  body wheel: disc(mass = 2 kg, radius = 0.2 m);
  body crank: rod(mass = 0.6 kg, length = 80 mm);
  body bielle: rod(mass = 1.1 kg, length = 240 mm);
  body piston: particle(mass = 0.9 kg);
  liaison W: rotoide(ground, wheel);
  liaison O: rotoide(ground, crank.start);
  liaison A: rotoide(crank.tip, bielle.start);
  liaison B: rotoide(bielle.tip, piston);
  curve bore on ground: line(through = (0, 0) m, direction = (1, 0));
  liaison C: point_courbe(piston, bore) with coulomb(mu = 0.08, mu_s = 0.10);
  force twist: couple(O, value = k*(W.angle - O.angle) + c*(W.speed - O.speed));
  force back: couple(W, value = -k*(W.angle - O.angle) - c*(W.speed - O.speed));
initial
  O.angle = 30 deg;
  W.angle = 30 deg;
  W.speed = 20 rad/s;
  O.speed = 20 rad/s;
  experiment(stop = 0.2 s, method = {});
end Crank;
"""


def steps(result: frot.Result) -> tuple[int, int]:
    """All steps, and those of the implicit method."""
    counts = result._engine.statistics
    return counts.steps, counts.implicit_steps


@pytest.mark.parametrize("damping", [1e4, 1e8])
def test_a_stiff_spring_follows_the_tolerance_and_is_found_by_itself(damping: float) -> None:
    model, k, soft = frot.compile(MASSES), 1e8, 10.0
    # x_a, x_b - x_a - 1, their rates; rates of modes from the inverse, which keeps slow ones exact
    a = np.zeros((4, 4))
    a[0, 2] = a[1, 3] = 1
    a[2], a[3] = [-soft, k, 0, damping], [soft, -1.5 * k, 0, -1.5 * damping]
    inverse, modes = np.linalg.eig(np.linalg.inv(a))
    parts = np.linalg.solve(modes, np.array([0.5, 0, 0, 0], dtype=complex))
    lasting = np.abs(inverse) > 1e-3
    exact = (modes[:, lasting] @ (parts * np.exp(3 / inverse))[lasting]).real
    exact[0] += 0.5
    for tolerance in (1e-4, 1e-6, 1e-8, 1e-10):
        result = model.simulate(tolerance=tolerance, parameters={"c": damping})
        error = max(
            abs(result["a.position.x"][-1] - exact[0]), abs(result["a.velocity.x"][-1] - exact[2])
        )
        assert error < 2 * tolerance
        count, implicit = steps(result)
        assert 0 < implicit < count < 400


@pytest.mark.parametrize(
    ("text", "names"),
    [
        (PENDULUM, ("arm.angle", "bob.velocity.x", "bob.position.y")),
        (BELT, ("block.position.x", "belt.velocity.x", "i")),
        (CRANK, ("piston.position.x", "W.speed", "O.angle")),
    ],
)
def test_both_methods_agree_in_trees_loops_and_dry_friction(text: str, names: tuple[str]) -> None:
    slow = frot.compile(text.format("explicit")).simulate(tolerance=1e-11)
    fast = frot.compile(text.format("implicit"))
    for tolerance in (1e-6, 1e-9):
        result = fast.simulate(tolerance=tolerance)
        for name in names:
            size = np.abs(slow[name]).max()
            assert abs(result[name][-1] - slow[name][-1]) < 20 * tolerance * size, name
            assert np.abs(result[name] - slow[name]).max() < 1e-6 * size, name
        count, implicit = steps(result)
        assert count == implicit < 0.2 * steps(slow)[0]
        assert [(e.kind, e.liaison) for e in result.events] == [
            (e.kind, e.liaison) for e in slow.events
        ]
        for event, other in zip(result.events, slow.events, strict=True):
            assert abs(event.time - other.time) < 20 * tolerance
        assert abs(result.balance.relative) < 20 * tolerance


def test_what_sticks_does_not_creep_in_implicit_steps() -> None:
    result = frot.compile(BELT.format("implicit")).simulate(stop=0.3)
    assert steps(result)[1] > 0
    assert np.all(result["rub.slip"] == 0)


def test_a_run_goes_on_to_the_same_bits_from_where_it_was_saved() -> None:
    made = Engine(frot.compile(BELT.format("implicit")).program())
    assert made.start(0.0, 1e-8, "rest") == OK
    assert made.advance(0.4).status == OK
    kept = made.save()
    there = made.sample(made.advance(1.4).record, np.array([1.4]))
    made.restore(kept)
    for t in (0.5, 0.9, 1.4):
        done = made.advance(t)
    assert np.array_equal(made.sample(done.record, np.array([1.4])), there)


def test_andrews_squeezer() -> None:
    known = json.loads((HERE.parent / "reference" / "andrews_squeezer.json").read_text())
    model = frot.load(MODELS / "andrews_squeezer.frot")
    for tolerance, error in ((1e-8, 1e-9), (1e-11, 3e-12)):
        result = model.simulate(tolerance=tolerance)
        for name, value in known["q"].items():
            assert abs(result[f"{name}.angle"][-1] - value) < error, name


def test_the_governor_keeps_its_moment_of_momentum() -> None:
    model = frot.load(MODELS / "flyball_governor.frot")
    result = model.simulate(stop=10.0, tolerance=1e-9)
    count, implicit = steps(result)
    assert 0 < implicit < count < 1500
    sine, cosine = np.sin(result["open_right.angle"]), np.cos(result["open_right.angle"])
    arms = (5 + 0.3 / 4 + 0.3 * (1 + 1e-4) / 12) * sine**2 + 0.3 * 2e-4 / 12 * cosine**2
    momentum = result["turn.speed"] * (3 * 0.02 / 12 + 0.3 * 2e-4 / 12 + 2 * arms)
    assert np.abs(momentum / momentum[0] - 1).max() < 1e-8
    assert abs(result.balance.relative) < 1e-9


# From rest, where the square of the speed has no slope but zero; a user's root has none at all.
THICK = """planar model Thick
  parameter Mass m = 1 g;
  body ball: particle(mass = m);
  body sled: particle(mass = 1 kg);
  liaison on_a: prismatique(ground, ball, axis = x);
  liaison on_b: prismatique(ground, sled, axis = x);
  force oil: drag(ball, c = 100 kg/m, exponent = 2);
  force push: on(ball, value = (10 N, 0 N));
  force pull: on(sled, value = (-sqrt(abs(sled.position.x)/(1 m))*(1 N), 0 N));
initial
  ball.position = (0, 0) m;
  sled.position = (0, 0) m;
  sled.velocity = (1, 0) m/s;
  experiment(stop = 0.5 s, method = {});
end Thick;
"""


@pytest.mark.parametrize("method", ["implicit", "auto"])
def test_what_has_no_slope_at_rest_starts_all_the_same(method: str) -> None:
    model = frot.compile(THICK.format(method))
    limit, pace = 10**-0.5, (10 * 100 / 1e-6) ** 0.5  # F/c = v^2; m v' = F - c v^2
    for tolerance in (1e-4, 1e-7, 1e-10):
        result = model.simulate(tolerance=tolerance)
        speed = limit * np.tanh(pace * result.time)
        assert np.abs(result["ball.velocity.x"] - speed).max() < 10 * tolerance * limit
        energy = result["sled.velocity.x"] ** 2 / 2 + result["sled.position.x"] ** 1.5 * 2 / 3
        assert np.abs(energy - 0.5).max() < 10 * tolerance


# Two pairs as above, a block that slides to its stop, one that never moves, and a driven row.
APART = """planar model Apart
  parameter Stiffness k = 1e8 N/m;
  parameter Damping c = 1e4 N.s/m;
  curve floor on ground: line(through = (0, 0) m, direction = (1, 0));
{bodies}initial
{starts}  experiment(stop = 3 s, tolerance = 1e-8);
end Apart;
"""


def pair(name: str, soft: float) -> tuple[str, str]:
    a, b = f"a{name}", f"b{name}"
    return (
        f"  body {a}: particle(mass = 1 kg);\n  body {b}: particle(mass = 2 kg);\n"
        f"  liaison on_{a}: prismatique(ground, {a}, axis = x);\n"
        f"  liaison on_{b}: prismatique(ground, {b}, axis = x);\n"
        f"  force soft{name}: spring(ground, {a}, k = {soft} N/m, length = 0.5 m);\n"
        f"  force stiff{name}: spring({a}, {b}, k = k, length = 1 m);\n"
        f"  force brake{name}: damper({a}, {b}, c = c);\n"
    ), f"  {a}.position = (1, 0) m;\n  {b}.position = (2, 0) m;\n"


def block(name: str, speed: float) -> tuple[str, str]:
    return (
        f"  body {name}: particle(mass = 1 kg);\n"
        f"  liaison on_{name}: point_courbe({name}, floor) with coulomb(0.3);\n"
    ), f"  {name}.position = (0, 0) m;\n  {name}.velocity = ({speed}, 0) m/s;\n"


def test_stiff_islands_run_implicitly_beside_blocks_that_stop_and_rest() -> None:
    """A rigid pair swings with the square of its rate soft/3 kg; the block stops at v/(mu g)."""
    parts = [pair("", 10.0), block("runs", 4.0), pair("2", 30.0), block("rests", 0.0)]
    text = APART.format(bodies="".join(p[0] for p in parts), starts="".join(p[1] for p in parts))
    model = frot.compile(text)
    result = model.simulate()
    count, implicit = steps(result)
    assert 0.5 * count < implicit < count < 500
    for name, soft in (("a", 10.0), ("a2", 30.0)):
        # the soft spring stretches the stiff one: terms of soft/k = 1e-7
        exact = 0.5 + 0.5 * np.cos(np.sqrt(soft / 3) * result.time)
        assert np.abs(result[f"{name}.position.x"] - exact).max() < 2e-6
    (stop,) = (e for e in result.events if e.liaison == "on_runs")
    assert stop.kind == "stick"
    assert abs(stop.time - 4 / (0.3 * 9.81)) < 1e-8
    assert abs(result["runs.position.x"][-1] - 16 / (2 * 0.3 * 9.81)) < 1e-7
    assert np.all(result["rests.velocity.x"] == 0)
    assert np.all(result["rests.position.x"] == 0)


def test_a_long_chain_of_stiff_springs_runs_implicitly() -> None:
    """30 masses, pushed from rest by a constant force: the sum of its modes."""
    count, k, c, push, end = 30, 1e6, 1.9e3, 100.0, 0.3
    bodies, starts = "", ""
    for j in range(count):
        before = f"b{j - 1}" if j else "ground"
        bodies += (
            f"  body b{j}: particle(mass = 1 kg);\n"
            f"  liaison on{j}: prismatique(ground, b{j}, axis = x);\n"
            f"  force s{j}: spring({before}, b{j}, k = {k} N/m, length = 1 m);\n"
            f"  force d{j}: damper({before}, b{j}, c = {c} N.s/m);\n"
        )
        starts += f"  b{j}.position = ({j + 1}, 0) m;\n"
    model = frot.compile(
        f"planar model Chain\n{bodies}  force push: on(b{count - 1}, value = ({push} N, 0 N));\n"
        f"initial\n{starts}  experiment(stop = {end} s);\nend Chain;\n"
    )
    joined = 2 * np.eye(count) - np.eye(count, k=1) - np.eye(count, k=-1)
    joined[-1, -1] = 1
    squares, modes = np.linalg.eigh(joined)
    damping, rates = c * squares / 2, k * squares
    fast = np.sqrt((damping**2 - rates).astype(complex))
    slow, quick = fast - damping, -fast - damping
    left = ((slow * np.exp(quick * end) - quick * np.exp(slow * end)) / (slow - quick)).real
    force = push * modes[-1]
    moved = modes @ (force / rates * (1 - left))
    for tolerance in (1e-5, 1e-8):
        result = model.simulate(tolerance=tolerance)
        count_of_steps, implicit = steps(result)
        assert 0.3 * count_of_steps < implicit < count_of_steps < 400
        last = result[f"b{count - 1}.position.x"][-1] - count
        assert abs(last - moved[-1]) < 20 * tolerance * np.abs(moved).max()


def test_what_is_still_at_rest_is_no_reason_for_short_implicit_steps() -> None:
    """30 rods joined by stiff springs let go from the horizontal: the bend comes from the wall, and
    joints far from it are at rest but for rounding. The last rod falls freely."""
    rods, starts, before = "", "", "ground"
    for k in range(30):
        rods += (
            f"  body r{k}: rod(mass = 1 kg, length = 0.1 m);\n"
            f"  liaison p{k}: rotoide({before}, r{k}.start);\n"
            f"  force s{k}: couple(p{k}, value = -1e4 N.m*p{k}.angle - 10 N.m.s*p{k}.speed);\n"
        )
        starts += f"  p{k}.angle = 0;\n  p{k}.speed = 0 rad/s;\n"
        before = f"r{k}.tip"
    model = frot.compile(
        f"planar model Row\n{rods}initial\n{starts}"
        "  experiment(stop = 0.02 s, method = implicit);\nend Row;\n"
    )
    result = model.simulate(tolerance=1e-6)
    counts = result._engine.statistics
    assert counts.implicit_steps == counts.steps < 200
    assert counts.rejected < 30
    for t in (5e-4, 1e-3, 2e-3):
        assert abs(result.at(t)["r29.position.y"] + 9.81 * t**2 / 2) < 1e-5 * 9.81 * t**2 / 2


ROLLS = """
model Drawn "A ball that rolls draws a point by a stiff spring with a damper"
  body ball: sphere(mass = 1 kg, radius = 0.2 m);
  liaison rolls: roulement(ground.plane, ball.surface);
  body point: particle(mass = 0.1 kg);
  force s: spring(ball, point, k = 1e4 N/m, length = 0.3 m);
  force d: damper(ball, point, c = 10 N.s/m);
initial
  ball.position = (0, 0, 0.2) m;
  ball.angular_velocity = (1, 3, 2) rad/s;
  point.position = ball.position + (0.3, 0, 0.1) m;
  experiment(stop = 2 s, tolerance = 1e-8);
end Drawn;
"""


def test_groups_without_rows_beside_one_row_have_their_derivatives() -> None:
    """The inertia of a ball joins no speeds, so that its only row is that of one group of seven."""
    texts = (ROLLS.replace("1e-8)", f"1e-8, method = {x})") for x in ("explicit", "implicit"))
    explicit, implicit = (frot.compile(text).simulate() for text in texts)
    for name in ("ball.position.x", "ball.position.y", "point.position.z"):
        assert np.abs(explicit[name] - implicit[name]).max() < 1e-7, name
    assert implicit.figures.steps < 0.5 * explicit.figures.steps
