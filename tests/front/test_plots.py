"""What `--plot` draws where nobody says it: outputs, else what moves, one unit for each panel."""

from pathlib import Path

import numpy as np
import pytest
from front_door import MODELS
from frot.runtime.panels import MOST_CURVES, MOST_MODES, MOST_PANELS, Choice, choose
from frot.runtime.plotting import draw

import frot

RODS = """
model Rods
  body a: rod(mass = 1 kg, length = 1 m);
  body b: rod(mass = 1 kg, length = 1 m);
  body c: rod(mass = 1 kg, length = 1 m);
  body d: rod(mass = 1 kg, length = 1 m);
  liaison A: rotoide(ground, a.start, axis = y) driven(speed = 1 rad/s);
  liaison B: spherique(a.tip, b.start);
  liaison C: spherique(b.tip, c.start);
  liaison D: spherique(c.tip, d.start);
  {outputs}
  experiment(stop = 1 s);
end Rods;
"""
MACHINE = """
model Machine "A state of $two_ states"
  type State = enumeration(idle, working, broken);
  model Part
    Voltage v;
    Real u;
  end Part;
  State state(start = State.idle);
  State next(start = State.working);
  Boolean on(start = false);
  Real x(start = 0);
  Current i;
  Part part;
initial
  x = 0;
equation
  der(x) = 1 1/s;
  i = (2 A)*sin(5*x);
  part.v = (3 V)*cos(5*x);
  part.u = 7*x;
  when x > 0.3 then
    state = State.working;
    next = State.broken;
    on = true;
  elsewhen x > 0.7 then
    state = State.broken;
    next = State.idle;
  end when;
  experiment(stop = 1 s);
end Machine;
"""


def chosen(text: str) -> Choice:
    return choose(frot.compile(text).simulate())


def curves(choice: Choice) -> dict[str, tuple[str, ...]]:
    return {panel.title: panel.names for panel in choice.panels}


def test_what_falls_most_is_drawn_and_a_couple_is_no_angle() -> None:
    found = curves(chosen(RODS.format(outputs="")))
    assert {"c.position.z", "d.position.x", "d.position.z"} < set(found["position"])
    assert found["angle"] == ("A.angle",)
    assert found["couple"] == ("A.drive.angle",)
    assert "a.position.y" not in found["position"]


def test_outputs_are_drawn_alone_where_there_are_some() -> None:
    outputs = "output Length low = d.position.z; output Length far = c.position.x; "
    outputs += "output Angle turned = A.angle;"
    choice = chosen(RODS.format(outputs=outputs))
    assert [p.names for p in choice.panels] == [("low", "far"), ("turned",)]
    assert {p.title for p in choice.panels} == {"output"}


def test_outputs_are_never_left_out_for_want_of_colours() -> None:
    outputs = "".join(f"output Length z{k} = d.position.z + {k}*(1 m);" for k in range(17))
    choice = chosen(RODS.format(outputs=outputs))
    assert [name for p in choice.panels for name in p.names] == [f"z{k}" for k in range(17)]
    assert all(p.hidden == 0 for p in choice.panels)


@pytest.mark.parametrize("path", sorted(MODELS.glob("[a-z]*.frot")), ids=lambda p: p.stem)
def test_each_panel_has_one_unit(path: Path) -> None:
    result = frot.load(path).simulate()
    units = {v.name: (v.unit.name, v.literals) for v in result.program.variables}
    choice = choose(result)
    assert any(p.names for p in choice.panels) and len(choice.panels) <= MOST_PANELS
    for panel in choice.panels:
        assert len({units[name] for name in panel.names}) == 1
        assert len(panel.names) <= MOST_CURVES


def test_enumerations_and_booleans_are_drawn_with_their_names() -> None:
    result = frot.compile(MACHINE).simulate()
    choice = choose(result)
    states, switch = choice.panels[:2]
    assert states.names == ("state", "next") and states.steps == ("", "idle", "working", "broken")
    assert switch.names == ("on",) and switch.steps == ("false", "true")
    labels = [[t.get_text() for t in a.get_yticklabels()] for a in draw(result).axes[:2]]
    assert labels == [["idle", "working", "broken"], ["false", "true"]]


def test_variables_of_the_text_are_drawn_by_their_units() -> None:
    found = curves(chosen(MACHINE))
    assert found["voltage"] == ("part.v",) and found["current"] == ("i",)
    assert set(found["number"]) == {"x", "part.u"} and "position" not in found


def test_bars_are_of_liaisons_that_can_change_their_mode() -> None:
    assert chosen(RODS.format(outputs="")).modes == ()
    text = """
planar model Both
  body rod: rod(mass = 1 kg, length = 1 m);
  body arm: rod(mass = 1 kg, length = 1 m);
  body bead: particle(mass = 1 kg);
  liaison pin: rotoide(ground, rod.start);
  liaison dry: rotoide(rod.tip, arm.start) with coulomb(0.3, radius = 5 cm);
  liaison floor: contact_ponctuel(ground.line, bead);
initial
  bead.position = (3, 0) m;
end Both;
"""
    assert set(chosen(text).modes) == {"dry.mode", "floor.mode"}


def test_of_many_modes_those_that_change_are_drawn() -> None:
    """The last of 60 particles is pulled until it slips."""
    places = "\n".join(f"  p[{k}].position = ({k}, 0) m;" for k in range(1, 61))
    choice = chosen(f"""
planar model Row
  body p[60]: particle(mass = 1 kg);
  liaison c[60]: contact_ponctuel(ground.line, p) with coulomb(0.3);
  force pull: on(p[60], value = (6 N/s*time, 0 N));
initial
{places}
end Row;
""")
    assert len(choice.modes) == MOST_MODES and choice.hidden_modes == 60 - MOST_MODES
    assert choice.modes[-1] == "c[60].mode"


def test_a_run_at_rest_shows_where_it_rests() -> None:
    text = """
planar model Rest
  body p: particle(mass = 1 kg);
  liaison c: contact_ponctuel(ground.line, p) with coulomb(0.3);
initial
  p.position = (2, 0) m;
end Rest;
"""
    found = curves(chosen(text))
    assert found["position"] == ("p.position.x",) and found["reaction"] == ("c.normal_force",)


def test_values_are_sampled_block_by_block(monkeypatch: pytest.MonkeyPatch) -> None:
    result = frot.compile(RODS.format(outputs="")).simulate()
    whole = draw(result).axes[0].lines[3].get_xydata()
    monkeypatch.setattr("frot.runtime.plotting.MOST_VALUES", 7 * len(result.program.variables))
    assert np.array_equal(draw(result).axes[0].lines[3].get_xydata(), whole)
