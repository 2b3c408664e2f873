"""Threads of the plane: taut they are rods without mass, slack they do nothing."""

import numpy as np
import pytest

import frot


def test_threads_are_circles_that_turn_with_nobody() -> None:
    """The worked example says it with circles about the ends."""
    circles = frot.load("models/slack_threads.frot").simulate()
    with open("models/slack_threads.frot", encoding="utf-8") as file:
        text = file.read()
    text = text.replace("contact_ponctuel(reach, upper)", "fil(ground, upper, l1)")
    text = text.replace("contact_ponctuel(further, lower)", "tige(lower, upper, l2, true)")
    threads = frot.compile(text).simulate()
    for name in ("upper.position.x", "lower.position.y", "tension2"):
        assert np.abs(threads[name] - circles[name]).max() < 1e-12
    assert threads.events[0].time == pytest.approx(circles.events[0].time, rel=1e-13)
    # the reaction on b, the upper point, draws it down
    assert threads["second.force.y"][0] == pytest.approx(-threads["tension2"][0], rel=1e-12)
    assert threads["second.gap"] == pytest.approx(0.7 - threads["second.length"], abs=1e-12)


BODIES = """
planar model Pulled "Two turning rods, the end of one on a thread from the end of the other"
  body a: rod(mass = 1 kg, length = 1 m);
  body b: rod(mass = 2 kg, length = 0.6 m);
  liaison pin: rotoide(ground, a.start);
  liaison link: {kind}(a.tip, b.start, length = 0.4 m);
  output Force pull = link.force.y;
initial
  pin.angle = -90 deg;
  pin.speed = 3 rad/s;
  b.start.position = (0, -1.4) m;
  b.angle = -60 deg;
  b.start.velocity = (5, 0) m/s;
  experiment(stop = 0.5 s, tolerance = 1e-11);
end Pulled;
"""


def test_between_turning_bodies_a_taut_thread_is_a_rod() -> None:
    rod = frot.compile(BODIES.format(kind="tige")).simulate()
    thread = frot.compile(BODIES.format(kind="fil")).simulate()
    assert not thread.events
    for name in ("a.angle", "b.angle", "b.position.x", "pull"):
        assert np.abs(rod[name] - thread[name]).max() < 1e-9


FREE = """
planar model Free
  parameter Length start = 0 m;
  world(gravity = 0 m/s^2);
  body a: particle(mass = 1 kg);
  body b: particle(mass = 3 kg);
  liaison line: fil(a, b, length = {length});
initial
  a.velocity = (-1, 0) m/s;
  b.position.y = start;
  b.velocity = (2, 0) m/s;
  experiment(stop = 1 s);
end Free;
"""


@pytest.mark.parametrize(("start", "way"), [(0.0, 0.6), (0.3, np.sqrt(0.27))])
def test_it_may_begin_with_both_ends_at_one_place(start: float, way: float) -> None:
    model = frot.compile(FREE.format(length="0.6 m"))
    met = model.simulate(parameters={"start": start}).events[0]
    assert met.kind == "impact"  # it becomes tight with speed
    assert met.time == pytest.approx(way / 3, rel=1e-10)


def test_its_length_may_follow_time() -> None:
    """A load on a winch: it hangs at -l, with the tension m (g - l'')."""
    text = """
planar model Winch
  body load: particle(mass = 2 kg);
  liaison rope: fil(ground, load, length = 1 m + 0.1 m*sin(3*time/(1 s)));
  output Force pull = rope.normal_force;
initial
  load.position = (0, -1) m;
  load.velocity = (0, -0.3) m/s;
  experiment(stop = 2 s, tolerance = 1e-11);
end Winch;
"""
    result = frot.compile(text).simulate()
    wave = 0.1 * np.sin(3 * result.time)
    assert np.abs(result["load.position.y"] + 1 + wave).max() < 1e-11
    assert np.abs(result["pull"] - 2 * (9.81 + 9 * wave)).max() < 1e-9
    moved = text.replace("sin(3*time/(1 s))", "load.position.x/(1 m)")
    with pytest.raises(frot.FrotError, match="follows other than time"):
        frot.compile(moved).simulate()


def test_what_begins_too_far_away_is_drawn_nearer() -> None:
    """Least change in the metric of the masses: 3/4 of the way by the lighter body."""
    result = frot.compile(FREE.format(length="0.6 m").replace("y = start", "y = 1 m")).simulate(
        stop=1e-6
    )
    assert result["line.length"][0] == pytest.approx(0.6, rel=1e-12)
