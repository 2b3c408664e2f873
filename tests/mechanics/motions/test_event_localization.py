"""Events that a step may not pass over, whatever its length and whatever came before."""

from __future__ import annotations

from collections.abc import Callable

import pytest

import frot

pytestmark = pytest.mark.finding

Finding = Callable[..., frot.Model]

JAM = """
planar model Jam "a heavy body slides in a slot of a light disc that turns on a pin"
  parameter Mass light = 4.3e-6 kg;
  world(gravity = 0 m/s^2);
  body disc: disc(mass = light, radius = 40 m);
  body block: rod(mass = 36 kg, length = 110 m);
  frame f1 on ground at (-5.7 m, -20.75 m);
  curve slot on disc:
    line(through = (44.3 m, -9.8 m), direction = (cos(-1.2657), sin(-1.2657)));
  liaison C: point_courbe(block, slot) with coulomb(0.24), rolling_resistance(3.24 m);
  liaison P: rotoide(f1, disc);
initial
  disc.angle = 1.64; disc.angular_velocity = 0.0301 rad/s;
  C.slip = 1.447 m/s;
  block.angular_velocity = -0.0131 rad/s;
  guess(block.position.y = 9.5 m);
  experiment(stop = 8 s);
end Jam;
"""


@pytest.mark.parametrize("light", [4.3e-6, 4.3e-8, 4.3e-10])
def test_jamming_of_a_light_body_is_located(light: float) -> None:
    """The reaction grows without bound at one instant: a pole that long steps jumped over.

    The disc weighs nothing beside the block, so that the instant is the same for all of them. Steps
    shrink geometrically towards it: some tens suffice, as rounding of the reaction shortens none.
    """
    model = frot.compile(JAM)
    for tolerance in (1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10):
        with pytest.raises(frot.FrotError) as told:
            model.simulate(tolerance=tolerance, parameters={"light": light})
        assert told.value.diagnostics[0].code == "E0901"
        assert abs(told.value.result.time[-1] - 2.84387) < 1e-5
        assert told.value.result.figures.steps < 120


def test_rounding_of_another_mode_hides_no_event(finding: Finding) -> None:
    """The couple that holds a rim passes its bound at the same instant at every tolerance."""
    model = finding("rim_held")
    for tolerance in (1e-8, 1e-10, 1e-11, 3e-12, 1e-13):
        events = model.simulate(tolerance=tolerance).events
        held = [e.time for e in events if e.liaison == "C10" and "held -> rolling" in e.text]
        assert len(held) == 1 and abs(held[0] - 0.0817804) < 1e-6
