"""Codes of faults found in the text itself: syntax, names, types, values, structure."""

from __future__ import annotations

from collections.abc import Mapping

# Title, meaning, remedy, and a text that triggers it.
Row = tuple[str, str, str, str]


def snippet(declarations: str = "", initial: str = "", tail: str = "") -> str:
    """A planar model around a few statements."""
    body = "".join(f"  {line}\n" for line in declarations.splitlines())
    section = "initial\n" + "".join(f"  {line}\n" for line in initial.splitlines())
    return f"planar model Example\n{body}{section if initial else ''}{tail}end Example;\n"


_BALL = "body ball: particle(mass = 1 kg);"

_SYNTAX = {
    "E0101": (
        "unexpected text",
        "A word, sign or character stands where the language has no place for it. "
        "The statement is left out and reading goes on after it.",
        "Compare the statement with the same statement of an example; the caret says what could "
        "stand there.",
        snippet("body ball particle(mass = 1 kg);"),
    ),
    "E0102": (
        "missing ';'",
        "Every statement ends with a semicolon. What follows fits only as a new statement.",
        "Put ';' at the end of the statement before.",
        snippet("parameter Length r = 1 m\nparameter Length l = 2 m;"),
    ),
    "E0103": (
        "unclosed parenthesis",
        "A '(' has no ')' before the statement ends.",
        "Close it; the labels show where it was opened and where its end was expected.",
        snippet("body ball: particle(mass = 1 kg;"),
    ),
    "E0104": (
        "missing 'end'",
        "The text ends inside a model or another block. "
        "Each block is closed by 'end' and its name, so that a reader sees what ends.",
        "Write 'end Name;' after its last statement.",
        "planar model Example\n  parameter Length r = 1 m;\n",
    ),
    "E0105": (
        "wrong or missing name after 'end'",
        "The name after 'end' is that of the block it closes. "
        "Another name means that a block was not closed, or was renamed in one place only.",
        "Write the name of the block.",
        "planar model Example\nend Sample;\n",
    ),
    "E0106": (
        "number and word glued together",
        "A unit stands after its number with a space between: '3 m'. A product needs its sign: "
        "'3*m'.",
        "Put in the space or the '*'.",
        snippet("parameter Length r = 3m;"),
    ),
    "E0107": (
        "unclosed string or comment",
        "A string ends on the line where it begins; a comment '/*' ends with '*/'.",
        "Close it.",
        snippet('parameter Length r = 3 m "radius;'),
    ),
    "E0108": (
        "expression nested too deeply",
        "Parentheses, calls and 'if's may be nested 100 levels deep, and a sum or product may have "
        "200 terms.",
        "Give names to its parts.",
        snippet(f"parameter Real x = {'(' * 210}1{')' * 210};"),
    ),
    "E0109": (
        "model too large",
        "Components, scalars of arrays, equations and calls of functions are counted while the "
        "model is made; there are 200 000 at most, a component counted three times.",
        "Make the arrays smaller; look for a range or a size that is not meant.",
        snippet("parameter Real x = sum(zeros(1000000));"),
    ),
}

_NAMES = {
    "E0201": (
        "unknown name",
        "The name is not declared in the model and is not a name of the language. "
        "Capitals and small letters differ.",
        "Declare it, or write the name that is meant.",
        snippet("parameter Length r = 2*q;"),
    ),
    "E0202": (
        "unknown kind",
        "There is no such function, shape, curve, liaison, law or force.",
        "Write one of the kinds of docs/language.md; French and English names are known.",
        snippet("body ball: boule(mass = 1 kg);"),
    ),
    "E0203": (
        "no such member",
        "After the dot stands a frame, a geometry or a variable of the thing before it; "
        "this one has none of that name.",
        "Write a name that it has; docs/language.md lists them.",
        snippet(f"{_BALL}\noutput Length x = ball.postion.x;"),
    ),
    "E0204": (
        "wrong arguments",
        "Arguments are given by position or by name; one is missing, unknown, given twice or "
        "one too many.",
        "Give the arguments that the note lists.",
        snippet("body ball: disc(mass = 1 kg);"),
    ),
    "E0205": (
        "another kind of thing is needed",
        "The name is known but stands for another kind of thing: a body where a value is needed, "
        "a curve where a point is needed.",
        "Name a variable or a place of it.",
        snippet(f"{_BALL}\noutput Length x = ball;"),
    ),
    "E0206": (
        "unknown type",
        "The type of a declaration is neither one of the language nor defined in the text.",
        "Write a type as Length, Angle, Mass, Real.",
        snippet("parameter Lenght r = 1 m;"),
    ),
    "E0207": (
        "no such model",
        "The model that was asked for is not in the text.",
        "Ask for one of the models that the note lists.",
        "",
    ),
    "E0208": (
        "declarations in a circle",
        "Each of these needs the next one, and the last one the first: values of parameters, "
        "models that hold each other, functions that call each other, bases, types.",
        "Give one of them a value of its own, or take one of the uses away.",
        snippet("parameter Real a = b + 1;\nparameter Real b = a - 1;"),
    ),
    "E0210": (
        "library not found",
        "An import names a file 'Library.frot' or a folder 'Library' beside this file or among the "
        "libraries of Frot, and what is in it.",
        "Check the name, and put the file beside this one.",
        "import Nowhere.Thing;\nplanar model Example\nend Example;\n",
    ),
    "E0211": (
        "imports in a circle",
        "A file imports another that imports it again, directly or through others.",
        "Put what both need into a file of its own.",
        "",
    ),
    "E0212": (
        "name in two packages",
        "Two imports 'Package.*' give a definition of this name; which one is meant is not said.",
        "Import the one by its name, 'import Package.Name;', which goes before all '.*'.",
        "package P\n  model R\n  end R;\nend P;\npackage Q\n  model R\n  end R;\nend Q;\n"
        "model Example\n  import P.*;\n  import Q.*;\n  R r;\nend Example;\n",
    ),
}

