"""`mode` of a liaison in conditions, values and events of the text."""

import pytest

import frot

G = 9.81
TEXT = """
planar model Modes
  parameter Real mu = 0.2;
  body b: particle(mass = 1 kg);
  liaison floor: contact_ponctuel(ground.line, b) with coulomb(mu);
  force lift: on(b, value = (0 N, if time > 0.5 s then 20 N else 0 N));
  body block: box(mass = 1 kg, size = (0.4, 0.2) m);
  liaison feet: appui_faces(block.bottom, ground.line) with coulomb(0.5);
  body bar: rod(mass = 1 kg, length = 1 m);
  liaison pin: rotoide(ground, bar.start) with coulomb(0.3, radius = 10 mm);
  body after: particle(mass = 1 kg);
  liaison rail: contact_ponctuel(ground.line, after);
  force thrust: on(after, value = (if floor.mode == stick then 3 N else 0 N, 0 N));
  liaison loose: libre(ground, bar);
  Integer turns(start = 0), stops(start = 0), slides(start = 0);
  Integer rests(start = 0), flights(start = 0);
  Time stopped(start = 0 s);
  Boolean on_feet = feet.mode == stick;
  Real seen = if floor.mode == Mode.slip then 3 elseif floor.mode == stick then 2 else 1;
  output Real unkept = if loose.mode == open then 1 else 0;
  output Real turning = if pin.mode <> slip then 0 else 1;
initial
  b.velocity = (0.2, 0) m/s;
  block.position = (2, 0.1) m;
  block.velocity.x = 0.5 m/s;
  after.position = (4, 0) m;
equation
  when floor.mode == stick then
    rests = pre(rests) + 1;
    stopped = time;
  end when;
  when floor.mode == open then
    flights = pre(flights) + 1;
  end when;
  when change(floor.mode) then
    turns = pre(turns) + 1;
  end when;
  when floor.mode == stick and pre(floor.mode) == slip then
    stops = pre(stops) + 1;
  end when;
  when on_feet then
    slides = pre(slides) + 1;
  end when;
  experiment(stop = 0.6 s, tolerance = 1e-11);
end Modes;
"""


@pytest.fixture(scope="module")
def model():
    return frot.compile(TEXT)


def test_a_text_sees_the_modes(model):
    run = model.simulate()
    rest = 0.2 / (0.2 * G)
    assert [run[x][-1] for x in ("rests", "flights", "slides")] == [1, 1, 1]
    assert (run["turns"][-1], run["stops"][-1]) == (2, 1)
    assert run["stopped"][-1] == pytest.approx(rest, rel=1e-11)
    assert [float(run.at(t)["seen"]) for t in (0.05, 0.3, 0.55)] == [3, 2, 1]
    assert [float(run.at(t)["on_feet"]) for t in (0.05, 0.3)] == [0, 1]
    assert run["unkept"][-1] == 1
    assert [float(run.at(t)["turning"]) for t in (0.0, 0.3)] == [1, 1]
    # pushed from where b comes to rest to where it is lifted
    assert run["after.velocity.x"][-1] == pytest.approx(3 * (0.5 - rest), rel=1e-10)


def test_a_mode_at_the_start_is_seen_at_the_start(model):
    run = model.simulate(parameters={"mu": 1e3}, stop=0.4)
    assert run.at(0.0)["seen"] == 3
    still = frot.compile(TEXT.replace("b.velocity = (0.2, 0)", "b.velocity = (0, 0)")).simulate()
    assert still.at(0.0)["seen"] == 2
    assert (still["rests"][-1], still["turns"][-1], still["stops"][-1]) == (0, 1, 0)
    assert still["after.velocity.x"][-1] == pytest.approx(1.5, rel=1e-10)


def test_a_mode_that_undoes_itself_is_told():
    text = TEXT.replace(
        "lift: on(b, value = (0 N, ",
        "lift: on(b, value = (if floor.mode == stick and time > 0.3 s then 5 N else 0 N, ",
    )
    with pytest.raises(frot.SimulationError, match=r"E0903.*do not settle at t = 0\.[23]"):
        frot.compile(text).simulate()


def test_a_run_ends_where_a_mode_comes():
    text = TEXT.replace("stopped = time;", 'stopped = time; terminate("at rest");')
    run = frot.compile(text).simulate()
    assert run.time[-1] == pytest.approx(0.2 / (0.2 * G), rel=1e-11)
