"""Events carry the words of the text, with numbers in place of loop variables and indices."""

import frot


def told(text: str) -> set[str]:
    return {event.liaison for event in frot.compile(text).simulate().events}


def test_points_of_a_table_are_told_apart() -> None:
    assert told("""
import Blocks.*;
model Cam
  Table cam(n = 4, x = (0, 1, 2, 3), values = (0, 2, 1, 5));
equation
  cam.u = 3.5*time/(1 s);
  experiment(stop = 1 s);
end Cam;
""") == {
        *(f"cam: u >= x[{k}]" for k in (2, 3)),
        *(f"cam: max(u, x[{k}]) <= x[{k + 1}]" for k in (1, 2, 3)),
    }


def test_items_of_arrays_of_things_and_rounds_of_loops() -> None:
    assert told("""
planar model Loops
  model Part
    Real r[2];
    Real w(start = 0);
  equation
    for i in 1:2 loop
      r[i] = if w > 0.2*i then 1 else 0;
    end for;
    der(w) = 1 1/s;
  end Part;
  body p[2]: particle(mass = 1 kg);
  Part q[2];
  Real m[2, 2];
  Real s[2];
  Integer passed[2](start = 0);
initial
  for k in 1:2 loop
    p[k].position = (k, 0) m;
    p[k].velocity = (k, 0) m/s;
    q[k].w = 0.3*(k - 1);
  end for;
equation
  for i in 1:2 loop
    for j in 1:2 loop
      m[i, j] = if time > (0.6 s)*(2*i + j)/4 then i else j;
    end for;
    s[i] = if p[i].position.x > 1.25 m*i then 1 else 0;
    when q[i].w > 0.05 + m[1, i] then
      passed[i] = pre(passed[i]) + 1;
    end when;
  end for;
  experiment(stop = 1 s);
end Loops;
""") == {
        *(f"q[{k}]: w > 0.2*{i}" for k in (1, 2) for i in (1, 2) if (k, i) != (2, 1)),
        *(f"time > (0.6 s)*(2*{i} + {j})/4" for i in (1, 2) for j in (1, 2)),
        "p[1].position.x > 1.25 m*1",
        "p[2].position.x > 1.25 m*2",
        "q[2].w > 0.05 + m[1, 2]",
    }


def test_a_machine_of_states_is_told_in_its_own_words() -> None:
    assert told("""
model Machine
  type State = enumeration(idle, moving, done);
  State state(start = State.idle);
  Real p;
initial
  p = 0;
equation
  der(p) = 1 1/s;
  when state == State.idle and p > 0.1 then
    state = State.moving;
  elsewhen state == State.moving and p > 0.3 then
    state = State.done;
  end when;
  experiment(stop = 1 s);
end Machine;
""") == {"p > 0.1", "p > 0.3"}


def test_arguments_of_a_function_are_named_as_in_it() -> None:
    assert told("""
model Called
  function tab
    input Real u;
    output Real y = if u < 0.4 then 0 else 1;
  end tab;
  Real x[2];
equation
  for k in 1:2 loop
    x[k] = tab(time*k/(1 s));
  end for;
  experiment(stop = 1 s);
end Called;
""") == {"u < 0.4"}
