"""The checked model: every name bound to its object, every value in SI, every expression typed.

The compiler reads these objects and no text. Objects are compared by identity.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from frot.dsl.catalogue import ForceKind, LawKind, LiaisonKind, Shape
from frot.dsl.messages.source import Source, Span
from frot.dsl.quantities.dimensions import Type

# ------------------------------------------------------------------ expressions


@dataclass(frozen=True, slots=True, eq=False)
class Literal:
    """A value known from the text, in SI: `12 mm` is 0.012. `unit` is as the author wrote it."""

    value: float | int | bool | str
    type: Type
    span: Span
    unit: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Reference:
    """A parameter, constant, input, declared output or variable of the equations, named."""

    target: Parameter | Input | Output | Variable
    type: Type
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Time:
    """The independent variable."""

    type: Type
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Quantity:
    """A variable of a body, frame, place or liaison: `hoop.position`, `support.abscissa`.

    `owner` of `rod.start.velocity` is the `BodyPoint` (rod, "start"); of `hoop.position`, the
    `Body`.
    """

    owner: Body | Frame | BodyPoint | Liaison
    name: str
    type: Type
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Derivative:
    """`der(operand)`: derivative with respect to time."""

    operand: Expression
    type: Type
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Element:
    """One component of a vector, `index` from 0: `.x` is 0."""

    operand: Expression
    index: int
    type: Type
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Vector:
    """A tuple `(x, y)`; a unit after it is already applied to the items."""

    items: tuple[Expression, ...]
    type: Type
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Unary:
    """`-x` or `not x`; `op` is that text."""

    op: str
    operand: Expression
    type: Type
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Binary:
    """Two operands; `op` is one of `+ - * / ^ < <= > >= == <> and or`."""

    op: str
    left: Expression
    right: Expression
    type: Type
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Call:
    """A function of the language by its name.

    The usual ones (`sin sqrt atan2 dot norm min max abs sign exp log ...`), and those of events:
    `pre(x)` and `change(x)` of a discrete variable, `edge(b)` of a condition, `sample(start,
    interval)`, `initial()`; `friction(slip, bound, bound_s)` is set-valued dry friction: the force
    or couple opposed to `slip`, of size `bound` while it slips and at most `bound_s` at rest.
    Functions of the user are expanded: their expressions stand where they are called, and one
    object may then stand at several places of a tree.
    """

    function: str
    arguments: tuple[Expression, ...]
    type: Type
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class If:
    """`if condition then yes else no`."""

    condition: Expression
    yes: Expression
    no: Expression
    type: Type
    span: Span


Expression = (
    Literal
    | Reference
    | Time
    | Quantity
    | Derivative
    | Element
    | Vector
    | Unary
    | Binary
    | Call
    | If
)

# ------------------------------------------------------------------ declarations


@dataclass(frozen=True, slots=True, eq=False)
class Parameter:
    """A parameter (tunable) or a constant; `value` may depend on other parameters.

    `unit` is the unit of the author's default (`mm`), for display; values are SI.
    `quantity` is the name of its type (`Angle`). `structural` says what the parameter decides (`the
    size of 'r' (ladder.frot:4:3)`), and is empty for others: such a parameter is a constant too.
    """

    name: str
    type: Type
    value: Expression
    span: Span
    doc: str = ""
    unit: str = ""
    constant: bool = False
    quantity: str = ""
    structural: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Input:
    """A value given from outside, held between communication points."""

    name: str
    type: Type
    start: Expression
    span: Span
    doc: str = ""
    unit: str = ""
    quantity: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Output:
    """A declared output with its expression. `unit` as the author wrote it, if anywhere."""

    name: str
    type: Type
    value: Expression
    span: Span
    doc: str = ""
    unit: str = ""
    quantity: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Variable:
    """An unknown of the equations, a scalar or an array; `name` is dotted, as `r[2].p.i`.

    `discrete`: it changes at events only, by a `when` (or it is an integer, a condition or an
    enumeration that a `when` sets). `start` is `(start = ...)`, a guess for what `initial` leaves
    open and the first value of a discrete variable. `output`: declared so in the model itself.
    `nominal` is its usual size, by which its error is measured while it is smaller.
    """

    name: str
    type: Type
    span: Span
    doc: str = ""
    unit: str = ""
    quantity: str = ""
    start: Expression | None = None
    discrete: bool = False
    output: bool = False
    nominal: Expression | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Flange:
    """The flange of a liaison of one coordinate, where something is connected to it.

    `effort` is its flow variable, the force or couple that flows into the liaison: it drives the
    coordinate `Quantity(liaison, coordinate)` upwards.
    """

    liaison: Liaison
    coordinate: str
    effort: Variable


@dataclass(frozen=True, slots=True, eq=False)
class Equation:
    """`left = right`, scalars or arrays of one shape (or conditions, for a Boolean variable).

    `span` is where it is written, in the class of the component; `owner` is the component's dotted
    name, empty in the model itself. A connection gives equations with the span of its `connect`;
    `connection` is then its text for messages (`connect(r.n, l.p)`, or `flows of r.n, l.p`).
    """

    left: Expression
    right: Expression
    span: Span
    owner: str = ""
    connection: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class IfEquations:
    """`if` equations whose condition can change: every branch has as many scalar equations.

    `branches` are conditions with their equations; the last condition is None (`else`). Where the
    conditions are parameters of the structure the checker has chosen the branch already.
    """

    branches: tuple[tuple[Expression | None, tuple[Equation | IfEquations, ...]], ...]
    span: Span
    owner: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Assign:
    """`variable = value;` inside `when`: the discrete variable's new value."""

    variable: Variable
    value: Expression
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Reinit:
    """`reinit(target, value);` inside `when`; `target` is a variable or a coordinate or speed."""

    target: Expression
    value: Expression
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Terminate:
    """`terminate("why");` inside `when`: the run ends well."""

    message: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Assertion:
    """`assert(condition, "message", level = error | warning)`, anywhere among the equations."""

    condition: Expression
    message: str
    level: str
    span: Span
    owner: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class When:
    """`when` with its `elsewhen`s: the first branch one of whose conditions comes to hold fires."""

    branches: tuple[
        tuple[tuple[Expression, ...], tuple[Assign | Reinit | Terminate | Assertion, ...]], ...
    ]
    span: Span
    owner: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class World:
    """Gravity: its magnitude and its direction, one of `+x -x +y -y +z -z`."""

    gravity: Expression | None
    down: str
    span: Span | None


