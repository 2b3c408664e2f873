"""Slender rods have no inertia about themselves: five freedoms, or a liaison that is told."""

from __future__ import annotations

import numpy as np
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


def test_rods_in_one_line_that_are_welded_are_told() -> None:
    """Neither has an inertia about that line, and nothing holds them."""
    text = """
model Twice
  body a: rod(mass = 0.1339 kg, length = 0.745 m);
  body b: rod(mass = 0.1339 kg, length = 0.745 m);
  liaison weld: encastrement(a, b);
  frame f on a at (0.1706, 0.0268, -0.1540) m;
  force s: spring((0, 0, 0) m, f, k = 3 N/m, length = 0.3 m);
  experiment(stop = 1 s);
end Twice;
"""
    with pytest.raises(frot.FrotError) as told:
        frot.compile(text).simulate()
    assert "singular" in str(told.value)


LOOP = """
{planar}model Loop "A rod on a pin, a lamina on a link and on a curve of the rod"
  world(gravity = 3 m/s^2, down = -y);
  body a: rod(mass = 1 kg, length = 0.5 m);
  body b: ellipse(mass = 9 kg, a = 0.3 m, b = 0.2 m);
  {flat}
  frame f on a at ({at_f});
  frame g on a at ({at_g});
  frame h on b at ({at_h});
  frame k on b at ({at_k});
  curve c on a: parametric((0.471 m*u, 0.3 m*u^2 - 0.2 m*sin(u){along}), u = (-9, 9));
  liaison J: rotoide(ground, f);
  liaison K: tige(g, h, length = 0.86 m);
  liaison L: point_courbe(k, c);
  output Force j = J.force, k_ = K.force, l = L.force;
initial
  J.angle = -2.4;
  J.speed = 1 rad/s;
  {begin}
  b.angular_velocity{about} = 0.5 rad/s;
  experiment(stop = 0.8 s, tolerance = 1e-11);
end Loop;
"""


def test_the_spin_of_a_rod_makes_no_reaction_hard_to_read() -> None:
    """What is read of the pin has an auxiliary speed along the rod, which moves no mass."""
    places = ("0.16 m, 0.07 m", "0.34 m, -0.30 m", "-0.29 m, 0.04 m", "0.16 m, -0.07 m")
    names = ("at_f", "at_g", "at_h", "at_k")
    runs: list[frot.Result] = []
    for zero in ("", ", 0 m"):
        begin = "guess(b.position = (0.5, -0.5) m, b.angle = -0.8);"
        if runs:
            x, y, angle = (runs[0][f"b.{n}"][0] for n in ("position.x", "position.y", "angle"))
            begin = f"guess(b.position = ({x!r}, {y!r}, 0) m); guess(b.ex.x = {np.cos(angle)!r}, "
            begin += f"b.ex.y = {np.sin(angle)!r});"
        flat = "liaison A: appui_plan(ground, a); liaison B: appui_plan(ground, b);" if zero else ""
        text = LOOP.format(
            planar="" if zero else "planar ",
            flat=flat,
            along=zero,
            about=".z" if zero else "",
            begin=begin.replace("np.float64", ""),
            **{name: place + zero for name, place in zip(names, places, strict=True)},
        )
        runs.append(frot.compile(text).simulate())
    plane, space = runs
    assert space.figures.steps < 1.2 * plane.figures.steps + 5
    for name in "jkl":
        for e in "xy":
            read = f"{name}_.{e}" if name == "k" else f"{name}.{e}"
            assert space[read] == pytest.approx(plane[read], abs=1e-8)
    assert space["b.position.x"] == pytest.approx(plane["b.position.x"], abs=1e-10)
