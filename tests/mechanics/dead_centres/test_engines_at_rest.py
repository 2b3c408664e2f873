"""Engines that start from rest with a piston exactly in its dead centre, every joint dry.

There no speed moves the slide: its friction is free, between its bounds, and loads the pins. Rest
lasts as long as any share of the load holds: until that with the slides at their bounds has no
more, which is where an engine a billionth of a radian beside it starts.
"""

from __future__ import annotations

import math

import pytest

import frot

pytestmark = pytest.mark.finding

CRANK, ROD, RATE = 0.04, 0.13, 80.0


def engine(phases: list[float], start: float, opposed: bool = False) -> str:
    """Cylinders in one line, with cranks at these angles; `start` turns them all."""
    lines, guesses = [], []
    for i, phase in enumerate(phases):
        place = f"({CRANK * math.cos(phase)!r}, {CRANK * math.sin(phase)!r}) m"
        lines.append(f"  frame p{i} on crank at {place};")
        lines.append(f"  body r{i}: rod(mass = 0.5 kg, length = {ROD} m);")
        lines.append(f"  liaison P{i}: rotoide(p{i}, r{i}.start) with coulomb(mu, radius = 18 mm);")
        lines.append(f"  liaison S{i}: point_courbe(r{i}.tip, bore) with coulomb(mu);")
        turned = phase + start
        side = -1 if opposed and i % 2 else 1
        reach = math.sqrt(ROD**2 - (CRANK * math.sin(turned)) ** 2)
        x = CRANK * math.cos(turned) + side * reach
        guesses.append(f"  guess(r{i}.tip.position = ({x!r}, 0) m);")
    return "\n".join(
        [
            "planar model Engine",
            "  world(gravity = 9.81 m/s^2, down = -y);",
            "  parameter Real mu = 0.08;",
            "  body crank: disc(mass = 5 kg, radius = 0.06 m);",
            "  curve bore on ground: line(through = (0, 0) m, direction = (1, 0));",
            "  liaison A: rotoide(ground, crank.G) with coulomb(mu, radius = 20 mm);",
            *lines,
            f"  force motor: couple(A, value = {RATE} N.m/s*time);",
            "initial",
            f"  crank.angle = {start!r} rad; crank.angular_velocity = 0 rad/s;",
            *guesses,
            "  experiment(stop = 0.03 s, tolerance = 1e-8);",
            "end Engine;",
        ]
    )


@pytest.mark.parametrize(
    ("phases", "opposed"),
    [
        ([0.0, math.pi], False),
        ([0.0, math.pi], True),
        ([0.0, 2 * math.pi / 3, 4 * math.pi / 3], False),
        ([0.0, math.pi / 2, math.pi, 3 * math.pi / 2], False),
    ],
    ids=["two in line", "two opposed", "three in line", "four in line"],
)
def test_an_engine_starts_from_its_dead_centre(phases: list[float], opposed: bool) -> None:
    beside = frot.compile(engine(phases, 1e-9, opposed)).simulate(tolerance=1e-10)
    starts = min(e.time for e in beside.events if e.liaison == "A")
    model = frot.compile(engine(phases, 0.0, opposed))
    for tolerance in (1e-3, 1e-6, 1e-9, 1e-12):
        run = model.simulate(tolerance=tolerance)
        begun = {e.liaison: e for e in run.events}
        assert {e.before for e in begun.values()} == {"stick"}
        assert run.at(0.9 * starts)["crank.angular_velocity"] == 0
        # which of the slides' frictions load the pins more is not looked for: 3e-5 of the couple
        assert begun["A"].time == pytest.approx(starts, rel=5e-5)
        assert run["crank.angle"][-1] == pytest.approx(beside["crank.angle"][-1], rel=3e-4)
        assert run.balance.relative < 1e-9
