"""A checked model as text for readers: parameters, variables and equations on a line each."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import ClassVar

from frot.dsl import checked
from frot.dsl.checked.describe import describe
from frot.dsl.checked.walk import Rules, Walk, parts
from frot.dsl.quantities.units import parse_unit

# An expression that is longer is cut: calls that are expanded may repeat their arguments.
_LONGEST = 400
_BINDING = {"or": 1, "and": 2, "+": 5, "-": 5, "*": 6, "/": 6, "^": 8}
_COMPARISON = 4


def show(node: checked.Expression) -> str:
    """An expression as it could be written, values in the author's units; cut past 400 parts."""
    return _Printing(_LONGEST).of(node)


@dataclass(slots=True)
class _Printing(Walk[str]):
    """Expressions as text; `left` is the number of parts that are still shown."""

    left: int

    def of(self, node: checked.Expression) -> str:
        self.left -= 1
        shown: str = self.rules[type(node)](self, node) if self.left >= 0 else "..."
        return shown

    def _inside(self, node: checked.Expression, rank: int) -> str:
        """An operand, in parentheses where it binds less than what is around it."""
        shown = self.of(node)
        match node:
            case checked.Binary(op=op) if _BINDING.get(op, _COMPARISON) < rank:
                return f"({shown})"
            case checked.Unary() if rank > _BINDING["-"]:
                return f"({shown})"
            case checked.If():
                return f"({shown})"
        return shown

    def _listed(self, items: tuple[checked.Expression, ...]) -> str:
        return f"({', '.join(self.of(item) for item in items)})"

    def _literal(self, node: checked.Literal) -> str:
        return _written(node)

    def _reference(self, node: checked.Reference) -> str:
        return node.target.name

    def _time(self, node: checked.Time) -> str:
        return "time"

    def _quantity(self, node: checked.Quantity) -> str:
        owner = node.owner
        whole = f"{owner.body.name}." if isinstance(owner, checked.BodyPoint) else ""
        return f"{whole}{owner.name}.{node.name}"

    def _derivative(self, node: checked.Derivative) -> str:
        return f"der({self.of(node.operand)})"

    def _element(self, node: checked.Element) -> str:
        return f"{self._inside(node.operand, 9)}[{node.index + 1}]"

    def _vector(self, node: checked.Vector) -> str:
        return self._listed(node.items)

    def _unary(self, node: checked.Unary) -> str:
        gap = " " if node.op == "not" else ""
        return f"{node.op}{gap}{self._inside(node.operand, 7)}"

    def _binary(self, node: checked.Binary) -> str:
        rank = _BINDING.get(node.op, _COMPARISON)
        first = self._inside(node.left, rank + (node.op == "^"))
        second = self._inside(node.right, rank + (node.op != "^"))
        tight = node.op in "*/^"
        return f"{first}{node.op}{second}" if tight else f"{first} {node.op} {second}"

    def _call(self, node: checked.Call) -> str:
        return f"{node.function}{self._listed(node.arguments)}"

    def _if(self, node: checked.If) -> str:
        condition, yes, no = (self.of(part) for part in parts(node))
        return f"if {condition} then {yes} else {no}"

    rules: ClassVar[Rules] = {
        checked.Literal: _literal,
        checked.Reference: _reference,
        checked.Time: _time,
        checked.Quantity: _quantity,
        checked.Derivative: _derivative,
        checked.Element: _element,
        checked.Vector: _vector,
        checked.Unary: _unary,
        checked.Binary: _binary,
        checked.Call: _call,
        checked.If: _if,
    }


def _written(node: checked.Literal) -> str:
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
    surfaces = (f"{s.name} on {s.owner.name}: {s.kind}" for s in model.surfaces)
    lines += _section("surfaces", surfaces)
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
    within = ", ".join(f"{name} = {show(value)}" for name, value in parameter.bounds)
    name = f"{parameter.name}({within})" if within else parameter.name
    return f"{word}{name} = {show(parameter.value)}{tail}"


def _variable(variable: checked.Variable) -> str:
    words = [w for w in ("discrete", "output") if getattr(variable, w)]
    given = (("start", variable.start), ("nominal", variable.nominal), *variable.bounds)
    attributes = ", ".join(f"{name} = {show(value)}" for name, value in given if value is not None)
    return " ".join([*words, _declared(variable, attributes)])


def _body(body: checked.Body) -> str:
    return f"{body.name}: {body.shape.name if body.shape else ''}({_arguments(body.arguments)})"


def _liaison(liaison: checked.Liaison) -> str:
    laws = ", ".join(f"{w.kind.name}({_arguments(w.arguments)})" for w in liaison.laws)
    places = f"{_place(liaison.a)}, {_place(liaison.b)}"
    driven = f" driven({_arguments(liaison.driven)})" if liaison.driven else ""
    text = f"{liaison.name}: {liaison.kind.name}({places}){driven}"
    return text + (f" with {laws}" if laws else "")


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
                    item = f"[{','.join(str(k + 1) for k in action.item)}]" if action.item else ""
                    yield f"  {action.variable.name}{item} = {show(action.value)}"
                case checked.Reinit():
                    yield f"  reinit({show(action.target)}, {show(action.value)})"
                case checked.Terminate():
                    yield f'  terminate("{action.message}")'
                case checked.Assertion():
                    yield f"  {_assertion(action)}"


def _assertion(made: checked.Assertion) -> str:
    owner = f"{made.owner}: " if made.owner else ""
    return f'{owner}assert({show(made.condition)}, "{made.message}", {made.level})'
