"""The judge of mechanisms in space: known motions, and records that are falsified."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np
import pytest
from judge.family import Setting
from judge.space.check import SpaceJudge
from judge.space.families import start_of
from judge.space.rows import Floats, Mechanism, State, axes
from judge.space.scene import END, Link, Push, SpaceScene
from judge.space.trial import try_mechanism
from judge.trial import setting_of, structure_of
from judge.verdict import EXACT

import frot


def pendulum() -> SpaceScene:
    """A box on a smooth axis, drawn by a force off its centre."""
    s = SpaceScene("Pendulum")
    box = s.body("box", "box")
    seat, eye, hand = s.frame("seat", None), s.frame("eye", box), s.frame("hand", box)
    s.links.append(Link("pin", "rotoide", seat, eye, (0.0, 1.0, 0.0)))
    s.add("pull", {"fx": "Force", "fy": "Force", "fz": "Force", "w": "AngularVelocity"})
    s.pushes.append(Push("pull", "on", (hand,)))
    return s


def values(angle: float, speed: float) -> dict[str, float]:
    """The box hangs at 0.5 m from the axis, turned by `angle` about y."""
    given = {"g": 9.81, "m_box": 2.0, "s1_box": 0.3, "s2_box": 0.4, "s3_box": 0.5}
    at = -0.5 * math.sin(angle), 0.0, -0.5 * math.cos(angle)
    moving = -0.5 * math.cos(angle) * speed, 0.0, 0.5 * math.sin(angle) * speed
    given |= {f"{k}0_box": x for k, x in zip("xyz", at, strict=True)}
    given |= {f"{k}0_box": x for k, x in zip("uvw", moving, strict=True)}
    turned = math.cos(angle / 2), 0.0, math.sin(angle / 2), 0.0
    given |= {f"q{k + 1}_box": x for k, x in enumerate(turned)}
    given |= {"o1_box": 0.0, "o2_box": speed, "o3_box": 0.0}
    for f, place in (("seat", (0, 0, 0)), ("eye", (0, 0, 0.5)), ("hand", (0.1, 0.2, -0.1))):
        given |= {f"{k}_{f}": float(x) for k, x in zip("xyz", place, strict=True)}
        given |= {f"e1_{f}": 0.0, f"e2_{f}": 0.0, f"e3_{f}": 1.0, f"a_{f}": 0.0}
    return given | {"fx_pull": 3.0, "fy_pull": -2.0, "fz_pull": 1.0, "w_pull": 2.0}


def test_the_rows_of_a_pendulum_give_its_known_acceleration() -> None:
    """I_O th'' = -m g l sin(th), I_O = m (s1^2 + s3^2)/12 + m l^2, with its centripetal part."""
    angle, speed = 0.7, 1.3
    given, scene = values(angle, speed), pendulum()
    now = Mechanism(scene, given, start_of(scene, given), 0.0)
    matrix = now.matrix()
    bias = np.array([r.bias for r in now.rows["pin"]])
    n, k = now.n, len(matrix)
    whole = np.block([[now.mass, -matrix.T], [matrix, np.zeros((k, k))]])
    found = np.linalg.solve(whole, np.concatenate([now.load, -bias]))[:n]
    inertia = 2.0 * (0.3**2 + 0.5**2) / 12 + 2.0 * 0.25
    turn = -2.0 * 9.81 * 0.5 * math.sin(angle) / inertia
    ahead = np.array([-math.cos(angle), 0.0, math.sin(angle)])
    inward = np.array([math.sin(angle), 0.0, math.cos(angle)])
    assert found[3:] == pytest.approx([0, turn, 0], abs=1e-12)
    assert found[:3] == pytest.approx(0.5 * (turn * ahead + speed**2 * inward), abs=1e-12)


@pytest.mark.parametrize("number", range(4))
def test_biases_of_rows_are_rates_of_rates(number: int) -> None:
    """(J v)' - J a by differences, for random motions that need not keep the relations."""
    structure = structure_of(3, "loops", number)
    scene: SpaceScene = structure.scene  # type: ignore[assignment]
    given = setting_of(structure, 3, "loops", number, 0).values
    rng, first = np.random.default_rng(number), start_of(scene, given)
    spins = {b.name: rng.normal(size=3) for b in scene.bodies}
    moves = {b.name: rng.normal(size=3) for b in scene.bodies}

    def at(t: float) -> Mechanism:
        state = {}
        for b in scene.bodies:
            s, w, v = first[b.name], spins[b.name], moves[b.name]
            size = float(np.linalg.norm(w))
            q = np.array([math.cos(size * t / 2), *(math.sin(size * t / 2) * w / size)])
            state[b.name] = State(s.position + t * v, axes(q) @ s.axes, v, w)
        return Mechanism(scene, given, state, 0.0)

    h = 1e-5
    before, now, after = at(-h), at(0.0), at(h)
    for c in scene.links:
        for one, row, two in zip(
            before.rows[c.name], now.rows[c.name], after.rows[c.name], strict=True
        ):
            rate = (two.jacobian @ after.speed - one.jacobian @ before.speed) / (2 * h)
            assert row.bias == pytest.approx(rate, abs=1e-6), c
            moved = (two.value - one.value) / (2 * h)
            if c.kind != "helicoidale":
                assert row.jacobian @ now.speed == pytest.approx(moved, abs=1e-6), c


