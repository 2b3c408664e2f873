"""What is put together at the start does not depend on what stands beside it, nor costs more."""

from __future__ import annotations

import numpy as np
import pytest
from frot.compiler import driver
from frot.dsl import Log, compile_text
from frot.runtime.engine import Engine

import frot

# Each of them has something to find: places and speeds that are guessed, a loop, speeds that are
# stated together, a contact into which a body is thrown.
PARTS = {
    "loop": (
        "body a: rod(mass = 1 kg, length = 0.3 m); body b: rod(mass = 2 kg, length = 0.9 m);"
        "body c: rod(mass = 1 kg, length = 0.7 m); frame f on ground at (1, 0) m;"
        "liaison p: rotoide(ground, a.start); liaison q: rotoide(a.tip, b.start);"
        "liaison r: rotoide(b.tip, c.start); liaison s: rotoide(f, c.tip);",
        "guess(b.tip.position = (0.9, 0.8) m); guess(b.velocity = (1, -2) m/s);",
    ),
    "pendulum": (
        "body d: rod(mass = 1e6 kg, length = 3 m); frame g on ground at (5, 0) m;"
        "liaison t: rotoide(g, d.start);",
        "guess(d.tip.position = (7, -2) m); guess(d.tip.velocity.x = 0.3 m/s);",
    ),
    "gliders": (
        "body e: particle(mass = 1 kg); body h: particle(mass = 1e-6 kg);"
        "curve l on ground: line(through = (0, 7) m, direction = (0.6, 0.8));"
        "curve n on ground: line(through = (0, 9) m, direction = (0.8, -0.6));"
        "liaison u: point_courbe(e, l); liaison v: point_courbe(h, n);",
        "guess(e.position = (1, 8) m); guess(h.position = (3, 6) m);"
        "e.velocity.x + 2*h.velocity.x = 1 m/s; guess(h.velocity.y = 3 m/s);",
    ),
    "hoop": (
        "body k: ring(mass = 3 kg, radius = 0.5 m);"
        "liaison w: contact_ponctuel(ground.line, k.rim) with coulomb(0.3);",
        "k.position = (2, 0.5) m; k.angular_velocity = 3 rad/s;",
    ),
}


def begun(names: tuple[str, ...]) -> dict[str, float]:
    """Values at the start of a scene of some of the parts."""
    body, initial = (" ".join(PARTS[name][i] for name in names) for i in (0, 1))
    result = frot.compile(f"planar model M\n{body}\ninitial\n{initial}\nend M;").simulate(stop=1e-9)
    return {name: result[name][0] for name in result if not name.startswith(("energy", "first"))}


@pytest.mark.parametrize("name", PARTS)
def test_a_part_starts_alike_alone_and_beside_others(name: str) -> None:
    alone = begun((name,))
    for order in (tuple(PARTS), tuple(reversed(PARTS))):
        beside = begun(order)
        assert all(beside[x] == alone[x] for x in alone), "to the last bit"


def pendulums(count: int) -> str:
    body = "".join(
        f"  body b{k}: rod(mass = 1 kg, length = 1 m);\n"
        f"  frame f{k} on ground at ({2 * k + 1}, 0) m;\n"
        f"  liaison p{k}: rotoide(f{k}, b{k}.start);\n"
        for k in range(count)
    )
    guess = "".join(
        f"  guess(b{k}.tip.position = ({2 * k + 1}.6, -0.8) m);\n" for k in range(count)
    )
    return f"planar model M\n{body}initial\n{guess}end M;"


def test_parts_have_functions_of_their_own_that_equal_ones_share() -> None:
    log = Log()
    model = compile_text(pendulums(12), log)
    assert model is not None
    lowered = driver.lowered_of(model, log)
    assert lowered is not None
    assert sorted(part.q for part, _ in lowered.shared.parts) == [(k,) for k in range(12)]
    assert all(not part.p and len(part.guessed) == 2 for part, _ in lowered.shared.parts)
    assert len({member.kind for _, member in lowered.shared.parts}) == 1


def test_an_instance_grows_with_the_number_of_parts() -> None:
    sizes = [len(Engine(frot.compile(pendulums(n)).program())._work) for n in (10, 20, 40)]
    assert sizes[2] - sizes[1] <= 2.1 * (sizes[1] - sizes[0]), "not with its square"


def test_each_of_many_guessed_pendulums_hangs_where_it_is_guessed() -> None:
    result = frot.compile(pendulums(12)).simulate(stop=1e-9)
    middles = [result[f"b{k}.position.{x}"][0] for k in range(12) for x in "xy"]
    expected = [x for k in range(12) for x in (2 * k + 1.3, -0.4)]
    assert np.allclose(middles, expected, rtol=0, atol=1e-14 * 24)
