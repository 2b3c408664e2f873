"""`abscissa` of a point on a curve is the arc length from u = 0: on lines, circles and rims."""

import numpy as np
import pytest

import frot

TEXT = """
{word}model M
  body d: {holder};
  body b: particle(mass = 2 kg);
  body e: particle(mass = 2 kg);
  curve c on ground: {curve};
  liaison hold: encastrement(ground, d);
  liaison k: point_courbe(b, {place});
  liaison h: point_courbe(e, {place}) driven(abscissa = 0.3 m + 0.2 m*sin(time/(1 s)));
  output Length s = k.abscissa;
  output {kind} u = k.u;
  output Velocity v;
initial
  k.abscissa = 0.4 m;
  der(k.abscissa) = 0.5 m/s;
equation
  v = der(k.abscissa);
  experiment(stop = 0.5 s, tolerance = 1e-10);
end M;
"""
LINE = "line(through = {}, direction = {})"
# The curve or the rim, the type of its parameter, and its arc length for one unit of it.
CASES = {
    "line": (False, "c", LINE.format("(1, 2, 0.5) m", "(2, 3, 6)"), "Length", 1.0),
    "circle": (False, "c", "circle(radius = 1.5 m, normal = (1, 2, 3))", "Real", 1.5),
    "rim": (False, "d.rims[2]", "circle(radius = 1 m)", "Real", 0.8),
    "line of the plane": (True, "c", LINE.format("(1, 2) m", "(3, 4)"), "Length", 1.0),
    "circle of the plane": (True, "c", "circle(radius = 1.5 m)", "Real", 1.5),
    "rim of the plane": (True, "d.rim", "circle(radius = 1 m)", "Real", 0.8),
}


@pytest.mark.parametrize("name", CASES)
def test_it_is_the_way_along_the_curve(name: str) -> None:
    """s = r u, s' = |v|, and a drive of s is obeyed: |v| = 0.2 cos t."""
    planar, place, curve, kind, arc = CASES[name]
    holder = "disc(mass = 1 kg, radius = 0.8 m)"
    if not planar:
        holder = "cylinder(mass = 1 kg, radius = 0.8 m, length = 1 m)"
    word = "planar " if planar else ""
    text = TEXT.format(word=word, holder=holder, place=place, curve=curve, kind=kind)
    run = frot.compile(text).simulate()
    ways = "xy" if planar else "xyz"
    assert run["s"][0] == pytest.approx(0.4, abs=1e-12)
    assert run["v"][0] == pytest.approx(0.5, abs=1e-12)
    assert np.abs(run["s"] - arc * run["u"]).max() < 1e-12
    assert np.array_equal(run["k.abscissa"], run["s"])
    assert np.array_equal(run["k.u"], run["u"])
    speed = np.linalg.norm([run[f"b.velocity.{c}"] for c in ways], axis=0)
    assert np.abs(np.abs(run["v"]) - speed).max() < 1e-12
    want = 0.3 + 0.2 * np.sin(run.time)
    assert np.abs(run["h.abscissa"] - want).max() < 1e-10
    speed = np.linalg.norm([run[f"e.velocity.{c}"] for c in ways], axis=0)
    assert np.abs(speed - 0.2 * np.cos(run.time)).max() < 1e-9


def test_on_a_circle_that_grows_it_grows() -> None:
    """s = r(t) u, s' = r u' + r' u."""
    run = frot.compile(
        """
model M
  body b: particle(mass = 2 kg);
  curve c on ground: circle(radius = 1 m + 0.5 m/s*time);
  liaison k: point_courbe(b, c);
  output Velocity v;
  output AngularVelocity w;
initial
  k.u = 2;
  w = 1 rad/s;
equation
  v = der(k.abscissa);
  w = der(k.u);
  experiment(stop = 0.5 s, tolerance = 1e-10);
end M;
"""
    ).simulate()
    radius = 1 + 0.5 * run.time
    assert np.abs(run["k.abscissa"] - radius * run["k.u"]).max() < 1e-12
    assert np.abs(run["v"] - radius * run["w"] - 0.5 * run["k.u"]).max() < 1e-12


@pytest.mark.parametrize(
    "curve", ["ellipse(a = 2 m, b = 1 m)", "parametric((1 m*u, 1 m*u^2, 0 m), u = (-1, 1))"]
)
def test_without_a_closed_form_it_is_refused(curve: str) -> None:
    """In the text, as a drive, and of a result; its stops are those of u."""
    text = """
model M
  body b: particle(mass = 1 kg);
  curve c on ground: {};
  liaison k: point_courbe(b, c){};
  {}
  experiment(stop = 0.01 s);
end M;
"""
    for option, output in (
        ("", "output Length s = k.abscissa;"),
        (" driven(abscissa = 1 m)", ""),
        (" with stops(min = 0 m, max = 1 m)", ""),
    ):
        with pytest.raises(frot.FrotError, match=r"abscissa|its coordinates: u"):
            frot.compile(text.format(curve, option, output)).report()
    run = frot.compile(text.format(curve, "", "")).simulate()
    assert "k.u" in run
    with pytest.raises(KeyError, match=r"no variable 'k\.abscissa'"):
        run["k.abscissa"]


def test_one_place_is_driven_once() -> None:
    """By its parameter or by its arc length."""
    text = """
model M
  body b: particle(mass = 1 kg);
  curve c on ground: circle(radius = 1 m);
  liaison k: point_courbe(b, c) driven(abscissa = 1 m, u = 2);
end M;
"""
    with pytest.raises(frot.FrotError, match="driven twice"):
        frot.compile(text).report()
