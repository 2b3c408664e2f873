"""The judge is right itself: it finds what is falsified, and knows motions that are known."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
import pytest
from judge.check import Judge
from judge.family import Setting, Structure
from judge.integrals import shaken_by_errors
from judge.mechanics import Floats
from judge.motions import CLEAR, distinct, motions
from judge.scene import Contact, Force, Pin, Scene
from judge.trial import try_setting
from judge.values import name
from judge.verdict import CONFIRMED, EXACT, Start, judge_stop, still_of
from judge.write import END, write

import frot


def sledge() -> Scene:
    """A rod on two rough feet, drawn by a force that grows with time."""
    s = Scene("Sledge")
    bar = s.body("bar", "rod")
    floor = s.line("floor", None)
    mu = s.parameter("mu", "Real")
    for i in range(2):
        foot = s.frame(f"f{i}", bar)
        s.contacts.append(Contact(f"c{i}", floor, foot, mu=mu))
    rate, t0 = s.parameter("rate", "Force"), s.parameter("T0", "Time")
    pull = rate * (name("time") / t0)
    s.forces.append(Force("pull", "on", (s.middle(bar),), (pull, pull * 0.0)))
    s.statements += ["c0.gap = 0 m", "c1.gap = 0 m"]
    return s


VALUES = {
    "m_bar": 2.0,
    "l_bar": 1.0,
    "x_floor": 0.0,
    "y_floor": 0.0,
    "a_floor": 0.0,
    "mu": 0.3,
    "x_f0": -0.4,
    "y_f0": -0.1,
    "x_f1": 0.5,
    "y_f1": -0.1,
    "rate": 4.0,
    "T0": 1.0,
}


class Falsified:
    """A result with one variable changed."""

    def __init__(self, result: frot.Result, variable: str, factor: float) -> None:
        self._result, self._variable, self._factor = result, variable, factor
        self.time, self.events = result.time, result.events

    def at(self, t: Floats) -> Mapping[str, Floats]:
        now = dict(self._result.at(t))
        now[self._variable] = self._factor * now[self._variable]
        return now

    def __getitem__(self, word: str) -> Floats:
        return self._result[word]

    def __contains__(self, word: object) -> bool:
        return word in self._result


@pytest.fixture(scope="module")
def run() -> frot.Result:
    model = frot.compile(write(sledge()))
    return model.simulate(tolerance=1e-9, parameters={**VALUES, END: 3.0})


@pytest.mark.parametrize(
    ("variable", "factor", "kind"),
    [
        ("bar.acceleration.x", 1 + 1e-6, "Newton-Euler"),
        ("bar.angular_acceleration", 1.0, ""),
        ("c0.tangential_force", 1 + 1e-6, "law"),
        ("c1.normal_force", -1.0, "pull"),
        ("bar.velocity.x", 1 + 1e-4, "integral of velocity"),
        ("bar.position.y", 1.001, "relation"),
        ("c0.force.x", -1.0, "force"),
    ],
)
def test_a_falsified_variable_is_found(
    run: frot.Result, variable: str, factor: float, kind: str
) -> None:
    judge = Judge(sledge(), VALUES, Falsified(run, variable, factor), 1e-9)
    faults = judge.examine(np.random.default_rng(1)).faults
    told = {f.split(":")[0] for f in faults} - {"held slip"}
    assert kind in told if kind else not told


def test_the_motions_of_a_pulled_sledge_are_the_known_ones(run: frot.Result) -> None:
    """It rests until the pull is mu m g, at 1.4715 s, and slips as one body after that."""
    judge = Judge(sledge(), VALUES, run, 1e-9)
    for t, modes, acceleration in ((1.0, {0}, 0.0), (2.0, {1}, 2.0 * 2.0 - 0.3 * 9.81)):
        now = judge.mechanics(t)
        still = still_of(judge, now, 1e-6)
        found = distinct([m for m in motions(now, still) if m.margin > 1e-6], now)
        assert len(found) == 1
        assert {c.slip for c in found[0].modes.values()} == modes
        assert found[0].acceleration[0] == pytest.approx(acceleration, abs=1e-9)


def test_what_is_apart_may_accelerate_as_it_likes(run: frot.Result) -> None:
    """Lifted off the floor, the sledge falls freely: a motion like any other."""
    judge = Judge(sledge(), VALUES, Falsified(run, "bar.position.y", 2.0), 1e-9)
    now = judge.mechanics(1.0)
    found = [m for m in motions(now, still_of(judge, now, 1e-6)) if m.margin > 1e-6]
    assert len(found) == 1
    assert found[0].acceleration[1] == pytest.approx(-9.81, abs=1e-12)


def test_a_level_rod_on_a_dry_pin_falls_and_does_not_rise() -> None:
    """No load is a couple: what it may turn like is still looked at."""
    s = Scene("Pendulum")
    rod = s.body("rod", "rod")
    mu, radius = s.parameter("mu", "Real"), s.parameter("pin", "Length")
    s.pins.append(Pin("joint", s.frame("eye", None), s.end(rod, "start"), mu, mu, radius))
    at = {f"{c}0_rod": 0.0 for c in "yauvw"}
    values = {"m_rod": 1.0, "l_rod": 1.0, "mu": 0.3, "pin": 0.05, "x_eye": 0.0, "y_eye": 0.0}
    values |= {"x0_rod": 0.5, **at}
    judge = Judge(s, values, Start(s, values, 1.0), 1e-9)
    now = judge.mechanics(0.0)
    found = [m for m in motions(now, still_of(judge, now, 1e-6)) if m.margin > 1e-6]
    assert [m.modes["joint"].slip for m in found] == [-1]


def test_a_dry_pin_turns_beside_a_bar_on_three_feet() -> None:
    """Reactions that are not unique take no motion away from what turns with friction."""
    s = Scene("Beside")
    rod, bar = s.body("rod", "rod"), s.body("bar", "rod")
    mu, radius = s.parameter("mu", "Real"), s.parameter("pin", "Length")
    s.pins.append(Pin("joint", s.frame("eye", None), s.end(rod, "start"), mu, mu, radius))
    values = {"m_rod": 1.0, "l_rod": 1.0, "mu": 0.3, "pin": 0.05, "x_eye": 0.0, "y_eye": 5.0}
    values |= {"m_bar": 2.0, "l_bar": 1.0, "x_floor": 0.0, "y_floor": 0.0, "a_floor": 0.0}
    floor = s.line("floor", None)
    for i in range(3):
        s.contacts.append(Contact(f"c{i}", floor, s.frame(f"f{i}", bar)))
        values |= {f"x_f{i}": 0.4 * (i - 1), f"y_f{i}": -0.1}
    values |= {f"{c}0_rod": x for c, x in zip("xyauvw", (0.5, 5, 0, 0, 0.5, 1), strict=True)}
    values |= {f"{c}0_bar": x for c, x in zip("xyauvw", (0, 0.1, 0, 0, 0, 0), strict=True)}
    judge = Judge(s, values, Start(s, values, 1.0), 1e-9)
    now = judge.mechanics(0.0)
    found = [m for m in motions(now, still_of(judge, now, 1e-6)) if m.margin > 1e-6]
    assert found
    # about the eye: m g l/2 and the friction mu r |R| of R = m (a - g), a from the motion itself
    a = found[0].acceleration
    force = np.hypot(a[0], a[1] + 9.81)
    assert a[2] == pytest.approx((-9.81 / 2 - 0.3 * 0.05 * force) * 3, rel=1e-12)


@pytest.mark.parametrize(("tilt", "rests"), [(0.29, True), (0.31, False)])
def test_a_light_body_hides_no_slip_of_a_heavy_one(tilt: float, rests: bool) -> None:
    """Its quickness is no measure of forces: a bead of 1 kg rests where tan(tilt) < mu alone."""
    s = Scene("Slope")
    bead, rod = s.body("bead", "particle"), s.body("rod", "rod")
    mu, push = s.parameter("mu", "Real"), s.parameter("push", "Force")
    slope = s.line("slope", None)
    s.contacts.append(Contact("foot", slope, s.middle(bead), mu=mu, bilateral=True))
    s.pins.append(Pin("eye", s.middle(bead), s.end(rod, "start")))
    s.forces.append(Force("on_rod", "on", (s.middle(rod),), (push, push)))
    values = {"m_bead": 1.0, "m_rod": 1e-12, "l_rod": 1.0, "mu": math.tan(0.3), "push": 1e-3}
    values |= {"x_slope": 0.0, "y_slope": 0.0, "a_slope": tilt}
    values |= {f"{c}0_{b}": 0.0 for c in "xyauvw" for b in ("bead", "rod")} | {"x0_rod": 0.5}
    judge = Judge(s, values, Start(s, values, 1.0), 1e-9)
    now = judge.mechanics(0.0)
    found = [m for m in motions(now, still_of(judge, now, 1e-6)) if m.margin > -CLEAR]
    assert any(m.modes["foot"].slip == 0 for m in found) == rests


def test_errors_of_a_state_shake_what_a_stiff_load_moves() -> None:
    """A bead of 1e-4 kg in a drag of 1e4 N.s/m: what 2 m/s miss by 1e-9 are 0.2 m/s^2."""
    s = Scene("Stiff")
    bead = s.body("bead", "particle")
    c = s.parameter("c", "Damping")
    s.forces.append(Force("drag", "drag", (s.middle(bead),), (c,)))
    values = {"m_bead": 1e-4, "c": 1e4}
    values |= {f"{c}0_bead": x for c, x in zip("xyauvw", (0, 0, 0, 2.0, 0, 0), strict=True)}
    judge = Judge(s, values, Start(s, values, 1.0), 1e-9)
    assert shaken_by_errors(judge, 0.0)[:2] == pytest.approx([0.2, 0.2], rel=1e-6)


ROD = """
planar model Rod
  parameter Mass m_bar = 1 kg;
  parameter Length l_bar = 2 m;
  parameter Real mu = {mu};
  body bar: rod(mass = m_bar, length = l_bar);
  liaison foot: contact_ponctuel(bar.start, ground.line) with coulomb(mu);