_TYPES = {
    "E0301": (
        "types or dimensions differ",
        "Every expression has a dimension, checked when the text is read: a length is not a mass, "
        "and a bare number is neither. Angles are numbers, in radians.",
        "Write the unit of a number, or correct the expression.",
        snippet("parameter Length r = 2 kg;"),
    ),
    "E0302": (
        "unknown unit",
        "After a number and a space stands a unit without spaces, as 'kg.m/s^2'. "
        "A variable needs a sign before it, and spaces around '/'.",
        "Write a known unit, or the sign of the operation.",
        snippet("parameter Time t0 = 3 sec;"),
    ),
    "E0303": (
        "items of a tuple differ",
        "The items of a tuple have one dimension. A unit after the tuple multiplies all its items, "
        "which must then be numbers.",
        "Give each item its unit, or give one unit after the tuple.",
        snippet(_BALL, "ball.position = (1 m, 2);"),
    ),
    "E0304": (
        "operation not possible",
        "The operator or function does not apply to operands of these types.",
        "Use the items of a vector, 'dot' or 'norm'; write a power as a number.",
        snippet(f"{_BALL}\noutput Real x = sin(ball.ex);".replace("ball.ex", "(1, 0)")),
    ),
    "E0305": (
        "value must be constant",
        "This value is fixed before the motion begins, so it may depend on parameters only, "
        "not on time or on the motion.",
        "Use parameters.",
        snippet("body ball: particle(mass = time*(1 kg/(1 s)));"),
    ),
    "E0306": (
        "sizes differ",
        "In a declaration of several bodies, liaisons or forces, 'body b[3]: ...', an array of the "
        "same size gives each its item. Another size has no meaning there.",
        "Give the array the size of the declaration, or name a part of it: 'b[1:2]'.",
        snippet(
            "body b[3]: rod(mass = 1 kg, length = 1 m);\nliaison j[2]: rotoide(b.tip, ground);"
        ),
    ),
}

_VALUES = {
    "E0401": (
        "value with a wrong sign",
        "A mass, a radius, a length or an inertia is positive; a coefficient of friction, of "
        "restitution or a stiffness is not negative; a direction is not zero. "
        "The value was computed with the defaults of the parameters.",
        "Correct the value, or the default of the parameter it comes from.",
        snippet("body ball: particle(mass = -1 kg);"),
    ),
    "E0402": (
        "value out of its range",
        "The value is outside of what can be meant: a stop time not after the start, a coefficient "
        "at rest below that of motion, a restitution above one, a tolerance outside of 1e-14 to "
        "0.1.",
        "Correct the value.",
        snippet("", "", "  experiment(stop = 0 s);\n"),
    ),
    "E0403": (
        "no value",
        "The expression cannot be computed with the defaults of the parameters: a division by "
        "zero, a root or logarithm outside of its domain, a number too large.",
        "Correct the expression or the defaults it uses.",
        snippet("parameter Real x = 0;\nparameter Real y = 1/x;"),
    ),
    "E0404": (
        "unknown option",
        "The option is one of a few words.",
        "Write one of the words listed.",
        snippet("", "", "  experiment(stop = 1 s, method = automatic);\n"),
    ),
}

_STRUCTURE = {
    "E0501": (
        "statement in a wrong place",
        "A model holds its declarations first, then the sections 'initial' and 'equation', then "
        "'experiment(...)'. Nothing but definitions stands outside of a model.",
        "Move the statement.",
        snippet(f"{_BALL}\nball.position = (0, 0) m;"),
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
        "world of a component",
        "Gravity is one for all: a component cannot have a world other than that of the model.",
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
            f"{_BALL}\nframe place on ground at (0 m, 2*ball.position.x);\n"
            "liaison pin: encastrement(place, ball);"
        ),
    ),
    "E0511": (
        "law on a body that cannot obey it",
        "The law bounds a couple, but the body of this liaison does not turn; or a friction, but "
        "the liaison keeps its places apart by a drive.",
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
        snippet(f"{_BALL}\noutput Length late = delay(ball.position.x, 1 s);"),
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
}

LANGUAGE: Mapping[str, Row] = {
    **_SYNTAX,
    **_NAMES,
    **_TYPES,
    **_VALUES,
    **_STRUCTURE,
    **_LATER,
    **_WARNINGS,
}
