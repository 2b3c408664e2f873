"""`corners`, `sides`, `edges` and `rims` of a body in declarations of several: one item each."""

from __future__ import annotations

import numpy as np
import pytest

import frot

BOX = """planar model Box
  body b: {body};
  {liaisons}
initial
  b.position = (0, 1) m;
  b.angle = 20 deg;
  b.velocity = (1, 0) m/s;
  experiment(stop = 0.6 s);
end Box;
"""
PLANE = "box(mass = 1 kg, size = (1, 0.5) m)"
LAWS = "coulomb(0.3), restitution(0.4)"


def simulated(liaisons: str, body: str = PLANE) -> frot.Result:
    return frot.compile(BOX.format(body=body, liaisons=liaisons)).simulate()


@pytest.mark.parametrize(
    ("liaison", "which"),
    [
        ("feet[4]: contact_ponctuel(ground.line, b.corners)", (1, 2, 3, 4)),
        ("feet[4]: contact_ponctuel(b.corners, ground.line)", (1, 2, 3, 4)),
        ("feet[2]: contact_ponctuel(ground.line, b.corners[1:2])", (1, 2)),
        ("feet[2]: contact_ponctuel(ground.line, b.corners[1:3:4])", (1, 4)),
    ],
)
def test_each_liaison_of_an_array_has_one_corner(liaison: str, which: tuple[int, ...]) -> None:
    """The events and the motion are those of liaisons that are written one by one."""
    whole = simulated(f"liaison {liaison} with {LAWS};")
    alone = simulated(
        "".join(
            f"liaison foot{k}: contact_ponctuel(ground.line, b.corners[{k}]) with {LAWS};"
            for k in which
        )
    )
    assert [e.time for e in whole.events] == [e.time for e in alone.events]
    named = {f"feet[{n + 1}]": f"foot{k}" for n, k in enumerate(which)}
    assert [named[e.liaison] for e in whole.events] == [e.liaison for e in alone.events]
    assert np.array_equal(whole["b.position.x"], alone["b.position.x"])


def test_corners_of_a_polygon_and_forces_on_them() -> None:
    """Three equal forces at the corners of a triangle act as their sum at its centre."""
    body = "polygon(mass = 2 kg, vertices = ((0, 0), (1, 0), (0, 1)) m)"
    run = simulated("force f[3]: on(b.corners, value = (1, 0) N);", body)
    assert run["b.velocity.x"][-1] == pytest.approx(1 + 1.5 * 0.6, rel=1e-9)
    assert np.abs(run["b.angular_velocity"]).max() < 1e-9


def test_corners_and_rims_in_space() -> None:
    text = """model Falls
      body b: box(mass = 1 kg, size = (0.4, 0.2, 0.1) m);
      body c: cylinder(mass = 1 kg, radius = 0.1 m, length = 0.3 m);
      liaison feet[8]: contact_ponctuel(b.corners, ground.plane);
      liaison ends[2]: contact_ponctuel(c.rims, ground.plane);
      output Length lowest = feet[3].gap;
    initial
      b.position = (0, 0, 0.5) m;
      b.orientation = (cos(0.2), 0, sin(0.2), 0);
      c.position = (2, 0, 0.5) m;
      c.orientation = (cos(0.3), sin(0.3), 0, 0);
      experiment(stop = 0.4 s);
    end Falls;
    """
    run = frot.compile(text).simulate()
    first = {e.liaison.split("[")[0] for e in run.events}
    assert first == {"feet", "ends"}
    height = frot.compile(text.replace("feet[3].gap", "b.corners[3].position.z")).simulate()
    assert run["lowest"] == pytest.approx(height["lowest"], abs=1e-12)


def test_corners_of_several_bodies() -> None:
    """The first index counts the bodies, the second the corners."""
    text = """planar model Two
      body b[2]: box(mass = 1 kg, size = (1, 0.5) m);
      liaison own[2]: contact_ponctuel(ground.line, b.corners[1:2, 2]);
      liaison all[4]: contact_ponctuel(ground.line, b[2].corners);
    initial
      b[1].position = (0, 1) m;
      b[2].position = (3, 2) m;
      experiment(stop = 0.1 s);
    end Two;
    """
    run = frot.compile(text).simulate()
    assert run["own[1].gap"][0] == pytest.approx(0.75)
    assert run["own[2].gap"][0] == run["all[2].gap"][0] == pytest.approx(1.75)


REFUSED = {
    "too many": (
        "liaison f[2]: contact_ponctuel(ground.line, b.corners);",
        "E0306",
        r"'b.corners' of 4 stands in a declaration of 2.*'b.corners\[1:2\]'",
    ),
    "too few": (
        "liaison f[5]: contact_ponctuel(ground.line, b.corners);",
        "E0306",
        "declare as many as there are: 4",
    ),
    "one liaison": (
        "liaison f: contact_ponctuel(ground.line, b.corners);",
        "E0205",
        r"found array 'b.corners' of 4.*name one of them, as 'b.corners\[1\]'",
    ),
    "an empty range": (
        "liaison f[1]: contact_ponctuel(ground.line, b.corners[2:1]);",
        "E0306",
        "the range is empty",
    ),
    "beyond the last": (
        "liaison f[2]: contact_ponctuel(ground.line, b.corners[4:5]);",
        "E0304",
        "from 1 to 4",
    ),
    "several bodies": (
        f"body c[2]: {PLANE}; liaison f[2]: contact_ponctuel(ground.line, c.corners[1]);",
        "E0306",
        r"the first index counts the bodies: write 'c.corners\[1:2, 1\]'",
    ),
    "a loop": (
        "for i in 1:4 loop liaison f: contact_ponctuel(ground.line, b.corners[i]); end for;",
        "E0501",
        r"a declaration in 'for'.*declare an array: 'liaison feet\[4\]",
    ),
    "a loop of equations": (
        "equation for i in 1:4 loop liaison f: contact_ponctuel(ground.line, b.corners[i]); "
        "end for;",
        "E0501",
        r"of several declare an array: 'liaison feet\[4\]",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_refused_has_its_remedy(name: str) -> None:
    liaisons, code, words = REFUSED[name]
    with pytest.raises(frot.FrotError, match=f"(?s)^error.{code}.*{words}"):
        simulated(liaisons)