class Falsified:
    """A result with one variable changed."""

    def __init__(self, result: frot.Result, change: Callable[[dict[str, Floats]], None]) -> None:
        self._result, self._change = result, change
        self.time, self.events = result.time, result.events

    def at(self, t: Floats) -> Mapping[str, Floats]:
        now = {name: np.array(x) for name, x in self._result.at(t).items()}
        self._change(now)
        return now

    def __getitem__(self, word: str) -> Floats:
        return self._result[word]


@pytest.fixture(scope="module")
def run() -> frot.Result:
    every = {**values(0.7, 1.3), END: 1.5}
    return frot.compile(pendulum().text()).simulate(tolerance=1e-10, parameters=every)


def scaled(word: str, factor: float) -> Callable[[dict[str, Floats]], None]:
    def change(now: dict[str, Floats]) -> None:
        now[word] *= factor

    return change


def raised(word: str, by: float) -> Callable[[dict[str, Floats]], None]:
    def change(now: dict[str, Floats]) -> None:
        now[word] += by

    return change


CHANGES = (
    (scaled("box.acceleration.x", 1 + 1e-6), "Newton-Euler"),
    (scaled("box.angular_acceleration.y", 1 + 1e-6), "Newton-Euler"),
    (scaled("pin.force.z", 1 + 1e-6), "Newton-Euler"),
    (raised("pin.torque.y", 1e-4), "ideal reaction"),
    (raised("box.position.y", 1e-6), "relation"),
    (raised("box.velocity.y", 1e-6), "relation rate"),
    (raised("box.position.x", 1e-6), "start"),
    (scaled("box.velocity.z", 1 + 1e-5), "integral"),
)


@pytest.mark.parametrize(("change", "kind"), CHANGES)
def test_a_falsified_record_is_refuted(
    run: frot.Result, change: Callable[[dict[str, Floats]], None], kind: str
) -> None:
    setting = Setting(values(0.7, 1.3), 1.5, 1e-10)
    judge = SpaceJudge(pendulum(), setting, Falsified(run, change))  # type: ignore[arg-type]
    found = judge.examine(np.random.default_rng(1))
    assert kind in {f.split(":")[0] for f in found.faults}


def test_a_right_record_has_no_fault(run: frot.Result) -> None:
    setting = Setting(values(0.7, 1.3), 1.5, 1e-10)
    assert not SpaceJudge(pendulum(), setting, run).examine(np.random.default_rng(1)).faults


@pytest.mark.parametrize("family", ["space", "loops"])
def test_random_mechanisms_are_exact(family: str) -> None:
    structure = structure_of(26004, family, 2)
    scene: SpaceScene = structure.scene  # type: ignore[assignment]
    model = frot.compile(scene.text())
    for k in range(6):
        setting = setting_of(structure, 26004, family, 2, k)
        verdict = try_mechanism(model, scene, setting, k, 20.0)
        assert verdict.kind == EXACT, verdict.why
