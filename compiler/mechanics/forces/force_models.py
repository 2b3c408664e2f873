"""The kinds of forces by their names in the catalogue."""

from __future__ import annotations

from collections.abc import Mapping

from frot.compiler.mechanics.forces.applied import Applied
from frot.compiler.mechanics.forces.attraction import Attraction
from frot.compiler.mechanics.forces.couple import Couple
from frot.compiler.mechanics.forces.damper import Damper
from frot.compiler.mechanics.forces.drag import Drag
from frot.compiler.mechanics.forces.force import ForceModel
from frot.compiler.mechanics.forces.impulse import Impulse
from frot.compiler.mechanics.forces.spring import Spring

FORCE_MODELS: Mapping[str, ForceModel] = {
    "attraction": Attraction(),
    "couple": Couple(),
    "damper": Damper(),
    "drag": Drag(),
    "impulse": Impulse(),
    "on": Applied(),
    "spring": Spring(),
}
