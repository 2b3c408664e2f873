"""`frot check`: the report, the same as data, or the result of a stage of the compiler."""

from __future__ import annotations

from dataclasses import asdict

from frot.compiler import Report, make_report, print_stage
from frot.dsl import Log, Source, dump, load, parse, render_log
from frot.dsl.checked.show import show_model
from frot.dsl.files.reading import read_text
from frot.dsl.messages.diagnostic_data import log_data
from frot.dsl.messages.errors import FrotError
from frot.dsl.messages.interrupts import DeferredInterrupts
from frot.dsl.messages.source import escaped

TYPE_CHECKING = False
if TYPE_CHECKING:
    from frot.compiler.report.analysis import LoopLine, ParadoxLine


def report_file(path: str, name: str | None) -> str:
    """The report of a file and its warnings. Needs no C compiler."""
    log = Log()
    report = _report(path, name, log)
    if report is None:
        raise FrotError(log)
    return "\n".join(filter(None, (str(report), render_log(log))))


def check_data(path: str, name: str | None) -> dict[str, object]:
    """The file, its diagnostics and its report (None after an error), for JSON."""
    log = Log()
    report = _report(path, name, log)
    return {
        "file": path,
        "diagnostics": log_data(log, path),
        "report": None if report is None else _report_data(report),
    }


def _report(path: str, name: str | None, log: Log) -> Report | None:
    with DeferredInterrupts():
        model = load(path, log, name)
        report = make_report(model, log) if model is not None else None
    return None if log.failed else report


def _report_data(report: Report) -> dict[str, object]:
    mobility, found = report.mobility, report.analysis
    return {
        "model": report.model,
        "variables": report.unknowns,
        "equations": report.equations,
        "events": report.events,
        "bodies": [
            {"name": name, "shape": shape, "freedoms": freedoms}
            for name, shape, freedoms in report.bodies
        ],
        "liaisons": [asdict(liaison) for liaison in report.liaisons],
        "freedoms": mobility.freedoms,
        "relations": {
            "bilateral": mobility.bilateral,
            "unilateral": mobility.unilateral,
            "by_class": {str(k): n for k, n in mobility.classes},
            "independent": mobility.independent,
            "independent_at_start": mobility.independent_at_start,
            "touching": mobility.touching,
            "touching_independent": mobility.touching_independent,
        },
        "degrees_of_freedom": mobility.degrees_of_freedom,
        "hyperstatic": mobility.hyperstatic,
        "loops": [] if found is None else [_loop_data(loop) for loop in found.loops],
        "first_integrals": [] if found is None else [asdict(x) for x in found.integrals],
        "paradoxes": [] if found is None else [_paradox_data(x) for x in found.paradoxes],
        "start_found": found is None or found.found,
        "missing": "" if found is None else found.missing,
        "uncounted": {} if found is None else dict(found.uncounted),
        "energy_alone": 0 if found is None else found.energy_alone,
        "unconnected": list(report.unconnected),
    }


def _loop_data(loop: LoopLine) -> dict[str, object]:
    changes = [{"liaison": name, "kind": kind or None} for name, kind in loop.cure]
    return {**asdict(loop), "undetermined": dict(loop.undetermined), "cure": changes}


def _paradox_data(paradox: ParadoxLine) -> dict[str, object]:
    return {**asdict(paradox), "where": dict(paradox.where)}


def emit_stage(path: str, name: str | None, stage: str) -> str:
    """The text of one stage: `tree instance mechanism reduced equations cost c`."""
    log = Log()
    text = read_text(path, log)
    printed: str | None = None
    if text is not None and stage == "tree":
        printed = dump(parse(Source(path, text), log))
    elif text is not None:
        with DeferredInterrupts():
            model = load(path, log, name)
            if model is not None and not log.failed:
                whole = stage == "instance"
                printed = show_model(model) if whole else print_stage(model, stage, log)
    if log.failed or printed is None:
        raise FrotError(log)
    return "\n".join(escaped(line) for line in printed.split("\n"))
