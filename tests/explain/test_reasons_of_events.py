"""Every kind of event has a reason, whose numbers are those of the mechanics."""

from __future__ import annotations

import json
import math
import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from frot.runtime.event_reasons import REASONS
from frot.runtime.run_report import KINDS

import frot
from frot.explained_events import ExplainedEvent

MODELS = Path(__file__).parents[2] / "models"

# A block on the ground: pushed, thrown, carried away, struck; `push` grows with the time.
BLOCK = """
planar model Block
  parameter Mass m = 2 kg;
  parameter Real mu = 0.3;
  parameter Real mu_s = 0.4;
  parameter Velocity v0 = 0 m/s;
  parameter Force push = 10 N "after one second";
  parameter Force lift = 0 N "after one second";
  parameter Force back = 0 N "the constant push against the speed v0";
  parameter Angle slope = 0 rad;
  body b: particle(mass = m);
  curve way on ground: line(through = (0, 0) m, direction = (cos(slope), sin(slope)));
  liaison floor: contact_ponctuel(way, b) with coulomb(mu, mu_s = mu_s);
  force pull: on(b, value = (
    (push*time/(1 s) - back)*cos(slope) - lift*time/(1 s)*sin(slope),
    (push*time/(1 s) - back)*sin(slope) + lift*time/(1 s)*cos(slope)));
  force weight: on(b, value = m*9.81 m/s^2*(sin(slope), 1 - cos(slope)));
initial
  b.position = (0, 0) m;
  b.velocity = (v0*cos(slope), v0*sin(slope));
  experiment(stop = 2 s, tolerance = 1e-9);
end Block;
"""
# A bead that falls, is struck and warns; a text that ends.
STRUCK = """
planar model Struck
  parameter Mass m = 1 kg;
  body b: particle(mass = m);
  liaison floor: contact_ponctuel(ground.line, b) with coulomb(0.5), restitution(0.5);
  force hit: impulse(b, value = (6, 1) N.s, at = 1.5 s);
equation
  assert(b.position.x < 1 m, "far", level = warning);
  when b.position.x > 1.5 m then
    terminate("far enough");
  end when;
initial
  b.position = (0, 0.1) m;
  b.velocity = (0, 0) m/s;
  experiment(stop = 5 s);
end Struck;
"""
# The circle pushes first on one side of the bead, then on the other.
CIRCLE = """
planar model Circle
  parameter Mass m = 1 kg;
  body b: particle(mass = m);
  curve ring on ground: circle(centre = (0, 0) m, radius = 1 m);
  liaison guide: point_courbe(b, ring) with coulomb(0.05);
initial
  b.position = (0, 1) m;
  b.velocity = (0.5, 0) m/s;
  experiment(stop = 1.5 s);
end Circle;
"""
ROLLING = """
planar model Roller
  parameter Torque amplitude = 0.5 N.m;
  parameter AngularVelocity spin = 0 rad/s;
  body disc: disc(mass = 1 kg, radius = 0.1 m);
  liaison floor: contact_ponctuel(ground.line, disc.rim) with
    coulomb(0.5), rolling_resistance(10 mm, delta_s = 20 mm);
  force motor: couple(disc, value = amplitude*time/(1 s)*(if time < 1 s then 1 else -1));
initial
  disc.position = (0, 0.1) m;
  disc.velocity = (-spin*0.1 m, 0 m/s);
  disc.angular_velocity = spin;
  experiment(stop = 3 s);
end Roller;
"""


@cache
def model(text: str) -> frot.Model:
    return frot.compile(text)


def run(text: str, **parameters: object) -> frot.Result:
    try:
        return model(text).simulate(parameters=parameters)
    except frot.SimulationError as error:
        assert error.result is not None
        return error.result


@cache
def load(name: str) -> frot.Model:
    return frot.load(MODELS / f"{name}.frot")


def text_of(name: str, *changes: tuple[str, str]) -> str:
    text = (MODELS / f"{name}.frot").read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    return text


@cache
def all_kinds() -> dict[str, ExplainedEvent]:
    """The first event of each kind in some runs."""
    rest = ("stop, on_impasse = stop", "rest")
    runs = [
        run(BLOCK, push=0, v0=1, back=20),
        run(BLOCK, push=0, v0=1, back=5),
        run(BLOCK, push=10, lift=15),
        run(STRUCK),
        run(CIRCLE),
        run(ROLLING, amplitude=0, spin=2),
        run(ROLLING),
        run(text_of("bouncing_ball")),
        run(text_of("points_on_two_lines", rest), mu=3),
        run(text_of("rod_on_rough_ground", rest), mu=2, slip=-1),
    ]
    return {e.kind: e for result in reversed(runs) for e in reversed(result.explain())}


