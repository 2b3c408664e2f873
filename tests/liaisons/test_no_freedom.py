"""A mechanism that its liaisons hold fast is told with their names, by the report and by a run."""

from __future__ import annotations

import pytest

import frot

TRIANGLE = """
planar model Triangle "Three pins, two rods and the ground"
  body a: rod(mass = 1 kg, length = 1 m);
  body b: rod(mass = 1 kg, length = 1 m);
  frame f on ground at (1, 0) m;
  liaison p: rotoide(ground, a.start);
  liaison q: rotoide(a.tip, b.start);
  liaison r: rotoide(b.tip, f);
  output Force load = r.force.y;
end Triangle;
"""
WELDED = """
model Welded "A rod in a wall, and a redundant loop of four bars that moves beside it"
  body w: rod(mass = 1 kg, length = 1 m);
  liaison wall: encastrement(ground, w.start);
  body a: rod(mass = 1 kg, length = 1 m);
  body b: rod(mass = 1 kg, length = 2 m);
  body c: rod(mass = 1 kg, length = 1 m);
  frame e on ground at (2, 0, 0) m;
  liaison p: rotoide(ground, a.start, axis = y);
  liaison q: rotoide(a.tip, b.start, axis = y);
  liaison r: rotoide(b.tip, c.tip, axis = y);
  liaison s: rotoide(e, c.start, axis = y);
initial
  guess(p.angle = -60 deg, s.angle = -60 deg);
  experiment(stop = 0.1 s);
end Welded;
"""


def test_a_triangle_of_rods_says_that_nothing_can_move() -> None:
    """Each rod leans on both its pins: half of each weight on the ground's."""
    model = frot.compile(TRIANGLE)
    result = model.simulate()
    assert result.figures.free == 0
    assert "nothing can move: the liaisons 'p', 'q', 'r' hold all bodies" in result.summary()
    assert "nothing can move by itself: the liaisons 'p', 'q', 'r'" in str(model.report())
    assert abs(result["load"][0] + 9.81) < 1e-9  # of b on the ground


def test_what_moves_beside_is_counted_and_nothing_is_told() -> None:
    """Four bars with parallel axes keep one freedom, whatever number of relations they have."""
    result = frot.compile(WELDED).simulate()
    assert result.figures.free == 1
    assert "nothing can move" not in result.summary()


def test_what_time_alone_turns_may_be_kept_twice() -> None:
    """A pin that is driven leaves no unknown; a plane that lies flat beside it keeps the same."""
    result = frot.compile("""
model Kept
  body b: solid(mass = 1 kg, inertia = (1, 1, 2) kg.m^2);
  liaison flat: appui_plan(ground, b);
  liaison pin: rotoide(ground, b) driven(angle = 2*time/(1 s));
  output Angle turned = flat.angle;
  experiment(stop = 4 s);
end Kept;
""").simulate()
    assert result["turned"] == pytest.approx(2 * result.time, abs=1e-12)
