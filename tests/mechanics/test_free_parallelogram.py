"""A parallelogram that nothing pushes turns evenly through its flat postures, or ends by name."""

from __future__ import annotations

import numpy as np
import pytest

import frot

TEXT = """
planar model Parallelogram
  parameter AngularVelocity w = 1 rad/s;
  parameter Angle th = 1 rad;
  world(gravity = 0 m/s^2);
  body l: rod(mass = 1 kg, length = 1 m);
  body t: rod(mass = 1 kg, length = 2 m);
  body r: rod(mass = 1 kg, length = 1 m);
  frame far on ground at (2 m, 0 m);
  liaison A: rotoide(ground, l.start);
  liaison B: rotoide(l.tip, t.start);
  liaison C: rotoide(t.tip, r.tip);
  liaison D: rotoide(far, r.start);
initial
  l.angle = th; guess(r.angle = th, t.angle = 0);
  l.angular_velocity = w;
  experiment(stop = 3 s);
end Parallelogram;
"""


@pytest.fixture(scope="module")
def model() -> frot.Model:
    return frot.compile(TEXT)


def test_it_turns_evenly_or_ends_by_name(model: frot.Model) -> None:
    rng, named, passed = np.random.default_rng(11), 0, 0
    for k in range(120):
        th = rng.uniform(-3, 3) if k % 2 else round(rng.uniform(-3, 3), 1)
        w = rng.normal() * (3.0 if k % 3 else 0.1)
        tolerance = 10.0 ** -rng.integers(4, 13)
        try:
            result = model.simulate(tolerance=tolerance, parameters={"th": th, "w": w})
        except frot.FrotError as told:
            assert told.diagnostics[0].code == "E0910"
            named += 1
            continue
        now = result.at(3.0)
        for leg in "lr":
            assert abs(now[f"{leg}.angle"] - th - 3 * w) < (100 * tolerance + 1e-9) * (1 + abs(w))
        passed += result.figures.crossings > 0
    assert named <= 12 and passed >= 40


@pytest.mark.parametrize("w", [1.0, -1e-3])
def test_a_start_in_the_posture_ends_by_name(model: frot.Model, w: float) -> None:
    with pytest.raises(frot.FrotError) as told:
        model.simulate(parameters={"th": 0.0, "w": w})
    assert told.value.diagnostics[0].code == "E0910"
    assert "liaison 'D'" in str(told.value)


def test_at_rest_it_rests_there(model: frot.Model) -> None:
    now = model.simulate(parameters={"th": 0.0, "w": 0.0}).at(3.0)
    assert now["l.angle"] == now["r.angle"] == now["t.angle"] == 0.0


def test_an_instant_known_beforehand_next_to_a_posture_does_not_hang() -> None:
    """A step that was to end where time changes a load, and cannot pass the posture before it."""
    nudge = "force nudge: couple(l, value = if time < 0.00101 s then 0 N.m else 1e-9 N.m);"
    model = frot.compile(TEXT.replace("initial\n", f"  {nudge}\ninitial\n"))
    with pytest.raises(frot.FrotError) as told:
        model.simulate(tolerance=1e-8, parameters={"th": 0.001, "w": -1.0})
    assert told.value.diagnostics[0].code == "E0910"
