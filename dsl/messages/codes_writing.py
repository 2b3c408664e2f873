"""Codes of faults in how a text is written: syntax, names, types, values."""

from __future__ import annotations

from collections.abc import Mapping

# Title, meaning, remedy, and a text that triggers it.
Row = tuple[str, str, str, str]


def snippet(declarations: str = "", initial: str = "", tail: str = "") -> str:
    """A planar model around a few statements."""
    body = "".join(f"  {line}\n" for line in declarations.splitlines())
    section = "initial\n" + "".join(f"  {line}\n" for line in initial.splitlines())
    return f"planar model Example\n{body}{section if initial else ''}{tail}end Example;\n"


BALL = "body ball: particle(mass = 1 kg);"

_SYNTAX = {
    "E0101": (
        "unexpected text",
        "A word, sign or character stands where the language has no place for it. "
        "The statement is left out and reading continues after it.",
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
        "Write one of those that are listed; French and English names are known.",
        snippet("body ball: boule(mass = 1 kg);"),
    ),
    "E0203": (
        "no such member",
        "After the dot stands a frame, a geometry or a variable of the thing before it; "
        "this one has none of that name.",
        "Write a name that it has; docs/language.md lists them.",
        snippet(f"{BALL}\noutput Length x = ball.postion.x;"),
    ),
    "E0204": (
        "wrong arguments",
        "Arguments are given by position or by name; one is missing, unknown, given twice or "
        "one too many.",
        "Give the arguments that it takes; docs/language.md lists them.",
        snippet("body ball: disc(mass = 1 kg);"),
    ),
    "E0205": (
        "another kind of thing is needed",
        "The name is known but stands for another kind of thing: a body where a value is needed, "
        "a curve where a point is needed.",
        "Name a variable or a place of it.",
        snippet(f"{BALL}\noutput Length x = ball;"),
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
        snippet(BALL, "ball.position = (1 m, 2);"),
    ),
    "E0304": (
        "operation not possible",
        "The operator or function does not apply to operands of these types.",
        "Use the items of a vector, 'dot' or 'norm'; write a power as a number.",
        snippet(f"{BALL}\noutput Real x = sin(ball.ex);".replace("ball.ex", "(1, 0)")),
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

WRITING: Mapping[str, Row] = {**_SYNTAX, **_NAMES, **_TYPES, **_VALUES}
