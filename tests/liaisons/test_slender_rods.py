"""Slender rods have no inertia about themselves: five freedoms, or a liaison that is told."""

from __future__ import annotations

import pytest

import frot

ROD = """
model Rod "A slender rod in a liaison"
  body t: rod(mass = 1 kg, length = 1 m);
  body b: box(mass = 1 kg, size = (0.1, 0.2, 0.3) m);
  frame g on ground rotated(axis = (1, 2, 3), angle = 0.3);
  frame f on t at (0.5, 0, 0) m rotated(axis = y, angle = 90 deg);
  liaison j: {};
  {}
  experiment(stop = 0.1 s);
end Rod;
"""


@pytest.mark.parametrize(
    "liaison",
    [
        "rotoide(ground, t, axis = x)",
        "rotoide(g, t, axis = x)",
        "verrou(g, f, axis = z)",
        "cardan(ground, t, axis_a = y, axis_b = x)",
    ],
)
def test_a_turn_without_inertia_is_told_with_its_liaison(liaison: str) -> None:
    """However rounding leaves something of it."""
    with pytest.raises(frot.FrotError, match=r"liaison 'j' leaves the slender rod 't' a turn") as r:
        frot.compile(ROD.format(liaison, "")).simulate()
    assert "inertia = (" in str(r.value)


@pytest.mark.parametrize(
    ("liaison", "more", "freedoms"),
    [
        ("rotoide(g, t, axis = y)", "", 7),
        ("rotoide(g, t, axis = x)", "liaison k: encastrement(t.tip, b);", 1),
        ("libre(ground, t)", "", 11),
        ("helicoidale(g, t, axis = x, pitch = 1 cm)", "", 7),
    ],
)
def test_what_has_inertia_moves(liaison: str, more: str, freedoms: int) -> None:
    model = frot.compile(ROD.format(liaison, more))
    assert model.report().mobility.degrees_of_freedom == freedoms
    result = model.simulate()
    energy = result["energy.kinetic"] + result["energy.potential"]
    assert abs(energy[-1] - energy[0]) < 1e-9
