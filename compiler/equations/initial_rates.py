"""Initial statements on accelerations and reactions, as statements on places or on speeds.

Accelerations and reactions are formulas of the state (`explicit_reactions.py`). A statement on
them finds places where other statements leave places open (an equilibrium: the speeds are then
those stated, or zero), else speeds (the pace at which a wire carries a given force).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import casadi as ca
from frot.compiler.equations.assembled import Assembled
from frot.compiler.symbolic.columns import column, scalars_of
from frot.compiler.translate.derivative_chains import replace_known


def finds_places(value: ca.SX, places: Sequence[ca.SX], system: Assembled) -> bool:
    """Whether a statement on accelerations tells of places more than `places` and gaps do."""
    if not system.q.numel():
        return False
    known = ca.jacobian(ca.vertcat(column(places), system.matrices.gap), system.q)
    own = ca.jacobian(value, system.q)
    before = int(ca.sprank(ca.DM(known.sparsity(), 1)))
    return int(ca.sprank(ca.DM(ca.vertcat(known, own).sparsity(), 1))) > before


def given_speeds(
    speeds: Sequence[ca.SX], given: Mapping[int, ca.SX], system: Assembled
) -> dict[int, ca.SX] | None:
    """The speeds that are stated, else zero; None where statements or liaisons give other ones.

    `speeds` are the statements on speeds, `given` the values that are stated one by one.
    """
    at = {v.element_hash(): given.get(v.element_hash(), ca.SX(0)) for v in scalars_of(system.v)}
    known = [
        ca.simplify(replace_known(x, at)) for x in (*speeds, *scalars_of(system.matrices.rate))
    ]
    return at if all(x.is_zero() for x in known) else None


def holds_at_rest(value: ca.SX | None, speeds: Mapping[int, ca.SX], system: Assembled) -> bool:
    """Whether a statement on accelerations alone is true of any equilibrium at these speeds."""
    unknown = ca.vertcat(system.z[system.nv :], system.lam)
    if value is None or (unknown.numel() and ca.depends_on(value, unknown)):
        return False
    none = {z.element_hash(): ca.SX(0) for z in scalars_of(system.z)}
    return bool(ca.simplify(replace_known(value, {**speeds, **none})).is_zero())
