"""The judge holds a scene against the same one written otherwise, and groups against each alone."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest
from judge.alike import back
from judge.changed import Moved, renamed, reordered, together, weighed
from judge.check import Judge
from judge.family import Setting, Structure
from judge.mechanics import Floats, Mechanics
from judge.others import Other
from judge.scene import Contact, Force, Pin, Scene
from judge.trial import try_setting
from judge.values import as_value, name, sin
from judge.verdict import EXACT, SILENT
from judge.write import END, write

import frot


def slider() -> Scene:
    """A rod on a smooth rail and a rough foot, pinned to a bead that a waved force draws."""
    s = Scene("Slider")
    s.gravity = s.parameter("g", "Acceleration")
    rod, bead = s.body("rod", "rod"), s.body("bead", "particle")
    rail = s.line("rail", None)
    mu = s.parameter("mu", "Real")
    law = mu * (as_value(1.0) + sin(name("bead.position.x") / s.parameter("L0", "Length")) * 0.3)
    s.contacts.append(
        Contact("foot", rail, s.middle(bead), bilateral=True, kind="point_courbe", mu=law)
    )
    s.pins.append(Pin("eye", s.middle(bead), s.end(rod, "start")))
    force, w = s.parameter("F", "Force"), s.parameter("w", "AngularVelocity")
    wave = force * sin(w * name("time"))
    s.forces.append(Force("push", "on", (s.end(rod, "tip"),), (wave, force)))
    s.forces.append(Force("turn", "couple", (), (s.parameter("C", "Torque"),), rod))
    s.statements += ["bead.position.x = x0", "bead.position.y = y0", "rod.angle = a0"]
    for word, kind in (("x0", "Length"), ("y0", "Length"), ("a0", "Angle")):
        s.parameter(word, kind)
    return s


VALUES = {
    "g": 9.81,
    "m_rod": 1.5,
    "l_rod": 0.8,
    "m_bead": 0.7,
    "x_rail": 0.1,
    "y_rail": 0.2,
    "a_rail": 0.3,
    "mu": 0.2,
    "L0": 0.5,
    "F": 3.0,
    "w": 4.0,
    "C": 0.4,
    "x0": 0.1 + math.cos(0.3),
    "y0": 0.2 + math.sin(0.3),
    "a0": -0.4,
}
SETTING = Setting(VALUES, 1.5, 1e-9)


def judged(scene: Scene, other: Other, setting: Setting = SETTING) -> tuple[str, list[str]]:
    structure = Structure(scene, lambda _: setting, [other])
    verdict = try_setting(frot.compile(write(scene)), structure, setting, 1, 20.0)
    return verdict.kind, verdict.why


def moved(turn: float, flip: float, scene: Scene) -> Other:
    return Other("moved", Moved(scene, turn, flip).scene, back(turn, flip))


@pytest.mark.parametrize(
    ("turn", "flip"), [(math.pi / 2, 1.0), (math.pi, 1.0), (0.0, -1.0), (-math.pi / 2, -1.0)]
)
def test_a_scene_turned_by_right_angles_and_mirrored_moves_as_before(
    turn: float, flip: float
) -> None:
    assert judged(slider(), moved(turn, flip, slider()))[0] == EXACT


def test_a_scene_turned_by_any_angle_moves_as_before() -> None:
    scene = weighed(slider())
    assert judged(scene, moved(1.1, 1.0, scene))[0] == EXACT


def test_gravity_that_is_not_turned_with_its_scene_is_found() -> None:
    other = moved(math.pi / 2, 1.0, slider())
    other.scene.down = "-y"
    kind, why = judged(slider(), other)
    assert kind == SILENT
    assert "moved" in why[0]


def test_accelerations_of_the_judge_turn_with_the_scene() -> None:
    """Loads of Newton-Euler in a turned and mirrored scene are those of the first, turned."""
    scene, turn, flip = weighed(slider()), 0.7, -1.0
    other = Moved(scene, turn, flip).scene
    at = {"rod": (0.4, 0.1, 0.3, 0.2, -0.5, 0.6), "bead": (0.2, -0.4, 0.0, 0.3, 0.1, 0.0)}
    turned = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])

    def around(x: float, y: float) -> tuple[float, float]:
        found = turned @ np.array([x, flip * y])
        return float(found[0]), float(found[1])

    then = {
        b: (*around(*s[:2]), flip * s[2] + turn, *around(*s[3:5]), flip * s[5])
        for b, s in at.items()
    }

    def load(scene: Scene, state: Mapping[str, tuple[float, ...]]) -> Floats:
        def look(word: str) -> float:
            if word in VALUES or word == "time":
                return VALUES.get(word, 0.3)
            body, what, axis = word.split(".")
            return state[body][(0 if what == "position" else 3) + "xy".index(axis)]

        return Mechanics(scene, look, state, {"foot": 1}).load

    one, two = load(scene, at), load(other, then)
    for k in (0, 3):
        assert two[k : k + 2] == pytest.approx(around(one[k], one[k + 1]), abs=1e-13)
    assert two[2] == pytest.approx(flip * one[2], abs=1e-13)


def test_a_scene_in_another_order_moves_as_before() -> None:
    again = reordered(slider(), np.random.default_rng(5))
    names = {b.name.split("_", 1)[1]: b.name for b in again.bodies}

    def read(now: Mapping[str, Floats], word: str) -> Floats:
        body, dot, rest = word.partition(".")
        return now[names[body] + dot + rest]

    assert judged(slider(), Other("reordered", again, read))[0] == EXACT


def test_a_text_in_small_units_moves_to_rounding_as_one_in_si() -> None:
    assert judged(slider(), Other("units", slider(), exact=True, literal=True))[0] == EXACT
    text = write(slider(), VALUES | {"g": 8.0, "w": 2.0}, small=True)
    for words in ("m_rod = 1500.0 g;", "g = 0.008 mm/ms^2;", "w = 0.002 rad/ms;"):
        assert words in text


def test_a_coefficient_that_differs_by_a_millionth_is_found() -> None:
    """Two runs of one tolerance of 1e-9 differ by less than a millionth of friction makes."""
    other = slider()
    other.contacts[0] = replace(other.contacts[0], mu=other.contacts[0].mu * (1 + 1e-5))  # type: ignore[operator]
    kind, why = judged(slider(), Other("units", other, exact=True, literal=True))
    assert kind == SILENT
    assert why[0].startswith("units: motion")


def two() -> tuple[Scene, list[Other]]:
    """Two sliders that nothing binds together."""
    scenes = [
        renamed(slider(), lambda w, k=k: w if w == "g" else f"{k}_{w}") for k in ("one", "two")
    ]
    return together(scenes), [Other("alone", s, part=True, bodies=s.bodies) for s in scenes]


def values_of_two() -> dict[str, float]:
    found = {"g": 9.81}
    for k in ("one", "two"):
        found |= {f"{k}_{w}": x for w, x in VALUES.items() if w != "g"}
    return found | {"two_m_rod": 4.0, "two_a0": 1.0}


def test_groups_start_and_move_as_each_alone() -> None:
    whole, others = two()
    setting = Setting(values_of_two(), 1.5, 1e-9, start_known=False)
    structure = Structure(whole, lambda _: setting, others)
    verdict = try_setting(frot.compile(write(whole)), structure, setting, 1, 20.0)
    assert verdict.kind == EXACT, verdict.why


def test_a_group_that_starts_elsewhere_than_alone_is_found() -> None:
    """A millionth of a millimetre is more than rounding."""
    whole, others = two()
    setting = Setting(values_of_two(), 1.5, 1e-9, start_known=False)

    def read(now: Mapping[str, Floats], word: str) -> Floats:
        return now[word] + (1e-9 if word == "two_rod.position.x" else 0.0)

    others[1].read = read
    structure = Structure(whole, lambda _: setting, others)
    verdict = try_setting(frot.compile(write(whole)), structure, setting, 1, 20.0)
    assert verdict.kind == SILENT
    assert verdict.why[0].startswith("alone: start")


class OtherBalance:
    """A result whose balance of energy was begun at another start."""

    def __init__(self, result: frot.Result, missed: float) -> None:
        self._result = result
        self.time, self.events, self.at = result.time, result.events, result.at
        self.balance = replace(result.balance, residual=result.balance.residual + missed)

    def __getitem__(self, word: str) -> Floats:
        return self._result[word]

    def __contains__(self, word: object) -> bool:
        return word in self._result


@pytest.mark.parametrize(("missed", "found"), [(0.0, False), (1e-5, True)])
def test_a_balance_of_energy_that_begins_elsewhere_is_found(missed: float, found: bool) -> None:
    every = {**VALUES, END: 1.5}
    result = frot.compile(write(slider())).simulate(tolerance=1e-9, parameters=every)
    judge = Judge(slider(), VALUES, OtherBalance(result, missed), 1e-9)
    faults = judge.examine(np.random.default_rng(1)).faults
    assert any(f.startswith("energy residual") for f in faults) == found
