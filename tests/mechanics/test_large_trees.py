"""Large trees of bodies: the recursion along them, and the mass matrix written out, agree."""

import random
import re
from collections.abc import Callable

import numpy as np
import pytest
from frot.compiler import driver
from frot.compiler.mechanics import dynamics
from frot.compiler.product import reroll
from frot.dsl import Log, compile_text

import frot

CHAIN = """
planar model Chain "Rods pinned to one another"
  parameter Integer n = {n};
  body b[n]: rod(mass = 1 kg, length = 1 m);
  liaison o: rotoide(ground, b[1].start);
  liaison j[n - 1]: rotoide(b[1:n - 1].tip, b[2:n].start);
initial
  o.angle = {first} rad;
  o.speed = 0.5 rad/s;
  for i in 1:n - 1 loop
    j[i].angle = 0.4*sin(1.7*i);
    j[i].speed = cos(0.9*i)*(1 rad/s);
  end for;
  experiment(stop = 1 s, tolerance = {tolerance});
end Chain;
"""


def chain_accelerations(angle: np.ndarray, rate: np.ndarray) -> np.ndarray:
    """Of n equal rods (1 kg, 1 m) by Lagrange's equations in angles to the ground."""
    n = len(angle)
    beyond = n - np.arange(n) - 0.5  # masses that a rod carries at its tip, and half its own
    turned = np.subtract.outer(angle, angle)
    coupling = np.minimum.outer(beyond, beyond)
    mass = coupling * np.cos(turned)
    mass[np.diag_indices(n)] = beyond - 0.5 + 1 / 3
    return np.linalg.solve(
        mass, -(coupling * np.sin(turned)) @ rate**2 - 9.81 * np.cos(angle) * beyond
    )


@pytest.mark.parametrize("n", [30, 100])
def test_accelerations_of_a_chain(n: int) -> None:
    joints = np.arange(1, n)
    angle = 0.3 + np.concatenate(([0], np.cumsum(0.4 * np.sin(1.7 * joints))))
    rate = 0.5 + np.concatenate(([0], np.cumsum(np.cos(0.9 * joints))))
    result = frot.compile(CHAIN.format(n=n, first=0.3, tolerance=1e-9)).simulate(stop=1e-3)
    found = [result[f"b[{k + 1}].angular_acceleration"][0] for k in range(n)]
    exact = chain_accelerations(angle, rate)
    assert found == pytest.approx(exact, abs=1e-12 * np.abs(exact).max())


BY_BODIES = """
planar model ByBodies "The same chain, stated by its bodies from the tip on"
  parameter Integer n = {n};
  parameter Angle lean = 0.2 rad;
  body b[n]: rod(mass = 1 kg, length = 1 m);
  liaison o: rotoide(ground, b[1].start){law};
  liaison j[n - 1]: rotoide(b[1:n - 1].tip, b[2:n].start){law};
initial
  for i in 1:n loop
    b[n + 1 - i].angle = lean*(n + 1 - i) + 1 rad;
    b[n + 1 - i].angular_velocity = (n + 1 - i)*(0.3 rad/s);
  end for;
  experiment(stop = 1 s, tolerance = 1e-9);
end ByBodies;
"""


@pytest.mark.parametrize("law", ["", " with coulomb(0.1, radius = 1 mm)"])
def test_what_is_stated_of_bodies_is_solved_one_by_one(law: str) -> None:
    n, log = 12, Log()
    text = BY_BODIES.format(n=n, law=law)
    model = compile_text(text, log)
    assert model is not None
    lowered = driver.lowered_of(model, log)
    assert lowered is not None
    for part, _ in (*lowered.shared.parts, *lowered.shared.speed_parts):
        assert not part.stated, "no system is left for the kernel"
    start = frot.compile(text).simulate(stop=1e-3, parameters={"lean": -0.1})
    for k in range(1, n + 1):
        assert start[f"b[{k}].angle"][0] == pytest.approx(1 - 0.1 * k, abs=1e-14)
        assert start[f"b[{k}].angular_velocity"][0] == pytest.approx(0.3 * k, rel=1e-14)


