"""Bodies of which enough points are placed stand there, wherever that is."""

from __future__ import annotations

from math import atan2, cos, hypot, pi, remainder, sin

import numpy as np
import pytest

import frot

BAR = """
planar model Bar
  parameter Real p = 0;
  parameter Real s = 1;
  parameter Length l = 2 m;
  parameter Mass m = 2 kg;
  parameter Length u = 1 m;
  parameter Length w = 1 m;
  world(gravity = 0 m/s^2);
  body b: rod(mass = m, length = l);
  frame turned on ground rotated(angle = p);
  curve ox on turned: line(through = (0, 0) m, direction = (1, 0));
  curve oy on turned: line(through = (0, 0) m, direction = (0, 1));
  liaison A: point_courbe(b.start, ox);
  liaison B: point_courbe(b.tip, oy);
initial
  b.start.position = (u*cos(p), u*sin(p));
  b.tip.position = (-w*sin(p), w*cos(p));
  b.angular_velocity = s*1 rad/s;
  experiment(stop = 1 ms);
end Bar;
"""


@pytest.fixture(scope="module")
def bar() -> frot.Model:
    return frot.compile(BAR)


@pytest.mark.parametrize("turned", [0.0, 0.7, -2.0])
@pytest.mark.parametrize("length", [2.0, 2e-4, 2e4])
@pytest.mark.parametrize("angle", [1e-3, 0.05, 0.1, 0.2, 0.3, 1.0, 2.0, 3.0, -0.1, -1.4, -3.1])
def test_a_bar_on_two_lines(bar, angle, length, turned):
    """Both of its ends are placed, each on its line: it stands at pi - angle to the first line."""
    for mass, spin in ((2.0, -1.0), (2e6, 1.0)):
        values = {"p": turned, "s": spin, "l": length, "m": mass}
        ends = {"u": length * cos(angle), "w": length * sin(angle)}
        run = bar.simulate(parameters=values | ends)
        missed = remainder(run["b.angle"][0] - (turned + pi - angle), 2 * pi)
        assert abs(missed) < 1e-10
        assert run["b.angular_velocity"][0] == pytest.approx(spin, rel=1e-9)


def test_a_chain_of_which_every_joint_is_placed():
    """Each link points from joint to joint."""
    links = range(1, 5)
    lines = ["planar model Chain"]
    lines += [f"  parameter Length x{i} = 0 m; parameter Length y{i} = 0 m;" for i in range(5)]
    for i in links:
        lines.append(f"  parameter Length l{i} = 1 m; body b{i}: rod(mass = 1 kg, length = l{i});")
    lines += [f"  liaison j{i}: rotoide(b{i - 1}.tip, b{i}.start);" for i in links if i > 1]
    lines += ["initial", "  b1.start.position = (x0, y0);"]
    lines += [f"  b{i}.tip.position = (x{i}, y{i});" for i in links]
    model = frot.compile("\n".join([*lines, "  experiment(stop = 1e-9 s);", "end Chain;"]))
    random = np.random.default_rng(7)
    for _ in range(40):
        joints = random.uniform(-3, 3, (5, 2))
        ways = np.diff(joints, axis=0)
        values = {f"{c}{i}": joints[i, k] for i in range(5) for k, c in enumerate("xy")}
        values |= {f"l{i}": hypot(*ways[i - 1]) for i in links}
        run = model.simulate(parameters=values)
        for i in links:
            angle = atan2(ways[i - 1][1], ways[i - 1][0])
            assert abs(remainder(run[f"b{i}.angle"][0] - angle, 2 * pi)) < 1e-7
