"""The passes and their order, from checked model to compiled program: nothing else calls one.

    Model -- mechanize --> Mechanism -- reduced_of --> Reduced -- assembled_of --> Assembled
          -- lowered_of --> Lowered -- generate --> C -- compile --> Program

Every product is made from one of these stages: what `frot check` prints from the first, the DAE and
the program from the last. A pass returns None where the text is at fault, and reports it.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from frot.compiler.mechanics.check_support import refuse_unknown
from frot.compiler.mechanics.mechanism import Mechanism
from frot.dsl import Log, dump
from frot.dsl.checked import Model
from frot.dsl.data.collection import without_collection
from frot.dsl.messages.interrupts import raise_noted_interrupt
from frot.runtime.program import LIBRARY, MODEL_SOURCE, Program, load_program, read_program

# What reads a report must not wait for CasADi: it is loaded where equations are formed.
TYPE_CHECKING = False
if TYPE_CHECKING:
    import ctypes as ct

    from frot.compiler.equations.assembled import Assembled
    from frot.compiler.equations.reduced import Reduced
    from frot.compiler.lowering.lower import Lowered
    from frot.compiler.lowering.result_variables import FirstIntegral, Listed
    from frot.compiler.product.dae import Dae
    from frot.compiler.report.report import Report
    from frot.compiler.toolchain.child_processes import Keeper
    from frot.compiler.toolchain.compiler_choice import Toolchain

    # Variables of an assembled system that are listed after the others.
    Extra = Callable[[Assembled], tuple[Listed, ...]]


def _silent(_: str) -> None:
    """Report no progress."""


def _begin(words: str, tell: Callable[[str], None]) -> None:
    """Announce the next pass; a Ctrl-C that was noted is raised here."""
    raise_noted_interrupt()
    tell(words)


def mechanism_of(model: Model, log: Log) -> Mechanism | None:
    """Bodies, coordinates, contacts; what has neither bodies nor liaisons needs no CasADi."""
    if model.bodies or model.liaisons:
        from frot.compiler.mechanics.mechanize import mechanize

        return mechanize(model, log)
    refuse_unknown(model, (), log)
    return None if log.failed else Mechanism(model, (), (), (), model.forces, {}, {})


def reduced_of(model: Model, log: Log, tell: Callable[[str], None] = _silent) -> Reduced | None:
    """Mechanics and residuals of the text, in CasADi expressions.

    `tell` takes what is being done, in words, here and below.
    """
    _begin("the mechanism", tell)
    mechanism = mechanism_of(model, log)
    return None if mechanism is None else reduce(mechanism, log, tell)


def reduce(mechanism: Mechanism, log: Log, tell: Callable[[str], None] = _silent) -> Reduced | None:
    """The equations of a mechanism and of its text."""
    from frot.compiler.equations.gather_text import (
        apply_loads,
        gather_text,
        large_trees,
        make_reduced,
    )
    from frot.compiler.equations.parameter_checks import refuse_values
    from frot.compiler.equations.read_text import read_text
    from frot.compiler.mechanics.reduce import place_mechanism, reduce_motion

    refuse_values(mechanism, log)
    if log.failed:
        return None
    _begin("the equations of motion", tell)
    placed = place_mechanism(mechanism)
    reading = read_text(placed, log)
    applied = apply_loads(placed, reading, log)
    gathered = gather_text(placed, reading, log)
    if gathered is None:
        return None
    large = large_trees(placed, reading, applied, gathered)
    loads, coefficients = applied.loads, applied.coefficients
    motion = reduce_motion(placed, reading.variables, loads, coefficients, large, log)
    return make_reduced(placed, reading, applied, gathered, motion)


def assembled_of(model: Model, log: Log, tell: Callable[[str], None] = _silent) -> Assembled | None:
    """The one system that the kernel solves."""
    reduced = reduced_of(model, log, tell)
    return None if reduced is None else assemble(reduced, log, tell)


def assemble(reduced: Reduced, log: Log, tell: Callable[[str], None] = _silent) -> Assembled | None:
    """The system of the reduced equations, with slips at zero where friction holds them."""
    from frot.compiler.equations.assembled import plain_system
    from frot.compiler.equations.held_slips import hold_slips

    _begin("the order of the equations", tell)
    system = plain_system(reduced) if reduced.plain else _solved(reduced, log)
    return None if system is None else hold_slips(system)


def _solved(reduced: Reduced, log: Log) -> Assembled | None:
    """The system of a mechanism and the equations of its text."""
    from frot.compiler.equations.solve_equations import (
        order_equations,
        pose_equations,
        remove_definitions,
        solve_in_order,
    )

    posed = pose_equations(reduced, log)
    left = None if posed is None else remove_definitions(posed, log)
    if posed is None or left is None:
        return None
    ordered = order_equations(posed, left, log)
    return None if ordered is None else solve_in_order(posed, left, ordered, log)


def lowered_of(
    model: Model,
    log: Log,
    tell: Callable[[str], None] = _silent,
    *,
    search: bool = True,
    extra: Extra | None = None,
    orders: bool = False,
) -> Lowered | None:
    """The functions of the kernel's contract and their tables.

    `search`: also for the first integrals, whose drift the results of a program carry. `extra`
    gives variables that are listed after the others. `orders`: with the derivatives along the
    motion that `motions` reads.
    """
    system = assembled_of(model, log, tell)
    return None if system is None else lower_system(system, log, tell, search, extra, orders)


def lower_system(
    system: Assembled,
    log: Log,
    tell: Callable[[str], None] = _silent,
    search: bool = True,
    extra: Extra | None = None,
    orders: bool = False,
) -> Lowered | None:
    """The functions of a system: see `lowered_of`."""
    from frot.compiler.lowering.groups import make_groups
    from frot.compiler.lowering.initial_problem import pose_initial_problem
    from frot.compiler.lowering.lower import lower
    from frot.compiler.lowering.result_variables import list_variables
    from frot.compiler.lowering.sort_conditions import sort_conditions
    from frot.compiler.lowering.switches import lower_switches

    problem = pose_initial_problem(system, log)
    integrals: tuple[FirstIntegral, ...] = ()
    if search and not log.failed:
        from frot.compiler.report.first_integrals import first_integrals_of

        _begin("the first integrals", tell)
        integrals = first_integrals_of(system, problem)
    _begin("the functions", tell)
    listed = () if extra is None else extra(system)
    grouping = make_groups(system)
    variables = (*list_variables(system, problem.display, integrals), *listed)
    system, values = sort_conditions(system, problem.explicit)
    system, switches = lower_switches(system, values, log)
    return lower(system, problem, switches, grouping, variables, integrals, log, orders)


def text_of(lowered: Lowered, key: str) -> str:
    """The C text of a model; `key` identifies it to the kernel."""
    from frot.compiler.product.describe import inputs_of, parameters_of
    from frot.compiler.product.generate import generate

    defaults = ([one.default for one in of(lowered)] for of in (parameters_of, inputs_of))
    return generate(lowered, key, *defaults)


def build(
    model: Model,
    file: str,
    key: str,
    toolchain: Toolchain,
    log: Log,
    tell: Callable[[str], None] = _silent,
    extra: Extra | None = None,
    orders: bool = False,
) -> Program | None:
    """The compiled program, kept in the cache.

    `file` is the name of the text in the places of its equations. `extra` gives variables of the
    program that are listed after the others; its first integrals are then not searched for, nor
    with `orders`, the derivatives along the motion that `motions` reads.
    """
    from frot.compiler.product.describe import describe
    from frot.compiler.toolchain.cache_store import store, write_manifest
    from frot.compiler.toolchain.compiler_choice import model_compiler
    from frot.compiler.toolchain.compilers import (
        link_library,
        model_jobs,
        run_compilers,
        words_for,
    )
    from frot.compiler.toolchain.objects import (
        kept_kernel,
        kernel_folder,
        shared_kernel,
        whole_kernel,
    )

    with without_collection():
        lowered = lowered_of(
            model, log, tell, search=extra is None and not orders, extra=extra, orders=orders
        )
        if lowered is None:
            return None
        _begin("its C text", tell)
        text = text_of(lowered, key)
    _begin(f"the C compiler, {len(text) // 1000} kB", tell)
    kernel = kept_kernel(toolchain)

    def fill(folder: Path, keeper: Keeper) -> None:
        source = folder / MODEL_SOURCE
        source.write_text(text, encoding="utf-8")
        own = model_compiler(toolchain)
        jobs = model_jobs(own, toolchain, [source], [kernel_folder()], folder)
        made = [job.target for job in jobs]
        run_compilers(jobs, keeper)
        objects, words = whole_kernel(kernel), words_for(own, toolchain)
        link_library(toolchain, [*made, *objects], folder / LIBRARY, words, keeper)
        for one in made:
            one.unlink()
        shared = shared_kernel(kernel, objects)
        write_manifest(describe(lowered, file, key, own, folder, shared), folder)

    kept = store("programs", key, fill)
    return load_program(read_program(kept.folder), (kept.hold, kernel.hold))


def make_dae(model: Model, log: Log, kernel: Callable[[], ct.CDLL]) -> Dae | None:
    """The DAE with its switching, from the same functions as the program.

    `kernel` gives a library that has the kernel's impact law.
    """
    from frot.compiler.mechanics.unsupported import refuse
    from frot.compiler.product.dae import dae_of

    lowered = lowered_of(model, log, search=False)
    if lowered is None:
        return None
    # a switch has one number for the motion that its forces resist, and one for its couples
    rows = lowered.reduced.contact_rows
    if any(len(x.tangent) > 1 or len(x.rolling) > 1 for x in rows):
        where = "a DAE with friction on contacts in space, or on several motions of a joint,"
        refuse(log, where, None, "run it by `simulate`")
        return None
    return dae_of(lowered, kernel)


def make_report(model: Model, log: Log) -> Report | None:
    """What `frot check` says; without bodies it needs no CasADi."""
    from frot.compiler.report.report import report_of

    mechanism = _balanced(model, log)
    if mechanism is None:
        return None
    if not model.bodies:
        return report_of(mechanism, None)
    from frot.compiler.lowering.initial_problem import pose_initial_problem
    from frot.compiler.report.analysis import analyse

    system = assembled_of(model, log)
    raise_noted_interrupt()
    if system is None:
        return None
    own = Log()  # of a start that cannot be posed the report says so itself
    problem = pose_initial_problem(system, own)
    return report_of(mechanism, analyse(system, None if own.failed else problem))


def _balanced(model: Model, log: Log) -> Mechanism | None:
    """The mechanism, if the text has as many equations as unknowns."""
    mechanism = mechanism_of(model, log)
    if mechanism is None or not (mechanism.model.variables or mechanism.model.equations):
        return mechanism
    from frot.compiler.equations.check_balance import check_balance

    return mechanism if check_balance(mechanism.model, mechanism, log) else None


def print_stage(model: Model, stage: str, log: Log) -> str | None:
    """The text of `mechanism`, `reduced`, `equations`, `cost` or `c`."""
    if stage == "mechanism":
        mechanism = mechanism_of(model, log)
        return None if mechanism is None else dump(mechanism)
    from frot.compiler.product.printing import print_cost, print_equations, print_reduced

    if stage == "reduced":
        reduced = reduced_of(model, log)
        return None if reduced is None else print_reduced(reduced)
    lowered = lowered_of(model, log, search=stage != "equations")
    if lowered is None:
        return None
    if stage == "c":
        return text_of(lowered, "")
    return print_cost(lowered) if stage == "cost" else print_equations(lowered)
