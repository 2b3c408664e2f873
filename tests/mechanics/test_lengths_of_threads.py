"""The length of a thread: read, differentiated and bounded by stops, far from where it is taut."""

import numpy as np
import pytest

import frot

TEXT = """
{planar}model M
  parameter Mass m = 1 kg;
  parameter Length l = 0.4 m;
  body b: particle(mass = m);
  frame f on ground at {place} m;
  liaison k: fil(f, b, length = {length}){law};
  output Velocity drawn;
  output Velocity rest;
initial
  guess(b.position = {start} m);
equation
  drawn = der(k.length);
  rest = der(k.gap);
  experiment(stop = 0.6 s, tolerance = 1e-11);
end M;
"""


def scene(planar: bool, length: str = "l", law: str = "") -> frot.Model:
    """A point that falls beside a place."""
    place, start = ("(0.2, 0.1)", "(0.5, 0.1)") if planar else ("(0.2, 0.1, 0)", "(0.4, 0.3, 0.1)")
    word = "planar " if planar else ""
    return frot.compile(TEXT.format(planar=word, place=place, start=start, length=length, law=law))


@pytest.mark.parametrize("planar", [True, False])
def test_a_stop_of_its_length_is_a_shorter_thread(planar: bool) -> None:
    """However long the thread is that it bounds: the same impulse and the same swing."""
    short = scene(planar).simulate()
    bounded = scene(planar, law=" with stops(min = 0.01 m, max = 0.4 m)")
    for length, mass in ((0.5, 1.0), (50.0, 1.0), (5.0, 1e6)):
        run = bounded.simulate(parameters={"l": length, "m": mass})
        assert np.abs(run["k.length"] - short["k.length"]).max() < 1e-10
        assert np.abs(run["b.position.x"] - short["b.position.x"]).max() < 1e-9
        one, other = (next(e for e in x.events if e.kind == "impact") for x in (run, short))
        assert one.time == pytest.approx(other.time, abs=1e-11)
        assert one.impulse == pytest.approx(mass * other.impulse, rel=1e-9)
        assert other.impulse > 0.5


@pytest.mark.parametrize("planar", [True, False])
def test_the_rates_of_its_length_and_its_rest(planar: bool) -> None:
    """d' = x . v/d, while it is slack; its length may change too."""
    run = scene(planar, "3 m + 0.5 m*sin(2*time/(1 s))").simulate()
    ways = "xy" if planar else "xyz"
    place = dict(zip(ways, (0.2, 0.1, 0.0), strict=False))
    apart = np.array([run[f"b.position.{c}"] - place[c] for c in ways])
    speed = np.array([run[f"b.velocity.{c}"] for c in ways])
    far = np.linalg.norm(apart, axis=0)
    want = (apart * speed).sum(axis=0) / far
    assert np.abs(run["k.length"] - far).max() < 1e-12
    assert np.abs(run["drawn"] - want).max() < 1e-12
    assert np.ptp(want) > 1
    assert np.abs(run["rest"] - (np.cos(2 * run.time) - want)).max() < 1e-12
