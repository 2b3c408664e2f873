"""The judge of impacts: closed forms of one contact, records that are falsified, random scenes.

`bench/random_scenes.py --only impacts impacts_space` runs thousands.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np
import pytest
from judge.collisions.check import ImpactJudge
from judge.collisions.keller import departures, impact
from judge.collisions.rows import Bodies, inertia_of, polygon
from judge.collisions.scene import END, Body, ImpactScene, Place, Touch, Wall
from judge.collisions.trial import try_impacts
from judge.family import Setting
from judge.trial import setting_of, structure_of
from judge.verdict import CONFIRMED, EXACT

import frot

Floats = np.ndarray


def test_a_sphere_with_spin_has_its_closed_form() -> None:
    """The slip loses 7/2 mu (1 + e) of the speed of approach, or ends; three rules agree."""
    w = np.diag([1 / 0.17, 3.5 / 0.17, 3.5 / 0.17])
    for slip in ((3.0, 1.0), (0.1, -0.2)):
        for rule in ("energetic", "poisson", "newton"):
            after, impulses, lost = impact(w, np.array([-2.0, *slip]), (0.2, 0.2), 0.9, rule)
            p = 1.9 * 0.17 * 2.0
            left = max(1 - 0.2 * p * 3.5 / 0.17 / math.hypot(*slip), 0)
            assert after == pytest.approx([1.8, left * slip[0], left * slip[1]], abs=1e-12)
            assert impulses[0] == pytest.approx(p, rel=1e-12)
            squares = 0.17 / 2 * (4 - 1.8**2) + 0.17 / 7 * (1 - left**2) * (
                slip[0] ** 2 + slip[1] ** 2
            )
            assert lost == pytest.approx(squares, rel=1e-11)


def test_a_slip_that_turns_obeys_the_laws_of_impact() -> None:
    """Energy given back is e^2 of that stored: the work along the normal, by finer steps."""
    rng = np.random.default_rng(2)
    half = rng.normal(size=(3, 3)) * 0.3 + np.eye(3)
    w, u, mu, e = half @ half.T, np.array([-1.0, 0.8, -0.5]), 0.3, 0.6
    after, impulses, _ = impact(w, u, (mu, mu), e, "energetic")
    assert after == pytest.approx(u + w @ impulses, abs=1e-11)
    now, p, stored, returned, steps = u.copy(), 0.0, 0.0, 0.0, 40_000
    h = 1.05 * impulses[0] / steps
    for _ in range(2 * steps):
        force = np.array([1.0, *(-mu * now[1:] / np.hypot(*now[1:]))])
        then = now + h / 2 * (w @ force)
        force = np.array([1.0, *(-mu * then[1:] / np.hypot(*then[1:]))])
        work = h * then[0]
        stored, returned = stored - min(work, 0), returned + max(work, 0)
        now, p = now + h * (w @ force), p + h
        if returned >= e * e * stored > 0 and now[0] > 0:
            break
    assert p == pytest.approx(impulses[0], rel=3e-4)
    assert now == pytest.approx(after, abs=3e-4)


def test_a_slip_that_cannot_stick_departs_in_its_direction() -> None:
    """W_tn - mu W_tt d = beta d: where W_tt is a multiple of the identity, d is along W_tn."""
    w = np.array([[1.0, 0.3, 0.4], [0.3, 1.0, 0.0], [0.4, 0.0, 1.0]])
    (way,) = departures(w, 0.2)
    assert way == pytest.approx([0.6, 0.8], abs=1e-12)


def test_a_triangle_has_its_moment() -> None:
    """Of a right triangle with legs a, b: (a^2 + b^2)/18 per mass about its centroid."""
    centre, moment = polygon(((0.0, 0.0), (3.0, 0.0), (0.0, 4.0)))
    assert centre == pytest.approx([1, 4 / 3])
    assert moment == pytest.approx(25 / 18)
    body = Body("b", "polygon", ((0.0, 0.0), (3.0, 0.0), (0.0, 4.0)))
    assert inertia_of(body, {"m_b": 2.0, "l_b": 0.1}, True)[2] == pytest.approx(0.5 / 18)


def ball() -> ImpactScene:
    """A disc thrown on a level floor."""
    s = ImpactScene("Impacts", True)
    b = Body("b", "disc")
    s.bodies.append(b)
    s.add("b", {"m": "Mass", "r": "Length", "x0": "Length", "y0": "Length"})
    s.add("b", {"u0": "Velocity", "v0": "Velocity", "a0": "Angle", "o0": "AngularVelocity"})
    s.add("k", {"mu": "Real", "more": "Real", "e": "Real"})
    s.add("floor", {"x": "Length", "y": "Length", "a": "Angle"})
    floor = Wall("floor")
    s.walls.append(floor)
    s.touches.append(Touch("c", "wall", a=Place(b), wall=floor, law="k"))
    return s


VALUES = {
    "g": 9.81,
    "m_b": 2.0,
    "r_b": 0.1,
    "x0_b": 0.0,
    "y0_b": 0.6,
    "u0_b": 1.0,
    "v0_b": 0.0,
    "a0_b": 0.0,
    "o0_b": 5.0,
    "mu_k": 0.05,
    "more_k": 1.0,
    "e_k": 0.7,
    "x_floor": 0.0,
    "y_floor": 0.0,
    "a_floor": 0.0,
}
SETTING = Setting(VALUES, 1.0, 1e-10)


@pytest.fixture(scope="module")
def run() -> frot.Result:
    return frot.compile(ball().text()).simulate(tolerance=1e-10, parameters={**VALUES, END: 1.0})


class Falsified:
    """A result with its variables changed after the first impact, or with other events."""

    def __init__(
        self,
        result: frot.Result,
        change: Callable[[float, dict[str, float]], None] | None = None,
        **events: float,
    ) -> None:
        from dataclasses import replace

        self._result, self._change = result, change
        first, *others = result.events
        self.time, self.events = result.time, (replace(first, **events), *others)

    def at(self, t: Floats) -> Mapping[str, Floats]:
        rows = []
        for k, x in enumerate(t):
            row = {name: float(v[k]) for name, v in self._result.at(t).items()}
            if self._change:
                self._change(float(x) - self.events[0].time, row)
            rows.append(row)
        return {name: np.array([row[name] for row in rows]) for name in rows[0]}

    def __getitem__(self, word: str) -> Floats:
        return self._result[word]


def changed(word: str, factor: float = 1.0, by: float = 0.0, after: bool = True):
    def change(since: float, row: dict[str, float]) -> None:
        if (since >= 0) == after:
            row[word] = row[word] * factor + by

    return change


CASES = (
    ({"change": changed("b.velocity.y", 1 + 1e-5)}, "impulses"),
    ({"change": changed("b.velocity.x", by=1e-5)}, "speeds after"),
    ({"change": changed("b.velocity.x", by=0.5)}, "impulses"),
    ({"change": changed("b.velocity.y", 1.5)}, "energy grows"),
    ({"change": changed("b.position.y", by=-1e-9)}, "penetration"),
    ({"change": changed("b.acceleration.x", by=1e-4)}, "Newton-Euler"),
    ({"impulse": 3.0}, "impulse"),
    ({"energy_lost": 1.0}, "energy lost"),
    ({"contacts": 0}, "event"),
    ({"until": 0.1}, "limit before its impact"),
    ({"time": 0.999}, "order of events"),
)


@pytest.mark.parametrize(("changes", "kind"), CASES, ids=[k for _, k in CASES])
def test_a_falsified_record_of_an_impact_is_refuted(
    run: frot.Result, changes: dict[str, object], kind: str
) -> None:
    falsified = Falsified(run, **changes)  # type: ignore[arg-type]
    judge = ImpactJudge(ball(), SETTING, falsified)  # type: ignore[arg-type]
    assert kind in {f.split(":")[0] for f in judge.examine(np.random.default_rng(1)).faults}


def test_a_right_record_of_impacts_has_no_fault(run: frot.Result) -> None:
    judge = ImpactJudge(ball(), SETTING, run)
    assert not judge.examine(np.random.default_rng(1)).faults
    assert judge.counts["computed anew"] == judge.counts["examined"] >= 2


def test_another_coefficient_is_refuted(run: frot.Result) -> None:
    """The run has e = 0.7 and mu = 0.05; its slip does not end in the first impact."""
    for word, x in (("e_k", 0.7001), ("mu_k", 0.0501), ("m_b", 2.0001)):
        judge = ImpactJudge(ball(), Setting({**VALUES, word: x}, 1.0, 1e-10), run)
        assert judge.examine(np.random.default_rng(1)).faults, word


def test_rows_of_gaps_are_their_rates() -> None:
    """By differences, for bodies, walls, pairs, cords and joints in random motion."""
    rng = np.random.default_rng(4)
    for family in ("impacts", "impacts_space"):
        for number in range(8):
            structure = structure_of(4, family, number)
            scene: ImpactScene = structure.scene  # type: ignore[assignment]
            values = setting_of(structure, 4, family, number, 0).values
            row = {f"{j.name}.{k}": 0.0 for j in scene.joints for k in ("angle", "displacement")}
            h = 1e-6 * min(1.0, float(rng.uniform(0.9, 1)))
            from judge.collisions.check import start_row

            row |= start_row(scene, values)
            now = Bodies(scene, values, row, 0.0)
            pace = h * now_length(values, scene) / max(np.max(np.abs(now.speed)), 1e-300)
            moved = [Bodies(scene, values, flown(now, row, s * pace), s * pace) for s in (-1, 1)]
            for name, m in now.meetings.items():
                if m.touch.of is not None:
                    continue
                rate = (moved[1].meetings[name].gap - moved[0].meetings[name].gap) / (2 * pace)
                found = float(m.rows[0] @ now.speed + m.drift[0])
                size = float(np.sum(np.abs(m.rows[0]))) * float(np.max(np.abs(now.speed)))
                assert found == pytest.approx(rate, abs=1e-7 * size + 1e-7 * abs(m.drift[0])), name


def now_length(values: Mapping[str, float], scene: ImpactScene) -> float:
    """The largest length of a scene."""
    return max(abs(x) for w, x in values.items() if scene.parameters[w] == "Length")


def flown(now: Bodies, row: Mapping[str, float], h: float) -> dict[str, float]:
    """A start, a short time later, without forces."""
    scene, found = now.scene, dict(row)
    for b in scene.bodies:
        s = now.of(b)
        for k, axis in enumerate(scene.axes):
            found[f"{b.name}.position.{axis}"] += h * float(s.velocity[k])
        if b.shape == "particle":
            continue
        if scene.plane:
            found[f"{b.name}.angle"] += h * float(s.spin[2])
            continue
        q = np.array([row[f"{b.name}.orientation[{k}]"] for k in range(1, 5)])
        w = s.spin
        rate = np.array([-w @ q[1:], *(q[0] * w + np.cross(w, q[1:]))]) / 2
        for k in range(4):
            found[f"{b.name}.orientation[{k + 1}]"] = float(q[k] + h * rate[k])
    return found


# seed, family, number of its text, settings
SCENES = (
    *((5, "impacts", number, 4) for number in (0, 2, 5, 7)),
    *((5, "impacts_space", number, 3) for number in (0, 2, 4, 5)),
)


@pytest.mark.parametrize(("seed", "family", "number", "settings"), SCENES)
def test_random_scenes_with_impacts_are_right(
    seed: int, family: str, number: int, settings: int
) -> None:
    structure = structure_of(seed, family, number)
    scene: ImpactScene = structure.scene  # type: ignore[assignment]
    model = frot.compile(scene.text())
    for k in range(settings):
        setting = setting_of(structure, seed, family, number, k)
        verdict = try_impacts(model, scene, setting, k, 20.0)
        assert verdict.kind in (EXACT, CONFIRMED), verdict.why