# A number of each reason, and what it says.
NUMBERLESS = (
    "separation",
    "contact",
    "reaction",
    "condition",
    "warning",
    "terminate",
    "percussion",
)


@pytest.mark.parametrize("kind", KINDS)
def test_each_kind_of_event_has_a_reason_with_its_numbers(kind: str) -> None:
    event = all_kinds()[kind]
    assert event.kind == kind and kind in REASONS
    assert event.reason and not re.search(r"\bnan\b|\binf\b|None", event.reason), event.reason
    if kind not in NUMBERLESS:
        assert re.search(r"\d", event.reason), event.reason


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("slope", [0, 0.3, -1.2])
@pytest.mark.parametrize("mass", [2, 2e6, 2e-6])
def test_a_push_that_grows_reaches_what_holds(sign: int, slope: float, mass: float) -> None:
    """It begins to slip where the push is mu_s m g; mu m g is left in motion."""
    weight = mass * 9.81
    push = sign * weight
    result = run(BLOCK, m=mass, push=push, slope=slope)
    (event,) = result.explain()
    assert event.time == pytest.approx(0.4, rel=1e-9)
    assert event.direction == (sign,) and event.motion == "slip"
    held, moved = f"{0.4 * weight:.6g} N", f"{0.3 * weight:.6g} N"
    assert event.reason == (
        f"the friction needed, {held}, reaches mu_s N = {held}; in motion it is mu N = {moved}"
    )


@pytest.mark.parametrize("sign", [1, -1])
def test_a_slip_ends_and_a_smaller_push_is_held(sign: int) -> None:
    """Thrown against a push of 5 N, which mu_s m g = 7.848 N holds."""
    (event,) = run(BLOCK, push=0, v0=sign, back=5 * sign, slope=0.2).explain()
    assert event.direction == (sign,)
    assert event.reason == (
        "the slip reaches zero; the friction needed then, 5 N, is within mu_s N = 7.848 N"
    )


@pytest.mark.parametrize("sign", [1, -1])
def test_a_larger_push_turns_it_round(sign: int) -> None:
    (event,) = run(BLOCK, push=0, v0=sign, back=20 * sign, slope=-0.2).explain()
    assert (event.kind, event.direction) == ("reversal", (-sign,))
    assert "more than mu_s N = 7.848 N is needed" in event.reason


def test_a_pull_along_the_normal_takes_the_reaction_away() -> None:
    """It slips until lift t = m g, at t = 1.308 s."""
    (event,) = (e for e in run(BLOCK, lift=15).explain() if e.kind == "separation")
    assert event.time == pytest.approx(1.308, rel=1e-9)
    assert (event.direction, event.reason) == ((1,), "the normal reaction reaches zero")


@pytest.mark.parametrize("mass", [1, 1e6])
def test_an_impact_has_the_speeds_of_the_gap(mass: float) -> None:
    """Fallen by 0.1 m, with half of the speed back."""
    event = run(STRUCK, m=mass).explain()[0]
    speed = math.sqrt(2 * 9.81 * 0.1)
    assert event.reason == (
        f"the gap closes at {speed:.6g} m/s: impact; it opens at {speed / 2:.6g} m/s"
    )


def test_the_impulse_of_a_percussion_opens_the_gap() -> None:
    found = run(STRUCK).explain()
    (event,) = (e for e in found if e.kind == "separation" and e.time > 1)
    assert event.reason == "after the impact the gap opens at 1 m/s"


SLIDE = """
model Slide
  parameter Velocity vx = 0 m/s;
  parameter Velocity vy = 0 m/s;
  parameter Force fx = 0 N;
  parameter Force fy = 0 N;
  parameter Mass m = 1 kg;
  body b: particle(mass = m);
  surface floor on ground: plane(through = (0, 0, 0) m, normal = (0, 0, 1));
  liaison on: contact_ponctuel(floor, b) with coulomb(0.5);
  force pull: on(b, value = (fx, fy, 0 N)*(time/(1 s)));
initial
  b.position = (0, 0, 0) m;
  b.velocity = (vx, vy, 0 m/s);
  experiment(stop = 3 s);
end Slide;
"""


@pytest.mark.parametrize("turned", [1, -1])
@pytest.mark.parametrize(("x", "y"), [(3, 4), (-3, 4), (0, -5)])
def test_in_space_the_direction_is_that_of_the_slip_in_ground_axes(
    turned: int, x: float, y: float
) -> None:
    """Of the second place on the first, as `slip`: of a throw, and of a departure under a pull."""
    text = SLIDE if turned == 1 else SLIDE.replace("floor, b", "b, floor")
    way = turned * np.array([x, y, 0]) / 5
    (event,) = run(text, vx=x, vy=y).explain()
    assert event.direction == pytest.approx(way, abs=1e-6)
    words = "the slip reaches zero; the friction needed then, 0 N, is within mu N = 4.905 N"
    assert event.reason == words
    (event,) = run(text, fx=x, fy=y).explain()
    assert event.time == pytest.approx(0.981, rel=1e-9)
    assert event.direction == pytest.approx(way, abs=1e-9)
    assert event.reason == "the friction needed, 4.905 N, reaches mu N = 4.905 N"


