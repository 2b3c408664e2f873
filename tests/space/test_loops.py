"""Loops in space: cut at any joint they move alike; redundant ones; those that cannot close."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import frot
from tests.space.newton_euler import Link, Place, box, place_of, residual, vector

AXES = ["(0.1, 1, 0.2)", "(1, 0.3, 0)", "(0, 0.2, 1)", "(1, -1, 0.4)"]
AXES += ["(0.3, 1, 1)", "(-0.5, 0.2, 1)", "(1, 1, 1)"]
CORNERS = np.array(
    [
        [0, 0, 0],
        [0.5, 0.1, 0.3],
        [0.9, -0.4, 0.5],
        [1.2, 0.3, 1.0],
        [0.8, 0.9, 0.7],
        [0.3, 0.8, 0.2],
    ]
)


def ring(kind: str, count: int, cut: int, options: list[str], read: str = "") -> str:
    """Bodies from corner to corner and back to the ground; liaison `cut` stands last.

    All frames have the axes of the ground at the start, where every coordinate is zero.
    """
    corners = [np.zeros(3), *(CORNERS[k % 6] * (1 + k // 6) for k in range(1, count))]
    bodies, liaisons, starts = [], [], []
    for k in range(1, count):
        middle = (corners[k - 1] + corners[k]) / 2
        size = ", ".join(str(0.2 + 0.1 * ((k + i) % 3)) for i in range(3))
        bodies.append(f"body b{k}: box(mass = {1 + 0.3 * k} kg, size = ({size}) m);")
        for name, at in (("s", corners[k - 1] - middle), ("e", corners[k] - middle)):
            place = ", ".join(f"{x:.17g}" for x in at)
            bodies.append(f"frame {name}{k} on b{k} at ({place}) m;")
        starts.append(f"guess(b{k}.position = ({', '.join(f'{x:.17g}' for x in middle)}) m);")
    last = ", ".join(f"{x:.17g}" for x in corners[count - 1])
    bodies.append(f"frame far on ground at ({last}) m;")
    ends = ["ground", *(f"e{k}" for k in range(1, count))]
    begins = [*(f"s{k}" for k in range(1, count)), "far"]
    liaisons += [f"liaison J{k}: {kind}({ends[k]}, {begins[k]}{options[k]});" for k in range(count)]
    liaisons = [*liaisons[:cut], *liaisons[cut + 1 :], liaisons[cut]]
    lines = "\n  ".join([*bodies, *liaisons, read])
    return f"""
model Ring "{count} liaisons, cut at the {cut}th"
  {lines}
initial
  {" ".join(starts)}
  experiment(stop = 1 s, tolerance = 1e-11);
end Ring;
"""


LOOPS = {
    "rotoide": (7, [f", axis = {a}" for a in AXES]),
    "prismatique": (7, [f", axis = {a}" for a in AXES]),
    "verrou": (4, [f", axis = {a}" for a in AXES]),
    "cardan": (4, [", axis_a = x, axis_b = y", ", axis_a = y, axis_b = z"] * 2),
    "spherique": (3, ["", "", ""]),
    "appui_plan": (3, [f", normal = {a}" for a in AXES]),
}


# Loops whose reactions equilibrium alone gives.
UNIQUE = ("rotoide", "verrou", "cardan", "spherique")


@pytest.mark.parametrize("kind", LOOPS)
def test_a_loop_moves_alike_wherever_it_is_cut(kind: str) -> None:
    count, options = LOOPS[kind]
    names = [f"b{k}.position" for k in range(1, count)]
    places = []
    for cut in (0, count // 2, count - 1):
        read = f"output Real f = J{cut}.force.x/(1 N); output Real g = J1.torque.y/(1 N.m);"
        result = frot.compile(ring(kind, count, cut, options, read)).simulate()
        places.append(np.concatenate([vector(result.at(1), n) for n in names]))
        energy = result["energy.kinetic"] + result["energy.potential"]
        assert np.ptp(energy) < 1e-9
        assert "f" in result
        if kind in UNIQUE:
            places[-1] = np.append(places[-1], [result.at(1)["g"]])
    assert np.abs(places[0] - places[1]).max() < 1e-9
    assert np.abs(places[0] - places[2]).max() < 1e-9


FOUR_BAR = """
model FourBar "Parallelogram of four rotoides, hyperstatic of degree three"
  parameter Length L = 1 m;
  body left:  rod(mass = 1 kg, length = L);
  body top:   rod(mass = 1 kg, length = L);
  body right: rod(mass = 1 kg, length = L);
  frame far on ground at (L, 0 m, 0 m);
  liaison A: rotoide(ground, left.start, axis = y);
  liaison B: rotoide(left.tip, top.start, axis = y);
  liaison C: rotoide(top.tip, right.tip, axis = y);
  liaison D: rotoide(far, right.start, axis = y);
initial
  left.tip.position  = (0 m, 0 m, L);
  right.tip.position = (L, 0 m, L);
  left.tip.velocity.x = 1 m/s;
  experiment(stop = 3 s, tolerance = 1e-11);
