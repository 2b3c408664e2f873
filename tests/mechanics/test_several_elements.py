"""Several friction elements at once, loops, lines carried by bodies."""

from __future__ import annotations

import math

import numpy as np
import pytest
from closed_forms import block_on_slope, coulomb_oscillator, oscillator_at
from mechanical_scenes import (
    BAR,
    DUMBBELL,
    FIVE_BLOCKS,
    GROOVE,
    LIFTED,
    PAINLEVE_ROD,
    PARALLEL,
    SLOPES,
    SWUNG_ROD,
    TURNED_REACTION,
    TWO_BLOCKS,
    WEDGE_AND_BEAD,
    WEDGE_AND_HOOP,
    Scenes,
    near,
    rests_from,
    row,
    rows,
)
from scipy.linalg import expm
from scipy.optimize import brentq

import frot

STOP = ", on_indeterminate = stop, on_impasse = stop"


@pytest.mark.parametrize("mu", [0.05, 0.2, 0.33])
def test_mirror_images_on_one_line_stop_at_the_same_instant(scenes: Scenes, mu: float) -> None:
    """The stretch of the spring is a Coulomb oscillator of stiffness 2 k."""
    m, k, stretch = 1.0, 30.0, 1.0
    times, places = coulomb_oscillator(m, 2 * k, 0.0, 2 * mu * m * 9.81, stretch)
    stop = times[-1] + 1.0
    result = scenes.run(TWO_BLOCKS, mu=mu, stop=stop)
    assert [e.time for e in result.events[::2]] == [e.time for e in result.events[1::2]]
    assert {(a.liaison, b.liaison) for a, b in zip(*[iter(result.events)] * 2, strict=True)} <= {
        ("left", "right"),
        ("right", "left"),
    }
    assert len(result.events) == 2 * (len(times) - 1)
    for event, t in zip(result.events[::2], times[1:], strict=True):
        assert near(event.time, t)
    for t in np.linspace(0, stop, 41):
        now = result.at(t)
        apart = float(now["b.position.x"] - now["a.position.x"]) - 1.0
        assert near(apart, oscillator_at(t, m, 2 * k, 0, times, places)[0], scale=stretch)
        assert abs(float(now["b.position.x"] + now["a.position.x"])) < 1e-12
    assert rests_from(result, result.events[-1].time, "a")
    assert rests_from(result, result.events[-1].time, "b")


def test_mirror_images_on_two_lines_stop_at_the_same_instant(scenes: Scenes) -> None:
    """The spring lies across: it loads one contact and lifts the other; without weight alike."""
    result = scenes.run(TWO_BLOCKS, apart=0.5, mu=0.1, stop=3.0)
    assert result.balance.relative < 1e-9
    for name in ("left", "right"):
        values = result.at(np.linspace(0, 3, 400))
        bound = 0.1 * np.abs(values[f"{name}.normal_force"])
        assert np.all(np.abs(values[f"{name}.tangential_force"]) <= bound * (1 + 1e-9) + 1e-12)