@dataclass(frozen=True, slots=True, eq=False)
class Body:
    """A body: `arguments` holds every argument of its shape, defaults filled where there is one.

    `ground` is the one `Body` whose `shape` is None.
    """

    name: str
    shape: Shape | None
    arguments: Mapping[str, Expression]
    span: Span | None
    doc: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Frame:
    """A frame fixed to a body: origin in the owner's axes and a rotation (planar: an angle)."""

    name: str
    owner: Body | Frame
    origin: Expression | None
    angle: Expression | None
    span: Span
    doc: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Curve:
    """A curve on a body or frame; `kind` is `line` (`through`, `direction`) and, later, others.

    `ground.line` is a `Curve` too, with `span` None.
    """

    name: str
    owner: Body | Frame
    kind: str
    arguments: Mapping[str, Expression]
    span: Span | None
    doc: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Surface:
    """A surface on a body or frame; `ground.plane` has `span` None."""

    name: str
    owner: Body | Frame
    kind: str
    arguments: Mapping[str, Expression]
    span: Span | None
    doc: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class BodyPoint:
    """A named frame of a body's shape: `rod.start`; a bare body name means its `G`."""

    body: Body
    name: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class BodyGeometry:
    """A named geometry of a body's shape: `hoop.rim`."""

    body: Body
    name: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class CurvePlace:
    """A curve, as an argument: `ground.line`, `tube`."""

    curve: Curve
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class SurfacePlace:
    """A surface, as an argument: `ground.plane`, `ramp`."""

    surface: Surface
    span: Span

    @property
    def name(self) -> str:
        """The name of the surface."""
        return self.surface.name


Place = BodyPoint | BodyGeometry | CurvePlace | Frame


@dataclass(frozen=True, slots=True, eq=False)
class Law:
    """A law of a liaison with its arguments, defaults filled (`mu_s` is `mu` unless given)."""

    kind: LawKind
    arguments: Mapping[str, Expression]
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Liaison:
    """A liaison between the places `a` and `b`; its reaction is that of `a` on `b`."""

    name: str
    kind: LiaisonKind
    a: Place
    b: Place
    options: Mapping[str, Expression]
    laws: tuple[Law, ...]
    span: Span
    doc: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Force:
    """An applied force; `arguments` are expressions or places by the names of its kind.

    A point argument given as a tuple, `(0, 0) m`, is an expression in ground axes. The `holder` of
    a couple is a liaison, or the `G` of a body.
    """

    name: str
    kind: ForceKind
    arguments: Mapping[str, Expression | Place | Liaison]
    span: Span
    doc: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class InitialEquation:
    """`left = right` of the `initial` section; `guess` marks those that only guide."""

    left: Expression
    right: Expression
    span: Span
    guess: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Experiment:
    """Defaults of a run; expressions of parameters, None where the text is silent."""

    stop: Expression | None
    start: Expression | None
    tolerance: Expression | None
    interval: Expression | None
    max_step: Expression | None
    method: str
    on_impasse: str
    on_indeterminate: str
    span: Span | None


@dataclass(frozen=True, slots=True, eq=False)
class Model:
    """A checked model. `files` are all sources it was read from."""

    name: str
    planar: bool
    parameters: tuple[Parameter, ...]
    inputs: tuple[Input, ...]
    outputs: tuple[Output, ...]
    world: World
    ground: Body
    bodies: tuple[Body, ...]
    frames: tuple[Frame, ...]
    curves: tuple[Curve, ...]
    liaisons: tuple[Liaison, ...]
    forces: tuple[Force, ...]
    initial: tuple[InitialEquation, ...]
    experiment: Experiment
    files: tuple[Source, ...]
    span: Span
    doc: str = ""
    variables: tuple[Variable, ...] = ()
    equations: tuple[Equation | IfEquations, ...] = ()
    flanges: tuple[Flange, ...] = ()
    whens: tuple[When, ...] = ()
    assertions: tuple[Assertion, ...] = ()
