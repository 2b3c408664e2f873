"""A checked model as text for readers: parameters, variables and equations on a line each."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from frot.dsl import checked
from frot.dsl.checked.describe import describe
from frot.dsl.quantities.units import parse_unit

# An expression that is longer is cut: calls that are expanded may repeat their arguments.
_LONGEST = 400
_BINDING = {"or": 1, "and": 2, "+": 5, "-": 5, "*": 6, "/": 6, "^": 8}
_COMPARISON = 4


def show(node: checked.Expression) -> str:
    """An expression as it could be written, values in the author's units; cut past 400 parts."""
    left = [_LONGEST]
    return _show(node, left)


def _show(node: checked.Expression, left: list[int]) -> str:
    left[0] -= 1
    if left[0] < 0:
        return "..."
    match node:
        case checked.Literal():
            return _literal(node)
        case checked.Reference(target=target):
            return target.name
        case checked.Time():
            return "time"
        case checked.Quantity(owner=checked.BodyPoint() as owner, name=name):
            return f"{owner.body.name}.{owner.name}.{name}"
        case checked.Quantity(owner=owner, name=name):
            return f"{owner.name}.{name}"
        case checked.Derivative(operand=operand):
            return f"der({_show(operand, left)})"
        case checked.Element(operand=operand, index=index):
            return f"{_inside(operand, 9, left)}[{index + 1}]"
        case checked.Vector(items=items):
            return f"({', '.join(_show(i, left) for i in items)})"
        case checked.Unary(op=op, operand=operand):
            gap = " " if op == "not" else ""
            return f"{op}{gap}{_inside(operand, 7, left)}"
        case checked.Binary():
            return _binary(node, left)
        case checked.Call(function=function, arguments=arguments):
            return f"{function}({', '.join(_show(a, left) for a in arguments)})"
        case checked.If(condition=condition, yes=yes, no=no):
            parts = [_show(p, left) for p in (condition, yes, no)]
            return f"if {parts[0]} then {parts[1]} else {parts[2]}"


def _binary(node: checked.Binary, left: list[int]) -> str:
    rank = _BINDING.get(node.op, _COMPARISON)
    tight = node.op in "*/^"
    first = _inside(node.left, rank + (node.op == "^"), left)
    second = _inside(node.right, rank + (node.op != "^"), left)
    return f"{first}{node.op}{second}" if tight else f"{first} {node.op} {second}"


def _inside(node: checked.Expression, rank: int, left: list[int]) -> str:
    shown = _show(node, left)
    match node:
        case checked.Binary(op=op) if _BINDING.get(op, _COMPARISON) < rank:
            return f"({shown})"
        case checked.Unary() if rank > _BINDING["-"]:
            return f"({shown})"
        case checked.If():
            return f"({shown})"
    return shown


def _literal(node: checked.Literal) -> str:
    value = node.value
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return f'"{value}"'
    if node.type.enumeration is not None:
        return f"{node.type.enumeration.name}.{node.type.enumeration.literals[int(value) - 1]}"
    if node.unit:
        unit = parse_unit(node.unit)
        return f"{(value - unit.offset) / unit.factor:.12g} {node.unit}"
    return f"{value:.12g}" + ("" if node.type.dimension.is_one else f" {node.type.dimension.unit}")


# ------------------------------------------------------------------ the model


def show_model(model: checked.Model) -> str:
    """The checked model, section by section."""
    lines = [f"{'planar ' if model.planar else ''}model {model.name}"]
    lines += _section("parameters", map(_parameter, model.parameters))
    lines += _section("inputs", (_declared(i, f"start = {show(i.start)}") for i in model.inputs))
    lines += _section("bodies", (_body(b) for b in model.bodies))
    lines += _section("frames", (f"{f.name} on {f.owner.name}" for f in model.frames))
    lines += _section("curves", (f"{c.name} on {c.owner.name}: {c.kind}" for c in model.curves))
    lines += _section("liaisons", (_liaison(one) for one in model.liaisons))
    lines += _section(
        "forces", (f"{f.name}: {f.kind.name}({_arguments(f.arguments)})" for f in model.forces)
    )
    lines += _section("flanges", (f"{f.effort.name} of {f.liaison.name}" for f in model.flanges))
    lines += _section("variables", map(_variable, model.variables))
    lines += _section("equations", (x for e in model.equations for x in _equation(e, "")))
    lines += _section("events", (x for w in model.whens for x in _when(w)))
    lines += _section("assertions", map(_assertion, model.assertions))
    lines += _section(
        "initial",
        (
            f"{show(e.left)} = {show(e.right)}" + ("  (guess)" if e.guess else "")
            for e in model.initial
        ),
    )
    lines += _section("outputs", (f"{o.name} = {show(o.value)}" for o in model.outputs))
    return "\n".join(lines) + "\n"


