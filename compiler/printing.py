"""The compiler's stages in readable text."""

from __future__ import annotations

from frot.compiler.mechanize import mechanize
from frot.dsl import Log, dump
from frot.dsl.checked import Model


def print_stage(model: Model, stage: str, log: Log) -> str | None:
    """The text of `mechanism`, `equations` or `cost`; None where the model is refused."""
    mechanism = mechanize(model, log)
    if mechanism is None:
        return None
    if stage == "mechanism":
        return dump(mechanism)
    from frot.compiler.lower import lower
    from frot.compiler.names import coordinate_names
    from frot.compiler.reduce import reduce

    reduced = reduce(mechanism, log)
    lowered = lower(reduced, log) if reduced is not None else None
    if reduced is None or lowered is None:
        return None
    if stage == "cost":
        lines = [f"{model.name}: operations of the generated functions"]
        lines += [f"  {name:<18}{f.n_instructions():>6}" for name, f in lowered.functions.items()]
        lines += [
            f"  coordinates {reduced.symbols.q.numel()}, auxiliary speeds "
            f"{reduced.symbols.w.numel()} (reactions that a law or an expression reads), rows "
            f"{reduced.symbols.lam.numel()}, located conditions {len(reduced.conditions.flags)}"
        ]
        return "\n".join(lines)
    names = [n for c in mechanism.coordinates for n in coordinate_names(c)]
    parts = {
        "q": ", ".join(names),
        "M": reduced.mass,
        "h": reduced.force,
        "J": reduced.rows,
        "c": reduced.bias,
        "rate": reduced.rate,
        "gap": reduced.gap,
        "mu, mu_s, delta": reduced.coefficients,
    }
    lines = [f"{model.name}: M a = h + J' lam, rows accelerate by J a + c"]
    return "\n".join([*lines, *(f"  {name} = {value}" for name, value in parts.items())])
