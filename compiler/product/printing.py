"""The compiler's stages in readable text."""

from __future__ import annotations

from typing import TYPE_CHECKING

from frot.compiler.mechanics.mechanize import mechanize
from frot.dsl import Log, dump
from frot.dsl.checked import Model

if TYPE_CHECKING:
    import casadi as ca
    from frot.compiler.lowering.lower import Lowered


def print_stage(model: Model, stage: str, log: Log) -> str | None:
    """The text of `mechanism`, `equations` or `cost`; None where the model is refused."""
    mechanism = mechanize(model, log)
    if mechanism is None:
        return None
    if stage == "mechanism":
        return dump(mechanism)
    from frot.compiler.lowering.lower import lower
    from frot.compiler.mechanics.reduce import reduce

    reduced = reduce(mechanism, log)
    lowered = lower(reduced, log) if reduced is not None else None
    if reduced is None or lowered is None:
        return None
    return _cost(lowered) if stage == "cost" else _equations(lowered)


def _cost(lowered: Lowered) -> str:
    system = lowered.system
    lines = [f"{lowered.reduced.mechanism.model.name}: operations of the generated functions"]
    counted = [*lowered.functions.items(), *((f.name(), f) for f in lowered.blocks)]
    lines += [f"  {name:<18}{f.n_instructions():>6}" for name, f in counted]
    lines += [
        f"  states {system.q.numel() + system.nv} (of these speeds {system.nv}), auxiliary speeds "
        f"{system.na} (reactions that a law or an expression reads), rows {system.lam.numel()}, "
        f"located conditions {len(lowered.reduced.conditions.flags)}"
    ]
    if system.y.numel() or system.invariants.origins:
        lines += [
            f"  unknowns solved by iteration or elimination {system.y.numel()} in "
            f"{len(system.blocks)} blocks, invariants {len(system.invariants.origins)}"
        ]
    return "\n".join(lines)


def _equations(lowered: Lowered) -> str:
    """Rates of the states, blocks, invariants, and the core system with its rows."""
    from frot.compiler.lowering.groups import make_groups

    reduced, system = lowered.reduced, lowered.system
    lines = [f"{reduced.mechanism.model.name}: states {', '.join(system.names) or 'none'}"]
    for symbol, rate in zip(_items(system.q), _items(system.rates), strict=True):
        lines.append(f"  der({symbol.name()}) = {rate}")
    for block in system.blocks:
        kind = "linear" if block.linear else "iterated"
        lines.append(f"  block of {block.name} ({kind}{', late' if block.late else ''}):")
        lines += [f"    0 = {value}" for value in _items(block.residual)]
    for value, origin in zip(
        _items(system.invariants.values), system.invariants.origins, strict=True
    ):
        lines.append(f"  kept: 0 = {value}  from `{origin.text}`")
    if system.z.numel() or system.lam.numel():
        lines.append("  core: M z = h + J' lam, rows accelerate by J z + c")
        parts = {
            "z": system.z,
            "M": system.matrix,
            "h": system.force,
            "J": system.rows,
            "c": system.bias,
            "rate": system.rate,
            "gap": system.gap,
            "coefficients": system.coefficients,
        }
        if not make_groups(system).is_mass_matrix:
            parts["in place of J'"] = system.spread
        lines += [f"    {name} = {value}" for name, value in parts.items()]
    for variable in reduced.mechanism.model.variables:
        if not variable.discrete:
            value = system.resolve(reduced.text.values[variable])
            lines.append(f"  {variable.name} = {value}")
    return "\n".join(lines)


def _items(values: ca.SX) -> list[ca.SX]:
    import casadi as ca

    return list(ca.vertsplit(values)) if values.numel() else []
