"""Events of the text: `when`, `reinit`, `sample`, `terminate`, `assert`, against closed forms."""

from __future__ import annotations

import math

import casadi as ca
import numpy as np
import pytest
from frot.runtime.engine import OK, TERMINATED, Engine
from small_models import Small, build, column

G = 9.81


def ball(name: str = "ball", **more) -> Small:
    """A ball dropped from 1 m: when h <= 0 then v = -e pre(v) and one more bounce is counted."""
    given = {
        "name": name, "nq": 1, "nv": 1, "start": ([1.0], [0.0], [], [0.0]),
        "parameters": {"e": 0.8},
        "mass": lambda s: ca.SX(1), "force": lambda s: ca.SX(-G), "conditions": lambda s: -s.q[0],
        "strict": [False], "whens": [(0, False)], "n_discrete": 1, "stop": 2.5,
        "update": lambda s: (s.q, ca.if_else(s.fired[0], -s.p[0] * s.v, s.v), s.discrete + 1, []),
        "energy": lambda s: column(s.v[0] ** 2 / 2, G * s.q[0]),
        "variables": {
            "h": lambda s: s.q[0], "v": lambda s: s.v[0], "bounces": lambda s: s.discrete[0],
        },
    }  # fmt: skip
    return Small(**{**given, **more})


def impacts(count: int, e: float = 0.8) -> list[float]:
    first = math.sqrt(2 / G)
    times = [first]
    for k in range(1, count):
        times.append(times[-1] + 2 * first * e**k)
    return times


def test_a_ball_bounces_at_the_times_of_the_closed_form(run) -> None:
    result = run(ball(), tolerance=1e-12)
    fallen = [e.time for e in result.events if e.kind == "condition" and e.after == "true"]
    expected = [t for t in impacts(40) if t < 2.5]
    assert fallen == pytest.approx(expected, rel=1e-12)
    assert result["bounces"][-1] == len(expected)
    last = 2.5 - expected[-1]
    v = 0.8 ** len(expected) * math.sqrt(2 * G)
    assert result["h"][-1] == pytest.approx(v * last - G * last**2 / 2, abs=1e-11)
    assert result.balance.relative < 1e-12  # what `reinit` takes is no part of the balance


@pytest.mark.parametrize("e", [0.5, 0.1, 0.01])
def test_a_ball_that_bounces_for_ever_is_refused_at_the_limit(run, e) -> None:
    limit = math.sqrt(2 / G) * (1 + 2 * e / (1 - e))
    with pytest.raises(Exception, match=r"do not settle.*without end") as caught:
        run(ball(), parameters={"e": e}, stop=3.0)
    assert caught.value.result.time[-1] == pytest.approx(limit, abs=1e-5)


def test_a_run_ends_where_the_text_terminates_it(run) -> None:
    """`terminate` at the third bounce: the values are those after it."""
    model = ball(
        "ending", outcomes=[("terminate", "three bounces")],
        update=lambda s: (s.q, -s.p[0] * s.v, s.discrete + 1, s.discrete[0] >= 2),
    )  # fmt: skip
    result = run(model, tolerance=1e-12)
    third = impacts(3)[-1]
    assert result.time[-1] == pytest.approx(third, rel=1e-12)
    assert result["bounces"][-1] == 3
    assert result["v"][-1] == pytest.approx(0.8**3 * math.sqrt(2 * G), rel=1e-11)
    assert result.events[-1].kind == "terminate"
    assert "three bounces" in result.summary()


def test_a_run_that_has_ended_stays_ended(tmp_path) -> None:
    model = ball("ended", outcomes=[("terminate", "down")],
        update=lambda s: (s.q, s.v, s.discrete, 1))  # fmt: skip
    engine = Engine(build(model, tmp_path / "ended"))
    assert engine.start(0.0, 1e-10, "rest") == OK
    assert engine.advance(0.2).status == OK
    first = engine.advance(1.0)
    assert first.status == TERMINATED and [e.kind for e in first.events] == [9, 12]
    assert engine.time == pytest.approx(impacts(1)[0], rel=1e-12)
    again = engine.advance(2.0)
    assert (again.status, len(again.segments), again.events) == (TERMINATED, 0, [])
    assert engine.settle() == TERMINATED
    assert engine.fault.status == 0


def test_a_failed_assertion_is_told_with_its_text_and_place(run) -> None:
    model = ball(
        "asserted", outcomes=[("fail", "the ball is on the floor")],
        update=lambda s: (s.q, s.v, s.discrete, 1),
    )  # fmt: skip
    with pytest.raises(Exception, match="the ball is on the floor") as caught:
        run(model)
    assert "E0906" in str(caught.value) and "small:1:1" in str(caught.value)
    assert caught.value.result.time[-1] == pytest.approx(impacts(1)[0], rel=1e-12)


def test_a_warning_is_an_event_and_the_run_goes_on(run) -> None:
    model = ball(
        "warned", outcomes=[("warn", "hard landing")], parameters={"e": 0.8},
        update=lambda s: (s.q, -s.p[0] * s.v, s.discrete + 1, s.v[0] < -4),
    )  # fmt: skip
    result = run(model, stop=1.0)
    warnings = [e for e in result.events if e.kind == "warning"]
    assert [e.time for e in warnings] == pytest.approx(impacts(1), rel=1e-11)
    assert "hard landing" in warnings[0].text and result.time[-1] == 1.0


