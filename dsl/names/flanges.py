"""The flange of a liaison of one coordinate: where shafts and rods of equations are connected."""

from __future__ import annotations

from frot.dsl import checked
from frot.dsl.catalogue import TYPES
from frot.dsl.catalogue.types import LENGTH
from frot.dsl.checked.liaison_variables import parameter_type
from frot.dsl.names.classes import built_in
from frot.dsl.names.scope import Instance, Scope
from frot.dsl.text import tree

# The potential of a connector: its name, and the flow variable of that with its type.
_FLANGES = {
    "angle": ("RotationalFlange", "torque", "Torque"),
    "displacement": ("TranslationalFlange", "force", "Force"),
}


def flange(liaison: checked.Liaison, node: tree.Member, scope: Scope) -> Instance | None:
    """The connector of a liaison, made where it is first named; None after a message."""
    found = scope.build.flange_instances.get(liaison)
    if found is not None:
        return found
    own = [(c, c) for c in liaison.kind.coordinates if c in _FLANGES]
    place = liaison.b
    along = None
    if liaison.kind.along_curve and isinstance(place, checked.CurvePlace | checked.BodyGeometry):
        along = parameter_type(place)
        own = [("u", "displacement" if along.dimension == LENGTH.dimension else "angle")]
    if len(own) != 1:
        which = "it has no angle or displacement" if not own else "it has several coordinates"
        scope.log.report(
            "E0203",
            f"liaison {liaison.name!r} ({liaison.kind.name}) has no flange: {which}",
            node.name.span,
            help="'rotoide', 'prismatique', 'helicoidale' and 'point_courbe' have one",
        )
        return None
    ((coordinate, potential),) = own
    connector, flow, type_name = _FLANGES[potential]
    of = built_in(connector)
    assert of is not None
    name = f"{liaison.name}.flange"
    effort = checked.Variable(
        f"{name}.{flow}", TYPES[type_name], liaison.span, "what flows in", quantity=type_name
    )
    kind = liaison.kind.coordinates[coordinate] if along is None else along
    value = checked.Quantity(liaison, coordinate, kind, liaison.span)
    made = Instance(name, of, liaison.span, {potential: value, flow: effort}, {flow})
    scope.build.flange_instances[liaison] = made
    scope.build.flanges.append(checked.Flange(liaison, coordinate, effort))
    scope.build.connections.flow(effort, liaison.span, made)
    return made