end FourBar;
"""


def crank(stop: float) -> float:
    """The angle of the cranks: two thirds and one kg.m^2, weights at half and at the whole."""

    def rate(t: float, x: np.ndarray) -> list[float]:
        return [x[1], 2 * 9.81 * np.sin(x[0]) / (5 / 3)]

    found = solve_ivp(rate, (0, stop), [0, 1], method="DOP853", rtol=1e-13, atol=1e-14)
    return float(found.y[0, -1])


def test_a_hyperstatic_parallelogram_moves_as_its_one_crank() -> None:
    """Ten times through flat postures, where its relations do not tell how it goes on."""
    model = frot.compile(FOUR_BAR)
    for tolerance, error in ((1e-4, 2e-2), (1e-6, 3e-4), (1e-9, 1e-7), (1e-11, 2e-9)):
        result = model.simulate(stop=10, tolerance=tolerance)
        for t in (0.65, 1, 3, 10):
            angle = crank(t)
            tip = vector(result.at(t), "left.position") * 2
            assert tip == pytest.approx([np.sin(angle), 0, np.cos(angle)], abs=error)
        assert result.figures.crossings == 10
        assert result.figures.steps < 400
    assert "10 passages through postures" in result.summary()


BRICARD = """
model Bricard "Six pins on the edges of a cube: one motion, where a count says none"
  parameter Mass m = 1 kg;
  body b1: box(mass = m, size = (1, 0.1, 0.1) m);
  body b2: box(mass = m, size = (0.1, 1, 0.1) m);
  body b3: box(mass = m, size = (0.1, 0.1, 1) m);
  body b4: box(mass = m, size = (1, 0.1, 0.1) m);
  body b5: box(mass = m, size = (0.1, 1, 0.1) m);
  world(down = -y);
  frame a1 on b1 at (-0.5, 0, 0) m;
  frame c1 on b1 at (0.5, 0, 0) m;
  frame a2 on b2 at (0, 0.5, 0) m;
  frame c2 on b2 at (0, -0.5, 0) m;
  frame a3 on b3 at (0, 0, -0.5) m;
  frame c3 on b3 at (0, 0, 0.5) m;
  frame a4 on b4 at (0.5, 0, 0) m;
  frame c4 on b4 at (-0.5, 0, 0) m;
  frame a5 on b5 at (0, -0.5, 0) m;
  frame c5 on b5 at (0, 0.5, 0) m;
  frame far on ground at (0, 0, 1) m;
  liaison J1: rotoide(ground, a1, axis = y);
  liaison J2: rotoide(c1, a2, axis = z);
  liaison J3: rotoide(c2, a3, axis = x);
  liaison J4: rotoide(c3, a4, axis = y);
  liaison J5: rotoide(c4, a5, axis = z);
  liaison J6: rotoide(c5, far, axis = x);
  {read}
initial
  guess(b1.position = (0.5, 0, 0) m);
  experiment(stop = 10 s, tolerance = 1e-11);
end Bricard;
"""


BARS = [box(f"b{k}", 1, tuple(1 if k % 3 == i else 0.1 for i in (1, 2, 0))) for k in range(1, 6)]
ENDS = {
    "a": [(-0.5, 0, 0), (0, 0.5, 0), (0, 0, -0.5), (0.5, 0, 0), (0, -0.5, 0)],
    "c": [(0.5, 0, 0), (0, -0.5, 0), (0, 0, 0.5), (-0.5, 0, 0), (0, 0.5, 0)],
}


def test_bricards_loop_moves_with_its_energy_and_by_newton_and_euler() -> None:
    read = " ".join(f"output Real r{k} = J{k}.force.x/(1 N);" for k in range(1, 7))
    result = frot.compile(BRICARD.replace("{read}", read)).simulate()
    energy = result["energy.kinetic"] + result["energy.potential"]
    assert np.ptp(energy) < 1e-9
    assert np.ptp(result["b3.position.y"]) > 0.2
    begins = [Place(None, (0, 0, 0)), *(Place(f"b{k + 1}", p) for k, p in enumerate(ENDS["c"]))]
    ends = [*(Place(f"b{k + 1}", p) for k, p in enumerate(ENDS["a"])), Place(None, (0, 0, 1))]
    links = [Link(f"J{k + 1}", a, b) for k, (a, b) in enumerate(zip(begins, ends, strict=True))]
    down = np.array([0, -9.81, 0])
    times = (0.0, 0.7, 2.5, 6.1, 10.0)
    assert residual(result, BARS, links, times, gravity=down) < 1e-9
    for t in times:
        at = result.at(t)
        for a, b in zip(begins, ends, strict=True):
            assert place_of(at, a) == pytest.approx(place_of(at, b), abs=1e-12)


def test_a_loop_that_cannot_close_is_told_with_its_liaison() -> None:
    model = FOUR_BAR.replace("at (L, 0 m, 0 m)", "at (5*L, 0 m, 0 m)").replace(
        "  left.tip.position  = (0 m, 0 m, L);\n  right.tip.position = (L, 0 m, L);\n", ""
    )
    with pytest.raises(frot.SimulationError, match="liaison"):
        frot.compile(model).simulate()