initial
  bar.angle = 63 deg;
  bar.start.position = (0, 0) m;
  bar.start.velocity = (-1, 0) m/s;
  experiment(stop = 0.01 s);
end Rod;
"""


def painleve_rod() -> Scene:
    s = Scene("Rod")
    bar = s.body("bar", "rod")
    from judge.scene import Line
    from judge.values import as_value

    line = Line("ground.line", None, None, as_value(0.0))
    s.contacts.append(Contact("foot", line, s.end(bar, "start"), mu=s.parameter("mu", "Real")))
    return s


def test_an_impasse_of_painleve_is_confirmed_and_one_that_is_none_refuted() -> None:
    """p = 1 + 3 cos(th) (cos(th) - mu sin(th)) is negative at 63 degrees from mu = 1.98 on.

    With the free acceleration of the foot into the ground no motion is admissible then.
    """
    th = math.radians(63)
    critical = (1 + 3 * math.cos(th) ** 2) / (3 * math.sin(th) * math.cos(th))
    for mu, impasse in ((critical * 1.2, True), (critical * 0.5, False)):
        model = frot.compile(ROD.format(mu=mu))
        values = {"m_bar": 1.0, "l_bar": 2.0, "mu": mu}
        result = frot.compile(ROD.format(mu=0.1)).simulate(tolerance=1e-9)
        judge = Judge(painleve_rod(), values, result, 1e-9)
        verdict = judge_stop(judge, "E0902", "", 0.0)
        assert (verdict.kind == CONFIRMED) == impasse
        if impasse:
            first = model.simulate().events[0]
            assert (first.kind, first.time) == ("tangential_impact", 0.0)
            stops = frot.compile(ROD.format(mu=mu).replace("0.01 s", "0.01 s, on_impasse = stop"))
            with pytest.raises(frot.SimulationError, match="E0902"):
                stops.simulate()
        else:
            assert model.simulate().time[-1] == pytest.approx(0.01)


def test_a_whole_trial_of_a_known_scene_is_exact() -> None:
    structure = Structure(sledge(), lambda _: Setting(VALUES, 1.2, 1e-9))
    model = frot.compile(write(structure.scene))
    verdict = try_setting(model, structure, Setting(VALUES, 1.2, 1e-9, compare=True), 1, 10.0)
    faults = [w for w in verdict.why if not w.startswith("held slip")]
    assert verdict.kind == EXACT or not faults
