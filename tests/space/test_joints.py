"""Every liaison that coordinates keep, in space: Newton-Euler, relations, exchanged places, energy.

Two boxes hang one on the other from the ground, with frames turned every which way. The residuals
are formed from the result by `newton_euler.py`, which knows nothing of the compiler.
"""

import numpy as np
import pytest

import frot
from tests.space.newton_euler import Link, Place, axes, box, orientation, place_of, residual, vector

OPTIONS = {
    "encastrement": "",
    "rotoide": ", axis = (0.2, 1, 0.3)",
    "prismatique": ", axis = (1, 0.3, -0.5)",
    "verrou": ", axis = (0.5, 1, 0.1)",
    "helicoidale": ", axis = (0.1, 1, 0.2), pitch = 300 mm",
    "cardan": ", axis_a = y, axis_b = x",
    "spherique": "",
    "appui_plan": ", normal = (0.3, 0.1, 1)",
}
BODIES = (box("p1", 2, (0.3, 0.5, 0.7)), box("p2", 1, (0.4, 0.2, 0.3)))
F0, G1, H1, G2 = (
    Place(None, (0.1, 0.2, 0.3)),
    Place("p1", (0.15, 0.1, 0.35)),
    Place("p1", (-0.15, 0.1, -0.35)),
    Place("p2", (0.2, 0.1, 0.1)),
)
LINKS = (Link("A", F0, G1), Link("B", H1, G2))


def text(kind: str, back: bool, read: str) -> str:
    """The two boxes; `back` exchanges the places of both liaisons."""
    options = OPTIONS[kind]
    if back and kind == "cardan":
        options = ", axis_a = x, axis_b = y"
    first, second = ("g1, f0", "g2, h1") if back else ("f0, g1", "h1, g2")
    return f"""
model TwoBoxes "Two boxes in a {kind} each"
  body p1: box(mass = 2 kg, size = (0.3, 0.5, 0.7) m);
  body p2: box(mass = 1 kg, size = (0.4, 0.2, 0.3) m);
  frame f0 on ground at (0.1, 0.2, 0.3) m rotated(axis = (1, 2, 3), angle = 20 deg);
  frame g1 on p1 at (0.15, 0.1, 0.35) m rotated(axis = (1, 0, 1), angle = -30 deg);
  frame h1 on p1 at (-0.15, 0.1, -0.35) m rotated(axis = x, angle = 10 deg);
  frame g2 on p2 at (0.2, 0.1, 0.1) m rotated(axis = z, angle = 40 deg);
  liaison A: {kind}({first}{options});
  liaison B: {kind}({second}{options});
  {read}
  experiment(stop = 1.5 s, tolerance = 1e-11);
end TwoBoxes;
"""


READ = "output Real a = A.force.x/(1 N); output Real b = B.torque.z/(1 N.m);"
TIMES = (0.0, 0.31, 0.77, 1.5)


@pytest.mark.parametrize("kind", OPTIONS)
def test_reactions_and_motion_obey_newton_and_euler(kind: str) -> None:
    result = frot.compile(text(kind, False, READ)).simulate()
    assert residual(result, BODIES, LINKS, TIMES) < 1e-11
    energy = result["energy.kinetic"] + result["energy.potential"]
    assert np.ptp(energy) < 1e-9 * max(1, np.abs(result["energy.kinetic"]).max())
    if kind != "encastrement":
        assert np.ptp(result["p2.position.z"]) > 0.05  # it does move


@pytest.mark.parametrize("kind", OPTIONS)
def test_what_a_liaison_locks_does_no_work(kind: str) -> None:
    """The reaction's power on the motion of b relative to a is zero."""
    result = frot.compile(text(kind, False, READ)).simulate()
    for t in TIMES:
        at = result.at(t)
        for link in LINKS:
            there = place_of(at, link.b)
            power = 0.0
            for sign, own in ((1, link.b), (-1, link.a)):
                if own.body is None:
                    continue
                omega = vector(at, f"{own.body}.angular_velocity")
                swept = np.cross(omega, there - vector(at, f"{own.body}.position"))
                velocity = vector(at, f"{own.body}.velocity") + swept
                power += sign * velocity @ vector(at, f"{link.name}.force")
                power += sign * omega @ vector(at, f"{link.name}.torque")
            assert abs(power) < 1e-9


@pytest.mark.parametrize("kind", OPTIONS)
def test_exchanged_places_change_signs_only(kind: str) -> None:
    there, back = (frot.compile(text(kind, side, READ)).simulate() for side in (False, True))
    for t in TIMES:
        one, other = there.at(t), back.at(t)
        for name in ("position", "velocity", "angular_velocity"):
            assert vector(one, f"p2.{name}") == pytest.approx(
                vector(other, f"p2.{name}"), rel=1e-10, abs=1e-10
            )
        turns = (axes(orientation(at, "p2")) for at in (one, other))
        assert next(turns) == pytest.approx(next(turns), abs=1e-10)
        assert one["a"] == pytest.approx(-other["a"], rel=1e-8, abs=1e-8)


@pytest.mark.parametrize("kind", OPTIONS)
def test_a_reaction_that_nobody_reads_changes_nothing(kind: str) -> None:
    read, silent = (frot.compile(text(kind, False, x)).simulate() for x in (READ, ""))
    assert "A.force.x" in read
    assert "A.force.x" not in silent
    for name in ("p2.position.x", "p1.velocity.z"):
        assert read[name][-1] == pytest.approx(silent[name][-1], rel=1e-10, abs=1e-11)
