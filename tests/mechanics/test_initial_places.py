"""Where bodies are put at the start: as stated, or told that no place is."""

import pytest

import frot

# The pin keeps p at the rod's tip, 0.3 m from the line: no place of the rod closes the contact.
FLY = """
planar model Fly
  parameter Length l = 1 m;
  body rod1: rod(mass = {mass}, length = l);
  body p: particle(mass = 1 kg);
  curve top on rod1: line(through = (0, -0.3*l/(1 m)) m, direction = (cos({tilt}), sin({tilt})));
  liaison pin: rotoide(rod1.tip, p);
  liaison c: contact_ponctuel(p, top, unilateral = {unilateral});
initial
  {statements}
  experiment(stop = 0.1 s);
end Fly;
"""


@pytest.mark.parametrize("length", [1e-6, 1.0, 1e6])
@pytest.mark.parametrize(
    ("statements", "unilateral", "mass"),
    [
        ("c.gap = 0 m;", "true", "1 kg"),
        ("c.gap = 0 m; guess(rod1.angle = 0.7);", "true", "1 kg"),
        ("c.gap = 0 m; guess(rod1.angle = 2.9);", "true", "1e6 kg"),
        ("guess(rod1.angle = 0.7);", "false", "1e-6 kg"),
    ],
)
def test_a_contact_that_cannot_hold_is_told(
    statements: str, unilateral: str, mass: str, length: float
) -> None:
    text = FLY.format(statements=statements, unilateral=unilateral, mass=mass, tilt="0")
    with pytest.raises(frot.FrotError) as told:
        frot.compile(text).simulate(parameters={"l": length})
    assert told.value.diagnostics[0].code == "E0601"


@pytest.mark.parametrize("guess", ["", "guess(rod1.angle = 0.7);"])
@pytest.mark.parametrize("place", [1.0, 1e6])
def test_what_can_hold_far_away_is_put_there(guess: str, place: float) -> None:
    text = """
planar model Far
  parameter Length x = 1 m;
  body rod1: rod(mass = 1 kg, length = 1 m);
  body p: particle(mass = 1 kg);
  liaison pin: rotoide(rod1.tip, p);
initial
  p.position.x + p.position.y = x;
  p.position.y - p.position.x = 0 m;
  GUESS
  experiment(stop = 0.1 s);
end Far;
""".replace("GUESS", guess)
    result = frot.compile(text).simulate(parameters={"x": place})
    assert result["p.position.x"][0] == pytest.approx(place / 2, rel=1e-12)


@pytest.mark.parametrize("guess", [(5.0, 5.0), (1e9, 1e9), (-3e-7, 0.1)])
@pytest.mark.parametrize("stated", [0.0, 1.0, 1e-3])
def test_a_guess_of_what_is_stated_too_does_not_move_it(
    stated: float, guess: tuple[float, float]
) -> None:
    text = """
planar model Both
  parameter Velocity v = 1 m/s; parameter Velocity gx = 1 m/s; parameter Velocity gy = 1 m/s;
  body b: particle(mass = 1 kg);
  curve l on ground: line(through = (0, 0) m, direction = (2, 1));
  liaison p: contact_ponctuel(b, l, unilateral = false);
initial
  b.position.x = 1 m;
  b.velocity.x = v;
  guess(b.velocity = (gx, gy));
  experiment(stop = 0.1 s);
end Both;
"""
    given = {"v": stated, "gx": guess[0], "gy": guess[1]}
    result = frot.compile(text).simulate(parameters=given)
    assert result["b.velocity.x"][0] == stated
    assert result["b.velocity.y"][0] == pytest.approx(stated / 2, rel=1e-14, abs=1e-300)
    assert result["b.position.x"][0] == 1
