"""The names of the language: shapes, liaisons, laws, forces, types, functions, variables.

Every entry of the language is here, so that its arguments and dimensions are checked, also where
the mechanics does not exist yet.
"""

from frot.dsl.catalogue.forces import FORCES
from frot.dsl.catalogue.functions import FUNCTIONS, LATER, Function
from frot.dsl.catalogue.kinds import (
    Argument,
    ForceKind,
    LawKind,
    LiaisonKind,
    Shape,
    Softer,
    find,
    plain,
    spellings,
)
from frot.dsl.catalogue.laws import LAWS, arguments_for
from frot.dsl.catalogue.liaisons import LIAISONS
from frot.dsl.catalogue.members import (
    body_members,
    coordinates_of,
    liaison_members,
    point_members,
    vector,
)
from frot.dsl.catalogue.shapes import SHAPES
from frot.dsl.catalogue.types import MODE, MODES, TYPES, WORDS

__all__ = [
    "FORCES",
    "FUNCTIONS",
    "LATER",
    "LAWS",
    "LIAISONS",
    "MODE",
    "MODES",
    "SHAPES",
    "TYPES",
    "WORDS",
    "Argument",
    "ForceKind",
    "Function",
    "LawKind",
    "LiaisonKind",
    "Shape",
    "Softer",
    "arguments_for",
    "body_members",
    "coordinates_of",
    "find",
    "liaison_members",
    "plain",
    "point_members",
    "spellings",
    "vector",
]
