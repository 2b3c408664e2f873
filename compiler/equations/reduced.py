"""The reduced equations of a model: those of its motion, and those of its text."""

from __future__ import annotations

from dataclasses import dataclass

from frot.compiler.equations.events import Events
from frot.compiler.equations.structure.eliminate import Residuals
from frot.compiler.mechanics.constraint_geometry import Rows
from frot.compiler.mechanics.mechanism import Mechanism
from frot.compiler.mechanics.reduce import MotionEquations
from frot.compiler.mechanics.variables import Variables
from frot.compiler.translate.conditions import Conditions
from frot.compiler.translate.symbols import Symbols
from frot.compiler.translate.text_symbols import TextSymbols


@dataclass(frozen=True, slots=True, eq=False)
class Reduced:
    """Equations of the motion, and what the text adds to them with its variables.

    `text`, `equations`, `events` and `conditions` are those of the text; `motion` may hold its
    variables too. `plain`: the text adds nothing to the equations of motion.
    """

    mechanism: Mechanism
    symbols: Symbols
    text: TextSymbols
    equations: Residuals
    events: Events
    contact_rows: tuple[Rows, ...]
    variables: Variables
    conditions: Conditions
    motion: MotionEquations
    plain: bool
