"""What does not touch costs what it costs alone: it has its own functions, and sleeps at rest."""

from __future__ import annotations

import numpy as np
import pytest
from frot.runtime.engine import OK, Engine
from records import records

import frot

PENDULUM = """  body arm: rod(mass = 1 kg, length = 1 m);
  liaison pin: rotoide(ground, arm.start);
"""
SWINGS = "  pin.angle = 60 deg;\n  pin.speed = 0 rad/s;\n"


def block(k: int, mass: float, contact: bool) -> str:
    line = f"line(through = ({k}, 0) m, direction = (cos(slope), -sin(slope)))"
    kind = "contact_ponctuel(l{0}, b{0})" if contact else "point_courbe(b{0}, l{0})"
    return (
        f"  body b{k}: particle(mass = {mass} kg);\n  curve l{k} on ground: {line};\n"
        f"  liaison s{k}: {kind.format(k)} with coulomb(mu);\n"
    )


def starts(k: int) -> str:
    return (
        f"  b{k}.position = ({k}, 0) m;\n  b{k}.velocity = (v{k}*cos(slope), -v{k}*sin(slope));\n"
    )


def scene(blocks: int, pendulum: bool, more: str = "") -> str:
    """Blocks on lines of their own, every other one by a contact that can part."""
    parts = "".join(block(k, 1 + 0.5 * k, k % 2 == 1) for k in range(blocks))
    speeds = "".join(f"  parameter Velocity v{k} = 0 m/s;\n" for k in range(blocks))
    start = "".join(starts(k) for k in range(blocks)) + (SWINGS if pendulum else "")
    return (
        "planar model Scene\n  parameter Angle slope = 20 deg;\n  parameter Real mu = 0.5;\n"
        f"  input Force push(start = 0 N);\n{speeds}{PENDULUM if pendulum else ''}{parts}{more}"
        f"initial\n{start}  experiment(stop = 4 s, tolerance = 1e-9);\nend Scene;\n"
    )


@pytest.fixture(scope="module")
def six() -> frot.Model:
    return frot.compile(scene(6, True, "  force f: on(b2, value = (push, 0 N));\n"))


def started(model: frot.Model, **values: float) -> Engine:
    program = model.program()
    engine = Engine(program)
    names = [p.name for p in program.parameters]
    for name, value in values.items():
        engine.set_parameter(names.index(name), value)
    assert engine.start(0.0, 1e-9, "rest") == OK, engine.fault_text
    return engine


def test_a_block_that_stops_among_others_stops_as_alone(six: frot.Model) -> None:
    """v^2 = 2 g (mu cos - sin) s, Painlevé 1895 p. 58, each with a mass and a speed of its own."""
    speeds = {f"v{k}": v for k, v in enumerate((1.0, 0.0, 0.5, 2.0, 0.0, 3.0))}
    result = six.simulate(parameters=speeds, tolerance=1e-10)
    slope = np.deg2rad(20)
    brake = 9.81 * (0.5 * np.cos(slope) - np.sin(slope))
    stops = {e.liaison: e.time for e in result.events if e.kind == "stick"}
    for k, v in enumerate(speeds.values()):
        moved = np.hypot(result[f"b{k}.position.x"][-1] - k, result[f"b{k}.position.y"][-1])
        assert moved == pytest.approx(v * v / (2 * brake), rel=1e-9, abs=1e-15)
        assert result[f"b{k}.velocity.x"][-1] == 0
        if v:
            assert stops[f"s{k}"] == pytest.approx(v / brake, rel=1e-9)


def test_the_pendulum_swings_as_alone(six: frot.Model) -> None:
    """The same to a few times the tolerance, though the steps end at the events of the blocks."""
    alone = frot.compile(scene(0, True)).simulate(tolerance=1e-10)
    among = six.simulate(parameters={"v0": "2 m/s"}, tolerance=1e-10)
    assert np.allclose(among["pin.angle"], alone["pin.angle"], rtol=0, atol=1e-8)


def test_what_sleeps_is_what_it_would_be_awake(six: frot.Model) -> None:
    """Every variable of the blocks is constant to the bit, from the first to the last instant."""
    result = six.simulate()
    for name in result:
        if name[0] in "bs" and name[1:2].isdigit():
            assert np.all(result[name] == result[name][0]), name


