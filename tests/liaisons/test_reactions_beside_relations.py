"""Relations of one's own take part in the reactions that are read of other liaisons."""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
import pytest

import frot
from tests.space.newton_euler import Link, Place, box, residual

SPACE = """
liaison Away(a: frame, b: frame, Length way)
  geometric norm(b.position - a.position) = way;
end Away;
liaison Ball(a: frame, b: frame)
  geometric b.position = a.position;
end Ball;
liaison Beside(a: frame, b: frame, Real n[3])
  Length apart[3] = b.position - a.position;
  geometric n[1]*dot(apart, a.ex) + n[2]*dot(apart, a.ey) + n[3]*dot(apart, a.ez) = 0 m;
end Beside;
model Two
  body p: box(mass = 2 kg, size = (0.3, 0.5, 0.7) m);
  body q: box(mass = 1 kg, size = (0.4, 0.2, 0.3) m);
  frame place on ground;
  frame hung on q at (0.3, 0.1, 0.2) m;
  frame at_q on q at (0.1, 0.2, 0.3) m rotated(axis = (1, 0.4, -0.3), angle = 0.7);
  frame at_p on p at (0.1, -0.2, 0.3) m;
  liaison hook: spherique(place, hung);
initial
  guess(p.position = (0.3, 0.1, -0.4) m);
  guess(p.angular_velocity = (0.5, 1, 3) rad/s);
  guess(q.angular_velocity = (1, 2, 0.5) rad/s);
end Two;
model All
  Two away, ball, beside;
  liaison l1: Away(away.at_q, away.at_p, way = 0.8 m);
  liaison l2: Ball(ball.at_p, ball.at_q);
  liaison l3: Beside(beside.at_q, beside.at_p, n = (0, 1, 0.5));
  OUTPUTS
  experiment(stop = 0.5 s);
end All;
"""


def _reads(names: Iterator[str]) -> str:
    return "".join(
        f"  output Force f_{n} = {x}.force; output Torque t_{n} = {x}.torque;\n"
        for n, x in ((x.replace(".", "_"), x) for x in names)
    )


def test_reactions_of_a_tree_know_of_relations_in_space() -> None:
    """Newton and Euler for both bodies, with the reactions of the joint and of the relation."""
    parts = {"away": "l1", "ball": "l2", "beside": "l3"}
    links = (x for pair in parts.items() for x in (f"{pair[0]}.hook", pair[1]))
    run = frot.compile(SPACE.replace("OUTPUTS", _reads(links))).simulate(tolerance=1e-9)
    for part, link in parts.items():
        p = box(f"{part}.p", 2, (0.3, 0.5, 0.7))
        q = box(f"{part}.q", 1, (0.4, 0.2, 0.3))
        at_p, at_q = Place(p.name, (0.1, -0.2, 0.3)), Place(q.name, (0.1, 0.2, 0.3))
        ends = (at_p, at_q) if part == "ball" else (at_q, at_p)
        hook = Link(f"{part}.hook", Place(None, (0, 0, 0)), Place(q.name, (0.3, 0.1, 0.2)))
        assert residual(run, (p, q), (hook, Link(link, *ends)), (0.1, 0.3)) < 1e-12


CRANK = """
liaison Cam(a: frame, b: frame, Length way)
  geometric b.position.y - a.position.y = 0.5*way + 1/(1 m)*way^2;
end Cam;
planar model M
  body c: rod(mass = 1 kg, length = 0.5 m);
  body d: rod(mass = 1 kg, length = 1.2 m);
  body e: box(mass = 2 kg, size = (0.2, 0.1) m);
  frame rail on ground at (0.1, 0.2) m rotated(angle = 0.3);
  frame place on ground at (2, 0) m;
  body tappet: particle(mass = 2 kg);
  curve guide on ground: parametric((u*(1 m), 0.2 m*u^2), u = (-3, 3));
  liaison A: rotoide(ground, c.start);
  liaison B: rotoide(c.tip, d.start);
  liaison C: rotoide(d.tip, e);
  liaison D: LAST;
  liaison cam: Cam(place, tappet, way = WAY);
  output Force fa = A.force; output Force fb = B.force; output Force fc = C.force;
  output Force fd = D.force; output Torque td = D.torque; output Force fk = cam.force;
  output Length way = WAY;
  output Length pa = c.start.position; output Length pb = c.tip.position;
  output Length pc = d.tip.position;
initial
  A.angle = 1; guess(e.position = (1.5, 0.5) m);
  tappet.position.x = 0 m; A.speed = 2 rad/s;
  experiment(stop = 0.5 s, tolerance = 1e-7);
end M;
"""