def test_one_statement_too_many_is_told_where_others_are_solved_one_by_one() -> None:
    more = "  j[2].angle = 0.3 rad;\n  experiment("
    text = BY_BODIES.format(n=4, law="").replace("  experiment(", more)
    with pytest.raises(frot.FrotError, match=r"j\[2\].angle = 0.3 rad|b\[[23]\].angle"):
        frot.compile(text).simulate()


def test_rolled_code_gives_the_same_bits(monkeypatch: pytest.MonkeyPatch) -> None:
    text = CHAIN.format(n=25, first=0.3, tolerance=1e-9)
    rolled, straight = [], []
    for least, results in ((400, rolled), (10**9, straight)):
        monkeypatch.setattr(reroll, "LEAST", least)
        program = frot.compile(f"// {least}\n{text}")
        results.append(program.simulate(stop=0.2))
        loops = (program.program().folder / "model.c").read_text().count("r<")
        assert (loops > 4) == (least == 400)
    assert all(np.array_equal(rolled[0][name], straight[0][name]) for name in straight[0])


def test_code_grows_with_kinds_of_bodies_not_with_their_number() -> None:
    lines, statements = [], []
    for n in (60, 120):
        log = Log()
        model = compile_text(CHAIN.format(n=n, first=0.3, tolerance=1e-9), log)
        assert model is not None
        lowered = driver.lowered_of(model, log)
        assert lowered is not None
        lines.append(driver.text_of(lowered, "key").count("\n"))
        statements.append(sum(f.n_instructions() for f in lowered.whole.functions.values()))
    assert lines[1] < 1.2 * lines[0]
    assert statements[1] < 2.1 * statements[0]


def plane(rng: random.Random, count: int) -> str:
    """A random tree in the plane: rods on pins and slides, some with friction, forces on them."""
    lines, starts = [], []
    for k in range(1, count + 1):
        mass = rng.choice([1e-3, 1, 50])
        lines.append(f"body b{k}: rod(mass = {mass} kg, length = {rng.uniform(0.2, 2):.3f} m);")
        base = "ground" if k == 1 else f"b{rng.randint(max(1, k - 3), k - 1)}.tip"
        ends = [base, f"b{k}.start"]
        rng.shuffle(ends)
        kind = rng.choice(["rotoide"] * 3 + ["prismatique"])
        options = ", axis = (0.6, 0.8)" if kind == "prismatique" else ""
        law = " with coulomb(mu = 0.2, radius = 1 cm)" if k == 3 and kind == "rotoide" else ""
        lines.append(f"liaison l{k}: {kind}({ends[0]}, {ends[1]}{options}){law};")
        unit, name = ("rad", "angle") if kind == "rotoide" else ("m", "displacement")
        starts.append(f"l{k}.{name} = {rng.uniform(-1, 1):.3f} {unit};")
        starts.append(f"l{k}.speed = {rng.uniform(-1, 1):.3f} {unit}/s;")
    lines.append(f"force s: spring((1, 1) m, b{count}.tip, k = 30 N/m, length = 0.3 m);")
    lines.append("force d: damper(b1.tip, b4.tip, c = 2 N.s/m);")
    lines.append("force w: drag(b5.tip, c = 0.3 N.s/m);")
    lines.append("force t: couple(b2, value = 3 N.m);")
    return _text("planar model", lines, starts)