def _section(title: str, lines: Iterable[str]) -> Iterator[str]:
    kept = list(lines)
    if kept:
        yield f"{title} ({len([x for x in kept if not x.startswith(' ')])})"
        yield from (f"  {line}" for line in kept)


def _declared(one: checked.Variable | checked.Input | checked.Parameter, value: str = "") -> str:
    shown = describe(one.type, one.unit)
    return f"{one.name}: {shown}" + (f", {value}" if value else "")


def _parameter(parameter: checked.Parameter) -> str:
    word = "constant " if parameter.constant and not parameter.structural else ""
    tail = f"  (fixed: {parameter.structural})" if parameter.structural else ""
    return f"{word}{parameter.name} = {show(parameter.value)}{tail}"


def _variable(variable: checked.Variable) -> str:
    words = [w for w in ("discrete", "output") if getattr(variable, w)]
    given = (("start", variable.start), ("nominal", variable.nominal))
    attributes = ", ".join(f"{name} = {show(value)}" for name, value in given if value is not None)
    return " ".join([*words, _declared(variable, attributes)])


def _body(body: checked.Body) -> str:
    return f"{body.name}: {body.shape.name if body.shape else ''}({_arguments(body.arguments)})"


def _liaison(liaison: checked.Liaison) -> str:
    laws = ", ".join(f"{w.kind.name}({_arguments(w.arguments)})" for w in liaison.laws)
    places = f"{_place(liaison.a)}, {_place(liaison.b)}"
    return f"{liaison.name}: {liaison.kind.name}({places})" + (f" with {laws}" if laws else "")


def _place(place: object) -> str:
    match place:
        case checked.BodyPoint() | checked.BodyGeometry():
            return f"{place.body.name}.{place.name}"
        case checked.CurvePlace():
            return f"{place.curve.owner.name}.{place.curve.name}"
        case checked.Frame() | checked.Liaison() | checked.SurfacePlace():
            return place.name
    return str(place)


def _arguments(arguments: object) -> str:
    assert hasattr(arguments, "items")
    return ", ".join(
        f"{name} = {show(v) if isinstance(v, checked.Expression) else _place(v)}"
        for name, v in arguments.items()
    )


def _equation(made: checked.Equation | checked.IfEquations, margin: str) -> Iterator[str]:
    if isinstance(made, checked.Equation):
        owner = f"{made.owner}: " if made.owner else ""
        tail = f"  ({made.connection})" if made.connection else ""
        yield f"{margin}{owner}{show(made.left)} = {show(made.right)}{tail}"
        return
    for k, (condition, equations) in enumerate(made.branches):
        word = "if" if k == 0 else "elseif"
        yield margin + (f"{word} {show(condition)}" if condition is not None else "else")
        for inner in equations:
            yield from _equation(inner, f"{margin}  ")


def _when(made: checked.When) -> Iterator[str]:
    for k, (conditions, actions) in enumerate(made.branches):
        yield f"{'when' if k == 0 else 'elsewhen'} {', '.join(show(c) for c in conditions)}"
        for action in actions:
            match action:
                case checked.Assign():
                    yield f"  {action.variable.name} = {show(action.value)}"
                case checked.Reinit():
                    yield f"  reinit({show(action.target)}, {show(action.value)})"
                case checked.Terminate():
                    yield f'  terminate("{action.message}")'
                case checked.Assertion():
                    yield f"  {_assertion(action)}"


def _assertion(made: checked.Assertion) -> str:
    owner = f"{made.owner}: " if made.owner else ""
    return f'{owner}assert({show(made.condition)}, "{made.message}", {made.level})'
