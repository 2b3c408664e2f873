"""Initial values where statements read unknowns of the blocks, and where they are far off."""

from __future__ import annotations

import math

import casadi as ca
import pytest
from small_models import Block, Small, column


def test_a_statement_on_the_unknown_of_a_block_fixes_the_state_behind_it(run) -> None:
    """y^3 + y = q, and y = 2 at the start: q = 10."""
    model = Small(
        name="behind", nq=1, q_speed=[-1], start=([1.0], [], [0.5]), rates=lambda s: -s.q,
        blocks=[Block(0, lambda s: [s.y[0] ** 3 + s.y[0] - s.q[0]])],
        position=lambda s: s.y[0] - 2, variables={"q": lambda s: s.q[0], "y": lambda s: s.y[0]},
    )  # fmt: skip
    result = run(model)
    assert result["q"][0] == pytest.approx(10, rel=1e-14)
    assert result["y"][0] == pytest.approx(2, rel=1e-14)


def test_a_statement_on_a_speed_goes_through_the_blocks_too(run) -> None:
    """2 y = v + 4 (linear block); y = 5 gives v = 6."""
    model = Small(
        name="speed", nq=1, nv=1, start=([0.0], [0.0], [0.0]), mass=lambda s: ca.SX(1),
        blocks=[Block(0, lambda s: [2 * s.y[0] - s.v[0] - 4], linear=True)],
        force=lambda s: ca.SX(0),
        velocity=lambda s: s.y[0] - 5, variables={"v": lambda s: s.v[0]},
    )  # fmt: skip
    assert run(model)["v"][0] == pytest.approx(6, rel=1e-14)


def test_a_chain_of_blocks_carries_slopes_through(run) -> None:
    """y0 = q0 + q1 (linear), y1 = exp(y0 / 4): least change of q for y1 = e."""
    model = Small(
        name="slopes", nq=2, q_speed=[-1, -1], start=([1.0, 1.0], [], [0.0, 1.0]),
        rates=lambda s: ca.SX.zeros(2), position=lambda s: s.y[1] - math.e,
        blocks=[
            Block(0, lambda s: [s.y[0] - s.q[0] - s.q[1]], linear=True),
            Block(1, lambda s: [ca.log(s.y[1]) - s.y[0] / 4]),
        ],
        variables={"a": lambda s: s.q[0], "b": lambda s: s.q[1]},
    )  # fmt: skip
    result = run(model)
    assert [result["a"][0], result["b"][0]] == pytest.approx([2, 2], rel=1e-13)


@pytest.mark.parametrize("guess", [0.0, 3.0, -40.0, 1e4])
def test_statements_far_from_linear_are_found_from_far(run, guess) -> None:
    """atan(q - 1) = 0: Newton's full steps diverge from beyond 1.39."""
    model = Small(
        name=f"far{guess}", nq=1, q_speed=[-1], start=([guess],), rates=lambda s: ca.SX(0),
        position=lambda s: ca.atan(s.q[0] - 1), variables={"q": lambda s: s.q[0]},
    )  # fmt: skip
    assert run(model)["q"][0] == pytest.approx(1, abs=1e-13)


def test_places_and_other_states_are_solved_together(run) -> None:
    """A mass of 4 kg at x and a filter state f with x + f = 6, x = 2 f: no freedom is left."""
    model = Small(
        name="both", nq=2, nv=1, q_speed=[0, -1], start=([0.0, 0.0], [0.0]),
        rates=lambda s: column(s.v[0], 0), mass=lambda s: ca.SX(4), force=lambda s: ca.SX(0),
        position=lambda s: column(s.q[0] + s.q[1] - 6, s.q[0] - 2 * s.q[1]),
        variables={"x": lambda s: s.q[0], "f": lambda s: s.q[1]},
    )  # fmt: skip
    result = run(model)
    assert [result["x"][0], result["f"][0]] == pytest.approx([4, 2], rel=1e-14)


def test_statements_that_contradict_each_other_are_named(run) -> None:
    model = Small(
        name="against", nq=1, q_speed=[-1], start=([1.0], [], [1.0]), rates=lambda s: -s.q,
        blocks=[Block(0, lambda s: [s.y[0] ** 3 - s.q[0]])],
        position=lambda s: column(s.y[0] - 2, s.q[0] - 9),
    )  # fmt: skip
    with pytest.raises(Exception, match=r"statement 1.*statement 2|statement 2.*statement 1") as e:
        run(model)
    assert "E0601" in str(e.value)


def test_a_block_without_solution_at_the_start_is_named(run) -> None:
    model = Small(
        name="none", nq=1, q_speed=[-1], start=([-1.0], [], [1.0]), rates=lambda s: -s.q,
        blocks=[Block(0, lambda s: [s.y[0] ** 2 - s.q[0]], name="'root'")],
    )  # fmt: skip
    with pytest.raises(Exception, match="equations for 'root'") as caught:
        run(model)
    assert "E0907" in str(caught.value)


def test_conditions_at_the_start_agree_with_the_values_they_choose(run) -> None:
    """y = if q > 1 then 5 else 2; the statement y + q = 7 holds on the upper branch: q = 2."""
    model = Small(
        name="branch", nq=1, q_speed=[-1], start=([1.5], [], [0.0]), rates=lambda s: ca.SX(0),
        conditions=lambda s: s.q[0] - 1, strict=[True],
        blocks=[Block(0, lambda s: [s.y[0] - ca.if_else(s.conditions[0], 5, 2)], linear=True)],
        position=lambda s: s.y[0] + s.q[0] - 7, variables={"q": lambda s: s.q[0]},
    )  # fmt: skip
    assert run(model)["q"][0] == pytest.approx(2, rel=1e-14)