class PiecewiseLinear:
    """Particles on lines, zero-length springs between neighbours, Coulomb friction, gravity.

    In each vector of signs the motion is affine; it is followed by the matrix exponential, and the
    zeros of the speeds are found on it by bisection.
    """

    def __init__(self, slopes: tuple[float, ...], k: float, mu: float, g: float) -> None:
        n = len(slopes)
        self.n, self.mu = n, mu
        self.mass = np.array([1 + 0.25 * i for i in range(n)])
        e = np.array([[math.cos(a), math.sin(a)] for a in slopes])
        normal = np.array([[-math.sin(a), math.cos(a)] for a in slopes])
        base = np.array([[0.2 * i, 0.05 * i] for i in range(n)])
        weight = np.outer(self.mass, [0, -g])
        laplace = np.zeros((n, n))
        for i in range(n - 1):
            laplace[[i, i + 1, i, i + 1], [i, i + 1, i + 1, i]] += [k, k, -k, -k]
        # the force on i is weight - sum_j laplace_ij (base_j + s_j e_j)
        self.along = -laplace * (e @ e.T)
        self.along0 = np.einsum("ij,ij->i", e, weight - laplace @ base)
        self.across = laplace * (normal @ e.T)
        self.across0 = -np.einsum("ij,ij->i", normal, weight - laplace @ base)

    def system(self, signs: np.ndarray) -> np.ndarray:
        """Matrix of (s, v, 1)' with friction -sign mu N; a zero sign holds the particle."""
        n, a = self.n, np.zeros((2 * self.n + 1, 2 * self.n + 1))
        moves = (signs != 0).astype(float)
        a[:n, n : 2 * n] = np.diag(moves)
        rate = moves / self.mass
        a[n : 2 * n, :n] = rate[:, None] * (self.along - (signs * self.mu)[:, None] * self.across)
        a[n : 2 * n, -1] = rate * (self.along0 - signs * self.mu * self.across0)
        return a

    def forces(self, s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return self.along @ s + self.along0, self.across @ s + self.across0

    def run(self, s: np.ndarray, stop: float) -> tuple[list[tuple[float, int]], np.ndarray]:
        n, t, events = self.n, 0.0, []
        y = np.concatenate([s, np.zeros(n), [1.0]])
        pull, press = self.forces(s)
        signs = np.where(np.abs(pull) > self.mu * press, np.sign(pull), 0.0)
        while True:
            a = self.system(signs)
            found, step = None, 2e-3
            nudge, leap, d = expm(a * 1e-9), expm(a * step), 0.0
            now = y
            while t + d < stop and found is None:
                after = leap @ now
                ends = (1e-9, nudge @ now), (step, after)
                first = [self._zero(a, now, ends, i, signs) for i in range(n)]
                if any(x is not None for x in first):
                    found = min((x, i) for i, x in enumerate(first) if x is not None)
                else:
                    now, d = after, d + step
            if found is None:
                return events, expm(a * (stop - t)) @ y
            y, t = expm(a * found[0]) @ now, t + d + found[0]
            i = found[1]
            y[n + i] = 0.0
            pull, press = self.forces(y[:n])
            assert np.all(press > 0)
            was = signs[i]
            signs = signs.copy()
            if was == 0:
                signs[i] = np.sign(pull[i])
            else:
                signs[i] = np.sign(pull[i]) if abs(pull[i]) > self.mu * press[i] else 0.0
            events.append((t, i))

    def _zero(self, a, y, ends, i, signs) -> float | None:
        """Time inside the step at which particle i stops or lets go.

        `ends`: soon after the begin of the step and at its end, the time and the state.
        """
        n = self.n

        def value(z: np.ndarray) -> float:
            if signs[i] != 0:
                return signs[i] * z[n + i]
            pull, press = self.forces(z[:n])
            return self.mu * press[i] - abs(pull[i])

        (soon, early), (end, late) = ends
        if value(late) >= 0 or value(early) <= 0:
            return None
        return brentq(lambda d: value(expm(a * d) @ y), soon, end, xtol=1e-15, rtol=1e-15)


def test_five_blocks_on_five_slopes_stop_and_start_each_at_its_time(scenes: Scenes) -> None:
    """Springs without length make the motion affine between events: matrix exponentials."""
    stop = 6.0
    reference = PiecewiseLinear(SLOPES, 8.0, 0.15, 9.81)
    events, end = reference.run(np.array([0.9, -0.7, 0.4, -1.1, 0.6]), stop)
    result = scenes.run(FIVE_BLOCKS, stop=stop)
    assert len(events) > 10
    assert [e.liaison for e in result.events] == [f"l{i}" for _, i in events]
    for event, (t, _) in zip(result.events, events, strict=True):
        assert abs(event.time - t) < 1e-10 * stop
    for i in range(5):
        assert abs(float(result[f"l{i}.abscissa"][-1]) - end[i]) < 1e-10
        assert abs(float(result[f"l{i}.slip"][-1]) - end[5 + i]) < 1e-9
    assert result.balance.relative < 1e-9


def test_a_hoop_slides_on_a_moving_wedge_with_painleves_accelerations(scenes: Scenes) -> None:
    """Painlevé 1895, p. 103-104."""
    p, e = row("wedge_hoop-1")["parameters"], row("wedge_hoop-1")["expected"]
    result = scenes.run(WEDGE_AND_HOOP, g=p["g"], M=p["M"], C=p["C"], f=p["f"], r=0.3)
    now = result.at(np.linspace(0, 1, 11))
    assert np.allclose(now["side.normal_force"], e["R_n"], rtol=1e-12, atol=0)
    assert np.allclose(now["wedge.acceleration.x"], e["wedge_xdd"], rtol=1e-12, atol=0)
    assert np.allclose(-0.3 * now["hoop.angular_acceleration"], e["r_theta_dd"], rtol=1e-12, atol=0)
    # xi runs down the slope, from the wedge
    apart = now["hoop.acceleration.x"] - now["wedge.acceleration.x"]
    assert np.allclose(apart / math.cos(p["C"]), e["xi_dd"], rtol=1e-12, atol=0)
    assert np.max(np.abs(now["side.gap"])) < 1e-13
    assert result.balance.relative < 1e-12


@pytest.mark.parametrize("share", [0.99, 1.01])
def test_a_hoop_on_a_moving_wedge_rolls_from_painleves_coefficient_on(
    scenes: Scenes, share: float
) -> None:
    """Painlevé 1895, p. 104: it rolls at once, without slip, from f_roll on."""
    p, e = row("wedge_hoop-1")["parameters"], row("wedge_hoop-1")["expected"]
    result = scenes.run(WEDGE_AND_HOOP, g=p["g"], M=p["M"], C=p["C"], f=share * e["f_roll"], v0=0.0)
    assert result.events == ()
    modes = set(result["side.mode"].tolist())
    assert modes == ({1.0} if share > 1 else {2.0})
    assert (np.max(np.abs(result["side.slip"])) < 1e-13) == (share > 1)


def test_a_bead_on_a_wedge_that_rubs_on_the_ground(scenes: Scenes) -> None:
    """Newton's equations of both with N and N' unknown, solved for the constant accelerations."""
    M, C, f, fg, g = 2.0, 0.6, 0.1, 0.05, 9.81
    c, s = math.cos(C), math.sin(C)
    # unknowns: X'' (wedge), u'' (bead on the slope), N (slope on bead), R (ground on wedge);
    # the wedge is driven to the left (X' < 0), the bead goes down: friction opposes both
    a = np.array(
        [
            [1.0, c, -s + f * c, 0.0],
            [0.0, -s, -c - f * s, 0.0],
            [M, 0.0, s - f * c, -fg],
            [0.0, 0.0, c + f * s, -1.0],
        ]
    )
    X, u, N, R = np.linalg.solve(a, [0.0, -g, 0.0, -M * g])
    assert X < 0 < u and N > 0 and R > 0
    result = scenes.run(WEDGE_AND_BEAD, M=M, C=C, f=f, f_ground=fg)
    assert result.events == ()
    now = result.at(np.linspace(0.01, 1, 10))
    t = np.linspace(0.01, 1, 10)
    assert np.allclose(now["wedge.position.x"], X * t**2 / 2, rtol=1e-12, atol=0)
    assert np.allclose(now["side.slip"], 1 + u * t, rtol=1e-12, atol=0)
    assert np.allclose(now["side.normal_force"], N, rtol=1e-12, atol=0)
    assert np.allclose(now["floor.normal_force"], R, rtol=1e-12, atol=0)
    assert result.balance.relative < 1e-12


BAR_IMAGES = {
    "first quadrant": ("th0", "w0", 1),
    "seen from behind": ("180 deg - th0", "-w0", -1),
    "upside down": ("-th0", "-w0", -1),
    "half a turn on": ("th0 - 180 deg", "w0", 1),
}


@pytest.mark.parametrize("image", BAR_IMAGES)
@pytest.mark.parametrize("name", [r["id"] for r in rows("bar_two_lines")])
def test_a_bar_on_two_rough_lines_turns_as_painleve_p_95_says(
    scenes: Scenes, name: str, image: str
) -> None:
    """The rate at an angle does not depend on mass or length; a loop of two bilateral liaisons."""
    p, e = row(name)["parameters"], row(name)["expected"]
    angle, rate, sense = BAR_IMAGES[image]
    result = scenes.run(
        BAR.format(angle=angle, rate=rate),
        f=p["f"],
        f1=p["f1"],
        th0=p["th0"],
        w0=p["thd0"],
        m=3.0,
        length=0.7,
    )
    first = result.at(0.0)["bar.angle"]

    def turned(t: float) -> float:
        return sense * float(result.at(t)["bar.angle"] - first) - (p["th"] - p["th0"])

    t = brentq(turned, 0, result.time[-1], xtol=1e-15)
    assert near(sense * float(result.at(t)["bar.angular_velocity"]), e["theta_dot"])
    switches = [
        p["th0"] + sense * float(result.at(v.time)["bar.angle"] - first)
        for v in result.events
        if v.time < t
    ]
    assert switches == pytest.approx(e["switches"], rel=1e-10)
    assert result.balance.relative < 1e-9
    assert np.max(np.abs(result.at(np.linspace(0, 6, 300))["b.gap"])) < 1e-11


def test_a_bar_on_lines_turned_by_any_angle_moves_alike(scenes: Scenes) -> None:
    p, e = row("bar_two_lines-2")["parameters"], row("bar_two_lines-2")["expected"]
    for turn in (0.3, -1.0, 2.0, math.pi):
        result = scenes.run(BAR.format(angle="th0", rate="w0"), turn=turn)

        def turned(t: float, result=result, turn=turn) -> float:
            return float(result.at(t)["bar.angle"]) - turn - p["th"]

        t = brentq(turned, 0, result.time[-1], xtol=1e-15)
        assert near(float(result.at(t)["bar.angular_velocity"]), e["theta_dot"])


def test_a_dumbbell_on_a_rough_line_has_painleves_accelerations(scenes: Scenes) -> None:
    """Painlevé 1895, p. 13-16: f < 2 sqrt(2), one motion."""
    p, (e,) = (
        row("dumbbell_acceleration-1")["parameters"],
        row("dumbbell_acceleration-1")["expected"],
    )
    result = scenes.run(
        DUMBBELL.format(option=""), f=p["f"], th=p["th"], w0=p["thd"], v0=p["xd"], r=p["r"]
    )
    now = result.at(0.0)
    assert near(float(now["points.angular_acceleration"]), e["theta_dd"])
    assert near(float(now["guide.normal_force"]), e["R_y"])
    # x'' of the point on the line
    angle, alpha = p["th"], e["theta_dd"]
    arm = p["r"] / 2
    x_dd = float(now["points.acceleration.x"]) + arm * (
        alpha * math.sin(angle) + p["thd"] ** 2 * math.cos(angle)
    )
    assert near(x_dd, e["x_dd"])


def test_a_dumbbell_with_two_motions_is_reported_and_with_none_is_refused(scenes: Scenes) -> None:
    """Painlevé 1895, p. 13-16: f = 3.2 > 2 sqrt(2)."""
    p = row("dumbbell_acceleration-2")["parameters"]
    given = {"f": p["f"], "th": p["th"], "w0": p["thd"], "r": p["r"]}
    with pytest.raises(frot.FrotError, match=r"E0902.*2 motions"):
        scenes.run(DUMBBELL.format(option=STOP), v0=1.0, **given)
    with pytest.raises(frot.FrotError, match=r"E0902.*no admissible motion"):
        scenes.run(DUMBBELL.format(option=STOP), v0=-1.0, **given)


@pytest.mark.parametrize("sense", (1, -1))
def test_two_points_on_parallel_lines_have_painleves_accelerations(
    scenes: Scenes, sense: int
) -> None:
    """Painlevé 1895, p. 36 and 93-94: R along the rod, x'' by f and f1."""
    p, e = row("parallel_lines-1")["parameters"], row("parallel_lines-1")["expected"]
    (motion,) = e["x'>0" if sense > 0 else "x'<0"]
    result = scenes.run(
        PARALLEL.format(option=""),
        f=p["f"],
        f1=p["f1"],
        alpha=p["alpha"],
        X=p["X"],
        X1=p["X1"],
        v0=float(sense),
    )
    now = result.at(0.0)
    assert near(float(now["rod.acceleration.x"]), motion["xdd"])
    assert near(abs(float(now["low.normal_force"])), abs(motion["R"]) * math.sin(p["alpha"]))
    assert near(float(now["low.normal_force"]), -float(now["high.normal_force"]), scale=motion["R"])


def test_two_points_on_parallel_lines_past_the_limit_are_told(scenes: Scenes) -> None:
    """parallel_lines-2: two motions for x' > 0, none for x' < 0 (Painlevé 1895, p. 94)."""
    p = row("parallel_lines-2")["parameters"]
    given = {n: p[n] for n in ("f", "f1", "alpha", "X", "X1")}
    with pytest.raises(frot.FrotError, match=r"E0902.*2 motions"):
        scenes.run(PARALLEL.format(option=STOP), v0=1.0, **given)
    with pytest.raises(frot.FrotError, match=r"E0902.*no admissible motion"):
        scenes.run(PARALLEL.format(option=STOP), v0=-1.0, **given)


@pytest.mark.parametrize("name", [r["id"] for r in rows("rod_acceleration")])
def test_the_painleve_rod_slides_parts_or_jams_as_the_theory_says(
    scenes: Scenes, name: str
) -> None:
    """Painlevé 1895, p. 99: y'' of the tip = p lambda + b."""
    p, e = row(name)["parameters"], row(name)["expected"]
    given = {"f": p["f"], "th": p["th"], "w0": p["thd"], "v0": p["slip"], "l": p["l"]}
    text = PAINLEVE_ROD.format(option=STOP)
    if e["case"] == "inconsistent":
        with pytest.raises(frot.FrotError, match=r"E0902.*no admissible motion"):
            scenes.run(text, **given)
    elif e["case"] == "indeterminate":
        with pytest.raises(frot.FrotError, match=r"E0902.*2 motions"):
            scenes.run(text, **given)
    else:
        result = scenes.run(text, **given)
        now = result.at(0.0)
        if e["R_n"] is None:
            assert now["tip.mode"] == 0
            assert now["tip.normal_force"] == 0.0
        else:
            assert now["tip.mode"] == 2
            assert near(float(now["tip.normal_force"]), e["R_n"])


def test_several_motions_at_the_start_are_an_event_of_the_result(scenes: Scenes) -> None:
    """LANGUAGE section 6: each such instant is an event; rod_acceleration-3 under `rest`."""
    p = row("rod_acceleration-3")["parameters"]
    result = scenes.run(PAINLEVE_ROD.format(option=""), f=p["f"], th=p["th"], w0=p["thd"])
    assert [(e.kind, e.time) for e in result.events][:1] == [("several", 0.0)]


@pytest.mark.parametrize("sense", (1, -1))
@pytest.mark.parametrize("delta", (0.0, 0.02))
def test_a_hoop_spinning_in_a_groove_stops_and_stays(
    scenes: Scenes, sense: int, delta: float
) -> None:
    """Both contacts slide: two forces and the couple turn it; then rest with both held."""
    mu, beta, w0, r, g = 0.3, 0.6, 20.0, 0.5, 9.81
    # spin counter-clockwise: the rim moves along each line's direction, friction against it
    c, s = math.cos(beta), math.sin(beta)
    a = np.array([[s - mu * c, -s - mu * c], [c + mu * s, c - mu * s]])
    n = np.linalg.solve(a, [0.0, g])
    rate = (mu * r * n.sum() + delta * n.sum()) / r**2
    result = scenes.run(GROOVE, w0=sense * w0, delta=delta, stop=6.0)
    now = result.at(0.0)
    pressed = sorted((float(now["a.normal_force"]), float(now["b.normal_force"])))
    assert pressed == pytest.approx(sorted(n.tolist()), rel=1e-12)
    assert result.events
    assert all(near(e.time, w0 / rate) for e in result.events)
    assert rests_from(result, result.events[-1].time, "hoop")
    assert near(float(result["hoop.angle"][-1]), sense * w0**2 / (2 * rate))
    assert result.balance.relative < 1e-12


def test_a_hoop_laid_in_a_groove_rests_for_ever(scenes: Scenes) -> None:
    """Four unknown reactions, three equations: hyperstatic, and nothing moves by one bit."""
    result = scenes.run(GROOVE, stop=1000.0)
    assert result.events == ()
    assert rests_from(result, 0.0, "hoop")
    assert near(float(result["a.force.y"][-1] + result["b.force.y"][-1]), 9.81, rel=1e-12)


@pytest.mark.parametrize("m", [0.5, 1.0, 1.7])
def test_a_ring_leaves_the_ground_when_the_lift_reaches_its_weight(
    scenes: Scenes, m: float
) -> None:
    """N = m g - c t; sliding x'' = -mu N/m until it rolls (v = v0/2); parts at t = m g/c."""
    g, c, mu, v0, r = 9.81, 5.0, 0.2, 3.0, 0.3
    result = scenes.run(LIFTED, m=m, rate=c, mu=mu, v0=v0, r=r, stop=m * g / c + 1.0)
    # the slip v0 - 2 mu (g t - c t^2/2m) is zero at t_roll, if it ever is
    root = g**2 - v0 * c / (mu * m)
    lost = v0 / 2 if root > 0 else mu * g**2 * m / (2 * c)
    assert [e.kind for e in result.events] == ["stick"] * (root > 0) + ["separation"]
    if root > 0:
        assert near(result.events[0].time, (g - math.sqrt(root)) * m / c)
    assert near(result.events[-1].time, m * g / c)
    end = result.at(m * g / c + 1.0)
    assert near(float(end["floor.gap"]), c / (6 * m))
    assert near(float(end["ring.velocity.x"]), v0 - lost)
    assert near(float(end["ring.angular_velocity"]), -lost / r)


@pytest.mark.parametrize("load", [(0.0, 5.0), (0.0, 9.81), (19.62, -5.0), (19.62, -9.81), (0, 7.7)])
@pytest.mark.parametrize("v0", (6.0, -6.0))
def test_the_reaction_of_a_tube_changes_sides_and_friction_goes_on(
    scenes: Scenes, load: tuple[float, float], v0: float
) -> None:
    """x'' = -mu |m g - P| sgn x' with P = P0 + c t: |N| falls to zero at t0 and grows again."""
    m, g, mu, stop = 1.0, 9.81, 0.2, 3.0
    before, rate = load
    t0 = (m * g - before) / rate
    result = scenes.run(TURNED_REACTION, before=before, rate=rate, v0=v0, mu=mu, stop=stop)
    assert [e.kind for e in result.events] == ["reaction"]
    assert near(result.events[0].time, t0)
    lost = mu * abs(rate) / m * (t0**2 + (stop - t0) ** 2) / 2
    assert near(float(result["tube.slip"][-1]), math.copysign(abs(v0) - lost, v0))
    assert result.balance.relative < 1e-9


def test_two_blocks_on_different_slopes_without_coupling_do_not_disturb_each_other(
    scenes: Scenes,
) -> None:
    """A spring of no stiffness: each follows the block of Painlevé 1895, p. 58."""
    result = scenes.run(FIVE_BLOCKS, k=0.0, stop=2.0)
    for i, slope in enumerate(SLOPES):
        motion = block_on_slope(0.0, -9.81 * math.sin(slope), 0.15 * 9.81 * math.cos(slope), 2.0)
        s0 = (0.9, -0.7, 0.4, -1.1, 0.6)[i]
        assert near(
            float(result[f"l{i}.abscissa"][-1]) - s0, motion.at(2.0)[0], scale=10, rel=1e-13
        )
        assert near(float(result[f"l{i}.slip"][-1]), motion.at(2.0)[1], scale=10, rel=1e-13)


@pytest.mark.parametrize("length", [0.01, 0.1, 1.0, 10.0])
@pytest.mark.parametrize("degrees", [-30.0, 30.0, 80.0, -100.0])
def test_a_rod_let_go_at_rest_on_a_smooth_line_keeps_its_energy_and_its_centre(
    scenes: Scenes, length: float, degrees: float
) -> None:
    """(1/12 + cos^2/4) l^2 w^2 + g l sin = const; G moves on a vertical: a whole run from rest."""
    th = math.radians(degrees)
    result = scenes.run(SWUNG_ROD, length=length, th=th, tolerance=1e-12)
    angle, w = result["rod.angle"], result["rod.angular_velocity"]
    square = 9.81 / length * (math.sin(th) - np.sin(angle)) / (1 / 12 + np.cos(angle) ** 2 / 4)
    assert np.max(np.abs(w**2 - square)) < 1e-9 * 9.81 / length
    assert np.max(np.abs(result["rod.position.x"] - length / 2 * math.cos(th))) < 1e-10 * length
    assert np.max(np.abs(w)) > 1 / math.sqrt(length)  # it has swung
    assert result.balance.relative < 1e-9


@pytest.mark.parametrize("mu", [0.1, 0.3, 0.6])
@pytest.mark.parametrize("degrees", [-30.0, 30.0, 80.0, -80.0])
def test_a_rod_let_go_at_rest_on_a_rough_line_keeps_the_balance_of_energy(
    scenes: Scenes, mu: float, degrees: float
) -> None:
    result = scenes.run(SWUNG_ROD, mu=mu, th=math.radians(degrees), stop=1.0)
    assert result.balance.relative < 1e-9
    assert np.all(result["guide.power"] <= 1e-12)


def test_balance_is_told_against_the_largest_energy_of_the_run(scenes: Scenes) -> None:
    """A smooth oscillator stopped at a turning point: 15 J swing, the scale keeps them."""
    result = scenes.run(TWO_BLOCKS, mu=0.0, stop=20 * math.pi / math.sqrt(60))
    assert result.balance.scale > 1.0
    assert result.balance.relative < 1e-9