def test_of_several_axes_each_event_has_its_own() -> None:
    """A universal joint: the direction is that of the relative turning about that axis."""
    result = run(text_of("dry_gimbal"))
    first, second = result.explain()
    assert (first.motion, second.motion) == ("turning", "turning")
    names = [f"ball.angular_velocity.{a}" for a in "xyz"]
    after = np.array([float(result.ask([n], np.array([0.8]))[n][0]) for n in names])
    spin = after / np.linalg.norm(after)
    assert second.direction == pytest.approx(spin, abs=1e-9)
    assert abs(np.dot(first.direction, second.direction)) < 1e-9


def test_condition_of_a_text_with_the_values_of_what_it_reads() -> None:
    (event,) = (e for e in run(ROLLING).explain() if e.kind == "condition")
    assert event.reason == "the condition `time < 1 s` becomes false"


def test_a_saved_run_has_the_same_reasons(tmp_path: Path) -> None:
    result = run(STRUCK)
    result.save(tmp_path / "run.frotrun")
    assert frot.load_result(tmp_path / "run.frotrun").explain() == result.explain()


def test_some_events_alone() -> None:
    result = run(STRUCK)
    assert result.explain(result.events[1:2]) == result.explain()[1:2]
    assert result.explain(()) == ()


def test_the_reasons_are_in_json_where_asked_for(tmp_path: Path) -> None:
    result = run(BLOCK, push=10)
    for explain in (False, True):
        result.save(tmp_path / "run.json", explain=explain)
        (event,) = json.loads((tmp_path / "run.json").read_text(encoding="utf-8"))["events"]
        assert ("reason" in event, "direction" in event) == (explain, explain)
    assert event["reason"] == result.explain()[0].reason and event["direction"] == [1.0]


def test_a_result_without_its_model_is_refused_by_name() -> None:
    from frot.runtime.run import simulate

    result = simulate(model(BLOCK).program())
    with pytest.raises(frot.FrotError) as found:
        result.explain()
    assert [x.code for x in found.value.diagnostics] == ["E0805"]


def test_inputs_over_time_are_those_of_the_instant() -> None:
    """The push times the time jumps from 3.924 N to 10 N at t = 0.5 s."""
    text = BLOCK.replace("parameter Force push = 10 N", "input Force push")
    result = frot.compile(text).simulate(inputs={"push": ([0, 0.5, 2], [7.848, 20, 20], "held")})
    (event,) = (e for e in result.explain() if e.kind == "slip")
    assert event.time == pytest.approx(0.5, abs=1e-12)
    assert event.reason == (
        "the loads change: more than mu_s N = 7.848 N is needed (3.924 N of 7.848 N before)"
    )


STOPPED = """planar model Stopped
  body b: particle(mass = 1 kg);
  liaison floor: contact_ponctuel(ground.line, b) with coulomb(0.1);
  {declared}
initial
  b.position = (0, 0) m;
  b.velocity = (2, 0) m/s;
{equations}
  experiment(stop = 0.5 s);
end Stopped;
"""


def reason_of_the_stop(declared: str = "", equations: str = "") -> str:
    text = STOPPED.format(declared=declared, equations=equations)
    found = frot.compile(text).simulate().explain()
    (stop,) = (x for x in found if x.kind == "stick" and x.liaison == "floor")
    return stop.reason


def test_a_slip_that_the_text_ends() -> None:
    jump = "equation when time > 0.25 s then reinit(b.velocity.x, 0 m/s); end when;"
    assert reason_of_the_stop(equations=jump).startswith("the text ends the slip of 1.75")


def test_a_slip_that_the_impact_of_another_liaison_ends() -> None:
    """A thread that comes taut takes the speed; the contact itself has no impact."""
    thread = "frame post on ground at (0, 0) m;liaison rope: fil(post, b, length = 0.5 m);"
    reason = reason_of_the_stop(declared=thread)
    assert reason.startswith("the impact ends the slip of 1.7375")


def test_a_slip_that_a_percussion_ends() -> None:
    blow = "force blow: impulse(b, value = (-2 + 0.1*9.81*0.25, 0) N.s, at = 0.25 s);"
    assert reason_of_the_stop(declared=blow).startswith("the impact ends the slip of 1.75")