@pytest.mark.parametrize(
    ("last", "way"),
    [("prismatique(rail, e)", "D.displacement"), ("point_courbe(e, guide)", "D.u*(1 m)")],
)
def test_a_relation_that_reads_what_closes_a_loop(last: str, way: str) -> None:
    """What keeps `y = f(s)` acts by -f'(s) along s, and the pins of the loop bear it.

    The energy of every value looked at is kept, also where an angle is small and turns back.
    """
    run = frot.compile(CRANK.replace("LAST", last).replace("WAY", way)).simulate()
    masses = {"c": (1, 0.25 / 12), "d": (1, 1.44 / 12), "e": (2, 0.1 / 12), "tappet": (2, 0)}
    for t in (0.1, 0.25, 0.4):
        at = run.at(t)

        def pair(name: str, at: object = at) -> np.ndarray:
            return np.array([at[f"{name}.{x}"] for x in "xy"], dtype=float)  # type: ignore[index]

        s = float(at["way"])
        if "guide" in last:
            along, sign = np.array([1, 0.4 * s]), -1
            along = along / (along @ along)
        else:
            along, sign = np.array([np.cos(0.3), np.sin(0.3)]), 1
        driven = -at["fk.y"] * (0.5 + 2 * s) * along
        loads = [("tappet", pair("fk"), pair("tappet.position"), 0.0)]
        for (one, other), name in zip(pairwise((None, "c", "d", "e")), "abc", strict=True):
            loads.append((other, pair(f"f{name}"), pair(f"p{name}"), 0.0))
            loads.append((one, -pair(f"f{name}"), pair(f"p{name}"), 0.0))
        here = pair("e.position")
        loads += [("e", sign * pair("fd"), here, sign * float(at["td"])), ("e", driven, here, 0)]
        for body, (mass, inertia) in masses.items():
            force = mass * (np.array([0, -9.81]) - pair(f"{body}.acceleration"))
            couple = -inertia * float(at[f"{body}.angular_acceleration"]) if inertia else 0.0
            for on, push, place, turn in loads:
                if on == body:
                    force = force + push
                    arm = place - pair(f"{body}.position")
                    couple += arm[0] * push[1] - arm[1] * push[0] + turn
            assert np.abs(force).max() < 1e-10
            assert abs(couple) < 1e-10 or body == "tappet"
    energy = run["energy.kinetic"] + run["energy.potential"] - run["energy.work"]
    assert np.abs(energy - energy[0]).max() < 1e-5


def test_a_relation_may_switch_where_its_terms_vanish() -> None:
    """A bead runs from a level line into a parabola: it is off by nothing where they meet."""
    run = frot.compile("""
liaison Valley(a: frame, b: frame)
  geometric b.position.z = if b.position.x > 0 m then 0 m else b.position.x^2/(1 m);
end Valley;
model Bead
  body b: particle(mass = 1 kg);
  liaison l: Valley(ground, b);
initial
  b.position.x = 0.1 m;
  b.velocity.x = -1 m/s;
  experiment(stop = 0.3 s);
end Bead;
""").simulate(tolerance=1e-9)
    x, z = run["b.position.x"], run["b.position.z"]
    assert z == pytest.approx(np.where(x > 0, 0, x**2), abs=1e-14)
    square = run["b.velocity.x"] ** 2 + run["b.velocity.z"] ** 2
    assert square / 2 + 9.81 * z == pytest.approx(0.5, abs=1e-8)


def test_the_report_knows_of_a_third_place() -> None:
    """The body in the middle of two others: three relations of three bodies."""
    report = frot.compile("""
liaison Middle(a: frame, b: frame, c: frame)
  geometric b.position = (a.position + c.position)/2;
end Middle;
model M
  body p: sphere(mass = 1 kg, radius = 0.1 m);
  body q: sphere(mass = 1 kg, radius = 0.1 m);
  body r: particle(mass = 1 kg);
  liaison l: Middle(p, r, c = q);
end M;
""").report()
    assert (report.mobility.freedoms, report.mobility.independent) == (15, 3)


@pytest.mark.parametrize(
    ("formals", "inside", "told"),
    [
        ("Real k", "Real k = 2;", "'k' is declared twice in 'L'"),
        ("Real k", "Real d;", "'d' is given no value in 'L'"),
        ("Real k[2]", "", "expected a vector of 2 numbers, found a number"),
    ],
)
def test_values_of_a_definition_that_are_none(formals: str, inside: str, told: str) -> None:
    """Of arguments and of what is declared inside."""
    with pytest.raises(frot.FrotError) as raised:
        frot.compile(f"""
liaison L(a: frame, b: frame, {formals})
  {inside}
  geometric b.position.x = a.position.x;
end L;
model M
  body p: particle(mass = 1 kg);
  liaison l: L(ground, p, k = 1);
end M;
""")
    assert told in str(raised.value)