def space(rng: random.Random, count: int) -> str:
    """A random tree in space: boxes on joints of every kind that coordinates keep."""
    lines, starts = [], []

    def three(size: float) -> str:
        return ", ".join(f"{rng.uniform(-size, size):.3f}" for _ in range(3))

    for k in range(1, count + 1):
        lines.append(f"body b{k}: box(mass = {rng.choice([0.01, 1, 7])} kg, size = (1, 2, 3) dm);")
        lines += [f"frame {e}{k} on b{k} at ({three(0.5)}) m;" for e in "se"]
        ends = ["ground" if k == 1 else f"e{rng.randint(max(1, k - 3), k - 1)}", f"s{k}"]
        rng.shuffle(ends)
        kind = rng.choice(["rotoide", "prismatique", "spherique", "cardan", "verrou"])
        options = ", axis_a = x, axis_b = y" if kind == "cardan" else f", axis = ({three(1)})"
        options = "" if kind == "spherique" else options
        lines.append(f"liaison l{k}: {kind}({ends[0]}, {ends[1]}{options});")
        starts.append(f"guess(b{k}.angular_velocity = ({three(1)}) rad/s);")
    lines.append(f"force s: spring((1, 1, 1) m, e{count}, k = 30 N/m, length = 0.3 m);")
    lines.append("output Force read = norm(l4.force);")
    return _text("model", lines, starts)


def _text(kind: str, lines: list[str], starts: list[str]) -> str:
    return (
        f"{kind} Tree\n  "
        + "\n  ".join(lines)
        + "\ninitial\n  "
        + "\n  ".join(starts)
        + "\n  experiment(stop = 1 s, tolerance = 1e-10);\nend Tree;\n"
    )


# A motor with its current, a controller with memory, what reads accelerations and reactions, and a
# clutch of the text beside the tree.
EQUATIONS = """
Current i;
Torque made;
Real gain(start = 1);
AngularVelocity w1; AngularVelocity w2;
Torque slipping;
output Acceleration seen;
output Force read;
"""
RELATIONS = """
0.1 H*der(i) = gain*(12 V) - 2 Ohm*i - 0.3 V.s*der(l1.flange.angle);
made = 0.3 N.m/A*i - 0.1 N.m.s*l1.speed;
l1.flange.torque = made;
when b2.angle > 0.1 rad then gain = 2; end when;
slipping = friction(w1 - w2, 0.4 N.m);
2 kg.m^2*der(w1) = -slipping + 0.5 N.m*cos(b3.angle);
1 kg.m^2*der(w2) = slipping;
seen = b5.tip.acceleration.x + b7.tip.acceleration.y + p.tip.acceleration.x;
read = norm(l3.force);
"""


def plane_with_equations(rng: random.Random, count: int) -> str:
    """A random tree in the plane that equations drive by forces and look at, beside a small one."""
    small = "body p: rod(mass = 1 kg, length = 1 m);\nliaison q: rotoide(ground, p.start);\n"
    whole = f"{small}{EQUATIONS}equation\n{RELATIONS}initial\n"
    return plane(rng, count).replace("initial\n", whole)


def dry_plane(rng: random.Random, count: int) -> str:
    """The same with friction in every pin, and no equations: reactions and friction in turn."""
    law = " with coulomb(mu = 0.2, radius = 1 cm);"
    return re.sub(r"(: rotoide\(.*?\))(?: with .*)?;", rf"\1{law}", plane(rng, count))


@pytest.mark.parametrize("make", [plane_with_equations, dry_plane, space])
def test_recursion_and_mass_matrix_agree(
    make: Callable[[random.Random, int], str], monkeypatch: pytest.MonkeyPatch
) -> None:
    text = make(random.Random(5), 9)
    results = []
    for large in (1, 10**6):
        monkeypatch.setattr(dynamics, "LARGE", large)
        monkeypatch.setattr(dynamics, "LARGE_READ", large)
        model = frot.compile(f"// {large}\n{text}")
        results.append(model.simulate(stop=0.05))
        lowered = driver.lowered_of(model.checked(), Log())
        assert lowered is not None
        assert any(g.tree is not None for g in lowered.grouping.groups) == (large == 1)
    recursion, matrix = results
    for at, allowed in ((0, 1e-12), (-1, 1e-8)):
        found = np.array([recursion[n][at] for n in matrix])
        expected = np.array([matrix[n][at] for n in matrix])
        assert found == pytest.approx(expected, abs=allowed * np.abs(expected).max())