def sampler(name: str, **more) -> Small:
    """when sample(0, 0.1): n = n + 1, held = x. x' = 1."""
    given = {
        "name": name, "nq": 1, "q_speed": [-1], "stop": 1.05,
        "start": ([0.0], [], [], [0.0, 0.0, -1.0]),
        "rates": lambda s: ca.SX(1), "conditions": lambda s: s.t - s.discrete[0], "strict": [False],
        "whens": [(0, True)], "n_discrete": 3, "time_dependent": True,
        "update": lambda s: (
            s.q, s.v, column((s.discrete[1] + 1) * 0.1, s.discrete[1] + 1, s.q[0]), [],
        ),
        "variables": {"n": lambda s: s.discrete[1], "held": lambda s: s.discrete[2]},
    }  # fmt: skip
    return Small(**{**given, **more})


def test_samples_are_counted_from_the_start_on(run) -> None:
    result = run(sampler("sampler"), interval=0.05)
    t = np.round(result.time, 10)
    away = np.abs(t * 10 - np.round(t * 10)) > 0.1
    assert np.array_equal(result["n"][away], np.floor(t[away] * 10) + 1)
    assert result["held"][away] == pytest.approx(np.floor(t[away] * 10) / 10, abs=1e-14)


def test_one_event_brings_the_next_at_the_same_instant(run) -> None:
    """d1 = 1 at t = 1; when d1 > 0.5 then d2 = 1; when d2 > 0.5 then x = 7."""
    model = Small(
        name="chain", nq=1, q_speed=[-1], start=([0.0], [], [], [0.0, 0.0]), stop=2.0,
        rates=lambda s: ca.SX(1), time_dependent=True, n_discrete=2,
        conditions=lambda s: column(s.t - 1, s.discrete[0] - 0.5, s.discrete[1] - 0.5),
        strict=[False, True, True], whens=[(0, False), (1, False), (2, False)],
        update=lambda s: (
            ca.if_else(s.fired[2], 7, s.q), s.v,
            column(
                ca.if_else(s.fired[0], 1, s.discrete[0]), ca.if_else(s.fired[1], 1, s.discrete[1])
            ), [],
        ),
        variables={"x": lambda s: s.q[0]},
    )  # fmt: skip
    result = run(model)
    assert result["x"][-1] == pytest.approx(8, rel=1e-14)
    assert [e.time for e in result.events] == pytest.approx([1.0] * 3, rel=1e-15)


def test_conditions_that_chase_each_other_are_refused(run) -> None:
    model = Small(
        name="flip", nq=1, q_speed=[-1], start=([0.0], [], [], [0.0]), stop=2.0,
        rates=lambda s: ca.SX(1), n_discrete=1, strict=[False, True, True],
        conditions=lambda s: column(s.q[0] - 1, s.discrete[0] - 0.5, 0.5 - s.discrete[0]),
        whens=[(0, False), (1, False), (2, False)],
        update=lambda s: (s.q, s.v, 1 - s.discrete, []),
    )  # fmt: skip
    with pytest.raises(Exception, match="bring each other about without end"):
        run(model)


def test_a_parameter_that_makes_a_condition_hold_fires_its_when(tmp_path) -> None:
    model = Small(
        name="outside", nq=1, q_speed=[-1], parameters={"limit": 5.0}, strict=[True],
        start=([0.0], [], [], [0.0]), rates=lambda s: ca.SX(1), whens=[(0, False)], n_discrete=1,
        conditions=lambda s: s.q[0] - s.p[0],
        update=lambda s: (s.q * 0, s.v, s.discrete + 1, []),
        variables={"x": lambda s: s.q[0], "n": lambda s: s.discrete[0]},
    )  # fmt: skip
    engine = Engine(build(model, tmp_path / "outside"))
    assert engine.start(0.0, 1e-10, "rest") == OK
    engine.advance(2.0)
    engine.set_parameter(0, 1.5)
    assert engine.settle() == OK
    run = engine.advance(3.0)
    values = engine.sample(run.record, np.array([3.0]))[0]
    assert values == pytest.approx([1.0, 1.0], rel=1e-14)


def test_a_reinit_goes_through_the_modes_of_friction(run) -> None:
    """A braked wheel at rest is struck at t = 1: it slips from there, and rests again."""
    from small_models import Element

    model = Small(
        name="struck", nq=1, nv=1, unilateral=[0.0], elements=[Element("value", tangent=0)],
        mass=lambda s: ca.SX(2), force=lambda s: ca.SX(0), start=([0.0], [0.0]), stop=4.0,
        rows=lambda s: ca.SX(1), coefficients=lambda s: column(3.0, 3.0), time_dependent=True,
        conditions=lambda s: s.t - 1, strict=[False], whens=[(0, False)],
        update=lambda s: (s.q, s.v + 2, [], []), variables={"w": lambda s: s.v[0]},
    )  # fmt: skip
    result = run(model)
    kinds = [(e.kind, e.time) for e in result.events if e.kind != "condition"]
    assert kinds == [("slip", pytest.approx(1)), ("stick", pytest.approx(1 + 4 / 3, rel=1e-12))]
    assert result["w"][-1] == 0


def test_runs_with_events_in_pieces_and_restored_are_the_same_bits(tmp_path) -> None:
    program = build(ball("pieces"), tmp_path / "pieces")
    whole, pieces = Engine(program), Engine(program)
    for engine in (whole, pieces):
        assert engine.start(0.0, 1e-10, "rest") == OK
    expected = whole.advance(2.5).segments
    found = []
    for t in np.linspace(0, 2.5, 61)[1:]:
        found.append(pieces.advance(t).segments)
        saved = pieces.save()
        pieces = Engine(program)
        pieces.restore(saved)
    assert np.array_equal(np.concatenate(found).view(np.uint64), expected.view(np.uint64))
