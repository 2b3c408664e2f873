"""The compiler's stages in readable text."""

from __future__ import annotations

from frot.compiler.equations.reduced import Reduced
from frot.compiler.lowering.lower import Lowered
from frot.compiler.symbolic.columns import scalars_of


def print_reduced(reduced: Reduced) -> str:
    """The mechanism's own equations, and the residuals of the text."""
    s = reduced.symbols
    mass, force = reduced.motion.tree.in_full(
        reduced.motion.matrices.matrix, reduced.motion.matrices.force, s.v.numel()
    )
    lines = [f"{reduced.mechanism.model.name}: M a = h + J' lam, rows accelerate by J a + c"]
    parts = {
        "q": s.q,
        "v": s.v,
        "der(q)": s.rates,
        "M": mass,
        "h": force,
        "J": reduced.motion.matrices.rows,
        "c": reduced.motion.matrices.bias,
        "rate": reduced.motion.matrices.rate,
        "gap": reduced.motion.matrices.gap,
        "coefficients": reduced.motion.matrices.coefficients,
        "kinetic": reduced.motion.kinetic,
        "potential": reduced.motion.potential,
    }
    lines += [f"  {name} = {value}" for name, value in parts.items()]
    for value, origin in zip(reduced.equations.values, reduced.equations.origins, strict=True):
        lines.append(f"  0 = {value}  from `{origin.text}`")
    conditions = reduced.conditions
    for flag, value, text in zip(
        conditions.flags, conditions.values, conditions.texts, strict=True
    ):
        lines.append(f"  {flag} while {value} > 0  from `{text}`")
    return "\n".join(lines)


def print_cost(lowered: Lowered) -> str:
    """The operations of each generated function, and the sizes of the system."""
    system = lowered.system
    lines = [f"{lowered.reduced.mechanism.model.name}: operations of the generated functions"]
    counted = [*lowered.whole.functions.items(), *((f.name(), f) for f in lowered.switches.blocks)]
    lines += [f"  {name:<18}{f.n_instructions():>6}" for name, f in counted]
    for k, kind in enumerate(lowered.shared.kinds):
        islands = sum(member.kind == k for _, member in lowered.shared.islands)
        parts = sum(
            member.kind == k for _, member in (*lowered.shared.parts, *lowered.shared.speed_parts)
        )
        counts = ", ".join(f"{name} {f.n_instructions()}" for name, f in kind.functions.items())
        what = "islands" if islands else "parts of the start"
        if counts:
            lines.append(f"  {islands or parts} {what} of a kind: {counts}")
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


def print_equations(lowered: Lowered) -> str:
    """Rates of the states, blocks, invariants, and the core system with its rows."""
    reduced, system = lowered.reduced, lowered.system
    lines = [f"{reduced.mechanism.model.name}: states {', '.join(system.names) or 'none'}"]
    for symbol, rate in zip(scalars_of(system.q), scalars_of(system.rates), strict=True):
        lines.append(f"  der({symbol.name()}) = {rate}")
    for block in system.blocks:
        kind = "linear" if block.linear else "iterated"
        lines.append(f"  block of {block.name} ({kind}{', late' if block.late else ''}):")
        lines += [f"    0 = {value}" for value in scalars_of(block.residual)]
    for value, origin in zip(
        scalars_of(system.invariants.values), system.invariants.origins, strict=True
    ):
        lines.append(f"  kept: 0 = {value}  from `{origin.text}`")
    if system.z.numel() or system.lam.numel():
        lines.append("  core: M z = h + J' lam, rows accelerate by J z + c")
        matrix, force = system.in_full()
        parts = {
            "z": system.z,
            "M": matrix,
            "h": force,
            "J": system.matrices.rows,
            "c": system.matrices.bias,
            "rate": system.matrices.rate,
            "gap": system.matrices.gap,
            "coefficients": system.matrices.coefficients,
        }
        if not lowered.grouping.is_mass_matrix:
            parts["in place of J'"] = system.matrices.spread
        lines += [f"    {name} = {value}" for name, value in parts.items()]
    for variable in reduced.mechanism.model.variables:
        if not variable.discrete:
            value = system.resolve(reduced.text.values[variable])
            lines.append(f"  {variable.name} = {value}")
    return "\n".join(lines)
