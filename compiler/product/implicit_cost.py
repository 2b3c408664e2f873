"""The cost of an implicit step relative to an explicit one."""

from __future__ import annotations

from frot.compiler.lowering.jacobian import has_motion
from frot.compiler.lowering.lower import Lowered

# Evaluations of an explicit step, those of its dense output among them.
_EXPLICIT = 15
# Stages of the implicit method of mechanisms, passes of Newton's method over them that a step takes
# as a rule; systems of equations that it factors, in real multiplications (two are complex).
_STAGES, _PASSES, _SYSTEMS = 5, 3, 9
# Stages of the one for equations alone, which factors one system.
_STAGES_ALONE = 8
# Operations that an evaluation costs in the kernel, whatever the model.
_KERNEL = 300


def price_of_implicit(lowered: Lowered) -> float:
    """Explicit steps that cost what an implicit one does, counted in operations; 0 without one.

    One at least: where a step of lower order is not longer, it is of no use.
    Blocks are taken to be solved in two passes. The measure is the same on every machine.
    """
    jacobian, system = lowered.whole.jacobian, lowered.system
    if jacobian is None:
        return 0.0
    kinds = [lowered.shared.kinds[member.kind].functions for _, member in lowered.shared.islands]
    own = [*kinds, lowered.whole.functions]
    once = float(_KERNEL)
    once += sum(f["dynamics"].n_instructions() for f in own if "dynamics" in f)
    once += 2 * sum(block.n_instructions() for block in lowered.switches.blocks)
    cores = [len(g.unknowns) + len(g.rows) for g in lowered.grouping.groups]
    once += sum(core**3 for core in cores) / 3
    n = system.q.numel() + system.nv
    slopes = lowered.whole.functions["jacobian"].n_instructions()
    if jacobian.lines is not None:
        slopes *= max(1, jacobian.lines.n_directions)
        # each column of a group is solved for accelerations and reactions
        columns = (len(group) for group in jacobian.lines.of_groups)
        slopes += sum(count * core**2 for count, core in zip(columns, cores, strict=True))
    factor = jacobian.factors.work if jacobian.factors is not None else n**3 / 3
    solve = len(jacobian.factors.columns) if jacobian.factors is not None else n**2
    if has_motion(system):
        evaluations, systems, solves = _STAGES * _PASSES + 1, _SYSTEMS, _PASSES * _SYSTEMS
    else:
        evaluations, systems, solves = _STAGES_ALONE, 1, _STAGES_ALONE
    whole = evaluations * once + slopes + systems * factor + solves * solve
    return max(1.0, round(whole / (_EXPLICIT * once), 2))
