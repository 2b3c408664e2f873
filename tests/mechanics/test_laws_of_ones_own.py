"""Laws of the user: the friction on the body as a function of slip and normal reaction."""

from __future__ import annotations

import numpy as np
import pytest

import frot

LAWS = """
law Smooth(Real mu, Velocity v = 0.1 m/s) "nearly dry, for comparison"
  tangential = -mu*normal*tanh(slip/v);
end Smooth;
law Oil(Damping c)
  tangential = -c*slip;
end Oil;
law Glue(Force f)
  tangential = -(normal + f)*tanh(slip/(1 m/s));
end Glue;
law Linear(Real k)
  tangential = -k*normal*slip/(1 m/s);
end Linear;
"""
TEXT = f"""{LAWS}
planar model Own "A disc, a bead, and a block that is lifted"
  body disc: disc(mass = 2 kg, radius = 0.1 m);
  body bead: particle(mass = 1 kg);
  body block: particle(mass = 1 kg);
  curve wire on ground: line(through = (0, -1) m, direction = (1, 0));
  liaison c: contact_ponctuel(ground.line, disc.rim) with Smooth(0.3);
  liaison d: point_courbe(bead, wire) with Oil(2 N.s/m);
  liaison e: contact_ponctuel(block, ground.line) with Linear(0.5);
  force lift: on(block, value = (0 N, 20 N/s*time));
initial
  disc.position = (0, 0.1) m;
  disc.velocity = (1, 0) m/s;
  bead.velocity.x = 1 m/s;
  block.velocity.x = -2 m/s;
  experiment(stop = 0.8 s, tolerance = 1e-11);
end Own;
"""


@pytest.fixture(scope="module")
def result() -> frot.Result:
    return frot.compile(TEXT).simulate()


def test_a_bead_in_oil_slows_down_exponentially(result: frot.Result) -> None:
    assert np.abs(result["d.slip"] - np.exp(-2 * result.time)).max() < 1e-10


def test_a_disc_begins_to_roll(result: frot.Result) -> None:
    """s' = -3 mu g tanh(s/v): sinh(s/v) falls exponentially; the power is that of the friction."""
    want = np.arcsinh(np.sinh(10) * np.exp(-3 * 0.3 * 9.81 * result.time / 0.1)) * 0.1
    assert np.abs(result["c.slip"] - want).max() < 1e-9
    friction = -0.3 * 2 * 9.81 * np.tanh(want / 0.1)
    assert np.abs(result["c.tangential_force"] - friction).max() < 1e-7
    assert np.abs(result["c.force.x"] - friction).max() < 1e-7
    assert np.abs(result["c.power"] - friction * want).max() < 1e-7


def test_what_parts_has_no_friction_any_more(result: frot.Result) -> None:
    """v = v0 exp(-k (g t - 10 t^2)) until the lift is the weight, at t = g/20."""
    t = np.minimum(result.time, 9.81 / 20)
    want = -2 * np.exp(-0.5 * (9.81 * t - 10 * t**2))
    assert np.abs(result["block.velocity.x"] - want).max() < 1e-9
    assert [e.kind for e in result.events] == ["separation"]
    assert result.events[0].time == pytest.approx(9.81 / 20, abs=1e-10)


@pytest.mark.parametrize(
    ("liaison", "code", "words"),
    [
        ("contact_ponctuel(b.tip, ground.line) with Glue(2 N)", "E0511", "does not vanish"),
        ("rotoide(ground, b.start) with Smooth(0.2)", "E0701", "the law 'Smooth' of a rotoïde"),
    ],
)
def test_where_it_has_no_meaning_it_is_told(liaison: str, code: str, words: str) -> None:
    text = f"""{LAWS}
planar model M
  body b: rod(mass = 1 kg, length = 1 m);
  liaison L: {liaison};
end M;
"""
    with pytest.raises(frot.FrotError, match=words) as told:
        frot.compile(text).report()
    assert code in str(told.value)
