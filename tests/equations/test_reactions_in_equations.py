"""Reactions in equations, conditions and derivatives: right, or refused by name."""

from math import asin, sqrt

import numpy as np
import pytest

import frot

# A rod let go level about its end: with s the sine of the angle below the level, energy gives
# w^2 = 3 g s/l, and the pin carries m g (1 + 9 s^2)/4 upwards.
ROD = """
planar model Swing
  parameter Length l = 1 m;
  parameter Mass m = 2 kg;
  body b: rod(mass = m, length = l);
  liaison p: rotoide(ground, b.start);
  {declared}
{equation}
  experiment(stop = 0.5 s, tolerance = 1e-10);
end Swing;
"""
WEIGHT = 2 * 9.81


def swing(declared: str = "", *equations: str) -> frot.Model:
    body = "".join(f"  {e}\n" for e in equations)
    return frot.compile(ROD.format(declared=declared, equation=f"equation\n{body}" if body else ""))


def test_an_equation_reads_the_reaction_of_an_ideal_liaison() -> None:
    result = swing("Force f;", "f = 2*p.force.y;").simulate()
    s = np.sin(result["b.angle"])
    assert result["f"] == pytest.approx(WEIGHT * (1 + 9 * s**2) / 2, rel=1e-8)


def test_a_when_reads_the_reaction_of_an_ideal_liaison() -> None:
    model = swing(
        "Angle a(start = 0); Integer n(start = 0);",
        "when p.force.y > m*9.81 m/s^2 then\n a = b.angle;\n n = pre(n) + 1;\nend when;",
    )
    result = model.simulate()
    assert result["n"][-1] == 1
    assert result["a"][-1] == pytest.approx(-asin(1 / sqrt(3)), abs=1e-9)


def test_an_assertion_reads_the_reaction_of_an_ideal_liaison() -> None:
    model = swing("", 'assert(norm(p.force) < 2.4*m*9.81 m/s^2, "the pin breaks");')
    with pytest.raises(frot.SimulationError, match="the pin breaks"):
        model.simulate(stop=1.0)
    model.simulate(stop=0.3)


PRESSED = """
planar model Rate
  input Force u(start = 0 N);
  body b: {shape};
  liaison g: {liaison};
  force s: on(b, value = (0 N, {push}));
  output Real z = der({what})*(1 s/N);
  experiment(stop = 1 s);
end Rate;
"""


def rate(what: str, push: str, liaison: str = "point_courbe(b, ground.line)") -> frot.Model:
    shape = "particle(mass = 1 kg)"
    return frot.compile(PRESSED.format(shape=shape, liaison=liaison, push=push, what=what))


def test_the_rate_of_a_reaction_follows_the_load() -> None:
    result = rate("g.force.y", "-3 N*time^2/(1 s^2)").simulate()
    assert result["z"] == pytest.approx(6 * result.time * np.sign(result["z"][-1]), abs=1e-9)
    assert np.diff(result["g.force.y"]) / np.diff(result.time) == pytest.approx(
        (result["z"][1:] + result["z"][:-1]) / 2, abs=1e-9
    )


def test_the_rate_of_a_reaction_follows_the_motion() -> None:
    model = swing("output Real z = der(p.force.y)*(1 s/N);")
    result = model.simulate()
    s, w = np.sin(result["b.angle"]), result["b.angular_velocity"]
    assert result["z"] == pytest.approx(
        WEIGHT * 4.5 * s * np.cos(result["b.angle"]) * w, rel=1e-7, abs=1e-7
    )


@pytest.mark.parametrize(
    ("what", "liaison", "names"),
    [
        ("g.tangential_force", "point_courbe(b, ground.line) with coulomb(0.3)", "reaction of 'g'"),
        ("g.normal_force", "contact_ponctuel(b, ground.line)", "reaction of 'g'"),
        ("u", "point_courbe(b, ground.line)", "input 'u'"),
        ("g.force.y", "point_courbe(b, ground.line)", "input 'u'"),
    ],
)
def test_a_rate_that_nobody_knows_is_refused_by_name(what: str, liaison: str, names: str) -> None:
    with pytest.raises(frot.FrotError, match=names) as told:
        rate(what, "u", liaison).simulate()
    assert told.value.diagnostics[0].code == "E0606"
    assert told.value.diagnostics[0].help


def test_the_rate_of_a_reaction_in_an_equation_is_refused_by_name() -> None:
    with pytest.raises(frot.FrotError, match="reaction of 'p'"):
        swing("Real x;", "x = der(p.force.y)*(1 s/N);").simulate()


def test_the_rate_of_what_follows_from_a_reaction_follows_too() -> None:
    model = swing("Force f; output Real z = der(f)*(1 s/N);", "f = 2*p.force.y;")
    result = model.simulate()
    s, w = np.sin(result["b.angle"]), result["b.angular_velocity"]
    assert result["z"] == pytest.approx(
        2 * WEIGHT * 4.5 * s * np.cos(result["b.angle"]) * w, rel=1e-7, abs=1e-7
    )
