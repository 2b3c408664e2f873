"""Codes of faults found where equations are made ready for solving."""

from __future__ import annotations

from collections.abc import Mapping

from frot.dsl.messages.codes_writing import Row


def _equations(declarations: str, equations: str) -> str:
    declared = "".join(f"  {line}\n" for line in declarations.splitlines())
    written = "".join(f"  {line}\n" for line in equations.splitlines())
    return f"model Example\n{declared}equation\n{written}end Example;\n"


EQUATIONS: Mapping[str, Row] = {
    "E0603": (
        "too few equations",
        "Every variable needs an equation that determines it; an equation determines one variable. "
        "The variables named share fewer equations than they are.",
        "Write the missing equation, connect the component, or make the variable a parameter.",
        _equations("Length x;\nVelocity v;", "der(x) = v;"),
    ),
    "E0604": (
        "too many equations",
        "The equations named share fewer variables than they are: one of them says again what the "
        "others say, or contradicts them.",
        "Leave one out, or declare what it should determine as a variable.",
        _equations("Real x;", "x = 1;\nx = 2;"),
    ),
    "E0606": (
        "derivative that nobody knows",
        "The equations prescribe how something moves by a value whose derivative is not known: an "
        "input is held between communication points, a friction force jumps.",
        "Give the rate as an input and integrate it, or let the value act through a spring or a "
        "filter.",
        _equations("input Length u;\nLength x;\nVelocity v;", "x = u;\nder(x) = v;"),
    ),
    "E0607": (
        "not linear in accelerations",
        "Accelerations, reactions and friction forces that determine each other are solved "
        "together as one linear system; this equation is not linear in them.",
        "Let the quantity act through a state, as a filter or a spring does.",
        _equations(
            "Velocity v;\nForce f;",
            "f = friction(v, 1 N);\n1 kg*der(v)*(1 + (der(v)/(1 m/s^2))^2) = f;",
        ),
    ),
    "E0608": (
        "'reinit' of what is not a state",
        "'reinit' gives a new value to a state: a coordinate, a speed, or a variable whose "
        "derivative the equations give.",
        "Name a variable that stands under 'der', or one that is equal to it.",
        _equations(
            "Length x;\nArea y;",
            "der(x) = 1 m/s;\ny = x^2;\nwhen x > 2 m then\n  reinit(y, 0 m^2);\nend when;",
        ),
    ),
    "E0609": (
        "values of a 'when' in a circle",
        "The values that a 'when' assigns need each other in a circle, so that none comes first.",
        "Use 'pre(...)' for the value before the event.",
        _equations(
            "Integer m;\nInteger n;",
            "when time > 1 s then\n  m = n + 1;\n  n = m + 1;\nend when;",
        ),
    ),
    "E0611": (
        "potentials that nothing fixes",
        "In a circuit only differences of potentials matter: one of them must be given. The same "
        "holds for shafts that only springs and dampers join.",
        "Connect a part that fixes one: a 'Ground' of Electrical, a 'Fixed' of Rotational.",
        "import Electrical.*;\nmodel Example\n  ConstantVoltage s(V = 5 V);\n"
        "  Resistor r(R = 1 Ohm);\n"
        "equation\n  connect(s.p, r.p);\n  connect(s.n, r.n);\nend Example;\n",
    ),
    "E0610": (
        "condition without an equation of its own",
        "A Boolean or whole number that no 'when' sets must follow from an equation 'name = ...', "
        "between values that are no real numbers, and not from itself.",
        "Write such an equation, or set it in a 'when'.",
        _equations("Boolean b;\nReal x;", "x = if b then 1 else 2;\nx = 1;"),
    ),
}
