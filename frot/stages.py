"""What `frot check` prints: the report, or what one stage of the compiler makes."""

from __future__ import annotations

from frot.compiler import make_report, print_stage
from frot.dsl import Log, Source, dump, load, parse, render_log
from frot.dsl.diagnostics import FrotError
from frot.dsl.reading import read_text


def report_file(path: str, name: str | None) -> str:
    """The report of a file and its warnings. Needs no C compiler and no CasADi."""
    log = Log()
    model = load(path, log, name)
    report = make_report(model, log) if model is not None else None
    if report is None or log.failed:
        raise FrotError(log)
    return "\n".join(filter(None, (str(report), render_log(log))))


def emit_stage(path: str, name: str | None, stage: str) -> str:
    """The text of one stage: `tree instance mechanism equations cost`."""
    log = Log()
    text = read_text(path, log)
    printed: str | None = None
    if text is not None and stage == "tree":
        printed = dump(parse(Source(path, text), log))
    elif text is not None:
        model = load(path, log, name)
        if model is not None and not log.failed:
            printed = dump(model) if stage == "instance" else print_stage(model, stage, log)
    if log.failed or printed is None:
        raise FrotError(log)
    return printed
