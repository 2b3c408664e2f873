"""The judge refutes records whose events are wrong: another bound of rest, another instant."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
import pytest
from judge.check import Judge
from judge.mechanics import Floats
from judge.scene import Contact, Force, Scene
from judge.seen import STICK, Outcome
from judge.values import name
from judge.write import END, write

import frot

TOLERANCE = 1e-6


def sledge() -> Scene:
    """A rod on two rough feet whose friction is larger at rest, drawn harder and harder."""
    s = Scene("Sledge")
    bar = s.body("bar", "rod")
    floor = s.line("floor", None)
    mu, more = s.parameter("mu", "Real"), s.parameter("more", "Real")
    for i in range(2):
        s.contacts.append(Contact(f"c{i}", floor, s.frame(f"f{i}", bar), mu=mu, mu_s=mu * more))
    rate, t0 = s.parameter("rate", "Force"), s.parameter("T0", "Time")
    speed = s.parameter("v0", "Velocity")
    pull = rate * (name("time") / t0)
    s.forces.append(Force("pull", "on", (s.middle(bar),), (pull, pull * 0.0)))
    s.statements += ["c0.gap = 0 m", "c1.gap = 0 m", f"bar.velocity.x = {speed.text}"]
    return s


VALUES = {
    "m_bar": 2.0,
    "l_bar": 1.0,
    "x_floor": 0.0,
    "y_floor": 0.0,
    "a_floor": 0.0,
    "mu": 0.3,
    "more": 1.2,
    "x_f0": -0.4,
    "y_f0": -0.1,
    "x_f1": 0.5,
    "y_f1": -0.1,
    "rate": 4.0,
    "T0": 1.0,
    "v0": 0.0,
}
# The bound of rest, 1.2*0.3*2 kg*9.81 m/s^2, is reached at 1.7658 s; 1 m/s are lost before that.
STOP = 3.0


@pytest.fixture(scope="module")
def model() -> frot.Model:
    return frot.compile(write(sledge()))


Run = Callable[..., frot.Result]


@pytest.fixture(scope="module")
def run(model: frot.Model) -> Run:
    def run(**changed: float) -> frot.Result:
        every = {**VALUES, **changed, END: STOP}
        return model.simulate(tolerance=TOLERANCE, parameters=every)

    return run


class Changed:
    """A result with a variable changed where it rests, or before an instant."""

    def __init__(
        self, result: frot.Result, change: Callable[[Floats, dict[str, Floats]], None]
    ) -> None:
        self._result, self._change = result, change
        self.time, self.events = result.time, result.events

    def at(self, t: Floats) -> Mapping[str, Floats]:
        now = {name: np.array(x) for name, x in self._result.at(t).items()}
        self._change(np.asarray(t), now)
        return now

    def __getitem__(self, word: str) -> Floats:
        return self._result[word]

    def __contains__(self, word: object) -> bool:
        return word in self._result


def faults(result: Outcome, **changed: float) -> set[str]:
    """Kinds of faults in a record that is held against the values of the scene."""
    judge = Judge(sledge(), {**VALUES, **changed}, result, TOLERANCE)
    return {f.split(":")[0] for f in judge.examine(np.random.default_rng(1)).faults}


def test_a_right_record_of_a_departure_and_of_a_stop_has_no_fault(run: Run) -> None:
    assert not faults(run())
    assert not faults(run(v0=1.0), v0=1.0)


def test_a_departure_at_the_friction_of_motion_is_refuted(run: Run) -> None:
    """`mu_s` was replaced by `mu`: at the end of rest, rest is still admissible."""
    assert "rest ended early" in faults(run(more=1.0))


@pytest.mark.parametrize(
    ("factor", "kind"), [(1 - 1e-5, "rest ended early"), (1 + 1e-5, "late departure")]
)
def test_a_departure_at_another_instant_is_refuted(run: Run, factor: float, kind: str) -> None:
    """The load grows with time: a bound 1e-5 too small or large shifts the event by as much."""
    assert kind in faults(run(more=VALUES["more"] * factor))


def test_a_stop_while_some_slip_is_left_is_refuted(run: Run) -> None:
    """A stop located 1e-5 of the run early leaves 1e-5 of the speed."""
    result = run(v0=1.0)
    stop = next(e.time for e in result.events if e.kind == "stick")

    def early(t: Floats, now: dict[str, Floats]) -> None:
        now["bar.velocity.x"][t < stop * (1 - 1e-14)] += 1e-5

    assert "slip at rest's begin" in faults(Changed(result, early), v0=1.0)


def test_modes_that_do_not_change_at_their_event_are_refuted(run: Run) -> None:
    result = run()

    def stuck(t: Floats, now: dict[str, Floats]) -> None:
        now["c0.mode"][t > 0] = STICK

    assert "event" in faults(Changed(result, stuck))


@pytest.mark.parametrize("word", ["velocity.x", "velocity.y", "angular_velocity"])
def test_a_body_at_rest_that_creeps_is_refuted(run: Run, word: str) -> None:
    """Rest is zero, not 1e-77 of anything."""
    result = run()

    def creep(t: Floats, now: dict[str, Floats]) -> None:
        now[f"bar.{word}"][t < 1.0] = 1e-77

    assert "rest" in faults(Changed(result, creep))


def test_a_reaction_that_is_scaled_is_refuted(run: Run) -> None:
    result = run()

    def scaled(t: Floats, now: dict[str, Floats]) -> None:
        for axis in "xy":
            now[f"c0.force.{axis}"] *= 1 + 1e-6
        now["c0.normal_force"] *= 1 + 1e-6
        now["c0.tangential_force"] *= 1 + 1e-6

    assert "Newton-Euler" in faults(Changed(result, scaled))
