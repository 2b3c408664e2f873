"""Scenes of `bench/impacts.py` against exact values: errors do not grow with the impacts."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

import frot

sys.path.insert(0, str(Path(__file__).parents[2] / "bench"))

import impact_references
from peers import impacts_frot
from peers.impact_scenes import BALL, BLOCK


def test_an_elastic_ball_is_at_its_height_after_a_thousand_bounces() -> None:
    times = {"ball": (BALL.stop, BALL.stop)}
    found = impacts_frot.run(frot.compile(impacts_frot.ball()), "ball", 1e-8, times)
    assert found.positions == pytest.approx(impact_references.ball(), abs=1e-10)


def test_a_block_rocks_a_hundred_times() -> None:
    """Swings are integrated one by one; each blow takes Housner's part of the speed."""
    model = frot.compile(impacts_frot.block())
    turned, tilt = impact_references.block()
    for tolerance, error in ((1e-4, 1e-6), (1e-7, 1e-9), (1e-11, 3e-12)):
        result = model.simulate(stop=turned, tolerance=tolerance)
        assert result["b.angle"][-1] == pytest.approx(tilt[0], abs=error)
        blows = {e.time for e in result.events if e.kind == "impact"}
        assert len(blows) == BLOCK.blows
        assert result["b.angular_velocity"][-1] == pytest.approx(0, abs=30 * error)


def test_nine_elastic_balls_are_where_exact_flights_bring_them() -> None:
    """An error of rounding grows some ten times an impact; energy is kept through all of them."""
    model = frot.compile(impacts_frot.billiard())
    early, late, places = impact_references.billiard()
    found = impacts_frot.run(model, "billiard", 1e-9, {"billiard": (early, late)})
    assert found.positions == pytest.approx(places, abs=1e-10)
    assert found.speed == pytest.approx(0.5 * 0.17 * (2.0**2 + 0.03**2), rel=1e-11)
