"""A surface that is an ellipsoid, on a body, a frame or the ground, beside others of that form."""

import numpy as np
import pytest

import frot

STONE = """
model Stone "A celt on a level plane: an ellipsoid whose axes are not those of its inertia"
  parameter Length a = 0.2 m;
  parameter Length b = 0.05 m;
  parameter Length c = 0.04 m;
  {body}
  liaison table: {table};
  output Length height = stone.position.z;
initial
  stone.orientation = (cos(0.1), sin(0.1)*0.6, sin(0.1)*0.8, 0);
  stone.angular_velocity = (0.1, 0.2, 1) rad/s;
  guess(stone.position = (0, 0, 0.1) m);
  {start}
  experiment(stop = 0.5 s, tolerance = 1e-10);
end Stone;
"""
OWN = "body stone: ellipsoid(mass = 2 kg, semi_axes = (a, b, c));"
GIVEN = """body stone: solid(mass = 2 kg, inertia = 2/5*(1 kg)*(b^2 + c^2, c^2 + a^2, a^2 + b^2));
  surface keel on stone: ellipsoid(semi_axes = (a, b, c));"""
FRAMED = """body stone: solid(mass = 2 kg, inertia = 2/5*(1 kg)*(b^2 + c^2, c^2 + a^2, a^2 + b^2));
  frame turned on stone at (0, 0, 0) m rotated(axis = z, angle = 90 deg);
  surface keel on turned: ellipsoid(semi_axes = (b, a, c));"""
CONTACT = "contact_ponctuel(ground.plane, {figure}, unilateral = false)"


def run(body: str, table: str, start: str = "") -> frot.Result:
    text = STONE.format(body=body, table=table, start=start)
    return frot.compile(text).simulate(parameters={"b": 0.06})


@pytest.mark.parametrize("given", [GIVEN, FRAMED], ids=["on a body", "on a frame"])
@pytest.mark.parametrize("table", [CONTACT, "roulement({figure}, ground.plane)"])
def test_it_is_the_surface_of_a_body_of_that_shape(given: str, table: str) -> None:
    own = run(OWN, table.format(figure="stone.surface"))
    other = run(given, table.format(figure="keel"))
    for name in ("height", *(f"stone.angular_velocity.{k}" for k in "xyz"), "stone.position.x"):
        assert other[name] == pytest.approx(own[name], abs=1e-8), name


BEAD = """
model Bead "A bead on an ellipsoid that grows, off the middle of the ground"
  parameter Length a = 1 m;
  body bead: particle(mass = 1 kg);
  surface hill on ground: {form};
  liaison on: point_surface(bead, hill);
initial
  bead.position.x = 0.7 m;
  bead.position.y = 0.3 m;
  guess(bead.position.z = 2 m);
  bead.velocity.x = 0.1 m/s;
  bead.velocity.y = -0.2 m/s;
  experiment(stop = 0.5 s, tolerance = 1e-11);
end Bead;
"""
FLATTER = "(2*a, 1.5*a, a*({grow}))"


@pytest.mark.parametrize("grow", ["1", "1 + 0.3*sin(time/(0.2 s))"])
def test_a_bead_on_it_moves_as_on_its_implicit_form(grow: str) -> None:
    semi = FLATTER.format(grow=grow)
    one = BEAD.format(form=f"ellipsoid(semi_axes = {semi}, centre = (0.2, 0, 1) m)")
    x, y, z = "(x - 0.2 m)/(2*a)", "y/(1.5*a)", f"(z - 1 m)/(a*({grow}))"
    other = BEAD.format(form=f"implicit(({x})^2 + ({y})^2 + ({z})^2 - 1)")
    results = [frot.compile(text).simulate(parameters={"a": 1.1}) for text in (one, other)]
    for name in (*(f"bead.position.{k}" for k in "xyz"), "bead.velocity.z"):
        assert results[0][name] == pytest.approx(results[1][name], abs=1e-7), name
    x, y, z = (results[0][f"bead.position.{k}"] for k in "xyz")
    t = results[0].time
    height = 1.1 * (1 if grow == "1" else 1 + 0.3 * np.sin(t / 0.2))
    level = ((x - 0.2) / 2.2) ** 2 + (y / 1.65) ** 2 + ((z - 1) / height) ** 2
    assert level == pytest.approx(1, abs=1e-9)


def test_three_equal_axes_make_a_sphere() -> None:
    one = BEAD.format(form="ellipsoid(semi_axes = (a, a, a))")
    other = BEAD.format(form="sphere(radius = a)")
    results = [frot.compile(text).simulate() for text in (one, other)]
    for name in (f"bead.position.{k}" for k in "xyz"):
        assert results[0][name] == pytest.approx(results[1][name], abs=1e-8), name


@pytest.mark.parametrize("kind", ["ellipsoid", "box"])
@pytest.mark.parametrize("item", [1, 2, 3])
def test_sizes_are_positive_at_every_run(kind: str, item: int) -> None:
    name = "semi_axes" if kind == "ellipsoid" else "size"
    model = frot.compile(
        f"model M\n  parameter Length s[3] = (1, 2, 3) m;\n  body b: {kind}(mass = 1 kg, "
        f"{name} = s);\n  experiment(stop = 10 ms);\nend M;\n"
    )
    with pytest.raises(frot.FrotError, match=rf"{name}\[{item}\] of body 'b' is -1: it must be"):
        model.simulate(parameters={f"s[{item}]": -1})


@pytest.mark.parametrize("item", [1, 3])
def test_so_are_the_semi_axes_of_a_surface(item: int) -> None:
    text = BEAD.replace("parameter Length a = 1 m", "parameter Length s[3] = (1, 1, 1) m")
    model = frot.compile(text.format(form="ellipsoid(semi_axes = s)"))
    with pytest.raises(frot.FrotError, match=rf"semi_axes\[{item}\] of surface 'hill' is 0"):
        model.simulate(parameters={f"s[{item}]": 0})


def test_semi_axes_that_vanish_in_a_run_end_it() -> None:
    form = "ellipsoid(semi_axes = (2*a, 2*a, a*(1 - time/(0.2 s))))"
    with pytest.raises(frot.FrotError, match="E09") as ended:
        frot.compile(BEAD.format(form=form)).simulate()
    assert isinstance(ended.value, frot.SimulationError)