def test_what_sleeps_is_not_evaluated(six: frot.Model) -> None:
    """The steps are those of the pendulum; the first alone says where the rest stands."""
    engine = started(six)
    whole = engine.advance(3.0)
    steps = engine.statistics.steps
    lengths = [len(segment) for segment in records(whole.segments)]
    assert len(lengths) == steps
    assert sum(length > engine.segment_size / 2 for length in lengths) == 1


def test_nothing_is_evaluated_inside_steps_where_nobody_looks(six: frot.Model) -> None:
    """Twelve evaluations a step, and seven for a measure of rounding after the first rejection.

    What is evaluated for values inside steps is neither counted nor changes the run.
    """
    engine = started(six)
    whole = engine.advance(3.0)
    made = engine.statistics
    assert made.evaluations <= 12 * (made.steps + made.rejected) + 20 + 7
    inside = np.linspace(0.0, 3.0, 301)
    values = engine.sample(whole.segments, inside)
    assert engine.statistics.evaluations == made.evaluations
    for t, row in zip(inside[1::50], values[1::50], strict=True):  # what a host is shown there
        other = started(six)
        assert np.array_equal(other.sample(other.advance(t).segments, np.array([t]))[0], row)


def test_a_load_from_outside_wakes(six: frot.Model) -> None:
    """Pushed by 20 N, block 2 of 2 kg slides down its line; let go, it comes to rest again."""
    engine = started(six)
    engine.advance(1.0)
    slope = np.deg2rad(20)
    engine.set_input(0, 20.0)
    pushed = engine.advance(1.5)
    assert [engine.event_text(e).split(" at ")[0] for e in pushed.events] == ["s2: stick -> slip"]
    values = engine.sample(pushed.segments, np.array([1.5]))[0]
    column = [v.name for v in engine.program.variables].index("b2.velocity.x")
    normal = 9.81 * 2 * np.cos(slope) - 20 * np.sin(slope)
    drive = 20 * np.cos(slope) + 9.81 * 2 * np.sin(slope) - 0.5 * normal
    assert values[column] == pytest.approx(0.5 * drive / 2 * np.cos(slope), rel=1e-9)
    engine.set_input(0, 0.0)
    let_go = engine.advance(8.0)
    assert [engine.event_text(e).split(" at ")[0] for e in let_go.events] == ["s2: slip -> stick"]


def test_a_run_in_pieces_and_a_saved_one_have_the_same_bits(six: frot.Model) -> None:
    """Asleep or not, results do not depend on when they are asked."""
    times = np.linspace(0.0, 3.0, 31)
    whole = started(six, v1=1.0)
    expected = whole.sample(whole.advance(3.0).segments, times)
    pieces = started(six, v1=1.0)
    found = []
    for t in times[1:]:
        run = pieces.advance(t)
        saved = pieces.save()
        pieces = Engine(pieces.program)
        pieces.restore(saved)
        found.append(run.segments)
    sampled = pieces.sample(np.concatenate(found), times)
    assert np.array_equal(sampled.view(np.uint64), expected.view(np.uint64))


def test_loads_that_read_other_groups_keep_them_awake_together() -> None:
    """A spring between a block and the pendulum makes one island of both: x'' of each is exact."""
    more = "  force k: spring(b0, b2, k = 400 N/m, length = 2 m);\n"
    model = frot.compile(scene(4, True, more))
    result = model.simulate(parameters={"v0": "3 m/s"}, tolerance=1e-10)
    assert {e.liaison for e in result.events} >= {"s0", "s2"}
    assert result.balance.relative < 1e-8


def test_a_load_of_time_alone_ends_a_rest() -> None:
    """The force ramps up from t = 1 at 4 N/s and moves the block when it reaches mu m g."""
    more = "  force f: on(b0, value = (max(0 N, (time - 1 s)*4 N/s), 0 N));\n"
    text = scene(3, False, more)
    result = frot.compile(text).simulate(parameters={"slope": 0.0}, tolerance=1e-9)
    [slip] = [e for e in result.events if e.kind == "slip"]
    assert (slip.liaison, slip.time) == ("s0", pytest.approx(1 + 0.5 * 9.81 / 4, rel=1e-8))
