"""Codes of faults in what a text says: structure, what is not supported yet, warnings."""

from __future__ import annotations

from collections.abc import Mapping

from frot.dsl.messages.codes_writing import BALL, Row, snippet

_STRUCTURE = {
    "E0501": (
        "statement in a wrong place",
        "A model holds its declarations first, then the sections 'initial' and 'equation', then "
        "'experiment(...)'. Nothing but definitions stands outside of a model.",
        "Move the statement.",
        snippet(f"{BALL}\nball.position = (0, 0) m;"),
    ),
    "E0502": (
        "name used twice",
        "A name is declared once in a model, and the names 'time', 'pi' and 'ground' are taken. "
        "A law is given once to a liaison.",
        "Choose another name, or take one of the two away.",
        snippet("parameter Length r = 1 m;\nparameter Length r = 2 m;"),
    ),
    "E0503": (
        "section or statement given twice",
        "There is at most one section of each name, one 'world' and one 'experiment' in a model.",
        "Join the two.",
        snippet("world(gravity = 1 m/s^2);\nworld(gravity = 2 m/s^2);"),
    ),
    "E0504": (
        "declaration without a value",
        "A parameter, a constant or an output is declared with its value.",
        "Write '= ...' after its name.",
        snippet("parameter Length r;"),
    ),
    "E0505": (
        "input with an equation",
        "An input is given from outside. Only its first value is written in the model.",
        "Write 'input Force f(start = 0 N);'.",
        snippet("input Force f = 1 N;"),
    ),
    "E0506": (
        "kind of another world",
        "Some shapes and liaisons have a meaning in space only, some in the plane only.",
        "Use a kind of this world, or change 'planar model' to 'model'.",
        snippet("body ball: sphere(mass = 1 kg, radius = 1 m);"),
    ),
    "E0507": (
        "liaison of a body with itself",
        "A liaison holds between two bodies, or a body and the ground. "
        "Two places of one body keep their distance anyway.",
        "Name a place of another body.",
        snippet(
            "body bar: rod(mass = 1 kg, length = 1 m);\nliaison a: rotoide(bar.start, bar.tip);"
        ),
    ),
    "E0508": (
        "statement that determines nothing",
        "An equation or an initial statement determines a variable. This one holds only parameters "
        "and numbers.",
        "Name a variable, of a body, a frame, a liaison or of the equations.",
        snippet("parameter Length r = 1 m;", "r = 2 m;"),
    ),
    "E0509": (
        "no model",
        "The text holds no model, or only partial ones, which are bases of others.",
        "Write 'planar model Name ... end Name;'.",
        "partial planar model Base\nend Base;\n",
    ),
    "E0510": (
        "several models",
        "The text holds several models of which none is a part of another.",
        "Say which one is meant, with '--model' or model=.",
        "planar model A\nend A;\nplanar model B\nend B;\n",
    ),
    "E0512": (
        "modification of what is final",
        "A name declared or modified as 'final' keeps its value in every model that uses it.",
        "Take the modifier away, or the word 'final'.",
        'model Part\n  final parameter Real a = 1;\nequation\n  assert(a > 0, "a");\nend Part;\n'
        "model Example\n  Part part(a = 2);\nend Example;\n",
    ),
    "E0513": (
        "component of a partial model",
        "A partial model is only a base: something is left open in it.",
        "Declare a component of a model that extends it.",
        "partial model Base\nend Base;\nmodel Example\n  Base b;\nend Example;\n",
    ),
    "E0514": (
        "function without one output",
        "A function gives one value: it has exactly one output, of any type.",
        "Declare one output; put several values into a record or an array.",
        "function f\n  input Real x;\nend f;\nmodel Example\n  parameter Real y = f(2);\n"
        "end Example;\n",
    ),
    "E0515": (
        "connection of unlike things",
        "Connectors are connected if they have the same variables with the same dimensions, and "
        "the same flows among them.",
        "Connect connectors of one kind.",
        "connector A\n  Real v;\n  flow Real i;\nend A;\nconnector B\n  Real v;\n  flow Force i;\n"
        "end B;\nmodel Example\n  A a;\n  B b;\nequation\n  connect(a, b);\nend Example;\n",
    ),
    "E0516": (
        "branches of 'if' with different numbers of equations",
        "Where a condition can change, every branch must determine as much as the others, and "
        "there must be an 'else'.",
        "Give every branch as many equations.",
        "model Example\n  Real x;\nequation\n  if time > 1 s then\n    x = 1;\n  end if;\n"
        "end Example;\n",
    ),
    "E0517": (
        "variable set by two 'when's",
        "Two 'when's can fire at the same instant; which one would then decide is not said.",
        "Join them by 'elsewhen'.",
        "model Example\n  Integer n;\nequation\n  when time > 1 s then\n    n = 1;\n  end when;\n"
        "  when time > 2 s then\n    n = 2;\n  end when;\nend Example;\n",
    ),
    "E0518": (
        "no statement of 'when'",
        "At an event discrete variables are set, 'x = value;', variables that move are set anew, "
        "'reinit(x, value);', and 'assert' and 'terminate' may stand.",
        "Write it as one of these.",
        "model Example\n  Real x;\nequation\n  der(x) = 1 1/s;\n  when x > 1 then\n"
        "    der(x) = 2 1/s;\n  end when;\nend Example;\n",
    ),
    "E0519": (
        "'pre' of a variable that does not jump",
        "The value before an event differs from the value after it only for variables that a "
        "'when' sets.",
        "Write the variable itself.",
        "model Example\n  Real x;\nequation\n  x = pre(x) + time/(1 s);\nend Example;\n",
    ),
    "E0520": (
        "bases that disagree",
        "A base that is reached in two ways stands in the component once; the two ways give one of "
        "its names different values.",
        "Say the same in both, or set the name where the model is used.",
        "partial model A\n  parameter Real k = 1;\n  output Real y = k;\nend A;\n"
        "partial model B\n  extends A(k = 2);\nend B;\npartial model C\n  extends A(k = 3);\n"
        "end C;\nmodel Example\n  extends B;\n  extends C;\nend Example;\n",
    ),
    "E0521": (
        "world of a component or a base",
        "Gravity is one for all: a component cannot have a world other than that of the model, and "
        "bases of a model that has none itself cannot have different ones.",
        "Write 'world(...)' in the model itself.",
        "planar model Part\n  world(gravity = 0 m/s^2);\nend Part;\nplanar model Example\n"
        "  Part part;\nend Example;\n",
    ),
    "E0522": (
        "geometry that cannot change so",
        "Curves, surfaces, frames, directions of liaisons and gravity are given by parameters and "
        "time, without switches; a body by parameters alone. What is to move otherwise is a body, "
        "and what is fixed to it goes with it.",
        "Put it on a body, and let a liaison drive that; write a smooth function of time.",
        snippet(
            f"{BALL}\nframe place on ground at (0 m, 2*ball.position.x);\n"
            "liaison pin: encastrement(place, ball);"
        ),
    ),
    "E0511": (
        "law or drive on a body that cannot obey it",
        "The law bounds a couple, or the drive turns, but the body of this liaison does not turn; "
        "or a friction, but the liaison keeps its places apart by a drive.",
        "Use a shape that turns, such as a disc or a ring, or leave the law out.",
        snippet(
            "body ball: particle(mass = 1 kg);\n"
            "liaison floor: contact_ponctuel(ground.line, ball) with rolling_resistance(1 mm);",
        ),
    ),
}

