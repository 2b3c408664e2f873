"""What moves by rounding alone: an engine that stands in its dead centre, gaps that are zero, rows
that come to say the same while boxes slide off each other."""

from __future__ import annotations

import functools
import math

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding

TOLERANCES = [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13]


@functools.cache
def engine(one_pin: bool) -> frot.Model:
    """A crank with two rods whose ends slide on one dry line; on one pin, or on opposite ones."""
    crank = "rod(mass = 0.6 kg, length = r)" if one_pin else "rod(mass = 0.6 kg, length = 2*r)"
    return frot.compile(f"""
planar model Engine
  parameter Length r = 80 mm;
  parameter Mass high_mass = 0.9 kg;
  parameter Real mu = 0.1;
  parameter Angle start = 0 rad;
  parameter Angle along = 90 deg;
  world(down = -y);
  body crank: {crank};
  body up: rod(mass = 1.1 kg, length = 240 mm);
  body down: rod(mass = 1.1 kg, length = 240 mm);
  body high: particle(mass = high_mass);
  body low: particle(mass = 0.9 kg);
  curve rail on ground: line(through = (0, 0) m, direction = (cos(along), sin(along)));
  liaison O: rotoide(ground, crank.{"start" if one_pin else "G"});
  liaison A: rotoide(crank.tip, up.start);
  liaison D: rotoide(crank.{"tip" if one_pin else "start"}, down.start);
  liaison B: rotoide(up.tip, high);
  liaison E: rotoide(down.tip, low);
  liaison C: point_courbe(high, rail) with coulomb(mu);
  liaison F: point_courbe(low, rail) with coulomb(mu);
initial
  O.angle = start;
  O.speed = 0 rad/s;
  guess(high.position = (0.2 m*cos(along), 0.2 m*sin(along)),
        low.position = (-0.2 m*cos(along), -0.2 m*sin(along)));
  experiment(stop = 3 s);
end Engine;""")


def mechanical_energy(at: frot.Instant) -> float:
    bodies = {"crank": 0.6, "up": 1.1, "down": 1.1, "high": 0.9, "low": 0.9}
    return sum(
        at[f"{name}.kinetic_energy"] + mass * 9.81 * at[f"{name}.position.y"]
        for name, mass in bodies.items()
    )


@pytest.mark.parametrize("one_pin", [True, False])
@pytest.mark.parametrize("start", [math.pi / 2, -math.pi / 2])
def test_an_engine_stands_in_its_dead_centre(one_pin: bool, start: float) -> None:
    """All loads vanish but for the rounding of pi/2: what moves is rounding, and grows from there
    as that of any pendulum that stands on its head. Energy is only lost."""
    for mu in (0.001, 0.4):
        for tolerance in TOLERANCES:
            result = engine(one_pin).simulate(
                parameters={"start": start, "mu": mu}, tolerance=tolerance
            )
            assert result.time[-1] == 3
            assert abs(result.at(0.2)["O.speed"]) < 1e-12
            first = mechanical_energy(result.at(0.0))
            told = [mechanical_energy(result.at(float(t))) for t in np.linspace(0, 3, 31)]
            assert max(told) <= first + 200 * max(tolerance, 1e-12)


def test_a_gap_of_zero_by_lengths_alone() -> None:
    """The body is at (0, 0) and its corner 0.25 m below: the gap 0.25 m - 0.25 m has the rounding
    of these, which no coordinate tells. As the pull grows from zero the drawer turns about its
    other corner, l[2], and the far corners meet the rail above."""
    model = frot.compile("""
planar model Drawer
  parameter Real mu = 0.1;
  parameter Length off = 0.1 m;
  world(gravity = 0 m/s^2);
  body b: box(mass = 2 kg, size = (1 m, 0.5 m));
  curve low on ground: line(through = (0, -0.25) m, direction = (1, 0));
  curve high on ground: line(through = (0 m, 0.251 m), direction = (-1, 0));
  liaison l: appui_faces(b.bottom, low) with coulomb(mu);
  liaison h: appui_faces(b.top, high) with coulomb(mu);
  frame knob on b at (0.1 m, off);
  force p: on(knob, value = (20 N*sin(6*time/(1 s)), 0 N));
initial
  b.position = (0, 0) m; b.angle = 0; b.velocity = (0, 0) m/s; b.angular_velocity = 0 rad/s;
  experiment(stop = 1 s);
end Drawer;""")
    for off in (0.1, -0.3):
        ends = []
        for tolerance in TOLERANCES:
            result = model.simulate(parameters={"off": off}, tolerance=tolerance)
            ends.append(next(e.time for e in result.events if e.kind == "impact"))
        assert max(ends) - min(ends) <= 1e-3 * ends[-1]
        assert abs(ends[3] - ends[-1]) <= 1e-8 * ends[-1]


def test_level_boxes_slide_off_each_other() -> None:
    """The last corners of two level boxes meet as one slides off the other, falling with it: there
    both contacts are one row, and the stages of a step lie off it by its error."""
    lines = ["planar model Boxes"]
    below = "ground.line"
    for i in range(3):
        pushed = "-3 N" if i == 1 else "0 N"
        lines += [
            f"  body b{i}: box(mass = 1 kg, size = (1 m, 0.5 m));",
            f"  liaison c{i}: appui_faces(b{i}.bottom, {below}) with coulomb(0.05);",
            f"  force f{i}: on(b{i}, value = ({pushed}, 0 N));",
        ]
        below = f"b{i}.top"
    lines += ["initial"]
    for i in range(3):
        speed = 1.5 if i == 0 else 0.0
        lines += [
            f"  b{i}.position = ({-0.3 * i}, {0.25 + 0.5 * i}) m; b{i}.angle = 0;",
            f"  b{i}.velocity = ({speed}, 0) m/s; b{i}.angular_velocity = 0 rad/s;",
        ]
    model = frot.compile("\n".join([*lines, "  experiment(stop = 1.5 s);", "end Boxes;"]))
    for tolerance in [*TOLERANCES, 1e-4, 1e-6]:
        result = model.simulate(tolerance=tolerance)
        last = [e for e in result.events if e.kind == "separation"][-1]
        assert last.time == pytest.approx(0.88624821, rel=max(tolerance, 1e-8) * 10)