_LATER = {
    "E0701": (
        "construct not supported yet",
        "The text is right, but this version of Frot cannot turn it into equations yet. "
        "It says so rather than leaving the construct out.",
        "Write the model without it.",
        snippet(f"{BALL}\noutput Length late = delay(ball.position.x, 1 s);"),
    ),
}

_WARNINGS = {
    "W0101": (
        "import of which nothing is used",
        "The import names something that the text never uses.",
        "Take it away.",
        "",
    ),
    "W0102": (
        "parameter used nowhere",
        "Nothing depends on this parameter, so that setting it changes nothing.",
        "Use it, or take it away.",
        snippet("parameter Length r = 1 m;"),
    ),
    "W0103": (
        "component connected to nothing",
        "The component has connectors, but nothing connects them and nothing names what is in it.",
        "Connect it, or take it away.",
        "model Part\n  RotationalFlange a;\nequation\n  a.angle = time/(1 s);\nend Part;\n"
        "model Example\n  Part part;\nend Example;\n",
    ),
    "W0104": (
        "connector with unequal numbers of flows and potentials",
        "A connection gives one equation for each potential and one for each flow; where these "
        "are not as many, parts that are connected have too many or too few equations.",
        "Give every potential its flow.",
        "connector Port\n  Real a;\n  Real b;\n  flow Real f;\nend Port;\nmodel Example\n"
        "  Port p;\n  Port q;\nequation\n  connect(p, q);\nend Example;\n",
    ),
    "W0105": (
        "angle of more than a turn without a unit",
        "An angle written as a bare number is in radians; one of more than a turn was surely meant "
        "in degrees.",
        "Write the unit: '30 deg', or '30 rad'.",
        snippet("body bar: rod(mass = 1 kg, length = 1 m);", "bar.angle = 30;"),
    ),
    "W0106": (
        "impulse outside of the run",
        "The instant of the impulse lies before the start of the experiment or after its stop. An "
        "impulse without `at` acts at 0 s.",
        "Give it an instant within the run, as 'at = 1 s'.",
        "model Example\n  body b: particle(mass = 1 kg);\n"
        "  force i: impulse(b, value = (1, 0, 0) N.s, at = 3 s);\n  experiment(stop = 2 s);\n"
        "end Example;\n",
    ),
}

LANGUAGE: Mapping[str, Row] = {**_STRUCTURE, **_LATER, **_WARNINGS}
